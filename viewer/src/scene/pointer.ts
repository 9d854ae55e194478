// SPDX-License-Identifier: MIT
// The pointer over the scene: which joint is under it, and which is chosen.
import * as THREE from 'three';
import type {AnyCamera} from './cameras.ts';
import type {Figure} from './figure.ts';

/** A joint of a motion. */
export interface Pick {
  handle: number;
  joint: number;
}

/** How far from a joint a pointer may be, in pixels: a mouse, and a finger. */
const kMouseReach = 14;
const kFingerReach = 28;
/** A press that moves further is a drag. */
const kMostTravel = 6;

/** Finds the joint at a place of the canvas: what is hit, or else the nearest joint. */
export function pickJoint(
  figures: Iterable<[number, Figure]>,
  camera: AnyCamera,
  place: THREE.Vector2,
  canvas: {width: number; height: number},
  reach: number,
): Pick | null {
  const shown = [...figures].filter(([, figure]) => figure.root.visible && figure.shown !== null);
  const ray = new THREE.Raycaster();
  const {width, height} = canvas;
  ray.setFromCamera(
    new THREE.Vector2((place.x / width) * 2 - 1, 1 - (place.y / height) * 2),
    camera,
  );
  let best: Pick | null = null;
  let least = Infinity;
  for (const [handle, figure] of shown) {
    const hit = figure.hit(ray);
    if (hit === null || hit.distance >= least) continue;
    least = hit.distance;
    best = {handle, joint: hit.joint};
  }
  if (best !== null) return best;
  least = reach;
  const point = new THREE.Vector3();
  for (const [handle, figure] of shown) {
    const {positions} = figure.shown!;
    for (let joint = 0; joint * 3 < positions.length; joint++) {
      point
        .fromArray(positions, joint * 3)
        .applyMatrix4(figure.root.matrix)
        .project(camera);
      if (Math.abs(point.z) > 1) continue;
      const x = ((point.x + 1) / 2) * width - place.x;
      const y = ((1 - point.y) / 2) * height - place.y;
      const away = Math.hypot(x, y);
      if (away < least) {
        least = away;
        best = {handle, joint};
      }
    }
  }
  return best;
}

/** Watches the pointer over the canvas. */
export function watchPointer(
  canvas: HTMLCanvasElement,
  pick: (place: THREE.Vector2, reach: number) => Pick | null,
  show: (pick: Pick | null, place: THREE.Vector2) => void,
  choose: (pick: Pick | null) => void,
): void {
  const place = new THREE.Vector2();
  const pressed = new THREE.Vector2();
  let isPressed = false;
  let isWaiting = false;
  let fingers = 0;
  const placeOf = (event: PointerEvent) => {
    const box = canvas.getBoundingClientRect();
    return place.set(event.clientX - box.left, event.clientY - box.top);
  };

  canvas.addEventListener('pointermove', (event) => {
    placeOf(event);
    if (event.pointerType === 'touch' || event.buttons !== 0 || isWaiting) return;
    isWaiting = true;
    requestAnimationFrame(() => {
      isWaiting = false;
      show(pick(place, kMouseReach), place);
    });
  });
  canvas.addEventListener('pointerleave', (event) => {
    if (event.pointerType !== 'touch') show(null, place);
  });
  canvas.addEventListener('pointerdown', (event) => {
    fingers++;
    isPressed = event.button === 0 && fingers === 1;
    pressed.copy(placeOf(event));
    show(null, place);
  });
  const release = () => {
    fingers = Math.max(0, fingers - 1);
  };
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('pointerup', (event) => {
    release();
    const isClick = isPressed && placeOf(event).distanceTo(pressed) <= kMostTravel;
    isPressed = false;
    if (!isClick) return;
    const found = pick(place, event.pointerType === 'touch' ? kFingerReach : kMouseReach);
    choose(found);
    show(found, place);
  });
}
