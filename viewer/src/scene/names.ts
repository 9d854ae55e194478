// SPDX-License-Identifier: MIT
// Names: the joint under the pointer says its name; a click selects it.
import type * as THREE from 'three';
import {byId} from '../elements.ts';
import {fullName} from '../motionname.ts';
import type {Store} from '../state.ts';
import type {Cameras} from './cameras.ts';
import type {Figures} from './figures.ts';
import {type Pick, pickJoint, watchPointer} from './pointer.ts';

/** The distance of the name from the pointer, in pixels. */
const kAside = 14;

/** Shows names near the pointer, and lets it select joints. */
export function makeNames(
  canvas: HTMLCanvasElement,
  store: Store,
  figures: Figures,
  cameras: Cameras,
): void {
  const label = byId('hover');

  const textOf = ({handle, joint}: Pick): string => {
    const {motion} = figures.all.get(handle)!;
    const {name} = motion.document.joints[joint];
    return store.state.motions.length > 1 ? `${name} · ${fullName(motion)}` : name;
  };

  const show = (pick: Pick | null, place: THREE.Vector2) => {
    canvas.classList.toggle('over-joint', pick !== null);
    label.textContent = pick !== null && store.state.shown.names ? textOf(pick) : '';
    if (label.textContent === '') return;
    // Beside the pointer, on the side where there is room.
    const {clientWidth, clientHeight} = canvas;
    const isRight = place.x + kAside + label.offsetWidth <= clientWidth;
    const isBelow = place.y + kAside + label.offsetHeight <= clientHeight;
    const x = isRight ? place.x + kAside : place.x - kAside - label.offsetWidth;
    const y = isBelow ? place.y + kAside : place.y - kAside - label.offsetHeight;
    label.style.left = `${Math.max(0, x)}px`;
    label.style.top = `${Math.max(0, y)}px`;
  };

  // What is under a resting pointer, or a finger that is gone, changes with the time and the view.
  store.on(['seconds', 'camera', 'motions'], () => {
    label.textContent = '';
  });
  watchPointer(
    canvas,
    (place, reach) => {
      const shown = [...figures.all].map(([handle, {figure}]): [number, typeof figure] => [
        handle,
        figure,
      ]);
      const size = {width: canvas.clientWidth, height: canvas.clientHeight};
      return pickJoint(shown, cameras.current, place, size, reach);
    },
    show,
    (pick) => {
      if (pick === null) store.set({joint: -1});
      else store.set({active: pick.handle, joint: pick.joint});
    },
  );
}
