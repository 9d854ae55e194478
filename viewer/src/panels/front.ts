// SPDX-License-Identifier: MIT
// Which axis of its file a figure faces: what the core found, or what a person says.
import type {Description} from '../core/types.ts';
import {el} from '../elements.ts';
import type {Front, OpenMotion} from '../state.ts';
import {t} from '../words.ts';

const kAxes = ['x', 'y', 'z'];

/** A direction along an axis by its name, others as numbers. */
function directionText({facing}: Description): string {
  const {direction} = facing;
  if (direction === null) return t('not_known');
  const values = direction.map(Number);
  const axis = values.findIndex((value) => Math.abs(value) > 0.999);
  if (axis >= 0) return `${values[axis] > 0 ? '+' : '−'}${kAxes[axis]}`;
  return values.map((value) => value.toFixed(2)).join(' ');
}

/** The directions along the ground, by the axis that points up. */
const frontsOf = ({up}: Description): Front[] =>
  kAxes
    .filter((_, axis) => axis !== up.axis)
    .flatMap((axis): Front[] => [`+${axis}` as Front, `-${axis}` as Front]);

/** A choice of the front of a motion. */
export function frontSelect(
  {document, front}: OpenMotion,
  choose: (front: Front | null) => void,
): HTMLSelectElement {
  const select = el(
    'select',
    {
      name: 'front',
      attributes: {'aria-label': t('fact_facing')},
      on: {change: () => choose((select.value as Front) || null)},
    },
    [
      el('option', {value: ''}, [t('front_found', directionText(document))]),
      ...frontsOf(document).map((one) =>
        el('option', {value: one, selected: one === front}, [one.replace('-', '−')]),
      ),
    ],
  );
  return select;
}
