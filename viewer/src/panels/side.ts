// SPDX-License-Identifier: MIT
// The panels at the side, as tabs: one is open.
import {type Core, isFailure} from '../core/core.ts';
import type {Tables} from '../core/types.ts';
import {byId, el} from '../elements.ts';
import {t} from '../words.ts';
import {makeCheckPanel} from './check.ts';
import {kPanels, openPanel, type Panel, type PanelContext} from './context.ts';
import {makeCurvesPanel} from './curves.ts';
import {makeEditPanel} from './edit.ts';
import {makeExportPanel} from './export.ts';
import {makeInfoPanel} from './info.ts';
import {makeJointsPanel} from './joints.ts';

/** The tables of the core, from which forms are made. */
export async function tablesOf(core: Core): Promise<Tables> {
  const answer = await core.ask('tables', {});
  if (isFailure(answer)) throw new Error(answer.error.message);
  return answer;
}

/** Which tab a key goes to, from the one that has the focus; null: the key is not for tabs. */
const tabAfter = (key: string, from: number): number | null => {
  const last = kPanels.length - 1;
  if (key === 'ArrowRight') return from === last ? 0 : from + 1;
  if (key === 'ArrowLeft') return from === 0 ? last : from - 1;
  if (key === 'Home') return 0;
  if (key === 'End') return last;
  return null;
};

/** Fills the side of the page. */
export function makeSide(context: PanelContext): void {
  const {store} = context;
  const count = el('span', {class: 'count', hidden: true});
  const panels: Record<Panel, HTMLElement> = {
    joints: makeJointsPanel(context),
    curves: makeCurvesPanel(context),
    edit: makeEditPanel(context),
    info: makeInfoPanel(context),
    check: makeCheckPanel(context, count),
    export: makeExportPanel(context),
  };
  const labels = kPanels.map(() => el('span'));
  const tabs = kPanels.map((panel, index) =>
    el(
      'button',
      {
        type: 'button',
        id: `tab-${panel}`,
        class: 'tab',
        attributes: {role: 'tab', 'aria-controls': `panel-${panel}`},
        on: {
          click: () => store.set({panel}),
          keydown: (event) => {
            const next = tabAfter(event.key, index);
            if (next === null) return;
            event.preventDefault();
            event.stopPropagation(); // the arrows step frames elsewhere
            store.set({panel: kPanels[next]});
            tabs[next].focus();
          },
        },
      },
      panel === 'check' ? [labels[index], count] : [labels[index]],
    ),
  );
  const list = el('div', {class: 'tabs', attributes: {role: 'tablist'}}, tabs);
  for (const panel of kPanels) {
    const root = panels[panel];
    root.id = `panel-${panel}`;
    root.classList.add('panel');
    root.setAttribute('role', 'tabpanel');
    root.setAttribute('aria-labelledby', `tab-${panel}`);
  }
  byId('side').append(list, ...kPanels.map((panel) => panels[panel]));

  store.on(['language'], () => {
    list.setAttribute('aria-label', t('panels'));
    kPanels.forEach((panel, index) => {
      labels[index].textContent = t(`tab_${panel}`);
    });
  });
  store.on(['panel'], (state) => {
    kPanels.forEach((panel, index) => {
      const isOpen = panel === openPanel(state);
      tabs[index].setAttribute('aria-selected', String(isOpen));
      tabs[index].tabIndex = isOpen ? 0 : -1;
      panels[panel].hidden = !isOpen;
    });
  });
}
