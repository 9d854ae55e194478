// SPDX-License-Identifier: MIT
// The page's core, without a page: its kinematics are those of the command, and its answers those
// that the page expects.
import assert from 'node:assert/strict';
import {existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {basename, join} from 'node:path';
import {test} from 'node:test';
import {data, run} from './browser.mjs';
import {openCore} from './core.mjs';

const real = join(data, 'bvh/real');

/** The files below a folder with one of these extensions. */
const filesBelow = (folder, extension) =>
  readdirSync(folder, {recursive: true})
    .map((name) => join(folder, name))
    .filter((path) => path.toLowerCase().endsWith(extension) && statSync(path).isFile())
    .sort();

/** The largest difference of two tables of positions, relative to the largest number. */
function largestDifference(a, b) {
  const rows = (text) => text.trimEnd().split('\n');
  const [mine, other] = [rows(a), rows(b)];
  assert.equal(mine.length, other.length);
  assert.equal(mine[0], other[0]);
  let largest = 0;
  let scale = 1;
  for (let row = 1; row < mine.length; row++) {
    if (mine[row] === other[row]) continue;
    const [x, y] = [mine[row].split(',').slice(-3), other[row].split(',').slice(-3)];
    for (let k = 0; k < 3; k++) {
      if (x[k] === y[k]) continue;
      largest = Math.max(largest, Math.abs(Number(x[k]) - Number(y[k])));
      scale = Math.max(scale, Math.abs(Number(x[k])));
    }
  }
  return largest / scale;
}

test('kinematics equal those of the command to 1e-12 on real files', async (t) => {
  if (!existsSync(real)) return t.skip(`no real files at ${basename(real)}`);
  const folder = mkdtempSync(join(tmpdir(), 'kinefile-'));
  t.after(() => rmSync(folder, {recursive: true}));
  const core = await openCore();
  let compared = 0;
  for (const path of filesBelow(real, '.bvh')) {
    const table = join(folder, 'native.csv');
    try {
      run('fk', path, '-o', table, '--force', '--quiet');
    } catch {
      continue; // not valid, or without frames: the command's own tests look at these
    }
    core.addFile('a.bvh', readFileSync(path));
    const opened = core.ask('open', {path: 'a.bvh'});
    assert.equal(opened.error, undefined, path);
    const {files} = core.ask('write_poses', {handle: opened.handle, name: 'a.csv'});
    const difference = largestDifference(
      Buffer.from(files[0].bytes).toString(),
      readFileSync(table, 'utf8'),
    );
    assert.ok(difference <= 1e-12, `${path}: ${difference}`);
    core.ask('close', {handle: opened.handle});
    compared++;
  }
  assert.ok(compared > 10, `${compared} files compared`);
});

test('a failure has its place', async () => {
  const core = await openCore();
  core.addFile('cut.bvh', Buffer.from('HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0\n'));
  const answer = core.ask('open', {path: 'cut.bvh'});
  assert.equal(answer.diagnostics[0].file, 'cut.bvh');
  assert.equal(answer.diagnostics[0].line, 5);
  assert.match(answer.diagnostics[0].code, /^BVH/);
});
