// SPDX-License-Identifier: MIT
// How wide a cell of the grid is, in words.
import {el} from '../elements.ts';
import type {OpenMotion} from '../state.ts';
import {t} from '../words.ts';
import {lengthText} from './floor.ts';

export interface Scale {
  /** Shows the width of a cell, in metres, and whether the unit of a motion is a guess. */
  show(cell: number, motion: OpenMotion | undefined): void;
}

/** The label of the grid; as the panels say it, ≈ stands before what was found and not given. */
export const gridText = (cell: number, motion: OpenMotion | undefined): string => {
  const certainty = motion?.document.unit.certainty ?? 'known';
  const length = lengthText(cell);
  if (certainty === 'doubtful') return t('grid_guess', length);
  return t('grid', certainty === 'known' ? length : `≈ ${length}`);
};

export function makeScale(stage: HTMLElement): Scale {
  const label = el('p', {class: 'grid-scale'});
  stage.append(label);
  return {
    show(cell, motion) {
      const text = motion === undefined ? '' : gridText(cell, motion);
      if (label.textContent !== text) label.textContent = text;
      label.title = motion?.document.unit.reason ?? '';
    },
  };
}
