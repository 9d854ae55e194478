// SPDX-License-Identifier: MIT
#include "support/figures.hpp"

#include <fmt/format.h>

namespace kinefile::test {
namespace {

std::string offset_text(const Vec3& v) {
  return fmt::format("OFFSET {} {} {}\n", v[0], v[1], v[2]);
}

bool has_positions(const Bone& bone) { return bone.depth == 0 || bone.has_positions; }

}  // namespace

std::string bvh_of_figure(const std::vector<Bone>& bones,
                          const std::vector<std::vector<double>>& rows, double frame_time) {
  std::string text = "HIERARCHY\n";
  int depth = -1;
  for (const Bone& bone : bones) {
    for (; depth >= bone.depth; --depth) text += "}\n";
    text += fmt::format("{} {}\n{{\n", bone.depth == 0 ? "ROOT" : "JOINT", bone.name);
    text += offset_text(bone.offset);
    text += has_positions(bone) ? "CHANNELS 6 Xposition Yposition Zposition" : "CHANNELS 3";
    text += " Zrotation Xrotation Yrotation\n";
    if (bone.tip) text += "End Site\n{\n" + offset_text(*bone.tip) + "}\n";
    depth = bone.depth;
  }
  for (; depth >= 0; --depth) text += "}\n";
  text += fmt::format("MOTION\nFrames: {}\nFrame Time: {}\n", rows.size(), frame_time);
  for (const auto& row : rows) text += fmt::format("{}\n", fmt::join(row, " "));
  return text;
}

std::vector<Bone> person() {
  return {{"Hips", 0, {0, 0, 0}},
          {"LeftUpLeg", 1, {9, -5, 0}},
          {"LeftFoot", 2, {0, -80, 0}, Vec3(0, -5, 12)},
          {"RightUpLeg", 1, {-9, -5, 0}},
          {"RightFoot", 2, {0, -80, 0}, Vec3(0, -5, 12)},
          {"Spine", 1, {0, 20, 0}, Vec3(0, 60, 0)}};
}

std::vector<double> row_of(const std::vector<Bone>& bones, const std::vector<double>& first) {
  std::size_t width = 0;
  for (const Bone& bone : bones) width += has_positions(bone) ? 6 : 3;
  std::vector<double> row = first;
  row.resize(width, 0.0);
  return row;
}

}  // namespace kinefile::test
