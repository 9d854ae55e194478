// SPDX-License-Identifier: MIT
// What the plots show: of each visible motion the joint of the same name, on one x axis.
import uPlot from 'uplot';
import type {Time} from '../core/types.ts';
import {activeMotion, type OpenMotion, type State} from '../state.ts';
import {frameAt, numFrames, secondsOf, timeOfFrame} from '../times.ts';
import {isDark, lineColour, readableColour} from './colours.ts';
import type {Line, Range} from './plot.ts';
import type {Measure, Quantity, SeriesCache} from './series.ts';

/** What the x axis counts: frames of the active motion, or seconds of the page. */
export type XAxis = 'frames' | 'seconds';

/** One line, with its numbers. */
export interface PlottedLine extends Line {
  motion: OpenMotion;
  quantity: Quantity;
  values: Float64Array;
}

/** The lines of one measure. */
export interface PlottedGroup {
  measure: Measure;
  lines: PlottedLine[];
  data: uPlot.AlignedData;
}

/** Lines of several motions differ by colour, their quantities by dashes. */
const kDashes = [[], [6, 3], [2, 2], [8, 3, 2, 3], [12, 4], [4, 6]];

/** The frame at a time from a motion's start, with the part of the way to the next one. */
function frameCoordinate(time: Time, seconds: number): number {
  if (time.own_times === null) return seconds / time.frame_time;
  const frame = frameAt(time, seconds);
  const begin = timeOfFrame(time, frame);
  const isLast = frame + 1 >= numFrames(time);
  const step = isLast ? time.frame_time : timeOfFrame(time, frame + 1) - begin;
  return frame + (seconds - begin) / step;
}

/** Where a frame of a motion is on the x axis. */
export function xOfFrame(x: XAxis, active: OpenMotion, motion: OpenMotion, frame: number): number {
  if (x === 'seconds') return secondsOf(motion, frame);
  if (motion.handle === active.handle) return frame;
  return frameCoordinate(active.document.time, secondsOf(motion, frame) - active.offset);
}

/** The frame of the active motion that is nearest to a place on the x axis. */
export function frameAtX(x: XAxis, active: OpenMotion, place: number): number {
  if (x === 'frames') return Math.round(place);
  return Math.round(frameCoordinate(active.document.time, place - active.offset));
}

const xsOf = (x: XAxis, active: OpenMotion, motion: OpenMotion, count: number): Float64Array =>
  Float64Array.from({length: count}, (_, frame) => xOfFrame(x, active, motion, frame));

/** The motions that are plotted, each with the joint that has the name of the selected one. */
export function plottedMotions(state: Readonly<State>): {motion: OpenMotion; joint: number}[] {
  const active = activeMotion(state);
  const name = active?.document.joints[state.joint]?.name;
  if (active === undefined || name === undefined) return [];
  return state.motions
    .filter((motion) => motion.isVisible || motion === active)
    .map((motion) => ({
      motion,
      joint:
        motion === active
          ? state.joint
          : motion.document.joints.findIndex((joint) => joint.name === name),
    }))
    .filter(({motion, joint}) => joint >= 0 && !motion.document.time.is_still);
}

/** Joins lines whose frames are at the same places, or at others. */
function aligned(lines: PlottedLine[], x: XAxis, active: OpenMotion): uPlot.AlignedData {
  const xs = lines.map(({motion, values}) => xsOf(x, active, motion, values.length));
  const isSame = xs.every(
    (own) => own.length === xs[0].length && own.every((value, index) => value === xs[0][index]),
  );
  if (isSame) return [xs[0], ...lines.map(({values}) => values)];
  return uPlot.join(lines.map(({values}, index) => [xs[index], values]));
}

/** Asks for everything that the plots show; groups of one measure in the order of quantities. */
export async function plottedGroups(
  cache: SeriesCache,
  state: Readonly<State>,
  quantities: Quantity[],
  x: XAxis,
): Promise<PlottedGroup[]> {
  const active = activeMotion(state);
  const motions = plottedMotions(state);
  if (active === undefined) return [];
  const dark = isDark();
  const groups = new Map<Measure, PlottedLine[]>();
  for (const quantity of quantities) {
    const lines = groups.get(quantity.measure) ?? [];
    const n = new Set(lines.map((line) => line.quantity)).size;
    for (const {motion, joint} of motions) {
      const values = await cache.values(motion, joint, quantity);
      if (values === null || values.length === 0) continue;
      const isAlone = motions.length === 1;
      lines.push({
        label: quantity.key,
        colour: isAlone
          ? lineColour('xyz'.indexOf(quantity.key), n, dark)
          : readableColour(motion.colour, dark),
        dash: isAlone ? [] : kDashes[n % kDashes.length],
        limits: motion === active ? quantity.limits.filter((limit) => limit !== undefined) : [],
        motion,
        quantity,
        values,
      });
    }
    if (lines.length > 0) groups.set(quantity.measure, lines);
  }
  return [...groups].map(([measure, lines]) => ({
    measure,
    lines,
    data: aligned(lines, x, active),
  }));
}

/** The part of the x axis that everything is in. */
export function wholeX(groups: PlottedGroup[]): Range {
  let [min, max] = [Infinity, -Infinity];
  for (const {data} of groups) {
    min = Math.min(min, data[0][0]);
    max = Math.max(max, data[0][data[0].length - 1]);
  }
  return min < max ? [min, max] : [min - 1, min + 1];
}
