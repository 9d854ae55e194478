// SPDX-License-Identifier: MIT
// Curves of the selected joint over time, of all visible motions that have one of its name.
import {button, el} from '../elements.ts';
import {fullName} from '../motionname.ts';
import {goToFrame} from '../playback.ts';
import {activeMotion, type OpenMotion, type State} from '../state.ts';
import {shownFrame} from '../times.ts';
import {t} from '../words.ts';
import {onTheme} from './colours.ts';
import {openPanel, type PanelContext, whileOpen} from './context.ts';
import {latestOnly} from './latest.ts';
import {angleUnit, lengthUnit, shortNumber} from './numbers.ts';
import {makePlot, type Plot, type Range} from './plot.ts';
import {
  frameAtX,
  type PlottedGroup,
  plottedGroups,
  plottedMotions,
  wholeX,
  type XAxis,
  xOfFrame,
} from './plotted.ts';
import {type Measure, makeSeriesCache, type Quantity, quantitiesOf} from './series.ts';

const unitOf = (measure: Measure, {document}: OpenMotion): string => {
  if (measure === 'length') return lengthUnit(document);
  if (measure === 'speed') return `${lengthUnit(document)}/s`;
  if (measure === 'angle') return angleUnit(document);
  return measure === 'angular_speed' ? '°/s' : '';
};

const labelOf = ({key, channel}: Quantity): string => {
  if (channel !== '') return channel;
  if (key === 'speed' || key === 'angular_speed') return t(`curve_${key}`);
  return key;
};

/** So many curves are told apart. */
const kFewCurves = 6;

/**
 * What is plotted before a person has chosen: the value of a joint that has one, or its place; the
 * first values where there is no place.
 */
function usualOf(quantities: Quantity[]): Set<string> {
  const own = quantities.filter(({channel}) => channel !== '');
  const isAll = own.length === 1 || own.length === quantities.length;
  return new Set(isAll ? own.slice(0, kFewCurves).map(({key}) => key) : ['x', 'y', 'z']);
}

/** Makes the panel. */
export function makeCurvesPanel({store, core}: PanelContext): HTMLElement {
  const cache = makeSeriesCache(core);
  /** What a person has chosen; null: nothing yet. */
  let chosen: Set<string> | null = null;
  const isChosen = (key: string, of: Quantity[]) => (chosen ?? usualOf(of)).has(key);
  let x: XAxis = 'frames';
  let zoomed: Range | null = null;
  let whole: Range = [0, 1];
  let plots: {plot: Plot; group: PlottedGroup; values: HTMLElement[]}[] = [];

  const title = el('h2');
  const chips = el('div', {class: 'chips', attributes: {role: 'group'}});
  const bar = el('div', {class: 'bar'});
  const body = el('div', {class: 'plots'});
  const hint = el('p', {class: 'hint'});

  const showRange = () => {
    for (const {plot} of plots) plot.zoom(zoomed ?? whole);
    reset.disabled = zoomed === null;
  };
  const zoom = ([min, max]: Range) => {
    const [first, last] = whole;
    const size = Math.min(max - min, last - first);
    const begin = Math.max(first, Math.min(last - size, min));
    zoomed = size < last - first && size > 0 ? [begin, begin + size] : null;
    showRange();
  };
  const zoomBy = (factor: number) => {
    const [min, max] = zoomed ?? whole;
    const active = activeMotion(store.state);
    if (active === undefined) return;
    const now = xOfFrame(x, active, active, shownFrame(active, store.state.seconds));
    const centre = now >= min && now <= max ? now : (min + max) / 2;
    zoom([centre + (min - centre) * factor, centre + (max - centre) * factor]);
  };
  const reset = button('', () => zoom(whole), {disabled: true});

  const seek = (place: number) => {
    const active = activeMotion(store.state);
    if (active !== undefined) goToFrame(store, frameAtX(x, active, place));
  };

  /** Moves the marks, and writes the values of the shown frames. */
  const follow = () => {
    const active = activeMotion(store.state);
    if (active === undefined) return;
    const {seconds} = store.state;
    const now = xOfFrame(x, active, active, shownFrame(active, seconds));
    for (const {plot, group, values} of plots) {
      plot.mark(now);
      group.lines.forEach(({motion, values: numbers}, index) => {
        values[index].textContent = shortNumber(numbers[shownFrame(motion, seconds)]);
      });
    }
  };

  const drawGroup = (group: PlottedGroup, active: OpenMotion, several: boolean) => {
    const plot = makePlot(group.data, group.lines, zoomed ?? whole, {
      seek,
      zoom,
      reset: () => zoom(whole),
    });
    const values = group.lines.map(() => el('span', {class: 'number'}));
    const keys = group.lines.map(({motion, quantity, colour, dash}, index) => {
      const swatch = el('span', {class: dash.length > 0 ? 'dash dashed' : 'dash'});
      swatch.style.borderColor = colour;
      const label = labelOf(quantity);
      const text = several ? `${label} ${fullName(motion)}` : label;
      return el('span', {class: 'legend-key', title: text}, [
        swatch,
        el('span', {class: 'text'}, [text]),
        values[index],
      ]);
    });
    const bounds = group.lines.flatMap(({motion, quantity: {limits}, colour}) => {
      if (motion !== active || limits.every((limit) => limit === undefined)) return [];
      const [lower, upper] = limits.map((limit) => (limit === undefined ? '' : shortNumber(limit)));
      const swatch = el('span', {class: 'dash dashed'});
      swatch.style.borderColor = colour;
      const text = `${t('limits')} ${lower} … ${upper}`;
      return [el('span', {class: 'legend-key limits'}, [swatch, text])];
    });
    const unit = unitOf(group.measure, active);
    const caption = t(`measure_${group.measure}`) + (unit ? ` [${unit}]` : '');
    plots.push({plot, group, values});
    return el('figure', {attributes: {'aria-label': caption}}, [
      el('figcaption', {}, [
        el('h3', {}, [caption]),
        el('div', {class: several ? 'legend several' : 'legend'}, [...keys, ...bounds]),
      ]),
      plot.root,
    ]);
  };

  const redraw = latestOnly<Readonly<State>>(async (state) => {
    const active = activeMotion(state);
    const quantities = active ? quantitiesOf(active.document, state.joint) : [];
    const wanted = quantities.filter(({key}) => isChosen(key, quantities));
    const groups = await plottedGroups(cache, state, wanted, x);
    for (const {plot} of plots) plot.dispose();
    plots = [];
    if (active === undefined || groups.length === 0) return body.replaceChildren(nothing(state));
    whole = wholeX(groups);
    const several = plottedMotions(state).length > 1;
    body.replaceChildren(...groups.map((group) => drawGroup(group, active, several)));
    zoom(zoomed ?? whole);
    follow();
  });

  /** Why there is no plot. */
  const nothing = (state: Readonly<State>) => {
    const active = activeMotion(state);
    if (active === undefined) return el('p', {class: 'empty'}, [t('no_motion')]);
    if (active.document.time.is_still) return el('p', {class: 'empty'}, [t('still_has_no_curves')]);
    return el('p', {class: 'empty'}, [t(state.joint < 0 ? 'choose_joint' : 'choose_curves')]);
  };

  const toggle = (key: string, of: Quantity[]) => {
    const now = chosen ?? usualOf(of);
    chosen = new Set(now.has(key) ? [...now].filter((own) => own !== key) : [...now, key]);
    draw(store.state);
    chips.querySelector<HTMLElement>(`[data-key="${CSS.escape(key)}"]`)?.focus();
  };

  const chip = (quantity: Quantity, _: number, all: Quantity[]) => {
    const {key} = quantity;
    const made = button(labelOf(quantity), () => toggle(key, all), {
      class: 'chip',
      pressed: isChosen(key, all),
    });
    made.dataset.key = key;
    return made;
  };

  const drawBar = () => {
    const choice = (own: XAxis) => el('option', {value: own, selected: own === x}, [t(`x_${own}`)]);
    const select = el(
      'select',
      {
        attributes: {'aria-label': t('x_axis')},
        on: {
          change: () => {
            x = select.value as XAxis;
            zoomed = null;
            redraw(store.state);
          },
        },
      },
      [choice('frames'), choice('seconds')],
    );
    reset.textContent = t('zoom_all');
    bar.replaceChildren(
      select,
      button('+', () => zoomBy(0.5), {title: t('zoom_in')}),
      button('−', () => zoomBy(2), {title: t('zoom_out')}),
      reset,
    );
    const isTouch = window.matchMedia('(pointer: coarse)').matches;
    hint.textContent = t(isTouch ? 'plot_hint_touch' : 'plot_hint');
  };

  const draw = (state: Readonly<State>) => {
    const active = activeMotion(state);
    const document = active?.document;
    const name = document?.joints[state.joint]?.name;
    cache.keep(state.motions);
    title.textContent = name ?? '';
    title.hidden = bar.hidden = hint.hidden = name === undefined;
    chips.setAttribute('aria-label', t('choose_curves'));
    const quantities = document && name !== undefined ? quantitiesOf(document, state.joint) : [];
    chips.replaceChildren(...quantities.map(chip));
    redraw(state);
  };

  whileOpen(store, 'curves', ['language'], drawBar);
  whileOpen(store, 'curves', ['motions', 'active', 'joint', 'language'], draw);
  whileOpen(store, 'curves', ['seconds'], follow);
  onTheme(() => openPanel(store.state) === 'curves' && redraw(store.state));
  const tools = el('div', {class: 'curve-tools'}, [title, chips, bar]);
  return el('section', {class: 'curves-panel'}, [tools, body, hint]);
}
