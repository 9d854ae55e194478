// SPDX-License-Identifier: MIT
// The scene draws the state: a figure for each motion that is visible, at the time that is shown.
import * as THREE from 'three';
import type {PoseCache} from '../poses.ts';
import {activeMotion, type OpenMotion, type Store} from '../state.ts';
import {shownFrame} from '../times.ts';
import {makeCameras} from './cameras.ts';
import {type Figure, makeFigure} from './figure.ts';
import {boxOf, facingOf, sceneFromFile} from './placement.ts';
import {makeStage} from './stage.ts';

export interface Scene {
  /** Draws soon. */
  invalidate(): void;
  /** Shows everything from the view of the state. */
  frameAll(): void;
}

interface Drawn {
  figure: Figure;
  version: number;
  colour: string;
}

export function makeScene(canvas: HTMLCanvasElement, store: Store, poses: PoseCache): Scene {
  const stage = makeStage(canvas);
  const drawn = new Map<number, Drawn>();
  let isWaiting = false;

  const invalidate = () => {
    if (isWaiting) return;
    isWaiting = true;
    requestAnimationFrame(draw);
  };
  const cameras = makeCameras(canvas, invalidate);

  const visible = () => store.state.motions.filter((motion) => motion.isVisible);

  const show = (motion: OpenMotion) => {
    const own = drawn.get(motion.handle);
    const frame = poses.at(motion, shownFrame(motion, store.state.seconds));
    if (own !== undefined && frame !== null) own.figure.show(frame);
  };

  const follow = () => {
    const motion = activeMotion(store.state);
    if (store.state.camera !== 'follow' || motion === undefined) return;
    const frame = poses.at(motion, shownFrame(motion, store.state.seconds));
    if (frame === null) return;
    const root = new THREE.Vector3().fromArray(frame.positions, 0);
    cameras.moveTo(root.applyMatrix4(drawn.get(motion.handle)!.figure.root.matrix));
  };

  function draw() {
    isWaiting = false;
    for (const motion of visible()) show(motion);
    follow();
    stage.renderer.render(stage.scene, cameras.current);
  }

  const wholeBox = (): THREE.Box3 => {
    const box = new THREE.Box3();
    for (const motion of visible()) box.union(boxOf(motion.document));
    return box.isEmpty() ? new THREE.Box3(new THREE.Vector3(), new THREE.Vector3(1, 2, 1)) : box;
  };

  const frameAll = () => {
    const box = wholeBox();
    const motion = activeMotion(store.state);
    const facing = motion ? facingOf(motion.document) : new THREE.Vector3(0, 0, 1);
    cameras.frame(box, store.state.camera, facing);
    stage.place(box, Math.min(0, box.min.y));
    invalidate();
  };

  const rebuild = (motion: OpenMotion) => {
    const own = drawn.get(motion.handle);
    if (own !== undefined && own.version === motion.version) {
      if (own.colour !== motion.colour) own.figure.setColour(motion.colour);
      own.figure.root.visible = motion.isVisible;
      return;
    }
    if (own !== undefined) remove(motion.handle, own);
    const figure = makeFigure(motion.document, motion.colour);
    figure.root.matrix.copy(sceneFromFile(motion.document));
    figure.root.visible = motion.isVisible;
    stage.scene.add(figure.root);
    drawn.set(motion.handle, {figure, version: motion.version, colour: motion.colour});
  };

  const remove = (handle: number, own: Drawn) => {
    stage.scene.remove(own.figure.root);
    own.figure.dispose();
    drawn.delete(handle);
  };

  let count = 0;
  store.on(['motions'], ({motions}) => {
    for (const [handle, own] of drawn) {
      if (motions.every((motion) => motion.handle !== handle)) remove(handle, own);
    }
    for (const motion of motions) rebuild(motion);
    if (motions.length !== count) frameAll();
    count = motions.length;
    invalidate();
  });
  store.on(['seconds', 'shown'], invalidate);
  store.on(['camera'], frameAll);
  store.on(['joint', 'active', 'motions'], ({active, joint}) => {
    for (const [handle, own] of drawn) own.figure.select(handle === active ? joint : -1);
    invalidate();
  });

  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  const setTheme = () => {
    stage.setTheme(dark.matches);
    invalidate();
  };
  dark.addEventListener('change', setTheme);
  setTheme();

  new ResizeObserver(() => {
    const {clientWidth: width, clientHeight: height} = canvas.parentElement!;
    stage.renderer.setSize(width, height);
    cameras.resize(width, height);
    invalidate();
  }).observe(canvas.parentElement!);

  return {invalidate, frameAll};
}
