// SPDX-License-Identifier: MIT
// The drawn parts of the track: ruler, lanes, ground contacts, marks.
import type {Contact, Mark} from '../core/types.ts';
import {fullName} from '../motionname.ts';
import type {OpenMotion} from '../state.ts';
import {endOf, numFrames, secondsOf, secondsPerFrame} from '../times.ts';
import {fromCore, t, type Word} from '../words.ts';
import {kLeft, kRight, type TimeAxis, tickStep} from './axis.ts';
import type {Marks} from './marks.ts';
import {sliderAttributes, svg} from './svg.ts';

export const kRulerHeight = 26;
export const kLaneHeight = 14;

/** Labels of the ruler stay so many pixels apart. */
const kLabelSpace = 70;
/** Marks that are nearer than so many pixels are drawn as one. */
const kMarkSpace = 5;

/** What the ruler counts: frames of the active motion, or its seconds. */
export type RulerUnit = 'frames' | 'seconds';

/** Ticks, and their numbers. */
export function drawRuler(
  motion: OpenMotion,
  axis: TimeAxis,
  width: number,
  height: number,
  unit: RulerUnit,
): SVGElement[] {
  // The room beside a single frame is no time.
  if (axis.isMoment) {
    const text = unit === 'seconds' ? '0 s' : '0';
    return tick(axis.x(motion.offset, width), height, text, true);
  }
  if (unit === 'seconds') return drawSeconds(motion, axis, width, height);
  const {time} = motion.document;
  const [begin, end] = axis.range;
  const perFrame = time.frame_time > 0 ? secondsPerFrame(motion) : 1;
  const step = Math.max(1, tickStep((kLabelSpace * axis.secondsPerPixel(width)) / perFrame));
  const drawn: SVGElement[] = [];
  const first = Math.ceil((begin - motion.offset) / perFrame / step - 1e-6);
  const last = Math.floor((end - motion.offset) / perFrame / step + 1e-6);
  for (let i = first; i <= last; i++) {
    const frame = i * step;
    const isWithin = frame >= 0 && frame < numFrames(time);
    const seconds = isWithin ? secondsOf(motion, frame) : motion.offset + frame * perFrame;
    const x = axis.x(seconds, width);
    if (x > width - kRight + 1) continue;
    drawn.push(...tick(x, height, String(frame), isWithin));
  }
  return drawn;
}

function drawSeconds(
  motion: OpenMotion,
  axis: TimeAxis,
  width: number,
  height: number,
): SVGElement[] {
  const [begin, end] = axis.range;
  const {offset, pace} = motion;
  const step = tickStep(kLabelSpace * axis.secondsPerPixel(width) * pace);
  const drawn: SVGElement[] = [];
  const duration = Number(motion.document.time.duration);
  for (let i = Math.ceil(((begin - offset) * pace) / step - 1e-6); ; i++) {
    const seconds = i * step;
    const at = offset + seconds / pace;
    const x = axis.x(at, width);
    if (at > end + 1e-9 || x > width - kRight + 1) return drawn;
    const isWithin = seconds >= 0 && seconds <= duration;
    drawn.push(...tick(x, height, `${Number(seconds.toPrecision(6))} s`, isWithin));
  }
}

const tick = (x: number, height: number, text: string, isWithin: boolean): SVGElement[] => [
  svg('path', {class: 'tick', d: `M${x} 18V${height}`}),
  svg('text', {class: isWithin ? 'label' : 'label outside', x: x + 3, y: 15}, [text]),
];

/** The lane of a motion: how long it is, and when it starts. */
export function drawLane(
  motion: OpenMotion,
  axis: TimeAxis,
  width: number,
  top: number,
  isActive: boolean,
  isMovable: boolean,
): SVGElement {
  const {handle, colour, offset, isVisible} = motion;
  const name = fullName(motion);
  const within = (x: number) => Math.max(kLeft, Math.min(width - kRight, x));
  const left = within(axis.x(offset, width));
  const right = Math.max(left + 3, within(axis.x(endOf(motion), width)));
  const attributes = isMovable
    ? sliderAttributes(
        `lane:${handle}`,
        t('lane', name),
        [-1e6, 1e6],
        offset,
        `${offset.toFixed(3)} s`,
      )
    : {'data-grip': 'playhead'};
  const bar = svg('rect', {
    x: left,
    y: top + 3,
    width: right - left,
    height: kLaneHeight - 6,
    rx: 3,
    fill: colour,
  });
  const classes = ['lane', isActive ? 'active' : '', isVisible ? '' : 'off'];
  return svg('g', {class: classes.filter(Boolean).join(' '), 'data-lane': handle, ...attributes}, [
    svg('title', {}, [isMovable ? t('lane', name) : name]),
    svg('rect', {class: 'reach', x: left, y: top, width: right - left, height: kLaneHeight}),
    bar,
  ]);
}

/** Where feet are on the ground: darker where several are. */
export function drawContacts(
  motion: OpenMotion,
  contacts: readonly Contact[],
  axis: TimeAxis,
  width: number,
  top: number,
): SVGElement[] {
  const {time} = motion.document;
  return contacts.map(({first_frame, num_frames}) => {
    const from = axis.x(secondsOf(motion, first_frame), width);
    const last = Math.min(numFrames(time) - 1, first_frame + num_frames);
    const to = axis.x(secondsOf(motion, last), width);
    const [left, right] = [Math.max(kLeft, from), Math.min(width - kRight, to)];
    return svg('rect', {
      class: 'contact',
      x: left,
      y: top + kLaneHeight - 3,
      width: Math.max(0, right - left),
      height: 3,
    });
  });
}

/** Letters of Latin, and of Chinese and Japanese, are about so wide. */
const kNarrow = 6.5;
const kWide = 11;
const kBlockSpace = 8;

const widthOf = (text: string): number =>
  [...text].reduce((sum, letter) => sum + (letter > '\u2e7f' ? kWide : kNarrow), 0);

/** The poses of a flow where they begin, with their names where there is room. */
export function drawBlocks(
  motion: OpenMotion,
  axis: TimeAxis,
  width: number,
  top: number,
): SVGElement[] {
  const drawn: SVGElement[] = [];
  let free = -Infinity;
  let last = -Infinity;
  for (const {frame, number, name} of motion.document.blocks) {
    const x = axis.x(secondsOf(motion, frame), width);
    if (x < kLeft - 1 || x > width - kRight + 1 || x - last < 3) continue;
    last = x;
    const text = name || `#${number}`;
    const parts: SVGElement[] = [svg('path', {class: 'tick', d: `M${x} ${top}v${kLaneHeight}`})];
    const room = width - kRight - x;
    if (x >= free && widthOf(text) < room) {
      free = x + widthOf(text) + kBlockSpace;
      parts.push(svg('text', {class: 'label', x: x + 3, y: top + kLaneHeight - 4}, [text]));
    }
    drawn.push(svg('g', {class: 'block'}, parts));
  }
  return drawn;
}

const kShapes: Record<Mark['kind'], string> = {
  spike: 'M0-5.5 5 4.5H-5z',
  flip: 'M0-6 5 0 0 6-5 0z',
  below: 'M-5-3h10L0 5z',
  above: 'M-5 3h10L0-5z',
  fast: 'M-4.5-4.5h9v9h-9z',
};

const kNames: Record<Mark['kind'], Word> = {
  spike: 'mark_spike',
  flip: 'mark_flip',
  below: 'mark_limit',
  above: 'mark_limit',
  fast: 'mark_fast',
};

/** The marks of the active motion; one for several that would lie over each other. */
export function drawMarks(
  motion: OpenMotion,
  marks: Marks,
  axis: TimeAxis,
  width: number,
  middle: number,
): SVGElement[] {
  const drawn: SVGElement[] = [];
  let last = -Infinity;
  for (const mark of marks.all) {
    const x = axis.x(secondsOf(motion, mark.worst_frame), width);
    if (x < kLeft - 1 || x > width - kRight + 1 || x - last < kMarkSpace) continue;
    last = x;
    const text = `${t(kNames[mark.kind])}: ${fromCore(mark.message)}`;
    const shape = svg('g', {class: `mark ${mark.kind}`, transform: `translate(${x} ${middle})`}, [
      svg('title', {}, [text]),
      svg('rect', {class: 'reach', x: -7, y: -8, width: 14, height: 16}),
      svg('path', {d: kShapes[mark.kind]}),
    ]);
    shape.addEventListener('pointerenter', () => marks.tell(text));
    shape.addEventListener('pointerleave', (event) => {
      if (event.pointerType === 'mouse') marks.tell('');
    });
    shape.addEventListener('click', () => marks.select(mark));
    drawn.push(shape);
  }
  return drawn;
}
