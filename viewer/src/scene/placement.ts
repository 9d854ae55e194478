// SPDX-License-Identifier: MIT
// From the coordinates of a file to those of the scene: metres, y up, and where a motion stands
// beside the others.
import * as THREE from 'three';
import type {Description} from '../core/types.ts';
import type {PoseCache} from '../poses.ts';
import type {OpenMotion} from '../state.ts';

const kUpright = [
  new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), Math.PI / 2),
  new THREE.Quaternion(),
  new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(1, 0, 0), -Math.PI / 2),
];

/** The rotation from the file's axes to those of the scene. */
export const uprightOf = (document: Description): THREE.Quaternion => kUpright[document.up.axis];

/** scene_from_file without any offset: the file's unit in metres, its up axis along y. */
export function sceneFromFile(document: Description): THREE.Matrix4 {
  const metres = document.unit.metres;
  return new THREE.Matrix4().compose(
    new THREE.Vector3(),
    uprightOf(document),
    new THREE.Vector3(metres, metres, metres),
  );
}

/** The box around all frames, in the scene, without any offset. */
export function boxOf(document: Description): THREE.Box3 {
  const {extent} = document;
  if (extent === null) return new THREE.Box3();
  const corner = (values: typeof extent.min) => new THREE.Vector3(...values.map(Number));
  const box = new THREE.Box3(corner(extent.min), corner(extent.max));
  if (![...box.min.toArray(), ...box.max.toArray()].every(Number.isFinite)) return new THREE.Box3();
  return box.applyMatrix4(sceneFromFile(document));
}

/** The direction that a person chose, in the file; null: none, or it is not along the ground. */
function chosenFront({document, front}: Facing): number[] | null {
  const axis = front === null ? -1 : 'xyz'.indexOf(front[1]);
  if (front === null || axis === document.up.axis) return null;
  return [0, 1, 2].map((k) => (k === axis ? Number(`${front[0]}1`) : 0));
}

type Facing = Pick<OpenMotion, 'document' | 'front'>;

/** The direction that the figure faces, in the scene; the scene's +z where that is not known. */
export function facingOf(motion: Facing | undefined): THREE.Vector3 {
  const found = motion?.document.facing.direction ?? null;
  const direction = (motion && chosenFront(motion)) ?? found;
  if (motion === undefined || direction === null) return new THREE.Vector3(0, 0, 1);
  const upright = uprightOf(motion.document);
  const facing = new THREE.Vector3(...direction.map(Number)).applyQuaternion(upright);
  facing.y = 0;
  return facing.lengthSq() > 1e-9 ? facing.normalize() : new THREE.Vector3(0, 0, 1);
}

/** Where roots are at the first frames of motions, in the scene, without any offset. */
export interface Starts {
  /** Null: on its way, or there is none. */
  of(motion: OpenMotion): THREE.Vector3 | null;
}

/** Asks for the first frames of motions, and keeps what came. */
export function makeStarts(poses: PoseCache, onArrival: () => void): Starts {
  const kept = new Map<number, {version: number; start: THREE.Vector3 | null}>();
  return {
    of(motion) {
      const known = kept.get(motion.handle);
      if (known?.version === motion.version) return known.start;
      // Until the new one is there, that of before the change is as good.
      const entry = {version: motion.version, start: known?.start ?? null};
      kept.set(motion.handle, entry);
      poses.wait(motion, 0).then((frame) => {
        if (frame === null || kept.get(motion.handle) !== entry) return;
        const root = new THREE.Vector3().fromArray(frame.positions, 0);
        if (!Number.isFinite(root.x + root.y + root.z)) return;
        entry.start = root.applyMatrix4(sceneFromFile(motion.document));
        onArrival();
      });
      return entry.start;
    },
  };
}

/** The space between motions that stand side by side, relative to the height of the first. */
const kGap = 0.35;

/**
 * How far each motion is moved along the ground, by its placement: `aligned` starts where the first
 * one starts; `beside` starts in line with the first one, to the right of all before it.
 */
export function offsetsOf(motions: readonly OpenMotion[], starts: Starts): THREE.Vector3[] {
  const first = motions[0];
  if (first === undefined) return [];
  const isMoved = motions.some((motion) => motion.placement !== 'recorded');
  const start = isMoved ? starts.of(first) : null;
  const firstBox = boxOf(first.document);
  const gap = kGap * (firstBox.isEmpty() ? 1 : firstBox.max.y - firstBox.min.y);
  let edge = firstBox.isEmpty() ? 0 : firstBox.max.x;
  return motions.map((motion, index) => {
    const offset = new THREE.Vector3();
    if (index === 0 || motion.placement === 'recorded') return offset;
    const own = starts.of(motion);
    if (start === null || own === null) return offset;
    offset.subVectors(start, own).setY(0);
    if (motion.placement === 'aligned') return offset;
    const box = boxOf(motion.document);
    if (box.isEmpty()) return offset;
    offset.x = edge + gap - box.min.x;
    edge += gap + box.max.x - box.min.x;
    return offset;
  });
}
