// SPDX-License-Identifier: MIT
// The original beside what is made of it.
import {type Actions, kColours} from '../actions.ts';
import type {Step} from '../core/types.ts';
import {type OpenMotion, type Store, withMotion} from '../state.ts';
import {originalOffset} from '../times.ts';
import {t} from '../words.ts';

/**
 * Opens the file of a motion once more, with these steps, and shows it before the motion, as its
 * original: it has the first colour, as in the document on time warping, and shows at every time the
 * frame that the changed one was made of.
 */
export async function openOriginal(
  store: Store,
  actions: Actions,
  motion: OpenMotion,
  steps: Step[] = [],
): Promise<void> {
  const opened = await actions.openPath(motion.document.path, motion.document);
  if (opened === null) return;
  if (steps.length > 0) await actions.setSteps(opened, steps);
  const {motions} = store.state;
  const original = motions.find(({handle}) => handle === opened.handle);
  const changed = motions.find(({handle}) => handle === motion.handle);
  if (original === undefined || changed === undefined) return;
  const isFirst = original.colour === kColours[0];
  const placed: OpenMotion = {
    ...original,
    title: steps.length > 0 ? original.title : t('original_of', original.title),
    colour: isFirst ? original.colour : changed.colour,
    placement: changed.placement,
    front: changed.front,
    originalOf: changed.handle,
    offset: originalOffset(changed, original),
    done: [], // its steps are no change of its own
  };
  const others = withMotion(store.state, changed.handle, {
    colour: isFirst ? changed.colour : original.colour,
  }).filter(({handle}) => handle !== original.handle);
  store.set({
    motions: others.flatMap((one) => (one.handle === changed.handle ? [placed, one] : [one])),
    active: changed.handle,
  });
}
