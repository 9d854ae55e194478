// SPDX-License-Identifier: MIT
// Where the selected joint is at the shown frame, and the numbers that put it there.
import {isFailure} from '../core/core.ts';
import type {Description, Dof, JointAnswer, Num} from '../core/types.ts';
import {el} from '../elements.ts';
import {activeMotion, type OpenMotion} from '../state.ts';
import {shownFrame} from '../times.ts';
import {t} from '../words.ts';
import {type PanelContext, whileOpen} from './context.ts';
import {copyButton} from './copying.ts';
import {latestOnly} from './latest.ts';
import {angleUnit, groupedNumber, inMetres, lengthUnit, shortNumber} from './numbers.ts';

interface Wanted {
  motion: OpenMotion;
  joint: number;
  frame: number;
}

/** A row of a table: a label, a number, its unit. */
const row = (label: string, value: Num, unit: string, note = ''): HTMLElement =>
  el('tr', {}, [
    el('th', {scope: 'row'}, [label]),
    el('td', {class: 'value'}, [groupedNumber(value)]),
    el('td', {class: 'value-unit'}, [unit]),
    el('td', {class: 'value-note'}, [note]),
  ]);

const table = (caption: string, values: Num[], rows: HTMLElement[]): HTMLElement =>
  el('section', {class: 'values'}, [
    el('header', {}, [el('h3', {}, [caption]), copyButton('copy', () => values.join(' '))]),
    el('table', {attributes: {'aria-label': caption}}, [el('tbody', {}, rows)]),
  ]);

const unitOf = (document: Description, joint: number, channel: number): string => {
  const measure = document.joints[joint].channels?.[channel]?.measure;
  if (measure === 'length') return lengthUnit(document);
  return measure === 'angle' ? angleUnit(document) : '';
};

const kAxes = ['x', 'y', 'z'];

/** An axis by its name, another one as numbers. */
function axisText(axis: Num[]): string {
  const values = axis.map(Number);
  const own = values.findIndex((value) => Math.abs(value) === 1);
  if (own >= 0) return `${values[own] < 0 ? '−' : ''}${kAxes[own]}`;
  return `(${values.map(shortNumber).join(' ')})`;
}

const kUnits: Record<string, string> = {deg: '°'};

/** How a joint of a robot moves, how far it may, and whether it is beyond that. */
function dofTable(dof: Dof, {value, beyond}: {value: Num; beyond: string | null}): HTMLElement {
  const {kind, axis, lower, upper, max_speed, id} = dof;
  const unit = kUnits[dof.unit] ?? dof.unit;
  const text = (label: string, what: string, of: string, note = '') =>
    el('tr', {}, [
      el('th', {scope: 'row'}, [label]),
      el('td', {class: 'value number'}, [what]),
      el('td', {class: 'value-unit'}, [of]),
      el('td', {class: 'value-note'}, [note]),
    ]);
  const way = t(kind === 'rotation' ? 'turns_about' : 'moves_along', axisText(axis));
  const side = beyond === null ? '' : t(beyond === 'below' ? 'below_limit' : 'above_limit');
  // Every digit is among the channels below.
  const now = text(way, shortNumber(value), unit, side);
  if (beyond !== null) now.classList.add('beyond');
  const bound = (limit: number | null, none: string) =>
    limit === null ? none : shortNumber(limit);
  const hasLimits = lower !== null || upper !== null;
  const rows = [
    now,
    ...(hasLimits ? [text(t('limits'), `${bound(lower, '−∞')} … ${bound(upper, '∞')}`, unit)] : []),
    ...(max_speed === null ? [] : [text(t('top_speed'), shortNumber(max_speed), `${unit}/s`)]),
    ...(id === null ? [] : [text(t('joint_id'), String(id), '')]),
  ];
  return table(t('robot_joint'), [value], rows);
}

/** Makes the readout. */
export function makeReadout({store, core}: PanelContext): HTMLElement {
  const root = el('div', {class: 'readouts', hidden: true, tabIndex: 0, role: 'region'});
  const title = el('h2');
  const parts = el('div');
  root.append(title, parts);

  const show = ({motion, joint, frame}: Wanted, answer: JointAnswer) => {
    const {document} = motion;
    const {position, rotation, channels} = answer;
    const name = document.joints[joint].name || t('nameless');
    root.setAttribute('aria-label', name);
    title.replaceChildren(name, el('span', {class: 'at-frame'}, [t('at_frame', frame)]));
    const tables = [
      table(
        t('world_position'),
        position,
        position.map((value, axis) =>
          row('xyz'[axis], value, lengthUnit(document), inMetres(document, value)),
        ),
      ),
      table(
        t('channels'),
        channels.map(({value}) => value),
        channels.map(({name, value}, index) => row(name, value, unitOf(document, joint, index))),
      ),
      table(
        t('world_rotation'),
        rotation,
        rotation.map((value, axis) => row('wxyz'[axis], value, '')),
      ),
    ];
    const ways = document.joints[joint].dofs ?? [];
    const found = answer.dofs ?? [];
    parts.replaceChildren(
      ...ways.flatMap((dof, index) => (index in found ? [dofTable(dof, found[index])] : [])),
      // What has no figure has no place.
      ...(document.lacks !== ''
        ? [tables[1]]
        : channels.length > 0
          ? tables
          : [tables[0], tables[2]]),
    );
  };

  const update = latestOnly<Wanted>(async (wanted) => {
    const {motion, joint, frame} = wanted;
    const answer = await core.ask('joint', {handle: motion.handle, joint, frame});
    const now = activeMotion(store.state);
    const isStale = now?.handle !== motion.handle || now.version !== motion.version;
    if (isStale || store.state.joint !== joint || isFailure(answer)) return;
    if (answer.position !== undefined) show(wanted, answer);
  });

  // A number that is being copied must not go away: only another frame draws it again.
  let last: Partial<Wanted> & {language?: string} = {};
  whileOpen(store, 'joints', ['seconds', 'joint', 'motions', 'active', 'language'], (state) => {
    const motion = activeMotion(state);
    const {joint, language} = state;
    root.hidden = motion === undefined || motion.document.joints[joint] === undefined;
    if (motion === undefined || root.hidden) return;
    const frame = shownFrame(motion, state.seconds);
    const isSame =
      last.motion?.document === motion.document && last.joint === joint && last.frame === frame;
    if (isSame && last.language === language) return;
    last = {motion, joint, frame, language};
    update({motion, joint, frame});
  });
  return root;
}
