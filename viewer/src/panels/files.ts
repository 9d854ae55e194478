// SPDX-License-Identifier: MIT
// Files that are not open: those that wait, those that the core could not read, and why.
import type {Actions} from '../actions.ts';
import type {OpenedFile} from '../core/types.ts';
import {button, byId, el} from '../elements.ts';
import type {Store} from '../state.ts';
import {t, type Word} from '../words.ts';
import {iconButton} from './icons.ts';

const kWhats: Partial<Record<OpenedFile['what'], Word>> = {
  waiting: 'file_waiting',
  fault: 'file_fault',
  unknown: 'file_unknown',
};

/** The message that says why; a place in another file is said with it. */
function reasonOf({path, what, diagnostics}: OpenedFile): string {
  const worst = diagnostics.find((diagnostic) => diagnostic.severity === 'error') ?? diagnostics[0];
  if (worst === undefined) return t(kWhats[what] ?? 'file_unknown');
  const {file, line, code, message} = worst;
  const place = line > 0 ? `${file || path}:${line}: ` : '';
  return `${place}${message} [${code}]`;
}

/** Makes the list of files that are not open. */
export function makeFileList(store: Store, actions: Actions): void {
  const list = byId('files');
  const dismiss = (gone: OpenedFile[]) =>
    store.set({files: store.state.files.filter((file) => !gone.includes(file))});

  const open = (path: string) => actions.openPath(path);

  const row = (file: OpenedFile): HTMLElement =>
    el('li', {class: `file ${file.what}`}, [
      el('div', {class: 'file-head'}, [
        el('b', {title: file.path}, [file.path]),
        ...(file.what === 'unknown'
          ? []
          : [button(t(file.what === 'fault' ? 'try_again' : 'open'), () => open(file.path))]),
        iconButton('close', () => dismiss([file]), {title: t('dismiss'), class: 'plain'}),
      ]),
      el('p', {}, [reasonOf(file)]),
    ]);

  store.on(['files', 'language'], ({files}) => {
    const others = files.filter(({what}) => what === 'unknown');
    // One says what it is; many, as a folder has, are folded away.
    const unknown = others.length > 1 ? others : [];
    const told = files.filter((file) => !unknown.includes(file));
    list.hidden = files.length === 0;
    list.setAttribute('aria-label', t('files'));
    const parts: HTMLElement[] = [];
    if (told.length > 0) parts.push(el('ul', {}, told.map(row)));
    if (unknown.length > 0) {
      parts.push(
        el('details', {class: 'unknown'}, [
          el('summary', {}, [t('files_unknown', unknown.length)]),
          el(
            'ul',
            {},
            unknown.map(({path}) => el('li', {}, [path])),
          ),
          button(t('dismiss'), () => dismiss(unknown)),
        ]),
      );
    }
    list.replaceChildren(...parts);
  });
}
