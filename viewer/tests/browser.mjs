// SPDX-License-Identifier: MIT
// What the tests of the page share: Debian's Chromium, the page, files.
import {execFileSync} from 'node:child_process';
import {mkdirSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';
import {build} from 'esbuild';
import {chromium} from 'playwright-core';

export const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
export const page = join(root, 'build/web/page.html');
export const kinefile = process.env.KINEFILE ?? join(root, 'build/release/kinefile');
/** Real files, which tests use where they are there. */
export const data = process.env.KINEFILE_TEST_DATA ?? join(root, '../shared/data');
/** Where screenshots and files of a test go. */
export const out = join(root, 'build/viewer-tests');
mkdirSync(out, {recursive: true});

export const phone = {
  viewport: {width: 390, height: 844},
  deviceScaleFactor: 2,
  isMobile: true,
  hasTouch: true,
  colorScheme: 'dark',
  locale: 'ja-JP',
};

/** Software rendering, and no connection to anywhere. */
export const launch = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--no-sandbox',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
    ],
  });

/** Opens a page of a browser; every error of its console fails the test that reads `faults`. */
export async function openPage(browser, options = {}, file = page, hash = '') {
  const context = await browser.newContext({viewport: {width: 1280, height: 760}, ...options});
  const tab = await context.newPage();
  const faults = [];
  tab.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  tab.on('pageerror', (fault) => faults.push(String(fault)));
  await tab.goto(pathToFileURL(file).href + hash);
  return {tab, context, faults};
}

/**
 * Drops files and folders of the disk onto the page, as a person does. A busy browser may not know
 * yet that the page takes what is over it, and then drops nothing: it is tried again.
 */
export async function drop(tab, files, x = 400, y = 300) {
  const session = await tab.context().newCDPSession(tab);
  const data = {items: [], files, dragOperationsMask: 1};
  await tab.evaluate(() => {
    globalThis.isDropped = false;
    const note = () => {
      globalThis.isDropped = true;
    };
    addEventListener('drop', note, {once: true, capture: true});
  });
  for (let attempt = 0; attempt < 10; attempt++) {
    for (const type of ['dragEnter', 'dragOver', 'drop']) {
      await session.send('Input.dispatchDragEvent', {type, x, y, data});
    }
    const seen = tab.waitForFunction(() => globalThis.isDropped, null, {timeout: 2000});
    if (await seen.catch(() => null)) return;
  }
  throw new Error(`the page saw no drop of ${files}`);
}

/**
 * What a function says of the first element of a selector. One step in the page: between the two of
 * `$eval` the page may replace the element, which then has no style.
 */
export const ofFirst = (tab, selector, read) =>
  tab.evaluate(`(${read})(document.querySelector(${JSON.stringify(selector)}))`);

/** The same of all elements of a selector. */
export const ofAll = (tab, selector, read) =>
  tab.evaluate(`(${read})([...document.querySelectorAll(${JSON.stringify(selector)})])`);

/** Runs the command. */
export const run = (...words) => execFileSync(kinefile, words, {encoding: 'utf8'});

/** The functions of a module of the page that needs no page. */
export async function imported(module) {
  const entry = join(root, 'viewer/src', module);
  const made = await build({entryPoints: [entry], bundle: true, write: false, format: 'esm'});
  return import(`data:text/javascript,${encodeURIComponent(made.outputFiles[0].text)}`);
}
