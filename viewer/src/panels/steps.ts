// SPDX-License-Identifier: MIT
// Words of steps: of one operation, and of the commands that do the same.
import type {
  Description,
  FormatInfo,
  OperationForm,
  OperationInfo,
  Step,
  Tables,
  WarpWords,
} from '../core/types.ts';
import {extensionOf, stemOf} from '../paths.ts';
import type {OpenMotion} from '../state.ts';

/** The form in which an operation works on a document; null: it does not. */
export function formFor(operation: OperationInfo, {kind}: Description): OperationForm | null {
  if (kind === 'pose_flow') return operation.flow_form;
  if (kind === 'body_motion' && !operation.works_on_components) return null;
  if (kind === 'skeleton' && operation.needs_motion) return null;
  return operation.form;
}

/**
 * The word of an operation: NAME=FIRST, then each parameter after its separator; parameters
 * without a separator come last, by their names.
 */
export function operationWord(name: string, form: OperationForm, words: string[]): string {
  const placed = form.parameters.flatMap((info, index) => (info.separator ? [index] : []));
  const named = form.parameters.flatMap((info, index) => (info.separator ? [] : [index]));
  const isBare = placed.every(
    (index) => words[index] === '' && !form.parameters[index].is_required,
  );
  let word = name;
  if (!isBare) for (const index of placed) word += form.parameters[index].separator + words[index];
  for (const index of named) {
    if (words[index] !== '') word += `,${form.parameters[index].name}=${words[index]}`;
  }
  return word;
}

/** A word as a shell takes it. */
export const quoted = (word: string): string =>
  /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;

/** A name of a file as a shell and a command take it: it is no option. */
const fileWord = (path: string): string => quoted(path.startsWith('-') ? `./${path}` : path);

/** Words by the names of options as they are on a command line. */
function optionWords(words: Record<string, unknown>): string[] {
  return Object.entries(words).flatMap(([name, given]) => {
    const list = Array.isArray(given) ? given : [given];
    return list.flatMap((word) => {
      if (word === true) return [`--${name}`];
      return typeof word === 'string' && word !== '' ? [`--${name}`, quoted(word)] : [];
    });
  });
}

/** A step as people read it, in the words of the command line. */
export const stepText = (step: Step): string =>
  'operation' in step ? step.operation : ['warp', ...optionWords(step.warp)].join(' ');

/** What a file does not say itself must be said again of what was made of it. */
const kSaidOfEveryFile = ['unit-in', 'up-in'];

/** The options with which the first command, or a later one, reads. */
function readingWords(document: Description, isFirst: boolean): string[] {
  const {skeleton, project, options} = document;
  const kept = Object.entries(options).filter(
    ([name]) => isFirst || kSaidOfEveryFile.includes(name),
  );
  const words = Object.fromEntries(kept.map(([name, word]) => [name, word]));
  const files = [
    ...(skeleton ? ['--skeleton', fileWord(skeleton)] : []),
    ...(project ? ['--project', fileWord(project)] : []),
  ];
  return [...files, ...optionWords(words)];
}

/** A run of operations, or a warp: what one command does. */
type Run = {edit: string[]} | {warp: WarpWords};

function runsOf(steps: Step[]): Run[] {
  const runs: Run[] = [];
  for (const step of steps) {
    const last = runs[runs.length - 1];
    if ('warp' in step) runs.push(step);
    else if (last !== undefined && 'edit' in last) last.edit.push(step.operation);
    else runs.push({edit: [step.operation]});
  }
  return runs;
}

/** What a name says of the steps that were done. */
function suffixOf(steps: Step[]): string {
  const last = steps[steps.length - 1];
  if (last === undefined) return '';
  return 'warp' in last ? '_warped' : '_edited';
}

/** The name that the page proposes for what was made of a motion. */
export const outputName = ({document, steps}: OpenMotion, extension?: string): string =>
  `${stemOf(document.path)}${suffixOf(steps)}${extension ?? extensionOf(document.path)}`;

/** The words of the command that makes a file from what has been done: without steps, a conversion. */
function lastCommand(
  document: Description,
  [input, out]: [string, string],
  isPlayed: boolean,
  isFirst: boolean,
): string[] {
  const servoMap = document.servo_map ? ['--servo-map', fileWord(document.servo_map)] : [];
  return [
    'kinefile',
    isPlayed ? 'run' : 'convert',
    fileWord(input),
    ...(isPlayed ? servoMap : []),
    ...readingWords(document, isFirst),
    '-o',
    fileWord(out),
  ];
}

/** The commands that do what was done to a motion, for a shell. */
export function commandLine({document, steps}: OpenMotion, out: string): string {
  const extension = extensionOf(document.path);
  const runs = runsOf(steps);
  // Operations keep the kind of a file; what a flow's robot does is another file.
  const isPlayed = document.kind === 'pose_flow' && extensionOf(out) !== extension;
  const between = (index: number) => `${stemOf(document.path)}.step${index + 1}${extension}`;
  const inputOf = (index: number) => (index === 0 ? document.path : between(index - 1));
  const commands = runs.map((run, index) => {
    const isLast = index === runs.length - 1 && !isPlayed;
    return [
      'kinefile',
      'warp' in run ? 'warp' : 'edit',
      fileWord(inputOf(index)),
      ...('warp' in run ? optionWords(run.warp) : run.edit.map(quoted)),
      ...readingWords(document, index === 0),
      '-o',
      fileWord(isLast ? out : between(index)),
    ].join(' ');
  });
  if (runs.length === 0 || isPlayed) {
    commands.push(
      lastCommand(document, [inputOf(runs.length), out], isPlayed, runs.length === 0).join(' '),
    );
  }
  return commands.join(' &&\n');
}

/** The format of a document, in the table. */
export const formatOf = (tables: Tables, {format}: Description): FormatInfo | undefined =>
  tables.formats.find(({name}) => name === format);
