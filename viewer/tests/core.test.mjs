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

test('a motion tells with which time of its source it begins', () =>
  openCore().then((core) => {
    const rows = Array.from({length: 40}, (_, f) => `${f} 90 0 0 0 0`).join('\n');
    const head = 'HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition ';
    const tail = 'Zrotation Xrotation Yrotation\n}\nMOTION\nFrames: 40\nFrame Time: 0.1\n';
    core.addFile('a.bvh', Buffer.from(`${head}${tail}${rows}\n`));
    core.addFile('b.bvh', Buffer.from(`${head}${tail}${rows}\n`));
    const {handle} = core.ask('open', {path: 'a.bvh'});
    const startAfter = (...words) => {
      const steps = words.map((one) => (typeof one === 'string' ? {operation: one} : {warp: one}));
      const {document, error} = core.ask('edit', {handle, steps});
      assert.equal(error, undefined, `${words}`);
      return Math.round(document.source_start * 1e6) / 1e6;
    };
    assert.equal(startAfter(), 0);
    assert.equal(startAfter('trim=10:30'), 1);
    assert.equal(startAfter('trim=10:30', 'mirror=x', 'trim=5:20'), 1.5);
    assert.equal(startAfter('speed=2', 'trim=5:10'), 1);
    assert.equal(startAfter('append=b.bvh', 'trim=4:50'), 0.4);
    assert.equal(startAfter('trim=10:30', {key: ['10:12'], tail: 'extend'}), 1);
    assert.equal(startAfter({key: ['8:0', '20:12'], tail: 'extend'}), 0.8);
    // Backwards there is no time at which both could start.
    assert.equal(startAfter('trim=10:30', 'reverse'), 0);
  }));

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

test('a file is written with the options of its format and of the conversion', async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'kinefile-'));
  t.after(() => rmSync(folder, {recursive: true}));
  const path = join(root, 'tests/formats/bvh/valid/spec_example.bvh');
  const core = await openCore();
  core.addFile('a.bvh', readFileSync(path));
  const {handle} = core.ask('open', {path: 'a.bvh'});
  for (const [name, options] of [
    ['b.bvh', {decimals: '3', order: 'XYZ', channels: 'all'}],
    ['b.seq', {'seq-version': '4', 'choreonoid-digits': true, form: 'links', up: 'y'}],
  ]) {
    const words = Object.entries(options).flatMap(([option, word]) =>
      word === true ? [`--${option}`] : [`--${option}`, word],
    );
    run('convert', path, join(folder, name), '--quiet', ...words);
    const [file] = core.ask('write', {handle, name, options}).files;
    const expected = readFileSync(join(folder, name), 'utf8');
    assert.equal(Buffer.from(file.bytes).toString(), expected, name);
  }
  const {formats} = core.ask('tables');
  const seq = formats.find(({name}) => name === 'choreonoid');
  assert.ok(seq.write_options.some(({name}) => name === 'seq-version'));
  assert.ok(seq.adapt_options.some(({name}) => name === 'form'));
  assert.ok(formats.every(({is_written, adapt_options}) => is_written || !adapt_options.length));
  const refused = core.ask('write', {handle, name: 'b.bvh', options: {decimals: '99'}});
  assert.match(refused.error.message, /decimals/);
});

test('a ZMP is given in the world, whichever frame the file has it in', async () => {
  const core = await openCore();
  const times = [0, 0.6, 1, 1.5, 2];
  const rows = (height) => times.map((at) => `      - [ ${at}, 0.1, 0, ${height} ]`).join('\n');
  const zmp = (height, isRelative) => `  -
    type: Vector3Seq
    content: ZMP
    isRootRelative: ${isRelative}
    frames:
${rows(height)}
`;
  const bow = example('bow.seq').toString();
  core.addFile('robot.body', example('robot.body'));
  core.addFile('none.seq', Buffer.from(bow));
  core.addFile('world.seq', Buffer.from(bow + zmp(0, false)));
  core.addFile('root.seq', Buffer.from(bow + zmp(-0.7, true)));
  const pointsOf = (path) => {
    const {handle, document, error} = core.ask('open', {path, skeleton: 'robot.body'});
    assert.equal(error, undefined, path);
    return {points: core.ask('zmp', {handle}).points, count: document.time.num_frames};
  };
  assert.equal(pointsOf('none.seq').points.length, 0);
  for (const path of ['world.seq', 'root.seq']) {
    const {points, count} = pointsOf(path);
    assert.equal(points.length, 3 * count, path);
    [0.1, 0, 0].forEach((value, k) => {
      assert.ok(Math.abs(points[k] - value) < 1e-9, `${path}: ${points.slice(0, 3)}`);
    });
  }
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

test('a flow is written as its own format, and as the motion of its robot', async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'kinefile-'));
  t.after(() => rmSync(folder, {recursive: true}));
  const core = await openCore();
  for (const name of ['wave.txt', 'robot.body', 'servos.yaml']) core.addFile(name, example(name));
  const {documents} = core.ask('open_all', {paths: ['robot.body', 'servos.yaml', 'wave.txt']});
  const {handle, document} = documents[0];
  assert.equal(document.has_frames, false);
  const starts = document.blocks.map(({frame}) => frame);
  assert.ok(starts.length > 3 && starts[0] === 0, `${starts}`);
  assert.deepEqual(
    starts,
    [...starts].sort((a, b) => a - b),
  );
  assert.ok(document.blocks.every(({name}) => name !== ''));
  assert.deepEqual(core.ask('check', {handle}).diagnostics, []);
  const path = (name) => join(root, 'examples', name);
  const robot = ['--servo-map', path('servos.yaml'), '--skeleton', path('robot.body')];
  run('run', path('wave.txt'), ...robot, '-o', join(folder, 'wave.seq'), '--quiet');
  const [seq] = core.ask('write', {handle, name: 'wave.seq'}).files;
  assert.equal(Buffer.from(seq.bytes).toString(), readFileSync(join(folder, 'wave.seq'), 'utf8'));
  const [txt] = core.ask('write', {handle, name: 'again.txt'}).files;
  assert.deepEqual(Buffer.from(txt.bytes), example('wave.txt'));
});
