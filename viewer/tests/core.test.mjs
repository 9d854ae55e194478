// SPDX-License-Identifier: MIT
// The page's core, without a page: its kinematics are those of the command, and its answers those
// that the page expects.
import assert from 'node:assert/strict';
import {existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {basename, join} from 'node:path';
import {test} from 'node:test';
import {data, root, run} from './browser.mjs';
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

const example = (name) => readFileSync(join(root, 'examples', name));

/** What became of each file: {"walk.amc": "document", ...}. */
const whats = ({opened}) => Object.fromEntries(opened.map(({path, what}) => [path, what]));

test('the position of the Chest is that of the document', async () => {
  const core = await openCore();
  core.addFile('a.bvh', readFileSync(join(root, 'tests/formats/bvh/valid/spec_example.bvh')));
  const {handle, document} = core.ask('open', {path: 'a.bvh'});
  const joint = document.joints.findIndex(({name}) => name === 'Chest');
  const {position} = core.ask('joint', {handle, joint, frame: 0});
  assert.deepEqual(
    position.map((value) => value.toFixed(5)),
    ['8.32964', '40.03869', '89.68911'],
  );
});

test('an AMC takes the ASF beside it, whichever comes first', async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'kinefile-'));
  t.after(() => rmSync(folder, {recursive: true}));
  run('convert', join(root, 'tests/formats/bvh/valid/spec_example.bvh'), join(folder, 'a.amc'));
  const core = await openCore();
  core.addFile('in/a.amc', readFileSync(join(folder, 'a.amc')));
  const alone = core.ask('open_all', {paths: ['in/a.amc']});
  assert.equal(alone.opened[0].what, 'fault');
  assert.match(alone.opened[0].diagnostics[0].code, /^AMC/);
  core.addFile('in/a.asf', readFileSync(join(folder, 'a.asf')));
  const both = core.ask('open_all', {paths: ['in/a.amc', 'in/a.asf']});
  assert.deepEqual(whats(both), {'in/a.amc': 'document', 'in/a.asf': 'companion'});
  assert.equal(both.documents.length, 1);
});

test('a robot carries the body motion and the flow that come with it or before it', async () => {
  const core = await openCore();
  core.addFile('bow.seq', example('bow.seq'));
  const alone = core.ask('open_all', {paths: ['bow.seq']});
  const {handle} = alone.opened[0];
  for (const name of ['robot.body', 'wave.txt', 'servos.yaml']) core.addFile(name, example(name));
  const all = core.ask('open_all', {paths: ['robot.body', 'servos.yaml', 'wave.txt']});
  assert.deepEqual(whats(all), {
    'robot.body': 'companion',
    'servos.yaml': 'companion',
    'wave.txt': 'document',
  });
  assert.equal(all.documents.length, 2);
  for (const {document} of all.documents) {
    assert.equal(document.skeleton, 'robot.body');
    assert.equal(document.is_robot, true);
  }
  assert.equal(all.documents[0].handle, handle);
});

test('a list of steps replaces another, and a refused one changes nothing', async () => {
  const core = await openCore();
  core.addFile('a.bvh', readFileSync(join(root, 'tests/formats/bvh/valid/spec_example.bvh')));
  const {handle, document} = core.ask('open', {path: 'a.bvh'});
  assert.equal(document.time.num_frames, 2);
  const looped = core.ask('edit', {handle, steps: [{operation: 'loop=3'}]});
  assert.equal(looped.document.time.num_frames, 6);
  const refused = core.ask('edit', {handle, steps: [{operation: 'trim=4:9'}]});
  assert.match(refused.error.message, /frames/);
  const warp = {key: ['1:4'], tail: 'extend'};
  const warped = core.ask('edit', {handle, steps: [{operation: 'loop=3'}, {warp}]});
  assert.deepEqual(warped.document.source_frames, [0, 0.25, 0.5, 0.75, 1, 2, 3, 4, 5]);
  assert.equal(core.ask('edit', {handle, steps: []}).document.time.num_frames, 2);
  const words = core.ask('edit', {handle, steps: [{warp: {key: ['1:4'], tail: 'sideways'}}]});
  assert.match(words.error.message, /tail/);
});

test('a motion is written as the command writes it, and its source is given back', async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'kinefile-'));
  t.after(() => rmSync(folder, {recursive: true}));
  const path = join(root, 'tests/formats/bvh/valid/spec_example.bvh');
  const core = await openCore();
  core.addFile('a.bvh', readFileSync(path));
  const {handle} = core.ask('open', {path: 'a.bvh'});
  for (const name of ['b.bvh', 'b.amc', 'b.seq', 'b.csv']) {
    run('convert', path, join(folder, name), '--quiet');
    const {files} = core.ask('write', {handle, name});
    for (const file of files) {
      assert.equal(
        Buffer.from(file.bytes).toString(),
        readFileSync(join(folder, file.name), 'utf8'),
        file.name,
      );
    }
  }
  const {files} = core.ask('source', {path: 'a.bvh'});
  assert.deepEqual(Buffer.from(files[0].bytes), readFileSync(path));
});

test('files that come one by one, in any order, end as those that come together', async () => {
  const names = ['servos.yaml', 'wave.txt', 'robot.body', 'bow.seq'];
  const orders = [
    names,
    [...names].reverse(),
    ['robot.body', 'bow.seq', 'servos.yaml', 'wave.txt'],
  ];
  for (const order of orders) {
    const core = await openCore();
    let faults = [];
    let last;
    for (const name of order) {
      core.addFile(name, example(name));
      last = core.ask('open_all', {paths: [...faults, name].sort()});
      faults = last.opened.filter(({what}) => what === 'fault').map(({path}) => path);
    }
    assert.deepEqual(faults, [], order.join(' '));
    const open = last.documents.map(({document}) => [document.path, document.skeleton]).sort();
    assert.deepEqual(open, [
      ['bow.seq', 'robot.body'],
      ['wave.txt', 'robot.body'],
    ]);
  }
});
