// SPDX-License-Identifier: MIT
// Starts the page: first what can be seen, then the core and the scene.
import {type Actions, makeActions} from './actions.ts';
import {keepAddress} from './address.ts';
import {type Core, startCore} from './core/core.ts';
import type {Tables} from './core/types.ts';
import {byId, el} from './elements.ts';
import {carriedFiles} from './files.ts';
import {makeShortcuts, type Shortcut, useShortcuts} from './keyboard.ts';
import {makeTimeAxis} from './panels/axis.ts';
import {makeEmpty} from './panels/empty.ts';
import {makeFileList} from './panels/files.ts';
import {makeHelp} from './panels/help.ts';
import {makeLacks} from './panels/lacks.ts';
import {makeMarks} from './panels/marks.ts';
import {makeMotionList} from './panels/motions.ts';
import {makeSheet} from './panels/sheet.ts';
import {makeSide, tablesOf} from './panels/side.ts';
import {chosenLanguage, makeStatus, makeTools, takeFiles} from './panels/topbar.ts';
import {makeTrack} from './panels/track.ts';
import {makeTransport} from './panels/transport.ts';
import {makeViews} from './panels/views.ts';
import {kPhone, makeWarpEditor} from './panels/warp.ts';
import {offerPictures, type Studio, savePicture} from './picture.ts';
import {runPlayback} from './playback.ts';
import {makePoseCache, type PoseCache} from './poses.ts';
import {makeScene, type Scene} from './scene/scene.ts';
import {makeStore} from './state.ts';
import {fillWords, preferredLanguage, setLanguage} from './words.ts';

const store = makeStore({
  motions: [],
  active: 0,
  joint: -1,
  files: [],
  seconds: 0,
  isPlaying: false,
  speed: 1,
  loop: null,
  repeats: true,
  link: 'time',
  camera: 'orbit',
  shown: {
    ghosts: false,
    paths: false,
    contacts: false,
    zmp: true,
    axes: false,
    names: true,
    shapes: true,
  },
  isWarping: false,
  // On a phone the panel would hide the timeline.
  isSideOpen: !kPhone.matches,
  panel: '',
  isBare: false,
  language: chosenLanguage() ?? preferredLanguage(),
  busy: 'starting',
  message: '',
});

store.on(['language'], ({language}) => {
  setLanguage(language);
  fillWords();
});
makeStatus(store);
let giveActions: (actions: Actions) => void;
takeFiles(
  store,
  new Promise((resolve) => {
    giveActions = resolve;
  }),
);

/** A page that no paint is told of, as in a tab behind others, starts after so many milliseconds. */
const kLongestPaint = 2000;

/**
 * Resolves when the browser has painted what is there. A busy one paints long after the frame for
 * which it asked the page, so the entry of the paint is what counts.
 */
const painted = () =>
  new Promise<void>((resolve) => {
    const kind = 'first-contentful-paint';
    if (!PerformanceObserver.supportedEntryTypes.includes('paint')) {
      requestAnimationFrame(() => setTimeout(resolve));
    } else {
      new PerformanceObserver((list, observer) => {
        if (list.getEntriesByName(kind).length === 0) return;
        observer.disconnect();
        resolve();
      }).observe({type: 'paint', buffered: true});
    }
    setTimeout(resolve, kLongestPaint);
  });

/** The scene; where the browser has no WebGL, a message in its place, and the rest works. */
function startScene(core: Core, poses: PoseCache): Scene | null {
  try {
    const scene = makeScene(byId('canvas'), store, core, poses);
    makeViews(store, scene);
    return scene;
  } catch {
    byId('canvas').hidden = true;
    byId('stage').append(el('p', {class: 'no-scene', attributes: {'data-word': 'no_webgl'}}));
    fillWords();
    return null;
  }
}

/** Makes the bar, the lists, the timeline, the keys, the address. */
function makeSurroundings(
  core: Core,
  tables: Tables,
  actions: Actions,
  frameAll: () => void,
): void {
  makeMotionList(store, actions);
  makeFileList(store, actions);
  makeLacks(store);
  makeEmpty(tables, store);
  const axis = makeTimeAxis(store);
  const marks = makeMarks(core, store);
  makeTransport(store, marks, () => warp.toggle());
  const warp = makeWarpEditor(core, tables, store, actions, axis);
  makeTrack(store, axis, marks);
  const toggleHelp = makeHelp(store, core.version, (): Shortcut[] => shortcuts);
  const shortcuts = makeShortcuts(store, actions, {
    toggleHelp,
    toggleWarp: () => warp.toggle(),
    goToMark: (direction) => marks.go(direction),
    frameAll,
  });
  useShortcuts(shortcuts);
  makeTools(store, toggleHelp);
  makeSheet(store);
}

async function start(): Promise<Studio> {
  const [core, carried] = await Promise.all([startCore(), carriedFiles(), painted()]);
  let scene: Scene | null = null;
  const poses = makePoseCache(core, () => scene?.invalidate());
  store.on(['motions'], ({motions}) => poses.keep(motions));
  const actions = makeActions(core, store);
  const tables = await tablesOf(core);
  makeSurroundings(core, tables, actions, () => scene?.frameAll());
  makeSide({store, actions, core, tables, savePicture: () => savePicture(store)});
  runPlayback(store);
  scene = startScene(core, poses);
  store.set({busy: ''});

  for (const {path, bytes} of carried.files) await core.addFile(path, bytes);
  for (const {path, ...like} of carried.open) await actions.openPath(path, like);
  keepAddress(store);
  giveActions(actions);
  return {store, scene, poses};
}

const started = start();
offerPictures(started);
started.catch((fault) => store.set({busy: '', message: String(fault)}));
