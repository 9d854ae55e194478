// SPDX-License-Identifier: MIT
// A figure: a solid bone from each joint to its children and tips, a ball at each joint. Everything
// below `root` is in the file's coordinates.
import * as THREE from 'three';
import type {Description} from '../core/types.ts';
import type {FramePoses} from '../poses.ts';

export interface Figure {
  root: THREE.Group;
  /** Moves everything to a frame. */
  show(poses: FramePoses): void;
  setColour(colour: string): void;
  /** Marks a joint; -1: none. */
  select(joint: number): void;
  /** The joint that a ray hits first, and how far away; null: none. */
  hit(ray: THREE.Raycaster): {joint: number; distance: number} | null;
  dispose(): void;
}

/** Where a bone begins and ends: a joint, and another joint or a tip. */
export interface Bone {
  from: number;
  to: number;
  isTip: boolean;
}

/** The bones of a skeleton. */
export function bonesOf(document: Description): Bone[] {
  const bones: Bone[] = [];
  let tip = 0;
  document.joints.forEach((joint, index) => {
    if (joint.parent >= 0) bones.push({from: joint.parent, to: index, isTip: false});
    for (let k = 0; k < joint.tips.length; k++) bones.push({from: index, to: tip++, isTip: true});
  });
  return bones;
}

/** A bone along +y of length 1 and width 1: thickest near its start. */
function boneGeometry(): THREE.BufferGeometry {
  return new THREE.LatheGeometry(
    [
      new THREE.Vector2(0.0001, 0),
      new THREE.Vector2(0.34, 0.03),
      new THREE.Vector2(0.5, 0.12),
      new THREE.Vector2(0.44, 0.3),
      new THREE.Vector2(0.2, 0.96),
      new THREE.Vector2(0.0001, 1),
    ],
    12,
  );
}

const kBone = boneGeometry();
const kBall = new THREE.SphereGeometry(1, 16, 12);

/** Widths relative to the figure's height. */
const kBoneWidth = 0.036;
const kBallRadius = 0.014;

/** The figure's size in the file's unit, from which widths follow. */
function sizeOf(document: Description): number {
  const height = Number(document.height);
  if (Number.isFinite(height) && height > 0) return height;
  return 1 / document.unit.metres;
}

export function makeFigure(document: Description, colour: string): Figure {
  const bones = bonesOf(document);
  const size = sizeOf(document);
  const material = new THREE.MeshStandardMaterial({roughness: 0.55, metalness: 0.05});
  const ballMaterial = new THREE.MeshStandardMaterial({roughness: 0.4, metalness: 0.1});
  const bars = new THREE.InstancedMesh(kBone, material, Math.max(1, bones.length));
  const balls = new THREE.InstancedMesh(kBall, ballMaterial, document.joints.length);
  for (const mesh of [bars, balls]) {
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
  }
  bars.count = bones.length;
  const root = new THREE.Group();
  root.matrixAutoUpdate = false;
  root.add(bars, balls);
  let selected = -1;

  const start = new THREE.Vector3();
  const end = new THREE.Vector3();
  const along = new THREE.Vector3();
  const up = new THREE.Vector3(0, 1, 0);
  const turn = new THREE.Quaternion();
  const scale = new THREE.Vector3();
  const matrix = new THREE.Matrix4();

  const placeBars = ({positions, tips}: FramePoses) => {
    bones.forEach((bone, index) => {
      start.fromArray(positions, bone.from * 3);
      end.fromArray(bone.isTip ? tips : positions, bone.to * 3);
      along.subVectors(end, start);
      const length = along.length();
      // A bone without length, or one that is not finite, is not there.
      const width = length > 1e-9 ? Math.min(kBoneWidth * size, length * 0.35) : 0;
      if (width > 0) turn.setFromUnitVectors(up, along.divideScalar(length));
      matrix.compose(start, turn, scale.set(width, width > 0 ? length : 0, width));
      bars.setMatrixAt(index, matrix);
    });
    bars.instanceMatrix.needsUpdate = true;
  };

  const placeBalls = ({positions}: FramePoses) => {
    for (let joint = 0; joint < document.joints.length; joint++) {
      const radius = kBallRadius * size * (joint === selected ? 1.9 : 1);
      matrix.compose(
        start.fromArray(positions, joint * 3),
        turn.identity(),
        scale.set(radius, radius, radius),
      );
      balls.setMatrixAt(joint, matrix);
    }
    balls.instanceMatrix.needsUpdate = true;
  };

  const paint = (own: string) => {
    const base = new THREE.Color(own);
    material.color.copy(base);
    const ball = base.clone().offsetHSL(0, 0, -0.12);
    for (let joint = 0; joint < document.joints.length; joint++) {
      balls.setColorAt(joint, joint === selected ? new THREE.Color('#ff3b6b') : ball);
    }
    if (balls.instanceColor) balls.instanceColor.needsUpdate = true;
  };

  let shown: FramePoses | null = null;
  let own = colour;
  paint(own);
  return {
    root,
    show(poses) {
      shown = poses;
      placeBars(poses);
      placeBalls(poses);
    },
    setColour(given) {
      own = given;
      paint(own);
    },
    select(joint) {
      selected = joint;
      paint(own);
      if (shown !== null) placeBalls(shown);
    },
    hit(ray) {
      bars.computeBoundingSphere();
      balls.computeBoundingSphere();
      const found = ray.intersectObjects([balls, bars], false)[0];
      if (found?.instanceId === undefined) return null;
      const joint = found.object === balls ? found.instanceId : bones[found.instanceId].from;
      return {joint, distance: found.distance};
    },
    dispose() {
      bars.dispose();
      balls.dispose();
      material.dispose();
      ballMaterial.dispose();
    },
  };
}
