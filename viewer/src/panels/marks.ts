// SPDX-License-Identifier: MIT
// What the core marks on the timeline of the active motion, and where its feet are on the ground.
import {type Core, isFailure} from '../core/core.ts';
import type {Contact, Mark} from '../core/types.ts';
import {goToFrame} from '../playback.ts';
import {activeMotion, type Store} from '../state.ts';
import {shownFrame} from '../times.ts';
import {fromCore} from '../words.ts';

export interface Marks {
  readonly all: readonly Mark[];
  readonly contacts: readonly Contact[];
  /** Goes to the next mark after the shown frame, or the one before it. */
  go(direction: 1 | -1): void;
  /** Goes to the worst frame of a mark, selects its joint and shows its sentence. */
  select(mark: Mark): void;
  /** Shows a sentence for a while; empty: none. */
  tell(text: string): void;
  /** Calls a function now, and whenever the marks change. */
  onChange(listener: () => void): void;
  /** Calls a function when a sentence is to be shown. */
  onTell(listener: (text: string) => void): void;
}

/** The marks of a motion that is being changed are asked for when it has been left alone. */
const kPause = 250;

export function makeMarks(core: Core, store: Store): Marks {
  let all: Mark[] = [];
  let contacts: Contact[] = [];
  let shown = '';
  let timer = 0;
  /** The frame whose mark is told of; what is said of it goes when another frame is shown. */
  let toldFrame: number | null = null;
  const listeners: (() => void)[] = [];
  const tellers: ((text: string) => void)[] = [];
  const changed = () => {
    for (const listener of listeners) listener();
  };
  const keyOf = () => {
    const motion = activeMotion(store.state);
    return motion === undefined ? '' : `${motion.handle}/${motion.version}`;
  };

  const ask = async (key: string) => {
    const motion = activeMotion(store.state);
    if (motion === undefined || motion.document.time.is_still) return;
    const {handle} = motion;
    const [marked, touched] = await Promise.all([
      core.ask('marks', {handle}),
      core.ask('contacts', {handle}),
    ]);
    if (keyOf() !== key) return;
    all = isFailure(marked) ? [] : [...marked.marks].sort((a, b) => a.worst_frame - b.worst_frame);
    contacts = isFailure(touched) ? [] : touched.contacts;
    changed();
  };

  store.on(['motions', 'active'], () => {
    const key = keyOf();
    if (key === shown) return;
    const isOther = key.split('/')[0] !== shown.split('/')[0];
    shown = key;
    all = [];
    contacts = [];
    if (toldFrame !== null) marks.tell('');
    changed();
    clearTimeout(timer);
    if (key !== '') timer = window.setTimeout(() => ask(key), isOther ? 0 : kPause);
  });

  store.on(['seconds'], ({seconds}) => {
    const motion = activeMotion(store.state);
    if (toldFrame === null || motion === undefined) return;
    if (shownFrame(motion, seconds) !== toldFrame) marks.tell('');
  });

  const marks: Marks = {
    get all() {
      return all;
    },
    get contacts() {
      return contacts;
    },
    go(direction) {
      const motion = activeMotion(store.state);
      if (motion === undefined || all.length === 0) return;
      const frame = shownFrame(motion, store.state.seconds);
      const next =
        direction > 0
          ? all.find((mark) => mark.worst_frame > frame)
          : all.filter((mark) => mark.worst_frame < frame).pop();
      marks.select(next ?? (direction > 0 ? all[0] : all[all.length - 1]));
    },
    select(mark) {
      goToFrame(store, mark.worst_frame);
      store.set({joint: mark.joint});
      marks.tell(fromCore(mark.message));
      toldFrame = mark.worst_frame;
    },
    tell(text) {
      toldFrame = null;
      for (const teller of tellers) teller(text);
    },
    onChange(listener) {
      listeners.push(listener);
      listener();
    },
    onTell(listener) {
      tellers.push(listener);
    },
  };
  return marks;
}
