// SPDX-License-Identifier: MIT
// The scene draws the state: a figure for each motion that is visible, at the time that is shown,
// and what is shown beside the figures. It draws only when something has changed.
import * as THREE from 'three';
import type {Core} from '../core/core.ts';
import {byId} from '../elements.ts';
import type {FramePoses, PoseCache} from '../poses.ts';
import {activeMotion, type Front, type OpenMotion, type Store} from '../state.ts';
import {makeAxes} from './axes.ts';
import {type Cameras, type Cover, isStraight, makeCameras, type View} from './cameras.ts';
import {makeContacts} from './contacts.ts';
import {coverOf} from './cover.ts';
import {type Figures, makeFigures} from './figures.ts';
import {cellSize} from './floor.ts';
import {floorHeight, follow, framedBox} from './framing.ts';
import {makeGhosts} from './ghosts.ts';
import {watchKeys} from './keys.ts';
import {makeNames} from './names.ts';
import {makeOffers, type Offers} from './offers.ts';
import {jointOfPath, makePaths} from './paths.ts';
import {facingOf, makeStarts, offsetsOf} from './placement.ts';
import {makeScale} from './scale.ts';
import {makeStage, type Stage} from './stage.ts';
import {makeZmpMarks} from './zmp.ts';

export interface Scene {
  stage: Stage;
  cameras: Cameras;
  figures: Figures;
  /** Draws soon. */
  invalidate(): void;
  /** Shows everything from the view of the state. */
  frameAll(): void;
  offers: Offers;
  /** Moves everything to a time, as far as its poses are there. */
  update(seconds: number, given?: ReadonlyMap<number, FramePoses>): boolean;
  /** Frames now what was to be framed with the next drawing. */
  settle(): void;
  /**
   * Fits floor and light to a view whose picture has so many pixels of height.
   * \return the width of a cell of the grid, in metres
   */
  prepare(view: View, pixels: number): number;
  /** The box that the view shows by itself. */
  framed(): THREE.Box3;
  /** The box around all visible figures at some moments: poses by the handles of motions. */
  boxOfMoments(moments: ReadonlyMap<number, FramePoses>[]): THREE.Box3;
  /** Draws now, as the page shows it. */
  drawNow(): void;
}

/** The floor goes on for so many half heights of the picture. */
const kFloorReach = 14;
/** The room around a figure that is followed, relative to its size. */
const kRoom = 0.25;

/** Those of the motions that have a figure. */
const withFigures = (motions: readonly OpenMotion[]): OpenMotion[] =>
  motions.filter(({document}) => document.lacks === '');

/** Makes the scene; throws where the browser has no WebGL. */
export function makeScene(
  canvas: HTMLCanvasElement,
  store: Store,
  core: Core,
  poses: PoseCache,
): Scene {
  const stage = makeStage(canvas);
  const figures = makeFigures(stage.scene, poses);
  let isWaiting = false;
  let isDirty = true;
  let isDrawing = false;
  let mustFrame: 'no' | 'new' | 'again' | 'anew' = 'anew';
  let lastDraw = 0;

  const request = () => {
    if (isWaiting) return;
    isWaiting = true;
    requestAnimationFrame(draw);
  };
  const invalidate = () => {
    if (isDrawing) return;
    isDirty = true;
    request();
  };
  const layer = () => {
    const group = new THREE.Group();
    stage.scene.add(group);
    return group;
  };
  const cameras = makeCameras(canvas, invalidate);
  const ghosts = makeGhosts(layer());
  const paths = makePaths(core, layer(), invalidate);
  const offerAgain = () => {
    offers.update(withFigures(store.state.motions), figures);
    invalidate();
  };
  const contacts = makeContacts(core, layer(), offerAgain);
  const zmp = makeZmpMarks(core, layer(), offerAgain);
  const offers = makeOffers(contacts, zmp);
  const starts = makeStarts(poses, () => {
    place();
    if (!cameras.isMoved) frameAll();
  });
  const scale = makeScale(canvas.parentElement!);
  const axes = makeAxes(layer());
  makeNames(canvas, store, figures, cameras);
  watchKeys(canvas, cameras);

  const whole = new THREE.Box3();
  const present = new THREE.Box3();
  const root = new THREE.Vector3();
  const active = () => figures.all.get(store.state.active);

  const update = (seconds: number, given?: ReadonlyMap<number, FramePoses>): boolean => {
    const isMoved = figures.show(seconds, given);
    if (!isMoved && !isDirty) return false;
    const {shown, joint} = store.state;
    const own = active();
    const drawn = figures.visible().filter(({figure}) => figure.shown !== null);
    const hasGhosts = shown.ghosts && own?.motion.isVisible && own.frame >= 0;
    ghosts.show(hasGhosts ? own : null, poses);
    const motion = activeMotion(store.state);
    paths.show(
      shown.paths
        ? drawn.map((one) => ({
            motion: one.motion,
            frame: Math.max(0, one.frame),
            matrix: one.figure.root.matrix,
            joint: jointOfPath(one.motion, motion, joint),
          }))
        : [],
    );
    const floor = floorHeight(whole, figures.size());
    contacts.show(shown.contacts ? drawn : [], floor);
    zmp.show(shown.zmp ? drawn : [], floor);
    axes.show(shown.axes ? activeMotion(store.state) : undefined, own, joint, figures.size());
    return true;
  };

  const prepare = ({camera, target, halfHeight}: View, pixels: number): number => {
    const size = figures.size();
    const reach = kFloorReach * halfHeight;
    const cell = cellSize(size, pixels / (2 * halfHeight));
    stage.floor.lay(target, floorHeight(whole, size), reach, cell);
    const {camera: view} = store.state;
    const isUpright = view === 'front' || view === 'side';
    const depth = whole.isEmpty() ? 1 : whole.getSize(root).length() + size;
    root.set(0, 0, -depth).applyQuaternion(camera.quaternion).add(target);
    stage.floor.stand(isUpright ? camera : null, root);
    stage.lightFrom(camera);
    stage.lightBox(figures.presentBox(present));
    return cell;
  };

  const reach = (): number => {
    const far = whole.isEmpty()
      ? 1
      : whole.getSize(root).length() + whole.distanceToPoint(cameras.target);
    return Math.max(far + figures.size(), kFloorReach * cameras.halfHeight());
  };

  const followActive = (now: number): boolean => {
    const own = active();
    if (store.state.camera !== 'follow' || own?.figure.shown == null) return false;
    root.fromArray(own.figure.shown.positions, 0).applyMatrix4(own.figure.root.matrix);
    if (!Number.isFinite(root.x + root.y + root.z)) return false;
    const elapsed = store.state.isPlaying ? (now - lastDraw) / 1000 : null;
    const target = cameras.target.clone();
    const isOnTheWay = follow(target, root, figures.size(), elapsed);
    if (target.distanceToSquared(cameras.target) > 0) cameras.moveTo(target);
    return isOnTheWay;
  };

  const framed = () => {
    figures.presentBox(present);
    const size = figures.size();
    // Who follows wants the figure, not its way.
    const isNear = store.state.camera === 'follow' && !present.isEmpty();
    return isNear
      ? present.clone().expandByScalar(kRoom * size)
      : framedBox(whole, present, size, figures.skin());
  };
  /** Whether nothing is seen where a person has chosen nothing: long walks leave the picture. */
  const isOutOfView = () => {
    const boxes = figures.boxes();
    return !cameras.isMoved && boxes.length > 0 && !boxes.some(cameras.sees);
  };
  const frameNow = () => {
    const isAnew = mustFrame === 'anew';
    // A view that a person has chosen stays where a new motion is in it.
    const isKept = mustFrame === 'new' && cameras.isMoved && figures.boxes().every(cameras.sees);
    mustFrame = 'no';
    if (isKept) return;
    const motion = activeMotion(store.state);
    if (isAnew) cameras.setView(store.state.camera, facingOf(motion), true);
    if (isAnew) stage.turnSun(facingOf(motion));
    const box = framed();
    cameras.frame(box);
    const sizeOf = (given: Cover) => cameras.halfHeightFor(box, given);
    const cover = coverOf(figures.presentBox(present), cameras.current, sizeOf);
    if (Object.values(cover).some((part) => part > 0)) cameras.frame(box, cover);
  };

  function drawNow() {
    cameras.setRange(reach());
    const height = stage.renderer.domElement.clientHeight;
    const {current: camera, target} = cameras;
    const cell = prepare({camera, target, halfHeight: cameras.halfHeight()}, height);
    scale.show(cell, activeMotion(store.state));
    stage.renderer.render(stage.scene, cameras.current);
  }

  function draw(now: number) {
    isWaiting = false;
    isDrawing = true;
    const isChanged = update(store.state.seconds);
    const waits = figures.visible().some(({figure}) => figure.shown === null);
    if (isOutOfView() && mustFrame === 'no') mustFrame = 'again';
    if (mustFrame !== 'no' && !waits) frameNow();
    const isOnTheWay = followActive(now);
    if (isChanged || isDirty || isOnTheWay) drawNow();
    lastDraw = now;
    isDirty = isDrawing = false;
    if (isOnTheWay) invalidate();
    offers.update(withFigures(store.state.motions), figures);
  }

  const place = () => {
    const {shown} = store.state;
    const motions = withFigures(store.state.motions);
    figures.update(motions, offsetsOf(motions, starts), shown.shapes);
    ghosts.useShapes(shown.shapes);
    figures.wholeBox(whole);
    invalidate();
  };
  const frameAll = () => {
    if (mustFrame !== 'anew') mustFrame = 'again';
    invalidate();
  };

  let known = '';
  let front: {handle: number; of: Front | null} = {handle: 0, of: null};
  store.on(['motions', 'shown', 'active'], ({motions, active}) => {
    place();
    // Where a motion is new, or stands elsewhere or otherwise than before, all is framed again.
    const now = withFigures(motions).map(({handle, placement, document}) =>
      [handle, placement, document.up.axis, document.unit.metres].join(),
    );
    const isKnown = now.every((text) => known.includes(`${text};`));
    if (!isKnown && mustFrame === 'no') mustFrame = 'new';
    if (known === '' || (now.length === 1 && !isKnown)) mustFrame = 'anew';
    const own = motions.find(({handle}) => handle === active);
    const isTurned = front.handle === active && front.of !== own?.front;
    if (isTurned) mustFrame = 'anew';
    front = {handle: active, of: own?.front ?? null};
    known = now.map((text) => `${text};`).join('');
    offers.update(withFigures(store.state.motions), figures);
  });
  store.on(['seconds'], request);
  store.on(['camera'], ({camera}) => {
    if (mustFrame !== 'anew') {
      const wasMoved = cameras.isMoved;
      cameras.setView(camera, facingOf(activeMotion(store.state)));
      // What a person has framed stays as large as it is.
      if (!wasMoved) frameAll();
    }
    invalidate();
  });
  store.on(['active'], () => {
    const {camera} = store.state;
    if (mustFrame !== 'anew' && isStraight(camera)) {
      cameras.setView(camera, facingOf(activeMotion(store.state)));
    }
  });
  store.on(['joint', 'active', 'motions', 'language'], (state) => {
    for (const [handle, {figure}] of figures.all) {
      figure.select(handle === state.active ? state.joint : -1);
    }
    invalidate();
  });

  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  const setTheme = () => {
    stage.setTheme(dark.matches);
    invalidate();
  };
  dark.addEventListener('change', setTheme);
  setTheme();
  canvas.addEventListener('webglcontextrestored', invalidate);

  new ResizeObserver(() => {
    const {clientWidth: width, clientHeight: height} = byId('stage');
    const wasMoved = cameras.isMoved;
    stage.renderer.setSize(width, height, false);
    cameras.resize(width, height);
    if (!wasMoved) frameAll();
    // At once: a canvas of another size is blank until it is drawn.
    isDirty = true;
    draw(performance.now());
  }).observe(byId('stage'));

  return {
    stage,
    cameras,
    figures,
    invalidate,
    frameAll,
    offers,
    update,
    settle() {
      if (mustFrame !== 'no') frameNow();
    },
    prepare,
    framed,
    boxOfMoments(moments) {
      const box = new THREE.Box3();
      for (const poses of moments) box.union(figures.boxOf(poses));
      return box.isEmpty() ? framed() : box;
    },
    drawNow,
  };
}
