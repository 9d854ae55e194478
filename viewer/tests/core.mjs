// SPDX-License-Identifier: MIT
// The core under Node, asked as the page's worker asks it.
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {root} from './browser.mjs';

const folder = process.env.KINEFILE_CORE ?? join(root, 'build/wasm');

/** Starts a core of its own. */
export async function openCore() {
  const createKinefile = createRequire(import.meta.url)(join(folder, 'core.js'));
  const core = await createKinefile({wasmBinary: readFileSync(join(folder, 'core.wasm'))});

  const withText = (text, call) => {
    const size = core.lengthBytesUTF8(text) + 1;
    const at = core._malloc(size);
    core.stringToUTF8(text, at, size);
    const answer = call(at);
    core._free(at);
    return answer;
  };
  return {
    addFile(path, bytes) {
      const at = core._malloc(Math.max(1, bytes.length));
      core.HEAPU8.set(bytes, at);
      return withText(path, (name) => core._kinefile_add_file(name, at, bytes.length) !== 0);
    },
    ask(question, of = {}) {
      const asked = JSON.stringify({ask: question, ...of});
      const text = withText(asked, (at) => core.UTF8ToString(core._kinefile_answer(at)));
      return JSON.parse(text, (_, value) => {
        const isPlace = typeof value === 'object' && value !== null && 'size' in value;
        if (!isPlace) return value;
        if (value.name === undefined) {
          const heap = question === 'poses' ? core.HEAPF32 : core.HEAPF64;
          const first = value.at / heap.BYTES_PER_ELEMENT;
          return heap.slice(first, first + value.size);
        }
        const bytes = core.HEAPU8.slice(value.at, value.at + value.size);
        return {name: value.name, bytes};
      });
    },
  };
}
