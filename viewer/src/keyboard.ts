// SPDX-License-Identifier: MIT
// Keyboard shortcuts: one table, from which the help is made.
import type {Actions} from './actions.ts';
import {notify} from './notify.ts';
import {setLoopEnd} from './panels/track.ts';
import {focusFrame} from './panels/transport.ts';
import {goToFrame, step, stepSpeed} from './playback.ts';
import {activeMotion, type Camera, type Shown, type Store} from './state.ts';
import {t, type Word} from './words.ts';

export interface Shortcut {
  /** As `nameOf` names keys; all of them do the same. */
  keys: string[];
  /** What the help calls them. */
  shown: string[];
  word: Word;
  run(): void;
}

/** What shortcuts do that is not in the state. */
export interface ShortcutActions {
  toggleHelp(): void;
  toggleWarp(): void;
  goToMark(direction: 1 | -1): void;
  frameAll(): void;
}

/** The name of a pressed key: with ctrl (or cmd) and, for keys that have no other sign, shift. */
function nameOf(event: KeyboardEvent): string {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const isLetter = /^[\p{L}]$/u.test(key);
  const ctrl = (event.ctrlKey || event.metaKey) && !event.getModifierState('AltGraph');
  const shift = event.shiftKey && (isLetter || event.key.length > 1);
  return `${ctrl ? 'ctrl+' : ''}${shift ? 'shift+' : ''}${key}`;
}

const kTyped =
  'input:not([type="checkbox"], [type="radio"], [type="range"], [type="button"], [type="file"]), ' +
  'textarea, select, [contenteditable]';
const kMoved = 'input, summary, [role="tab"], [role="listbox"], [role="option"], [role="treeitem"]';
const kPressed = 'button, summary, a, input, [role="tab"], [role="button"], [role="option"]';
const kMoves = /^(shift\+)?(Arrow|Home|End|Page)/;

/** Whether the element that has the focus needs the key itself. */
function isTaken(event: KeyboardEvent): boolean {
  const target = event.target as Element | null;
  if (target === null || !(target instanceof Element)) return false;
  if (target.closest(kTyped) !== null) return true;
  if (kMoves.test(nameOf(event))) return target.closest(kMoved) !== null;
  if (event.key !== ' ' && event.key !== 'Enter') return false;
  // A click may leave the focus on a button without showing it; the space bar still plays.
  return target.closest(kPressed) !== null && target.matches(':focus-visible');
}

/** The shortcuts of the page. */
export function makeShortcuts(store: Store, actions: Actions, others: ShortcutActions): Shortcut[] {
  const active = () => activeMotion(store.state);
  const camera = (name: Camera) => () => {
    if (store.state.camera === name) others.frameAll();
    else store.set({camera: name});
  };
  const toggle = (name: keyof Shown, word: Word) => () => {
    const isOn = !store.state.shown[name];
    store.set({shown: {...store.state.shown, [name]: isOn}});
    notify(store, t(isOn ? 'is_on' : 'is_off', t(word)));
  };
  const undo = () => {
    const motion = active();
    if (motion !== undefined) actions.undo(motion);
  };
  const redo = () => {
    const motion = active();
    if (motion !== undefined) actions.redo(motion);
  };
  const nextMotion = () => {
    const {motions} = store.state;
    const index = motions.findIndex((motion) => motion.handle === store.state.active);
    if (motions.length > 1) {
      store.set({active: motions[(index + 1) % motions.length].handle, joint: -1});
    }
  };
  const of = (keys: string[], word: Word, run: () => void, shown = keys): Shortcut => ({
    keys,
    shown,
    word,
    run,
  });
  return [
    of([' '], 'key_play', () => store.set({isPlaying: !store.state.isPlaying}), ['Space']),
    of(['ArrowLeft'], 'step_back', () => step(store, -1), ['←']),
    of(['ArrowRight'], 'step_forward', () => step(store, 1), ['→']),
    of(['shift+ArrowLeft'], 'key_ten_back', () => step(store, -10), ['Shift ←']),
    of(['shift+ArrowRight'], 'key_ten_forward', () => step(store, 10), ['Shift →']),
    of(['Home'], 'first_frame', () => goToFrame(store, 0)),
    of(['End'], 'last_frame', () => goToFrame(store, Infinity)),
    of(['f'], 'key_type_frame', focusFrame, ['F']),
    of(['['], 'key_slower', () => stepSpeed(store, -1)),
    of([']'], 'key_faster', () => stepSpeed(store, 1)),
    of(['l'], 'repeat', () => store.set({repeats: !store.state.repeats}), ['L']),
    of(['i'], 'loop_begin', () => setLoopEnd(store, 'begin'), ['I']),
    of(['o'], 'loop_end', () => setLoopEnd(store, 'end'), ['O']),
    of(['shift+l'], 'loop_clear', () => store.set({loop: null}), ['Shift L']),
    of([','], 'previous_mark', () => others.goToMark(-1)),
    of(['.'], 'next_mark', () => others.goToMark(1)),
    of(['w'], 'warp', others.toggleWarp, ['W']),
    of(['1'], 'key_orbit', camera('orbit')),
    of(['2'], 'key_front', camera('front')),
    of(['3'], 'key_side', camera('side')),
    of(['4'], 'key_top', camera('top')),
    of(['5'], 'key_follow', camera('follow')),
    of(['0'], 'key_frame_all', others.frameAll),
    of(['g'], 'key_ghosts', toggle('ghosts', 'key_ghosts'), ['G']),
    of(['p'], 'key_paths', toggle('paths', 'key_paths'), ['P']),
    of(['c'], 'key_contacts', toggle('contacts', 'key_contacts'), ['C']),
    of(['a'], 'key_axes', toggle('axes', 'key_axes'), ['A']),
    of(['n'], 'key_names', toggle('names', 'key_names'), ['N']),
    of(['m'], 'key_next_motion', nextMotion, ['M']),
    of(['u', 'ctrl+z'], 'undo', undo, ['U', 'Ctrl Z']),
    of(['shift+u', 'ctrl+shift+z', 'ctrl+y'], 'redo', redo, ['Shift U', 'Ctrl Shift Z']),
    of(['h'], 'key_bare', () => store.set({isBare: !store.state.isBare}), ['H']),
    of(['?'], 'help', others.toggleHelp),
    of(['Escape'], 'key_escape', () => {
      store.set({isBare: false, isWarping: false, message: ''});
    }),
  ];
}

const kClicked = 'button, summary, input:is([type="checkbox"], [type="radio"])';

/**
 * After a click with a pointer the focus goes back to the page, so that the space bar plays. What
 * is pressed with a key keeps the focus; so does what is in a dialog.
 */
function giveBackFocus(event: MouseEvent): void {
  const focused = document.activeElement;
  if (event.detail === 0 || !(focused instanceof HTMLElement)) return;
  if (focused.matches(kClicked) && focused.closest('dialog') === null) focused.blur();
}

/** Lets the shortcuts be used, except where something is typed. */
export function useShortcuts(shortcuts: Shortcut[]): void {
  const byKey = new Map(
    shortcuts.flatMap((shortcut) => shortcut.keys.map((key) => [key, shortcut] as const)),
  );
  document.addEventListener('click', giveBackFocus);
  document.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.isComposing || event.altKey) return;
    if (document.querySelector('dialog[open]') !== null || isTaken(event)) return;
    const shortcut = byKey.get(nameOf(event));
    if (shortcut === undefined) return;
    event.preventDefault();
    const focused = document.activeElement;
    if (event.key === ' ' && focused instanceof HTMLButtonElement) focused.blur();
    shortcut.run();
  });
}
