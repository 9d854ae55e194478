// SPDX-License-Identifier: MIT
// Colours of lines that can be seen on a light and on a dark ground.

type Rgb = [number, number, number];

/** Contrast that graphics need beside their ground (WCAG 1.4.11). */
const kLeastContrast = 3;

const darkScheme = () => window.matchMedia('(prefers-color-scheme: dark)');

/** Whether the page is dark now. */
export const isDark = (): boolean => darkScheme().matches;

/** Calls a function when the page turns dark or light. */
export const onTheme = (listener: () => void): void =>
  darkScheme().addEventListener('change', listener);

/** A colour of the style sheet: "--line". */
export const styleColour = (name: string): string =>
  getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const parse = (colour: string): Rgb => [
  Number.parseInt(colour.slice(1, 3), 16),
  Number.parseInt(colour.slice(3, 5), 16),
  Number.parseInt(colour.slice(5, 7), 16),
];

const luminance = (rgb: Rgb): number => {
  const [r, g, b] = rgb.map((value) => {
    const part = value / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};

const contrast = (a: number, b: number): number =>
  (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);

/** A colour #rrggbb, darker or lighter as far as its ground asks for it. */
export function readableColour(colour: string, dark: boolean): string {
  const ground = luminance(dark ? [21, 24, 29] : [255, 255, 255]);
  const rgb = parse(colour);
  const towards = dark ? 255 : 0;
  for (let mix = 0; mix < 1; mix += 0.05) {
    const mixed = rgb.map((value) => Math.round(value + (towards - value) * mix)) as Rgb;
    if (contrast(luminance(mixed), ground) >= kLeastContrast) return `rgb(${mixed.join(' ')})`;
  }
  return colour;
}

/** Red, green and blue for x, y and z, as everywhere in 3D; then others. */
const kAxisColours = ['#d93a3a', '#2f9e44', '#3678e0'];
const kOtherColours = ['#b3589a', '#b8860b', '#1199aa', '#8a63d2', '#6b7a3a', '#c2562d'];

/** The colour of the n-th line of a plot; `axis` is -1 for what belongs to no axis. */
export const lineColour = (axis: number, n: number, dark: boolean): string =>
  readableColour(axis >= 0 ? kAxisColours[axis] : kOtherColours[n % kOtherColours.length], dark);
