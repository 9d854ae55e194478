// SPDX-License-Identifier: MIT
// What is wrong with the file, as `kinefile check` says it, and what stands out in the motion.
import {type Core, isFailure} from '../core/core.ts';
import type {Diagnostic, Mark, OpenedFile} from '../core/types.ts';
import {button, el} from '../elements.ts';
import {fullName} from '../motionname.ts';
import {goToFrame} from '../playback.ts';
import {activeMotion, type OpenMotion, type State} from '../state.ts';
import {fromCore, t} from '../words.ts';
import {openPanel, type PanelContext, whileOpen} from './context.ts';
import {diagnosticList} from './diagnostic.ts';
import {latestOnly} from './latest.ts';

const kSeverities = ['error', 'warning', 'note'] as const;

/** Whether a diagnostic says the same as a mark. */
const isOf = (mark: Mark, {code, message}: Diagnostic): boolean =>
  mark.code === code && mark.message === message;

/** What decides the answer of a check: the file and how it is read, not what was done to it. */
const readingOf = ({handle, document}: OpenMotion): string => {
  const {path, skeleton, servo_map, project, options} = document;
  return JSON.stringify([handle, path, skeleton, servo_map, project, options]);
};

/** The diagnostics of a motion's file, asked once as long as it is read in the same way. */
function makeChecks(core: Core) {
  const known = new Map<number, {reading: string; diagnostics: Diagnostic[]}>();
  return {
    of: (motion: OpenMotion): Diagnostic[] | undefined => {
      const own = known.get(motion.handle);
      return own?.reading === readingOf(motion) ? own.diagnostics : undefined;
    },
    async ask(motion: OpenMotion): Promise<void> {
      const answer = await core.ask('check', {handle: motion.handle});
      const diagnostics = isFailure(answer) ? [answer.error] : answer.diagnostics;
      known.set(motion.handle, {reading: readingOf(motion), diagnostics});
    },
  };
}

/** What stands out in a motion, asked once for each version of it. */
function makeMarks(core: Core) {
  const known = new Map<number, {version: number; marks: Mark[]}>();
  return {
    of: (motion: OpenMotion): Mark[] | undefined => {
      const own = known.get(motion.handle);
      return own?.version === motion.version ? own.marks : undefined;
    },
    async ask(motion: OpenMotion): Promise<void> {
      const answer = await core.ask('marks', {handle: motion.handle});
      const marks = isFailure(answer) ? [] : answer.marks;
      known.set(motion.handle, {version: motion.version, marks});
    },
  };
}

/** Makes the panel; the tab says in `count` how much there is to read. */
export function makeCheckPanel(context: PanelContext, count: HTMLElement): HTMLElement {
  const {store, actions, core} = context;
  const root = el('section', {class: 'check-panel scrolled'});
  const checks = makeChecks(core);
  const marks = makeMarks(core);

  const section = (title: string, parts: (Node | string)[]): HTMLElement =>
    el('section', {}, [el('h2', {}, [title]), ...parts]);

  const goTo = (mark: Mark) => {
    store.set({joint: mark.joint});
    goToFrame(store, mark.worst_frame);
  };

  /** Diagnostics by severity; those of a frame have a button that goes there. */
  const groups = (diagnostics: Diagnostic[], found: Mark[]): HTMLElement[] => {
    const going = (diagnostic: Diagnostic) => {
      const mark = found.find((one) => isOf(one, diagnostic));
      if (mark === undefined) return [];
      return [button(t('go_to_frame', mark.worst_frame), () => goTo(mark), {class: 'go'})];
    };
    return kSeverities.flatMap((severity) => {
      const own = diagnostics.filter((one) => one.severity === severity);
      if (own.length === 0) return [];
      return [section(`${t(`severity_${severity}s`)} (${own.length})`, diagnosticList(own, going))];
    });
  };

  const markRow = (motion: OpenMotion, mark: Mark): HTMLElement => {
    const place = `${t('frame')} ${mark.worst_frame}`;
    const joint = motion.document.joints[mark.joint]?.name ?? '';
    const go = () => goTo(mark);
    return el('li', {}, [
      el('button', {type: 'button', class: `mark ${mark.severity}`, on: {click: go}}, [
        el('span', {class: 'faint'}, [`${place}  ${joint}`]),
        el('span', {}, [fromCore(mark.message)]),
      ]),
    ]);
  };

  const markList = (motion: OpenMotion, found: Mark[]): HTMLElement => {
    const kMost = 200; // a person goes to no more
    const rows = found.slice(0, kMost).map((mark) => markRow(motion, mark));
    const rest = found.length - rows.length;
    return el('ul', {class: 'marks'}, [
      ...rows,
      ...(rest > 0 ? [el('li', {class: 'faint'}, [t('and_more', rest)])] : []),
    ]);
  };

  /** A file at fault; repaired and opened, what was repaired is then what is read here. */
  const fault = (file: OpenedFile): HTMLElement =>
    section(t('not_opened', file.path), [
      ...diagnosticList(file.diagnostics),
      ...(file.leniently === null
        ? []
        : [button(t('open_leniently'), () => actions.repair(file), {title: t('lenient_help')})]),
    ]);

  /** What the check says of a motion's file, and what stands out in the motion beside that. */
  const partsOf = (motion: OpenMotion): HTMLElement[] => {
    const found = checks.of(motion);
    const standing = marks.of(motion) ?? [];
    if (found === undefined) {
      const waiting = el('p', {class: 'faint', attributes: {role: 'status'}}, [t('checking')]);
      return [section(fullName(motion), [waiting])];
    }
    const isGood = found.every(({severity}) => severity === 'note');
    // Frames that the check names are those of the file.
    const ofFile = motion.steps.length === 0 ? standing : [];
    const others = standing.filter(
      (mark) => !ofFile.includes(mark) || !found.some((one) => isOf(mark, one)),
    );
    const title = `${t('stands_out')} (${others.length})`;
    return [
      section(fullName(motion), isGood ? [el('p', {}, [t('nothing_wrong')])] : []),
      ...groups(found, ofFile),
      ...(others.length > 0 ? [section(title, [markList(motion, others)])] : []),
    ];
  };

  const draw = (state: Readonly<State>) => {
    const motion = activeMotion(state);
    const parts = state.files.filter(({what}) => what === 'fault').map(fault);
    if (motion === undefined && parts.length === 0) {
      return root.replaceChildren(el('p', {class: 'empty'}, [t('no_motion')]));
    }
    if (motion !== undefined) parts.push(...partsOf(motion));
    root.replaceChildren(...parts);
  };

  /** Errors and warnings: those of the check, or of reading as long as there was none. */
  const tell = (state: Readonly<State>) => {
    const motion = activeMotion(state);
    const faults = state.files.filter(({what}) => what === 'fault');
    const all = [
      ...faults.flatMap(({diagnostics}) => diagnostics),
      ...(motion === undefined ? [] : (checks.of(motion) ?? motion.diagnostics)),
    ];
    const serious = all.filter(({severity}) => severity !== 'note');
    count.hidden = serious.length === 0;
    count.textContent = String(serious.length);
    count.title = t('count_help', serious.length);
    count.classList.toggle(
      'error',
      serious.some(({severity}) => severity === 'error'),
    );
  };

  const ask = latestOnly<OpenMotion>(async (motion) => {
    if (checks.of(motion) === undefined) await checks.ask(motion);
    tell(store.state);
    if (openPanel(store.state) !== 'check') return;
    if (marks.of(motion) === undefined) await marks.ask(motion);
    draw(store.state);
  });

  /**
   * Checks the active motion once, so that the tab has its count: after its first poses were
   * drawn, and not while it plays, since the core does one thing at a time.
   */
  const askInTime = () => {
    const motion = activeMotion(store.state);
    if (motion === undefined || store.state.isPlaying || checks.of(motion) !== undefined) return;
    ask(motion);
  };

  let drawnFor: unknown[] = [];
  whileOpen(store, 'check', ['motions', 'active', 'files', 'language'], (state) => {
    const motion = activeMotion(state);
    const wanted = [motion?.handle, motion?.document, state.files, state.language];
    // What is unfolded and scrolled to stays while there is nothing new.
    if (wanted.every((value, index) => value === drawnFor[index])) return;
    drawnFor = wanted;
    draw(state);
    if (motion === undefined) return;
    if (checks.of(motion) === undefined || marks.of(motion) === undefined) ask(motion);
  });
  store.on(['motions', 'active', 'files', 'language'], tell);
  store.on(['motions', 'active', 'isPlaying'], () => {
    const motion = activeMotion(store.state);
    if (motion === undefined || checks.of(motion) !== undefined) return;
    requestAnimationFrame(() => setTimeout(askInTime));
  });
  return root;
}
