// SPDX-License-Identifier: MIT
// What the file is, what is known of its axes and units, and how it is read.
import type {Description, OptionInfo} from '../core/types.ts';
import {el} from '../elements.ts';
import {baseName, extensionOf} from '../paths.ts';
import {activeMotion, type OpenMotion, type State, withMotion} from '../state.ts';
import {numFrames} from '../times.ts';
import {fromCore, t} from '../words.ts';
import {type PanelContext, whileOpen} from './context.ts';
import {hintsOf} from './diagnostic.ts';
import {makeField, selectOf} from './fields.ts';
import {frontSelect} from './front.ts';
import {angleUnit, inMetres, lengthUnit, shortNumber, unitName} from './numbers.ts';
import {formatOf} from './steps.ts';

/** `--lenient` is of the command, and so in no table. */
const lenientOption = (): OptionInfo => ({
  name: 'lenient',
  type: 'flag',
  value_name: '',
  help: t('lenient_help'),
  default: '',
  is_required: false,
  separator: '',
  choices: [],
  least: null,
  most: null,
});

type Fact = [label: string, value: string | HTMLElement, note?: string];

const kAxes = ['x', 'y', 'z'];

const certainty = (own: 'known' | 'clear' | 'doubtful', reason: string): string =>
  reason ? t('with_reason', t(`certainty_${own}`), fromCore(reason)) : t(`certainty_${own}`);

function factsOf(document: Description, front: HTMLElement): Fact[] {
  const {time, extent, up, facing, unit, height} = document;
  const rate = time.frame_time > 0 ? shortNumber(1 / time.frame_time) : t('not_known');
  const facts: Fact[] = [
    [t('fact_file'), document.path],
    [t('fact_kind'), t(`kind_${document.kind}`)],
    ...(document.lacks === '' ? [[t('fact_joints'), String(document.joints.length)] as Fact] : []),
    [t('fact_channels'), String(document.num_coordinates)],
  ];
  if (!time.is_still) {
    const first = time.first_frame_number;
    facts.push(
      [t('fact_frames'), String(numFrames(time)), first === 0 ? '' : t('first_number', first)],
      [t('fact_rate'), t('per_second', rate), `${shortNumber(time.frame_time)} s`],
      [t('fact_duration'), `${shortNumber(time.duration)} s`],
    );
  }
  if (document.lacks !== '') return facts;
  const name = unitName(unit.metres);
  const size = name === null ? `${shortNumber(unit.metres)} m` : `1 ${name}`;
  facts.push(
    [t('fact_unit'), t('unit_is', size), certainty(unit.certainty, unit.reason)],
    [t('fact_angles'), angleUnit(document)],
    [t('fact_up'), kAxes[up.axis], certainty(up.certainty, up.reason)],
    [t('fact_facing'), front, fromCore(facing.reason)],
    [
      t('fact_height'),
      `${shortNumber(height)} ${lengthUnit(document)}`,
      inMetres(document, height),
    ],
  );
  if (extent !== null) {
    const ranges = extent.min.map(
      (min, axis) => `${kAxes[axis]} ${shortNumber(min)} … ${shortNumber(extent.max[axis])}`,
    );
    facts.push([t('fact_extent'), ranges.join('\n'), lengthUnit(document)]);
  }
  return facts;
}

type Companion = 'skeleton' | 'servo_map' | 'project';

/** What a motion is read with where no file is named. */
function withoutText({kind, companions, project}: Description, key: Companion): string {
  const findsOwn = key === 'skeleton' && kind !== 'body_motion' && kind !== 'pose_flow';
  if (findsOwn && companions.length > 0) {
    return t('found_beside', companions.map(baseName).join(', '));
  }
  if (key === 'servo_map' && project !== '') return t('servo_map_of_project');
  return t(key === 'skeleton' && kind === 'body_motion' ? 'links_alone' : 'without_file');
}

const factList = (facts: Fact[]): HTMLElement =>
  el(
    'dl',
    {class: 'facts'},
    facts.flatMap(([label, value, note]) => [
      el('dt', {}, [label]),
      el('dd', {}, [value, ...(note ? [el('small', {}, [note])] : [])]),
    ]),
  );

/** Makes the panel. */
export function makeInfoPanel(context: PanelContext): HTMLElement {
  const {store, actions, core, tables} = context;
  const root = el('section', {class: 'info-panel scrolled'});
  const refusal = el('p', {class: 'refusal', attributes: {role: 'alert'}});

  /** Reads the file again; what the core says against it stands at the control. */
  const reopen = async (motion: OpenMotion, change: Partial<Description>, field: HTMLElement) => {
    const isDone = await actions.reopen(motion, change);
    refusal.textContent = isDone ? '' : store.state.message;
    if (isDone) return;
    field.append(refusal);
    refusal.scrollIntoView({block: 'nearest'});
    store.set({message: ''});
  };

  const optionField = (motion: OpenMotion, info: OptionInfo): HTMLElement => {
    const {options} = motion.document;
    const given = options[info.name];
    const field = makeField(info, given === true ? 'true' : String(given ?? ''));
    field.control.addEventListener('change', () => {
      const word = info.type === 'flag' ? field.word() === 'true' : field.word();
      const {[info.name]: _, ...others} = options;
      const changed = word ? {...others, [info.name]: word} : others;
      reopen(motion, {options: changed}, field.root);
    });
    return field.root;
  };

  /** Files of the page with one of some extensions, without the motion's own. */
  const filesWith = (motion: OpenMotion, extensions: string[]): string[] =>
    [...core.paths]
      .filter((path) => path !== motion.document.path)
      .filter((path) => extensions.includes(extensionOf(path).toLowerCase()))
      .sort();

  const companionField = (motion: OpenMotion, key: Companion, extensions: string[]) => {
    const now = motion.document[key];
    const files = filesWith(motion, extensions);
    if (now !== '' && !files.includes(now)) files.unshift(now);
    const select = selectOf(files, withoutText(motion.document, key), now);
    select.id = `companion-${key}`;
    const label = el('label', {htmlFor: select.id}, [t(`companion_${key}`)]);
    const field = el('div', {class: 'field'}, [label, select]);
    select.addEventListener('change', () => reopen(motion, {[key]: select.value}, field));
    return field;
  };

  /** What a motion is read with: the skeleton or the robot, and for a flow what moves it. */
  const companions = (motion: OpenMotion): HTMLElement[] => {
    const {kind} = motion.document;
    const isRobotMotion = kind === 'body_motion' || kind === 'pose_flow';
    if (!isRobotMotion && !formatOf(tables, motion.document)?.takes_skeleton) return [];
    const fits = tables.formats.filter(({is_read, is_written, takes_skeleton}) =>
      isRobotMotion ? is_read && !is_written : is_read && !takes_skeleton,
    );
    const fields = [
      companionField(
        motion,
        'skeleton',
        fits.flatMap(({extensions}) => extensions),
      ),
    ];
    if (kind === 'pose_flow') {
      fields.push(
        companionField(motion, 'servo_map', ['.yaml', '.yml']),
        companionField(motion, 'project', ['.rpj']),
      );
    }
    return [el('h2', {}, [t('read_with')]), ...fields];
  };

  const frontField = (motion: OpenMotion) =>
    frontSelect(motion, (front) =>
      store.set({motions: withMotion(store.state, motion.handle, {front})}),
    );

  const draw = (state: Readonly<State>) => {
    const motion = activeMotion(state);
    if (motion === undefined) {
      return root.replaceChildren(el('p', {class: 'empty'}, [t('no_motion')]));
    }
    const focused = (document.activeElement as HTMLInputElement | null)?.name;
    const format = formatOf(tables, motion.document);
    // A file that an option names is chosen among the files of the page, above.
    const options = (format?.read_options ?? []).filter(({type}) => type !== 'file');
    root.replaceChildren(
      el('h2', {}, [fromCore(format?.description ?? motion.document.format)]),
      factList(factsOf(motion.document, frontField(motion))),
      el('ul', {class: 'sentences'}, [
        ...motion.document.facts.map((fact) => el('li', {}, [fromCore(fact), ...hintsOf(fact)])),
        ...(motion.document.lacks ? [el('li', {}, [fromCore(motion.document.lacks)])] : []),
        ...(motion.document.has_place ? [] : [el('li', {}, [t('stands_at_origin')])]),
      ]),
      ...companions(motion),
      el('h2', {}, [t('read_options')]),
      el('p', {class: 'hint'}, [t('read_options_help')]),
      ...[...options, lenientOption()].map((info) => optionField(motion, info)),
    );
    if (focused) root.querySelector<HTMLElement>(`[name="${CSS.escape(focused)}"]`)?.focus();
  };

  let drawnFor: unknown[] = [];
  whileOpen(store, 'info', ['motions', 'active', 'language'], (state) => {
    const motion = activeMotion(state);
    const {handle, document, front} = motion ?? {};
    const wanted = [handle, document, front, state.language, core.paths.size];
    if (wanted.every((value, index) => value === drawnFor[index])) return;
    drawnFor = wanted;
    draw(state);
  });
  return root;
}
