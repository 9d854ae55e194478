// SPDX-License-Identifier: MIT
// The colours of the stage, for dark and for light pages.

export interface Theme {
  background: number;
  floor: number;
  line: number;
  strongLine: number;
  sky: number;
  sun: number;
  fill: number;
  /** How dark shadows are, 0 to 1. */
  shadow: number;
  text: string;
}

export const kDark: Theme = {
  background: 0x15181d,
  floor: 0x252b33,
  line: 0x424b58,
  strongLine: 0x6b7788,
  sky: 1.3,
  sun: 2.3,
  fill: 2,
  shadow: 0.55,
  text: '#e8ecf1',
};

export const kLight: Theme = {
  background: 0xeef1f5,
  floor: 0xdfe4eb,
  line: 0xbfc7d2,
  strongLine: 0x9aa4b2,
  sky: 1.45,
  sun: 2.2,
  fill: 2,
  shadow: 0.32,
  text: '#1b2027',
};

/** A selected joint, on every figure and in both themes. */
export const kSelected = '#ff3b6b';
