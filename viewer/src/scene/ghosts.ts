// SPDX-License-Identifier: MIT
// Ghosts: the active motion a little before and after, faint.
import type * as THREE from 'three';
import type {PoseCache} from '../poses.ts';
import type {OpenMotion} from '../state.ts';
import {frameAt, timeOfFrame} from '../times.ts';
import {type Figure, makeFigure} from './figure.ts';

const kEachSide = 4;
const kInterval = 0.25;
const kOpacity = 0.25;

/**
 * The times of the ghosts of a motion, from its start: every quarter of a second around the time
 * that is shown, or all over a clip that is shorter than they reach.
 */
export function ghostTimes(seconds: number, duration: number): number[] {
  const reach = 2 * kEachSide * kInterval;
  const times: number[] = [];
  for (let k = -kEachSide; k <= kEachSide; k++) {
    const isShort = duration <= reach;
    if (k === 0 && !isShort) continue;
    const time = isShort ? ((k + kEachSide) / (2 * kEachSide)) * duration : seconds + k * kInterval;
    if (time >= 0 && time <= duration) times.push(time);
  }
  return times;
}

export interface Ghosts {
  /** Shows the ghosts of a motion around a frame, where its figure stands; null: none. */
  show(of: {motion: OpenMotion; frame: number; figure: Figure} | null, poses: PoseCache): void;
  useShapes(wanted: boolean): void;
}

/** Makes the ghosts; figures are made when they are first needed. */
export function makeGhosts(group: THREE.Group): Ghosts {
  let figures: Figure[] = [];
  let made = '';
  let areShapes = true;

  const clear = () => {
    for (const figure of figures) {
      group.remove(figure.root);
      figure.dispose();
    }
    figures = [];
  };

  const figureOf = (k: number, motion: OpenMotion): Figure => {
    if (figures[k] === undefined) {
      figures[k] = makeFigure(motion.document, kOpacity);
      figures[k].paint(motion.colour, 1);
      figures[k].useShapes(areShapes);
      group.add(figures[k].root);
    }
    return figures[k];
  };

  return {
    useShapes(wanted) {
      areShapes = wanted;
      for (const figure of figures) figure.useShapes(wanted);
    },
    show(of, poses) {
      group.visible = of !== null;
      if (of === null) return;
      const {motion, frame: now, figure: like} = of;
      const wanted = `${motion.handle} ${motion.version} ${motion.colour}`;
      if (made !== wanted) clear();
      made = wanted;
      const {time} = motion.document;
      let count = 0;
      for (const seconds of ghostTimes(timeOfFrame(time, now), Number(time.duration))) {
        const frame = frameAt(time, seconds);
        const pose = frame === now ? null : poses.at(motion, frame);
        if (pose === null) continue;
        const figure = figureOf(count++, motion);
        figure.root.matrix.copy(like.root.matrix);
        figure.root.visible = true;
        figure.show(pose);
      }
      for (let k = count; k < figures.length; k++) figures[k].root.visible = false;
    },
  };
}
