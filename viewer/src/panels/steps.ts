// SPDX-License-Identifier: MIT
// Words of steps: of one operation, and of the commands that do the same.
import type {
  Description,
  FormatInfo,
  OperationForm,
  OperationInfo,
  OptionWords,
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

/** How a file is written: words by the names of options. */
export interface Writing {
  words: OptionWords;
  /** Whether only `convert` has all of them. */
  isConversion: boolean;
}

/** What `edit`, `warp` and `run` do not take of the options of a format, `convert` does. */
export function writingOf(tables: Tables, format: FormatInfo, words: OptionWords): Writing {
  const isOfConvert = (name: string) =>
    format.adapt_options.some((own) => own.name === name) ||
    tables.formats.some(({read_options}) => read_options.some((own) => own.name === name));
  return {words, isConversion: Object.keys(words).some(isOfConvert)};
}

/** A command: its name and what follows its input. */
interface Command {
  name: 'edit' | 'warp' | 'run' | 'convert';
  words: string[];
  /** The extension of what it writes, where another command follows. */
  extension: string;
}

/** The commands that do what was done to a motion, without names of files. */
function commandsOf(
  {document, steps}: OpenMotion,
  out: string,
  {isConversion}: Writing,
): Command[] {
  const extension = extensionOf(document.path);
  const commands = runsOf(steps).map((run): Command => {
    if ('warp' in run) return {name: 'warp', words: optionWords(run.warp), extension};
    return {name: 'edit', words: run.edit.map(quoted), extension};
  });
  // Operations keep the kind of a file; what a flow's robot does is another file.
  const isPlayed = document.kind === 'pose_flow' && extensionOf(out) !== extension;
  if (isPlayed) {
    const map = document.servo_map ? ['--servo-map', fileWord(document.servo_map)] : [];
    commands.push({name: 'run', words: map, extension: extensionOf(out)});
  }
  if (commands.length === 0 || isConversion) {
    commands.push({name: 'convert', words: [], extension});
  }
  return commands;
}

const kPlain: Writing = {words: {}, isConversion: false};

/** The commands that do what was done to a motion, for a shell. */
export function commandLine(motion: OpenMotion, out: string, writing: Writing = kPlain): string {
  const {document} = motion;
  const commands = commandsOf(motion, out, writing);
  let input = document.path;
  const lines = commands.map(({name, words, extension}, index) => {
    const isLast = index === commands.length - 1;
    const output = isLast ? out : `${stemOf(document.path)}.step${index + 1}${extension}`;
    // What a flow's robot does is no flow, and needs no project.
    const isMotion = commands.slice(0, index).some((earlier) => earlier.name === 'run');
    const read = isMotion ? {...document, project: ''} : document;
    const line = [
      'kinefile',
      name,
      fileWord(input),
      ...words,
      ...readingWords(read, index === 0),
      ...(isLast ? optionWords(writing.words) : []),
      '-o',
      fileWord(output),
    ];
    input = output;
    return line.join(' ');
  });
  return lines.join(' &&\n');
}

/** The format of a document, in the table. */
export const formatOf = (tables: Tables, {format}: Description): FormatInfo | undefined =>
  tables.formats.find(({name}) => name === format);
