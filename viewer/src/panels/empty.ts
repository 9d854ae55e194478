// SPDX-License-Identifier: MIT
// What is seen before a motion is open.
import type {Tables} from '../core/types.ts';
import {button, byId, el} from '../elements.ts';
import type {Store} from '../state.ts';
import {fromCore, t} from '../words.ts';

/** Makes what the empty page shows; the formats are those that the core reads. */
export function makeEmpty({formats}: Tables, store: Store): void {
  const empty = byId('empty');
  const choose = (id: string) => byId<HTMLInputElement>(id).click();
  const fill = () => {
    const read = formats.filter((format) => format.is_read);
    empty.replaceChildren(
      el('div', {class: 'card'}, [
        el('h2', {}, [t('empty_title')]),
        el('p', {}, [t('empty_text')]),
        el('p', {class: 'group'}, [
          button(t('open_files'), () => choose('choose-files'), {class: 'primary'}),
          button(t('open_folder'), () => choose('choose-folder')),
        ]),
        el('p', {class: 'faint'}, [t('empty_companions')]),
        el(
          'ul',
          {class: 'formats', ariaLabel: t('empty_formats')},
          read.map(({name, description, extensions}) =>
            el('li', {title: fromCore(description)}, [
              el('b', {}, [name]),
              ` ${extensions.map((one) => (one.startsWith('.') ? one : `.${one}`)).join(' ')}`,
            ]),
          ),
        ),
        el('p', {class: 'faint'}, [t('empty_private')]),
      ]),
    );
  };
  store.on(['language'], fill);
  store.on(['motions', 'busy'], ({motions, busy}) => {
    empty.hidden = motions.length > 0 || busy !== '';
    document.body.classList.toggle('is-empty', motions.length === 0);
  });
}
