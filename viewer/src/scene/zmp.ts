// SPDX-License-Identifier: MIT
// The ZMP of a robot's motion, where its data holds one: a small target on the floor.
import * as THREE from 'three';
import {type Core, isFailure} from '../core/core.ts';
import type {OpenMotion} from '../state.ts';
import type {Standing} from './contacts.ts';

/** Relative to the figure's size. */
const kRadius = 0.026;
const kLift = 0.002;
const kMost = 16;
/** Marks are darker than contacts, over which they may lie. */
const kInk = new THREE.Color(0x101418);

export interface ZmpMarks {
  /** Whether a motion has a ZMP, as far as that is known; asks once. */
  has(motion: OpenMotion): boolean;
  /** Puts marks on a floor; none: no marks. */
  show(standing: Standing[], floor: number): void;
}

/** A ring with a point in it. */
function targetShape(): THREE.BufferGeometry {
  const place = (shape: THREE.BufferGeometry) => shape.toNonIndexed().getAttribute('position');
  const parts = [new THREE.RingGeometry(0.72, 1, 32), new THREE.CircleGeometry(0.42, 24)].map(
    place,
  );
  const all = new Float32Array(parts.reduce((sum, {array}) => sum + array.length, 0));
  let at = 0;
  for (const {array} of parts) {
    all.set(array, at);
    at += array.length;
  }
  const shape = new THREE.BufferGeometry();
  shape.setAttribute('position', new THREE.BufferAttribute(all, 3));
  return shape.rotateX(-Math.PI / 2);
}

export function makeZmpMarks(core: Core, group: THREE.Group, onArrival: () => void): ZmpMarks {
  const kept = new Map<number, {version: number; points: Float64Array}>();
  // It is under feet, which must not hide it.
  const material = new THREE.MeshBasicMaterial({
    depthWrite: false,
    depthTest: false,
    transparent: true,
  });
  const marks = new THREE.InstancedMesh(targetShape(), material, kMost);
  marks.frustumCulled = false;
  marks.renderOrder = 2;
  marks.count = 0;
  group.add(marks);
  const place = new THREE.Vector3();
  const matrix = new THREE.Matrix4();
  const colour = new THREE.Color();

  const pointsOf = (motion: OpenMotion): Float64Array => {
    const known = kept.get(motion.handle);
    if (known?.version === motion.version) return known.points;
    // Those of before the change are shown until the new ones are there.
    const entry = {version: motion.version, points: known?.points ?? new Float64Array()};
    kept.set(motion.handle, entry);
    if (motion.document.kind !== 'body_motion') return entry.points;
    core.ask('zmp', {handle: motion.handle}).then((answer) => {
      if (kept.get(motion.handle) !== entry) return;
      entry.points = isFailure(answer) ? new Float64Array() : answer.points;
      onArrival();
    });
    return entry.points;
  };

  const add = ({motion, frame, figure}: Standing, floor: number) => {
    place.fromArray(pointsOf(motion), 3 * frame).applyMatrix4(figure.root.matrix);
    if (!Number.isFinite(place.x + place.z) || marks.count >= kMost) return;
    const size = figure.size * motion.document.unit.metres;
    matrix.makeScale(kRadius * size, 1, kRadius * size);
    matrix.setPosition(place.x, floor + kLift * size, place.z);
    marks.setMatrixAt(marks.count, matrix);
    marks.setColorAt(marks.count, colour.set(motion.colour).lerp(kInk, 0.35));
    marks.count++;
  };

  return {
    has: (motion) => pointsOf(motion).length > 0,
    show(standing, floor) {
      marks.count = 0;
      for (const one of standing) {
        const isThere = one.figure.shown !== null && one.frame >= 0;
        if (isThere && 3 * one.frame + 2 < pointsOf(one.motion).length) add(one, floor);
      }
      marks.instanceMatrix.needsUpdate = true;
      if (marks.instanceColor) marks.instanceColor.needsUpdate = true;
    },
  };
}
