// SPDX-License-Identifier: MIT
// The axis of time that the track and the warp's map share: seconds to pixels.
import type {Store} from '../state.ts';
import {wholeRange} from '../times.ts';

/** Room at both sides, in pixels, for handles and labels. */
export const kLeft = 46;
export const kRight = 14;

/** No zoom shows less, in seconds. */
const kLeastSpan = 0.05;

export interface TimeAxis {
  /** The part of time that is drawn, in seconds. */
  readonly range: [number, number];
  /** Whether all there is happens at one time, as a motion of one frame does. */
  readonly isMoment: boolean;
  /** Where a time is, in a drawing of a width. */
  x(seconds: number, width: number): number;
  /** The time at a place. */
  seconds(x: number, width: number): number;
  /** Seconds a pixel. */
  secondsPerPixel(width: number): number;
  /** Keeps the range while something is dragged, so that it does not run away from the pointer. */
  hold(): void;
  release(): void;
  /** Shows `factor` times as much time, around a time that stays where it is. */
  zoom(factor: number, around: number): void;
  readonly isZoomed: boolean;
  showAll(): void;
  /** Calls a function whenever the range changes in another way than with the motions. */
  onChange(listener: () => void): void;
}

export function makeTimeAxis(store: Store): TimeAxis {
  let held: [number, number] | null = null;
  let zoomed: [number, number] | null = null;
  const listeners: (() => void)[] = [];
  const tell = () => {
    for (const listener of listeners) listener();
  };
  const whole = (): [number, number] => {
    const [begin, end] = wholeRange(store.state);
    return end > begin ? [begin, end] : [begin, begin + 1];
  };
  const axis: TimeAxis = {
    get range() {
      return held ?? zoomed ?? whole();
    },
    get isMoment() {
      const [begin, end] = wholeRange(store.state);
      return end <= begin;
    },
    x(seconds, width) {
      const [begin, end] = axis.range;
      return kLeft + ((seconds - begin) / (end - begin)) * (width - kLeft - kRight);
    },
    seconds(x, width) {
      return axis.range[0] + (x - kLeft) * axis.secondsPerPixel(width);
    },
    secondsPerPixel(width) {
      const [begin, end] = axis.range;
      return (end - begin) / Math.max(1, width - kLeft - kRight);
    },
    hold() {
      held = axis.range;
    },
    release() {
      held = null;
      tell();
    },
    zoom(factor, around) {
      const [first, last] = whole();
      const [begin, end] = axis.range;
      const span = Math.max(kLeastSpan, (end - begin) * factor);
      if (span >= last - first) zoomed = null;
      else {
        const start = around - ((around - begin) / (end - begin)) * span;
        const from = Math.max(first, Math.min(last - span, start));
        zoomed = [from, from + span];
      }
      tell();
    },
    get isZoomed() {
      return zoomed !== null;
    },
    showAll() {
      zoomed = null;
      tell();
    },
    onChange(listener) {
      listeners.push(listener);
    },
  };
  return axis;
}

/** Steps of 1, 2, 5 times a power of ten; the least that keeps labels apart. */
export function tickStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= least * 0.999)!;
}
