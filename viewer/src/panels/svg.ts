// SPDX-License-Identifier: MIT
// Drawings of the timeline: SVG elements, and grips in them that are dragged or moved by keys.

/** Makes an SVG element; null leaves an attribute out. */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number | null> = {},
  children: (Node | string)[] = [],
): SVGElementTagNameMap[K] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== null) element.setAttribute(name, String(value));
  }
  element.append(...children);
  return element;
}

/** What a grip does. A grip is an element with a `data-grip`, its name. */
export interface Grip {
  begin?(event: PointerEvent): void;
  move(event: PointerEvent): void;
  end?(): void;
  /** True if the key was for it. */
  key?(event: KeyboardEvent): boolean;
}

const kGrip = '[data-grip]';

const nameOf = (target: EventTarget | null): string | undefined =>
  (target as Element | null)?.closest<SVGElement>(kGrip)?.dataset.grip;

const gripWith = (root: SVGSVGElement, name: string): SVGElement | null =>
  root.querySelector(`[role="slider"][data-grip="${CSS.escape(name)}"]`);

/**
 * Lets the grips of a drawing be used. The drawing listens, not the grips: a redraw during a drag
 * replaces them.
 */
export function useGrips(root: SVGSVGElement, gripOf: (name: string) => Grip | undefined): void {
  let dragged: {grip: Grip; pointer: number} | null = null;
  root.addEventListener('pointerdown', (event) => {
    const name = nameOf(event.target);
    const grip = name === undefined ? undefined : gripOf(name);
    if (grip === undefined || event.button !== 0 || dragged !== null) return;
    event.preventDefault();
    root.setPointerCapture(event.pointerId);
    dragged = {grip, pointer: event.pointerId};
    grip.begin?.(event);
    gripWith(root, name!)?.focus({preventScroll: true});
  });
  root.addEventListener('pointermove', (event) => {
    if (dragged?.pointer === event.pointerId) dragged.grip.move(event);
  });
  const end = (event: PointerEvent) => {
    if (dragged?.pointer !== event.pointerId) return;
    const {grip} = dragged;
    dragged = null;
    grip.end?.();
  };
  root.addEventListener('pointerup', end);
  root.addEventListener('pointercancel', end);
  root.addEventListener('keydown', (event) => {
    const name = nameOf(event.target);
    if (name === undefined || event.ctrlKey || event.metaKey) return;
    if (gripOf(name)?.key?.(event)) event.preventDefault();
  });
}

/** Replaces what a drawing shows; the grip that had the focus keeps it. */
export function redraw(root: SVGSVGElement, children: Node[]): void {
  const focused = root.contains(document.activeElement)
    ? nameOf(document.activeElement)
    : undefined;
  root.replaceChildren(...children);
  if (focused !== undefined) gripWith(root, focused)?.focus({preventScroll: true});
}

/** The attributes of a grip that is a slider, for those who use keys or hear the page. */
export const sliderAttributes = (
  grip: string,
  label: string,
  [least, most]: [number, number],
  value: number,
  text: string,
): Record<string, string | number> => ({
  'data-grip': grip,
  role: 'slider',
  tabindex: 0,
  'aria-label': label,
  'aria-valuemin': least,
  'aria-valuemax': most,
  'aria-valuenow': value,
  'aria-valuetext': text,
});

/** How far an arrow key moves: 0 for other keys; ten times as far with Shift. */
export function arrowStep(event: KeyboardEvent): number {
  const far = event.shiftKey ? 10 : 1;
  if (event.key === 'ArrowRight') return far;
  return event.key === 'ArrowLeft' ? -far : 0;
}
