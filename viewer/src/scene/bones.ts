// SPDX-License-Identifier: MIT
// A skeleton as solid bones: one from each joint to its children and tips, a ball at each joint.
import * as THREE from 'three';
import type {Description} from '../core/types.ts';
import type {FramePoses} from '../poses.ts';

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
const kBone = new THREE.LatheGeometry(
  [
    [0.0001, 0],
    [0.34, 0.04],
    [0.5, 0.16],
    [0.46, 0.3],
    [0.26, 0.95],
    [0.0001, 1],
  ].map(([x, y]) => new THREE.Vector2(x, y)),
  12,
);
const kBall = new THREE.SphereGeometry(1, 12, 8);

/**
 * The width of a bone, relative to the figure's size: it grows with the root of the bone's length,
 * so that toes are not threads and long links are not logs.
 */
const kWidth = 0.085;
const kMostWidth = 0.05;
/** Never wider than this part of its length. */
const kMostShare = 0.55;
const kBallShare = 0.4;
/** The ball of a joint without bones, relative to the figure. */
const kLoneBall = 0.012;
const kSelectedGrowth = 1.55;

export interface Bones {
  bones: Bone[];
  bars: THREE.InstancedMesh;
  balls: THREE.InstancedMesh;
  /**
   * Moves bones and balls to a frame; `size` is the figure's, in the file's unit. Joints that are
   * hidden have no ball, and no bones from them.
   */
  show(
    poses: FramePoses,
    size: number,
    selected: number,
    isHidden?: (joint: number) => boolean,
  ): void;
}

/** Makes the bones of a skeleton from one material. */
export function makeBones(document: Description, material: THREE.Material): Bones {
  const bones = bonesOf(document);
  const numJoints = document.joints.length;
  const bars = new THREE.InstancedMesh(kBone, material, Math.max(1, bones.length));
  const balls = new THREE.InstancedMesh(kBall, material, Math.max(1, numJoints));
  bars.count = bones.length;
  balls.count = numJoints;

  const start = new THREE.Vector3();
  const end = new THREE.Vector3();
  const up = new THREE.Vector3(0, 1, 0);
  const turn = new THREE.Quaternion();
  const straight = new THREE.Quaternion();
  const scale = new THREE.Vector3();
  const matrix = new THREE.Matrix4();
  const nothing = new THREE.Matrix4().makeScale(0, 0, 0);
  const widths = new Float32Array(numJoints);

  const showBar = (index: number, {positions, tips}: FramePoses, size: number) => {
    const bone = bones[index];
    start.fromArray(positions, bone.from * 3);
    end.fromArray(bone.isTip ? tips : positions, bone.to * 3).sub(start);
    const length = end.length();
    // A bone without length, or one that is not finite, is not there.
    if (!(length > 1e-6 * size && length < Infinity)) {
      bars.setMatrixAt(index, nothing);
      return;
    }
    const width = Math.min(
      size * Math.min(kMostWidth, kWidth * Math.sqrt(length / size)),
      length * kMostShare,
    );
    widths[bone.from] = Math.max(widths[bone.from], width);
    if (!bone.isTip) widths[bone.to] = Math.max(widths[bone.to], width * 0.7);
    turn.setFromUnitVectors(up, end.divideScalar(length));
    bars.setMatrixAt(index, matrix.compose(start, turn, scale.set(width, length, width)));
  };

  const showBall = (joint: number, {positions}: FramePoses, size: number, growth: number) => {
    start.fromArray(positions, joint * 3);
    if (!Number.isFinite(start.x + start.y + start.z)) {
      balls.setMatrixAt(joint, nothing);
      return;
    }
    const radius = growth * (widths[joint] > 0 ? widths[joint] * kBallShare : size * kLoneBall);
    balls.setMatrixAt(joint, matrix.compose(start, straight, scale.setScalar(radius)));
  };

  return {
    bones,
    bars,
    balls,
    show(poses, size, selected, isHidden = () => false) {
      widths.fill(0);
      for (let k = 0; k < bones.length; k++) {
        if (isHidden(bones[k].from)) bars.setMatrixAt(k, nothing);
        else showBar(k, poses, size);
      }
      for (let joint = 0; joint < numJoints; joint++) {
        if (isHidden(joint)) balls.setMatrixAt(joint, nothing);
        else showBall(joint, poses, size, joint === selected ? kSelectedGrowth : 1);
      }
      bars.instanceMatrix.needsUpdate = true;
      balls.instanceMatrix.needsUpdate = true;
    },
  };
}
