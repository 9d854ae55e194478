// SPDX-License-Identifier: MIT
// Real files: placed as independent programs placed them, and written bit for bit.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>

#include "formats/acclaim/arm.hpp"
#include "formats/acclaim/golden.hpp"
#include "kinefile/convert.hpp"
#include "kinefile/io.hpp"
#include "kinefile/kinefile.hpp"

namespace kinefile::test {
namespace {

Document read_amc(const std::string& path, const std::string& skeleton = {}) {
  Diagnostics diagnostics;
  ReadOptions options;
  if (!skeleton.empty()) options.skeleton_name = data_folder() + "/acclaim/" + skeleton;
  auto document = read_file(data_folder() + "/acclaim/" + path, nullptr, options, diagnostics);
  EXPECT_TRUE(document) << text_of(diagnostics);
  EXPECT_EQ(diagnostics.count(Severity::Warning), 0u) << text_of(diagnostics);
  return document ? std::move(*document) : Document{};
}

const Motion& motion_in(const Document& document) { return std::get<Motion>(document.content); }

TEST(AcclaimRealFiles, BoneEndsAreWhereOtherProgramsPlaceThem) {
  SKIP_WITHOUT_DATA();
  const std::vector<std::pair<std::string, std::string>> kPairs = {
      {"cmu/01_01.amc", "cmu_01_01_octave_f60.csv"},
      {"cmu/02_03.amc", "cmu_02_03.csv"},
      {"cmu/punch_kick.amc", "punch_kick.csv"},
      {"hdm05/HDM_dg_06-03_03_120.amc", "hdm05_dg.csv"},
      {"hdm05/HDM_mm_depositFloorR_019_120.amc", "hdm05_mm_019.csv"},
  };
  for (const auto& [motion, table] : kPairs) {
    const auto rows = read_table(table);
    ASSERT_GT(rows.size(), 1000u) << table;
    EXPECT_LE(largest_error(motion_in(read_amc(motion)), rows, true), 1e-9) << motion;
  }
}

TEST(AcclaimRealFiles, AWarpThatAnotherProgramMadeIsReadAsItMeantIt) {
  SKIP_WITHOUT_DATA();
  const Document document = read_amc("golden/punch_kick_160_slerp.amc", "cmu/punch_kick.asf");
  // The file's bones with fewer than three rotations cannot turn quite as the table's do.
  EXPECT_LE(largest_error(motion_in(document), read_table("punch_kick_160_slerp.csv"), false),
            1e-3);
}

/// cgspeed's BVH clips: the same motion by another program, whose first frame is a T-pose, and
/// which left out the length of the thorax.
double largest_error_of_cgspeed(const std::string& bvh, const std::string& amc) {
  const Document theirs = read_amc("cgspeed_bvh/" + bvh);
  const Motion& b = motion_in(theirs);
  const Document ours = read_amc("cmu/" + amc);
  const Motion& a = motion_in(ours);
  const std::vector<std::pair<std::string, std::string>> kSame = {
      {"Hips", "root"},           {"LeftUpLeg", "lfemur"},  {"LeftLeg", "ltibia"},
      {"LeftFoot", "lfoot"},      {"LeftToeBase", "ltoes"}, {"RightUpLeg", "rfemur"},
      {"RightLeg", "rtibia"},     {"RightFoot", "rfoot"},   {"RightToeBase", "rtoes"},
      {"Neck", "lowerneck"},      {"Head", "head"},         {"LeftArm", "lhumerus"},
      {"LeftForeArm", "lradius"}, {"RightArm", "rhumerus"}, {"RightForeArm", "rradius"},
      {"LeftHand", "lwrist"},     {"RightHand", "rwrist"},
  };
  const auto index_of = [](const Motion& motion, const std::string& name) {
    std::size_t j = 0;
    while (motion.skeleton.joints.at(j).name != name) ++j;
    return j;
  };
  const WorldPoses pa = forward_kinematics(a.skeleton, a.clip, {.tips = true});
  const WorldPoses pb = forward_kinematics(b.skeleton, b.clip);
  const std::size_t thorax = index_of(a, "thorax");
  const auto point = [](std::span<const double> all, std::size_t width, std::size_t f,
                        std::size_t j) { return Vec3(&all[(f * width + j) * 3]); };
  double largest = 0;
  for (std::size_t f = 0; f + 1 < b.clip.num_frames; ++f) {
    const Vec3 left_out =
        point(pa.tips, pa.num_tips, f, thorax - 1) - point(pa.positions, pa.num_joints, f, thorax);
    for (const auto& [their, our] : kSame) {
      const std::size_t j = index_of(a, our);
      bool is_above = false;
      for (std::size_t up = a.skeleton.joints[j].parent; up != kNoParent;
           up = a.skeleton.joints[up].parent) {
        is_above |= up == thorax;
      }
      Vec3 expected = point(pa.positions, pa.num_joints, f, j);
      if (is_above) expected -= left_out;
      const Vec3 found = point(pb.positions, pb.num_joints, f + 1, index_of(b, their));
      largest = std::max(largest, (found - expected).norm());
    }
  }
  return largest;
}

TEST(AcclaimRealFiles, ClipsOfAnotherPipelineAgree) {
  SKIP_WITHOUT_DATA();
  EXPECT_LE(largest_error_of_cgspeed("02_03.bvh", "02_03.amc"), 1.1e-4);
  EXPECT_LE(largest_error_of_cgspeed("05_01.bvh", "05_01.amc"), 1.1e-4);
}

std::vector<std::string> real_motions() {
  std::vector<std::string> names;
  for (const std::string folder : {"cmu", "hdm05"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(data_folder() + "/acclaim/" + folder)) {
      if (entry.path().extension() == ".amc") {
        names.push_back(folder + "/" + entry.path().filename().string());
      }
    }
  }
  return names;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(AcclaimRealFiles, RoundTripBitForBit) {
  SKIP_WITHOUT_DATA();
  const auto names = real_motions();
  EXPECT_GE(names.size(), 9u);
  for (const std::string& name : names) {
    const Document first = read_amc(name);
    const std::string asf = write_to_string(first, "asf");
    const std::string amc = write_to_string(first, "amc");
    const ReadText second = read_acclaim("amc", amc, asf);
    ASSERT_TRUE(second.document) << name << "\n" << text_of(second.diagnostics);
    const Motion& a = motion_in(first);
    const Motion& b = second.motion();
    EXPECT_TRUE(same_bits(a.clip.values, b.clip.values)) << name;
    EXPECT_EQ(column_names(a.skeleton), column_names(b.skeleton)) << name;
    const WorldPoses pa = forward_kinematics(a.skeleton, a.clip, {.num_frames = 50, .tips = true});
    const WorldPoses pb = forward_kinematics(b.skeleton, b.clip, {.num_frames = 50, .tips = true});
    EXPECT_TRUE(same_bits(pa.positions, pb.positions)) << name;
    EXPECT_TRUE(same_bits(pa.tips, pb.tips)) << name;
    EXPECT_EQ(write_to_string(*second.document, "asf"), asf) << name;
    EXPECT_EQ(write_to_string(*second.document, "amc"), amc) << name;
    EXPECT_EQ(a.skeleton.metres_per_unit, b.skeleton.metres_per_unit) << name;
  }
}

/// The largest distance between joints of the same name, relative to the distance from the origin.
double largest_distance(const Motion& a, const Motion& b) {
  const MotionComparison comparison = compare_motions(a, b);
  EXPECT_TRUE(comparison.only_in_first.empty());
  const Box box = world_extent(a.skeleton, a.clip);
  const double size = std::max(box.min.norm(), box.max.norm());
  return std::max(comparison.distance.value, comparison.tip_distance.value) / size;
}

/// The largest step of a column from one frame to the next.
double largest_step(const Motion& motion) {
  double largest = 0;
  for (std::size_t f = 1; f < motion.clip.num_frames; ++f) {
    for (std::size_t c = 6; c < motion.clip.num_coordinates; ++c) {
      largest = std::max(largest, std::abs(motion.clip.row(f)[c] - motion.clip.row(f - 1)[c]));
    }
  }
  return largest;
}

Document converted(Document document, const std::string& format) {
  Diagnostics diagnostics;
  auto result = adapted_to(*find_format(format), std::move(document), {}, diagnostics);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? std::move(*result) : Document{};
}

TEST(AcclaimRealFiles, BecomeBvhAndBackWithEveryJointInItsPlace) {
  SKIP_WITHOUT_DATA();
  for (const std::string& name : real_motions()) {
    const Document first = read_amc(name);
    const ReadText bvh = read_bvh(write_to_string(converted(first, "bvh"), "bvh"));
    ASSERT_TRUE(bvh.document) << name << text_of(bvh.diagnostics);
    const double relative = largest_distance(motion_in(first), bvh.motion());
    EXPECT_LE(relative, 1e-9) << name;
    EXPECT_LE(largest_step(bvh.motion()), std::max(180.0, largest_step(motion_in(first)))) << name;

    const Document bones = converted(*bvh.document, "amc");
    const ReadText back =
        read_acclaim("amc", write_to_string(bones, "amc"), write_to_string(bones, "asf"));
    ASSERT_TRUE(back.document) << name << text_of(back.diagnostics);
    EXPECT_LE(largest_distance(motion_in(first), back.motion()), 1e-9) << name;
    EXPECT_EQ(back.motion().skeleton.joints.size(), motion_in(first).skeleton.joints.size());
  }
}

TEST(AcclaimRealFiles, RealBvhFilesBecomeBonesWithEveryJointInItsPlace) {
  SKIP_WITHOUT_DATA();
  std::size_t count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(data_folder() + "/bvh/real")) {
    if (entry.path().extension() != ".bvh" || entry.path().filename() == "bad.bvh") continue;
    const ReadText bvh = read_bvh(bytes_of(entry.path()));
    const Motion& motion = bvh.motion();
    Diagnostics diagnostics;
    auto bones = adapted_to(*find_format("amc"), *bvh.document, {}, diagnostics);
    if (!bones) {  // several roots, scale
      EXPECT_EQ(bones.error().code, "BRG003") << entry.path();
      continue;
    }
    ++count;
    const ReadText back =
        read_acclaim("amc", write_to_string(*bones, "amc"), write_to_string(*bones, "asf"));
    ASSERT_TRUE(back.document) << entry.path() << text_of(back.diagnostics);
    const MotionComparison comparison = compare_motions(motion, back.motion());
    const Box box = world_extent(motion.skeleton, motion.clip);
    EXPECT_LE(comparison.distance.value, 1e-9 * std::max(box.min.norm(), box.max.norm()))
        << entry.path();
  }
  EXPECT_GE(count, 30u);
}

}  // namespace
}  // namespace kinefile::test
