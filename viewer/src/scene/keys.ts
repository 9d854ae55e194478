// SPDX-License-Identifier: MIT
// Keys that move the camera while the canvas has the focus. The arrows alone step through frames,
// so those that turn need ctrl or alt; with shift, they move.
import type {Cameras} from './cameras.ts';

const kTurn = Math.PI / 24;
const kMove = 0.12;
const kZoom = 1.15;

const kArrows: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Moves the camera by keys. */
export function watchKeys(canvas: HTMLCanvasElement, cameras: Cameras): void {
  canvas.addEventListener('keydown', (event) => {
    const arrow = kArrows[event.key];
    if (arrow !== undefined && (event.ctrlKey || event.altKey)) {
      if (event.shiftKey) cameras.pan(arrow[0] * kMove, arrow[1] * kMove);
      else cameras.turn(arrow[0] * kTurn, arrow[1] * kTurn);
    } else if (event.key === '+' || event.key === '=') {
      cameras.zoom(kZoom);
    } else if (event.key === '-') {
      cameras.zoom(1 / kZoom);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  });
}
