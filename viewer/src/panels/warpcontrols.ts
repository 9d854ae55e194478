// SPDX-License-Identifier: MIT
// What surrounds the map of a warp: buttons, the options of the core's table, the selected key in
// numbers, what the core says against it.
import type {Actions} from '../actions.ts';
import {type Core, isFailure} from '../core/core.ts';
import type {OptionInfo, Tables} from '../core/types.ts';
import {el, offerFile} from '../elements.ts';
import {notify} from '../notify.ts';
import {activeMotion, type Store} from '../state.ts';
import {fromCore, t, translated, type Word} from '../words.ts';
import {type Icon, iconButton, titled} from './icons.ts';
import {commandLine, outputName} from './steps.ts';
import type {Warping} from './warping.ts';
import {type Key, numberText} from './warpwords.ts';

/** Keys are drawn, and the editor counts in frames. */
const kNotControls = new Set(['key', 'seconds']);
/** Eases that are offered; others can be typed. */
const kEases = ['smooth', 'smoother', 'in', 'out', 'in-out', 'in:3', 'bezier:0.4,0,0.6,1'];

/** The message that the fields are described by. */
const kFault = 'warp-fault';

/** A message stays so far away from the window's edges, in pixels. */
const kEdge = 8;

/** What the controls do with keys. */
export interface KeyActions {
  add(): void;
  remove(): void;
  selected(): number;
  replace(index: number, key: Key): void;
}

export interface WarpControls {
  bar: HTMLElement;
  /** Lies over the map: a drag must not move the map. */
  notes: HTMLElement;
  /** Shows what the warp is now. */
  show(): void;
}

type Control = {option: OptionInfo; field: HTMLInputElement | HTMLSelectElement};

const wordOf = (name: string): string => name.replaceAll('-', '_');

/** Copies a text; the page says that it did. */
async function copy(text: string, store: Store): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    notify(store, t('copied_text', text));
  } catch {
    store.set({message: text}); // to be copied by hand
  }
}

export function makeWarpControls(
  core: Core,
  tables: Tables,
  store: Store,
  actions: Actions,
  warping: Warping,
  keyActions: KeyActions,
): WarpControls {
  const controls: Control[] = [];
  const texts: [HTMLElement, Word][] = [];
  const labelled = <T extends HTMLElement>(element: T, word: Word): T => {
    texts.push([element, word]);
    return element;
  };
  const action = (word: Word, run: () => void) => {
    const made = el('button', {type: 'button', class: word, on: {click: run}});
    texts.push([made, word]);
    return made;
  };
  const withActive = (run: (motion: NonNullable<ReturnType<typeof activeMotion>>) => void) => {
    const motion = activeMotion(store.state);
    if (motion !== undefined) run(motion);
  };

  const title = el('strong', {class: 'warp-title'});
  const undo = iconButton('undo', () => withActive((motion) => actions.undo(motion)));
  const redo = iconButton('redo', () => withActive((motion) => actions.redo(motion)));
  const removeKey = iconButton('bin', keyActions.remove);
  const close = iconButton('close', () => store.set({isWarping: false}), {
    class: 'plain warp-close',
  });
  const addKey = action('warp_add', keyActions.add);
  const iconAction = (name: Icon, word: Word, run: () => void) => {
    const made = iconButton(name, run, {class: word});
    made.append(labelled(el('span', {class: 'wide'}), word));
    store.on(['language'], () => titled(made, t(word)));
    return made;
  };
  const copyButton = iconAction('copy', 'warp_copy', () => copyCommand());
  const saveButton = iconAction('save', 'warp_save', () => save());
  const numbers = {from: el('input'), to: el('input')};
  /** Fields of the selected key with what is no number. */
  let misread: HTMLInputElement[] = [];
  let shownKey: Key | undefined;
  for (const field of [numbers.from, numbers.to]) {
    Object.assign(field, {type: 'number', step: 'any', min: '0', className: 'key-number'});
    field.setAttribute('aria-describedby', kFault);
    field.addEventListener('change', () => {
      const key = {from: numbers.from.valueAsNumber, to: numbers.to.valueAsNumber};
      misread = [numbers.from, numbers.to].filter((own) => Number.isNaN(own.valueAsNumber));
      if (misread.length > 0) show();
      else keyActions.replace(keyActions.selected(), key);
    });
  }
  const keyNumbers = el('span', {class: 'key-numbers'}, [
    labelled(el('span', {class: 'wide'}), 'warp_old_frame'),
    numbers.from,
    '→',
    labelled(el('span', {class: 'wide'}), 'warp_new_frame'),
    numbers.to,
  ]);
  const options = el('span', {class: 'warp-options'});
  const more = el('details', {class: 'warp-more'}, [labelled(el('summary'), 'warp_options')]);
  const moreOptions = el('div', {class: 'warp-options'});
  more.append(moreOptions);
  const fault = el('p', {id: kFault, class: 'warp-fault', role: 'alert', hidden: true});
  const hint = labelled(el('p', {class: 'warp-help'}), 'warp_help');
  const notes = el('div', {class: 'warp-notes'}, [hint]);

  const save = () =>
    withActive(async (motion) => {
      const answer = await core.ask('write', {handle: motion.handle, name: outputName(motion)});
      if (isFailure(answer)) return store.set({message: answer.error.message});
      for (const file of answer.files) offerFile(file.name, file.bytes as BlobPart);
    });
  const copyCommand = () =>
    withActive((motion) => copy(commandLine(motion, outputName(motion)), store));

  const wordsNow = () => {
    const words = {...warping.words};
    for (const {option, field} of controls) {
      const given =
        field instanceof HTMLInputElement && field.type === 'checkbox'
          ? field.checked
          : field.value;
      if (given === false || given === '' || given === option.default) delete words[option.name];
      else words[option.name] = given;
    }
    return words;
  };

  const makeField = (option: OptionInfo): Control['field'] => {
    const changed = () => warping.set({words: wordsNow()});
    if (option.type === 'choice') {
      return el('select', {on: {change: changed}});
    }
    if (option.type === 'flag') return el('input', {type: 'checkbox', on: {change: changed}});
    const list = el(
      'datalist',
      {id: `warp-${option.name}-list`},
      kEases.map((value) => el('option', {value})),
    );
    const field = el('input', {type: 'text', autocomplete: 'off', on: {change: changed}}, []);
    field.setAttribute('list', list.id);
    moreOptions.append(list);
    return field;
  };

  const addControl = (option: OptionInfo) => {
    const field = makeField(option);
    field.dataset.option = option.name;
    controls.push({option, field});
    const label = el('span', {class: option.name === 'tail' ? 'wide' : ''});
    const isFirst = option.name === 'tail';
    field.setAttribute('aria-describedby', kFault);
    const place = el('span', {class: 'warp-field'}, [el('label', {}, [label, field])]);
    (isFirst ? options : moreOptions).append(place);
    store.on(['language'], () => {
      label.textContent = translated(`warp_${wordOf(option.name)}`, option.name);
      titled(field, `${label.textContent}: ${fromCore(option.help)}`);
      if (!(field instanceof HTMLSelectElement)) return;
      const {value} = field;
      field.replaceChildren(
        ...option.choices.map((choice) =>
          el('option', {value: choice}, [translated(`warp_${wordOf(choice)}`, choice)]),
        ),
      );
      field.value = value || option.default;
    });
  };
  for (const option of tables.warp_options) {
    if (!kNotControls.has(option.name)) addControl(option);
  }

  /** Moves what hangs at a field to the left, as far as the window's edge asks for. */
  const keepInside = () => {
    fault.style.left = '';
    if (fault.hidden || !fault.classList.contains('hangs')) return;
    const {left, right} = fault.getBoundingClientRect();
    const edge = document.documentElement.clientWidth - kEdge;
    const over = Math.min(right - edge, left - kEdge);
    if (over > 0) fault.style.left = `${fault.offsetLeft - over}px`;
  };
  window.addEventListener('resize', keepInside);

  /** Shows what is wrong at the field that it is about; else over the map. */
  const showFault = (key: Key | undefined) => {
    const refused = controls.filter(({option}) => warping.refusedOptions.includes(option.name));
    const isOfKey = misread.length > 0 || (refused.length === 0 && warping.fault !== '');
    const isBadKey = isOfKey && key !== undefined && warping.isRefused(key);
    for (const field of [numbers.from, numbers.to]) {
      field.setAttribute('aria-invalid', String(isBadKey || misread.includes(field)));
    }
    for (const control of controls) {
      control.field.setAttribute('aria-invalid', String(refused.includes(control)));
    }
    const text = misread.length > 0 ? t('warp_no_number') : fromCore(warping.fault);
    if (fault.textContent !== text) fault.textContent = text;
    fault.hidden = text === '';
    const option = misread.length > 0 ? undefined : refused[0]?.field;
    if (option !== undefined && moreOptions.contains(option)) more.open = true;
    const ofKey = key === undefined || fault.hidden ? notes : keyNumbers;
    const place = option?.closest<HTMLElement>('.warp-field') ?? ofKey;
    if (fault.parentElement !== place) place.append(fault);
    fault.classList.toggle('hangs', place !== notes && !moreOptions.contains(place));
    keepInside();
  };

  const show = () => {
    const motion = activeMotion(store.state);
    if (motion === undefined) return;
    title.textContent = t('warp_of', motion.title);
    undo.disabled = motion.done.length === 0;
    redo.disabled = motion.undone.length === 0;
    const key = warping.keys[keyActions.selected()];
    removeKey.disabled = key === undefined;
    keyNumbers.hidden = key === undefined;
    if (key !== shownKey) misread = [];
    shownKey = key;
    numbers.from.max = String(warping.numOld - 1);
    titled(numbers.from, t('warp_old_frame_to', warping.numOld - 1));
    if (key !== undefined) {
      for (const name of ['from', 'to'] as const) {
        const isLeft = document.activeElement === numbers[name] || misread.includes(numbers[name]);
        if (!isLeft) numbers[name].value = numberText(key[name]);
      }
    }
    for (const {option, field} of controls) {
      const word = warping.words[option.name];
      if (field instanceof HTMLInputElement && field.type === 'checkbox') {
        field.checked = word === true;
      } else if (document.activeElement !== field || field instanceof HTMLSelectElement) {
        field.value = typeof word === 'string' ? word : option.default;
      }
    }
    showFault(key);
    // What is shown is then the last warp that was taken, which is not what the controls say.
    saveButton.disabled = copyButton.disabled = !fault.hidden;
    hint.hidden = warping.keys.length > 0 || !fault.hidden;
  };

  store.on(['language'], () => {
    for (const [element, word] of texts) element.textContent = t(word);
    titled(undo, t('undo'));
    titled(redo, t('redo'));
    titled(removeKey, t('warp_remove'));
    titled(close, t('close'));
    titled(numbers.to, t('warp_new_frame'));
    show();
  });

  return {
    bar: el('div', {class: 'warp-bar'}, [
      title,
      addKey,
      removeKey,
      keyNumbers,
      options,
      more,
      el('span', {class: 'group end'}, [undo, redo, copyButton, saveButton]),
      close,
    ]),
    notes,
    show,
  };
}
