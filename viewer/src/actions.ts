// SPDX-License-Identifier: MIT
// What a person does with motions: open, close, change, undo. The core does the work; the state
// says what came of it.
import {type Core, isFailure} from './core/core.ts';
import type {
  Description,
  Diagnostic,
  Failure,
  OpenAllAnswer,
  OpenedFile,
  Step,
} from './core/types.ts';
import {baseName, inOrder} from './paths.ts';
import {activeMotion, type OpenMotion, type Store, withMotion} from './state.ts';
import {shownTimes} from './times.ts';
import {t} from './words.ts';

/** Yellow first, blue second, as in the document on time warping; then colours far from both. */
export const kColours = [
  '#f2b705',
  '#3d8bff',
  '#2fb56a',
  '#e5484d',
  '#9b6bff',
  '#ff8a3d',
  '#14b8b8',
  '#ec6fb5',
];

/** Files that were given to the page: from a drop, a choice, or the page itself. */
export interface GivenFile {
  path: string;
  bytes: ArrayBuffer;
}

export interface Actions {
  openFiles(files: GivenFile[]): Promise<void>;
  /** Opens files that wait or could not be read, with what the page has by now; shows the first. */
  openListed(paths: string[]): Promise<void>;
  /** Opens a file of the page once more, as given. */
  openPath(path: string, like?: Partial<Description>): Promise<OpenMotion | null>;
  /** Opens a file at fault with its faults repaired, and shows it. */
  repair(file: OpenedFile): Promise<void>;
  /** Reads a document again, with other options of reading. */
  reopen(motion: OpenMotion, change: Partial<Description>): Promise<boolean>;
  close(motion: OpenMotion): Promise<void>;
  /** Replaces all steps of a motion; false if one of them is refused, with a message. */
  setSteps(motion: OpenMotion, steps: Step[]): Promise<boolean>;
  /**
   * The same for one who shows the refusal; null: done. A change that goes on with the last one, as
   * the moves of a drag do, is undone with it.
   */
  trySteps(motion: OpenMotion, steps: Step[], goesOn?: boolean): Promise<Failure | null>;
  addStep(motion: OpenMotion, step: Step): Promise<boolean>;
  undo(motion: OpenMotion): Promise<boolean>;
  redo(motion: OpenMotion): Promise<boolean>;
}

/** What is said where nothing of what was given is a motion; empty where something is. */
function unreadText(opened: OpenedFile[], given: GivenFile[]): string {
  const isUnknown = ({path}: GivenFile) =>
    opened.some((file) => file.path === path && file.what === 'unknown');
  if (given.length === 0 || !given.every(isUnknown)) return '';
  if (given.length > 3) return t('files_unknown', given.length);
  return `${given.map(({path}) => baseName(path)).join(', ')}: ${t('file_unknown')}`;
}

/** What is said of files that were given once more. */
const againText = (again: OpenMotion[]): string =>
  again.length === 1 ? t('is_open', baseName(again[0].document.path)) : t('are_open', again.length);

/** Whether a file that is not open may be read once others have come. */
const mayOpen = ({what, diagnostics}: OpenedFile): boolean =>
  what === 'fault' || (what === 'unknown' && diagnostics.length > 0);

/** By how much later in its source a changed motion begins, in seconds of the page. */
const startMoved = (before: OpenMotion, now: Description): number =>
  (now.source_start - before.document.source_start) / before.pace;

/** Lets originals keep step with a motion whose steps now begin with another frame of its source. */
function inStep(motions: OpenMotion[], before: OpenMotion, now: Description): OpenMotion[] {
  const moved = startMoved(before, now);
  if (moved === 0) return motions;
  return motions.map((motion) =>
    motion.originalOf === before.handle ? {...motion, offset: motion.offset - moved} : motion,
  );
}

export function makeActions(core: Core, store: Store): Actions {
  /** A colour that no open motion has, as long as there is one. */
  const freeColour = (motions: OpenMotion[]): string =>
    kColours.find((colour) => motions.every((motion) => motion.colour !== colour)) ??
    kColours[motions.length % kColours.length];

  const added = (
    motions: OpenMotion[],
    handle: number,
    document: Description,
    diagnostics: Diagnostic[],
  ): OpenMotion[] => [
    ...motions,
    {
      handle,
      title: baseName(document.path),
      colour: freeColour(motions),
      isVisible: true,
      document,
      steps: [],
      done: [],
      undone: [],
      version: 1,
      offset: 0,
      originalOf: 0,
      pace: 1,
      placement: 'recorded',
      front: null,
      diagnostics,
    },
  ];

  /** The open motions after files were opened: some are new, some were read again, some went. */
  const merged = (documents: OpenAllAnswer['documents'], opened: OpenedFile[]): OpenMotion[] => {
    const found = (handle: number) =>
      opened.find((file) => file.handle === handle)?.diagnostics ?? [];
    let motions = store.state.motions.filter((motion) =>
      documents.some((one) => one.handle === motion.handle),
    );
    for (const {handle, document} of documents) {
      if (document === null) continue;
      const known = motions.find((motion) => motion.handle === handle);
      if (known === undefined) motions = added(motions, handle, document, found(handle));
      else {
        motions = motions.map((motion) =>
          motion === known
            ? {...known, document, steps: [], version: known.version + 1} // done again below
            : motion,
        );
      }
    }
    return motions;
  };

  /** The files that still wait or are at fault, with what came of the new ones. */
  const remaining = (opened: OpenedFile[]): OpenedFile[] => {
    const isTold = (file: OpenedFile) => file.what !== 'document' && file.what !== 'companion';
    const known = new Set(opened.map((file) => file.path));
    return [...store.state.files.filter((file) => !known.has(file.path)), ...opened.filter(isTold)];
  };

  const firstActive = (motions: OpenMotion[]): number =>
    motions.some((motion) => motion.handle === store.state.active)
      ? store.state.active
      : (motions[0]?.handle ?? 0);

  /** Applies a list of steps, and remembers what undo and redo go to. */
  const apply = async (
    motion: OpenMotion,
    history: Pick<OpenMotion, 'steps' | 'done' | 'undone'>,
  ): Promise<Failure | null> => {
    const answer = await core.ask('edit', {handle: motion.handle, steps: history.steps});
    if (isFailure(answer)) return answer;
    const {document, diagnostics} = answer;
    const now = store.state.motions.find((other) => other.handle === motion.handle);
    if (now === undefined) return null;
    const keepsJoints = document.joints.length === now.document.joints.length;
    const isActive = activeMotion(store.state)?.handle === motion.handle;
    const changed = withMotion(store.state, motion.handle, {
      ...history,
      document,
      diagnostics,
      version: now.version + 1,
    });
    const motions = inStep(changed, now, document);
    store.set({
      message: '',
      joint: isActive && !keepsJoints ? -1 : store.state.joint,
      motions,
      ...(isActive ? shownTimes(store.state, motions, startMoved(now, document)) : {}),
    });
    return null;
  };

  /** Whether nothing was refused; tells a refusal. */
  const told = (failure: Failure | null): boolean => {
    if (failure !== null) store.set({message: failure.error.message});
    return failure === null;
  };

  /** Opens files of the page together; null: refused, with a message. */
  const openAll = async (paths: string[], few?: number): Promise<OpenedFile[] | null> => {
    if (paths.length === 0) return [];
    const answer = await core.ask('open_all', {paths, few});
    if (isFailure(answer)) {
      store.set({message: answer.error.message});
      return null;
    }
    const before = store.state.motions;
    const motions = merged(answer.documents, answer.opened);
    store.set({motions, files: remaining(answer.opened), active: firstActive(motions)});
    for (const {handle, steps, done, undone} of before) {
      const now = store.state.motions.find((motion) => motion.handle === handle);
      const isReadAgain = now !== undefined && steps.length > 0 && now.steps.length === 0;
      if (isReadAgain) told(await apply(now, {steps, done, undone}));
    }
    return answer.opened;
  };

  /** A motion of a list of several goes back to it when it is closed. */
  const listedAgain = ({document}: OpenMotion, motions: OpenMotion[]): OpenedFile[] => {
    const {path, format, kind, is_robot} = document;
    const {files} = store.state;
    const isLast = motions.every((other) => other.document.path !== path);
    const hasList = files.some(({what}) => what === 'waiting');
    const is_model = kind === 'skeleton' && is_robot;
    if (!hasList || !isLast || (kind === 'skeleton' && !is_model)) return files;
    const listed = {path, format, handle: 0, is_model, diagnostics: [], leniently: null};
    return [...files, {...listed, what: 'waiting'}];
  };

  const actions: Actions = {
    async openFiles(files) {
      store.set({busy: 'reading', message: ''});
      try {
        const had = new Set<string>();
        for (const {path, bytes} of files) if (await core.addFile(path, bytes)) had.add(path);
        const again = store.state.motions.filter(({document}) => had.has(document.path));
        const isDone = (path: string) => again.some(({document}) => document.path === path);
        // Of a folder that is given once more the list stays as it is.
        const isListed = (path: string) =>
          again.length > 0 &&
          had.has(path) &&
          store.state.files.some((file) => file.path === path && file.what === 'waiting');
        const fresh = files.filter(({path}) => !isDone(path) && !isListed(path));
        // What could not be opened before may have what it lacked now.
        const lacking = fresh.length > 0 ? store.state.files.filter(mayOpen) : [];
        const paths = inOrder(new Set([...lacking, ...fresh].map(({path}) => path)));
        const opened = await openAll(paths);
        if (opened === null) return;
        const isFirst =
          again.length > 0 && !again.some(({handle}) => handle === store.state.active);
        if (isFirst) store.set({active: again[0].handle, joint: -1});
        store.set({message: again.length > 0 ? againText(again) : unreadText(opened, files)});
      } finally {
        store.set({busy: ''});
      }
    },

    async openListed(paths) {
      store.set({busy: 'reading', message: ''});
      try {
        const opened = await openAll(paths, paths.length);
        const first = opened?.find(({what, path}) => what === 'document' && paths.includes(path));
        if (first !== undefined) store.set({active: first.handle, joint: -1});
      } finally {
        store.set({busy: ''});
      }
    },

    async openPath(path, like = {}) {
      store.set({busy: 'reading', message: ''});
      const {skeleton, servo_map, project, options} = like;
      const answer = await core.ask('open', {path, skeleton, servo_map, project, options});
      store.set({busy: ''});
      if (isFailure(answer)) {
        const files = store.state.files.filter((file) => file.path !== path);
        const {error, diagnostics} = answer;
        files.push({
          path,
          what: 'fault',
          format: '',
          handle: 0,
          is_model: false,
          diagnostics: diagnostics.length > 0 ? diagnostics : [error],
          leniently: answer.leniently ?? null,
        });
        store.set({files, message: error.message});
        return null;
      }
      const {handle, document, diagnostics} = answer;
      const motions = added(store.state.motions, handle, document, diagnostics);
      store.set({
        motions,
        files: store.state.files.filter((file) => file.path !== path),
        active: firstActive(motions),
      });
      return motions[motions.length - 1];
    },

    async repair({path, leniently}) {
      const motion = await actions.openPath(path, leniently ?? {});
      if (motion !== null) store.set({active: motion.handle, joint: -1});
    },

    async reopen(motion, change) {
      const {path, skeleton, servo_map, project, options} = {...motion.document, ...change};
      const {handle, steps} = motion;
      const answer = await core.ask('open', {
        path,
        skeleton,
        servo_map,
        project,
        options,
        handle,
      });
      if (isFailure(answer)) {
        store.set({message: answer.error.message});
        return false;
      }
      const {document, diagnostics} = answer;
      store.set({
        message: '',
        motions: withMotion(store.state, handle, {
          document,
          diagnostics,
          // Done again below; if they are refused now, the core has none of them.
          steps: [],
          version: motion.version + 1,
        }),
      });
      const now = store.state.motions.find((other) => other.handle === handle);
      if (steps.length === 0 || now === undefined) return true;
      return told(await apply(now, {steps, done: now.done, undone: now.undone}));
    },

    async close(motion) {
      await core.ask('close', {handle: motion.handle});
      const motions = store.state.motions.filter((other) => other.handle !== motion.handle);
      store.set({
        motions,
        files: listedAgain(motion, motions),
        active: firstActive(motions),
        joint: -1,
      });
    },

    async setSteps(motion, steps) {
      return told(await actions.trySteps(motion, steps));
    },

    trySteps(motion, steps, goesOn = false) {
      const done = goesOn ? motion.done : [...motion.done, motion.steps];
      return apply(motion, {steps, done, undone: []});
    },

    addStep: (motion, step) => actions.setSteps(motion, [...motion.steps, step]),

    async undo(motion) {
      const steps = motion.done[motion.done.length - 1];
      if (steps === undefined) return false;
      const undone = [motion.steps, ...motion.undone];
      return told(await apply(motion, {steps, done: motion.done.slice(0, -1), undone}));
    },

    async redo(motion) {
      const [steps, ...undone] = motion.undone;
      if (steps === undefined) return false;
      return told(await apply(motion, {steps, done: [...motion.done, motion.steps], undone}));
    },
  };
  return actions;
}
