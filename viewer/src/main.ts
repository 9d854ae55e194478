// SPDX-License-Identifier: MIT
// Starts the page: first what can be seen, then the core and the scene.
import {makeActions} from './actions.ts';
import {type Core, startCore} from './core/core.ts';
import {byId, el} from './elements.ts';
import {carriedFiles, chosenFiles, droppedFiles} from './files.ts';
import {makeMotionList} from './panels/motions.ts';
import {makeSide, tablesOf} from './panels/side.ts';
import {makeTransport} from './panels/transport.ts';
import {makeViews} from './panels/views.ts';
import {offerPictures, type Studio} from './picture.ts';
import {runPlayback} from './playback.ts';
import {makePoseCache, type PoseCache} from './poses.ts';
import {makeScene, type Scene} from './scene/scene.ts';
import {makeStore} from './state.ts';
import {fillWords, preferredLanguage, setLanguage, t, type Word} from './words.ts';

const store = makeStore({
  motions: [],
  active: 0,
  joint: -1,
  files: [],
  seconds: 0,
  isPlaying: false,
  speed: 1,
  loop: null,
  camera: 'orbit',
  shown: {ghosts: false, paths: false, contacts: false, axes: false, names: true, shapes: true},
  panel: 'joints',
  language: preferredLanguage(),
  busy: 'starting',
  message: '',
});

store.on(['language'], ({language}) => {
  setLanguage(language);
  fillWords();
});
store.on(['busy', 'message', 'language'], ({busy, message}) => {
  const status = byId('status');
  status.textContent = message || (busy ? t(busy as Word) : '');
  status.className = message ? 'error' : '';
});

/** Resolves when the browser has painted what is there. */
const painted = () =>
  new Promise<void>((resolve) => requestAnimationFrame(() => setTimeout(resolve)));

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

async function start(): Promise<Studio> {
  const [core, carried] = await Promise.all([startCore(), carriedFiles(), painted()]);
  let scene: Scene | null = null;
  const poses = makePoseCache(core, () => scene?.invalidate());
  const actions = makeActions(core, store);
  makeMotionList(store, actions);
  makeTransport(store);
  makeSide({store, actions, core, tables: await tablesOf(core)});
  runPlayback(store);
  scene = startScene(core, poses);
  store.set({busy: ''});

  for (const {path, bytes} of carried.files) await core.addFile(path, bytes);
  for (const {path, ...like} of carried.open) await actions.openPath(path, like);

  for (const id of ['choose-files', 'choose-folder']) {
    const input = byId<HTMLInputElement>(id);
    input.addEventListener('change', async () => {
      if (input.files) await actions.openFiles(await chosenFiles(input.files));
      input.value = '';
    });
  }
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('drop', async (event) => {
    event.preventDefault();
    if (event.dataTransfer) await actions.openFiles(await droppedFiles(event.dataTransfer.items));
  });
  return {store, scene, poses};
}

const started = start();
offerPictures(started);
started.catch((fault) => store.set({busy: '', message: String(fault)}));
