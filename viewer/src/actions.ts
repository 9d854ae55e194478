// SPDX-License-Identifier: MIT
// What a person does with motions: open, close, change, undo. The core does the work; the state
// says what came of it.
import {type Core, isFailure} from './core/core.ts';
import type {Description, Diagnostic, OpenedFile, Step} from './core/types.ts';
import {activeMotion, type OpenMotion, type Store, withMotion} from './state.ts';

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
  /** Opens a file of the page once more, or a waiting one. */
  openPath(path: string, like?: Partial<Description>): Promise<OpenMotion | null>;
  /** Reads a document again, with other options of reading. */
  reopen(motion: OpenMotion, change: Partial<Description>): Promise<boolean>;
  close(motion: OpenMotion): Promise<void>;
  /** Replaces all steps of a motion; false if one of them is refused, with a message. */
  setSteps(motion: OpenMotion, steps: Step[], undone?: Step[]): Promise<boolean>;
  addStep(motion: OpenMotion, step: Step): Promise<boolean>;
  undo(motion: OpenMotion): Promise<boolean>;
  redo(motion: OpenMotion): Promise<boolean>;
}

const nameOf = (path: string): string => path.slice(path.lastIndexOf('/') + 1);

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
      title: nameOf(document.path),
      colour: freeColour(motions),
      isVisible: true,
      document,
      steps: [],
      undone: [],
      version: 1,
      offset: 0,
      placement: 'recorded',
      diagnostics,
    },
  ];

  /** The open motions after files were opened: some are new, some were read again, some went. */
  const merged = (
    documents: {handle: number; document: Description}[],
    opened: OpenedFile[],
  ): OpenMotion[] => {
    const found = (handle: number) =>
      opened.find((file) => file.handle === handle)?.diagnostics ?? [];
    let motions = store.state.motions.filter((motion) =>
      documents.some((one) => one.handle === motion.handle),
    );
    for (const {handle, document} of documents) {
      const known = motions.find((motion) => motion.handle === handle);
      if (known === undefined) motions = added(motions, handle, document, found(handle));
      else if (known.document.skeleton !== document.skeleton) {
        motions = motions.map((motion) =>
          motion === known ? {...known, document, version: known.version + 1} : motion,
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

  const actions: Actions = {
    async openFiles(files) {
      store.set({busy: 'reading', message: ''});
      try {
        for (const {path, bytes} of files) await core.addFile(path, bytes);
        // What could not be opened before may have what it lacked now.
        const again = store.state.files.filter((file) => file.what === 'fault');
        const paths = [...new Set([...again, ...files].map((file) => file.path))].sort();
        const answer = await core.ask('open_all', {paths});
        if (isFailure(answer)) return store.set({message: answer.error.message});
        const motions = merged(answer.documents, answer.opened);
        store.set({
          motions,
          files: remaining(answer.opened),
          active: firstActive(motions),
        });
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
          diagnostics: diagnostics.length > 0 ? diagnostics : [error],
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
          version: motion.version + 1,
        }),
      });
      const now = store.state.motions.find((other) => other.handle === handle);
      return steps.length === 0 || now === undefined || actions.setSteps(now, steps);
    },

    async close(motion) {
      await core.ask('close', {handle: motion.handle});
      const motions = store.state.motions.filter((other) => other.handle !== motion.handle);
      store.set({motions, active: firstActive(motions), joint: -1});
    },

    async setSteps(motion, steps, undone = []) {
      const answer = await core.ask('edit', {handle: motion.handle, steps});
      if (isFailure(answer)) {
        store.set({message: answer.error.message});
        return false;
      }
      const {document, diagnostics} = answer;
      const now = store.state.motions.find((other) => other.handle === motion.handle);
      if (now === undefined) return false;
      const joint = activeMotion(store.state)?.handle === motion.handle ? -1 : store.state.joint;
      const keepsJoints = document.joints.length === now.document.joints.length;
      store.set({
        message: '',
        joint: keepsJoints ? store.state.joint : joint,
        motions: withMotion(store.state, motion.handle, {
          document,
          steps,
          undone,
          diagnostics,
          version: now.version + 1,
        }),
      });
      return true;
    },

    addStep: (motion, step) => actions.setSteps(motion, [...motion.steps, step]),

    undo(motion) {
      const last = motion.steps[motion.steps.length - 1];
      if (last === undefined) return Promise.resolve(false);
      return actions.setSteps(motion, motion.steps.slice(0, -1), [last, ...motion.undone]);
    },

    redo(motion) {
      const [next, ...undone] = motion.undone;
      if (next === undefined) return Promise.resolve(false);
      return actions.setSteps(motion, [...motion.steps, next], undone);
    },
  };
  return actions;
}
