// SPDX-License-Identifier: MIT
// The state of the page, in one place. Every part of the page draws what is in it, and changes it
// through `set`.
import type {Description, Diagnostic, OpenedFile, Step} from './core/types.ts';
import type {Language} from './words.ts';

/** How a motion stands in the scene, beside the others. */
export type Placement = 'recorded' | 'aligned' | 'beside';

/** A direction along an axis of a file. */
export type Front = '+x' | '-x' | '+y' | '-y' | '+z' | '-z';

/** A motion that is open. */
export interface OpenMotion {
  handle: number;
  /** Its name in the page: the file's, with what was done to it. */
  title: string;
  colour: string;
  isVisible: boolean;
  document: Description;
  /** What was done to it, in order. */
  steps: Step[];
  /** The lists of steps that undo goes back to, the last one last. */
  done: Step[][];
  /** The lists of steps that redo goes on to, the next one first. */
  undone: Step[][];
  /** Counts the changes of its poses. */
  version: number;
  /** The time at which it starts, in seconds. */
  offset: number;
  /** The handle of the motion that was made of it, and with which it keeps step; 0: none. */
  originalOf: number;
  /** How fast it runs beside the others: other than 1 where frames are linked by number. */
  pace: number;
  placement: Placement;
  /** Where its figure faces, as a person says; null: where the core finds it does. */
  front: Front | null;
  diagnostics: Diagnostic[];
}

/** How the times of motions belong together. */
export type Link = 'time' | 'frames';

export type Camera = 'orbit' | 'follow' | 'front' | 'side' | 'top';

/** What the scene shows beside the figures. */
export interface Shown {
  ghosts: boolean;
  paths: boolean;
  contacts: boolean;
  zmp: boolean;
  axes: boolean;
  names: boolean;
  shapes: boolean;
}

export interface State {
  motions: OpenMotion[];
  /** The handle of the motion that the panels show; 0: none. */
  active: number;
  /** The selected joint of the active motion; -1: none. */
  joint: number;
  /** Files that could not be opened, or wait. */
  files: OpenedFile[];
  /** The time that is shown, in seconds. */
  seconds: number;
  isPlaying: boolean;
  speed: number;
  /** The part that is repeated, in seconds; null: all. */
  loop: [number, number] | null;
  /** Whether it is repeated, or stops at its end. */
  repeats: boolean;
  link: Link;
  camera: Camera;
  shown: Shown;
  /** Whether the editor of the time warp is open. */
  isWarping: boolean;
  /** Whether the side panel is open. */
  isSideOpen: boolean;
  /** Whether everything around the scene is hidden. */
  isBare: boolean;
  /** The panel that is open, by its name; empty: the first one. */
  panel: string;
  language: Language;
  /** What the page is busy with; empty: nothing. */
  busy: string;
  /** A message for the person who uses the page; empty: none. */
  message: string;
}

type Key = keyof State;
type Listener = (state: State, changed: ReadonlySet<Key>) => void;

export interface Store {
  readonly state: Readonly<State>;
  /** Replaces members of the state and tells everyone who listens to one of them. */
  set(change: Partial<State>): void;
  /** Calls a function now, and whenever one of these members has changed. */
  on(keys: readonly Key[], listener: Listener): void;
}

export function makeStore(initial: State): Store {
  let state = initial;
  const listeners: {keys: readonly Key[]; listener: Listener}[] = [];
  return {
    get state() {
      return state;
    },
    set(change) {
      const keys = (Object.keys(change) as Key[]).filter((key) => change[key] !== state[key]);
      if (keys.length === 0) return;
      state = {...state, ...change};
      const changed = new Set(keys);
      for (const {keys: wanted, listener} of listeners) {
        if (wanted.some((key) => changed.has(key))) listener(state, changed);
      }
    },
    on(keys, listener) {
      listeners.push({keys, listener});
      listener(state, new Set(keys));
    },
  };
}

/** The active motion. */
export const activeMotion = (state: Readonly<State>): OpenMotion | undefined =>
  state.motions.find((motion) => motion.handle === state.active);

/** The motions with one of them changed. */
export const withMotion = (
  state: Readonly<State>,
  handle: number,
  change: Partial<OpenMotion>,
): OpenMotion[] =>
  state.motions.map((motion) => (motion.handle === handle ? {...motion, ...change} : motion));
