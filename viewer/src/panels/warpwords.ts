// SPDX-License-Identifier: MIT
// The words of a warp, as the core's table of warp options has them, and its keys in frames.
import type {Description, Step, WarpWords} from '../core/types.ts';

/** The new motion shows at `to` what the old one shows at `from`; frames. */
export interface Key {
  from: number;
  to: number;
}

const kDecimals = 1000;

/** A number with three decimals where it needs them. */
export const numberText = (value: number): string =>
  String(Math.round(value * kDecimals) / kDecimals);

/** The last step if it is a warp, otherwise a new one; and the steps before it. */
export function warpOf(steps: Step[]): {before: Step[]; words: WarpWords} {
  const last = steps[steps.length - 1];
  if (last !== undefined && 'warp' in last) return {before: steps.slice(0, -1), words: last.warp};
  return {before: steps, words: {}};
}

/** The keys of a warp, in frames. */
export function keysOf(words: WarpWords, frameTime: number): Key[] {
  const texts = [words.key ?? []].flat() as string[];
  const scale = words.seconds === true ? 1 / frameTime : 1;
  return texts
    .flatMap((text) => text.split(','))
    .map((text) => {
      const [from, to] = text.split(':').map(Number);
      return {from: from * scale, to: to * scale};
    });
}

/** The words with other keys. */
export function wordsWith(words: WarpWords, keys: Key[]): WarpWords {
  const {seconds: _, ...others} = words;
  return {...others, key: keys.map(({from, to}) => `${numberText(from)}:${numberText(to)}`)};
}

/** A word for a shell. */
const quoted = (word: string): string =>
  /^[\w./:=,+@%-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;

const extensionOf = (path: string): string => /\.[^./]+$/.exec(path)?.[0] ?? '';

/** The name of the file that a warp of a file is saved as. */
export function warpedName(path: string): string {
  const name = path.slice(path.lastIndexOf('/') + 1);
  const extension = extensionOf(name);
  return `${name.slice(0, name.length - extension.length)}_warped${extension}`;
}

/** The options of a warp as words of the command. */
export function optionsOf(words: WarpWords): string[] {
  return Object.entries(words).flatMap(([name, given]) => {
    if (given === false || given === '') return [];
    if (given === true) return [`--${name}`];
    return [given].flat().flatMap((word) => [`--${name}`, quoted(word)]);
  });
}

/** The command line that does the same. */
export function commandOf(document: Description, before: Step[], words: WarpWords): string {
  const {path, skeleton, project, options} = document;
  const reading = Object.entries(options).flatMap(([name, given]) => {
    if (given === true) return [`--${name}`];
    return typeof given === 'string' ? [`--${name}`, quoted(given)] : [];
  });
  if (skeleton) reading.push('--skeleton', quoted(skeleton));
  if (project) reading.push('--project', quoted(project));
  const commands: string[] = [];
  let input = path;
  before.forEach((step, index) => {
    const output = `step${index + 1}${extensionOf(path)}`;
    const done =
      'warp' in step
        ? ['warp', quoted(input), ...optionsOf(step.warp)]
        : ['edit', quoted(input), quoted(step.operation)];
    commands.push(['kinefile', ...done, ...reading, '-o', output].join(' '));
    input = output;
  });
  const last = ['kinefile', 'warp', quoted(input), ...optionsOf(words), ...reading];
  commands.push([...last, '-o', quoted(warpedName(path))].join(' '));
  return commands.join(' && ');
}
