// SPDX-License-Identifier: MIT
// The list of open motions: which is active, which are shown.
import type {Actions} from '../actions.ts';
import {button, byId, el} from '../elements.ts';
import {type OpenMotion, type Store, withMotion} from '../state.ts';
import {t} from '../words.ts';

export function makeMotionList(store: Store, actions: Actions): void {
  const list = byId('motions');

  const row = (motion: OpenMotion): HTMLElement => {
    const swatch = el('span', {class: 'swatch'});
    swatch.style.background = motion.colour;
    const {handle, title, isVisible} = motion;
    return el('div', {class: handle === store.state.active ? 'motion active' : 'motion'}, [
      swatch,
      button(title, () => store.set({active: handle, joint: -1}), {class: 'title', title}),
      button(
        isVisible ? '◉' : '○',
        () => {
          store.set({motions: withMotion(store.state, handle, {isVisible: !isVisible})});
        },
        {title: t(isVisible ? 'hide' : 'show'), pressed: isVisible},
      ),
      button('✕', () => actions.close(motion), {title: t('close')}),
    ]);
  };

  store.on(['motions', 'active', 'language'], ({motions}) => {
    list.replaceChildren(...motions.map(row));
  });
}
