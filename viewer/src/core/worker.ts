// SPDX-License-Identifier: MIT
// The worker owns the core. The packer puts the core's own script, which defines createKinefile,
// before this one.
import {unpack} from './unpack.ts';

interface Module {
  HEAPU8: Uint8Array;
  HEAPF32: Float32Array;
  HEAPF64: Float64Array;
  _malloc(size: number): number;
  _free(at: number): void;
  /** Not 0: the core had the same bytes. */
  _kinefile_add_file(path: number, bytes: number, size: number): number;
  _kinefile_answer(question: number): number;
  _kinefile_version(): number;
  UTF8ToString(at: number): string;
  stringToUTF8(text: string, at: number, size: number): void;
  lengthBytesUTF8(text: string): number;
}
declare function createKinefile(options: {wasmBinary: Uint8Array}): Promise<Module>;

type Message =
  | {id: number; do: 'start'; core: string}
  | {id: number; do: 'add'; path: string; bytes: ArrayBuffer}
  | {id: number; do: 'ask'; question: unknown};

let core: Module;

/** A text in the core's memory, for the time of a call. */
function withText<T>(text: string, call: (at: number) => T): T {
  const size = core.lengthBytesUTF8(text) + 1;
  const at = core._malloc(size);
  core.stringToUTF8(text, at, size);
  try {
    return call(at);
  } finally {
    core._free(at);
  }
}

function add(path: string, bytes: ArrayBuffer): boolean {
  const at = core._malloc(Math.max(1, bytes.byteLength));
  if (at === 0) throw new RangeError('out of memory');
  core.HEAPU8.set(new Uint8Array(bytes), at);
  // The memory is now the core's.
  return withText(path, (name) => core._kinefile_add_file(name, at, bytes.byteLength) !== 0);
}

interface Place {
  at: number;
  size: number;
  name?: string;
}

const isPlace = (value: unknown): value is Place =>
  typeof value === 'object' && value !== null && 'at' in value && 'size' in value;

/** Copies what an answer points to out of the core's memory, which the next question may move. */
function copied(place: Place, floats: boolean): unknown {
  if (place.name !== undefined) {
    return {name: place.name, bytes: core.HEAPU8.slice(place.at, place.at + place.size)};
  }
  const heap = floats ? core.HEAPF32 : core.HEAPF64;
  const first = place.at / heap.BYTES_PER_ELEMENT;
  return heap.slice(first, first + place.size);
}

function ask(question: unknown): {answer: unknown; transfers: Transferable[]} {
  const text = withText(JSON.stringify(question), (at) =>
    core.UTF8ToString(core._kinefile_answer(at)),
  );
  const transfers: Transferable[] = [];
  const floats = (question as {ask: string}).ask === 'poses';
  const answer: unknown = JSON.parse(text, (_, value) => {
    if (!isPlace(value)) return value;
    const made = copied(value, floats);
    transfers.push((ArrayBuffer.isView(made) ? made : (made as {bytes: Uint8Array}).bytes).buffer);
    return made;
  });
  return {answer, transfers};
}

async function handle(message: Message): Promise<{answer: unknown; transfers: Transferable[]}> {
  switch (message.do) {
    case 'start':
      core = await createKinefile({wasmBinary: new Uint8Array(await unpack(message.core))});
      return {answer: core.UTF8ToString(core._kinefile_version()), transfers: []};
    case 'add':
      return {answer: add(message.path, message.bytes), transfers: []};
    case 'ask':
      return ask(message.question);
  }
}

/** What this file needs of a worker's own scope. */
const scope = self as unknown as {
  onmessage: (event: MessageEvent<Message>) => void;
  postMessage(message: unknown, transfers?: Transferable[]): void;
};

scope.onmessage = async ({data}) => {
  try {
    const {answer, transfers} = await handle(data);
    scope.postMessage({id: data.id, answer}, transfers);
  } catch (fault) {
    scope.postMessage({id: data.id, fault: String(fault)});
  }
};
