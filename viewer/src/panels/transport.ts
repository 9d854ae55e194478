// SPDX-License-Identifier: MIT
// Playing, stepping, scrubbing, the readouts of frame and time.
import {button, byId, el} from '../elements.ts';
import {goToFrame, setSpeed, step} from '../playback.ts';
import {activeMotion, type Store} from '../state.ts';
import {numFrames, shownFrame} from '../times.ts';
import {t} from '../words.ts';

export function makeTransport(store: Store): void {
  const bar = el('div', {class: 'transport'});
  byId('time').append(bar);
  const readout = el('output', {class: 'readout'});
  const scrub = el('input', {
    type: 'range',
    min: '0',
    class: 'scrub',
    on: {input: () => goToFrame(store, Number(scrub.value))},
  });

  store.on(['isPlaying', 'speed', 'language'], ({isPlaying, speed}) => {
    bar.replaceChildren(
      button('⏮', () => goToFrame(store, 0), {title: t('first_frame')}),
      button('◂', () => step(store, -1), {title: t('step_back')}),
      button(isPlaying ? '⏸' : '▶', () => store.set({isPlaying: !isPlaying}), {
        title: t(isPlaying ? 'pause' : 'play'),
        class: 'primary',
      }),
      button('▸', () => step(store, 1), {title: t('step_forward')}),
      button('⏭', () => goToFrame(store, Infinity), {title: t('last_frame')}),
      button(`${speed}×`, () => setSpeed(store, 1), {title: t('speed')}),
      scrub,
      readout,
    );
  });
  store.on(['seconds', 'active', 'motions', 'language'], (state) => {
    const motion = activeMotion(state);
    if (motion === undefined) return readout.replaceChildren();
    const frame = shownFrame(motion, state.seconds);
    scrub.max = String(numFrames(motion.document.time) - 1);
    scrub.value = String(frame);
    scrub.setAttribute('aria-label', t('frame'));
    readout.textContent = `${t('frame')} ${frame}  ${(state.seconds - motion.offset).toFixed(3)} s`;
  });
}
