// SPDX-License-Identifier: MIT
// One plot: uPlot draws the lines. A press or a drag goes to a place, shift and drag, ctrl and
// wheel, or two fingers zoom.
import uPlot from 'uplot';
import {el} from '../elements.ts';
import {styleColour} from './colours.ts';

/** A line of a plot. */
export interface Line {
  label: string;
  colour: string;
  dash: number[];
  /** Values that it should not pass: dashed lines. */
  limits: number[];
}

/** A part of the x axis. */
export type Range = [number, number];

export interface Plot {
  root: HTMLElement;
  /** Moves the mark of what is shown now. */
  mark(x: number): void;
  zoom(range: Range): void;
  dispose(): void;
}

/** What a plot tells. */
export interface PlotEvents {
  seek(x: number): void;
  zoom(range: Range): void;
  reset(): void;
}

/** Limits that are further off than so many times the reach of the values are not in the picture. */
const kFarLimit = 2;

/** The part of the y axis that shows values, and their limits unless these are far off. */
function rangeOfY(lines: Line[], min: number | null, max: number | null): [number, number] {
  if (min === null || max === null) return [0, 1];
  const far = max > min ? kFarLimit * (max - min) : Infinity;
  const limits = lines.flatMap((line) => line.limits);
  const near = limits.filter((limit) => limit >= min - far && limit <= max + far);
  const [low, high] = uPlot.rangeNum(Math.min(min, ...near), Math.max(max, ...near), 0.1, true);
  return [low ?? 0, high ?? 1];
}

function drawLimits({ctx, bbox, valToPos}: uPlot, lines: Line[]): void {
  ctx.save();
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
  for (const {limits, colour} of lines) {
    ctx.strokeStyle = colour;
    for (const limit of limits) {
      const y = valToPos(limit, 'y', true);
      if (y < bbox.top || y > bbox.top + bbox.height) continue;
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
    }
  }
  ctx.restore();
}

/** Until the plot is laid out. */
const kFirstSize = {width: 300, height: 150};
const kWheelFactor = 1.0015;

const axis = (given: Partial<uPlot.Axis>): uPlot.Axis => ({
  stroke: () => styleColour('--faint'),
  grid: {stroke: () => styleColour('--line'), width: 1},
  ticks: {stroke: () => styleColour('--line'), width: 1, size: 4},
  font: '11px system-ui, sans-serif',
  ...given,
});

/** Makes a plot. The first array of the data is x, then one for each line. */
export function makePlot(
  data: uPlot.AlignedData,
  lines: Line[],
  range: Range,
  events: PlotEvents,
): Plot {
  const root = el('div', {class: 'plot'});
  const now = el('div', {class: 'plot-now'});
  let marked = 0;
  const place = (plot: uPlot) => {
    const at = plot.valToPos(marked, 'x');
    const width = plot.bbox.width / devicePixelRatio; // known without a layout
    now.hidden = !(at >= -1 && at <= width + 1);
    now.style.transform = `translateX(${at}px)`;
  };
  const plot = new uPlot(
    {
      ...kFirstSize,
      legend: {show: false},
      cursor: {drag: {setScale: false, x: false, y: false}, y: false, points: {size: 6}},
      scales: {
        x: {time: false, range: () => range},
        y: {range: (_, min, max) => rangeOfY(lines, min, max)},
      },
      axes: [axis({size: 26, space: 50}), axis({size: 48, space: 26})],
      series: [
        {},
        ...lines.map(({label, colour, dash}) => ({
          label,
          stroke: colour,
          dash,
          width: 1.5,
          points: {show: false},
        })),
      ],
      hooks: {draw: [place, (own) => drawLimits(own, lines)], setSize: [place]},
    },
    data,
    root,
  );
  plot.over.append(now);
  addPointers(plot, events);
  const watch = new ResizeObserver(() => {
    const {clientWidth: width, clientHeight: height} = root;
    if (width > 0 && height > 0) plot.setSize({width, height});
  });
  watch.observe(root);
  return {
    root,
    mark(x) {
      marked = x;
      place(plot);
    },
    zoom([min, max]) {
      range = [min, max];
      plot.setScale('x', {min, max});
    },
    dispose() {
      watch.disconnect();
      plot.destroy();
    },
  };
}

/** What mouse and fingers do. */
function addPointers(plot: uPlot, events: PlotEvents): void {
  const {over} = plot;
  /** Where each finger or button went down: x in pixels, and its value. */
  const down = new Map<number, {at: number; value: number}>();
  let selectFrom: number | null = null;
  const atOf = (event: MouseEvent) => event.clientX - over.getBoundingClientRect().left;
  const placeAt = (at: number) => plot.posToVal(at, 'x');
  const select = (a: number, b: number) =>
    plot.setSelect(
      {left: Math.min(a, b), top: 0, width: Math.abs(a - b), height: over.clientHeight},
      false,
    );

  /** Keeps what was under two fingers under them. */
  const pinch = () => {
    const [a, b] = down.values();
    if (Math.abs(a.at - b.at) < 8) return;
    const scale = (a.value - b.value) / (a.at - b.at);
    if (scale <= 0) return;
    const min = a.value - a.at * scale;
    events.zoom([min, min + over.clientWidth * scale]);
  };

  over.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    over.setPointerCapture(event.pointerId);
    const at = atOf(event);
    down.set(event.pointerId, {at, value: placeAt(at)});
    if (down.size > 1) return;
    if (event.shiftKey) selectFrom = at;
    else events.seek(placeAt(at));
  });
  over.addEventListener('pointermove', (event) => {
    const finger = down.get(event.pointerId);
    if (finger === undefined) return;
    const at = atOf(event);
    finger.at = at;
    if (down.size === 2) pinch();
    else if (selectFrom !== null) select(selectFrom, at);
    else if (down.size === 1) events.seek(placeAt(at));
  });
  const up = (event: PointerEvent) => {
    down.delete(event.pointerId);
    if (selectFrom === null) return;
    const [from, to] = [selectFrom, atOf(event)];
    selectFrom = null;
    select(0, 0);
    if (Math.abs(from - to) > 4) {
      events.zoom([placeAt(Math.min(from, to)), placeAt(Math.max(from, to))]);
    }
  };
  over.addEventListener('pointerup', up);
  over.addEventListener('pointercancel', up);
  over.addEventListener('dblclick', () => events.reset());
  over.addEventListener(
    'wheel',
    (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      const at = placeAt(atOf(event));
      const factor = kWheelFactor ** event.deltaY;
      const {min, max} = plot.scales.x as {min: number; max: number};
      events.zoom([at + (min - at) * factor, at + (max - at) * factor]);
    },
    {passive: false},
  );
}
