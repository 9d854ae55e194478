// SPDX-License-Identifier: MIT
// What the core's tables and sentences are in Japanese.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {before, test} from 'node:test';
import {imported} from './browser.mjs';
import {openCore} from './core.mjs';
import {smallBvh} from './motions.mjs';

const known = JSON.parse(readFileSync(new URL('../src/words/tables.ja.json', import.meta.url)));
const isJapanese = (text) => /[\u3040-\u30ff\u4e00-\u9fff]/.test(text ?? '');

let core;
let tables;
let words;
before(async () => {
  core = await openCore();
  tables = core.ask('tables');
  globalThis.document = {documentElement: {}}; // whose language is set
  words = await imported('words.ts');
});

/** Every option of the core's tables. */
const allOptions = () => [
  ...tables.formats.flatMap(({read_options, write_options, adapt_options}) => [
    ...read_options,
    ...write_options,
    ...adapt_options,
  ]),
  ...tables.operations.flatMap(({form, flow_form}) =>
    [form, flow_form].flatMap((own) => own?.parameters ?? []),
  ),
  ...tables.warp_options,
];

test('every operation, option and format of the core has its name and help in Japanese', () => {
  assert.ok(tables.operations.length > 0 && allOptions().length > 0);
  const helps = [...tables.operations, ...allOptions()].map(({help}) => help);
  const descriptions = tables.formats.map(({description}) => description);
  const missing = {
    texts: [...helps, ...descriptions].filter((text) => !isJapanese(known.texts[text])),
    operations: tables.operations.filter(({name}) => !isJapanese(known.operations[name])),
    options: allOptions().filter(({name}) => !isJapanese(known.options[name])),
  };
  assert.deepEqual(missing, {texts: [], operations: [], options: []});
  const unused = Object.keys(known.texts).filter(
    (text) => !helps.includes(text) && !descriptions.includes(text),
  );
  assert.deepEqual(unused, [], 'texts that the core does not say');
});

test('sentences of the core are in Japanese with what they name, others stay', () => {
  const {fromCore, setLanguage} = words;
  setLanguage('ja');
  core.addFile('small.bvh', Buffer.from(smallBvh(10)));
  const {up, facing, unit, facts} = core.ask('open', {path: 'small.bvh'}).document;
  for (const reason of [up.reason, facing.reason, unit.reason]) {
    assert.ok(isJapanese(fromCore(reason)), reason);
  }
  assert.ok(facts.includes('positions replace OFFSET'));
  assert.ok(isJapanese(fromCore('positions replace OFFSET')));
  assert.equal(
    fromCore('the legs hang down at rest, joints are high at rest; for z speaks: joints are high'),
    '基本姿勢で脚が下に伸びている、基本姿勢で関節が高い位置にある。' +
      '一方、z 軸を示す手がかり：joints are high',
  );
  assert.equal(
    fromCore('the names tell left from right, first L$1 from R{0}'),
    '関節名の左右（L$1 と R{0} など）から判断',
  );
  const flow = readFileSync(new URL('../../examples/wave.txt', import.meta.url));
  core.addFile('wave.txt', flow);
  const {handle, document: lacking} = core.ask('open', {path: 'wave.txt'});
  assert.match(fromCore(lacking.lacks), /ロボットモデル.*サーボマップ/);
  const {hindrances} = core.ask('written_formats', {handle});
  assert.ok(Object.values(hindrances).every((text) => text === '' || isJapanese(fromCore(text))));
  const {error} = core.ask('write', {handle, name: 'a.csv', options: {decimals: '99'}});
  core.addFile('robot.body', readFileSync(new URL('../../examples/robot.body', import.meta.url)));
  const robot = core.ask('open', {path: 'robot.body'}).handle;
  for (const text of Object.values(core.ask('written_formats', {handle: robot}).hindrances)) {
    assert.ok(text === '' || isJapanese(fromCore(text)), text);
  }
  assert.equal(fromCore(error.message), 'decimals：0〜30 の整数を入力してください（入力：「99」）');
  const turn = "joint 'Arm' turns by 90 degrees from frame 3 to 4";
  assert.equal(fromCore(turn), '関節「Arm」がフレーム 3 から 4 で 90 度回転します');
  assert.match(fromCore(`${turn} and is back in frame 6`), /フレーム 6 で戻ります/);
  const fast =
    "joint 'Arm' moves at up to 400 deg/s (to frame 30), its limit is 360 deg/s; " +
    'too fast in 3 frames, first in 29';
  assert.equal(
    fromCore(fast),
    '関節「Arm」の速度が 400 deg/s（フレーム 30 まで）で上限 360 deg/s を超過。' +
      '超過フレーム数：3、最初：フレーム 29',
  );
  assert.equal(fromCore('expected a list, found none'), 'expected a list, found none');
  setLanguage('en');
  assert.equal(fromCore(turn), turn);
});
