// SPDX-License-Identifier: MIT
// Draws the scene at given times and in a given size, on the renderer's own canvas. All is done
// before the browser shows anything, and ends with the page's own view.
import type {FramePoses, PoseCache} from '../poses.ts';
import type {Store} from '../state.ts';
import {shownFrame} from '../times.ts';
import type {Scene} from './scene.ts';

/** A time, with the poses of all visible motions. */
export interface Moment {
  seconds: number;
  /** By the handles of the motions. */
  poses: Map<number, FramePoses>;
}

/** Waits for the poses of all visible motions at some times. */
export async function momentsAt(
  store: Store,
  poses: PoseCache,
  times: number[],
): Promise<Moment[]> {
  const moments: Moment[] = [];
  for (const seconds of times) {
    const moment: Moment = {seconds, poses: new Map()};
    for (const motion of store.state.motions) {
      if (!motion.isVisible) continue;
      const frame = await poses.wait(motion, shownFrame(motion, seconds));
      if (frame !== null) moment.poses.set(motion.handle, frame);
    }
    moments.push(moment);
  }
  return moments;
}

/** The size of a picture, and what it frames. */
export interface Format {
  width: number;
  height: number;
  /** Each moment, all at one scale; as the page does by itself; or what the page shows. */
  frames: 'each' | 'own' | 'present';
}

/** Draws moments, and gives the canvas after each of them, with the width of the grid's cells. */
export function shoot(
  scene: Scene,
  store: Store,
  moments: Moment[],
  {width, height, frames}: Format,
  take: (canvas: HTMLCanvasElement, index: number, cell: number) => void,
): void {
  const {renderer} = scene.stage;
  const canvas = renderer.domElement;
  const [ownWidth, ownHeight] = [canvas.clientWidth, canvas.clientHeight];
  const ratio = renderer.getPixelRatio();
  renderer.setPixelRatio(1);
  renderer.setSize(width, height, false);
  scene.update(moments[0]?.seconds ?? store.state.seconds, moments[0]?.poses);
  scene.settle();
  const aspect = width / height;
  const boxes = moments.map(({poses}) => {
    if (frames === 'each') return scene.boxOfMoments([poses]);
    return frames === 'own' ? scene.framed() : null;
  });
  const views = boxes.map((box) => scene.cameras.framed(box, aspect));
  const halfHeight = Math.max(...views.map((view) => view.halfHeight));
  moments.forEach(({seconds, poses}, index) => {
    scene.update(seconds, poses);
    const view = scene.cameras.framed(boxes[index], aspect, halfHeight);
    const cell = scene.prepare(view, height);
    renderer.render(scene.stage.scene, view.camera);
    take(canvas, index, cell);
  });
  renderer.setPixelRatio(ratio);
  renderer.setSize(ownWidth, ownHeight, false);
  scene.update(store.state.seconds);
  scene.drawNow();
}
