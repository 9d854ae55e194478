// SPDX-License-Identifier: MIT
// Playing, stepping, speed, repeating; the readouts of frame and time.
import {byId, el} from '../elements.ts';
import {presenceText} from '../motionname.ts';
import {goToFrame, kSpeeds, setSpeed, step} from '../playback.ts';
import {activeMotion, type OpenMotion, type Store} from '../state.ts';
import {canWarp, numFrames, ownSeconds, shownFrame} from '../times.ts';
import {t, type Word} from '../words.ts';
import {iconButton, setIcon, titled} from './icons.ts';
import type {Marks} from './marks.ts';
import {numberText} from './warpwords.ts';

/** Marks the field for a frame's number, which a key puts the cursor into. */
export const focusFrame = (): void => {
  const field = byId<HTMLInputElement>('frame');
  field.focus();
  field.select();
};

/** The frame before the warp, and the number in the file, where they differ from the frame. */
function otherNumbers(motion: OpenMotion, frame: number, seconds: number): string {
  const {time, source_frames} = motion.document;
  const own = frame + time.first_frame_number;
  return [
    own === frame ? '' : t('own_frame', own),
    frame < source_frames.length ? t('source_frame', numberText(source_frames[frame])) : '',
    presenceText(motion, seconds),
  ]
    .filter((text) => text !== '')
    .join(' · ');
}

/** The time of the motion; one that does not go on says what it is. */
function readoutText(motion: OpenMotion, seconds: number): string {
  const {time} = motion.document;
  if (time.is_still) return t('rest_pose');
  if (numFrames(time) === 1) return t('one_frame');
  return `${ownSeconds(motion, seconds).toFixed(3)} s`;
}

/** The field that shows the frame and takes another. */
function makeFrameField(store: Store): HTMLElement {
  const field = el('input', {
    id: 'frame',
    type: 'text',
    inputMode: 'numeric',
    autocomplete: 'off',
    class: 'frame',
  });
  const last = el('span', {class: 'last'});
  const shown = (): string => {
    const motion = activeMotion(store.state);
    return motion === undefined ? '' : String(shownFrame(motion, store.state.seconds));
  };
  field.addEventListener('change', () => {
    const wanted = Number.parseInt(field.value, 10);
    if (Number.isFinite(wanted)) goToFrame(store, wanted);
    field.value = shown();
  });
  field.addEventListener('keydown', (event) => {
    if (event.key === 'Escape') field.value = shown();
    if (event.key === 'Escape' || event.key === 'Enter') field.blur();
  });
  store.on(['seconds', 'active', 'motions'], (state) => {
    const motion = activeMotion(state);
    if (document.activeElement !== field) field.value = shown();
    last.textContent =
      motion === undefined ? '' : t('of_frames', numFrames(motion.document.time) - 1);
  });
  const label = el('span');
  store.on(['language'], () => {
    label.textContent = t('frame');
    titled(field, t('frame_field'));
  });
  return el('label', {class: 'frame-field'}, [label, field, last]);
}

function makeSpeedField(store: Store): HTMLElement {
  const field = el('select', {
    id: 'speed',
    on: {change: () => setSpeed(store, Number(field.value))},
  });
  store.on(['speed'], ({speed}) => {
    const speeds = kSpeeds.includes(speed) ? kSpeeds : [...kSpeeds, speed].sort((a, b) => a - b);
    field.replaceChildren(...speeds.map((one) => el('option', {value: String(one)}, [`${one}×`])));
    field.value = String(speed);
  });
  store.on(['language'], () => titled(field, t('speed')));
  return field;
}

/** Makes the row of buttons and readouts; `openWarp` opens the editor of the time warp. */
export function makeTransport(store: Store, marks: Marks, openWarp: () => void): void {
  const play = iconButton('play', () => store.set({isPlaying: !store.state.isPlaying}), {
    class: 'primary play',
  });
  const repeat = iconButton('repeat', () => store.set({repeats: !store.state.repeats}));
  const previousMark = iconButton('previousMark', () => marks.go(-1), {class: 'mark-step'});
  const nextMark = iconButton('nextMark', () => marks.go(1), {class: 'mark-step'});
  const warpLabel = el('span');
  const warp = iconButton('warp', openWarp, {class: 'warp-button'});
  warp.append(warpLabel);
  const readout = el('output', {class: 'readout'});
  const others = el('output', {class: 'readout others'});
  const buttons: [HTMLElement, Word][] = [
    [iconButton('first', () => goToFrame(store, 0)), 'first_frame'],
    [iconButton('back', () => step(store, -1)), 'step_back'],
    [play, 'play'],
    [iconButton('forward', () => step(store, 1)), 'step_forward'],
    [iconButton('last', () => goToFrame(store, Infinity)), 'last_frame'],
    [repeat, 'repeat'],
    [previousMark, 'previous_mark'],
    [nextMark, 'next_mark'],
  ];
  const [first, back, , forward, last] = buttons.map(([made]) => made);
  byId('time').append(
    el('div', {class: 'transport'}, [
      el('div', {class: 'group'}, [first, back, play, forward, last, repeat]),
      el('div', {class: 'group'}, [makeFrameField(store), readout, others, previousMark, nextMark]),
      el('div', {class: 'group end'}, [makeSpeedField(store), warp]),
    ]),
  );

  store.on(['isPlaying', 'language'], ({isPlaying}) => {
    for (const [made, word] of buttons) titled(made, t(word));
    warpLabel.textContent = t('warp');
    setIcon(play, isPlaying ? 'pause' : 'play');
    titled(play, t(isPlaying ? 'pause' : 'play'));
  });
  store.on(['repeats'], ({repeats}) => repeat.setAttribute('aria-pressed', String(repeats)));
  store.on(['isWarping'], ({isWarping}) => warp.setAttribute('aria-pressed', String(isWarping)));
  store.on(['seconds', 'active', 'motions', 'language'], (state) => {
    const motion = activeMotion(state);
    byId('time').hidden = motion === undefined;
    if (motion === undefined) return;
    const {document} = motion;
    warp.disabled = !canWarp(document);
    titled(warp, t(document.has_frames ? 'warp_hint' : 'warp_no_frames'));
    const frame = shownFrame(motion, state.seconds);
    readout.textContent = readoutText(motion, state.seconds);
    others.textContent = otherNumbers(motion, frame, state.seconds);
  });
  marks.onChange(() => {
    previousMark.hidden = nextMark.hidden = marks.all.length === 0;
  });
}
