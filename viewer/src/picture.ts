// SPDX-License-Identifier: MIT
// Pictures of the scene: the present view, and contact sheets. The renderer draws each picture at
// its own size, and a plain canvas collects them, with labels.
import {offerFile} from './elements.ts';
import type {PoseCache} from './poses.ts';
import {gridText} from './scene/scale.ts';
import type {Scene} from './scene/scene.ts';
import {framesOf, gridFor, type SheetFrames} from './scene/sheet.ts';
import {type Moment, momentsAt, shoot} from './scene/shots.ts';
import {activeMotion, type OpenMotion, type Store} from './state.ts';
import {numFrames, secondsOf} from './times.ts';
import {t} from './words.ts';

/** What a picture is made from, when the page is ready. */
export interface Studio {
  store: Store;
  scene: Scene | null;
  poses: PoseCache;
}

/** What is asked of a picture. */
export interface PictureWish {
  width: number;
  height: number;
  /** "A:B:STEP", parts may be missing: a contact sheet; null: the time that is shown. */
  frames: string | null;
  /** Shows what the page shows, even if nobody has moved the view. */
  isExact?: boolean;
}

const kMostSide = 8192;
const kGap = 2;

const side = (wanted: number): number =>
  Math.max(16, Math.min(kMostSide, Math.round(Number(wanted) || 0)));

/** Text over a picture, on any ground. */
function write(context: CanvasRenderingContext2D, text: string, x: number, y: number): void {
  const {fillStyle} = context;
  context.lineJoin = 'round';
  context.strokeText(text, x, y);
  context.fillText(text, x, y);
  context.fillStyle = fillStyle;
}

/** The titles of the motions, with their colours, at the bottom left; the grid at the right. */
function writeTitles(
  context: CanvasRenderingContext2D,
  motions: OpenMotion[],
  size: number,
  grid: string,
): void {
  const {width, height} = context.canvas;
  const swatch = size * 0.8;
  const text = context.fillStyle;
  motions.forEach(({title, colour}, k) => {
    const y = height - size * (0.8 + 1.5 * (motions.length - 1 - k));
    context.fillStyle = colour;
    context.beginPath();
    context.roundRect(size * 0.8, y - swatch, swatch, swatch, swatch / 4);
    context.fill();
    context.fillStyle = text;
    write(context, title, size * 2.1, y);
  });
  context.textAlign = 'right';
  write(context, grid, width - size * 0.8, height - size * 0.8);
  context.textAlign = 'left';
}

function makePaper(scene: Scene, width: number, height: number, size: number) {
  const paper = document.createElement('canvas');
  paper.width = width;
  paper.height = height;
  const context = paper.getContext('2d')!;
  const {theme} = scene.stage;
  const ground = `#${theme.background.toString(16).padStart(6, '0')}`;
  context.fillStyle = ground;
  context.fillRect(0, 0, width, height);
  context.font = `${size}px system-ui, "Noto Sans JP", "VL Gothic", sans-serif`;
  context.lineWidth = size / 4;
  context.strokeStyle = ground;
  context.fillStyle = theme.text;
  return {paper, context};
}

const visibleOf = (store: Store): OpenMotion[] =>
  store.state.motions.filter((motion) => motion.isVisible);

/** One picture of the time that is shown. */
async function presentPicture(studio: Studio, {width, height, isExact}: PictureWish) {
  const {store, poses} = studio;
  const scene = studio.scene!;
  const size = Math.max(12, Math.min(width, height) / 42);
  const moments = await momentsAt(store, poses, [store.state.seconds]);
  const {paper, context} = makePaper(scene, width, height, size);
  let cell = 1;
  // A view that nobody has moved is fitted to the picture's own proportions.
  const frames = isExact || scene.cameras.isMoved ? 'present' : 'own';
  shoot(scene, store, moments, {width, height, frames}, (canvas, _, drawnCell) => {
    cell = drawnCell;
    context.drawImage(canvas, 0, 0);
  });
  writeTitles(context, visibleOf(store), size, gridText(cell, activeMotion(store.state)));
  return paper;
}

/** A sheet of pictures, each with the number of its frame. */
async function contactSheet(studio: Studio, width: number, height: number, chosen: SheetFrames) {
  const {store, poses} = studio;
  const scene = studio.scene!;
  const {motion, frames} = chosen;
  const size = Math.max(11, Math.min(width, height) / 56);
  const seconds = frames.map((frame) => secondsOf(motion, frame));
  const moments: Moment[] = await momentsAt(store, poses, seconds);
  const {paper, context} = makePaper(scene, width, height, size);
  const {columns, rows} = gridFor(frames.length, width, height, aspectOf(scene, moments));
  const place = (index: number, count: number, whole: number) =>
    Math.round((index * (whole + kGap)) / count);
  const cell = {
    width: place(1, columns, width) - kGap,
    height: place(1, rows, height) - kGap,
    frames: 'each',
  } as const;
  let grid = 1;
  shoot(scene, store, moments, cell, (canvas, k, drawnCell) => {
    grid = drawnCell;
    const x = place(k % columns, columns, width);
    const y = place(Math.floor(k / columns), rows, height);
    context.drawImage(canvas, x, y);
    write(context, String(frames[k]), x + size * 0.6, y + size * 1.4);
  });
  writeTitles(context, visibleOf(store), size, gridText(grid, activeMotion(store.state)));
  return paper;
}

/** How wide what is seen of a moment is, relative to its height, at most. */
const aspectOf = (scene: Scene, moments: Moment[]): number =>
  Math.max(...moments.map(({poses}) => scene.cameras.aspectOf(scene.boxOfMoments([poses]))));

/** Makes a picture, as a canvas. */
async function makePicture(studio: Studio, wish: PictureWish): Promise<HTMLCanvasElement> {
  if (studio.scene === null) throw new Error(t('no_webgl'));
  const {state} = studio.store;
  const {frames: wanted} = wish;
  const width = side(wish.width);
  const height = side(wish.height);
  const motion = activeMotion(state) ?? state.motions[0];
  if (wanted === null || motion === undefined) {
    return presentPicture(studio, {...wish, width, height});
  }
  const frames = framesOf(wanted, numFrames(motion.document.time));
  if (frames === null) throw new Error(t('no_frames', wanted));
  return contactSheet(studio, width, height, {motion, frames});
}

interface Api {
  picture(wish: PictureWish): Promise<string>;
}

let studio: Promise<Studio> | null = null;

/**
 * Offers pictures to whoever drives the page: `kinefile.picture` gives a PNG in base64 when the page
 * has opened its files and has their poses.
 */
export function offerPictures(ready: Promise<Studio>): void {
  studio = ready;
  const api: Api = {
    async picture(wish) {
      const paper = await makePicture(await ready, wish);
      return paper.toDataURL('image/png').replace(/^[^,]*,/, '');
    },
  };
  const page = globalThis as {kinefile?: Partial<Api>};
  page.kinefile = Object.assign(page.kinefile ?? {}, api);
}

/** The present view at twice its size, as a file. */
export async function savePicture(store: Store): Promise<void> {
  if (studio === null) return;
  const canvas = document.getElementById('canvas')!;
  const paper = await makePicture(await studio, {
    width: 2 * canvas.clientWidth,
    height: 2 * canvas.clientHeight,
    frames: null,
    isExact: true,
  });
  const blob = await new Promise<Blob | null>((resolve) => paper.toBlob(resolve, 'image/png'));
  const title = activeMotion(store.state)?.title ?? 'kinefile';
  if (blob !== null) offerFile(`${title.replace(/\.[^.]*$/, '')}.png`, blob);
}
