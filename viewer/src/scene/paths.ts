// SPDX-License-Identifier: MIT
// Paths: where a joint goes during the whole motion, as a line; what is past is thicker.
import * as THREE from 'three';
import {Line2} from 'three/addons/lines/Line2.js';
import {LineGeometry} from 'three/addons/lines/LineGeometry.js';
import {LineMaterial} from 'three/addons/lines/LineMaterial.js';
import {type Core, isFailure} from '../core/core.ts';
import type {OpenMotion} from '../state.ts';
import {numFrames} from '../times.ts';

/** No line has more points: frames are left out evenly. */
const kMostPoints = 4000;
const kMostKept = 24;
/** The width of the line in pixels: of all of it, and of what is past. */
const kThin = 1.2;
const kThick = 3;

/** A joint's path, in the file's coordinates; null: none. */
interface Path {
  points: Float32Array;
  /** Frames from one point to the next. */
  stride: number;
}

/** Every so many frames of a path; points that are not finite repeat the one before. */
export function thinned(positions: Float64Array, most = kMostPoints): Path | null {
  const count = Math.floor(positions.length / 3);
  const stride = Math.max(1, Math.ceil(count / most));
  const points = new Float32Array(3 * Math.ceil(count / stride));
  let last = -1;
  let first = -1;
  for (let k = 0; k * stride < count; k++) {
    const at = 3 * k * stride;
    const isThere = Number.isFinite(positions[at] + positions[at + 1] + positions[at + 2]);
    if (isThere) last = at;
    if (isThere && first < 0) first = k;
    if (last < 0) continue;
    for (let axis = 0; axis < 3; axis++) points[3 * k + axis] = positions[last + axis];
  }
  if (first < 0 || points.length < 6) return null;
  for (let k = 0; k < first; k++) points.copyWithin(3 * k, 3 * first, 3 * first + 3);
  return {points, stride};
}

/** Which joint of a motion has its path shown: the selected one, the one with its name, or the root. */
export function jointOfPath(motion: OpenMotion, active: OpenMotion | undefined, joint: number) {
  if (active === undefined || joint < 0) return 0;
  if (active.handle === motion.handle) return joint;
  const name = active.document.joints[joint]?.name;
  return Math.max(
    0,
    motion.document.joints.findIndex((other) => other.name === name),
  );
}

interface Drawn {
  key: string;
  joint: number;
  whole: Line2;
  past: Line2;
  stride: number;
}

export interface Paths {
  /** Shows the paths of joints of these motions, each with the matrix of its figure. */
  show(wanted: {motion: OpenMotion; joint: number; frame: number; matrix: THREE.Matrix4}[]): void;
}

export function makePaths(core: Core, group: THREE.Group, onArrival: () => void): Paths {
  const kept = new Map<string, Path | null | 'asked'>();
  const drawn = new Map<number, Drawn>();

  const pathOf = (key: string, motion: OpenMotion, joint: number): Path | null => {
    const known = kept.get(key);
    if (known !== undefined) return known === 'asked' ? null : known;
    kept.set(key, 'asked');
    if (kept.size > kMostKept) kept.delete(kept.keys().next().value!);
    core.ask('curves', {handle: motion.handle, joint}).then((answer) => {
      kept.set(key, isFailure(answer) ? null : thinned(answer.positions));
      onArrival();
    });
    return null;
  };

  const remove = (handle: number) => {
    const own = drawn.get(handle);
    if (own === undefined) return;
    for (const line of [own.whole, own.past]) {
      group.remove(line);
      line.geometry.dispose();
      line.material.dispose();
    }
    drawn.delete(handle);
  };

  const lineOf = (path: Path, colour: string, width: number): Line2 => {
    const geometry = new LineGeometry();
    geometry.setPositions(path.points);
    const material = new LineMaterial({
      color: new THREE.Color(colour).getHex(),
      linewidth: width,
      transparent: true,
      depthWrite: false,
    });
    const line = new Line2(geometry, material);
    line.matrixAutoUpdate = false;
    line.frustumCulled = false;
    // Before the ghosts, which lie over it.
    line.renderOrder = 0.5;
    group.add(line);
    return line;
  };

  return {
    show(wanted) {
      for (const handle of drawn.keys()) {
        if (wanted.every(({motion}) => motion.handle !== handle)) remove(handle);
      }
      for (const {motion, joint, frame, matrix} of wanted) {
        if (numFrames(motion.document.time) < 2) continue;
        const key = `${motion.handle} ${motion.version} ${joint}`;
        const path = pathOf(key, motion, joint);
        const own = drawn.get(motion.handle);
        const look = `${key} ${motion.colour}`;
        // While a changed path is on its way, the one before stays.
        if (path === null && own?.joint !== joint) remove(motion.handle);
        if (path === null && !drawn.has(motion.handle)) continue;
        if (path !== null && own?.key !== look) {
          remove(motion.handle);
          drawn.set(motion.handle, {
            key: look,
            joint,
            whole: lineOf(path, motion.colour, kThin),
            past: lineOf(path, motion.colour, kThick),
            stride: path.stride,
          });
        }
        const {whole, past, stride} = drawn.get(motion.handle)!;
        whole.matrix.copy(matrix);
        past.matrix.copy(matrix);
        past.geometry.instanceCount = Math.ceil(frame / stride);
      }
    },
  };
}
