// SPDX-License-Identifier: MIT
// What every panel is given, and how it draws: only while it is open.
import type {Actions} from '../actions.ts';
import type {Core} from '../core/core.ts';
import type {Tables} from '../core/types.ts';
import type {State, Store} from '../state.ts';

/** The panels, in the order of their tabs. */
export const kPanels = ['joints', 'curves', 'edit', 'info', 'check', 'export'] as const;
export type Panel = (typeof kPanels)[number];

/** The panel that is open. */
export const openPanel = ({panel}: Readonly<State>): Panel =>
  kPanels.find((own) => own === panel) ?? kPanels[0];

export interface PanelContext {
  store: Store;
  actions: Actions;
  core: Core;
  tables: Tables;
  /** Offers a picture of the scene; absent: there is no scene to take one of. */
  savePicture?: () => Promise<void>;
}

/** Calls `draw` when one of these members has changed while a panel is open, and when it opens. */
export function whileOpen(
  store: Store,
  panel: Panel,
  keys: readonly (keyof State)[],
  draw: (state: Readonly<State>, changed: ReadonlySet<keyof State>) => void,
): void {
  store.on([...keys, 'panel'], (state, changed) => {
    if (openPanel(state) === panel) draw(state, changed);
  });
}
