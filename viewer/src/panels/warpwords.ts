// SPDX-License-Identifier: MIT
// The words of a warp, as the core's table of warp options has them, and its keys in frames.
import type {Step, WarpWords} from '../core/types.ts';

/** The new motion shows at `to` what the old one shows at `from`; frames. */
export interface Key {
  from: number;
  to: number;
}

const kDecimals = 1000;

/** A number with three decimals where it needs them. */
export const numberText = (value: number): string =>
  String(Math.round(value * kDecimals) / kDecimals);

/** A key as a word of the command. */
const keyText = ({from, to}: Key): string => `${numberText(from)}:${numberText(to)}`;

/** The last step if it is a warp, otherwise a new one; and the steps before it. */
export function warpOf(steps: Step[]): {before: Step[]; words: WarpWords} {
  const last = steps[steps.length - 1];
  if (last !== undefined && 'warp' in last) return {before: steps.slice(0, -1), words: last.warp};
  return {before: steps, words: {}};
}

/** Whether two keys are written alike. */
export const isSameKey = (one: Key, other: Key): boolean => keyText(one) === keyText(other);

/** The keys of a warp, in frames. */
export function keysOf(words: WarpWords, frameTime: number): Key[] {
  const texts = [words.key ?? []].flat() as string[];
  const scale = words.seconds === true ? 1 / frameTime : 1;
  return texts
    .flatMap((text) => text.split(','))
    .map((text) => {
      const [from, to] = text.split(':').map(Number);
      return {from: from * scale, to: to * scale};
    });
}

/** The words with other keys. */
export function wordsWith(words: WarpWords, keys: Key[]): WarpWords {
  const {seconds: _, ...others} = words;
  return {...others, key: keys.map(keyText)};
}
