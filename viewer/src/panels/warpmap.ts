// SPDX-License-Identifier: MIT
// The drawn map of a time warp: new frames to the right, old frames upwards, keys as handles.
import type {OpenMotion} from '../state.ts';
import {secondsPerFrame} from '../times.ts';
import {t} from '../words.ts';
import {kLeft, kRight, type TimeAxis, tickStep} from './axis.ts';
import {redraw, sliderAttributes, svg} from './svg.ts';
import {type Key, numberText} from './warpwords.ts';

const kTop = 12;
const kBottom = 18;
/** Labels stay so many pixels apart. */
const kAcross = 80;
const kUp = 34;
/** The name of what keeps the curve off the labels when the time is zoomed. */
const kClip = 'warp-clip';

/** What is drawn. */
export interface WarpMap {
  motion: OpenMotion;
  keys: readonly Key[];
  /** The index of the selected key; -1: none. */
  selected: number;
  /** How many frames there were before the warp. */
  numOld: number;
  /** Whether the core refused these keys: the map is the last good one. */
  isRefused: boolean;
  /** Those of the keys that were refused. */
  refused: readonly Key[];
}

/** Frames to pixels, and back. */
export interface WarpScale {
  x(to: number): number;
  y(from: number): number;
  to(x: number): number;
  from(y: number): number;
}

/** The scale of a map in a drawing. */
export function warpScale(
  {motion, numOld}: WarpMap,
  axis: TimeAxis,
  width: number,
  height: number,
): WarpScale {
  const perFrame = secondsPerFrame(motion);
  const most = Math.max(1, numOld - 1);
  const room = height - kTop - kBottom;
  return {
    x: (to) => axis.x(motion.offset + to * perFrame, width),
    y: (from) => height - kBottom - (from / most) * room,
    to: (x) => (axis.seconds(x, width) - motion.offset) / perFrame,
    from: (y) => ((height - kBottom - y) / room) * most,
  };
}

/** Which old frame a new frame shows; without a warp the same. */
export function sourceOf({motion, numOld}: WarpMap, to: number): number {
  const {source_frames} = motion.document;
  if (source_frames.length === 0) return Math.max(0, Math.min(numOld - 1, to));
  const low = Math.max(0, Math.min(source_frames.length - 1, Math.floor(to)));
  const high = Math.min(source_frames.length - 1, low + 1);
  return source_frames[low] + (source_frames[high] - source_frames[low]) * Math.max(0, to - low);
}

/** The curve, with no more points than pixels. */
function curve(map: WarpMap, scale: WarpScale, width: number): string {
  const {source_frames, time} = map.motion.document;
  const count = source_frames.length || time.num_frames;
  const stride = Math.max(1, Math.floor(count / width));
  const points: string[] = [];
  const add = (to: number) =>
    points.push(`${scale.x(to).toFixed(1)} ${scale.y(sourceOf(map, to)).toFixed(1)}`);
  for (let to = 0; to < count - 1; to += stride) add(to);
  add(count - 1);
  return `M${points.join('L')}`;
}

function grid(map: WarpMap, axis: TimeAxis, scale: WarpScale, width: number, height: number) {
  const drawn: SVGElement[] = [];
  const across = Math.max(
    1,
    tickStep((kAcross * axis.secondsPerPixel(width)) / secondsPerFrame(map.motion)),
  );
  const last = scale.to(width - kRight);
  for (let to = Math.ceil(scale.to(kLeft) / across - 1e-6) * across; to <= last; to += across) {
    const x = scale.x(to);
    drawn.push(
      svg('path', {class: 'tick', d: `M${x} ${kTop}V${height - kBottom}`}),
      svg('text', {class: 'label', x, y: height - 5, 'text-anchor': 'middle'}, [numberText(to)]),
    );
  }
  const up = Math.max(1, tickStep((kUp * map.numOld) / (height - kTop - kBottom)));
  for (let from = 0; from < map.numOld; from += up) {
    const y = scale.y(from);
    drawn.push(
      svg('path', {class: 'tick', d: `M${kLeft} ${y}H${width - kRight}`}),
      svg('text', {class: 'label', x: kLeft - 5, y: y + 4, 'text-anchor': 'end'}, [
        numberText(from),
      ]),
    );
  }
  return drawn;
}

/** Where a key is drawn; one that was refused stands at the edge of the map that it is beyond. */
function placeOf(map: WarpMap, scale: WarpScale, key: Key, width: number): [number, number] {
  const [x, y] = [scale.x(key.to), scale.y(key.from)];
  if (!map.refused.includes(key)) return [x, y];
  return [
    Math.max(kLeft, Math.min(width - kRight, x)),
    Math.max(scale.y(map.numOld - 1), Math.min(scale.y(0), y)),
  ];
}

/** A key: a handle that is large enough for a finger. */
function keyHandle(map: WarpMap, [x, y]: [number, number], key: Key, index: number): SVGElement {
  const text = `${numberText(key.from)} → ${numberText(key.to)}`;
  return svg(
    'g',
    {
      class: [
        'key',
        index === map.selected ? 'selected' : '',
        map.refused.includes(key) ? 'refused' : '',
      ]
        .filter(Boolean)
        .join(' '),
      transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
      ...sliderAttributes(
        `key:${index}`,
        t('warp_key_label', index + 1),
        [0, map.motion.document.time.num_frames - 1],
        key.to,
        text,
      ),
    },
    [
      svg('title', {}, [text]),
      svg('circle', {class: 'reach', r: 16}),
      svg('path', {class: 'diamond', d: 'M0-7 7 0 0 7-7 0z', stroke: map.motion.colour}),
      svg('text', {class: 'key-text', y: -11, 'text-anchor': 'middle'}, [text]),
    ],
  );
}

/** Draws the map. `playhead` is moved by the caller. */
export function drawWarpMap(
  drawing: SVGSVGElement,
  map: WarpMap,
  axis: TimeAxis,
  playhead: SVGElement,
): void {
  const width = drawing.clientWidth || 300;
  const height = drawing.clientHeight || 160;
  drawing.setAttribute('viewBox', `0 0 ${width} ${height}`);
  const scale = warpScale(map, axis, width, height);
  playhead.setAttribute('d', `M0 ${kTop}V${height - kBottom}`);
  const end = map.numOld - 1;
  redraw(drawing, [
    svg('rect', {class: 'ground', x: 0, y: 0, width, height, 'data-grip': 'ground'}),
    ...grid(map, axis, scale, width, height),
    svg('text', {class: 'label name', x: 4, y: 10}, [t('warp_old')]),
    svg(
      'text',
      {class: 'label name', x: width - 4, y: height - kBottom - 5, 'text-anchor': 'end'},
      [t('warp_new')],
    ),
    svg('clipPath', {id: kClip}, [
      svg('rect', {x: kLeft - 2, y: 0, width: Math.max(0, width - kLeft), height}),
    ]),
    svg('path', {
      class: 'diagonal',
      'clip-path': `url(#${kClip})`,
      d: `M${scale.x(0)} ${scale.y(0)}L${scale.x(end)} ${scale.y(end)}`,
    }),
    svg('path', {
      class: map.isRefused ? 'curve refused' : 'curve',
      d: curve(map, scale, width),
      stroke: map.motion.colour,
      'clip-path': `url(#${kClip})`,
    }),
    playhead,
    ...map.keys.flatMap((key, index) => {
      const place = placeOf(map, scale, key, width);
      return place[0] < kLeft - 1 ? [] : [keyHandle(map, place, key, index)];
    }),
  ]);
}
