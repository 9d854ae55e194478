// SPDX-License-Identifier: MIT
// A figure: the bones of a skeleton, or the shapes of a robot. Everything below `root` is in the
// file's coordinates.
import * as THREE from 'three';
import type {Description} from '../core/types.ts';
import type {FramePoses} from '../poses.ts';
import {makeBones} from './bones.ts';
import {extentsOfShapes, hasShapes, makeShapes} from './shapes.ts';
import {kSelected} from './theme.ts';

export interface Figure {
  root: THREE.Group;
  /** What it shows; null: nothing yet. */
  readonly shown: FramePoses | null;
  /** Its size in the file's unit of length: from its first pose on. */
  readonly size: number;
  /** The box around its joints and tips, in the file's coordinates. */
  readonly box: THREE.Box3;
  /** How far it reaches beyond its joints and tips, in the file's unit. */
  skin(): number;
  /** Moves everything to a frame. */
  show(poses: FramePoses): void;
  /** Takes another description of the same joints: its size may have changed. */
  redescribe(document: Description): void;
  /** Its colour, and how much of it the shapes with a colour of their own take, 0 to 1. */
  paint(colour: string, tint: number): void;
  /** Draws it faint, as one that is not there at this time. */
  fade(isFaint: boolean): void;
  /** Where figures are one in the other, that of the higher rank is seen. */
  lift(rank: number): void;
  /** Marks a joint; -1: none. */
  select(joint: number): void;
  /** Shows a robot's shapes, if it has some, or its bones. */
  useShapes(wanted: boolean): void;
  /** The joint that a ray hits first, and how far away; null: none. */
  hit(ray: THREE.Raycaster): {joint: number; distance: number} | null;
  dispose(): void;
}

/** The box around all points of a pose. */
export function boxOfPoses({positions, tips}: FramePoses, box: THREE.Box3): THREE.Box3 {
  const {min, max} = box.makeEmpty();
  for (const points of [positions, tips]) {
    for (let at = 0; at + 2 < points.length; at += 3) {
      const x = points[at];
      const y = points[at + 1];
      const z = points[at + 2];
      if (!Number.isFinite(x + y + z)) continue;
      min.set(Math.min(min.x, x), Math.min(min.y, y), Math.min(min.z, z));
      max.set(Math.max(max.x, x), Math.max(max.y, y), Math.max(max.z, z));
    }
  }
  return box;
}

/** The figure's size in the file's unit: how high it stands, where that fits its pose. */
export function sizeOf(document: Description, box: THREE.Box3): number {
  const diagonal = box.isEmpty() ? 0 : box.getSize(new THREE.Vector3()).length();
  const height = Number(document.height);
  if (!(diagonal > 0)) return height > 0 ? height : 1 / document.unit.metres;
  return height > 0 ? Math.max(0.4 * diagonal, Math.min(diagonal, height)) : 0.7 * diagonal;
}

/** How far figures reach beyond the middles of joints, relative to their size: bones, and shapes. */
const kSkin = 0.06;
const kMostSkin = 0.12;
/** The opacity of a figure before its motion begins, and after it. */
const kFaint = 0.3;
/** How much darker balls are than bones. */
const kBallShade = 0.72;
/** A link whose shapes are smaller, relative to the figure, is told by its bones, too. */
const kLeastShape = 0.02;
const kNeutral = new THREE.Color(0xb9c0c9);
/** How much of the motion's colour shapes without any colour take. */
const kNeutralTint = 0.45;

/** Makes a figure; with an opacity below 1 it is a ghost, which casts no shadow. */
export function makeFigure(document: Description, opacity = 1): Figure {
  const isGhost = opacity < 1;
  const material = new THREE.MeshStandardMaterial({
    roughness: 0.6,
    metalness: 0,
    transparent: isGhost,
    opacity,
  });
  const skeleton = makeBones(document, material);
  const shapes = hasShapes(document) ? makeShapes(document, material) : null;
  const extents = extentsOfShapes(document);
  const meshes = [skeleton.bars, skeleton.balls, ...(shapes?.meshes ?? [])];
  for (const mesh of meshes) {
    mesh.castShadow = mesh.receiveShadow = !isGhost;
    mesh.frustumCulled = false;
    mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
    if (isGhost) mesh.renderOrder = 1;
  }
  // Balls lie within the shadows of their bones.
  skeleton.balls.castShadow = false;
  const root = new THREE.Group();
  root.matrixAutoUpdate = false;
  root.add(...meshes);

  const box = new THREE.Box3();
  let shown: FramePoses | null = null;
  let described = document;
  let isResized = true;
  let size = 0;
  let selected = -1;
  let own = new THREE.Color();
  let tint = 0;
  let areShapes = shapes !== null;
  let isStale = false;

  const update = () => {
    if (shown === null) return;
    isStale = true;
    if (areShapes) {
      shapes!.show(shown);
      skeleton.show(shown, size, selected, (joint) => extents[joint] >= kLeastShape * size);
    } else {
      skeleton.show(shown, size, selected);
    }
  };

  const repaint = () => {
    const marked = new THREE.Color(kSelected);
    const ball = own.clone().multiplyScalar(kBallShade);
    const near = own.clone().lerp(marked, 0.45);
    skeleton.bones.forEach((bone, k) => {
      skeleton.bars.setColorAt(k, bone.from === selected ? near : own);
    });
    for (let joint = 0; joint < document.joints.length; joint++) {
      skeleton.balls.setColorAt(joint, joint === selected ? marked : ball);
    }
    for (const {instanceColor} of [skeleton.bars, skeleton.balls]) {
      if (instanceColor) instanceColor.needsUpdate = true;
    }
    shapes?.paint((joint, colour, out) => {
      if (colour === null) out.copy(kNeutral).lerp(own, kNeutralTint);
      else out.setRGB(...colour, THREE.SRGBColorSpace).lerp(own, tint);
      if (joint === selected) out.lerp(marked, 0.8);
    });
  };

  const showMeshes = () => {
    for (const mesh of shapes?.meshes ?? []) mesh.visible = areShapes;
  };
  showMeshes();

  return {
    root,
    box,
    get shown() {
      return shown;
    },
    get size() {
      return size;
    },
    skin: () => (areShapes ? Math.min(kMostSkin * size, shapes!.reach) : kSkin * size),
    show(poses) {
      boxOfPoses(poses, box);
      if (isResized) size = sizeOf(described, box);
      isResized = false;
      shown = poses;
      update();
    },
    redescribe(given) {
      described = given;
      isResized = true;
    },
    paint(colour, given) {
      own = new THREE.Color(colour);
      tint = given;
      repaint();
    },
    fade(isFaint) {
      material.transparent = isGhost || isFaint;
      material.opacity = isFaint ? kFaint : opacity;
      material.needsUpdate = true;
      for (const mesh of meshes) {
        if (mesh !== skeleton.balls) mesh.castShadow = !isGhost && !isFaint;
      }
    },
    lift(rank) {
      material.polygonOffset = rank > 0;
      material.polygonOffsetFactor = material.polygonOffsetUnits = -rank;
    },
    select(joint) {
      if (joint === selected) return;
      selected = joint;
      repaint();
      update();
    },
    useShapes(wanted) {
      if (areShapes === (wanted && shapes !== null)) return;
      areShapes = !areShapes;
      showMeshes();
      update();
    },
    hit(ray) {
      if (isStale) for (const mesh of meshes) mesh.computeBoundingSphere();
      isStale = false;
      const found = ray.intersectObjects(
        meshes.filter((mesh) => mesh.visible && mesh.count > 0),
        false,
      )[0];
      if (found?.instanceId === undefined) return null;
      const {object, instanceId, distance} = found;
      if (object === skeleton.balls) return {joint: instanceId, distance};
      if (object === skeleton.bars) return {joint: skeleton.bones[instanceId].from, distance};
      return {joint: shapes!.jointOf(object, instanceId), distance};
    },
    dispose() {
      for (const mesh of meshes) mesh.dispose();
      material.dispose();
    },
  };
}
