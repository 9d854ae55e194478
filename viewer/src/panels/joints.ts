// SPDX-License-Identifier: MIT
// The joints of the active motion: a list to search and choose in, and what the chosen one does.
import type {Joint} from '../core/types.ts';
import {el} from '../elements.ts';
import {activeMotion, type State} from '../state.ts';
import {t} from '../words.ts';
import {type PanelContext, whileOpen} from './context.ts';
import {makeReadout} from './readout.ts';

/** Deeper joints are indented no further: the list is narrow. */
const kDeepest = 14;

/** How far down each joint is. */
export function depthsOf(joints: Joint[]): number[] {
  const depths: number[] = [];
  for (const {parent} of joints) depths.push(parent < 0 ? 0 : depths[parent] + 1);
  return depths;
}

/** The joints whose name, or the name of what moves them, has a text in it. */
export function foundJoints(joints: Joint[], wanted: string): number[] {
  const lower = wanted.trim().toLowerCase();
  const isFound = ({name, joint_name}: Joint) =>
    name.toLowerCase().includes(lower) || joint_name.toLowerCase().includes(lower);
  return joints.flatMap((joint, index) => (isFound(joint) ? [index] : []));
}

/** Makes the panel. */
export function makeJointsPanel(context: PanelContext): HTMLElement {
  const {store} = context;
  const search = el('input', {type: 'search', class: 'search'});
  const found = el('output', {class: 'faint'});
  const tree = el('div', {class: 'joints', tabIndex: 0, attributes: {role: 'tree'}});
  let rows = new Map<number, HTMLElement>();
  let drawnFor: unknown[] = [];

  const choose = (joint: number) => store.set({joint});

  const row = (joint: Joint, index: number, depth: number): HTMLElement => {
    const isOther = joint.joint_name !== '' && joint.joint_name !== joint.name;
    const made = el(
      'div',
      {
        id: `joint-${index}`,
        class: 'joint',
        on: {click: () => choose(index)},
        attributes: {role: 'treeitem', 'aria-level': String(depth + 1), 'aria-selected': 'false'},
      },
      [
        el('span', {}, [joint.name || t('nameless')]),
        ...(isOther ? [el('span', {class: 'other-name'}, [joint.joint_name])] : []),
      ],
    );
    made.style.paddingInlineStart = `${10 + Math.min(depth, kDeepest) * 12}px`;
    return made;
  };

  const select = ({joint}: Readonly<State>) => {
    tree.querySelector('[aria-selected="true"]')?.setAttribute('aria-selected', 'false');
    const chosen = rows.get(joint);
    if (chosen === undefined) return tree.removeAttribute('aria-activedescendant');
    chosen.setAttribute('aria-selected', 'true');
    tree.setAttribute('aria-activedescendant', chosen.id);
    chosen.scrollIntoView({block: 'nearest'});
  };

  const draw = (state: Readonly<State>) => {
    const motion = activeMotion(state);
    const wanted = [motion?.handle, motion?.document.joints, state.language, search.value];
    if (wanted.every((value, index) => value === drawnFor[index])) return select(state);
    drawnFor = wanted;
    search.placeholder = t('search_joints');
    search.setAttribute('aria-label', t('search_joints'));
    tree.setAttribute('aria-label', t('tab_joints'));
    const joints = motion?.document.joints ?? [];
    const shown = foundJoints(joints, search.value);
    const depths = depthsOf(joints);
    const isSearch = search.value.trim() !== '';
    rows = new Map(
      shown.map((index) => [index, row(joints[index], index, isSearch ? 0 : depths[index])]),
    );
    found.textContent = isSearch ? t('found_joints', shown.length, joints.length) : '';
    const empty = el('p', {class: 'empty'}, [t(motion ? 'no_joint_found' : 'no_motion')]);
    tree.replaceChildren(...(rows.size > 0 ? rows.values() : [empty]));
    select(state);
  };

  /** Goes to another row: the selection goes with it. */
  const move = (event: KeyboardEvent) => {
    const shown = [...rows.keys()];
    const at = shown.indexOf(store.state.joint);
    const steps: Record<string, number> = {
      ArrowDown: at + 1,
      ArrowUp: at < 0 ? 0 : at - 1,
      PageDown: at + 10,
      PageUp: at - 10,
      Home: 0,
      End: shown.length - 1,
    };
    if (!(event.key in steps) || shown.length === 0) return;
    event.preventDefault();
    event.stopPropagation(); // these keys go to other frames elsewhere
    choose(shown[Math.max(0, Math.min(shown.length - 1, steps[event.key]))]);
  };

  tree.addEventListener('keydown', move);
  // The readout of the first choice takes room from the list.
  new ResizeObserver(() => {
    tree.querySelector('[aria-selected="true"]')?.scrollIntoView({block: 'nearest'});
  }).observe(tree);
  search.addEventListener('input', () => draw(store.state));
  search.addEventListener('keydown', (event) => {
    const [first] = rows.keys();
    if (event.key === 'Enter' && first !== undefined) choose(first);
    if (event.key === 'ArrowDown') {
      event.preventDefault();
      if (!rows.has(store.state.joint) && first !== undefined) choose(first);
      tree.focus();
    }
  });
  whileOpen(store, 'joints', ['motions', 'active', 'joint', 'language'], draw);
  const head = el('div', {class: 'search-bar'}, [search, found]);
  return el('section', {class: 'joints-panel'}, [head, tree, makeReadout(context)]);
}
