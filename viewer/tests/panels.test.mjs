// SPDX-License-Identifier: MIT
// The panels at the side: joints, curves, edit, info, check, export.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {existsSync, mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import {
  drop,
  imported,
  kinefile,
  launch,
  ofAll,
  ofFirst,
  openPage,
  out,
  phone,
  root,
} from './browser.mjs';
import {smallProject} from './motions.mjs';

const folder = join(out, 'panels');
mkdirSync(folder, {recursive: true});
const specExample = join(root, 'tests/formats/bvh/valid/spec_example.bvh');
const examples = join(root, 'examples');

/** A figure whose arm turns by two degrees a frame; both joints have names of one's choice. */
function writeBvh(name, frames, joints = ['Hips', 'Arm']) {
  const rows = Array.from({length: frames}, (_, f) => `${f} 90 0 0 0 0 ${f * 2} 0 0`);
  const path = join(folder, name);
  writeFileSync(
    path,
    `HIERARCHY
ROOT ${joints[0]}
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT ${joints[1]}
  {
    OFFSET 0 10 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 10 0
    }
  }
}
MOTION
Frames: ${frames}
Frame Time: 0.02
${rows.join('\n')}
`,
  );
  return path;
}

/** Joint values of the robot of the examples, all joints alike, without the pose of its root. */
const robotSeq = (values) => `type: CompositeSeq
content: BodyMotion
formatVersion: 2
components:
  - type: MultiValueSeq
    content: JointDisplacement
    numParts: 18
    numFrames: ${values.length}
    frameRate: 10
    frames:
${values.map((value) => `      - [${Array(18).fill(value).join(', ')}]`).join('\n')}
`;

/** Small, since software draws it. */
const viewport = {width: 1000, height: 680};

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

/** A page with files open; `faults` must be empty at the end. */
async function opened(files, options = {}) {
  const given = {permissions: ['clipboard-read', 'clipboard-write'], ...options};
  const {tab, context, faults} = await openPage(browser, {
    reducedMotion: 'reduce',
    viewport,
    ...given,
  });
  await tab.waitForSelector('#tab-joints', {state: 'attached'});
  await drop(tab, files, 100, 200);
  return {tab, context, faults};
}

/** Opens a panel, where the side is folded away too. */
async function openTab(tab, name) {
  const toggle = await tab.$('#side-toggle[aria-expanded="false"]');
  if (toggle !== null) await toggle.click();
  await tab.click(`#tab-${name}`);
  await tab.waitForSelector(`#panel-${name}:not([hidden])`);
}

const shot = (tab, name) =>
  tab.screenshot({path: join(out, `panels_${name}.png`), timeout: 60_000});
const clipboard = (tab) => tab.evaluate(() => navigator.clipboard.readText());
const frames = (tab) =>
  tab.evaluate(() => document.querySelector('.facts')?.textContent.match(/Frames(\d+)/)?.[1]);
const isShown = (tab, selector, text) =>
  tab.waitForSelector(`${selector}:has-text("${text}")`, {timeout: 10_000});

test('steps become commands that a shell takes: one a warp, one for operations in a row', async () => {
  const {commandLine, operationWord, outputName, quoted, stepText} =
    await imported('panels/steps.ts');
  const warp = {warp: {key: ['100:110', '150:160'], tail: 'extend', contacts: true, ease: ''}};
  const document = {
    path: 'take 1/-walk.amc',
    format: 'amc',
    skeleton: 'take 1/actor.asf',
    servo_map: '',
    project: '',
    options: {fps: '60', 'up-in': 'z', lenient: true},
  };
  const steps = [{operation: 'trim=10:20'}, {operation: 'mirror'}, warp, {operation: 'reverse'}];
  const motion = {document, steps};
  assert.equal(outputName(motion), '-walk_edited.amc');
  assert.equal(stepText(warp), 'warp --key 100:110 --key 150:160 --tail extend --contacts');
  assert.equal(
    commandLine(motion, 'out.bvh'),
    "kinefile edit 'take 1/-walk.amc' trim=10:20 mirror --skeleton 'take 1/actor.asf' " +
      '--fps 60 --up-in z --lenient -o ./-walk.step1.amc &&\n' +
      'kinefile warp ./-walk.step1.amc --key 100:110 --key 150:160 --tail extend --contacts ' +
      "--skeleton 'take 1/actor.asf' --up-in z -o ./-walk.step2.amc &&\n" +
      "kinefile edit ./-walk.step2.amc reverse --skeleton 'take 1/actor.asf' --up-in z -o out.bvh",
  );
  assert.equal(quoted("it's; rm -rf $HOME"), "'it'\\''s; rm -rf $HOME'");
  const parameter = (name, separator, is_required) => ({name, separator, is_required});
  const form = {
    parameters: [parameter('count', '=', true), parameter('to', ':', true), parameter('blend', '')],
  };
  assert.equal(operationWord('loop', form, ['3', '', '']), 'loop=3:');
  assert.equal(operationWord('loop', form, ['3', '4', '5']), 'loop=3:4,blend=5');
  const bare = {parameters: [parameter('axis', '=', false)]};
  assert.equal(operationWord('mirror', bare, ['']), 'mirror');
  assert.equal(operationWord('mirror', bare, ['x']), 'mirror=x');
});

test('the tabs are tabs: arrows, Home and End go through them', async () => {
  const {tab, context, faults} = await opened([writeBvh('tabs.bvh', 4)]);
  await isShown(tab, '.joint', 'Arm');
  await tab.focus('#tab-joints');
  await tab.keyboard.press('ArrowRight');
  assert.equal(await tab.getAttribute('#tab-curves', 'aria-selected'), 'true');
  assert.equal(await tab.isVisible('#panel-joints'), false);
  assert.equal(await tab.isVisible('#panel-curves'), true);
  await tab.keyboard.press('End');
  assert.equal(await tab.evaluate(() => document.activeElement.id), 'tab-export');
  await tab.keyboard.press('ArrowRight');
  assert.equal(await tab.evaluate(() => document.activeElement.id), 'tab-joints');
  assert.deepEqual(faults, []);
  await context.close();
});

test('the Chest of the example in the document of BVH is where the document says', async () => {
  const {tab, context, faults} = await opened([specExample]);
  await tab.click('.joint:has-text("Chest")');
  await isShown(tab, '.readouts h2', 'Chest');
  const position = tab.locator('.values').first();
  const numbers = await position.locator('.number').allTextContents();
  const expected = [8.32964, 40.03869, 89.68911];
  for (const [axis, value] of expected.entries()) {
    assert.ok(Math.abs(Number(numbers[axis]) - value) < 5e-6, `${numbers[axis]} is not ${value}`);
  }
  // Every digit of the double is there, and is copied without the gaps between the groups.
  assert.deepEqual(numbers, ['8.329640301706473', '40.03869482165106', '89.6891140208022']);
  await position.locator('button').click();
  await isShown(tab, '.values button', 'Copied');
  assert.equal(await clipboard(tab), '8.329640301706473 40.03869482165106 89.6891140208022');
  const channels = await tab.locator('.values').nth(1).locator('tr').allTextContents();
  assert.deepEqual(channels, ['Zrotation13.09°', 'Xrotation40.3°', 'Yrotation-24.6°']);
  await shot(tab, 'joints');
  assert.deepEqual(faults, []);
  await context.close();
});

test('joints are found by a part of their name, and chosen with the keyboard', async () => {
  const {tab, context, faults} = await opened([specExample]);
  await isShown(tab, '.joint', 'Hips');
  await tab.fill('#panel-joints .search', 'rightlow');
  assert.deepEqual(await tab.locator('.joint').allTextContents(), ['RightLowArm', 'RightLowLeg']);
  await tab.press('#panel-joints .search', 'ArrowDown');
  await isShown(tab, '.readouts h2', 'RightLowArm');
  await tab.keyboard.press('ArrowDown');
  await isShown(tab, '.readouts h2', 'RightLowLeg');
  await tab.fill('#panel-joints .search', 'nothing of this name');
  await isShown(tab, '.joints .empty', 'No joint');
  await tab.fill('#panel-joints .search', '');
  assert.equal(await tab.locator('.joint').count(), 18);
  assert.equal(await tab.locator('.joint[aria-selected="true"]').textContent(), 'RightLowLeg');
  await tab.waitForFunction(() => {
    const list = document.querySelector('.joints').getBoundingClientRect();
    const row = document.querySelector('.joint[aria-selected="true"]').getBoundingClientRect();
    return row.top >= list.top - 1 && row.bottom <= list.bottom + 1; // lists scroll by pixels
  });
  assert.deepEqual(faults, []);
  await context.close();
});

test('curves go with the time: a click goes to a frame, shift and drag zooms', async () => {
  const {tab, context, faults} = await opened([writeBvh('curves.bvh', 101)]);
  await tab.click('.joint:has-text("Arm")');
  await openTab(tab, 'curves');
  await tab.waitForSelector('.plot canvas');
  assert.equal(await tab.locator('.plot').count(), 1);
  await tab.click('.chip:has-text("angular speed")');
  await tab.click('.chip:has-text("Zrotation")');
  await isShown(tab, 'figcaption', 'Angle [°]');
  assert.equal(await tab.locator('.plot').count(), 3);
  assert.equal(await tab.getAttribute('.chip:has-text("Zrotation")', 'aria-pressed'), 'true');

  const over = tab.locator('.u-over').first();
  const box = await over.boundingBox();
  const at = (part) => [box.x + box.width * part, box.y + box.height / 2];
  // A pixel inside: where the plot begins is no whole pixel with every font.
  const left = [box.x + 1, box.y + box.height / 2];
  const isAbout = (low, high) =>
    tab.waitForFunction(
      ([low, high]) => {
        const angle = [...document.querySelectorAll('figure')].find((one) =>
          one.textContent.includes('Angle ['),
        );
        const value = Number(angle.querySelector('.legend-key .number').textContent);
        return value >= low && value <= high;
      },
      [low, high],
    );
  await tab.mouse.click(...at(0.5));
  await isAbout(98, 102); // the value at the shown frame: Zrotation is twice the frame
  const mark = await tab.locator('.plot-now').first().boundingBox();
  assert.ok(Math.abs(mark.x + 1 - at(0.5)[0]) < 4);

  await tab.keyboard.down('Shift');
  await tab.mouse.move(...at(0.25));
  await tab.mouse.down();
  await tab.mouse.move(...at(0.75), {steps: 4});
  await tab.mouse.up();
  await tab.keyboard.up('Shift');
  const all = tab.locator('.curve-tools button:has-text("Show all")');
  assert.equal(await all.isDisabled(), false);
  await tab.mouse.click(...left);
  await isAbout(46, 54); // frame 25, and a frame for what the drag and the click round
  await shot(tab, 'curves');
  await all.click();
  await tab.mouse.click(...left);
  await isAbout(0, 2);
  assert.deepEqual(faults, []);
  await context.close();
});

test('of a robot joint its value is plotted, until a person chooses', async () => {
  const {tab, context, faults} = await opened([
    join(examples, 'robot.body'),
    join(examples, 'bow.seq'),
  ]);
  const pressed = () =>
    ofAll(tab, '.chip[aria-pressed="true"]', (all) => all.map((one) => one.textContent));
  await tab.click('.joint >> nth=1');
  await openTab(tab, 'curves');
  await tab.waitForSelector('.plot canvas');
  assert.deepEqual(await pressed(), ['q']);
  await isShown(tab, '.legend-key.limits', 'limits -0.785398 … 0.436332');
  await shot(tab, 'limits');
  await openTab(tab, 'joints');
  await tab.click('.joint >> nth=0');
  await openTab(tab, 'curves');
  assert.deepEqual(await pressed(), ['x', 'y', 'z'], 'the root has a place');
  await tab.click('.chip:text-is("y")');
  await openTab(tab, 'joints');
  await tab.click('.joint >> nth=1');
  await openTab(tab, 'curves');
  assert.deepEqual(await pressed(), ['x', 'z']);
  assert.deepEqual(faults, []);
  await context.close();
});

test('curves of several motions lie over each other, in their colours', async () => {
  const files = [writeBvh('first.bvh', 60), writeBvh('second.bvh', 90)];
  const {tab, context, faults} = await opened(files, {colorScheme: 'dark'});
  await tab.click('.joint:has-text("Arm")');
  await openTab(tab, 'curves');
  await isShown(tab, '.legend-key', 'x second.bvh');
  assert.equal(await tab.locator('.legend-key').count(), 6);
  const colours = await tab
    .locator('.legend-key .dash')
    .evaluateAll((lines) => [...new Set(lines.map((line) => line.style.borderColor))]);
  assert.equal(colours.length, 2);
  await tab.selectOption('.curve-tools select', 'seconds');
  await tab.waitForSelector('.plot canvas');
  await shot(tab, 'overlay_dark');
  await tab.emulateMedia({colorScheme: 'light'});
  await tab.waitForFunction(
    (dark) => document.querySelector('.legend-key .dash').style.borderColor !== dark,
    colours[0],
  );
  assert.deepEqual(faults, []);
  await context.close();
});

test('an operation is applied, refused, undone, removed, and its command copied', async () => {
  const path = writeBvh('edited.bvh', 40);
  const {tab, context, faults} = await opened([path]);
  await openTab(tab, 'edit');
  // What an operation does stands before the command's word for it.
  assert.equal(await tab.textContent('.operation b'), 'Some frames alone');
  assert.match(await tab.textContent('.operation code'), /^trim=/);
  await shot(tab, 'edit_list');
  await tab.fill('#panel-edit .search', 'frames alone');
  await tab.click('.operation:has-text("trim")');
  await tab.fill('form [name="begin"]', '30');
  await tab.fill('form [name="end"]', '20');
  await tab.click('form button:has-text("Apply")');
  // What the core says stands at the form, and nowhere else.
  await isShown(tab, 'form .refusal', 'trim');
  await shot(tab, 'edit_refused');
  assert.equal(await tab.locator('.steps li').count(), 0);
  await tab.fill('form [name="begin"]', '10');
  await tab.fill('form [name="end"]', '20');
  await tab.press('form [name="end"]', 'Enter');
  await isShown(tab, '.steps', 'Some frames alone trim=10:20');
  assert.equal(await tab.textContent('form .refusal'), '');

  await tab.fill('#panel-edit .search', '');
  await tab.click('.operation:has-text("loop")');
  await tab.fill('form [name="count"]', '3');
  await tab.fill('form [name="blend"]', '2');
  await tab.click('form button:has-text("Apply")');
  await isShown(tab, '.steps', 'loop=3,blend=2');
  await tab.click('button:has-text("Copy the command line")');
  await isShown(tab, '.copy', 'Copied');
  const command = 'kinefile edit edited.bvh trim=10:20 loop=3,blend=2 -o edited_edited.bvh';
  assert.equal(await clipboard(tab), command);

  await tab.click('button[aria-label="Remove the step trim=10:20"]');
  await tab.waitForSelector('.steps:not(:has-text("trim"))');
  assert.deepEqual(await tab.locator('.steps code').allTextContents(), ['loop=3,blend=2']);
  await openTab(tab, 'info');
  assert.equal(await frames(tab), String(40 * 3 - 2 * 2));
  await openTab(tab, 'edit');
  await tab.click('button:has-text("Compare with the original")');
  await isShown(tab, '#motions', 'edited.bvh (original)');
  await openTab(tab, 'edit');
  // The changed one stays the active one; the original is yellow.
  await isShown(tab, '.steps', 'loop=3');
  await shot(tab, 'edit_compare');
  assert.deepEqual(faults, []);
  await context.close();
});

test('a parameter that names a file takes one of the files of the page', async () => {
  const files = [writeBvh('before.bvh', 20), writeBvh('behind.bvh', 15)];
  const {tab, context, faults} = await opened(files);
  await isShown(tab, '#motions', 'behind.bvh');
  await openTab(tab, 'edit');
  await tab.click('.operation:has-text("append")');
  await tab.selectOption('form [name="file"]', 'behind.bvh');
  await tab.click('form button:has-text("Apply")');
  await isShown(tab, '.steps', 'append=behind.bvh');
  await openTab(tab, 'info');
  assert.equal(await frames(tab), '35');
  assert.deepEqual(faults, []);
  await context.close();
});

test('undo and redo go through the steps', async () => {
  const {tab, context, faults} = await opened([writeBvh('history.bvh', 20)]);
  await openTab(tab, 'edit');
  for (const name of ['reverse', 'in-place']) {
    await tab.click(`.operation:has(code:text-is("${name}"))`);
    await tab.click('form button:has-text("Apply")');
    await isShown(tab, '.steps', name);
  }
  await tab.click('button:has-text("Undo")');
  await tab.waitForSelector('.steps:not(:has-text("in-place"))');
  await tab.click('button:has-text("Redo")');
  await isShown(tab, '.steps', 'in-place');
  assert.deepEqual(await tab.locator('.steps code').allTextContents(), ['reverse', 'in-place']);
  assert.deepEqual(faults, []);
  await context.close();
});

test('the copied command does what the page does', {skip: !existsSync(kinefile)}, async () => {
  const path = writeBvh("it's a clip.bvh", 30);
  const {tab, context, faults} = await opened([path]);
  await openTab(tab, 'edit');
  await tab.click('.operation:has-text("speed")');
  await tab.fill('form [name="factor"]', '1.5');
  await tab.click('form button:has-text("Apply")');
  await isShown(tab, '.steps', 'speed=1.5');
  await openTab(tab, 'export');
  const [saved] = await Promise.all([
    tab.waitForEvent('download'),
    tab.click('#panel-export button:has-text("Save")'),
  ]);
  const command = await tab.textContent('.command');
  const made = join(folder, "it's a clip_edited.bvh");
  rmSync(made, {force: true});
  execFileSync('sh', ['-c', command.replace(/^kinefile/, '"$KINEFILE"')], {
    cwd: folder,
    env: {...process.env, KINEFILE: kinefile},
    stdio: 'pipe',
  });
  assert.equal(readFileSync(await saved.path(), 'utf8'), readFileSync(made, 'utf8'));
  assert.deepEqual(faults, []);
  await context.close();
});

test('a format has its own options, which are saved and in the command', {
  skip: !existsSync(kinefile),
}, async () => {
  const path = writeBvh('options.bvh', 12);
  const {tab, context, faults} = await opened([path]);
  await openTab(tab, 'edit');
  await tab.click('.operation:has-text("trim")');
  await tab.fill('form [name="begin"]', '2');
  await tab.fill('form [name="end"]', '8');
  await tab.click('form button:has-text("Apply")');
  await isShown(tab, '.steps', 'trim=2:8');
  await openTab(tab, 'export');
  await tab.click('.write-options summary');
  await tab.fill('.write-options [name="decimals"]', '99');
  await tab.click('#panel-export button:has-text("Save")');
  await isShown(tab, '.told', 'Nothing was saved');
  await isShown(tab, '.told', 'expected a whole number from 0 to 30');
  await tab.fill('.write-options [name="decimals"]', '2');
  const edit = 'kinefile edit options.bvh trim=2:8';
  assert.equal(await tab.textContent('.command'), `${edit} --decimals 2 -o options_edited.bvh`);
  await tab.fill('.write-options [name="order"]', 'XYZ');
  // Only `convert` has an order.
  const command = `${edit} -o options.step1.bvh &&
kinefile convert options.step1.bvh --decimals 2 --order XYZ -o options_edited.bvh`;
  assert.equal(await tab.textContent('.command'), command);
  await shot(tab, 'export_options');
  const [saved] = await Promise.all([
    tab.waitForEvent('download'),
    tab.click('#panel-export button:has-text("Save")'),
  ]);
  for (const name of ['options.step1.bvh', 'options_edited.bvh']) {
    rmSync(join(folder, name), {force: true});
  }
  execFileSync('sh', ['-c', command.replaceAll(/^kinefile/gm, '"$KINEFILE"')], {
    cwd: folder,
    env: {...process.env, KINEFILE: kinefile},
    stdio: 'pipe',
  });
  const made = readFileSync(join(folder, 'options_edited.bvh'), 'utf8');
  assert.match(made, /CHANNELS 3 Xrotation Yrotation Zrotation/);
  assert.equal(readFileSync(await saved.path(), 'utf8'), made);
  // Another format has others, and the first ones are there again with the first format.
  await tab.selectOption('#export-format', 'choreonoid');
  assert.equal(await tab.locator('.write-options [name="seq-version"]').count(), 1);
  await tab.click('.write-options summary');
  await tab.check('.write-options [name="choreonoid-digits"]');
  assert.match(await tab.textContent('.command'), / --choreonoid-digits -o options_edited\.seq$/);
  await tab.selectOption('#export-format', 'bvh');
  assert.equal(await tab.inputValue('.write-options [name="decimals"]'), '2');
  assert.deepEqual(faults, []);
  await context.close();
});

test('the file is read again with other options', async () => {
  const {tab, context, faults} = await opened([writeBvh('read.bvh', 10)]);
  await openTab(tab, 'info');
  await isShown(tab, '.facts', '50 frames a second');
  await tab.fill('[name="fps"]', '25');
  await tab.press('[name="fps"]', 'Enter');
  await isShown(tab, '.facts', '25 frames a second');
  await tab.selectOption('[name="up-in"]', 'z');
  await isShown(tab, '.facts', 'known');
  await isShown(tab, '.facts', '25 frames a second');
  await tab.fill('[name="unit-in"]', 'furlong');
  await tab.press('[name="unit-in"]', 'Enter');
  await isShown(tab, '.refusal', 'furlong');
  await shot(tab, 'info');
  await openTab(tab, 'export');
  await tab.selectOption('#export-format', 'csv');
  assert.equal(
    await tab.textContent('.command'),
    'kinefile convert read.bvh --fps 25 --up-in z -o read.csv',
  );
  assert.deepEqual(faults, []);
  await context.close();
});

test('a file at fault shows its messages as check does', async () => {
  const good = writeBvh('bad.bvh', 3, ['ヒップ', '<img/src=x/onerror=alert(1)>']);
  const text = readFileSync(good, 'utf8')
    .replace('JOINT', '関節 JOINT')
    .replace('OFFSET 0 10 0\n    CHANNELS', 'OFFSET 0 1o 0\n    CHANNELS');
  writeFileSync(good, text);
  const {tab, context, faults} = await opened([writeBvh('whole.bvh', 3), good]);
  await isShown(tab, '#motions', 'whole.bvh');
  await openTab(tab, 'check');
  await isShown(tab, '.diagnostic', 'bad.bvh:6:3');
  await isShown(tab, '.diagnostic', "found '関節'");
  // The caret is a byte of UTF-8; the page marks the letter.
  assert.equal(await tab.locator('.excerpt mark').first().textContent(), '関');
  assert.ok(Number(await tab.textContent('#tab-check .count')) >= 1);
  await tab.click('.diagnostic summary');
  await isShown(tab, '.diagnostic details[open]', 'Cause:');
  await shot(tab, 'check_fault');
  assert.deepEqual(faults, []);
  await context.close();
});

test('a file is repaired and opened, and says what was repaired', async () => {
  const path = writeBvh('repaired.bvh', 3);
  writeFileSync(path, readFileSync(path, 'utf8').replace('    OFFSET 0 10 0\n    CH', '    CH'));
  const {tab, context, faults} = await opened([writeBvh('whole.bvh', 3), path]);
  await isShown(tab, '#motions', 'whole.bvh');
  await openTab(tab, 'check');
  await isShown(tab, '.diagnostic.error', 'BVH006');
  await tab.click('button:has-text("Repair and open")');
  await isShown(tab, '.diagnostic.warning', 'BVH006');
  assert.equal(await tab.locator('.diagnostic.error').count(), 0);
  await openTab(tab, 'info');
  assert.equal(await tab.isChecked('[name="lenient"]'), true);
  assert.deepEqual(faults, []);
  await context.close();
});

test('repair is offered where it helps alone', async () => {
  const whole = readFileSync(writeBvh('whole.bvh', 3), 'utf8');
  const mended = writeBvh('mended.bvh', 3);
  writeFileSync(mended, whole.replace('    OFFSET 0 10 0\n    CH', '    CH'));
  const cut = writeBvh('cut.bvh', 3);
  writeFileSync(cut, whole.slice(0, 80));
  const {tab, context, faults} = await opened([mended, cut]);
  await isShown(tab, '.file.fault:has-text("mended.bvh") button', 'Repair and open');
  // Nothing has changed since it was refused.
  const again = '.file.fault:has-text("cut.bvh") button:text-is("Try again")';
  await isShown(tab, '.file.fault', 'cut.bvh');
  assert.equal(await tab.locator(again).count(), 0);
  await openTab(tab, 'check');
  await isShown(tab, '.check-panel h2', 'cut.bvh was not opened');
  assert.equal(await tab.locator('.check-panel button:text-is("Repair and open")').count(), 1);
  await shot(tab, 'repair');
  await tab.click('.file.fault button:text-is("Repair and open")');
  await isShown(tab, '#motions', 'mended.bvh');
  await tab.waitForFunction(() => document.querySelectorAll('.file.fault').length === 1);
  // Now there is another file that it might need.
  await tab.waitForSelector(again);
  await tab.click(again);
  await tab.waitForSelector(again, {state: 'detached'});
  assert.deepEqual(faults, []);
  await context.close();
});

/** A folder of takes with what else lies in such a folder. */
function writeTakes(name, numTakes) {
  const day = join(folder, name);
  rmSync(day, {recursive: true, force: true});
  mkdirSync(day, {recursive: true});
  for (let take = 1; take <= numTakes; take++) {
    writeFileSync(join(day, `take${take}.bvh`), readFileSync(writeBvh('take.bvh', take + 2)));
  }
  writeFileSync(join(day, 'notes.txt'), 'Take 3 is the good one.\n');
  writeFileSync(join(day, 'shots.csv'), 'take,actor\n1,A\n');
  writeFileSync(join(day, 'still.jpg'), 'no picture\n');
  return day;
}

test('of a folder full of takes the first opens, the others are one click each', async () => {
  const {tab, context, faults} = await opened([writeTakes('day', 12)]);
  await isShown(tab, '#files .waiting summary', '12 motions here, 1 open');
  assert.deepEqual(await tab.locator('.motion .name').allTextContents(), ['take1.bvh']);
  const listed = await tab.locator('.waiting li').allTextContents();
  assert.deepEqual(
    listed,
    Array.from({length: 11}, (_, index) => `take${index + 2}.bvh`),
  );
  assert.equal(await tab.locator('.file.fault').count(), 0);
  await isShown(tab, '#files .unknown summary', 'Files that are no motions: 3');
  await tab.click('#files .unknown summary');
  await isShown(tab, '#files .unknown', "found 'take'");
  await shot(tab, 'folder');
  await tab.click('.waiting button:text-is("take7.bvh")');
  await isShown(tab, '#files .waiting summary', '12 motions here, 2 open');
  await isShown(tab, '.motion.active', 'take7.bvh');
  await tab.click('[aria-label="Close take7.bvh"]');
  await isShown(tab, '#files .waiting summary', '12 motions here, 1 open');
  assert.equal(await tab.locator('.waiting button:text-is("take7.bvh")').count(), 1);
  // The folder once more changes nothing.
  await drop(tab, [join(folder, 'day')], 100, 200);
  await isShown(tab, '#status', 'take1.bvh is open already');
  await isShown(tab, '#files .waiting summary', '12 motions here, 1 open');
  await shot(tab, 'folder_again');
  assert.deepEqual(faults, []);
  await context.close();
});

test('of several robots the first opens, the others are one click each', async () => {
  const robots = join(folder, 'robots');
  mkdirSync(robots, {recursive: true});
  for (const name of ['first', 'second', 'third']) {
    writeFileSync(join(robots, `${name}.body`), readFileSync(join(examples, 'robot.body')));
  }
  const {tab, context, faults} = await opened([robots]);
  await isShown(tab, '#files .waiting summary', '3 robots and motions here, 1 open');
  assert.deepEqual(await tab.locator('.motion .name').allTextContents(), ['first.body']);
  const listed = await tab.locator('.waiting li').allTextContents();
  assert.deepEqual(listed, ['second.body', 'third.body']);
  await shot(tab, 'robots');
  await tab.click('.waiting button:text-is("third.body")');
  await isShown(tab, '.motion.active', 'third.body');
  await tab.click('[aria-label="Close third.body"]');
  await isShown(tab, '#files .waiting summary', '3 robots and motions here, 1 open');
  assert.deepEqual(faults, []);
  await context.close();
});

test('of a few takes all open', async () => {
  const {tab, context, faults} = await opened([writeTakes('pair', 2)]);
  await isShown(tab, '.motion', 'take2.bvh');
  await isShown(tab, '.motion', 'take1.bvh');
  await isShown(tab, '#files .unknown summary', 'Files that are no motions: 3');
  assert.equal(await tab.locator('.waiting').count(), 0);
  assert.deepEqual(faults, []);
  await context.close();
});

test('the same file once more is selected, another one of its name opens beside it', async () => {
  const twice = writeBvh('twice.bvh', 5);
  const {tab, context, faults} = await opened([twice, writeBvh('other.bvh', 5)]);
  await isShown(tab, '.motion.active', 'other.bvh');
  await drop(tab, [twice], 100, 200);
  await isShown(tab, '#status', 'twice.bvh is open already');
  await isShown(tab, '.motion.active', 'twice.bvh');
  assert.equal(await tab.locator('.motion').count(), 2);
  await drop(tab, [writeBvh('twice.bvh', 8)], 100, 200);
  await tab.waitForFunction(() => document.querySelectorAll('.motion').length === 3);
  assert.deepEqual(faults, []);
  await context.close();
});

test('the tab of the check has its count before it was open', async () => {
  const seq = join(folder, 'limits.seq');
  writeFileSync(seq, robotSeq([0, 0.1, 3]));
  const {tab, context, faults} = await opened([join(examples, 'robot.body'), seq]);
  await tab.waitForSelector('#tab-check .count:not([hidden])');
  assert.ok(Number(await tab.textContent('#tab-check .count')) > 1);
  assert.equal(await tab.isVisible('#panel-check'), false);
  // The joint, its limits and how far it is beyond them.
  await tab.click('.joint:has-text("LEG_R_HIP_R")');
  await isShown(tab, '.values th', 'turns about x');
  await isShown(tab, '.values tr:has-text("limits")', '-45 … 25°');
  await isShown(tab, '.values tr:has-text("top speed")', '360°/s');
  await isShown(tab, '.values tr:has-text("joint id")', '0');
  assert.equal(await tab.locator('.values .beyond').count(), 0);
  await tab.fill('#frame', '2');
  await tab.press('#frame', 'Enter');
  await isShown(tab, '.values .beyond', 'above its limit');
  await shot(tab, 'robot_joint');
  // What the file does not say, and what it was read with.
  await openTab(tab, 'info');
  await isShown(tab, '.sentences', 'it stands at the origin');
  await tab.selectOption('#companion-skeleton', '');
  await isShown(tab, '.refusal', 'expected');
  assert.deepEqual(faults, []);
  await context.close();
});

test('Info says what a motion was read with, and where an option of the core is', async () => {
  const {tab, context, faults} = await opened([join(examples, 'bow.seq')]);
  await openTab(tab, 'info');
  await isShown(tab, '#companion-skeleton', 'none: the links as recorded');
  await isShown(tab, '.sentences', 'timed frames hold their values');
  await isShown(tab, '.sentences .here', 'How the file is read, “timed-rounding”');
  assert.equal(await tab.locator('.sentences:has-text("origin")').count(), 0);
  await tab.selectOption('[name="timed-rounding"]', 'slerp');
  await isShown(tab, '.sentences', 'timed frames are interpolated');
  await shot(tab, 'timed');
  assert.deepEqual(faults, []);
  await context.close();
});

test('what stands out in a motion is listed, and a click goes there', async () => {
  const path = writeBvh('spike.bvh', 60);
  const rows = readFileSync(path, 'utf8');
  writeFileSync(path, rows.replace('\n30 90 0 0 0 0 60 0 0\n', '\n30 90 0 0 0 0 200 0 0\n'));
  const {tab, context, faults} = await opened([path]);
  await openTab(tab, 'check');
  await tab.click('.diagnostic:has-text("Arm") .go');
  await shot(tab, 'marks');
  await openTab(tab, 'joints');
  await isShown(tab, '.readouts h2', 'frame 30');
  assert.equal(await tab.locator('.joint[aria-selected="true"]').textContent(), 'Arm');
  // After a step the frames are no longer those that the check of the file names.
  await openTab(tab, 'edit');
  await tab.click('.operation:has(code:text-is("reverse"))');
  await tab.click('form button:has-text("Apply")');
  await isShown(tab, '.steps', 'reverse');
  await openTab(tab, 'check');
  await tab.click('.mark:has-text("Arm")');
  await openTab(tab, 'joints');
  await isShown(tab, '.readouts h2', 'frame 29');
  assert.deepEqual(faults, []);
  await context.close();
});

test('a flow of servo poses: its own operations, its robot and its servo map', async () => {
  const names = ['robot.body', 'servos.yaml', 'wave.txt'];
  const {tab, context, faults} = await opened(names.map((name) => join(examples, name)));
  await openTab(tab, 'info');
  await isShown(tab, '.facts', 'flow of servo poses');
  assert.equal(await tab.inputValue('#companion-skeleton'), 'robot.body');
  assert.equal(await tab.inputValue('#companion-servo_map'), 'servos.yaml');
  const labels = await tab.evaluate(() =>
    [...document.querySelectorAll('.track .block .label')].map((one) => one.textContent),
  );
  assert.ok(labels.length > 1 && labels.every((text) => text !== ''), `${labels}`);
  await shot(tab, 'flow');
  await openTab(tab, 'edit');
  await isShown(tab, '.operation', 'offset=SLIDER:VALUE');
  assert.equal(await tab.locator('.operation:has-text("trim")').count(), 0);
  assert.deepEqual(faults, []);
  await context.close();
});

test('a flow alone has its poses and their values, and says what a figure needs', async () => {
  const {tab, context, faults} = await opened([join(examples, 'wave.txt')]);
  await isShown(
    tab,
    '.lacks',
    "wave.txt: to see a figure, a flow of servo poses needs the robot's",
  );
  await tab.waitForSelector('.track .block .label');
  await isShown(tab, '.readouts h2', 'wave.txt');
  await tab.fill('#frame', '60');
  await tab.press('#frame', 'Enter');
  await isShown(tab, '.values tr:has-text("s12")', '28672');
  assert.equal(await tab.locator('.values table').count(), 1, 'nothing of it has a place');
  await shot(tab, 'flow_alone');
  await openTab(tab, 'curves');
  await isShown(tab, '.legend-key', 's12');
  await shot(tab, 'flow_curves');
  await openTab(tab, 'info');
  await isShown(tab, '.sentences', 'to see a figure');
  assert.equal(await tab.locator('dt:text-is("Height")').count(), 0);
  await openTab(tab, 'export');
  await tab.waitForSelector('#export-format');
  const formats = await tab
    .locator('#export-format option')
    .evaluateAll((all) => all.map(({value}) => value));
  assert.deepEqual(formats, ['robovie', 'csv', 'json']);
  // What comes is kept: then the other one alone is asked for.
  for (const [name, text] of Object.entries(smallProject)) writeFileSync(join(folder, name), text);
  await drop(
    tab,
    Object.keys(smallProject).map((name) => join(folder, name)),
    100,
    200,
  );
  await isShown(tab, '.lacks', "needs the robot's model (.body, .wrl, .urdf)");
  await tab.waitForFunction(() => !document.querySelector('.lacks').textContent.includes('.rpj'));
  await openTab(tab, 'info');
  assert.equal(await tab.inputValue('#companion-project'), 'robot.rpj');
  await openTab(tab, 'joints');
  await isShown(tab, '.values tr', 'shoulder [°]');
  await drop(
    tab,
    ['robot.body', 'servos.yaml'].map((name) => join(examples, name)),
    100,
    200,
  );
  await tab.waitForSelector('.lacks', {state: 'hidden'});
  await isShown(tab, '.joint', 'LEG_R_HIP_R');
  assert.equal(await tab.locator('.motion').count(), 1);
  await shot(tab, 'flow_complete');
  assert.deepEqual(faults, []);
  await context.close();
});

test('a format that a motion cannot be written in is not offered, and says what it needs', async () => {
  const {tab, context, faults} = await opened([writeBvh('offered.bvh', 5)]);
  await openTab(tab, 'export');
  await isShown(tab, '.hindered summary', 'Formats that this cannot be written in: 2');
  assert.equal(await tab.locator('#export-format option[value="robovie"]').count(), 0);
  await tab.click('.hindered summary');
  await isShown(tab, '.hindered li', "'kinefile keyframe' with a servo map");
  await shot(tab, 'export_offers');
  assert.deepEqual(faults, []);
  await context.close();
});

test('names with markup in them are text', async () => {
  const name = '<img/src=x/onerror=globalThis.hit=1>';
  const files = [writeBvh('hostile.bvh', 5, ['Hips', name])];
  const {tab, context, faults} = await opened(files);
  await tab.click(`.joint >> text=${name}`);
  await isShown(tab, '.readouts h2', name);
  for (const panel of ['curves', 'edit', 'info', 'check', 'export']) await openTab(tab, panel);
  assert.equal(await tab.locator('#side img').count(), 0);
  assert.equal(await tab.evaluate(() => globalThis.hit), undefined);
  assert.deepEqual(faults, []);
  await context.close();
});

test('motions, tables of positions and the original are saved', async () => {
  const path = writeBvh('saved.bvh', 6);
  const {tab, context, faults} = await opened([path]);
  await openTab(tab, 'export');
  const save = async (selector) => {
    const [download] = await Promise.all([tab.waitForEvent('download'), tab.click(selector)]);
    return {name: download.suggestedFilename(), text: readFileSync(await download.path(), 'utf8')};
  };
  const source = await save('#panel-export .bar button:has-text("saved.bvh")');
  assert.deepEqual(source, {name: 'saved.bvh', text: readFileSync(path, 'utf8')});
  const positions = await save('#panel-export .bar button:has-text("CSV")');
  assert.equal(positions.name, 'saved_positions.csv');
  assert.equal(positions.text.split('\n')[1].split(',')[2], 'Hips');
  await tab.selectOption('#export-format', 'choreonoid');
  assert.equal(await tab.inputValue('#export-name'), 'saved.seq');
  const motion = await save('#panel-export button:has-text("Save")');
  assert.equal(motion.name, 'saved.seq');
  assert.match(motion.text, /BodyMotion/);
  await isShown(tab, '.told', 'Saved: saved.seq');
  await shot(tab, 'export');
  assert.deepEqual(faults, []);
  await context.close();
});

test('a robot: links with the joints that move them, and which robot a motion is read with', async () => {
  const files = [join(examples, 'robot.body'), join(examples, 'bow.seq')];
  const {tab, context, faults} = await opened(files);
  await isShown(tab, '.joint', 'LEG_R_HIP_R');
  await openTab(tab, 'info');
  await isShown(tab, '.facts', 'body motion of a robot');
  assert.equal(await tab.inputValue('#companion-skeleton'), 'robot.body');
  await openTab(tab, 'edit');
  await isShown(tab, '.operation', 'zmp');
  // What works on skeletons alone is not offered.
  assert.equal(await tab.locator('.operation:has-text("mirror")').count(), 0);
  await shot(tab, 'robot');
  assert.deepEqual(faults, []);
  await context.close();
});

test('a phone, in Japanese and dark', async () => {
  const {tab, context, faults} = await opened([specExample], phone);
  await openTab(tab, 'joints');
  await tab.tap('.joint:has-text("Chest")');
  await isShown(tab, '.readouts h2', 'フレーム 0');
  for (const panel of ['joints', 'curves', 'edit', 'info', 'check', 'export']) {
    await openTab(tab, panel);
    const [wide, wanted] = await ofFirst(tab, `#panel-${panel}`, (own) => [
      own.clientWidth,
      own.scrollWidth,
    ]);
    assert.ok(wanted <= wide, `${panel} is ${wanted} wide on ${wide}`);
    await shot(tab, `phone_${panel}`);
  }
  assert.equal(await tab.textContent('#tab-export'), '書き出し');
  // What the core's tables say has Japanese beside the command's words, and is found by both.
  await openTab(tab, 'edit');
  for (const wanted of ['左右', 'mirror']) {
    await tab.fill('.edit-panel .search', wanted);
    assert.equal(await tab.locator('.operation').count(), 1);
    assert.equal(await tab.textContent('.operation b'), '左右反転');
    assert.equal(await tab.textContent('.operation code'), 'mirror[=x|y|z]');
  }
  await tab.tap('.operation');
  await isShown(tab, '.field label', '軸 axis');
  await isShown(tab, '.field small', '反転する方向の軸');
  await tab.tap('.operations .primary');
  await isShown(tab, '.steps li', '左右反転 mirror');
  await openTab(tab, 'info');
  await isShown(tab, '.field label', 'フレームレート fps');
  await isShown(tab, '.facts small', '関節名の左右（');
  assert.deepEqual(faults, []);
  await context.close();
});
