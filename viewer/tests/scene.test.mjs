// SPDX-License-Identifier: MIT
// The scene in a browser: what is drawn is found by its colours in pictures of the page's own.
import assert from 'node:assert/strict';
import {existsSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, describe, test} from 'node:test';
import {pathToFileURL} from 'node:url';
import {data, drop, launch, openPage, out, page, phone, root} from './browser.mjs';

const small = {viewport: {width: 1100, height: 440}, reducedMotion: 'reduce'};
const robot = [join(root, 'examples/robot.body'), join(root, 'examples/bow.seq')];

/** A figure of a pelvis, two legs and a head, `size` units high, which walks along z. */
function walker({size = 170, numFrames = 90, head = 'Head', x = 0, step = 0.01} = {}) {
  const unit = (share) => (share * size).toFixed(4);
  const leg = (side, at) => `JOINT ${side}UpLeg {
OFFSET ${unit(at)} 0 0
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT ${side}Foot {
OFFSET 0 ${unit(-0.5)} 0
CHANNELS 3 Zrotation Xrotation Yrotation
End Site {
OFFSET 0 0 ${unit(0.12)}
} } }`;
  const rows = Array.from({length: numFrames}, (_, frame) => {
    const swing = 20 * Math.sin(frame / 6);
    const place = [unit(x), unit(0.5), unit(frame * step)];
    return [...place, 0, 0, 0, 0, swing, 0, 0, 0, 0, 0, -swing, 0, 0, 0, 0, 0, 0, 0].join(' ');
  });
  const text = `HIERARCHY
ROOT Hips {
OFFSET 0 0 0
CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
${leg('Left', 0.08)}
${leg('Right', -0.08)}
JOINT ${head} {
OFFSET 0 ${unit(0.4)} 0
CHANNELS 3 Zrotation Xrotation Yrotation
End Site {
OFFSET 0 ${unit(0.1)} 0
} } }
MOTION
Frames: ${numFrames}
Frame Time: 0.033333333
${rows.join('\n')}
`;
  return Buffer.from(
    text.replaceAll(' {', '\n{').replaceAll('} }', '}\n}').replaceAll('} }', '}\n}'),
  );
}

const file = (name, buffer) => ({name, mimeType: 'text/plain', buffer});

/** Opens the page with files: buffers as a person chooses them, paths as a person drops them. */
async function opened(browser, files, options = {}, prepare = null) {
  const page = await openPage(browser, {...small, ...options});
  if (prepare !== null) {
    await page.tab.addInitScript(prepare);
    await page.tab.reload();
  }
  await page.tab.waitForFunction(() => document.querySelector('#status').textContent === '');
  if (typeof files[0] === 'string') await drop(page.tab, files, 100, 150);
  else if (files.length > 0) await page.tab.setInputFiles('#choose-files', files);
  if (files.length > 0) await page.tab.waitForSelector('#views:not([hidden]) button');
  return page;
}

const picture = (tab, wish) =>
  tab.evaluate((given) => globalThis.kinefile.picture(given), {frames: null, ...wish});

/** Where pixels of a kind of colour are in a PNG, relative to its size. */
const found = (tab, base64, colour) =>
  tab.evaluate(
    async ([text, kind]) => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], {type: 'image/png'}));
      const canvas = new OffscreenCanvas(image.width, image.height);
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      const {data: pixels} = context.getImageData(0, 0, image.width, image.height);
      const kinds = {
        yellow: (r, g, b) => r > 1.2 * g && g > 1.5 * b && r > 60,
        blue: (r, g, b) => b > 1.3 * g && g > 1.2 * r && b > 90,
        cool: (r, _, b) => b > 1.3 * r && b > 90,
        pink: (r, g, b) => r > 2 * g && b > 1.15 * g && r > 90,
        dark: (r, g, b) => r + g + b < 330,
      };
      const box = {count: 0, left: 1, right: 0, top: 1, bottom: 0, at: null};
      // The labels at the bottom have the colours of the motions, too.
      const last = Math.floor(image.height * 0.86);
      for (let y = 0; y < last; y++) {
        for (let x = 0; x < image.width; x++) {
          const k = 4 * (y * image.width + x);
          if (!kinds[kind](pixels[k], pixels[k + 1], pixels[k + 2])) continue;
          box.at ??= [x, y];
          box.count++;
          box.left = Math.min(box.left, x / image.width);
          box.right = Math.max(box.right, x / image.width);
          box.top = Math.min(box.top, y / image.height);
          box.bottom = Math.max(box.bottom, y / image.height);
        }
      }
      return {
        ...box,
        share: box.count / image.width / image.height,
        width: image.width,
        height: image.height,
      };
    },
    [base64, colour],
  );

const press = (tab, word) =>
  tab.locator('#views button', {hasText: new RegExp(`^${word}$`)}).click();
const labels = (tab, row) => tab.locator(`#views .row:nth-child(${row}) button`).allTextContents();
const save = (name, base64) => writeFileSync(join(out, name), Buffer.from(base64, 'base64'));
const shot = (tab, name) => tab.screenshot({path: join(out, name)});

/** The place in the page of something in a picture of the stage's own size. */
async function placeOf(tab, colour) {
  const box = await tab.locator('#canvas').boundingBox();
  const size = {width: Math.round(box.width), height: Math.round(box.height)};
  const {at} = await found(tab, await picture(tab, {...size, isExact: true}), colour);
  assert.ok(at, `nothing ${colour} in the picture`);
  return [box.x + at[0], box.y + at[1]];
}

describe('the scene', {concurrency: false}, () => {
  let browser;
  before(async () => {
    browser = await launch();
  });
  after(() => browser.close());

  test('figures of any size fill the picture, in their colours', async () => {
    const shares = [];
    for (const size of [10, 170, 10_000]) {
      const {tab, faults, context} = await opened(browser, [file('walk.bvh', walker({size}))]);
      const base64 = await picture(tab, {width: 480, height: 300});
      const yellow = await found(tab, base64, 'yellow');
      assert.deepEqual([yellow.width, yellow.height], [480, 300]);
      const height = yellow.bottom - yellow.top;
      assert.ok(height > 0.4 && yellow.top > 0.01, `size ${size}: ${JSON.stringify(yellow)}`);
      assert.ok(yellow.left > 0.1 && yellow.right < 0.9, JSON.stringify(yellow));
      shares.push(yellow.share);
      save(`scene-size-${size}.png`, base64);
      assert.deepEqual(faults, []);
      await context.close();
    }
    assert.ok(Math.max(...shares) < 1.15 * Math.min(...shares), `not alike: ${shares}`);
  });

  test('views show it from front, side and top, and keep their buttons pressed', async () => {
    const {tab, faults, context} = await opened(browser, [file('walk.bvh', walker())]);
    const boxes = {};
    for (const view of ['Front', 'Side', 'Top', 'Orbit', 'Follow']) {
      await press(tab, view);
      assert.deepEqual(
        await tab.locator('#views .row:first-child button[aria-pressed="true"]').allTextContents(),
        [view],
      );
      const base64 = await picture(tab, {width: 300, height: 300});
      boxes[view] = await found(tab, base64, 'yellow');
      save(`scene-view-${view.toLowerCase()}.png`, base64);
    }
    const tall = ({top, bottom}) => bottom - top;
    const wide = ({left, right}) => right - left;
    assert.ok(tall(boxes.Front) > 2 * wide(boxes.Front), JSON.stringify(boxes.Front));
    assert.ok(tall(boxes.Front) > 2 * tall(boxes.Top), JSON.stringify(boxes.Top));
    // From the side the left leg is hidden or beside the right one: it walks to the right.
    assert.ok(wide(boxes.Side) > 0.05 && tall(boxes.Side) > 0.3, JSON.stringify(boxes.Side));
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('a person says where a figure faces: the view from the front looks from there', async () => {
    const {tab, faults, context} = await opened(browser, [file('walk.bvh', walker())]);
    const boxOf = async (view) => {
      await press(tab, view);
      return found(tab, await picture(tab, {width: 300, height: 300}), 'yellow');
    };
    const choose = async (front) => {
      await tab.click('#tab-info');
      await tab.selectOption('[name="front"]', front);
    };
    const isLike = (one, other) =>
      ['left', 'right', 'top', 'bottom'].every((edge) => Math.abs(one[edge] - other[edge]) < 0.03);
    await tab.click('#tab-info');
    const words = await tab.locator('[name="front"] option').allTextContents();
    assert.deepEqual(words, ['+z (as found)', '+x', '−x', '+z', '−z']);
    const [front, side] = [await boxOf('Front'), await boxOf('Side')];
    assert.ok(!isLike(front, side), JSON.stringify([front, side]));
    await press(tab, 'Front');
    await choose('-x');
    const turned = await boxOf('Front');
    assert.ok(isLike(turned, side), JSON.stringify([turned, side]));
    await choose('');
    assert.ok(isLike(await boxOf('Front'), front));
    await choose('+x');
    // The file is read with another axis up, along which nothing can face.
    await tab.selectOption('[name="up-in"]', 'z');
    await tab.waitForFunction(
      () => document.querySelectorAll('[name="front"] option')[3]?.value === '+y',
    );
    assert.equal(await tab.inputValue('[name="front"]'), '+x');
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('the figure stays wholly in view when the editor takes room and the window shrinks', async () => {
    const {tab, faults, context} = await opened(browser, [file('walk.bvh', walker())], {
      viewport: {width: 900, height: 620},
    });
    const fits = async (colour, what) => {
      const box = await tab.locator('#canvas').boundingBox();
      const size = {width: Math.round(box.width), height: Math.round(box.height)};
      const shown = await found(tab, await picture(tab, {...size, isExact: true}), colour);
      const {left, right, top, bottom} = shown;
      const share = Math.max(right - left, bottom - top);
      assert.ok(left > 0.01 && right < 0.99 && top > 0.01, `${what}: ${JSON.stringify(shown)}`);
      assert.ok(bottom < 0.85 && share > 0.2, `${what}: ${JSON.stringify(shown)}`);
      const covered = await tab.evaluate(
        (place) => {
          const stage = document.querySelector('#stage').getBoundingClientRect();
          return ['#lists', '#views'].filter((selector) => {
            const own = document.querySelector(selector).getBoundingClientRect();
            const isAside =
              (own.right - stage.left) / stage.width < place.left ||
              (own.left - stage.left) / stage.width > place.right;
            const isApart =
              (own.bottom - stage.top) / stage.height < place.top ||
              (own.top - stage.top) / stage.height > place.bottom;
            return !isAside && !isApart;
          });
        },
        {left, right, top, bottom},
      );
      assert.deepEqual(covered, [], `${what}: ${JSON.stringify(shown)}`);
    };
    const settled = (height) =>
      tab.waitForFunction(
        (least) =>
          new Promise((done) => {
            const isThere = document.querySelector('#stage').clientHeight < least;
            requestAnimationFrame(() => requestAnimationFrame(() => done(isThere)));
          }),
        height,
      );
    await fits('yellow', 'alone');
    const {height} = await tab.locator('#stage').boundingBox();
    await tab.click('.warp-button');
    await tab.waitForFunction(() => document.querySelectorAll('.motion').length === 2);
    await settled(height - 100);
    await fits('blue', 'beside the editor');
    await tab.setViewportSize({width: 620, height: 700});
    await settled(height);
    await fits('blue', 'in a small window');
    await shot(tab, 'scene-fitted.png');
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('a figure stands beside a long list, not below it', async () => {
    const takes = Array.from({length: 12}, (_, k) =>
      file(`a_take_of_the_second_actor_${k}.bvh`, walker()),
    );
    const {tab, faults, context} = await opened(browser, takes, {
      viewport: {width: 860, height: 620},
    });
    await tab.waitForSelector('.waiting li');
    const box = await tab.locator('#canvas').boundingBox();
    const list = await tab.locator('#lists').boundingBox();
    const size = {width: Math.round(box.width), height: Math.round(box.height)};
    const shown = await found(tab, await picture(tab, {...size, isExact: true}), 'yellow');
    assert.ok(shown.bottom - shown.top > 0.25, JSON.stringify(shown));
    assert.ok(shown.left * box.width > list.x + list.width - box.x, JSON.stringify(shown));
    await shot(tab, 'scene-beside-list.png');
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('two motions have two colours; the grid says its size and what is a guess', async () => {
    const {tab, faults, context} = await opened(browser, [
      file('a.bvh', walker()),
      file('b.bvh', walker({x: 0.8})),
    ]);
    const base64 = await picture(tab, {width: 480, height: 300});
    assert.ok((await found(tab, base64, 'yellow')).share > 0.002);
    assert.ok((await found(tab, base64, 'blue')).share > 0.002);
    save('scene-two.png', base64);
    assert.equal(await tab.textContent('.grid-scale'), 'Grid ≈ 1 m', 'by a clear height');
    await tab.setInputFiles('#choose-files', [file('c.bvh', walker({size: 18}))]);
    await tab.waitForFunction(() => document.querySelectorAll('.motion').length === 3);
    await tab.click('.motion:nth-child(3) .title');
    await tab.waitForFunction(() =>
      /^Grid 1 m \(guess\)$/.test(document.querySelector('.grid-scale').textContent),
    );
    await shot(tab, 'scene-two-page.png');
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('only what the data holds is offered', async () => {
    const still = await opened(browser, [file('one.bvh', walker({numFrames: 1}))]);
    assert.deepEqual(await labels(still.tab, 2), ['Axes', 'Names']);
    await still.context.close();
    const {tab, context} = await opened(browser, robot);
    await tab.locator('#views button', {hasText: /^Contacts$/}).waitFor();
    await context.close();
  });

  test('ghosts, paths and axes are drawn when they are switched on', async () => {
    const {tab, faults, context} = await opened(browser, [file('walk.bvh', walker())], {
      colorScheme: 'dark',
    });
    const yellow = async () =>
      (await found(tab, await picture(tab, {width: 480, height: 300}), 'yellow')).share;
    const plain = await yellow();
    await press(tab, 'Paths');
    let withPath = 0;
    // The path is asked of the core first.
    for (let k = 0; k < 50 && withPath <= plain * 1.02; k++) withPath = await yellow();
    assert.ok(withPath > plain * 1.02, `path: ${plain} ${withPath}`);
    await press(tab, 'Ghosts');
    const withGhosts = await yellow();
    assert.ok(withGhosts > withPath * 1.1, `ghosts: ${withPath} ${withGhosts}`);
    await press(tab, 'Axes');
    save('scene-everything.png', await picture(tab, {width: 900, height: 600}));
    await press(tab, 'Ghosts');
    await press(tab, 'Paths');
    await press(tab, 'Axes');
    assert.ok(Math.abs((await yellow()) - plain) < 1e-4, 'switched off again');
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('contacts are discs on the ground while they last', async () => {
    const {tab, context} = await opened(browser, robot);
    await tab.locator('#views button', {hasText: /^Contacts$/}).click();
    const base64 = await picture(tab, {width: 480, height: 300});
    await tab.locator('#views button', {hasText: /^Contacts$/}).click();
    const without = await found(tab, await picture(tab, {width: 480, height: 300}), 'yellow');
    assert.ok((await found(tab, base64, 'yellow')).count > without.count + 20);
    save('scene-contacts.png', base64);
    await context.close();
  });

  test('a ZMP is a mark on the floor, where the data holds one', async () => {
    const times = [0, 0.6, 1, 1.5, 2];
    const rows = times.map((at) => `      - [ ${at}, 0.25, 0, 0 ]`).join('\n');
    const seq = `${readFileSync(robot[1], 'utf8')}  -
    type: Vector3Seq
    content: ZMP
    frames:
${rows}
`;
    const {tab, faults, context} = await opened(browser, [
      file('robot.body', readFileSync(robot[0])),
      file('zmp.seq', Buffer.from(seq)),
    ]);
    const toggle = tab.locator('#views button', {hasText: /^ZMP$/});
    await toggle.waitFor();
    await press(tab, 'Top');
    const yellow = async () =>
      (await found(tab, await picture(tab, {width: 480, height: 300}), 'yellow')).count;
    const marked = await yellow();
    save('scene-zmp.png', await picture(tab, {width: 480, height: 300}));
    await shot(tab, 'scene-zmp-page.png');
    await toggle.click();
    const plain = await yellow();
    assert.ok(marked > plain + 10, `${marked} ${plain}`);
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('a joint says its name, which is text, and a click selects it', async () => {
    const head = '<img/src=x/onerror=alert(1)>';
    const {tab, faults, context} = await opened(browser, [file('walk.bvh', walker({head}))]);
    await press(tab, 'Front');
    const [x, y] = await placeOf(tab, 'yellow');
    await tab.mouse.move(x, y + 3);
    await tab.waitForFunction(() => document.querySelector('#hover').textContent !== '');
    assert.equal(await tab.textContent('#hover'), head);
    assert.equal(await tab.locator('#hover *').count(), 0);
    assert.equal(
      (await found(tab, await picture(tab, {width: 300, height: 300}), 'pink')).count,
      0,
    );
    await tab.mouse.click(x, y + 3);
    const base64 = await picture(tab, {width: 300, height: 300});
    assert.ok((await found(tab, base64, 'pink')).count > 10);
    save('scene-selected.png', base64);
    await press(tab, 'Names');
    await tab.mouse.move(x + 1, y + 3);
    await tab.mouse.move(x, y + 3);
    assert.equal(await tab.textContent('#hover'), '');
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('a robot shows its shapes in their colours, or its bones', async () => {
    // The worker's answers get one box a joint: two of three blue, the others without a colour.
    const prepare = () => {
      const Real = Worker;
      window.Worker = class extends Real {
        set onmessage(listener) {
          super.onmessage = (event) => {
            const {documents = []} = event.data.answer ?? {};
            for (const {document} of documents) {
              document.joints.forEach((joint, k) => {
                joint.visuals = [
                  {
                    kind: ['box', 'cylinder', 'sphere', 'capsule', 'cone'][k % 5],
                    size: [0.08, 0.08, 0.16],
                    position: [0, 0, -0.08],
                    rotation: [1, 0, 0, 0],
                    colour: k % 3 === 0 ? null : [0.1, 0.3, 0.9],
                  },
                ];
              });
            }
            listener(event);
          };
        }
      };
    };
    const {tab, faults, context} = await opened(browser, robot, {}, prepare);
    const shapes = await picture(tab, {width: 480, height: 300});
    save('scene-shapes.png', shapes);
    assert.ok((await found(tab, shapes, 'cool')).share > 0.005);
    await press(tab, 'Shapes');
    const bones = await picture(tab, {width: 480, height: 300});
    save('scene-robot-bones.png', bones);
    assert.equal((await found(tab, bones, 'cool')).count, 0);
    assert.ok((await found(tab, bones, 'yellow')).share > 0.004);
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('a contact sheet has a picture for each frame, all by one camera', async () => {
    const {tab, faults, context} = await opened(browser, [file('walk.bvh', walker())]);
    const sheet = await picture(tab, {width: 600, height: 400, frames: '0:60:20'});
    save('scene-sheet.png', sheet);
    const yellow = await found(tab, sheet, 'yellow');
    assert.deepEqual([yellow.width, yellow.height], [600, 400]);
    assert.ok(yellow.right - yellow.left > 0.5, JSON.stringify(yellow));
    assert.notEqual(sheet, await picture(tab, {width: 600, height: 400, frames: '0:60:30'}));
    await assert.rejects(picture(tab, {width: 600, height: 400, frames: '80:200'}), /80:200/);
    assert.deepEqual(faults, []);
    await context.close();
  });

  test('a figure that walks out of the picture is framed again, unless a person framed it', async () => {
    const {tab, context} = await opened(browser, [file('far.bvh', walker({step: 0.2}))]);
    const wish = {width: 300, height: 300, isExact: true};
    const share = async () => (await found(tab, await picture(tab, wish), 'yellow')).share;
    assert.ok((await share()) > 0.002, 'at first');
    await tab.keyboard.press('End');
    await tab.waitForFunction(() => document.querySelector('#frame').value === '89');
    let there = 0;
    for (let k = 0; k < 50 && there < 0.002; k++) there = await share();
    assert.ok(there >= 0.002, `at the end: ${there}`);
    await tab.focus('#canvas');
    await tab.keyboard.press('Control+ArrowRight');
    await tab.keyboard.press('Home');
    await tab.waitForFunction(() => document.querySelector('#frame').value === '0');
    for (let k = 0; k < 50 && there > 0; k++) there = await share();
    assert.equal(there, 0, 'a view that a person has chosen stays');
    await context.close();
  });

  test('the keyboard turns and zooms without stepping through frames', async () => {
    const {tab, context} = await opened(browser, [file('walk.bvh', walker())]);
    const wish = {width: 300, height: 300};
    const before = await found(tab, await picture(tab, wish), 'yellow');
    await tab.focus('#canvas');
    for (let k = 0; k < 4; k++) await tab.keyboard.press('+');
    const near = await found(tab, await picture(tab, wish), 'yellow');
    assert.ok(near.share > 1.5 * before.share, `${before.share} ${near.share}`);
    const still = await picture(tab, wish);
    await tab.keyboard.press('Control+ArrowRight');
    assert.notEqual(await picture(tab, wish), still);
    await press(tab, 'Fit');
    await tab.waitForFunction(() => new Promise((done) => requestAnimationFrame(() => done(true))));
    const fitted = await found(tab, await picture(tab, wish), 'yellow');
    assert.ok(fitted.share < 1.3 * before.share, `${before.share} ${fitted.share}`);
    await context.close();
  });

  test('nothing is drawn when nothing changes', async () => {
    const prepare = () => {
      globalThis.drawn = 0;
      const {prototype} = WebGL2RenderingContext;
      const own = prototype.drawElementsInstanced;
      prototype.drawElementsInstanced = function (...words) {
        globalThis.drawn++;
        return own.apply(this, words);
      };
    };
    const {tab, context} = await opened(browser, [file('walk.bvh', walker())], {}, prepare);
    await picture(tab, {width: 64, height: 64});
    const settled = () =>
      tab.evaluate(async () => {
        const frame = () => new Promise((done) => requestAnimationFrame(done));
        for (let k = 0; k < 3; k++) await frame();
        const first = globalThis.drawn;
        for (let k = 0; k < 5; k++) await frame();
        return [first, globalThis.drawn];
      });
    const [first, last] = await settled();
    assert.ok(first > 0);
    assert.equal(last, first);
    await press(tab, 'Top');
    assert.ok((await settled())[0] > last);
    await context.close();
  });

  test('WebGL starts after the first paint; where none is told of, after a while', async () => {
    const noteStart = () => {
      const own = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...words) {
        if (kind.startsWith('webgl')) globalThis.webglStart ??= performance.now();
        return own.call(this, kind, ...words);
      };
    };
    const muteObserver = () => {
      PerformanceObserver.prototype.observe = () => {};
    };
    const starts = async (...prepare) => {
      const context = await browser.newContext(small);
      const tab = await context.newPage();
      for (const script of prepare) await tab.addInitScript(script);
      await tab.goto(pathToFileURL(page).href);
      await tab.waitForFunction(() => globalThis.webglStart > 0);
      const times = await tab.evaluate(() => [
        globalThis.webglStart,
        performance.getEntriesByName('first-contentful-paint')[0]?.startTime,
      ]);
      await context.close();
      return times;
    };
    const [start, paint] = await starts(noteStart);
    assert.ok(start >= Math.min(paint ?? Infinity, 2000), `WebGL at ${start}, paint at ${paint}`);
    const [unheard] = await starts(noteStart, muteObserver);
    assert.ok(unheard >= 2000, `WebGL at ${unheard}, before it was told of a paint`);
  });

  test('without WebGL there is a message, and the rest of the page works', async () => {
    const prepare = () => {
      const own = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...words) {
        return kind.startsWith('webgl') ? null : own.call(this, kind, ...words);
      };
    };
    const {tab, context} = await openPage(browser, small);
    await tab.addInitScript(prepare);
    await tab.reload();
    await tab.waitForSelector('.no-scene');
    assert.match(await tab.textContent('.no-scene'), /WebGL/);
    await tab.setInputFiles('#choose-files', [file('walk.bvh', walker())]);
    await tab.waitForSelector('#motions .motion');
    await assert.rejects(picture(tab, {width: 100, height: 100}), /WebGL/);
    await context.close();
  });

  test('dark, on a phone, in Japanese: the toggles are behind a button', async () => {
    const {tab, context} = await opened(browser, [file('walk.bvh', walker())], {
      ...phone,
      reducedMotion: 'reduce',
    });
    assert.deepEqual((await labels(tab, 1)).slice(0, 5), [
      '自由視点',
      '追従',
      '正面',
      '側面',
      '上面',
    ]);
    const toggle = tab.locator('#shown button', {hasText: /^残像$/});
    assert.equal(await toggle.isVisible(), false);
    await tab.locator('#views .more').dispatchEvent('click');
    assert.equal(await tab.getAttribute('#views .more', 'aria-expanded'), 'true');
    const base64 = await picture(tab, {width: 390, height: 500});
    assert.ok((await found(tab, base64, 'dark')).share > 0.7, 'a dark ground');
    save('scene-phone-picture.png', base64);
    await shot(tab, 'scene-phone.png');
    await context.close();
  });

  const walk = join(data, 'bvh/real/VictorS-67+pybvh/cmu_12_01_walk.bvh');
  test('a real walk', {skip: !existsSync(walk) && 'no real files here'}, async () => {
    const {tab, faults, context} = await opened(browser, [walk], {colorScheme: 'dark'});
    await tab.locator('#views button', {hasText: /^Contacts$/}).click();
    await press(tab, 'Paths');
    await press(tab, 'Ghosts');
    save('scene-real-sheet.png', await picture(tab, {width: 900, height: 500, frames: '::60'}));
    await shot(tab, 'scene-real.png');
    assert.deepEqual(faults, []);
    await context.close();
  });
});
