// SPDX-License-Identifier: MIT
// The address of the page holds what is looked at: frame, view, motion, joint, panel. It can be
// kept and sent with the page.
import {goToFrame} from './playback.ts';
import {activeMotion, type Camera, type State, type Store} from './state.ts';
import {shownFrame} from './times.ts';

const kCameras: readonly Camera[] = ['orbit', 'follow', 'front', 'side', 'top'];
/** Browsers allow few changes of the address a second. */
const kPause = 300;

/** The address of a state, without the #; what is as it always begins is left out. */
function addressOf(state: Readonly<State>): string {
  const motion = activeMotion(state);
  const words = new URLSearchParams();
  if (motion === undefined) return '';
  const frame = shownFrame(motion, state.seconds);
  const index = state.motions.indexOf(motion);
  if (frame !== 0) words.set('frame', String(frame));
  if (state.camera !== 'orbit') words.set('camera', state.camera);
  if (index !== 0) words.set('motion', String(index + 1));
  if (state.joint >= 0) words.set('joint', motion.document.joints[state.joint]?.name ?? '');
  if (state.panel !== '') words.set('panel', state.panel);
  return words.toString();
}

/** Shows what an address says; what does not fit the open motions is left alone. */
function show(store: Store, address: string): void {
  const words = new URLSearchParams(address);
  const camera = words.get('camera') as Camera | null;
  const panel = words.get('panel');
  const motion = store.state.motions[Number(words.get('motion') ?? 1) - 1];
  if (motion !== undefined && motion.handle !== store.state.active) {
    store.set({active: motion.handle, joint: -1});
  }
  if (camera !== null && kCameras.includes(camera)) store.set({camera});
  if (panel !== null && /^\w+$/.test(panel)) store.set({panel});
  const joints = activeMotion(store.state)?.document.joints ?? [];
  const joint = joints.findIndex(({name}) => name === words.get('joint'));
  if (joint >= 0) store.set({joint});
  const frame = Number.parseInt(words.get('frame') ?? '', 10);
  if (Number.isFinite(frame)) goToFrame(store, frame);
}

/** Restores the state from the address once motions are open, and keeps the address in step. */
export function keepAddress(store: Store): void {
  let isRestored = false;
  let timer = 0;
  const write = () => {
    timer = 0;
    const address = addressOf(store.state);
    if (store.state.isPlaying || address === location.hash.slice(1)) return;
    history.replaceState(null, '', address === '' ? location.pathname : `#${address}`);
  };
  store.on(
    ['seconds', 'isPlaying', 'camera', 'active', 'motions', 'joint', 'panel'],
    ({motions, isPlaying}) => {
      if (motions.length === 0) return;
      if (!isRestored) {
        isRestored = true;
        // When everyone has heard of the motions, and before any key is pressed.
        const address = location.hash.slice(1);
        if (address !== '') queueMicrotask(() => show(store, address));
      }
      if (!isPlaying && timer === 0) timer = window.setTimeout(write, kPause);
    },
  );
  window.addEventListener('hashchange', () => show(store, location.hash.slice(1)));
}
