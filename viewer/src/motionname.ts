// SPDX-License-Identifier: MIT
// What a motion is called: two of them may come from one file.
import type {OpenMotion} from './state.ts';
import {presenceOf} from './times.ts';
import {t} from './words.ts';

/** What is said of a motion that has not begun, or is over; empty: nothing. */
export function presenceText(motion: OpenMotion, seconds: number): string {
  const presence = presenceOf(motion, seconds);
  if (presence === 'now') return '';
  return t(presence === 'before' ? 'not_begun' : 'is_over');
}

/** What was done to a motion, in a word or two. */
export function changesOf({steps}: OpenMotion): string {
  if (steps.length === 0) return '';
  const last = steps[steps.length - 1];
  if (steps.length === 1 && 'warp' in last) return t('warped');
  return t(steps.length === 1 ? 'changed_once' : 'changed', steps.length);
}

/** Its name where it stands alone, such as "wave.bvh (time warp)". */
export function fullName(motion: OpenMotion): string {
  const changes = changesOf(motion);
  return changes === '' ? motion.title : `${motion.title} (${changes})`;
}
