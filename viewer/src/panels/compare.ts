// SPDX-License-Identifier: MIT
// The original beside what was made of it.
import {type Actions, kColours} from '../actions.ts';
import {type OpenMotion, type Store, withMotion} from '../state.ts';
import {t} from '../words.ts';

/**
 * Opens the file of a motion once more, as it is. The original then has the first colour, as in
 * the document on time warping, and the changed one the other.
 */
export async function compareWithOriginal(
  store: Store,
  actions: Actions,
  motion: OpenMotion,
): Promise<OpenMotion | null> {
  const original = await actions.openPath(motion.document.path, motion.document);
  if (original === null) return null;
  const changed = store.state.motions.find((other) => other.handle === motion.handle);
  const {handle} = original;
  const title = t('original_of', original.title);
  store.set({motions: withMotion(store.state, handle, {title, offset: motion.offset})});
  if (changed !== undefined && original.colour !== kColours[0]) {
    const colour = changed.colour;
    store.set({motions: withMotion(store.state, handle, {colour})});
    store.set({
      motions: withMotion(store.state, changed.handle, {colour: original.colour}),
      active: changed.handle,
    });
  }
  return original;
}
