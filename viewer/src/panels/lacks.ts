// SPDX-License-Identifier: MIT
// What is said over the scene of a motion that has no figure yet.
import {byId, el} from '../elements.ts';
import {activeMotion, type Store} from '../state.ts';
import {fromCore, t} from '../words.ts';

/** Says what the active motion lacks; its values, which it has, are chosen as those of a joint. */
export function makeLacks(store: Store): void {
  const note = el('p', {class: 'lacks', attributes: {role: 'status'}});
  byId('stage').append(note);
  store.on(['motions', 'active', 'language'], (state) => {
    const motion = activeMotion(state);
    const lacks = motion?.document.lacks ?? '';
    note.hidden = lacks === '';
    if (motion === undefined || lacks === '') return;
    note.textContent = t('with_reason', motion.title, fromCore(lacks));
    if (state.joint < 0) store.set({joint: 0});
  });
}
