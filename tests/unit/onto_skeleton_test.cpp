// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "kinefile/compare.hpp"
#include "kinefile/convert.hpp"
#include "kinefile/shape.hpp"
#include "support/random_skeletons.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

/// Reads a fixture of an AMC and of its ASF, which lies beside it.
Document turned_document(const std::string& extension) {
  ReadOptions options;
  options.source_name = "turned." + extension;
  options.companions.open = [](const std::string& name) -> std::optional<CompanionFile> {
    const auto owner = std::make_shared<const std::string>(fixture("acclaim/valid/" + name));
    return CompanionFile{name, *owner, owner};
  };
  options.companions.list = [](std::string_view ending) {
    return std::vector<std::string>{"turned" + std::string(ending)};
  };
  Diagnostics diagnostics;
  const std::string text = fixture("acclaim/valid/turned." + extension);
  auto document = find_format(extension)->read(text, options, diagnostics);
  EXPECT_TRUE(document) << text_of(diagnostics);
  return document ? std::move(*document) : Document{};
}

TEST(OntoSkeleton, AMotionComesBackThroughBvhToARootThatRestsTurned) {
  const Document amc = turned_document("amc");
  const Motion& motion = std::get<Motion>(amc.content);
  ASSERT_FALSE(motion.skeleton.joints[0].rest_rotation.isApprox(Quat::Identity(), 0));
  Diagnostics diagnostics;
  const auto for_bvh = adapted_to(*find_format("bvh"), amc, {}, diagnostics);
  ASSERT_TRUE(for_bvh);
  const ReadText bvh = read_bvh(write_to_string(*for_bvh));
  ASSERT_TRUE(bvh.document);
  EXPECT_LT(compare_motions(motion, bvh.motion()).distance.value, 1e-9);
  Diagnostics told;
  const auto back = on_skeleton_of(turned_document("asf"), *bvh.document, told);
  ASSERT_TRUE(back);
  const MotionComparison comparison = compare_motions(motion, std::get<Motion>(back->content));
  EXPECT_LT(comparison.distance.value, 1e-9);
  EXPECT_LT(comparison.rotation.value, 1e-5);
  ASSERT_EQ(told.items().size(), 1u) << text_of(told);  // BVH does not say its unit
  EXPECT_NE(told.items()[0].message.find("unit of length"), std::string::npos);
}

/// A joint that translates along three axes.
Motion sliding_motion(const std::array<Vec3, 3>& axes, const std::vector<Vec3>& rows) {
  Motion motion;
  motion.skeleton.metres_per_unit = 1;
  motion.skeleton.joints.resize(1);
  motion.skeleton.joints[0].name = "base";
  for (std::size_t k = 0; k < 3; ++k) {
    motion.skeleton.joints[0].dofs.push_back({DofKind::Translation, axes[k], k, 0});
    motion.skeleton.coordinates.push_back({0, "t"});
  }
  motion.clip.num_frames = rows.size();
  motion.clip.num_coordinates = 3;
  for (const Vec3& row : rows) motion.clip.values.append({row[0], row[1], row[2]});
  return motion;
}

TEST(OntoSkeleton, ObliqueTranslationsReachThePlace) {
  const Motion straight =
      sliding_motion({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, {{1, 2, 3}, {-4, 5, 0.5}});
  const Motion oblique =
      sliding_motion({Vec3::UnitX(), Vec3(1, 1, 0).normalized(), Vec3(1, -1, 2).normalized()},
                     {{0, 0, 0}, {0, 0, 0}});
  Diagnostics diagnostics;
  const auto onto = shape::onto_skeleton(straight, oblique.skeleton, diagnostics);
  ASSERT_TRUE(onto);
  EXPECT_TRUE(diagnostics.items().empty()) << text_of(diagnostics);
  EXPECT_LT(compare_motions(straight, *onto).distance.value, 1e-14);
}

TEST(OntoSkeleton, TailsAreTakenOver) {
  Motion motion = sliding_motion({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, {{1, 2, 3}});
  motion.skeleton.joints[0].dofs[2].kind = DofKind::TailTranslation;
  motion.skeleton.joints.push_back(motion.skeleton.joints[0]);
  motion.skeleton.joints[1] = Joint{};
  motion.skeleton.joints[1].name = "end";
  motion.skeleton.joints[1].parent = 0;
  Diagnostics diagnostics;
  const auto onto = shape::onto_skeleton(motion, motion.skeleton, diagnostics);
  ASSERT_TRUE(onto);
  EXPECT_EQ(onto->clip.values, motion.clip.values);
  EXPECT_TRUE(diagnostics.items().empty());
  Skeleton without = motion.skeleton;
  without.joints[0].dofs.pop_back();
  ASSERT_TRUE(shape::onto_skeleton(motion, without, diagnostics));
  ASSERT_EQ(codes_of(diagnostics), std::vector<std::string>{"BRG006"});
  EXPECT_NE(diagnostics.items()[0].message.find("up to 3 units"), std::string::npos);
}

}  // namespace
}  // namespace kinefile::test
