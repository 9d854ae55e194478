// SPDX-License-Identifier: MIT
// The timeline, the time warp, keys, address, files, layout.
import assert from 'node:assert/strict';
import {existsSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import {data, drop, launch, ofAll, ofFirst, openPage, out, page, phone, root} from './browser.mjs';
import {carryingPage, fileOf, smallAmc, smallAsf, smallBvh} from './motions.mjs';

const kSmall = {viewport: {width: 900, height: 620}, reducedMotion: 'reduce'};
const bvh = fileOf('small.bvh', smallBvh());
let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

/** A page with files open; it is closed, and must have had no faults, after the test. */
async function withPage(t, files, options = {}, file = page, hash = '') {
  const opened = await openPage(browser, {...kSmall, ...options}, file, hash);
  t.after(() => opened.context.close());
  const {tab} = opened;
  if (files.length > 0) {
    await drop(tab, files);
    await tab.waitForSelector('.motion');
  }
  return opened;
}

const frameOf = (tab) => tab.inputValue('#frame').then(Number);
const textOf = (tab, selector) => tab.textContent(selector);
const count = (tab, selector) => tab.locator(selector).count();
const waitFrame = (tab, frame) =>
  tab.waitForFunction((wanted) => document.querySelector('#frame').value === wanted, `${frame}`);
const waitText = (tab, selector, wanted) =>
  tab.waitForFunction(
    ([where, text]) => document.querySelector(where)?.textContent.includes(text),
    [selector, wanted],
  );
const waitHash = (tab, part) => tab.waitForFunction((text) => location.hash.includes(text), part);
const press = (tab, ...keys) =>
  keys.reduce((done, key) => done.then(() => tab.keyboard.press(key)), Promise.resolve());
const lastFrame = (tab) => textOf(tab, '.frame-field .last').then((text) => Number(text.slice(1)));

/**
 * Where an element of a drawing is, in the window. Drawings replace their elements: it is found and
 * measured in one go.
 */
const middleOf = (tab, selector) =>
  tab.evaluate((wanted) => {
    const {x, y, width, height} = document.querySelector(wanted).getBoundingClientRect();
    return {x: x + width / 2, y: y + height / 2};
  }, selector);

async function drag(tab, selector, right, down = 0) {
  const {x, y} = await middleOf(tab, selector);
  await tab.mouse.move(x, y);
  await tab.mouse.down();
  await tab.mouse.move(x + right / 2, y + down / 2);
  await tab.mouse.move(x + right, y + down);
  await tab.mouse.up();
}

/** The editor open, with a key at frame 50. */
async function withKey(tab) {
  await tab.click('.warp-button');
  await tab.waitForSelector('.warp:not([hidden])');
  await tab.waitForFunction(() => document.querySelectorAll('.motion').length === 2);
  await tab.fill('#frame', '50');
  await press(tab, 'Enter');
  await tab.click('.warp_add');
  await tab.waitForSelector('.key');
}

for (const [name, options] of [
  ['desktop', {}],
  ['phone', {...phone, locale: 'en-GB'}],
]) {
  test(`the empty page is seen and can be clicked: ${name}`, async (t) => {
    const {tab, faults} = await withPage(t, [], options);
    await tab.waitForSelector('#empty .formats li');
    const {x, y} = await middleOf(tab, '#empty .primary');
    const isOnTop = await tab.evaluate(
      ([left, top]) => document.elementFromPoint(left, top)?.matches('#empty .primary') === true,
      [x, y],
    );
    assert.ok(isOnTop, 'something lies over the button');
    await tab.screenshot({path: join(out, `timeline-empty-${name}.png`)});
    await tab.evaluate(() => {
      const input = document.querySelector('#choose-files');
      input.addEventListener('click', (event) => {
        event.preventDefault();
        globalThis.asksFor = input.multiple ? 'files' : 'file';
      });
    });
    await (options.hasTouch ? tab.touchscreen.tap(x, y) : tab.mouse.click(x, y));
    await tab.waitForFunction(() => globalThis.asksFor === 'files');
    assert.deepEqual(faults, []);
  });
}

test('frames: keys, field, scrubbing', async (t) => {
  const {tab, faults} = await withPage(t, [bvh]);
  await press(tab, 'ArrowRight', 'ArrowRight', 'ArrowLeft');
  assert.equal(await frameOf(tab), 1);
  await press(tab, 'Shift+ArrowRight');
  assert.equal(await frameOf(tab), 11);
  await press(tab, 'Shift+ArrowLeft');
  assert.equal(await frameOf(tab), 1);
  await press(tab, 'End');
  assert.equal(await frameOf(tab), 119);
  await press(tab, 'Home');
  assert.equal(await frameOf(tab), 0);
  await press(tab, 'f');
  await tab.keyboard.type('73');
  await press(tab, 'Enter');
  assert.equal(await frameOf(tab), 73);
  assert.equal(await textOf(tab, '.readout'), '1.460 s');
  await press(tab, 'f');
  await tab.keyboard.type('lg');
  await press(tab, 'Escape');
  assert.equal(await frameOf(tab), 73, 'what is typed is no shortcut, and is no frame');
  const box = await tab.locator('.track').boundingBox();
  await tab.mouse.click(box.x + box.width / 2, box.y + 20);
  const middle = await frameOf(tab);
  assert.ok(middle > 50 && middle < 75, `a click in the middle went to ${middle}`);
  await tab.locator('.track .playhead').focus();
  await press(tab, 'ArrowRight');
  assert.equal(await frameOf(tab), middle + 1, 'the playhead is a slider, moved once a key');
  assert.deepEqual(faults, []);
});

test('the playhead hides no number of the ruler', async (t) => {
  const {tab} = await withPage(t, [bvh]);
  const [head, label] = await tab.evaluate(() => {
    const box = (selector) => document.querySelector(selector).getBoundingClientRect();
    return [box('.playhead .head').top, box('.track .label').bottom];
  });
  // The box of a text has room below its digits.
  assert.ok(head >= label - 3, `the head begins at ${head}, the number ends at ${label}`);
});

test('a motion of one frame has no time', async (t) => {
  const {tab, faults} = await withPage(t, [fileOf('single.bvh', smallBvh(1))]);
  const labels = () => ofAll(tab, '.track .label', (all) => all.map((one) => one.textContent));
  assert.deepEqual(await labels(), ['0']);
  assert.equal(await textOf(tab, '.readout'), '1 frame');
  await tab.click('.unit');
  assert.deepEqual(await labels(), ['0 s']);
  await tab.screenshot({path: join(out, 'timeline-single.png')});
  await drop(tab, [bvh]);
  await tab.waitForFunction(() => document.querySelectorAll('.track .label').length > 2);
  assert.deepEqual(faults, []);
});

test('playing: space, speed, repeat, range', async (t) => {
  const {tab, faults} = await withPage(t, [bvh]);
  await press(tab, 'Space');
  await tab.waitForFunction(() => document.querySelector('#frame').value !== '0');
  assert.equal(await tab.getAttribute('.play', 'aria-label'), 'Pause');
  await press(tab, 'Space');
  assert.equal(await tab.getAttribute('.play', 'aria-label'), 'Play');
  await tab.click('.play');
  await press(tab, 'Space');
  assert.equal(await tab.getAttribute('.play', 'aria-label'), 'Play', 'after a click, too');

  // A name is drawn anew by its click, and is given the focus again.
  const playing = () => tab.getAttribute('.play', 'aria-label');
  for (const selector of ['.motion .title', '#tab-info', '.warp-button', '.warp-button']) {
    await tab.click(selector);
    await press(tab, 'Space');
    assert.equal(await playing(), 'Pause', `after a click on ${selector}`);
    await press(tab, 'Space');
    assert.equal(await playing(), 'Play');
  }
  await tab.click('[aria-label="Close small.bvh (original)"]');
  await tab.waitForFunction(() => document.querySelectorAll('.motion').length === 1);
  await tab.locator('[aria-label="Hide small.bvh"]').focus();
  await press(tab, 'Space');
  await tab.waitForSelector('[aria-label="Show small.bvh"]');
  await press(tab, 'Space');
  await tab.waitForSelector('[aria-label="Hide small.bvh"]');
  assert.equal(await playing(), 'Play', 'a button that the keyboard went to is pressed');
  await tab.locator('[aria-label="Hide small.bvh"]').blur();
  await press(tab, 'Home');

  await press(tab, '[');
  assert.equal(await tab.inputValue('#speed'), '0.75');
  await press(tab, ']', ']');
  assert.equal(await tab.inputValue('#speed'), '1.5');
  for (let i = 0; i < 9; i++) await press(tab, ']');
  assert.equal(await tab.inputValue('#speed'), '4');

  await press(tab, 'l');
  await press(tab, 'End', 'ArrowLeft', 'ArrowLeft', 'Space');
  await tab.waitForFunction(
    () => document.querySelector('.play').getAttribute('aria-label') === 'Play',
  );
  assert.equal(await frameOf(tab), 119, 'without repeat it stops at the end');

  await press(tab, 'Home', 'Shift+ArrowRight', 'Shift+ArrowRight', 'i');
  assert.equal(await tab.getAttribute('[data-grip="loop:begin"]', 'aria-valuetext'), '0.400 s');
  await press(tab, 'Shift+ArrowRight', 'o');
  assert.equal(await tab.getAttribute('[data-grip="loop:end"]', 'aria-valuetext'), '0.600 s');
  await drag(tab, '[data-grip="loop:end"]', 60);
  const end = Number.parseFloat(await tab.getAttribute('[data-grip="loop:end"]', 'aria-valuetext'));
  assert.ok(end > 0.65 && Math.abs(end / 0.02 - Math.round(end / 0.02)) < 1e-6, `${end}`);
  await tab.locator('[data-grip="loop:end"]').focus();
  await press(tab, 'ArrowLeft');
  const nudged = await tab.getAttribute('[data-grip="loop:end"]', 'aria-valuetext');
  assert.equal(nudged, `${(end - 0.02).toFixed(3)} s`);
  await press(tab, 'Shift+l');
  assert.equal(await tab.getAttribute('[data-grip="loop:begin"]', 'aria-valuetext'), '0.000 s');
  assert.deepEqual(faults, []);
});

test('views and what is shown: each key', async (t) => {
  const {tab, faults} = await withPage(t, [bvh]);
  for (const [key, camera] of [
    ['2', 'front'],
    ['3', 'side'],
    ['4', 'top'],
    ['5', 'follow'],
  ]) {
    await press(tab, key);
    await waitHash(tab, `camera=${camera}`);
  }
  await press(tab, '1');
  await tab.waitForFunction(() => !location.hash.includes('camera'));
  await press(tab, '0');
  for (const [key, name] of [
    ['g', 'Ghosts'],
    ['p', 'Paths'],
    ['c', 'Ground contacts'],
    ['a', 'Axes'],
  ]) {
    await press(tab, key);
    await waitText(tab, '#status', `${name}: on`);
    await press(tab, key);
    await waitText(tab, '#status', `${name}: off`);
  }
  await press(tab, 'n');
  await waitText(tab, '#status', 'Names: off');
  await press(tab, 'h');
  assert.equal(await tab.isVisible('#time'), false);
  assert.equal(await tab.isVisible('#side'), false);
  await press(tab, 'h');
  assert.equal(await tab.isVisible('#time'), true);
  await press(tab, '?');
  assert.equal(await tab.isVisible('#help'), true);
  const together = await ofAll(tab, '#help .keys td:first-child', (all) =>
    all.map((cell) => [cell.textContent, cell.querySelectorAll('kbd').length]),
  );
  assert.deepEqual(
    together.find(([text]) => text.includes('Ctrl Z')),
    ['U / Ctrl Z', 3],
  );
  await tab.screenshot({path: join(out, 'timeline-help.png')});
  assert.match(await textOf(tab, '#help'), /kinefile \d+\.\d+\.\d+/);
  assert.match(await textOf(tab, '#help'), /2010-2026 three\.js authors/);
  assert.match(await textOf(tab, '#help'), /Leon Sorokin/);
  await press(tab, 'ArrowRight');
  assert.equal(await frameOf(tab), 0, 'keys do nothing behind the help');
  await press(tab, 'Escape');
  assert.equal(await tab.isVisible('#help'), false);
  await tab.click('.help-button');
  await press(tab, '?');
  assert.equal(await tab.isVisible('#help'), false);
  assert.deepEqual(faults, []);
});

test('time warp: a dragged key changes the frames, and one undo takes the drag back', async (t) => {
  const {tab, faults} = await withPage(t, [bvh]);
  await withKey(tab);
  const colours = await ofAll(tab, '.motion .swatch', (all) =>
    all.map((one) => one.style.background),
  );
  assert.deepEqual(colours, ['rgb(242, 183, 5)', 'rgb(61, 139, 255)']);
  assert.equal(await textOf(tab, '.key title'), '50 → 50');
  await drag(tab, '.key .diamond', 80);
  await tab.waitForFunction(
    () => document.querySelector('.readout.others').textContent === 'source 50',
  );
  const title = await textOf(tab, '.key title');
  const moved = Number(title.split('→')[1]);
  assert.ok(title.startsWith('50 → ') && moved > 55 && Number.isInteger(moved), title);
  await waitFrame(tab, moved);
  await waitText(tab, '.motion.active', 'time warp');
  assert.equal(await count(tab, '[aria-label="Hide small.bvh (time warp)"]'), 1);
  assert.equal(await textOf(tab, '.lane.active title'), 'Start of small.bvh (time warp)');
  await tab.fill('#frame', '1');
  await press(tab, 'Enter');
  await waitText(tab, '.readout.others', `source ${Math.round((50 / moved) * 1000) / 1000}`);
  await tab.screenshot({path: join(out, 'timeline-warp.png')});

  await press(tab, 'u');
  await waitText(tab, '.key title', '50 → 50');
  await press(tab, 'Shift+u');
  await waitText(tab, '.key title', `50 → ${moved}`);
  await press(tab, 'Control+z');
  await waitText(tab, '.key title', '50 → 50');
  await press(tab, 'Control+Shift+z');
  await waitText(tab, '.key title', `50 → ${moved}`);
  await press(tab, 'm');
  await tab.waitForFunction(() => document.querySelectorAll('.key').length === 0);
  await press(tab, 'm');
  await waitText(tab, '.key title', `50 → ${moved}`);
  await press(tab, 'Escape');
  assert.equal(await tab.isVisible('.warp'), false);
  await press(tab, 'w');
  assert.equal(await tab.isVisible('.warp'), true);
  assert.equal(await count(tab, '.motion'), 2, 'the original is opened only once');
  assert.deepEqual(faults, []);
});

test('time warp: keys by keyboard and numbers, tails, refusals, command, saving', async (t) => {
  const {tab, context, faults} = await withPage(t, [bvh]);
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await withKey(tab);
  await tab.locator('.key').focus();
  await press(tab, 'ArrowRight');
  await waitText(tab, '.key title', '50 → 51');
  await press(tab, 'Shift+ArrowRight');
  await waitText(tab, '.key title', '50 → 61');
  await press(tab, 'ArrowUp');
  await waitText(tab, '.key title', '51 → 61');
  // Found and asked in one go: the drawing replaces its elements.
  const isFocused = () => document.querySelector('.key') === document.activeElement;
  assert.equal(await tab.evaluate(isFocused), true);
  await tab.fill('.key-number >> nth=0', '50');
  await tab.fill('.key-number >> nth=1', '60');
  await press(tab, 'Enter');
  await waitText(tab, '.key title', '50 → 60');
  assert.equal(await lastFrame(tab), 119);
  await tab.selectOption('[data-option="tail"]', 'extend');
  await waitText(tab, '.frame-field .last', '129');
  // A key beyond the motion is refused at its numbers, with the limits.
  await tab.fill('.key-number >> nth=0', '500');
  await press(tab, 'Enter');
  await waitText(tab, '.key-numbers .warp-fault', 'an old frame from 0 to 119');
  const isInvalid = (selector) => ofFirst(tab, selector, (one) => one.ariaInvalid);
  assert.equal(await isInvalid('.key-number'), 'true');
  assert.equal(await isInvalid('[data-option="tail"]'), 'false');
  assert.equal(await count(tab, '.key.refused'), 1);
  assert.equal(await lastFrame(tab), 129, 'the last good warp is kept');
  await tab.screenshot({path: join(out, 'timeline-refused-key.png')});
  await tab.fill('.key-number >> nth=0', '');
  await press(tab, 'Enter');
  await waitText(tab, '.key-numbers .warp-fault', 'Expected a number');
  await tab.fill('.key-number >> nth=0', '50');
  await press(tab, 'Enter');
  await tab.waitForSelector('.warp-fault', {state: 'hidden'});
  await waitText(tab, '.key title', '50 → 60');
  assert.equal(await isInvalid('.key-number'), 'false');
  assert.equal(await count(tab, '.key.refused'), 0);
  // An option that does not fit the keys is refused where it is.
  await tab.selectOption('[data-option="tail"]', 'keep');
  await tab.fill('.key-number >> nth=1', '119');
  await press(tab, 'Enter');
  await waitText(tab, '.key-numbers .warp-fault', 'expected keys before the new frame 119');
  await tab.selectOption('[data-option="tail"]', 'extend');
  await tab.waitForSelector('.warp-fault', {state: 'hidden'});
  await waitText(tab, '.frame-field .last', '188');
  await tab.selectOption('[data-option="tail"]', 'keep');
  await waitText(tab, '.warp-options .warp-fault', 'expected keys before the new frame 119');
  assert.equal(await isInvalid('[data-option="tail"]'), 'true');
  assert.equal(await isInvalid('.key-number'), 'false');
  await tab.selectOption('[data-option="tail"]', 'extend');
  await tab.fill('.key-number >> nth=1', '60');
  await press(tab, 'Enter');
  await waitText(tab, '.frame-field .last', '129');
  await tab.click('.warp-more summary');
  await tab.fill('[data-option="ease"]', 'wobbly');
  await press(tab, 'Enter');
  await waitText(tab, '.warp-fault', 'expected an ease such as smooth');
  assert.equal(await count(tab, '.warp-field:has([data-option="ease"]) .warp-fault'), 1);
  assert.equal(await lastFrame(tab), 129, 'the last good warp is kept');
  await tab.fill('[data-option="ease"]', 'smooth');
  await press(tab, 'Enter');
  await tab.waitForSelector('.warp-fault', {state: 'hidden'});
  await tab.fill('[data-option="ease"]', '');
  await press(tab, 'Enter');
  await tab.click('.warp-more summary');

  // A second key, dragged to before the first: the core's sentence is shown.
  const map = await tab.locator('.warp-map').boundingBox();
  await tab.mouse.dblclick(map.x + map.width * 0.8, map.y + 20);
  await tab.waitForFunction(() => document.querySelectorAll('.key').length === 2);
  const second = await tab.locator('.key title').nth(1).textContent();
  await tab.fill('.key-number >> nth=0', '30');
  await press(tab, 'Enter');
  await waitText(tab, '.warp-fault', 'runs backwards');
  assert.match(await tab.getAttribute('.warp-map .curve', 'class'), /refused/);
  await tab.screenshot({path: join(out, 'timeline-refused.png')});
  await tab.locator('.key').nth(1).focus();
  await press(tab, 'Delete');
  await tab.waitForFunction(() => document.querySelectorAll('.key').length === 1);
  await tab.waitForSelector('.warp-fault', {state: 'hidden'});
  assert.match(second, /→/);

  await tab.click('.warp_copy');
  await waitText(tab, '#status', 'Copied');
  assert.equal(
    await tab.evaluate(() => navigator.clipboard.readText()),
    'kinefile warp small.bvh --tail extend --key 50:60 -o small_warped.bvh',
  );
  const [download] = await Promise.all([tab.waitForEvent('download'), tab.click('.warp_save')]);
  assert.equal(download.suggestedFilename(), 'small_warped.bvh');
  assert.match(readFileSync(await download.path(), 'utf8'), /^Frames: 130$/m);
  assert.deepEqual(faults, []);
});

test('a flow has no time warp, and says why', async (t) => {
  const files = ['robot.body', 'servos.yaml', 'wave.txt'];
  const {tab, faults} = await withPage(
    t,
    files.map((name) => join(root, 'examples', name)),
  );
  await tab.waitForSelector('.warp-button:disabled');
  assert.match(await tab.getAttribute('.warp-button', 'title'), /no frames/);
  await press(tab, 'w');
  await waitText(tab, '#status', 'no frames');
  assert.equal(await count(tab, '.motion'), 1);
  assert.equal(await tab.isVisible('.warp'), false);
  assert.deepEqual(faults, []);
});

test('several motions: offsets by drag and by number, next motion, placement, closing', async (t) => {
  const other = fileOf('other.bvh', smallBvh(60));
  const {tab, faults} = await withPage(t, [bvh, other]);
  await tab.waitForFunction(() => document.querySelectorAll('.motion').length === 2);
  await waitText(tab, '.motion.active', 'other.bvh');
  await press(tab, 'm');
  await waitText(tab, '.motion.active', 'small.bvh');
  const lane = '.lane:not(.active)';
  await drag(tab, lane, 100);
  await waitText(tab, '.motion.active', 'other.bvh');
  const offset = Number(await tab.inputValue('.motion.active .offset'));
  assert.ok(
    offset > 0.1 && Math.abs(offset / 0.02 - Math.round(offset / 0.02)) < 1e-6,
    `${offset}`,
  );
  await tab.fill('.motion.active .offset', '0.5');
  await press(tab, 'Enter');
  await tab.waitForFunction(
    () => document.querySelector('.lane.active').getAttribute('aria-valuetext') === '0.500 s',
  );
  await tab.locator('.lane.active').focus();
  await press(tab, 'ArrowRight');
  assert.equal(await tab.getAttribute('.lane.active', 'aria-valuetext'), '0.520 s');
  await tab.selectOption('#placement', 'beside');
  await tab.click('[aria-label="Hide other.bvh"]');
  await tab.waitForSelector('[aria-label="Show other.bvh"]');
  await tab.click('[aria-label="Close other.bvh"]');
  await tab.waitForFunction(() => document.querySelectorAll('.motion').length === 1);
  assert.equal(await count(tab, '#placement'), 0);
  assert.deepEqual(faults, []);
});

test('an original keeps step with what its frames were cut from; who is not there is faint', async (t) => {
  const {tab, faults} = await withPage(t, [bvh]);
  await tab.click('#tab-edit');
  const apply = async (operation, values) => {
    await tab.click(`.operation:has(code:text-is("${operation}"))`);
    for (const [name, value] of values) await tab.fill(`form [name="${name}"]`, value);
    await tab.click('#panel-edit form button.primary');
    await waitText(tab, '.steps', operation.split('=')[0]);
    await tab.click(`.operation:has(code:text-is("${operation}"))`);
  };
  const offsets = () => ofAll(tab, '.offset', (all) => all.map(({value}) => Number(value)));
  const presence = () => ofAll(tab, '.presence', (all) => all.map((one) => one.textContent));
  await apply('trim=A:B', [
    ['begin', '20'],
    ['end', '70'],
  ]);
  await tab.click('button:has-text("Compare with the original")');
  await tab.waitForFunction(() => document.querySelectorAll('.offset').length === 2);
  await waitText(tab, '.motion.active', '1 change');
  assert.deepEqual(await offsets(), [-0.4, 0], 'frame 20 of the original is the first of the cut');
  await press(tab, 'm');
  await waitText(tab, '.motion.active', 'original');
  assert.equal(await frameOf(tab), 20);
  assert.deepEqual(await presence(), ['', '']);
  await press(tab, 'ArrowLeft');
  assert.deepEqual(await presence(), ['', 'not begun']);
  await press(tab, 'End');
  assert.deepEqual(await presence(), ['', 'over']);
  await press(tab, 'm');
  await waitText(tab, '.readout.others', 'over');
  await tab.screenshot({path: join(out, 'timeline-over.png')});
  // Twice as fast, then 10 frames less: these are 20 of the original.
  await press(tab, 'Home');
  await apply('speed=X', [['factor', '2']]);
  assert.deepEqual(await offsets(), [-0.4, 0]);
  await apply('trim=A:B', [
    ['begin', '10'],
    ['end', '20'],
  ]);
  await tab.waitForFunction(() => document.querySelector('.offset').value === '-0.8');
  await tab.click('#panel-edit button[data-act="undo"]');
  await tab.waitForFunction(() => document.querySelector('.offset').value === '-0.4');
  assert.deepEqual(faults, []);
});

test('a cut takes the range that plays; then all of it plays, and the frame stays', async (t) => {
  const {tab, faults} = await withPage(t, [bvh]);
  const values = () =>
    ofAll(tab, '#panel-edit form input', (all) => all.map(({value}) => value).join());
  const goTo = async (frame) => {
    await tab.fill('#frame', String(frame));
    await press(tab, 'Enter');
  };
  await tab.click('#tab-edit');
  await tab.click('.operation:has(code:text-is("trim=A:B"))');
  assert.equal(await values(), ',');
  await goTo(20);
  await press(tab, 'i');
  await goTo(69);
  await press(tab, 'o');
  assert.equal(await values(), '20,70', 'the range that is set while the form is open');
  await goTo(30);
  await tab.click('#panel-edit form button.primary');
  await waitText(tab, '.steps', 'trim=20:70');
  assert.equal(await lastFrame(tab), 49);
  assert.equal(await frameOf(tab), 10, 'the same frame of the file');
  assert.equal(await count(tab, '.loop.whole'), 1);
  assert.equal(await values(), ',');
  await tab.click('#panel-edit button[data-act="undo"]');
  await waitFrame(tab, 30);
  // What is twice as fast ends sooner: what is shown is there.
  await press(tab, 'End');
  await tab.click('.operation:has(code:text-is("speed=X"))');
  await tab.fill('form [name="factor"]', '2');
  await tab.click('#panel-edit form button.primary');
  await waitText(tab, '.steps', 'speed=2');
  assert.equal(await frameOf(tab), await lastFrame(tab));
  assert.deepEqual(
    await ofAll(tab, '.presence', (all) => all.map((one) => one.textContent)),
    [''],
    'it is not over',
  );
  assert.deepEqual(faults, []);
});

test('linked by frame number, motions of two rates show the same frame', async (t) => {
  const slow = fileOf('slow.bvh', smallBvh(60, undefined, 0.1));
  const {tab, faults} = await withPage(t, [bvh, slow]);
  await tab.waitForSelector('#link');
  await waitText(tab, '.motion.active', 'slow.bvh');
  assert.equal(await tab.inputValue('#link'), 'time');
  await tab.fill('#frame', '12');
  await press(tab, 'Enter');
  assert.equal(await textOf(tab, '.readout'), '1.200 s');
  await press(tab, 'm');
  assert.equal(await frameOf(tab), 60);
  await tab.selectOption('#link', 'frames');
  await tab.fill('#frame', '12');
  await press(tab, 'Enter');
  await press(tab, 'm');
  assert.equal(await frameOf(tab), 12);
  assert.equal(await textOf(tab, '.readout'), '1.200 s', 'of the motion, not of the page');
  await press(tab, 'ArrowRight', 'm');
  assert.equal(await frameOf(tab), 13);
  assert.deepEqual(faults, []);
});

test('the strip of ground contacts says what it is', async (t) => {
  const rows = Array.from({length: 60}, (_, f) => `0 ${f < 30 ? 20 : 60} 0 0 0 0 0 0 0 0 0 0`);
  const feet = smallBvh(60, ['Hips', 'Leg', 'Foot']).replaceAll('OFFSET 0 ', 'OFFSET 0 -');
  const [head] = feet.split(/^0 90 /m);
  const path = fileOf('feet.bvh', `${head}${rows.join('\n')}\n`);
  const {tab, faults} = await withPage(t, [path]);
  await tab.waitForSelector('.contact', {state: 'attached'});
  await waitText(tab, '.track-legend', 'on the ground, darker where several are: Foot');
  await tab.screenshot({path: join(out, 'timeline-contacts.png')});
  assert.deepEqual(faults, []);
});

test('a message at a field of the warp stays in a narrow window', async (t) => {
  const {tab, faults} = await withPage(t, [bvh], {viewport: {width: 780, height: 620}});
  await withKey(tab);
  await tab.selectOption('[data-option="tail"]', 'extend');
  await tab.fill('.key-number >> nth=0', '500');
  await press(tab, 'Enter');
  const isInside = () =>
    tab.waitForFunction(() => {
      const fault = document.querySelector('.warp-fault.hangs:not([hidden])');
      const {left, right} = fault?.getBoundingClientRect() ?? {left: -1, right: 0};
      return left >= 0 && right <= document.documentElement.clientWidth;
    });
  await isInside();
  await tab.fill('.key-number >> nth=0', '50');
  await tab.fill('.key-number >> nth=1', '119');
  await press(tab, 'Enter');
  await tab.selectOption('[data-option="tail"]', 'keep');
  await waitText(tab, '.warp-options .warp-fault', 'expected keys before the new frame 119');
  await isInside();
  await tab.screenshot({path: join(out, 'timeline-refused-narrow.png')});
  assert.deepEqual(faults, []);
});

test('companions and marks: an AMC waits for its ASF; a limit is marked', async (t) => {
  const asf = fileOf('small.asf', smallAsf);
  const amc = fileOf('small.amc', smallAmc([0, 5, 10, 30, 10, 0]));
  const {tab, faults} = await withPage(t, []);
  await drop(tab, [amc]);
  await waitText(tab, '#files', 'expected the .asf file of this motion');
  assert.equal(await tab.isVisible('#empty'), true);
  await tab.screenshot({path: join(out, 'timeline-waiting.png')});
  await drop(tab, [asf]);
  await tab.waitForSelector('.motion');
  assert.equal(await tab.isVisible('#files'), false);
  assert.equal(await textOf(tab, '.readout.others'), 'in the file 1');
  await tab.waitForSelector('.mark.above');
  await tab.hover('.mark.above');
  await waitText(tab, '.mark-note', "joint 'arm' goes up to 30");
  await tab.click('.mark.above');
  assert.equal(await frameOf(tab), 3);
  await waitHash(tab, 'joint=arm');
  await press(tab, 'Home', '.');
  assert.equal(await frameOf(tab), 3);
  await press(tab, 'End', ',');
  assert.equal(await frameOf(tab), 3);
  await tab.mouse.move(500, 200);
  await press(tab, 'Home', '.');
  await waitText(tab, '.mark-note', "joint 'arm' goes up to 30");
  await press(tab, 'ArrowRight');
  assert.equal(await tab.isVisible('.mark-note'), false, 'it is about another frame');
  await tab.click('.unit');
  await waitText(tab, '.track', '0.02 s');
  assert.deepEqual(faults, []);
});

test('a file that is not valid shows its message, a file of another kind its name', async (t) => {
  const bad = fileOf('bad.bvh', 'HIERARCHY\nROOT a\n{\n  OFFSET 0 0\n');
  const notes = fileOf('notes.md', '# nothing that moves\n');
  const {tab, faults} = await withPage(t, []);
  await drop(tab, [bad, notes]);
  await waitText(tab, '.file.fault', 'bad.bvh:5: expected 3 numbers after OFFSET');
  await waitText(tab, '#files', 'BVH002');
  await waitText(tab, '#files', 'notes.md');
  await tab.click('.file.fault [aria-label="Dismiss"]');
  await tab.waitForSelector('.file.fault', {state: 'detached'});
  assert.deepEqual(faults, []);
});

test('a table without a header says at once what is missing', async (t) => {
  const rows = Array.from({length: 30}, (_, f) =>
    Array(36)
      .fill(f / 10)
      .join(','),
  ).join('\n');
  const {tab, faults} = await withPage(t, []);
  await drop(tab, [fileOf('g1.csv', `${rows}\n`)]);
  await waitText(
    tab,
    '.file.unknown',
    "g1.csv:1: expected a header of 'time' and names of columns",
  );
  await waitText(tab, '#status', 'g1.csv: not a motion file');
  await tab.screenshot({path: join(out, 'timeline-table.png')});
  assert.deepEqual(faults, []);
});

test('a file of another kind that comes alone says so', async (t) => {
  const notes = fileOf('notes.md', '# nothing that moves\n');
  const {tab, faults} = await withPage(t, []);
  await drop(tab, [notes]);
  await tab.waitForSelector('.file.unknown');
  const said = await textOf(tab, '.file.unknown');
  assert.match(said, /notes\.md.*not a motion file that kinefile reads/);
  await waitText(tab, '#status', 'notes.md: not a motion file');
  await tab.screenshot({path: join(out, 'timeline-unknown.png')});
  await drop(tab, [bvh]);
  await tab.waitForSelector('.motion');
  // Beside an open motion, and with others, it is said all the same.
  await drop(tab, [fileOf('more.md', '# nothing either\n')]);
  await waitText(tab, '#status', 'more.md: not a motion file');
  await waitText(tab, '#files summary', '2');
  assert.deepEqual(faults, []);
});

test('names with markup are text', async (t) => {
  const name = '<img src=x onerror=alert(1)>';
  const hostile = fileOf('<img src=x onerror=alert(1)>.bvh', smallBvh(20, ['Hips', name, 'Head']));
  const bad = fileOf('<b>bad.bvh', `HIERARCHY\nROOT ${name}\n{\n`);
  const {tab, faults} = await withPage(t, [hostile, bad]);
  let alerts = 0;
  tab.on('dialog', (dialog) => {
    alerts += 1;
    dialog.dismiss();
  });
  await waitText(tab, '.motion .name', name);
  await waitText(tab, '#files', '<b>bad.bvh');
  await tab.click('.warp-button');
  await tab.waitForSelector('.warp:not([hidden])');
  await waitText(tab, '.warp-title', name);
  assert.equal(await tab.evaluate(() => document.querySelectorAll('img, #files b b').length), 0);
  assert.equal(alerts, 0);
  assert.deepEqual(faults, []);
});

test('the address holds frame, view, motion, joint, panel, and is restored', async (t) => {
  const carried = carryingPage(
    'carrying.html',
    [
      {path: 'a.bvh', text: smallBvh()},
      {path: 'b.bvh', text: smallBvh(60)},
    ],
    [{path: 'a.bvh'}, {path: 'b.bvh'}],
  );
  const address = '#frame=31&camera=side&motion=2&joint=Head&panel=curves';
  const {tab, faults} = await withPage(t, [], {}, carried, address);
  await waitText(tab, '.motion.active', 'b.bvh');
  await waitFrame(tab, 31);
  await press(tab, 'ArrowRight');
  await waitHash(tab, 'frame=32');
  assert.equal(
    await tab.evaluate(() => location.hash),
    '#frame=32&camera=side&motion=2&joint=Head&panel=curves',
  );
  await press(tab, 'Space');
  await tab.waitForFunction(() => document.querySelector('#frame').value !== '32');
  assert.match(await tab.evaluate(() => location.hash), /frame=32/, 'not while it plays');
  await press(tab, 'Space');
  await tab.evaluate(() => {
    location.hash = '#frame=5&motion=1';
  });
  await waitText(tab, '.motion.active', 'a.bvh');
  await waitFrame(tab, 5);
  assert.deepEqual(faults, []);
});

test('both languages; the choice is kept', async (t) => {
  const {tab, faults} = await withPage(t, [bvh], {locale: 'de-DE'});
  await waitText(tab, '#top', 'Open files');
  await tab.selectOption('#language', 'ja');
  await waitText(tab, '#top', 'ファイルを開く');
  assert.equal(await tab.getAttribute('html', 'lang'), 'ja');
  assert.equal(await tab.getAttribute('.play', 'aria-label'), '再生');
  await tab.click('.warp-button');
  await tab.waitForSelector('.warp:not([hidden])');
  await waitText(tab, '.warp_add', 'キーを追加');
  await tab.screenshot({path: join(out, 'timeline-japanese.png')});
  await press(tab, '?');
  await waitText(tab, '#help', '10フレーム進む');
  await tab.screenshot({path: join(out, 'timeline-help-japanese.png')});
  await tab.reload();
  await waitText(tab, '#empty', 'モーションを見る');
  assert.deepEqual(faults, []);
});

test('every word is there in both languages', () => {
  for (const area of ['common', 'timeline', 'scene', 'panels']) {
    const words = (language) =>
      JSON.parse(readFileSync(new URL(`../src/words/${area}.${language}.json`, import.meta.url)));
    const [en, ja] = [words('en'), words('ja')];
    assert.deepEqual(Object.keys(ja).sort(), Object.keys(en).sort(), area);
    for (const [word, text] of Object.entries(ja)) {
      assert.equal((text.match(/\{\d\}/g) ?? []).length, (en[word].match(/\{\d\}/g) ?? []).length);
    }
  }
});

/** The contrast of a text with the first ground below it that is not transparent. */
const contrastOf = (tab, selector) =>
  ofFirst(tab, selector, (element) => {
    const parts = (text) => text.match(/[\d.]+/g).map(Number);
    const light = ([r, g, b]) => {
      const linear = [r, g, b].map((part) => {
        const value = part / 255;
        return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
      });
      return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
    };
    const style = getComputedStyle(element);
    const text = light(parts(element instanceof SVGElement ? style.fill : style.color));
    let below = element;
    let ground = [0, 0, 0, 0];
    while (below !== null && ground.length === 4 && ground[3] < 0.5) {
      ground = parts(getComputedStyle(below).backgroundColor);
      below = below.parentElement;
    }
    const behind = light(ground);
    return (Math.max(text, behind) + 0.05) / (Math.min(text, behind) + 0.05);
  });

for (const colorScheme of ['dark', 'light']) {
  test(`contrast and looks: ${colorScheme}`, async (t) => {
    const options = {colorScheme, viewport: {width: 1280, height: 720}};
    const {tab, faults} = await withPage(t, [], options);
    await tab.waitForSelector('#empty .formats li');
    await tab.screenshot({path: join(out, `timeline-empty-${colorScheme}.png`)});
    for (const selector of ['#empty h2', '#empty .faint', '#empty .primary']) {
      const contrast = await contrastOf(tab, selector);
      assert.ok(contrast >= 4.5, `${selector}: ${contrast}`);
    }
    await drop(tab, [bvh]);
    await tab.waitForSelector('.motion');
    await withKey(tab);
    await tab.screenshot({path: join(out, `timeline-${colorScheme}.png`)});
    for (const selector of ['.track .label', '.warp-title', '.readout', '.motion .name', '.unit']) {
      const contrast = await contrastOf(tab, selector);
      assert.ok(contrast >= 4.5, `${selector}: ${contrast}`);
    }
    assert.deepEqual(faults, []);
  });
}

test('a phone: nothing is wider than the screen, all works by touch', async (t) => {
  const {tab, faults} = await withPage(t, [], {...phone, locale: 'en-GB'});
  const fits = async (what) => {
    const [scroll, client] = await tab.evaluate(() => {
      const {scrollWidth, clientWidth} = document.documentElement;
      return [scrollWidth, clientWidth];
    });
    assert.ok(scroll <= client && client === 390, `${what}: ${scroll} in ${client}`);
    const outside = await ofAll(tab, 'body *', (all) =>
      all
        .filter((one) => one.closest('[hidden], svg, dialog, #views') === null)
        .filter((one) => one.getBoundingClientRect().right > 390.5)
        .map((one) => one.id || one.className),
    );
    assert.deepEqual(outside, [], what);
  };
  await tab.waitForSelector('#empty .formats li');
  await fits('empty');
  await tab.screenshot({path: join(out, 'timeline-phone-empty.png')});
  const name = `a_long_name${'_of_a_take'.repeat(6)}.bvh`;
  await drop(tab, [fileOf(name, smallBvh())], 100, 300);
  await tab.waitForSelector('.motions-chip');
  assert.equal(await tab.isVisible('#side'), false);
  await fits('one motion');
  await tab.screenshot({path: join(out, 'timeline-phone.png')});
  const box = await tab.locator('.track').boundingBox();
  await tab.touchscreen.tap(box.x + box.width / 2, box.y + 20);
  assert.ok((await frameOf(tab)) > 40);
  const placeOf = (selector) => tab.locator(selector).boundingBox();
  await tab.waitForFunction(() => document.querySelector('.grid-scale').textContent !== '');
  const [chip, scale] = [await placeOf('.motions-chip'), await placeOf('.grid-scale')];
  assert.ok(chip.x + chip.width <= scale.x, 'the name ends before the size of the grid');
  assert.match(await textOf(tab, '.motions-chip'), /^a_long_name/);
  assert.equal(await tab.isVisible('.motion'), false, 'the list is folded');
  await tab.tap('.motions-chip');
  assert.equal(await tab.isVisible('.motion'), true);
  await fits('the list');
  await tab.tap('.motions-chip');

  await tab.tap('#side-toggle');
  assert.equal(await tab.isVisible('#side'), true);
  await fits('with the panel');
  const low = (await placeOf('#side')).height;
  await tab.tap('#side-taller');
  const tall = (await placeOf('#side')).height;
  assert.ok(low < 0.4 * 844 && tall > 0.65 * 844, `${low}, taller ${tall}`);
  await fits('with the tall panel');
  await tab.screenshot({path: join(out, 'timeline-phone-tall.png')});
  await drag(tab, '#side-toggle', 0, 200);
  const dragged = (await placeOf('#side')).height;
  assert.ok(Math.abs(dragged - (tall - 200)) < 3, `dragged from ${tall} to ${dragged}`);
  await tab.tap('.warp-button');
  await tab.waitForSelector('.warp:not([hidden])');
  assert.equal(await tab.isVisible('#side'), false, 'there is no room for both');
  const [hint, map] = [await placeOf('.warp-help'), await placeOf('.warp-map')];
  assert.ok(hint.y >= map.y + map.height, 'the hint hides nothing of the curve');
  await fits('the hint');
  await tab.screenshot({path: join(out, 'timeline-phone-hint.png')});
  await tab.tap('.warp-close');
  await tab.waitForSelector('.warp', {state: 'hidden'});
  await tab.tap('.warp-button');
  await tab.waitForSelector('.warp:not([hidden])');
  await tab.tap('.warp_add');
  await tab.waitForSelector('.key');
  assert.equal(await tab.isVisible('.warp-help'), false);
  await fits('time warp');
  await waitText(tab, '.motions-chip .tag', '2');
  await tab.tap('.motions-chip');
  assert.equal(await tab.isVisible('#placement'), true);
  await fits('the list of two');
  await tab.screenshot({path: join(out, 'timeline-phone-list.png')});
  await tab.tap('.motions-chip');
  await tab.screenshot({path: join(out, 'timeline-phone-warp.png')});
  const {x, y} = await middleOf(tab, '.key .diamond');
  const session = await tab.context().newCDPSession(tab);
  const touch = (type, ...touchPoints) =>
    session.send('Input.dispatchTouchEvent', {type, touchPoints});
  await touch('touchStart', {x, y});
  await touch('touchMove', {x: x + 30, y});
  await touch('touchMove', {x: x + 60, y});
  await touch('touchEnd');
  await tab.waitForFunction(() => {
    const [from, to] = document.querySelector('.key title').textContent.split(' → ').map(Number);
    return to > from + 5;
  });
  await fits('after a drag');
  await tab.screenshot({path: join(out, 'timeline-phone-warped.png')});
  await tab.tap('.help-button');
  await tab.waitForSelector('#help[open]');
  const wide = await ofFirst(tab, '#help', (help) => help.scrollWidth - help.clientWidth);
  assert.ok(wide <= 0, `the help is ${wide} pixels too wide`);
  const sections = await ofAll(tab, '#help section', (all) => all.map((one) => one.className));
  assert.deepEqual(sections, ['gestures', 'keys', 'about']);
  assert.doesNotMatch(await textOf(tab, '#help .columns'), /Ctrl|Alt\b|[Ww]heel|[Rr]ight button/);
  const scrolls = await ofFirst(
    tab,
    '#help .columns',
    (one) => one.scrollHeight - one.clientHeight,
  );
  assert.ok(scrolls > 0, 'the columns scroll below the heading');
  await tab.screenshot({path: join(out, 'timeline-phone-help.png')});
  assert.deepEqual(faults, []);
});

test('a real capture: marks, contacts, long ruler', async (t) => {
  const folder = join(data, 'acclaim/cmu');
  if (!existsSync(folder)) return t.skip('no real files here');
  const files = [join(folder, '01_01.amc'), join(folder, '01.asf')];
  const {tab, faults} = await withPage(t, files, {colorScheme: 'dark'});
  await tab.waitForSelector('.mark');
  await tab.waitForSelector('.contact', {state: 'attached'});
  await tab.screenshot({path: join(out, 'timeline-capture.png')});
  assert.deepEqual(faults, []);
});
