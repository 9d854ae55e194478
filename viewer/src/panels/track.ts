// SPDX-License-Identifier: MIT
// The whole time at a glance: ruler, lanes of the motions, marks, the range that plays, the
// playhead. The parts are drawn by lanes.ts; here they are put together and used.
import {byId, el} from '../elements.ts';
import {goToFrame, playedRange} from '../playback.ts';
import {activeMotion, type OpenMotion, type Store, withMotion} from '../state.ts';
import {
  frameAt,
  numFrames,
  ownSeconds,
  secondsOf,
  secondsPerFrame,
  shownFrame,
  wholeRange,
} from '../times.ts';
import {t} from '../words.ts';
import type {TimeAxis} from './axis.ts';
import {titled} from './icons.ts';
import {
  drawBlocks,
  drawContacts,
  drawLane,
  drawMarks,
  drawRuler,
  kLaneHeight,
  kRulerHeight,
  type RulerUnit,
} from './lanes.ts';
import type {Marks} from './marks.ts';
import {arrowStep, type Grip, redraw, sliderAttributes, svg, useGrips} from './svg.ts';

/** A wheel's notch shows so much more time, or less. */
const kZoomStep = 1.25;
const kMarksHeight = 14;
const kHandleWidth = 7;

/** The nearest frame of the active motion to a time. */
function nearestFrame(motion: OpenMotion, seconds: number): number {
  const {time} = motion.document;
  return frameAt(time, ownSeconds(motion, seconds) + time.frame_time / 2);
}

/** Sets the range that plays; the whole of time is no range. */
function setLoop(store: Store, begin: number, end: number): void {
  const [first, last] = wholeRange(store.state);
  if (end <= begin) return;
  store.set({loop: begin <= first && end >= last ? null : [begin, end]});
}

/** Begins or ends the range that plays at the time that is shown. */
export function setLoopEnd(store: Store, end: 'begin' | 'end'): void {
  const [begin, last] = playedRange(store);
  const {seconds} = store.state;
  if (end === 'begin') setLoop(store, seconds, last > seconds ? last : wholeRange(store.state)[1]);
  else setLoop(store, begin < seconds ? begin : wholeRange(store.state)[0], seconds);
}

export function makeTrack(store: Store, axis: TimeAxis, marks: Marks): void {
  const note = el('output', {class: 'mark-note', hidden: true});
  const drawing = svg('svg', {class: 'track'});
  const playhead = svg('g', {});
  let unit: RulerUnit = 'frames';
  const unitButton = el('button', {type: 'button', class: 'unit'});
  unitButton.addEventListener('click', () => {
    unit = unit === 'frames' ? 'seconds' : 'frames';
    draw();
  });
  const legend = el('p', {class: 'track-legend', hidden: true});
  byId('time').append(el('div', {class: 'track-holder'}, [drawing, unitButton]), legend, note);
  let width = 300;
  let height = 60;

  const secondsAt = (event: PointerEvent) =>
    axis.seconds(event.clientX - drawing.getBoundingClientRect().left, width);

  const scrub = (event: PointerEvent) => {
    const motion = activeMotion(store.state);
    if (motion !== undefined) goToFrame(store, nearestFrame(motion, secondsAt(event)));
  };
  const stepFrames = (event: KeyboardEvent): boolean => {
    const motion = activeMotion(store.state);
    const step = arrowStep(event);
    if (motion === undefined) return false;
    const frame = shownFrame(motion, store.state.seconds);
    if (step !== 0) goToFrame(store, frame + step);
    else if (event.key === 'Home') goToFrame(store, 0);
    else if (event.key === 'End') goToFrame(store, Infinity);
    else return false;
    return true;
  };

  /** A handle of the range that plays: moved in whole frames of the active motion. */
  const loopGrip = (which: 'begin' | 'end'): Grip => {
    const move = (seconds: number) => {
      const [begin, end] = playedRange(store);
      if (which === 'begin') setLoop(store, seconds, end);
      else setLoop(store, begin, seconds);
    };
    const snapped = (seconds: number) => {
      const motion = activeMotion(store.state);
      return motion === undefined ? seconds : secondsOf(motion, nearestFrame(motion, seconds));
    };
    return {
      move: (event) => move(snapped(secondsAt(event))),
      key(event) {
        const motion = activeMotion(store.state);
        const step = arrowStep(event);
        if (step === 0 || motion === undefined) return false;
        const at = playedRange(store)[which === 'begin' ? 0 : 1];
        move(secondsOf(motion, Math.max(0, nearestFrame(motion, at) + step)));
        return true;
      },
    };
  };

  /** A lane: dragging it lets its motion start at another time, in whole frames. */
  const laneGrip = (motion: OpenMotion): Grip => {
    let from = 0;
    const set = (offset: number) => {
      const step = secondsPerFrame(motion);
      const snapped = Math.round(Math.round(offset / step) * step * 1e9) / 1e9;
      store.set({motions: withMotion(store.state, motion.handle, {offset: snapped})});
    };
    return {
      begin(event) {
        axis.hold();
        from = secondsAt(event) - motion.offset;
        if (store.state.active !== motion.handle) store.set({active: motion.handle, joint: -1});
      },
      move: (event) => set(secondsAt(event) - from),
      end: () => axis.release(),
      key(event) {
        const step = arrowStep(event);
        if (step !== 0) set(motion.offset + step * secondsPerFrame(motion));
        return step !== 0;
      },
    };
  };

  useGrips(drawing, (name) => {
    const [kind, of] = name.split(':');
    if (kind === 'loop') return loopGrip(of as 'begin' | 'end');
    if (kind === 'playhead') return {begin: scrub, move: scrub, key: stepFrames};
    const motion = store.state.motions.find((one) => String(one.handle) === of);
    return kind === 'lane' && motion !== undefined ? laneGrip(motion) : undefined;
  });

  const drawLoop = (): SVGElement[] => {
    const [begin, end] = playedRange(store);
    const whole = wholeRange(store.state);
    const [left, right] = [axis.x(begin, width), axis.x(end, width)];
    const handle = (which: 'begin' | 'end', x: number) =>
      svg(
        'g',
        {
          class: 'loop-handle',
          ...sliderAttributes(
            `loop:${which}`,
            t(which === 'begin' ? 'loop_begin' : 'loop_end'),
            whole,
            which === 'begin' ? begin : end,
            `${(which === 'begin' ? begin : end).toFixed(3)} s`,
          ),
        },
        [
          svg('title', {}, [t(which === 'begin' ? 'loop_begin' : 'loop_end')]),
          svg('rect', {
            class: 'reach',
            x: which === 'begin' ? x - 16 : x - 1,
            y: 0,
            width: 17,
            height: kRulerHeight,
          }),
          svg('path', {
            d:
              which === 'begin'
                ? `M${x} 0h${-kHandleWidth}v9l${kHandleWidth} 5z`
                : `M${x} 0h${kHandleWidth}v9l${-kHandleWidth} 5z`,
          }),
        ],
      );
    const range = svg('rect', {
      class: store.state.loop === null ? 'loop whole' : 'loop',
      x: left,
      y: 0,
      width: Math.max(0, right - left),
      height: 4,
    });
    return [range, handle('begin', left), handle('end', right)];
  };

  const movePlayhead = () => {
    const motion = activeMotion(store.state);
    if (motion === undefined) return;
    const x = axis.x(store.state.seconds, width);
    const frame = shownFrame(motion, store.state.seconds);
    playhead.setAttribute('transform', `translate(${x.toFixed(2)} 0)`);
    const attributes = sliderAttributes(
      'playhead',
      t('playhead'),
      [0, numFrames(motion.document.time) - 1],
      frame,
      `${t('frame')} ${frame}`,
    );
    for (const [name, value] of Object.entries(attributes)) {
      playhead.setAttribute(name, String(value));
    }
  };

  /** What the strip along the active motion's bar is. */
  const drawLegend = (motion: OpenMotion) => {
    const {joints} = motion.document;
    const names = new Set(marks.contacts.map(({joint}) => joints[joint]?.name ?? ''));
    legend.hidden = names.size === 0;
    legend.replaceChildren(
      el('span', {class: 'contact-swatch'}),
      t('contact_legend', [...names].join(', ')),
    );
  };

  const draw = () => {
    const {motions, active} = store.state;
    const motion = activeMotion(store.state);
    if (motion === undefined) return;
    unitButton.textContent = t(unit === 'frames' ? 'unit_frames' : 'unit_seconds');
    titled(unitButton, t(unit === 'frames' ? 'ruler_frames' : 'ruler_seconds'));
    width = drawing.clientWidth || width;
    const hasMarks = marks.all.length > 0;
    const blocksTop = kRulerHeight + (hasMarks ? kMarksHeight : 2);
    const lanesTop = blocksTop + (motion.document.blocks.length > 0 ? kLaneHeight : 0);
    height = lanesTop + motions.length * kLaneHeight + 4;
    drawing.setAttribute('height', String(height));
    drawing.setAttribute('viewBox', `0 0 ${width} ${height}`);
    const top = (one: OpenMotion) => lanesTop + motions.indexOf(one) * kLaneHeight;
    redraw(drawing, [
      svg('rect', {class: 'ground', x: 0, y: 0, width, height, 'data-grip': 'playhead'}),
      ...drawRuler(motion, axis, width, height, unit),
      ...drawBlocks(motion, axis, width, blocksTop),
      ...motions.map((one) =>
        drawLane(one, axis, width, top(one), one.handle === active, motions.length > 1),
      ),
      ...drawContacts(motion, marks.contacts, axis, width, top(motion)),
      playhead,
      ...(axis.isMoment ? [] : drawLoop()),
      ...drawMarks(motion, marks, axis, width, kRulerHeight + kMarksHeight / 2),
    ]);
    playhead.replaceChildren(
      svg('rect', {class: 'reach', x: -9, y: 0, width: 18, height}),
      // Below the numbers of the ruler, which it would hide.
      svg('path', {class: 'line', d: `M0 18V${height}`}),
      svg('path', {class: 'head', d: 'M-6 18h12v4l-6 6-6-6z'}),
    );
    movePlayhead();
    drawLegend(motion);
  };
  playhead.setAttribute('class', 'playhead');

  drawing.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const x = event.clientX - drawing.getBoundingClientRect().left;
      axis.zoom(event.deltaY > 0 ? kZoomStep : 1 / kZoomStep, axis.seconds(x, width));
    },
    {passive: false},
  );
  drawing.addEventListener('dblclick', () => axis.showAll());
  marks.onTell((text) => {
    note.textContent = text;
    note.hidden = text === '';
  });
  marks.onChange(draw);
  axis.onChange(draw);
  new ResizeObserver(() => {
    if (drawing.clientWidth !== width) draw();
  }).observe(drawing);
  store.on(['motions', 'active', 'loop', 'language'], draw);
  store.on(['seconds'], movePlayhead);
}
