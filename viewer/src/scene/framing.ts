// SPDX-License-Identifier: MIT
// What the view frames, where the floor is, and how the camera follows.
import * as THREE from 'three';

/** A motion that goes further than so many heights of its figure is not shown as a whole. */
const kLongWalk = 2.5;
/** How much of a long path is in view on each side of the figure, in heights. */
const kPathInView = 0.8;
/**
 * The box that the view frames: all of the motions, or of long ones the figures with some path.
 * \param skin  how far figures reach beyond the box of all, which is that of their joints
 */
export function framedBox(
  whole: THREE.Box3,
  present: THREE.Box3,
  size: number,
  skin: number,
): THREE.Box3 {
  const box = whole.clone().expandByScalar(skin);
  const room = whole.getSize(new THREE.Vector3());
  if (!present.isEmpty()) {
    const isLong = Math.max(room.x, room.y, room.z) > kLongWalk * size;
    if (isLong) box.intersect(present.clone().expandByScalar(kPathInView * size));
    box.union(present);
  }
  if (box.isEmpty()) box.set(new THREE.Vector3(-0.6, 0, -0.6), new THREE.Vector3(0.6, 1.7, 0.6));
  return box;
}

/** Feet may sink in so far, relative to the figure's size, before the floor goes down with them. */
const kSinking = 0.12;

/** The height of the floor: that of the origin, unless all figures are well above or reach below. */
export function floorHeight(whole: THREE.Box3, size: number): number {
  if (whole.isEmpty()) return 0;
  const lowest = whole.min.y;
  return lowest < -kSinking * size || lowest > size ? lowest : 0;
}

/** The camera catches up with the figure in about so many seconds. */
const kCatchUp = 0.18;
/** The figure may rise and sink so far, relative to its size, before the camera does. */
const kVerticalPlay = 0.4;

/**
 * Moves a target after a root: along the ground smoothly, or at once where time did not just run on;
 * upwards only as far as needed, so that steps and jumps do not shake the view.
 * \return whether it has still some way to go
 */
export function follow(
  target: THREE.Vector3,
  root: THREE.Vector3,
  size: number,
  elapsed: number | null,
): boolean {
  const part = elapsed === null ? 1 : 1 - Math.exp(-elapsed / kCatchUp);
  const isFar = Math.hypot(root.x - target.x, root.z - target.z) > 3 * size;
  const share = isFar ? 1 : part;
  target.x += (root.x - target.x) * share;
  target.z += (root.z - target.z) * share;
  const play = kVerticalPlay * size;
  target.y = Math.max(root.y - play, Math.min(root.y + play, target.y));
  return Math.hypot(root.x - target.x, root.z - target.z) > 1e-3 * size;
}
