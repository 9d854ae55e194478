// SPDX-License-Identifier: MIT
// What can be done to a motion, and what was done.
import type {OperationForm, OperationInfo, Step} from '../core/types.ts';
import {button, el} from '../elements.ts';
import {activeMotion, type OpenMotion, type State} from '../state.ts';
import {shownFrame} from '../times.ts';
import {fromCore, nameOf, t} from '../words.ts';
import {openOriginal} from './compare.ts';
import {type PanelContext, whileOpen} from './context.ts';
import {copyButton} from './copying.ts';
import {diagnosticList} from './diagnostic.ts';
import {type Field, makeField} from './fields.ts';
import {commandLine, formFor, operationWord, outputName, stepText} from './steps.ts';

/** What an operation is called: its name in the page's language, else what the core says it does. */
function labelOf({name, help}: OperationInfo): string {
  const own = nameOf('operations', name);
  return own === name ? help : own;
}

/** What an operation is called, small the command's word, and what it does if that is not said. */
function headOf(info: OperationInfo, {usage}: OperationForm): HTMLElement[] {
  const label = labelOf(info);
  return [
    el('span', {}, [el('b', {}, [label]), ' ', el('code', {}, [usage])]),
    ...(label === info.help ? [] : [el('span', {class: 'faint'}, [fromCore(info.help)])]),
  ];
}

/** Makes the panel. */
export function makeEditPanel({store, actions, core, tables}: PanelContext): HTMLElement {
  const root = el('section', {class: 'edit-panel scrolled'});
  const done = el('div');
  const search = el('input', {type: 'search', class: 'search'});
  const list = el('ul', {class: 'operations'});
  /** The operation whose form is open. */
  let open = '';
  let drawnFor: unknown[] = [];

  /** Fills the open form again; nothing in most of them. */
  let refill = () => {};

  /** A form for some frames is about the range that plays, if there is one. */
  const fillRange = (fields: Field[]) => {
    const [begin, end] = ['begin', 'end'].map((name) =>
      fields.find(({info}) => info.name === name && info.type === 'count'),
    );
    if (begin === undefined || end === undefined) return;
    refill = () => {
      const motion = activeMotion(store.state);
      const {loop} = store.state;
      const frames = motion && loop?.map((seconds) => shownFrame(motion, seconds));
      begin.control.value = frames === undefined ? '' : String(frames[0]);
      end.control.value = frames === undefined ? '' : String(frames[1] + 1);
    };
    if (store.state.loop !== null) refill();
  };

  /** Shows what the core says against a change, here and not in the page's bar. */
  const tellRefusal = (isDone: boolean, place: HTMLElement) => {
    place.textContent = isDone ? '' : store.state.message;
    if (!isDone) store.set({message: ''});
  };

  const formOf = (motion: OpenMotion, info: OperationInfo, form: OperationForm): HTMLElement => {
    // A file that changes the motion is another one than its own.
    const files = [...core.paths].filter((path) => path !== motion.document.path).sort();
    const fields: Field[] = form.parameters.map((parameter) => makeField(parameter, '', files));
    fillRange(fields);
    const refusal = el('p', {class: 'refusal', attributes: {role: 'alert'}});
    const apply = el('button', {type: 'submit', class: 'primary'}, [t('apply')]);
    return el(
      'form',
      {
        noValidate: true, // the core says what is wrong, and better
        on: {
          submit: async (event: SubmitEvent) => {
            event.preventDefault();
            const now = activeMotion(store.state);
            if (now === undefined) return;
            const words = fields.map((field) => field.word());
            const operation = operationWord(info.name, form, words);
            apply.disabled = true;
            tellRefusal(await actions.addStep(now, {operation}), refusal);
            apply.disabled = false;
          },
        },
      },
      [...fields.map((field) => field.root), apply, refusal],
    );
  };

  const item = (motion: OpenMotion, info: OperationInfo, form: OperationForm): HTMLElement => {
    const isOpen = open === info.name;
    const head = el(
      'button',
      {
        type: 'button',
        class: 'operation',
        attributes: {'aria-expanded': String(isOpen)},
        on: {
          click: () => {
            open = isOpen ? '' : info.name;
            drawList(store.state, true);
            const made = list.querySelector<HTMLElement>(`[data-name="${info.name}"]`);
            (made?.querySelector<HTMLElement>('form input, form select') ?? made)?.focus();
          },
        },
      },
      headOf(info, form),
    );
    const made = el('li', {}, isOpen ? [head, formOf(motion, info, form)] : [head]);
    head.dataset.name = info.name;
    made.dataset.name = info.name;
    return made;
  };

  /** Draws the list; the form in it stays while what it is for stays. */
  const drawList = (state: Readonly<State>, isForced = false) => {
    const motion = activeMotion(state);
    const {language} = state;
    const wanted = [motion?.handle, motion?.document.kind, language, search.value, core.paths.size];
    if (!isForced && wanted.every((value, index) => value === drawnFor[index])) return;
    drawnFor = wanted;
    refill = () => {};
    search.placeholder = t('search_operations');
    search.setAttribute('aria-label', t('search_operations'));
    search.hidden = list.hidden = motion === undefined;
    if (motion === undefined) return;
    const lower = search.value.trim().toLowerCase();
    const isFound = ({name, help}: OperationInfo) =>
      [name, help, nameOf('operations', name), fromCore(help)].some((text) =>
        text.toLowerCase().includes(lower),
      );
    const items = tables.operations.filter(isFound).flatMap((info) => {
      const form = formFor(info, motion.document);
      return form === null ? [] : [item(motion, info, form)];
    });
    list.replaceChildren(...(items.length > 0 ? items : [el('li', {}, [t('nothing_found')])]));
  };

  const stepName = (step: Step): string => {
    if ('warp' in step) return t('warp');
    const [word] = step.operation.split('=');
    const info = tables.operations.find(({name}) => name === word);
    return info === undefined ? word : labelOf(info);
  };

  const stepRow = (motion: OpenMotion, index: number, refusal: HTMLElement): HTMLElement => {
    const text = stepText(motion.steps[index]);
    const others = motion.steps.filter((_, other) => other !== index);
    const remove = button(
      '✕',
      async () => tellRefusal(await actions.setSteps(motion, others), refusal),
      {title: t('remove_step', text)},
    );
    remove.setAttribute('aria-label', t('remove_step', text));
    return el('li', {}, [
      el('span', {}, [`${stepName(motion.steps[index])} `, el('code', {}, [text])]),
      remove,
    ]);
  };

  const drawDone = (state: Readonly<State>) => {
    const motion = activeMotion(state);
    if (motion === undefined) {
      return done.replaceChildren(el('p', {class: 'empty'}, [t('no_motion')]));
    }
    const {steps, done: earlier, undone, diagnostics} = motion;
    const focused = (document.activeElement as HTMLElement | null)?.dataset.act;
    const refusal = el('p', {class: 'refusal', attributes: {role: 'alert'}});
    const rows = steps.map((_, index) => stepRow(motion, index, refusal));
    const undo = button(t('undo'), async () => tellRefusal(await actions.undo(motion), refusal), {
      disabled: earlier.length === 0,
    });
    const redo = button(t('redo'), async () => tellRefusal(await actions.redo(motion), refusal), {
      disabled: undone.length === 0,
    });
    const compare = button(t('compare'), () => openOriginal(store, actions, motion), {
      title: t('compare_help'),
      disabled: steps.length === 0,
    });
    done.replaceChildren(
      el('h2', {}, [t('steps_done')]),
      rows.length > 0
        ? el('ol', {class: 'steps'}, rows)
        : el('p', {class: 'faint'}, [t('nothing_done')]),
      el('div', {class: 'bar'}, [undo, redo, compare]),
      ...(steps.length > 0
        ? [
            el('div', {class: 'bar'}, [
              copyButton('copy_command', () => commandLine(motion, outputName(motion))),
            ]),
          ]
        : []),
      refusal,
      ...(steps.length > 0 ? diagnosticList(diagnostics) : []),
      el('h2', {}, [t('operations')]),
    );
    undo.dataset.act = 'undo';
    redo.dataset.act = 'redo';
    if (focused !== undefined) done.querySelector<HTMLElement>(`[data-act="${focused}"]`)?.focus();
  };

  search.addEventListener('input', () => drawList(store.state));
  whileOpen(store, 'edit', ['motions', 'active', 'language'], (state) => {
    drawDone(state);
    drawList(state);
  });
  whileOpen(store, 'edit', ['loop'], (_, changed) => changed.has('loop') && refill());
  root.append(done, search, list);
  return root;
}
