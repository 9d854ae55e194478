// SPDX-License-Identifier: MIT
// Poses of motions, asked of the core in blocks of frames and kept for a while.
import {type Core, isFailure} from './core/core.ts';
import type {Poses} from './core/types.ts';
import type {OpenMotion} from './state.ts';
import {numFrames} from './times.ts';

/** One frame: views of a block. */
export interface FramePoses {
  /** [joint][3] */
  positions: Float32Array;
  /** [joint][4], w x y z */
  rotations: Float32Array;
  /** [tip][3] */
  tips: Float32Array;
}

export interface PoseCache {
  /** The poses of a frame; null if they are on their way: `onArrival` then tells. */
  at(motion: OpenMotion, frame: number): FramePoses | null;
  /** The same, for one who waits. */
  wait(motion: OpenMotion, frame: number): Promise<FramePoses | null>;
  /** Forgets what belongs to motions that have closed. */
  keep(motions: readonly OpenMotion[]): void;
}

const kFramesPerBlock = 64;
/** Per motion; 64 blocks of 64 frames of 60 joints are 7 MB. */
const kMostBlocks = 64;

interface Kept {
  version: number;
  blocks: Map<number, Poses | Promise<Poses | null>>;
}

const frameOf = (block: Poses, frame: number): FramePoses => {
  const row = frame - block.first;
  const part = (all: Float32Array) => {
    const width = all.length / block.count;
    return all.subarray(row * width, (row + 1) * width);
  };
  return {
    positions: part(block.positions),
    rotations: part(block.rotations),
    tips: part(block.tips),
  };
};

export function makePoseCache(core: Core, onArrival: (handle: number) => void): PoseCache {
  const all = new Map<number, Kept>();

  const keptOf = (motion: OpenMotion): Kept => {
    let kept = all.get(motion.handle);
    if (kept === undefined || kept.version !== motion.version) {
      kept = {version: motion.version, blocks: new Map()};
      all.set(motion.handle, kept);
    }
    return kept;
  };

  const request = (motion: OpenMotion, kept: Kept, index: number): Promise<Poses | null> => {
    const asked = core
      .ask('poses', {
        handle: motion.handle,
        first: index * kFramesPerBlock,
        count: kFramesPerBlock,
      })
      .then((answer) => {
        if (isFailure(answer) || answer.count === 0) return null;
        kept.blocks.set(index, answer);
        if (kept.blocks.size > kMostBlocks) kept.blocks.delete(kept.blocks.keys().next().value!);
        if (all.get(motion.handle) === kept) onArrival(motion.handle);
        return answer;
      });
    kept.blocks.set(index, asked);
    return asked;
  };

  const blockOf = (motion: OpenMotion, frame: number) => {
    const kept = keptOf(motion);
    const index = Math.floor(frame / kFramesPerBlock);
    const block = kept.blocks.get(index) ?? request(motion, kept, index);
    // The next block is fetched before it is needed.
    const isLast = (index + 1) * kFramesPerBlock >= numFrames(motion.document.time);
    if (!isLast && !kept.blocks.has(index + 1)) request(motion, kept, index + 1);
    return block;
  };

  return {
    at(motion, frame) {
      const block = blockOf(motion, frame);
      return block instanceof Promise ? null : frameOf(block, frame);
    },
    async wait(motion, frame) {
      const block = await blockOf(motion, frame);
      return block === null ? null : frameOf(block, frame);
    },
    keep(motions) {
      for (const handle of all.keys()) {
        if (motions.every((motion) => motion.handle !== handle)) all.delete(handle);
      }
    },
  };
}
