// SPDX-License-Identifier: MIT
// From the coordinates of a file to those of the scene: metres, y up.
import * as THREE from 'three';
import type {Description} from '../core/types.ts';

const kUpright = [
  new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), Math.PI / 2),
  new THREE.Quaternion(),
  new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(1, 0, 0), -Math.PI / 2),
];

/** scene_from_file without any offset: the file's unit in metres, its up axis along y. */
export function sceneFromFile(document: Description): THREE.Matrix4 {
  const metres = document.unit.metres;
  return new THREE.Matrix4().compose(
    new THREE.Vector3(),
    kUpright[document.up.axis],
    new THREE.Vector3(metres, metres, metres),
  );
}

/** The box around all frames, in the scene. */
export function boxOf(document: Description): THREE.Box3 {
  const {extent} = document;
  if (extent === null) return new THREE.Box3();
  const corner = (values: typeof extent.min) => new THREE.Vector3(...values.map(Number));
  return new THREE.Box3(corner(extent.min), corner(extent.max)).applyMatrix4(
    sceneFromFile(document),
  );
}

/** The direction that the figure faces, in the scene; the scene's +z where that is not known. */
export function facingOf(document: Description): THREE.Vector3 {
  const {direction} = document.facing;
  if (direction === null) return new THREE.Vector3(0, 0, 1);
  return new THREE.Vector3(...direction.map(Number))
    .applyQuaternion(kUpright[document.up.axis])
    .normalize();
}
