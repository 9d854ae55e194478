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
import {smallAmc, smallAsf, smallBvh, smallProject} from './motions.mjs';

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

/// The same text, whose numbers may differ in their last digits: the core has no vectors, and its
/// kinematics another order of operations.
function assertSameNumbers(actual, expected, name) {
  const parts = (text) => text.split(/(-?\d+(?:\.\d*)?(?:e[-+]?\d+)?)/);
  const [a, b] = [parts(actual), parts(expected)];
  assert.equal(a.length, b.length, name);
  for (let i = 0; i < a.length; ++i) {
    const isNumber = i % 2 === 1;
    if (!isNumber) assert.equal(a[i], b[i], name);
    if (isNumber) assert.ok(Math.abs(a[i] - b[i]) <= 1e-12 * Math.max(1, Math.abs(b[i])), name);
  }
}

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
      const expected = readFileSync(join(folder, file.name), 'utf8');
      const hasPoses = file.name.endsWith('.seq');
      const check = hasPoses ? assertSameNumbers : assert.equal;
      check(Buffer.from(file.bytes).toString(), expected, file.name);
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
  assert.match(
    refused.error.message,
    /^--decimals: expected a whole number from 0 to 30, found '99'$/,
  );
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
    const described = new Map();
    let faults = [];
    let last;
    for (const name of order) {
      core.addFile(name, example(name));
      last = core.ask('open_all', {paths: [...faults, name].sort()});
      faults = last.opened.filter(({what}) => what === 'fault').map(({path}) => path);
      for (const {handle, document} of last.documents) {
        if (document !== null) described.set(handle, document);
      }
    }
    assert.deepEqual(faults, [], order.join(' '));
    const open = last.documents
      .map(({handle}) => described.get(handle))
      .map(({path, skeleton}) => [path, skeleton])
      .sort();
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

test('a flow keeps what it was given, and says what is missing', async () => {
  const core = await openCore();
  const documents = new Map();
  const give = (files) => {
    for (const [path, text] of Object.entries(files)) core.addFile(path, Buffer.from(text));
    const answer = core.ask('open_all', {paths: Object.keys(files)});
    for (const {handle, document} of answer.documents) {
      if (document !== null) documents.set(handle, document);
    }
    return answer;
  };
  const flow = () => [...documents.values()].find(({path}) => path === 'wave.txt');
  const {handle} = give({'wave.txt': example('wave.txt')}).opened[0];
  assert.match(flow().lacks, /the robot's model .* and a servo map .* or the robot's project/);
  const blocks = flow().blocks;
  assert.ok(blocks.length > 3);
  const frame = blocks[2].frame;
  const sliderAt = (name) =>
    core.ask('joint', {handle, joint: 0, frame}).channels.find((one) => one.name === name).value;
  const word = sliderAt('s12');
  assert.equal(word, 0x7000);
  // A project names sliders; without its files it says what it lacks.
  const {'robot.rpj': project, 'sliders.ini': sliders} = smallProject;
  const alone = give({'robot.rpj': project}).opened[0];
  assert.equal(alone.what, 'fault');
  assert.match(alone.diagnostics[0].message, /sliders\.ini/);
  const whole = give({'robot.rpj': project, 'sliders.ini': sliders});
  assert.deepEqual(whats(whole), {'robot.rpj': 'companion', 'sliders.ini': 'companion'});
  assert.equal(flow().project, 'robot.rpj');
  assert.match(flow().lacks, /needs the robot's model \(\.body, \.wrl, \.urdf\)$/);
  assert.ok(Math.abs(sliderAt('shoulder [°]') - word / 182) < 1e-9);
  // The robot has no joint of that name; it stays open, and a servo map is asked for.
  const robot = give({'robot.body': example('robot.body')});
  assert.deepEqual(whats(robot), {'robot.body': 'document'});
  assert.match(flow().lacks, /needs a servo map \(\.yaml\), since no joint/);
  const map = give({'servos.yaml': example('servos.yaml')});
  assert.equal(map.documents.length, 1);
  const {lacks, skeleton, servo_map, blocks: now} = flow();
  assert.deepEqual(
    {lacks, skeleton, servo_map, project: flow().project},
    {lacks: '', skeleton: 'robot.body', servo_map: 'servos.yaml', project: 'robot.rpj'},
  );
  assert.equal(now.length, blocks.length);
});

test('a document says in which formats it can be written, and what others need', async () => {
  const core = await openCore();
  core.addFile('a.bvh', Buffer.from(smallBvh(3)));
  core.addFile('robot.body', example('robot.body'));
  core.addFile('wave.txt', example('wave.txt'));
  const hindrances = (path) => {
    const {handle} = core.ask('open', {path});
    return core.ask('written_formats', {handle}).hindrances;
  };
  const offered = (path) =>
    Object.entries(hindrances(path)).flatMap(([name, text]) => (text === '' ? [name] : []));
  assert.deepEqual(offered('a.bvh'), ['bvh', 'asf', 'amc', 'choreonoid', 'csv', 'json']);
  assert.match(hindrances('a.bvh').robovie, /'kinefile keyframe' with a servo map/);
  assert.match(hindrances('a.bvh').hrpsys, /expected a robot's motion/);
  assert.ok(!offered('robot.body').includes('choreonoid'));
  assert.deepEqual(offered('wave.txt'), ['robovie', 'csv', 'json']);
  // What is offered is written.
  const {handle} = core.ask('open', {path: 'a.bvh'});
  for (const format of offered('a.bvh')) {
    const answer = core.ask('write', {handle, name: `b.${format}`, format});
    assert.equal(answer.error, undefined, format);
  }
});

test('a table without a header says so at once', async () => {
  const core = await openCore();
  const rows = Array.from({length: 30}, (_, f) =>
    Array(36)
      .fill(f / 10)
      .join(','),
  ).join('\n');
  core.addFile('g1.csv', Buffer.from(`${rows}\n`));
  const [table] = core.ask('open_all', {paths: ['g1.csv']}).opened;
  assert.equal(table.what, 'unknown');
  assert.match(table.diagnostics[0].message, /a header of 'time'.*; numbers alone do not say what/);
});

test('a failure says whether the file opens leniently, and with what', async () => {
  const core = await openCore();
  const whole = smallBvh(3);
  const files = {
    'cut.bvh': whole.slice(0, 60),
    'mended.bvh': whole.replace('    OFFSET 0 30 0\n    CHANNELS', '    CHANNELS'),
  };
  for (const [path, text] of Object.entries(files)) core.addFile(path, Buffer.from(text));
  assert.equal(core.ask('open', {path: 'cut.bvh'}).leniently, null);
  const {error, leniently} = core.ask('open', {path: 'mended.bvh'});
  assert.equal(error.code, 'BVH006');
  assert.equal(leniently.options.lenient, true);
  const {opened} = core.ask('open_all', {paths: Object.keys(files)});
  assert.deepEqual(
    opened.map((file) => [file.what, file.leniently?.options.lenient]),
    [
      ['fault', undefined],
      ['fault', true],
    ],
  );
  const repaired = core.ask('open', {path: 'mended.bvh', ...leniently});
  assert.equal(repaired.document.time.num_frames, 3);
});

/** Adds files and opens them as a folder that was given. */
function openFolder(core, files, few) {
  for (const [path, text] of Object.entries(files)) core.addFile(path, Buffer.from(text));
  return whats(core.ask('open_all', {paths: Object.keys(files), few}));
}

test('of a few motions all are opened, of many the first; what is no motion is no fault', async () => {
  const bvh = smallBvh(3);
  const others = {
    'day/notes.txt': 'Take 3 is the good one.\n',
    'day/list.csv': 'take,actor\n1,A\n',
    'day/sensor.csv': 'time,ax\n0,1\n1,2\n',
    'day/rig.yaml': 'cameras: 12\n',
    'day/still.jpg': '\xff\xd8',
  };
  const unknown = Object.fromEntries(Object.keys(others).map((path) => [path, 'unknown']));
  const pair = {'day/a.bvh': bvh, 'day/b.bvh': bvh};
  const both = openFolder(await openCore(), {...others, ...pair});
  assert.deepEqual(both, {...unknown, 'day/a.bvh': 'document', 'day/b.bvh': 'document'});

  const takes = Object.fromEntries(['1', '2', '3', '4'].map((take) => [`day/${take}.bvh`, bvh]));
  const core = await openCore();
  const many = openFolder(core, {...others, ...pair, ...takes, 'day/0.bvh': 'HIERARCHY\n'});
  const waiting = Object.fromEntries(Object.keys(takes).map((path) => [path, 'waiting']));
  assert.deepEqual(many, {
    ...unknown,
    ...waiting,
    'day/a.bvh': 'document',
    'day/b.bvh': 'waiting',
    'day/0.bvh': 'waiting',
  });
  // One that cannot be read does not count.
  const next = core.ask('open_all', {paths: ['day/0.bvh', ...Object.keys(takes), 'day/b.bvh']});
  const open = next.opened.filter(({what}) => what === 'document').map(({path}) => path);
  assert.deepEqual(open, ['day/1.bvh']);
  const [listed] = core.ask('open_all', {paths: ['day/4.bvh', 'day/3.bvh'], few: 2}).opened;
  assert.deepEqual([listed.path, listed.what], ['day/4.bvh', 'document']);
});

test('of several robots the first is opened, and none beside a motion that one carries', async () => {
  const robot = example('robot.body');
  const robots = {'a.body': robot, 'b.body': robot, 'c.body': robot};
  const core = await openCore();
  const first = {'a.body': 'document', 'b.body': 'waiting', 'c.body': 'waiting'};
  assert.deepEqual(openFolder(core, robots), first);
  const {opened, documents} = core.ask('open_all', {paths: ['c.body'], few: 1});
  assert.deepEqual([opened[0].what, opened[0].is_model, documents.length], ['document', true, 2]);
  const other = await openCore();
  const carried = openFolder(other, {...robots, 'bow.seq': example('bow.seq')});
  assert.deepEqual(carried, {...first, 'a.body': 'companion', 'bow.seq': 'document'});
  assert.equal(other.ask('open_all', {paths: []}).documents.length, 1);
});

test('beside many motions the skeletons of others are not opened', async () => {
  const takes = Object.fromEntries(
    Array.from({length: 6}, (_, take) => [`in/${take}.amc`, smallAmc([0, 10])]),
  );
  const core = await openCore();
  const all = openFolder(core, {'in/0.asf': smallAsf, 'in/9.asf': smallAsf, ...takes});
  assert.equal(all['in/0.amc'], 'document');
  assert.equal(all['in/1.amc'], 'waiting');
  assert.equal(all['in/9.asf'], 'companion');
  const {documents} = core.ask('open_all', {paths: []});
  assert.equal(documents.length, 1);
  // Nothing is new, so nothing is described again.
  assert.equal(documents[0].document, null);
});

test('the same bytes under the same path are known', async () => {
  const core = await openCore();
  const bytes = () => Buffer.from(smallBvh(3));
  assert.equal(core.addFile('a.bvh', bytes()), false);
  assert.equal(core.addFile('a.bvh', bytes()), true);
  assert.equal(core.addFile('b.bvh', bytes()), false);
  assert.equal(core.addFile('a.bvh', Buffer.from(smallBvh(4))), false);
});

/** A body motion with joint values alone, which may have times. */
const smallSeq = (numJoints, values, times = null) =>
  [
    'type: CompositeSeq',
    'content: BodyMotion',
    'formatVersion: 2',
    `numFrames: ${values.length}`,
    'frameRate: 10',
    ...(times ? ['hasFrameTime: true'] : []),
    'components:',
    '  - type: MultiValueSeq',
    '    content: JointDisplacement',
    `    numParts: ${numJoints}`,
    `    numFrames: ${values.length}`,
    '    frameRate: 10',
    ...(times ? ['    hasFrameTime: true'] : []),
    '    frames:',
    ...values.map((value, frame) => {
      const row = Array(numJoints).fill(value);
      return `      - [${[...(times ? [times[frame]] : []), ...row].join(', ')}]`;
    }),
    '',
  ].join('\n');

test('a robot: its joints with limits in degrees, where it stands, how times are read', async () => {
  const core = await openCore();
  core.addFile('robot.body', example('robot.body'));
  core.addFile('bow.seq', example('bow.seq'));
  core.addFile('joints.seq', Buffer.from(smallSeq(18, [0, 3])));
  core.addFile('timed.seq', Buffer.from(smallSeq(18, [0, 1], [0, 1])));
  const open = (path, options) => core.ask('open', {path, skeleton: 'robot.body', options});
  assert.equal(open('bow.seq').document.has_place, true);
  const {handle, document} = open('joints.seq');
  assert.equal(document.has_place, false);
  assert.deepEqual(document.companions, ['robot.body']);
  const index = document.joints.findIndex(({dofs}) => dofs?.[0]?.id === 0);
  const [dof] = document.joints[index].dofs;
  const {kind, axis, unit} = dof;
  assert.deepEqual({kind, axis, unit}, {kind: 'rotation', axis: [1, 0, 0], unit: 'deg'});
  const rounded = [dof.lower, dof.upper, dof.max_speed].map((limit) => Number(limit.toFixed(9)));
  assert.deepEqual(rounded, [-45, 25, 360]);
  // The columns have them in their own unit.
  const [channel] = document.joints[index].channels;
  assert.deepEqual(
    [channel.lower, channel.upper].map((limit) => ((limit * 180) / Math.PI).toFixed(9)),
    ['-45.000000000', '25.000000000'],
  );
  const at = (frame) => core.ask('joint', {handle, joint: index, frame}).dofs[0];
  assert.deepEqual(at(0), {value: 0, beyond: null});
  assert.equal(at(1).value.toFixed(6), ((3 * 180) / Math.PI).toFixed(6));
  assert.equal(at(1).beyond, 'above');
  const holds = /timed frames hold their values \(--timed-rounding slerp/;
  const told = (path, options) => open(path, options).document.facts.join('; ');
  assert.match(told('timed.seq'), holds);
  assert.match(told('timed.seq', {'timed-rounding': 'slerp'}), /timed frames are interpolated/);
  assert.doesNotMatch(told('joints.seq'), /timed/);
});
