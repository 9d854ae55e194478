// SPDX-License-Identifier: MIT
// What can be plotted of a joint, and its numbers, kept as long as their motion does not change.
import {type Core, isFailure} from '../core/core.ts';
import type {Description, Questions} from '../core/types.ts';
import type {OpenMotion} from '../state.ts';

/** What a quantity is measured in; quantities of one measure share a plot. */
export type Measure = 'length' | 'angle' | 'speed' | 'angular_speed' | 'other';

/** Something that can be plotted of a joint. */
export interface Quantity {
  /** x, y, z, speed, angular_speed, or channel:NAME */
  key: string;
  measure: Measure;
  /** The channel's name; empty for what the core computes. */
  channel: string;
  /** How low and how high a joint may go; undefined: as it likes. */
  limits: (number | undefined)[];
}

const computed = (key: string, measure: Measure): Quantity => ({
  key,
  measure,
  channel: '',
  limits: [],
});
const kComputed: Quantity[] = [
  computed('x', 'length'),
  computed('y', 'length'),
  computed('z', 'length'),
  computed('speed', 'speed'),
  computed('angular_speed', 'angular_speed'),
];

/** What can be plotted of a joint. */
export const quantitiesOf = (document: Description, joint: number): Quantity[] => [
  ...(document.lacks === '' ? kComputed : []),
  ...(document.joints[joint]?.channels ?? []).map(
    ({name, measure, lower, upper}): Quantity => ({
      key: `channel:${name}`,
      measure: measure || 'other',
      channel: name,
      limits: [lower, upper],
    }),
  ),
];

type Curves = Questions['curves']['answer'];

export interface SeriesCache {
  /** The values of a quantity, one a frame; null: the motion has none. */
  values(motion: OpenMotion, joint: number, quantity: Quantity): Promise<Float64Array | null>;
  /** Forgets what belongs to motions that have changed or closed. */
  keep(motions: readonly OpenMotion[]): void;
}

/** One axis of positions [frame][3]. */
function axisOf(positions: Float64Array, axis: number): Float64Array {
  const values = new Float64Array(positions.length / 3);
  for (let frame = 0; frame < values.length; frame++) values[frame] = positions[frame * 3 + axis];
  return values;
}

export function makeSeriesCache(core: Core): SeriesCache {
  const kept = new Map<string, Promise<unknown>>();
  const prefixOf = (motion: OpenMotion) => `${motion.handle}:${motion.version}:`;

  const once = <T>(key: string, make: () => Promise<T>): Promise<T> => {
    const known = kept.get(key) as Promise<T> | undefined;
    if (known !== undefined) return known;
    const made = make();
    kept.set(key, made);
    return made;
  };

  const curvesOf = (motion: OpenMotion, joint: number): Promise<Curves | null> =>
    once(`${prefixOf(motion)}${joint}`, async () => {
      const answer = await core.ask('curves', {handle: motion.handle, joint});
      return isFailure(answer) ? null : answer;
    });

  const columnOf = (motion: OpenMotion, column: number): Promise<Float64Array | null> =>
    once(`${prefixOf(motion)}column:${column}`, async () => {
      const answer = await core.ask('column', {handle: motion.handle, column});
      return isFailure(answer) ? null : answer.values;
    });

  const asked = async (motion: OpenMotion, joint: number, key: string) => {
    const curves = await curvesOf(motion, joint);
    if (curves === null) return null;
    if (key === 'speed') return curves.speeds;
    if (key === 'angular_speed') return curves.angular_speeds;
    return axisOf(curves.positions, 'xyz'.indexOf(key));
  };

  return {
    values(motion, joint, {key, channel}) {
      if (channel === '') {
        return once(`${prefixOf(motion)}${joint}:${key}`, () => asked(motion, joint, key));
      }
      const own = motion.document.joints[joint].channels?.find(({name}) => name === channel);
      return own === undefined ? Promise.resolve(null) : columnOf(motion, own.column);
    },
    keep(motions) {
      const prefixes = motions.map(prefixOf);
      for (const key of kept.keys()) {
        if (!prefixes.some((prefix) => key.startsWith(prefix))) kept.delete(key);
      }
    },
  };
}
