// SPDX-License-Identifier: MIT
// What lies over the picture: lists and buttons, behind which nobody sees a figure.
import * as THREE from 'three';
import {byId} from '../elements.ts';
import {type AnyCamera, type Cover, kNoCover} from './cameras.ts';

const kOverlays = ['lists', 'views'];
/** So much of the height and the width is left to the figures, whatever lies over it. */
const kLeastFree = 0.4;
/** What leaves less is compared as if it left this. */
const kAlmostNone = 0.01;

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

/** A cover whose sides are so small that so much is left between them. */
function leaving(free: number, {top, bottom, left, right}: Cover): Cover {
  const share = (both: number) => Math.min(1, (1 - free) / Math.max(1e-6, both));
  const [high, wide] = [share(top + bottom), share(left + right)];
  return {top: top * high, bottom: bottom * high, left: left * wide, right: right * wide};
}

/**
 * How much is covered where a box is seen. What lies over it is passed on the side on which the box
 * stays largest: a row of buttons below it, a long list beside it.
 * \param sizeOf  how large a picture must be, in lengths of the scene, with so much of it covered
 */
export function coverOf(
  box: THREE.Box3,
  camera: AnyCamera,
  sizeOf: (cover: Cover) => number,
): Cover {
  let cover: Cover = kNoCover;
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
    const sides: Cover = {top: bottom, bottom: 1 - top, left: right, right: 1 - left};
    const ways = (Object.keys(sides) as (keyof Cover)[]).map((side) =>
      leaving(kAlmostNone, {...cover, [side]: Math.max(cover[side], sides[side])}),
    );
    cover = ways.reduce((best, next) => (sizeOf(next) < sizeOf(best) ? next : best));
  }
  return leaving(kLeastFree, cover);
}
