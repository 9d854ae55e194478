// SPDX-License-Identifier: MIT
// Any bytes, read with any options: no crash, no hang, and either a valid document or an error
// with a place.

#include <cstdint>
#include <cstdlib>

#include "kinefile/kinefile.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check_poses(const kinefile::Motion& motion) {
  using namespace kinefile;
  require(motion.clip.values.size() == motion.clip.num_frames * motion.clip.num_coordinates);
  require(motion.clip.num_coordinates == motion.skeleton.coordinates.size());
  const WorldPoses poses =
      forward_kinematics(motion.skeleton, motion.clip,
                         {.num_frames = 40, .rotations = true, .directions = true, .tips = true});
  require(poses.positions.size() == poses.num_frames * motion.skeleton.joints.size() * 3);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  if (size == 0) return 0;
  ReadOptions options;
  options.lenient = (data[0] & 1) != 0;
  options.positions = static_cast<PositionMode>((data[0] >> 1) % 3);
  constexpr const char* kEncodings[] = {"", "utf-8", "cp932", "utf-16le"};
  options.encoding = kEncodings[(data[0] >> 3) % 4];
  if ((data[0] & 64) != 0) options.fps = 25;
  Diagnostics diagnostics;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto document = find_format("bvh")->read(bytes, options, diagnostics);
  require(document.has_value() == !diagnostics.has_errors());
  for (const Diagnostic& item : diagnostics.items()) {
    require(item.place.line > 0 && item.place.column > 0);
    require(item.caret <= item.excerpt.size());
    to_string(item);
  }
  if (!document) return 0;
  require(validate(skeleton_of(*document)).has_value());
  if (const Motion* motion = std::get_if<Motion>(&document->content)) check_poses(*motion);
  return 0;
}
