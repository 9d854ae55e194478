// SPDX-License-Identifier: MIT
// A message about a file: its place, its sentence, the line, and what its code means.
import type {Diagnostic} from '../core/types.ts';
import {button, el} from '../elements.ts';
import {fromCore, nameOf, t, type Word} from '../words.ts';

/** What docs/errors.md says of each code; the packer puts it in. */
declare const ERRORS: Record<string, [title: string, body: string]>;

const kMostAtOnce = 100;

/** Cuts a text at a byte of its UTF-8: before it, the letter there, after it. */
export function cutAtByte(text: string, byte: number): [string, string, string] {
  const encoder = new TextEncoder();
  let bytes = 0;
  let at = 0;
  for (const letter of text) {
    if (bytes >= byte) return [text.slice(0, at), letter, text.slice(at + letter.length)];
    bytes += encoder.encode(letter).length;
    at += letter.length;
  }
  return [text, ' ', ''];
}

/** FILE:LINE:COLUMN, as far as the place is known. */
export const placeOf = ({file, line, column}: Diagnostic): string =>
  [file, ...(line > 0 ? [line] : []), ...(line > 0 && column > 0 ? [column] : [])].join(':');

/** The line with the caret below its letter, also where letters are of different widths. */
function excerptOf({excerpt, caret}: Diagnostic): HTMLElement {
  const [before, letter, after] = cutAtByte(excerpt, caret);
  const mark = el('mark', {}, [letter]);
  const line = el('pre', {class: 'excerpt', tabIndex: 0}, [before, mark, after]);
  // A long line is shown where the fault is; that place is known when it is laid out.
  requestAnimationFrame(() => {
    line.scrollLeft = mark.offsetLeft - line.clientWidth / 2;
  });
  return line;
}

/** Markdown's emphasis and code, as elements. */
const inline = (text: string): (Node | string)[] =>
  text.split(/(`[^`]+`|\*[^*]+\*)/).map((part) => {
    if (part.startsWith('`')) return el('code', {}, [part.slice(1, -1)]);
    return /^\*.+\*$/.test(part) ? el('em', {}, [part.slice(1, -1)]) : part;
  });

/** What a code means: its title, then a paragraph for each sentence that starts a line. */
function explanation(code: string): HTMLElement | null {
  const found = ERRORS[code];
  if (found === undefined) return null;
  const [title, body] = found;
  const paragraphs = body.split(/\n(?=Cause:|Cure:|\*|\n)/).filter((part) => part.trim() !== '');
  return el('details', {}, [
    el('summary', {}, [`${code}: ${title}`]),
    ...paragraphs.map((part) => el('p', {}, inline(part.trim().replaceAll('\n', ' ')))),
  ]);
}

/** What a flag of the command, which a message names, is in the page. */
const kFlags: Record<string, Word> = {
  lenient: 'here_lenient',
  skeleton: 'here_companion',
  'servo-map': 'here_companion',
  project: 'here_companion',
  fps: 'here_reading',
  encoding: 'here_reading',
  positions: 'here_reading',
  'unit-in': 'here_reading',
  'up-in': 'here_reading',
  'timed-rounding': 'here_reading',
  'keep-times': 'here_reading',
};

/** What to do in the page where a message of the core names flags of the command. */
export function hintsOf(message: string): HTMLElement[] {
  const found = [...message.matchAll(/--([a-z]+(?:-[a-z]+)*)/g)].map(([, flag]) => flag);
  const hints = found.flatMap((flag) =>
    flag in kFlags ? [t(kFlags[flag], nameOf('options', flag))] : [],
  );
  return [...new Set(hints)].map((hint) => el('small', {class: 'here'}, [hint]));
}

/** What else belongs to a message: a button that goes to its frame. */
type Extra = (diagnostic: Diagnostic) => HTMLElement[];

function item(diagnostic: Diagnostic, extra: Extra): HTMLElement {
  const {severity, code, message, excerpt} = diagnostic;
  const explained = explanation(code);
  return el('li', {class: `diagnostic ${severity}`}, [
    el('p', {class: 'place'}, [
      el('span', {class: 'severity'}, [t(`severity_${severity}`)]),
      ` ${placeOf(diagnostic)}`,
    ]),
    el('p', {class: 'sentence'}, [fromCore(message)]),
    ...hintsOf(message),
    ...(excerpt !== '' ? [excerptOf(diagnostic)] : []),
    explained ?? el('span', {class: 'faint'}, [code]),
    ...extra(diagnostic),
  ]);
}

/** Messages as a list; none if there are none. A long list is shown in parts. */
export function diagnosticList(diagnostics: Diagnostic[], extra: Extra = () => []): HTMLElement[] {
  if (diagnostics.length === 0) return [];
  const list = el('ul', {class: 'diagnostics'});
  const showMore = (first: number) => {
    const next = first + kMostAtOnce;
    list.append(...diagnostics.slice(first, next).map((one) => item(one, extra)));
    const left = diagnostics.length - next;
    if (left <= 0) return;
    const more = el('li', {}, [
      button(t('show_more', left), () => {
        more.remove();
        showMore(next);
      }),
    ]);
    list.append(more);
  };
  showMore(0);
  return [list];
}
