// SPDX-License-Identifier: MIT
// Icons of buttons, drawn here: characters look different on every system.
import {el} from '../elements.ts';
import {svg} from './svg.ts';

const kPaths = {
  first: 'M3 3h2v10H3zM13 3v10L6 8z',
  back: 'M10.5 3.5v9L4.5 8z',
  play: 'M4 2.5v11L13.5 8z',
  pause: 'M4 3h3v10H4zM9 3h3v10H9z',
  forward: 'M5.5 3.5v9l6-4.5z',
  last: 'M11 3h2v10h-2zM3 3v10l7-5z',
  repeat: 'M4 5h7V3l3.5 3L11 9V7H4v1H2V5zM12 11H5v2L1.5 10 5 7.5V9h7V8h2v3z',
  previousMark: 'M1 8 5.5 4v8zM11 3.5l4.5 9h-9z',
  nextMark: 'M15 8l-4.5-4v8zM5 3.5l4.5 9h-9z',
  warp: 'M2 13.5 5 10l5-1.5L14 2l-1-.6L9.4 7 4.4 8.6 1 12.6zM1.5 1v13.5H15v-1H2.5V1z',
  close: 'm4 2.9 4 4 4-4L13.1 4l-4 4 4 4-1.1 1.1-4-4-4 4L2.9 12l4-4-4-4z',
  shown:
    'M8 3C4.5 3 2 6 1 8c1 2 3.5 5 7 5s6-3 7-5c-1-2-3.5-5-7-5zm0 2.2a2.8 2.8 0 1 1 0 5.6 2.8 2.8 0 0 1 0-5.6z',
  hidden:
    'M2 3 3.2 1.9 14 12.9 12.8 14zM8 3c3.5 0 6 3 7 5-.4.8-1 1.7-1.9 2.6L6 3.4C6.6 3.1 7.3 3 8 3zM1 8c.4-.8 1-1.7 1.9-2.6l7.1 7.2c-.6.3-1.3.4-2 .4-3.5 0-6-3-7-5z',
  plus: 'M7 2.5h2V7h4.5v2H9v4.5H7V9H2.5V7H7z',
  minus: 'M2.5 7h11v2h-11z',
  bin: 'M6 1.5h4l.5 1H14V4H2V2.5h3.5zM3 5h10l-.8 9.5H3.8zm3 1.5.3 6.5h1L7 6.5zm3 0-.3 6.5h1l.3-6.5z',
  undo: 'M6.5 2 2 6l4.5 4V7.2H10a2.4 2.4 0 0 1 0 4.8H6v1.8h4a4.2 4.2 0 0 0 0-8.4H6.5z',
  redo: 'M9.5 2 14 6l-4.5 4V7.2H6a2.4 2.4 0 0 0 0 4.8h4v1.8H6a4.2 4.2 0 0 1 0-8.4h3.5z',
  help: 'M5 5.5C5 3.5 6.3 2.2 8.2 2.2s3.2 1.2 3.2 3c0 1.5-.8 2.2-1.7 2.9-.7.5-.8.8-.8 1.7H7c0-1.5.4-2.2 1.4-2.9.7-.5 1-.8 1-1.5s-.5-1.2-1.2-1.2c-.8 0-1.3.5-1.3 1.4zM6.9 11.4H9v2.1H6.9z',
  copy: 'M5 1.5h8.5V11H11v3.5H2.5V5H5zm1.5 1.5v2H11v4.5h1V3zM4 6.5V13h5.5V6.5z',
  save: 'M7 2h2v5.5h3L8 12 4 7.5h3zM2.5 11H4v2h8v-2h1.5v3.5h-11z',
  panels: 'M1.5 2.5h13v11h-13zM3 4v8h6V4zm7.5 0v8H13V4z',
} as const;

/** The name of an icon. */
export type Icon = keyof typeof kPaths;

/** Draws an icon. */
export const icon = (name: Icon): SVGSVGElement =>
  svg('svg', {viewBox: '0 0 16 16', class: 'icon', 'aria-hidden': 'true'}, [
    svg('path', {d: kPaths[name]}),
  ]);

/** A button that shows an icon, and says its title to those who hear the page. */
export function iconButton(
  name: Icon,
  onClick: () => void,
  given: {title?: string; class?: string; word?: string} = {},
): HTMLButtonElement {
  const made = el('button', {type: 'button', class: `icon-button ${given.class ?? ''}`.trim()}, [
    icon(name),
  ]);
  made.addEventListener('click', onClick);
  if (given.title) titled(made, given.title);
  return made;
}

/** Gives an element a title that is also its label. */
export function titled(element: HTMLElement | SVGElement, title: string): void {
  element.setAttribute('aria-label', title);
  if (element instanceof HTMLElement) element.title = title;
}

/** Shows another icon in a button. */
export const setIcon = (element: HTMLElement, name: Icon): void =>
  element.querySelector('.icon')!.replaceWith(icon(name));
