// SPDX-License-Identifier: MIT
// Elements of the page. Texts are always text: a file name with markup in it stays a name.
import {baseName} from './paths.ts';

type Attributes<T> = Partial<Omit<T, 'attributes'>> & {
  class?: string;
  on?: {[E in keyof HTMLElementEventMap]?: (event: HTMLElementEventMap[E]) => void};
  attributes?: Record<string, string>;
};

/** Makes an element: its properties, its listeners, its children. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  given: Attributes<HTMLElementTagNameMap[K]> = {},
  children: (Node | string)[] = [],
): HTMLElementTagNameMap[K] {
  const {class: classes, on, attributes, ...properties} = given;
  const element = document.createElement(tag);
  Object.assign(element, properties);
  if (classes) element.className = classes;
  for (const [name, value] of Object.entries(attributes ?? {})) element.setAttribute(name, value);
  for (const [name, listener] of Object.entries(on ?? {})) {
    element.addEventListener(name, listener as EventListener);
  }
  element.append(...children);
  return element;
}

/** An element that the page has from the start. */
export const byId = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

/** A button with a label that is also read aloud. */
export const button = (
  label: string,
  onClick: () => void,
  given: {class?: string; title?: string; disabled?: boolean; pressed?: boolean} = {},
): HTMLButtonElement => {
  const {pressed, class: classes, ...properties} = given;
  const made = el('button', {type: 'button', class: classes, on: {click: onClick}, ...properties}, [
    label,
  ]);
  if (pressed !== undefined) made.setAttribute('aria-pressed', String(pressed));
  return made;
};

/** Offers bytes as a file. */
export function offerFile(name: string, bytes: BlobPart): void {
  const url = URL.createObjectURL(new Blob([bytes]));
  el('a', {href: url, download: baseName(name)}).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
