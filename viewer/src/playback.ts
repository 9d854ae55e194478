// SPDX-License-Identifier: MIT
// Time that runs: play, pause, speed, loop, steps.
import {activeMotion, type Store} from './state.ts';
import {numFrames, secondsOf, shownFrame, wholeRange} from './times.ts';

export const kLeastSpeed = 0.1;
export const kMostSpeed = 4;
/** The speeds that are offered. */
export const kSpeeds = [0.1, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4];

/** Playing from the end starts at the beginning. */
const kAtEnd = 1e-6;

/** The range that plays: what there is of the loop, otherwise everything. */
export function playedRange({state}: Store): [number, number] {
  const [first, last] = wholeRange(state);
  const [begin, end] = state.loop ?? [first, last];
  const isThere = begin < last && end > first;
  return isThere ? [Math.max(first, begin), Math.min(last, end)] : [first, last];
}

/** Lets time run while the page plays. */
export function runPlayback(store: Store): void {
  let last = 0;
  const advance = (now: number) => {
    if (!store.state.isPlaying) return;
    const {seconds, speed} = store.state;
    const [begin, end] = playedRange(store);
    let next = seconds + ((now - last) / 1000) * speed;
    last = now;
    if (next > end && !store.state.repeats) return store.set({seconds: end, isPlaying: false});
    if (next > end || next < begin) next = begin;
    store.set({seconds: next});
    requestAnimationFrame(advance);
  };
  store.on(['isPlaying'], ({isPlaying}) => {
    if (!isPlaying) return;
    last = performance.now();
    const [begin, end] = playedRange(store);
    if (store.state.seconds >= end - kAtEnd) store.set({seconds: begin});
    requestAnimationFrame(advance);
  });
}

/** Shows a frame of the active motion. */
export function goToFrame(store: Store, frame: number): void {
  const motion = activeMotion(store.state);
  if (motion === undefined) return;
  const last = numFrames(motion.document.time) - 1;
  store.set({isPlaying: false, seconds: secondsOf(motion, Math.max(0, Math.min(last, frame)))});
}

/** Steps by frames of the active motion. */
export function step(store: Store, frames: number): void {
  const motion = activeMotion(store.state);
  if (motion !== undefined) goToFrame(store, shownFrame(motion, store.state.seconds) + frames);
}

export function setSpeed(store: Store, speed: number): void {
  store.set({speed: Math.max(kLeastSpeed, Math.min(kMostSpeed, speed))});
}

/** The next of the offered speeds, up or down. */
export function stepSpeed(store: Store, direction: 1 | -1): void {
  const {speed} = store.state;
  const next =
    direction > 0
      ? kSpeeds.find((other) => other > speed)
      : kSpeeds.filter((other) => other < speed).pop();
  if (next !== undefined) setSpeed(store, next);
}
