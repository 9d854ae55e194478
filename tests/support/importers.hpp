// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinefile/math.hpp"

namespace kinefile::test {

/// A program that imports BVH.
enum class Importer {
  Blender,  ///< io_anim_bvh of Blender 3.4
  Three,    ///< BVHLoader of three.js r187
  Assimp,   ///< BVHLoader of assimp 5.2
};

/// What a program makes of a BVH file.
struct Import {
  std::string refusal;                       ///< why it does not import the file; empty: it does
  std::vector<std::string> names;            ///< of joints, in file order
  std::vector<std::vector<Vec3>> positions;  ///< of joints in the world, [frame][joint]
};

/// Imports a BVH text by the rules of a program, which docs/formats/bvh.md names. Our own reader is
/// not used. The text must have the layout that all of these programs accept: one node, brace,
/// OFFSET, CHANNELS, and frame a line.
Import import_bvh(std::string_view text, Importer importer);

}  // namespace kinefile::test
