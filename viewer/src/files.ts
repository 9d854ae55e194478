// SPDX-License-Identifier: MIT
// Files that come into the page: dropped, chosen, or carried by the page itself.
import type {GivenFile} from './actions.ts';
import {packedText} from './core/core.ts';
import {unpack} from './core/unpack.ts';

interface Found {
  path: string;
  file: File;
}

async function walkHandle(handle: FileSystemHandle, folder: string, found: Found[]): Promise<void> {
  const path = folder + handle.name;
  if (handle.kind === 'file') {
    found.push({path, file: await (handle as FileSystemFileHandle).getFile()});
    return;
  }
  const children = handle as FileSystemDirectoryHandle & {
    values(): AsyncIterable<FileSystemHandle>;
  };
  for await (const child of children.values()) await walkHandle(child, `${path}/`, found);
}

async function walkEntry(entry: FileSystemEntry, folder: string, found: Found[]): Promise<void> {
  const path = folder + entry.name;
  if (entry.isFile) {
    const file = await new Promise<File>((resolve, reject) =>
      (entry as FileSystemFileEntry).file(resolve, reject),
    );
    found.push({path, file});
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    // A call gives at most 100 of them.
    const children = await new Promise<FileSystemEntry[]>((resolve, reject) =>
      reader.readEntries(resolve, reject),
    );
    if (children.length === 0) return;
    for (const child of children) await walkEntry(child, `${path}/`, found);
  }
}

const readAll = (found: Found[]): Promise<GivenFile[]> =>
  Promise.all(found.map(async ({path, file}) => ({path, bytes: await file.arrayBuffer()})));

/**
 * The files of a drop, folders walked. On pages from file:// Chromium's entries fail, and handles
 * work; other browsers have entries alone. All of them are asked for before the first await: the
 * items are gone after it.
 */
export async function droppedFiles(items: DataTransferItemList): Promise<GivenFile[]> {
  interface Item {
    handle: Promise<FileSystemHandle | null> | undefined;
    entry: FileSystemEntry | null;
    file: File | null;
  }
  const asked: Item[] = [];
  for (const item of items) {
    if (item.kind !== 'file') continue;
    const asHandle = item as DataTransferItem & {
      getAsFileSystemHandle?(): Promise<FileSystemHandle | null>;
    };
    asked.push({
      handle: asHandle.getAsFileSystemHandle?.().catch(() => null),
      entry: item.webkitGetAsEntry(),
      file: item.getAsFile(),
    });
  }
  const found: Found[] = [];
  for (const {handle, entry, file} of asked) {
    const opened = await handle;
    if (opened) await walkHandle(opened, '', found);
    else if (entry) await walkEntry(entry, '', found);
    else if (file) found.push({path: file.name, file});
  }
  return readAll(found);
}

/** The files of a choice, with their folders where a folder was chosen. */
export const chosenFiles = (files: FileList): Promise<GivenFile[]> =>
  readAll([...files].map((file) => ({path: file.webkitRelativePath || file.name, file})));

/** What the page is to open of the files that it carries. */
export interface Carried {
  files: GivenFile[];
  open: {
    path: string;
    skeleton?: string;
    servo_map?: string;
    project?: string;
    options?: Record<string, unknown>;
  }[];
}

/**
 * The files that `kinefile view` put into the page: base64 of gzip of a length (4 bytes, little
 * endian), a JSON text of that length, and the files' bytes one after another.
 */
export async function carriedFiles(): Promise<Carried> {
  const text = packedText('motion');
  if (text === '') return {files: [], open: []};
  const bytes = await unpack(text);
  const size = new DataView(bytes).getUint32(0, true);
  const list = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, size)));
  let at = 4 + size;
  const files = list.files.map(({path, size: length}: {path: string; size: number}) => {
    const part = bytes.slice(at, at + length);
    at += length;
    return {path, bytes: part};
  });
  return {files, open: list.open};
}
