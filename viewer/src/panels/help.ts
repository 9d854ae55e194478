// SPDX-License-Identifier: MIT
// The help: keys, gestures, version, licences.
import {byId, el} from '../elements.ts';
import type {Shortcut} from '../keyboard.ts';
import type {Store} from '../state.ts';
import {t, type Word} from '../words.ts';
import {iconButton} from './icons.ts';

/** The licences of what the page contains, by name: build.mjs puts them in. */
declare const LICENCES: Record<string, string>;

const kGestures: [Word, Word][] = [
  ['gesture_turn', 'gesture_turn_does'],
  ['gesture_zoom', 'gesture_zoom_does'],
  ['gesture_move', 'gesture_move_does'],
  ['gesture_arrows', 'gesture_arrows_does'],
  ['gesture_joint', 'gesture_joint_does'],
  ['gesture_scrub', 'gesture_scrub_does'],
  ['gesture_wheel', 'gesture_wheel_does'],
  ['gesture_lane', 'gesture_lane_does'],
  ['gesture_key', 'gesture_key_does'],
];

/** The gestures of fingers; a page that is touched has no wheel, and mostly no keys. */
const kTouchGestures: [Word, Word][] = [
  ['gesture_turn', 'gesture_turn_does'],
  ['touch_zoom', 'gesture_zoom_does'],
  ['touch_move', 'gesture_move_does'],
  ['touch_joint', 'gesture_joint_does'],
  ['gesture_scrub', 'gesture_scrub_does'],
  ['gesture_lane', 'gesture_lane_does'],
  ['gesture_key', 'touch_key_does'],
];

const kTouch = window.matchMedia('(pointer: coarse)');

/** Keys that are pressed together, such as "Ctrl Z": each is an element. */
const keys = (together: string): (Node | string)[] =>
  together.split(' ').flatMap((key, index) => {
    const made = el('kbd', {}, [key]);
    return index === 0 ? [made] : [' ', made];
  });

const keyRow = ({shown, word}: Shortcut): HTMLElement => {
  const ways = kTouch.matches ? shown.filter((way) => !way.includes('Ctrl')) : shown;
  return el('tr', {}, [
    el(
      'td',
      {},
      ways.flatMap((way, index) => (index === 0 ? keys(way) : [' / ', ...keys(way)])),
    ),
    el('td', {}, [t(word)]),
  ]);
};

const gestureRow = ([gesture, does]: [Word, Word]): HTMLElement =>
  el('tr', {}, [el('td', {}, [t(gesture)]), el('td', {}, [t(does)])]);

const licence = ([name, text]: [string, string]): HTMLElement =>
  el('details', {}, [el('summary', {}, [name]), el('pre', {}, [text])]);

/** Fills the dialog; gives back what opens and closes it. */
export function makeHelp(store: Store, version: string, shortcuts: () => Shortcut[]): () => void {
  const dialog = byId<HTMLDialogElement>('help');
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close(); // beside it
  });
  dialog.addEventListener('keydown', (event) => {
    if (event.key !== '?') return;
    event.preventDefault(); // or the shortcut would open it again
    dialog.close();
  });
  const fill = () => {
    dialog.setAttribute('aria-label', t('help'));
    const keyTable = el('section', {class: 'keys'}, [
      el('h3', {}, [t('help_keys')]),
      el('table', {}, [el('tbody', {}, shortcuts().map(keyRow))]),
    ]);
    const gestures = el('section', {class: 'gestures'}, [
      el('h3', {}, [t(kTouch.matches ? 'help_touch' : 'help_gestures')]),
      el('table', {}, [
        el('tbody', {}, (kTouch.matches ? kTouchGestures : kGestures).map(gestureRow)),
      ]),
    ]);
    dialog.replaceChildren(
      el('div', {class: 'help'}, [
        el('header', {}, [
          el('h2', {}, [t('help')]),
          iconButton('close', () => dialog.close(), {title: t('close')}),
        ]),
        el('div', {class: 'columns'}, [
          ...(kTouch.matches ? [gestures, keyTable] : [keyTable, gestures]),
          el('section', {class: 'about'}, [
            el('h3', {}, [t('help_about')]),
            el('p', {}, [`kinefile ${version}`]),
            el('p', {}, [t('help_private')]),
            ...Object.entries(LICENCES).map(licence),
          ]),
        ]),
      ]),
    );
  };
  store.on(['language'], () => {
    if (dialog.open) fill();
  });
  return () => {
    if (dialog.open) return dialog.close();
    fill();
    dialog.showModal();
  };
}
