// SPDX-License-Identifier: MIT
// Which frame is shown at a time. Frames count from 0.
import type {Description, Time} from './core/types.ts';
import type {OpenMotion, State} from './state.ts';

/** Rounding must not turn the time of a frame into the frame before it. */
const kRounding = 1e-6;

/** The number of frames that can be shown: a still skeleton has one. */
export const numFrames = (time: Time): number => (time.is_still ? 1 : time.num_frames);

/** Whether frames of a document can be shown at other times: flows and skeletons have none. */
export const canWarp = ({time, has_frames}: Description): boolean => !time.is_still && has_frames;

/** The time of a frame, from the first frame of its motion. */
export const timeOfFrame = (time: Time, frame: number): number =>
  time.own_times === null ? frame * time.frame_time : time.own_times[frame] - time.own_times[0];

/** The last frame at or before a time, within the motion. */
export function frameAt(time: Time, seconds: number): number {
  const last = numFrames(time) - 1;
  if (time.own_times === null) {
    const frame = Math.floor(seconds / time.frame_time + kRounding);
    return Math.max(0, Math.min(last, frame));
  }
  let low = 0;
  let high = last;
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (timeOfFrame(time, middle) <= seconds + kRounding * time.frame_time) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** The frame of a motion that the page shows now. */
export const shownFrame = (motion: OpenMotion, seconds: number): number =>
  frameAt(motion.document.time, ownSeconds(motion, seconds));

/** The time of a motion, from its first frame on, at a time of the page. */
export const ownSeconds = ({offset, pace}: OpenMotion, seconds: number): number =>
  (seconds - offset) * pace;

/** The time, in the page, at which a motion shows a frame. */
export const secondsOf = (motion: OpenMotion, frame: number): number =>
  motion.offset + timeOfFrame(motion.document.time, frame) / motion.pace;

/** The time, in the page, from one frame of a motion to the next. */
export const secondsPerFrame = ({document, pace}: OpenMotion): number =>
  document.time.frame_time / pace;

/** The time, in the page, at which a motion ends. */
export const endOf = ({offset, pace, document}: OpenMotion): number =>
  offset + Number(document.time.duration) / pace;

/** Whether a motion is shown at a time, has not begun, or is over. A pose has no beginning. */
export function presenceOf(motion: OpenMotion, seconds: number): 'now' | 'before' | 'after' {
  const {time} = motion.document;
  const count = numFrames(time);
  if (count < 2) return 'now';
  const own = ownSeconds(motion, seconds);
  const slack = kRounding * time.frame_time;
  if (own < -slack) return 'before';
  // The last frame lasts as long as the others.
  return own < timeOfFrame(time, count - 1) + time.frame_time - slack ? 'now' : 'after';
}

/** When an original starts, so that both show the same frame of it where the changed one starts. */
export const originalOffset = (changed: OpenMotion, original: OpenMotion): number =>
  changed.offset - (changed.document.source_start - original.document.source_start) / original.pace;

/** From the first start to the last end of all motions, in seconds. */
export function wholeRange(state: Readonly<State>): [number, number] {
  let first = Infinity;
  let last = -Infinity;
  for (const motion of state.motions) {
    first = Math.min(first, motion.offset);
    last = Math.max(last, endOf(motion));
  }
  return first <= last ? [first, last] : [0, 0];
}

/**
 * The time and the range of a page whose active motion was changed and begins so much later in its
 * source: they stay at what of it they were at, and where there is something to show.
 */
export function shownTimes(
  state: Readonly<State>,
  motions: OpenMotion[],
  moved: number,
): Pick<State, 'seconds' | 'loop'> {
  const [wasFirst, wasLast] = wholeRange(state);
  const [first, last] = wholeRange({...state, motions});
  const within = (seconds: number) => Math.max(first, Math.min(last, seconds));
  const {seconds, loop} = state;
  const isMoved = seconds - moved >= first && seconds - moved <= last + kRounding;
  const wasThere = seconds >= wasFirst && seconds <= wasLast;
  const now = isMoved ? seconds - moved : seconds;
  const [begin, end] = (loop ?? [first, first]).map((time) => within(time - moved));
  const isAll = begin - first < kRounding && last - end < kRounding;
  return {
    seconds: isMoved || wasThere ? within(now) : seconds,
    loop: end - begin < kRounding || isAll ? null : [begin, end],
  };
}
