// SPDX-License-Identifier: MIT
// Files to save: the motion in any format, tables of positions, the file as it was given, a
// picture, and the command that does what was done here.
import {isFailure} from '../core/core.ts';
import type {Diagnostic, FormatInfo, WrittenFile} from '../core/types.ts';
import {button, el, offerFile} from '../elements.ts';
import {extensionOf, stemOf} from '../paths.ts';
import {activeMotion, type OpenMotion, type State} from '../state.ts';
import {fromCore, t} from '../words.ts';
import {type PanelContext, whileOpen} from './context.ts';
import {copyButton} from './copying.ts';
import {diagnosticList} from './diagnostic.ts';
import {commandLine, formatOf, outputName} from './steps.ts';

/** A name with another extension. */
const withExtension = (name: string, extension: string): string => stemOf(name) + extension;

/** Makes the panel. */
export function makeExportPanel(context: PanelContext): HTMLElement {
  const {store, core, tables, savePicture} = context;
  const root = el('section', {class: 'export-panel scrolled'});
  const written = tables.formats.filter(({is_written}) => is_written);
  const withPoses = tables.formats.filter(({writes_poses}) => writes_poses);
  /** What the last conversion said. */
  const told = el('div', {class: 'told', attributes: {role: 'status'}});
  let format = '';
  let name = '';

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
    const answer = await core.ask('write', {handle, name, format});
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

  const motionForm = (motion: OpenMotion): HTMLElement => {
    const command = el('pre', {class: 'command', tabIndex: 0});
    const commandPart = el('section', {}, [
      el('h2', {}, [t('command_line')]),
      el('p', {class: 'hint'}, [t('command_line_help')]),
      command,
      copyButton('copy_command', () => commandLine(motion, name)),
    ]);
    const showCommand = () => {
      command.textContent = commandLine(motion, name);
      // No command is needed to have the file as it is.
      commandPart.hidden = motion.steps.length === 0 && motion.document.path.endsWith(name);
    };
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
            const [extension] = written.find((own) => own.name === format)!.extensions;
            nameField.value = name = withExtension(name, extension);
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
        el('div', {class: 'field'}, [
          el('label', {htmlFor: nameField.id}, [t('export_name')]),
          nameField,
        ]),
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
    if (!written.some((one) => one.name === format)) format = own?.is_written ? own.name : 'bvh';
    const isAsRead = format === own?.name;
    const [first] = written.find((one) => one.name === format)!.extensions;
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
      motionForm(motion),
      el('h2', {}, [t('export_positions')]),
      el('p', {class: 'hint'}, [t('export_positions_help')]),
      el('div', {class: 'bar'}, tablesOfPoses),
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
    draw(state);
  });
  return root;
}
