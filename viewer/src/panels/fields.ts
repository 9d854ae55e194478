// SPDX-License-Identifier: MIT
// A control for an entry of a table of options.
import type {OptionInfo} from '../core/types.ts';
import {el} from '../elements.ts';
import {fromCore, nameOf, t} from '../words.ts';

export interface Field {
  info: OptionInfo;
  root: HTMLElement;
  control: HTMLInputElement | HTMLSelectElement;
  /** The word that was entered; empty: none, or a flag that is off. */
  word(): string;
}

let lastId = 0;

/** A word of a choice, after what it is called in the page's language. */
function choiceText(word: string): string {
  const own = nameOf('choices', word);
  return own === word ? word : `${own} (${word})`;
}

/** A select of words; the first one stands for none of them. */
export function selectOf(words: string[], none: string | null, value: string): HTMLSelectElement {
  const all = none === null ? words : ['', ...words];
  return el(
    'select',
    {},
    all.map((word) =>
      el('option', {value: word, selected: word === value}, [choiceText(word) || (none ?? '')]),
    ),
  );
}

function controlOf(info: OptionInfo, value: string, files: string[]): Field['control'] {
  const {type, least, most, value_name: placeholder} = info;
  if (type === 'flag') return el('input', {type: 'checkbox', checked: value !== ''});
  if (type === 'choice') {
    const none = info.default ? t('default_is', info.default) : t('not_given');
    return selectOf(info.choices, info.is_required ? null : none, value);
  }
  if (type === 'file') return selectOf(files, files.length > 0 ? null : t('no_such_file'), value);
  const given = {value, placeholder: info.default || placeholder, autocomplete: 'off' as const};
  if (type === 'text') return el('input', {type: 'text', spellcheck: false, ...given});
  const control = el('input', {type: 'number', step: type === 'count' ? '1' : 'any', ...given});
  // The least positive double is a bound for the core; a step would count from it.
  if (least !== null && (Number.isInteger(least) || type === 'count')) control.min = String(least);
  if (most !== null) control.max = String(most);
  return control;
}

/** The name of an option in the page's language, and small the command's word for it. */
function labelOf(name: string): (Node | string)[] {
  const own = nameOf('options', name);
  return own === name ? [name] : [`${own} `, el('code', {}, [name])];
}

/** Makes a labelled control. `files`: those that a parameter of type file can name. */
export function makeField(info: OptionInfo, value: string, files: string[] = []): Field {
  const control = controlOf(info, value, files);
  control.id = `field-${++lastId}`;
  control.name = info.name;
  const help = el('small', {id: `${control.id}-help`}, [fromCore(info.help)]);
  control.setAttribute('aria-describedby', help.id);
  if (info.is_required) control.setAttribute('aria-required', 'true');
  const label = el('label', {htmlFor: control.id}, labelOf(info.name));
  const isFlag = info.type === 'flag';
  const root = el('div', {class: isFlag ? 'field flag' : 'field'}, [
    ...(isFlag ? [control, label] : [label, control]),
    help,
  ]);
  return {
    info,
    root,
    control,
    word: () => {
      if (isFlag) return (control as HTMLInputElement).checked ? 'true' : '';
      return control.value.trim();
    },
  };
}
