// SPDX-License-Identifier: MIT
// Which frames a contact sheet shows, and how it is laid out.
import type {OpenMotion} from '../state.ts';

export interface SheetFrames {
  motion: OpenMotion;
  frames: number[];
}

/** Without a step there are about so many pictures; with one, never more than the most. */
const kUsual = 12;
const kMost = 120;

/**
 * The frames of "A:B:STEP", B not included, as elsewhere in kinefile. Either end may be missing.
 * Without a step, the frames are spread evenly. Null: no such range of `count` frames.
 */
export function framesOf(text: string, count: number): number[] | null {
  const found = /^\s*(\d*)(?::(\d*)(?::(\d*))?)?\s*$/.exec(text);
  if (found === null) return null;
  const [, first, last, by] = found;
  const begin = first ? Number(first) : 0;
  const isOne = last === undefined && first !== '';
  const end = isOne ? begin + 1 : last ? Number(last) : count;
  if (begin >= end || end > count || by === '0') return null;
  const room = end - begin;
  const given = by ? Number(by) : Math.max(1, Math.ceil(room / kUsual));
  const step = Math.max(given, Math.ceil(room / kMost));
  return Array.from({length: Math.ceil(room / step)}, (_, k) => begin + k * step);
}

/** The columns and rows in which pictures of something of an aspect are largest. */
export function gridFor(count: number, width: number, height: number, aspect: number) {
  let best = {columns: 1, rows: count, scale: 0};
  for (let columns = 1; columns <= count; columns++) {
    const rows = Math.ceil(count / columns);
    const scale = Math.min(width / columns / aspect, height / rows);
    if (scale > best.scale * 1.001) best = {columns, rows, scale};
  }
  return best;
}
