// SPDX-License-Identifier: MIT
// What lies over the picture: lists and buttons, behind which nobody sees a figure.
import * as THREE from 'three';
import {byId} from '../elements.ts';
import type {AnyCamera, Cover} from './cameras.ts';

const kOverlays = ['lists', 'views'];
/** So much of the height is left to the figures, whatever lies over it. */
const kLeastFree = 0.4;

/** Where a box is seen, in parts of the picture from its top left. */
function seenPlace(box: THREE.Box3, camera: AnyCamera): THREE.Box2 {
  camera.updateMatrixWorld();
  const place = new THREE.Box2();
  const corner = new THREE.Vector3();
  for (let k = 0; k < 8; k++) {
    corner.set(
      k & 1 ? box.max.x : box.min.x,
      k & 2 ? box.max.y : box.min.y,
      k & 4 ? box.max.z : box.min.z,
    );
    corner.project(camera);
    place.expandByPoint(new THREE.Vector2((1 + corner.x) / 2, (1 - corner.y) / 2));
  }
  return place;
}

/** How much of the height, from the top and from the bottom, is covered where a box is seen. */
export function coverOf(box: THREE.Box3, camera: AnyCamera): Cover {
  const cover = {top: 0, bottom: 0};
  if (box.isEmpty()) return cover;
  const seen = seenPlace(box, camera);
  const stage = byId('stage').getBoundingClientRect();
  for (const id of kOverlays) {
    const own = byId(id).getBoundingClientRect();
    const left = (own.left - stage.left) / stage.width;
    const right = (own.right - stage.left) / stage.width;
    const top = (own.top - stage.top) / stage.height;
    const bottom = (own.bottom - stage.top) / stage.height;
    const isApart =
      right < seen.min.x || left > seen.max.x || bottom < seen.min.y || top > seen.max.y;
    if (isApart || own.height === 0) continue;
    if (top + bottom < 1) cover.top = Math.max(cover.top, bottom);
    else cover.bottom = Math.max(cover.bottom, 1 - top);
  }
  const share = Math.min(1, (1 - kLeastFree) / Math.max(1e-6, cover.top + cover.bottom));
  return {top: cover.top * share, bottom: cover.bottom * share};
}
