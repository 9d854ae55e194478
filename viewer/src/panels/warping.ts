// SPDX-License-Identifier: MIT
// The warp that is being made: its words and keys, and how they reach the core.
import type {Actions} from '../actions.ts';
import type {Step, WarpWords} from '../core/types.ts';
import {activeMotion, type OpenMotion, type Store} from '../state.ts';
import {latestOnly} from './latest.ts';
import {isSameKey, type Key, keysOf, warpOf, wordsWith} from './warpwords.ts';

export interface Warping {
  readonly keys: readonly Key[];
  readonly words: WarpWords;
  readonly before: Step[];
  /** What the core says against the words; empty: nothing. */
  readonly fault: string;
  /** The options that differ from those that the core last took, while there is a fault. */
  readonly refusedOptions: string[];
  /** Whether there is a fault, and a key is none of those that the core last took. */
  isRefused(key: Key): boolean;
  /** How many frames the active motion had before the warp. */
  readonly numOld: number;
  /** Changes keys or words, and asks for the motion. */
  set(change: {keys?: readonly Key[]; words?: WarpWords}): Promise<void>;
  /** Until `end`, all changes are undone as one. */
  beginDrag(): void;
  endDrag(): void;
  /** Calls a function whenever something of it has changed. */
  onChange(listener: () => void): void;
}

export function makeWarping(store: Store, actions: Actions): Warping {
  /** The numbers of frames of motions, by what was done to them. */
  const lengths = new Map<string, number>();
  const lengthKey = (handle: number, steps: Step[]) => `${handle} ${JSON.stringify(steps)}`;
  let keys: readonly Key[] = [];
  let words: WarpWords = {};
  let fault = '';
  let seen: {handle: number; steps: Step[]} | null = null;
  /** The drag that goes on, and whether the core has taken one of its changes. */
  let drag: {isTaken: boolean} | null = null;
  const listeners: (() => void)[] = [];
  const tell = () => {
    for (const listener of listeners) listener();
  };

  const lengthBefore = (motion: OpenMotion): number => {
    const {before} = warpOf(motion.steps);
    const {time, source_frames} = motion.document;
    if (before.length === motion.steps.length) return time.num_frames;
    const known = lengths.get(lengthKey(motion.handle, before));
    if (known !== undefined) return known;
    return Math.ceil(source_frames.reduce((most, frame) => Math.max(most, frame), 0)) + 1;
  };

  /** Takes over what the motion has: after undo, or when another motion is active. */
  const read = (motion: OpenMotion) => {
    ({words} = warpOf(motion.steps));
    keys = keysOf(words, motion.document.time.frame_time);
    fault = '';
  };

  const ask = latestOnly(async (of: {isTaken: boolean} | null) => {
    const motion = activeMotion(store.state);
    if (motion === undefined) return;
    const {before} = warpOf(motion.steps);
    const steps = keys.length === 0 ? before : [...before, {warp: wordsWith(words, [...keys])}];
    if (JSON.stringify(steps) === JSON.stringify(motion.steps)) {
      fault = '';
      return;
    }
    seen = {handle: motion.handle, steps};
    const failure = await actions.trySteps(motion, steps, of?.isTaken);
    fault = failure === null ? '' : failure.error.message;
    if (failure === null && of !== null) of.isTaken = true;
    if (failure !== null) seen = {handle: motion.handle, steps: motion.steps};
  });

  /** What the core last took. */
  const taken = (): {keys: Key[]; words: WarpWords} => {
    const motion = activeMotion(store.state);
    if (motion === undefined) return {keys: [], words: {}};
    const last = warpOf(motion.steps).words;
    return {keys: keysOf(last, motion.document.time.frame_time), words: last};
  };

  store.on(['motions', 'active'], (state) => {
    for (const {handle, steps, document} of state.motions) {
      const last = steps[steps.length - 1];
      if (last !== undefined && 'warp' in last) continue;
      lengths.set(lengthKey(handle, steps), document.time.num_frames);
    }
    const motion = activeMotion(state);
    if (motion === undefined) return;
    if (seen?.handle !== motion.handle || seen.steps !== motion.steps) {
      seen = {handle: motion.handle, steps: motion.steps};
      read(motion);
    }
    tell();
  });

  return {
    get keys() {
      return keys;
    },
    get words() {
      return words;
    },
    get before() {
      const motion = activeMotion(store.state);
      return motion === undefined ? [] : warpOf(motion.steps).before;
    },
    get fault() {
      return fault;
    },
    get refusedOptions() {
      if (fault === '') return [];
      const last = taken().words;
      const names = new Set([...Object.keys(words), ...Object.keys(last)]);
      return [...names].filter((name) => name !== 'key' && words[name] !== last[name]);
    },
    isRefused: (key) => fault !== '' && !taken().keys.some((own) => isSameKey(own, key)),
    get numOld() {
      const motion = activeMotion(store.state);
      return motion === undefined ? 1 : lengthBefore(motion);
    },
    async set(change) {
      keys = change.keys ?? keys;
      words = change.words ?? words;
      tell();
      await ask(drag);
      tell();
    },
    beginDrag() {
      drag = {isTaken: false};
    },
    endDrag() {
      drag = null;
    },
    onChange(listener) {
      listeners.push(listener);
    },
  };
}
