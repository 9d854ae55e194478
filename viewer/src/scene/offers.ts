// SPDX-License-Identifier: MIT
// What the open motions have of what the scene can show: nothing else is offered.
import type {OpenMotion, Shown} from '../state.ts';
import {numFrames} from '../times.ts';
import type {Contacts} from './contacts.ts';
import type {Figures} from './figures.ts';
import {hasShapes} from './shapes.ts';
import type {ZmpMarks} from './zmp.ts';

export interface Offers {
  readonly now: Shown;
  update(motions: readonly OpenMotion[], figures: Figures): void;
  /** Tells, now and later, when something has changed. */
  on(listener: () => void): void;
}

const kNothing: Shown = {
  ghosts: false,
  paths: false,
  contacts: false,
  zmp: false,
  axes: false,
  names: false,
  shapes: false,
};

export function makeOffers(contacts: Contacts, zmp: ZmpMarks): Offers {
  let now = kNothing;
  const listeners: (() => void)[] = [];
  return {
    get now() {
      return now;
    },
    update(motions, figures) {
      const moves = motions.some(({document}) => numFrames(document.time) > 1);
      // Contacts are asked for when the first poses are there: those are wanted first.
      const drawn = [...figures.all.values()].filter(({figure}) => figure.shown !== null);
      const next: Shown = {
        ghosts: moves,
        paths: moves,
        contacts: drawn.filter(({motion}) => contacts.has(motion)).length > 0,
        zmp: drawn.filter(({motion}) => zmp.has(motion)).length > 0,
        axes: motions.length > 0,
        names: motions.length > 0,
        shapes: motions.some(({document}) => hasShapes(document)),
      };
      const keys = Object.keys(next) as (keyof Shown)[];
      if (keys.every((key) => next[key] === now[key])) return;
      now = next;
      for (const listener of listeners) listener();
    },
    on(listener) {
      listeners.push(listener);
      listener();
    },
  };
}
