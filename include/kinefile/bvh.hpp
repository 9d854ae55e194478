// SPDX-License-Identifier: MIT
#pragma once

#pragma GCC visibility push(default)

namespace kinefile::bvh {

/// What a position channel does to the same component of the joint's OFFSET. Files do not specify
/// it, and programs disagree: see docs/formats/bvh.md.
enum class PositionMode {
  Replace,  ///< the value replaces the component (Blender, bvhio)
  Add,      ///< the value is added to it (three.js, PyMO)
  Auto,     ///< decided from the first frames, with a note
};

/// How to read a BVH file, in addition to `kinefile::ReadOptions`.
struct ReadOptions {
  PositionMode positions = PositionMode::Replace;
};

}  // namespace kinefile::bvh

#pragma GCC visibility pop
