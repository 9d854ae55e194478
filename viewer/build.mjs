// SPDX-License-Identifier: MIT
// Makes the page: bundles the scripts and packs them, the style and the core into one HTML file.
//   node build.mjs CORE_FOLDER OUT.html
// CORE_FOLDER has core.js and core.wasm. The page's policy allows just the script and the style
// that are in it: their hashes are those of the exact bytes between the tags.
import {createHash} from 'node:crypto';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {gzipSync} from 'node:zlib';
import zopfli from '@gfx/zopfli';
import {build, transform} from 'esbuild';

const here = import.meta.dirname ?? dirname(new URL(import.meta.url).pathname);
const [coreFolder, out] = process.argv.slice(2);
if (out === undefined) {
  console.error('usage: node build.mjs CORE_FOLDER OUT.html');
  process.exit(2);
}

/** A script and what it imports, minified, as one script that no element can end. */
async function bundle(entry) {
  const made = await build({
    entryPoints: [join(here, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['chrome100', 'firefox100', 'safari16.4'],
    define: {ERRORS: JSON.stringify(errors()), LICENCES: JSON.stringify(licences())},
    charset: 'utf8',
    legalComments: 'none',
    logLevel: 'warning',
  });
  return made.outputFiles[0].text;
}

/** What docs/errors.md says of each code: {"BVH001": ["not a BVH file", "Cause: ..."]}. */
function errors() {
  const text = readFileSync(join(here, '../docs/errors.md'), 'utf8');
  const found = {};
  for (const part of text.split(/^#+ (?=[A-Z]{3}\d{3} )/m).slice(1)) {
    const [heading, ...rest] = part.split(/^#/m)[0].trim().split('\n');
    const code = heading.slice(0, 6);
    const title = heading.slice(7);
    const body = rest.join('\n');
    found[code] = [title, body.trim()];
  }
  return found;
}

/** The licences of what the page contains, by name. */
function licences() {
  const text = (path) => readFileSync(join(here, path), 'utf8').trim();
  return {
    kinefile: text('../LICENSE'),
    'three.js': text('node_modules/three/LICENSE'),
    uPlot: text('node_modules/uplot/LICENSE'),
    'The core': text('core_licences.txt'),
  };
}

/** Gzip by Zopfli: some seconds, and a twentieth smaller than zlib's best. */
const zipped = async (bytes) => Buffer.from(await zopfli.gzipAsync(bytes, {numiterations: 15}));

async function style() {
  const made = await build({
    entryPoints: [join(here, 'src/style.css')],
    bundle: true,
    minify: true,
    write: false,
    logLevel: 'warning',
  });
  return made.outputFiles[0].text.trim();
}

const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const isolated = (script) =>
  script.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');

const script = isolated(await bundle('src/main.ts'));
const css = await style();
// Emscripten's own script is minified in part alone.
const coreScript = await transform(readFileSync(join(coreFolder, 'core.js'), 'utf8'), {
  minify: true,
  charset: 'utf8',
  legalComments: 'none',
});
const worker = isolated(`${coreScript.code}\n${await bundle('src/core/worker.ts')}`);
const core = (await zipped(readFileSync(join(coreFolder, 'core.wasm')))).toString('base64');
const policy = [
  "default-src 'none'",
  `script-src ${hash(script)} 'wasm-unsafe-eval'`,
  'worker-src blob:',
  `style-src ${hash(css)}`,
  'img-src blob: data:',
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');

const parts = {POLICY: policy, STYLE: css, WORKER: worker, CORE: core, SCRIPT: script};
const page = readFileSync(join(here, 'page.html'), 'utf8').replace(
  /(content="|<style>|text\/plain">|<script>)(POLICY|STYLE|WORKER|CORE|SCRIPT)/g,
  (_, before, part) => before + parts[part],
);
mkdirSync(dirname(out), {recursive: true});
writeFileSync(out, page);
const size = (bytes) => `${Math.round(bytes / 1000)} kB`;
console.log(`${out}: ${size(page.length)}, ${size(gzipSync(page).length)} compressed`);
