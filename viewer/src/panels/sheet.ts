// SPDX-License-Identifier: MIT
// On a phone the side panel is a sheet: its bar opens it, and is dragged to make it taller.
import {byId} from '../elements.ts';
import type {Store} from '../state.ts';
import {t} from '../words.ts';
import {titled} from './icons.ts';

/** Heights, as parts of the window: as the style has it, and the tallest. */
const kLow = 0.38;
const kTall = 0.7;
const kLeast = 0.15;
/** A press that moves less, in pixels, is no drag. */
const kStill = 6;

/** Lets the sheet be made taller and lower. */
export function makeSheet(store: Store): void {
  const side = byId('side');
  const bar = byId('side-toggle');
  const taller = byId<HTMLButtonElement>('side-taller');
  let height = kLow;

  const setHeight = (wanted: number) => {
    height = Math.min(kTall, wanted);
    side.style.setProperty('--sheet', `${100 * height}dvh`);
    show();
  };
  const show = () => {
    const isTall = height > (kLow + kTall) / 2;
    taller.hidden = side.hidden;
    taller.setAttribute('aria-pressed', String(isTall));
    taller.classList.toggle('tall', isTall);
    titled(taller, t('sheet_taller'));
    document.body.classList.toggle('has-tall-sheet', isTall && !side.hidden);
  };
  taller.addEventListener('click', () => setHeight(height < kTall ? kTall : kLow));

  let from: {y: number; height: number} | null = null;
  let isDragged = false;
  bar.addEventListener('pointerdown', (event) => {
    from = {y: event.clientY, height: side.hidden ? 0 : height};
    isDragged = false;
    bar.setPointerCapture(event.pointerId);
  });
  bar.addEventListener('pointermove', (event) => {
    if (from === null) return;
    const up = from.y - event.clientY;
    if (!isDragged && Math.abs(up) < kStill) return;
    isDragged = true;
    const wanted = from.height + up / window.innerHeight;
    const isSideOpen = wanted >= kLeast;
    if (isSideOpen !== store.state.isSideOpen) store.set({isSideOpen});
    setHeight(isSideOpen ? wanted : kLow);
  });
  const end = () => {
    from = null;
  };
  bar.addEventListener('pointerup', end);
  bar.addEventListener('pointercancel', end);
  // The click that ends a drag opens and closes nothing.
  bar.addEventListener(
    'click',
    (event) => {
      if (isDragged) event.stopImmediatePropagation();
      isDragged = false;
    },
    {capture: true},
  );
  store.on(['isSideOpen', 'isBare', 'motions', 'files', 'language'], show);
}
