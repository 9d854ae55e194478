// SPDX-License-Identifier: MIT
#pragma once

#pragma GCC visibility push(default)

namespace kinefile::bvh {

/// What a position channel does to the same component of the joint's OFFSET. Files do not specify
/// it, and programs disagree: see docs/formats/bvh.md.
enum class PositionMode {
  Replace,  ///< the value replaces the component (Blender, bvhio)
  Add,      ///< the value is added to it (three.js, PyMO)
  Auto,     ///< decided by the bones and the lowest point of the figure, with a note
};

/// The meaning of the position channels of the roots and of all other joints.
struct Positions {
  PositionMode root = PositionMode::Replace;
  PositionMode others = PositionMode::Replace;

  Positions() = default;
  Positions(PositionMode mode) : root(mode), others(mode) {}  // NOLINT(*-explicit-*): one for all
  Positions(PositionMode root_mode, PositionMode others_mode)
      : root(root_mode), others(others_mode) {}
};

/// How to read a BVH file, in addition to `kinefile::ReadOptions`.
struct ReadOptions {
  Positions positions = {};
};

}  // namespace kinefile::bvh

#pragma GCC visibility pop
