// SPDX-License-Identifier: MIT
// Short notes about what was just done, which go away by themselves.
import type {Store} from './state.ts';

const kStay = 4000;

/** Shows a note for some seconds, unless another message comes. */
export function notify(store: Store, text: string): void {
  store.set({message: text});
  setTimeout(() => {
    if (store.state.message === text) store.set({message: ''});
  }, kStay);
}
