// SPDX-License-Identifier: MIT
// Files with one oddity each, and the world positions of joint B (index 2, or 3 under a dummy
// root) that they stand for; null where no single reading is right.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "kinefile/kinematics.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

/// What we do with the files for which no single reading is right.
const std::map<std::string, std::vector<std::string>> kChoices = {
    {"40_offset_missing", {"BVH006"}},         // refused; --lenient assumes 0 0 0
    {"62_Frames_more_than_rows", {"BVH031"}},  // the rows that are there are read
    {"64_Frames_zero_with_rows", {"BVH030"}},  // all rows are read
    {"65_row_extra_values", {"BVH028"}},       // refused; --lenient drops the numbers beyond
    {"74_motion_inf", {"BVH027"}},             // read as infinity
    {"75_motion_1.#IND", {"BVH027"}},          // read as NaN
    {"79_garbage_after_frames", {"BVH015", "BVH033"}},  // read up to there
    {"94_Frames_negative", {"BVH019"}},                 // refused; --lenient counts the rows
};

/// Files that are an error by default and have their positions under --lenient.
const std::vector<std::string> kRepaired = {"55_FrameTime_comma", "97_unknown_channel_Foo"};

void expect_positions(const Motion& motion, const nlohmann::json& expected,
                      const std::string& name) {
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  ASSERT_EQ(poses.num_frames, expected.size()) << name;
  const std::size_t joint = poses.num_joints - 1;
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double position = poses.positions[(f * poses.num_joints + joint) * 3 + k];
      const double reference = expected[f][k];
      EXPECT_NEAR(position, reference, 1e-9 * std::abs(reference)) << name << " frame " << f;
    }
  }
}

TEST(BvhDialects, EachGivesItsPositionsOrItsDiagnostics) {
  SKIP_WITHOUT_DATA();
  const std::string folder = data_folder() + "/bvh/dialects/";
  const auto expected = nlohmann::json::parse(bytes_of(folder + "expected.json"));
  EXPECT_EQ(expected.size(), 60u);
  for (const auto& [name, positions] : expected.items()) {
    const std::string bytes = bytes_of(folder + name + ".bvh");
    const ReadText read = read_bvh(bytes);
    if (positions.is_null()) {
      ASSERT_TRUE(kChoices.contains(name)) << name;
      EXPECT_EQ(codes_of(read.diagnostics), kChoices.at(name)) << name;
    } else if (std::find(kRepaired.begin(), kRepaired.end(), name) != kRepaired.end()) {
      EXPECT_EQ(read.diagnostics.count(Severity::Error), 1u) << name;
      EXPECT_GT(read.diagnostics.items()[0].place.line, 0u) << name;
      expect_positions(read_bvh(bytes, {.lenient = true}).motion(), positions, name);
    } else {
      EXPECT_EQ(read.diagnostics.count(Severity::Error), 0u) << text_of(read.diagnostics);
      expect_positions(read.motion(), positions, name);
    }
  }
}

}  // namespace
}  // namespace kinefile::test
