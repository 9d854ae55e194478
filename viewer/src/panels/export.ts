// SPDX-License-Identifier: MIT
// Files to save: the motion in any format, tables of positions, the file as it was given, a
// picture, and the command that does what was done here.
import {isFailure} from '../core/core.ts';
import type {Diagnostic, FormatInfo, OptionInfo, OptionWords, WrittenFile} from '../core/types.ts';
import {button, el, offerFile} from '../elements.ts';
import {extensionOf, stemOf} from '../paths.ts';
import {activeMotion, type OpenMotion, type State} from '../state.ts';
import {fromCore, t} from '../words.ts';
import {type PanelContext, whileOpen} from './context.ts';
import {copyButton} from './copying.ts';
import {diagnosticList} from './diagnostic.ts';
import {makeField} from './fields.ts';
import {latestOnly} from './latest.ts';
import {commandLine, formatOf, outputName, writingOf} from './steps.ts';

/** A name with another extension. */
const withExtension = (name: string, extension: string): string => stemOf(name) + extension;

/** Makes the panel. */
export function makeExportPanel(context: PanelContext): HTMLElement {
  const {store, core, tables, savePicture} = context;
  const root = el('section', {class: 'export-panel scrolled'});
  /** The formats that the active motion can be written in, and why it cannot in others. */
  let written: FormatInfo[] = [];
  let hindrances: Record<string, string> = {};
  const withPoses = tables.formats.filter(({writes_poses}) => writes_poses);
  /** What the last conversion said. */
  const told = el('div', {class: 'told', attributes: {role: 'status'}});
  let format = '';
  let name = '';
  /** What was entered for the options of each format. */
  const entered = new Map<string, OptionWords>();
  const formatNow = () => written.find((own) => own.name === format) as FormatInfo;
  const wordsNow = (): OptionWords => entered.get(format) ?? {};
  const command = (motion: OpenMotion): string =>
    commandLine(motion, name, writingOf(tables, formatNow(), wordsNow()));

  const tell = (text: string, diagnostics: Diagnostic[]) =>
    told.replaceChildren(
      ...(text === '' ? [] : [el('p', {}, [text])]),
      ...diagnosticList(diagnostics),
    );

  const offer = (files: WrittenFile[], diagnostics: Diagnostic[] = []) => {
    for (const file of files) offerFile(file.name, file.bytes as BlobPart);
    tell(t('saved', files.map((file) => file.name).join(', ')), diagnostics);
  };

  const save = async (motion: OpenMotion) => {
    const {handle} = motion;
    const answer = await core.ask('write', {handle, name, format, options: wordsNow()});
    if (isFailure(answer)) {
      const {error, diagnostics} = answer;
      tell(t('not_saved'), diagnostics.length > 0 ? diagnostics : [error]);
    } else offer(answer.files, answer.diagnostics);
  };

  const savePoses = async (motion: OpenMotion, {extensions}: FormatInfo) => {
    const own = `${withExtension(outputName(motion), '')}_positions${extensions[0]}`;
    const answer = await core.ask('write_poses', {handle: motion.handle, name: own});
    if (isFailure(answer)) tell(t('not_saved'), [answer.error]);
    else offer(answer.files);
  };

  const saveSource = async (path: string) => {
    const answer = await core.ask('source', {path});
    if (isFailure(answer) || answer.files.length === 0) tell(t('not_saved'), []);
    else offer(answer.files);
  };

  /** The options of the chosen format, folded; `tell` is called after a change. */
  const optionsPart = (tell: () => void): HTMLElement[] => {
    const {write_options, adapt_options} = formatNow();
    const infos = [...write_options, ...adapt_options];
    if (infos.length === 0) return [];
    const change = (info: OptionInfo, word: string) => {
      const {[info.name]: _, ...others} = wordsNow();
      const given = info.type === 'flag' ? true : word;
      entered.set(format, word === '' ? others : {...others, [info.name]: given});
      tell();
    };
    const fields = infos.map((info) => {
      const given = wordsNow()[info.name] ?? '';
      const field = makeField(info, given === true ? 'true' : String(given));
      field.control.addEventListener('input', () => change(info, field.word()));
      return field.root;
    });
    const isOpen = Object.keys(wordsNow()).length > 0;
    return [
      el('details', {class: 'write-options', open: isOpen}, [
        el('summary', {}, [t('write_options')]),
        ...fields,
      ]),
    ];
  };

  /** The formats that are not offered, folded, and what each of them needs. */
  const hinderedPart = (): HTMLElement[] => {
    const hindered = tables.formats.filter(({name: own}) => hindrances[own]);
    if (hindered.length === 0) return [];
    const rows = hindered.map(({extensions, name: own}) =>
      el('li', {}, [el('b', {}, [extensions[0]]), ` ${fromCore(hindrances[own])}`]),
    );
    const summary = el('summary', {}, [t('not_written_here', hindered.length)]);
    return [el('details', {class: 'hindered'}, [summary, el('ul', {}, rows)])];
  };

  const motionForm = (motion: OpenMotion): HTMLElement => {
    const shown = el('pre', {class: 'command', tabIndex: 0});
    const options = el('div');
    const commandPart = el('section', {}, [
      el('h2', {}, [t('command_line')]),
      el('p', {class: 'hint'}, [t('command_line_help')]),
      shown,
      copyButton('copy_command', () => command(motion)),
    ]);
    const showCommand = () => {
      shown.textContent = command(motion);
      // No command is needed to have the file as it is.
      const isAsItIs = motion.steps.length === 0 && Object.keys(wordsNow()).length === 0;
      commandPart.hidden = isAsItIs && motion.document.path.endsWith(name);
    };
    const showOptions = () => options.replaceChildren(...optionsPart(showCommand));
    const nameField = el('input', {
      type: 'text',
      id: 'export-name',
      value: name,
      spellcheck: false,
      on: {
        input: () => {
          name = nameField.value.trim();
          showCommand();
        },
      },
    });
    const select = el(
      'select',
      {
        id: 'export-format',
        on: {
          change: () => {
            format = select.value;
            nameField.value = name = withExtension(name, formatNow().extensions[0]);
            showOptions();
            showCommand();
          },
        },
      },
      written.map((own) =>
        el('option', {value: own.name, selected: own.name === format}, [
          `${own.extensions[0]}  ${fromCore(own.description)}`,
        ]),
      ),
    );
    showOptions();
    showCommand();
    return el(
      'form',
      {
        noValidate: true,
        on: {
          submit: (event: SubmitEvent) => {
            event.preventDefault();
            if (name !== '') save(motion);
          },
        },
      },
      [
        el('h2', {}, [t('export_motion')]),
        el('div', {class: 'field'}, [
          el('label', {htmlFor: select.id}, [t('export_format')]),
          select,
        ]),
        ...hinderedPart(),
        el('div', {class: 'field'}, [
          el('label', {htmlFor: nameField.id}, [t('export_name')]),
          nameField,
        ]),
        options,
        el('button', {type: 'submit', class: 'primary'}, [t('save')]),
        told,
        commandPart,
      ],
    );
  };

  /** The motion's own file, and those that it was read with. */
  const sources = ({document}: OpenMotion): string[] => {
    const {path, skeleton, servo_map, project} = document;
    return [path, skeleton, servo_map, project].filter((own) => own !== '');
  };

  const draw = (state: Readonly<State>) => {
    const motion = activeMotion(state);
    if (motion === undefined) {
      return root.replaceChildren(el('p', {class: 'empty'}, [t('no_motion')]));
    }
    const own = formatOf(tables, motion.document);
    const usual = written.find((one) => one === own) ?? written[0];
    if (!written.some((one) => one.name === format)) format = usual?.name ?? '';
    const isAsRead = format === own?.name;
    const first = formatNow()?.extensions[0] ?? '';
    name = outputName(motion, isAsRead ? extensionOf(motion.document.path) : first);
    const tablesOfPoses = withPoses.map((one) =>
      button(one.extensions[0].slice(1).toUpperCase(), () => savePoses(motion, one), {
        title: fromCore(one.description),
      }),
    );
    const pictures =
      savePicture === undefined
        ? []
        : [
            el('h2', {}, [t('export_picture')]),
            el('div', {class: 'bar'}, [button('PNG', () => savePicture())]),
          ];
    root.replaceChildren(
      ...(written.length > 0 ? [motionForm(motion)] : hinderedPart()),
      ...(motion.document.lacks === ''
        ? [
            el('h2', {}, [t('export_positions')]),
            el('p', {class: 'hint'}, [t('export_positions_help')]),
            el('div', {class: 'bar'}, tablesOfPoses),
          ]
        : []),
      ...pictures,
      el('h2', {}, [t('export_source')]),
      el('p', {class: 'hint'}, [t('export_source_help')]),
      el(
        'div',
        {class: 'bar'},
        sources(motion).map((path) => button(path, () => saveSource(path))),
      ),
    );
  };

  /** Asks what the motion can be written in, and draws. */
  const update = latestOnly<Readonly<State>>(async (state) => {
    const motion = activeMotion(state);
    if (motion === undefined) return draw(state);
    const answer = await core.ask('written_formats', {handle: motion.handle});
    const now = activeMotion(store.state);
    if (isFailure(answer) || now?.document !== motion.document) return;
    hindrances = answer.hindrances;
    written = tables.formats.filter(({name: own}) => hindrances[own] === '');
    draw(store.state);
  });

  let drawnFor: unknown[] = [];
  whileOpen(store, 'export', ['motions', 'active', 'language'], (state) => {
    const motion = activeMotion(state);
    const wanted = [motion?.handle, motion?.document, state.language];
    if (wanted.every((value, index) => value === drawnFor[index])) return;
    if (motion?.handle !== drawnFor[0]) {
      format = '';
      told.replaceChildren();
    }
    drawnFor = wanted;
    update(state);
  });
  return root;
}
