// SPDX-License-Identifier: MIT
// The figures of the open motions: made, placed, moved to the time that is shown.
import * as THREE from 'three';
import type {Description} from '../core/types.ts';
import type {FramePoses, PoseCache} from '../poses.ts';
import type {OpenMotion} from '../state.ts';
import {presenceOf, shownFrame} from '../times.ts';
import {boxOfPoses, type Figure, makeFigure} from './figure.ts';
import {boxOf, sceneFromFile} from './placement.ts';

/** A motion with its figure. */
export interface Drawn {
  motion: OpenMotion;
  figure: Figure;
  /** The frame that the figure shows; -1: none of this version of the motion. */
  frame: number;
  /** Whether it is drawn faint: its motion has not begun, or is over. */
  isFaint: boolean;
  offset: THREE.Vector3;
}

/** How much of their motion's colour shapes with their own take: of one motion, of one of several. */
const kTint = 0.15;
const kStrongTint = 0.45;

export interface Figures {
  all: Map<number, Drawn>;
  /** Those that are visible. */
  visible(): Drawn[];
  /** Makes, changes and removes figures to fit the motions. */
  update(motions: readonly OpenMotion[], offsets: readonly THREE.Vector3[], shapes: boolean): void;
  /** Moves figures to a time; true if one of them moved. Those whose poses are on their way stay. */
  show(seconds: number, given?: ReadonlyMap<number, FramePoses>): boolean;
  /** The box around all visible motions at all times, and that around what they show now. */
  wholeBox(out: THREE.Box3): THREE.Box3;
  presentBox(out: THREE.Box3): THREE.Box3;
  /** The box of each visible figure now. */
  boxes(): THREE.Box3[];
  /** The box around all visible figures in given poses, by the handles of their motions. */
  boxOf(poses: ReadonlyMap<number, FramePoses>): THREE.Box3;
  /** How far figures reach beyond their joints, in metres. */
  skin(): number;
  /** The height of the tallest visible figure, in metres. */
  size(): number;
}

/** Whether a figure of one description can show the other. */
const fits = (one: Description, other: Description): boolean =>
  one === other ||
  (one.joints.length === other.joints.length &&
    one.joints.every((joint, k) => {
      const {parent, tips, visuals} = other.joints[k];
      return (
        joint.parent === parent &&
        joint.tips.length === tips.length &&
        joint.visuals.length === 0 &&
        visuals.length === 0
      );
    }));

export function makeFigures(scene: THREE.Scene, poses: PoseCache): Figures {
  const all = new Map<number, Drawn>();
  const box = new THREE.Box3();

  const remove = ({motion, figure}: Drawn) => {
    scene.remove(figure.root);
    figure.dispose();
    all.delete(motion.handle);
  };

  const drawnOf = (motion: OpenMotion): Drawn => {
    const known = all.get(motion.handle);
    if (known !== undefined && fits(known.motion.document, motion.document)) {
      if (known.motion.version !== motion.version) known.frame = -1;
      if (known.motion.document !== motion.document) known.figure.redescribe(motion.document);
      return known;
    }
    if (known !== undefined) remove(known);
    const figure = makeFigure(motion.document);
    scene.add(figure.root);
    const made = {motion, figure, frame: -1, isFaint: false, offset: new THREE.Vector3()};
    all.set(motion.handle, made);
    return made;
  };

  const visible = () => [...all.values()].filter(({motion}) => motion.isVisible);

  return {
    all,
    visible,
    update(motions, offsets, shapes) {
      for (const own of all.values()) {
        if (motions.every((motion) => motion.handle !== own.motion.handle)) remove(own);
      }
      motions.forEach((motion, index) => {
        const own = drawnOf(motion);
        own.motion = motion;
        own.offset.copy(offsets[index]);
        const {figure} = own;
        figure.root.visible = motion.isVisible;
        figure.lift(index);
        figure.root.matrix.copy(sceneFromFile(motion.document)).setPosition(own.offset);
        figure.root.matrixWorldNeedsUpdate = true;
        figure.paint(motion.colour, motions.length > 1 ? kStrongTint : kTint);
        figure.useShapes(shapes);
      });
    },
    show(seconds, given) {
      let isMoved = false;
      for (const own of all.values()) {
        if (!own.motion.isVisible) continue;
        const isFaint = presenceOf(own.motion, seconds) !== 'now';
        if (isFaint !== own.isFaint) {
          own.isFaint = isFaint;
          own.figure.fade(isFaint);
          isMoved = true;
        }
        const frame = shownFrame(own.motion, seconds);
        if (frame === own.frame) continue;
        const pose = given?.get(own.motion.handle) ?? poses.at(own.motion, frame);
        if (pose === null) continue;
        own.figure.show(pose);
        own.frame = frame;
        isMoved = true;
      }
      return isMoved;
    },
    wholeBox(out) {
      out.makeEmpty();
      for (const {motion, offset} of visible()) {
        const own = boxOf(motion.document);
        if (!own.isEmpty()) out.union(own.translate(offset));
      }
      return out;
    },
    presentBox(out) {
      out.makeEmpty();
      for (const {figure} of visible()) {
        if (figure.shown === null || figure.box.isEmpty()) continue;
        box.copy(figure.box).expandByScalar(figure.skin());
        out.union(box.applyMatrix4(figure.root.matrix));
      }
      return out;
    },
    boxes: () =>
      visible()
        .filter(({figure}) => figure.shown !== null && !figure.box.isEmpty())
        .map(({figure}) => figure.box.clone().applyMatrix4(figure.root.matrix)),
    boxOf(given) {
      const whole = new THREE.Box3();
      for (const {motion, figure} of visible()) {
        const pose = given.get(motion.handle);
        if (pose === undefined || boxOfPoses(pose, box).isEmpty()) continue;
        whole.union(box.expandByScalar(figure.skin()).applyMatrix4(figure.root.matrix));
      }
      return whole;
    },
    skin() {
      let skin = 0;
      for (const {motion, figure} of visible()) {
        skin = Math.max(skin, figure.skin() * motion.document.unit.metres);
      }
      return skin;
    },
    size() {
      let size = 0;
      for (const {motion, figure} of visible()) {
        size = Math.max(size, figure.size * motion.document.unit.metres);
      }
      return size || 1.7;
    },
  };
}
