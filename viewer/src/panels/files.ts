// SPDX-License-Identifier: MIT
// Files that are not open: motions that wait, files that the core could not read, and why, and
// quietly those that are no motions.
import type {Actions} from '../actions.ts';
import type {OpenedFile} from '../core/types.ts';
import {button, byId, el} from '../elements.ts';
import {inOrder} from '../paths.ts';
import type {State, Store} from '../state.ts';
import {fromCore, t} from '../words.ts';
import {iconButton} from './icons.ts';
import {kPhone} from './warp.ts';

/** So many figures have colours of their own. */
const kMostAtOnce = 8;

/** The message that says why; a place in another file is said with it. */
function reasonOf({path, what, diagnostics}: OpenedFile): string {
  const worst = diagnostics.find((diagnostic) => diagnostic.severity === 'error') ?? diagnostics[0];
  if (worst === undefined) return t(what === 'fault' ? 'file_fault' : 'file_unknown');
  const {file, line, code, message} = worst;
  const place = line > 0 ? `${file || path}:${line}: ` : '';
  return `${place}${fromCore(message)} [${code}]`;
}

/** The folder that all paths are in, with its slash. */
export function commonFolder(paths: string[]): string {
  const [first = ''] = paths;
  let length = first.lastIndexOf('/') + 1;
  while (length > 0 && !paths.every((path) => path.startsWith(first.slice(0, length)))) {
    length = first.lastIndexOf('/', length - 2) + 1;
  }
  return first.slice(0, length);
}

/** With what each open motion was read, as texts to compare. */
const openingsOf = ({motions}: Readonly<State>): string[] =>
  motions.map(({document: {path, skeleton, servo_map, project, options}}) =>
    JSON.stringify([path, skeleton, servo_map, project, options]),
  );

/** Makes the list of files that are not open. */
export function makeFileList(store: Store, actions: Actions): void {
  const list = byId('files');
  const dismiss = (gone: OpenedFile[]) =>
    store.set({files: store.state.files.filter((file) => !gone.includes(file))});
  const dismissal = (gone: OpenedFile[]) =>
    iconButton('close', () => dismiss(gone), {title: t('dismiss'), class: 'plain'});

  /** What was open when each file was refused. */
  const refusedBeside = new WeakMap<OpenedFile, Set<string>>();

  /** Whether something was opened, or read otherwise, since a file was refused. */
  const mayOpenNow = (file: OpenedFile): boolean => {
    const before = refusedBeside.get(file);
    return before !== undefined && openingsOf(store.state).some((text) => !before.has(text));
  };

  const fault = (file: OpenedFile): HTMLElement => {
    const {path, leniently} = file;
    const again = () => button(t('try_again'), () => actions.openListed([path]));
    const repair = () =>
      button(t('open_leniently'), () => actions.repair(file), {title: t('lenient_help')});
    return el('li', {class: 'file fault'}, [
      el('div', {class: 'file-head'}, [
        el('b', {title: path}, [path]),
        ...(leniently !== null ? [repair()] : mayOpenNow(file) ? [again()] : []),
        dismissal([file]),
      ]),
      el('p', {}, [reasonOf(file)]),
    ]);
  };

  // On a phone the list would hide the figure.
  let isUnfolded = !kPhone.matches;

  /** The motions and robots of a folder that are not open, one click each. */
  const waitingList = (waiting: OpenedFile[]): HTMLElement => {
    const paths = inOrder(waiting.map(({path}) => path));
    const numOpen = new Set(store.state.motions.map(({document}) => document.path)).size;
    const folder = commonFolder(paths);
    const here = waiting.some((file) => file.is_model) ? 'robots_here' : 'motions_here';
    const row = (path: string) =>
      button(path.slice(folder.length), () => actions.openListed([path]), {title: path});
    const section = el('details', {class: 'waiting', open: isUnfolded}, [
      el('summary', {title: folder}, [t(here, numOpen + paths.length, numOpen)]),
      el(
        'ul',
        {ariaLabel: t('files')},
        paths.map((path) => el('li', {}, [row(path)])),
      ),
      el('p', {class: 'group'}, [
        ...(numOpen + paths.length <= kMostAtOnce
          ? [button(t('open_all'), () => actions.openListed(paths))]
          : []),
        button(t('dismiss'), () => dismiss(waiting)),
      ]),
    ]);
    section.addEventListener('toggle', () => {
      isUnfolded = section.open;
    });
    return section;
  };

  /** What is said of the only file that was given. */
  const onlyOne = (file: OpenedFile): HTMLElement =>
    el('div', {class: 'file unknown'}, [
      el('div', {class: 'file-head'}, [
        el('b', {title: file.path}, [file.path]),
        dismissal([file]),
      ]),
      el('p', {}, [reasonOf(file)]),
    ]);

  /** One line; what each of them is, where reading was tried, on demand. */
  const others = (unknown: OpenedFile[]): HTMLElement => {
    const row = (file: OpenedFile) =>
      el('li', {}, [
        file.path,
        ...(file.diagnostics.length > 0 ? [el('small', {}, [reasonOf(file)])] : []),
      ]);
    return el('details', {class: 'unknown'}, [
      el('summary', {}, [t('files_unknown', unknown.length)]),
      el('ul', {}, unknown.map(row)),
      button(t('dismiss'), () => dismiss(unknown)),
    ]);
  };

  store.on(['files', 'motions', 'language'], ({files}, changed) => {
    const of = (what: OpenedFile['what']) => files.filter((file) => file.what === what);
    const [waiting, faults, unknown] = [of('waiting'), of('fault'), of('unknown')];
    // What is scrolled to and unfolded stays while motions move.
    const isSame = !changed.has('files') && !changed.has('language');
    for (const file of faults) {
      if (!refusedBeside.has(file)) refusedBeside.set(file, new Set(openingsOf(store.state)));
    }
    const numOpen = `${waiting.length && store.state.motions.length} ${faults.map(mayOpenNow)}`;
    if (isSame && list.dataset.open === numOpen) return;
    const {scrollTop = 0} = list.querySelector('.waiting ul') ?? {};
    list.dataset.open = numOpen;
    const isOnly = files.length === 1 && store.state.motions.length === 0;
    list.hidden = files.length === 0;
    list.setAttribute('aria-label', t('files'));
    list.replaceChildren(
      ...(waiting.length > 0 ? [waitingList(waiting)] : []),
      ...(faults.length > 0 ? [el('ul', {}, faults.map(fault))] : []),
      ...(unknown.length > 0 ? [isOnly ? onlyOne(unknown[0]) : others(unknown)] : []),
    );
    list.querySelector('.waiting ul')?.scrollTo(0, scrollTop);
  });
}
