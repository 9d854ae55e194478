// SPDX-License-Identifier: MIT
// Numbers as people read them. A grouped number has every digit of the double; what is copied from
// it has no gaps, since the groups are set apart by style alone.
import type {Description, Num} from '../core/types.ts';
import {el} from '../elements.ts';
import {t} from '../words.ts';

const inThrees = (digits: string, fromRight: boolean): string[] => {
  const first = fromRight ? digits.length % 3 : 0;
  const groups = first > 0 ? [digits.slice(0, first)] : [];
  for (let at = first; at < digits.length; at += 3) groups.push(digits.slice(at, at + 3));
  return groups;
};

/** The shortest text that is this double, its digits in groups of three. */
export function groupedNumber(value: Num): HTMLElement {
  const text = String(value);
  const parts = /^(-?)(\d+)(?:\.(\d+))?(e.*)?$/.exec(text);
  if (parts === null) return el('span', {class: 'number'}, [text]);
  const [, sign, whole, fraction, exponent] = parts;
  const spans = (groups: string[]) =>
    groups.map((group, index) => el('span', index > 0 ? {class: 'digits'} : {}, [group]));
  return el('span', {class: 'number'}, [
    sign,
    ...spans(inThrees(whole, true)),
    ...(fraction === undefined ? [] : ['.', ...spans(inThrees(fraction, false))]),
    exponent ?? '',
  ]);
}

/** A number with six significant digits at most. */
export const shortNumber = (value: Num): string =>
  typeof value === 'number' ? String(Number(value.toPrecision(6))) : value;

const kUnitNames: [number, string][] = [
  [1, 'm'],
  [0.01, 'cm'],
  [0.001, 'mm'],
  [0.0254, 'inch'],
];

/** The name of a unit of length, by its size in metres; null: it has none. */
export const unitName = (metres: number): string | null =>
  kUnitNames.find(([size]) => Math.abs(size - metres) < 1e-9 * size)?.[1] ?? null;

/** What lengths of a file are in: its unit's name where the file says it, otherwise "units". */
export const lengthUnit = (document: Description): string =>
  unitName(document.metres_per_unit) ?? t('length_units');

/** What angles of a file are in. */
export const angleUnit = (document: Description): string =>
  document.angle_unit === 'degrees' ? '°' : 'rad';

/**
 * A length of a file in metres, for people; empty where the unit is the metre anyway, or nothing
 * good is known of it. A guess says that it is one.
 */
export function inMetres(document: Description, length: Num): string {
  const {metres, certainty} = document.unit;
  if (certainty === 'doubtful' || metres === 1 || typeof length !== 'number') return '';
  const text = `${(length * metres).toFixed(4)} m`;
  return certainty === 'known' ? text : `≈ ${text}`;
}
