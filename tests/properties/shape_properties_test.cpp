// SPDX-License-Identifier: MIT
// What holds for any skeleton when its shape changes, tried on random ones with fixed seeds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinefile/joint_rotation.hpp"
#include "kinefile/shape.hpp"
#include "support/random_skeletons.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

constexpr double kSamePlace = 1e-9;  // of the motion's size
constexpr double kSameTurn = 1e-7;   // radians: of angles near 0, half of the digits are lost

void expect_same_world(const Motion& a, const Motion& b, int seed, bool has_same_turns = true) {
  const WorldDifference difference = world_difference(a, b);
  EXPECT_LT(difference.position, kSamePlace) << "skeleton " << seed;
  EXPECT_LT(difference.tip, kSamePlace) << "skeleton " << seed;
  EXPECT_LT(difference.shape, kSamePlace) << "skeleton " << seed;
  EXPECT_EQ(difference.num_shapes, num_shapes(a.skeleton)) << "skeleton " << seed;
  if (has_same_turns) {
    EXPECT_LT(difference.rotation, kSameTurn) << "skeleton " << seed;
  }
  EXPECT_TRUE(validate(b.skeleton)) << "skeleton " << seed;
  EXPECT_EQ(b.clip.num_coordinates, b.skeleton.coordinates.size());
  EXPECT_EQ(b.clip.values.size(), b.clip.num_frames * b.clip.num_coordinates);
}

bool has_tail_translation(const Joint& joint) {
  return std::any_of(joint.dofs.begin(), joint.dofs.end(), [](const DegreeOfFreedom& dof) {
    return dof.kind == DofKind::TailTranslation;
  });
}

TEST(ShapeProperties, WorldAlignedRestKeepsTheWorldAndTheValues) {
  RandomSource random(101);
  int num_accepted = 0;
  for (int i = 0; i < 300; ++i) {
    const Motion motion =
        random_motion(random, {.free_joints = i % 3 == 0, .whole_rotations = i % 9 == 0});
    const ExpectUnchanged unchanged(motion);
    const auto aligned = shape::with_world_aligned_rest(motion);
    if (!aligned) {
      EXPECT_EQ(aligned.error().code, "BRG001");
      continue;
    }
    ++num_accepted;
    for (const Joint& joint : aligned->skeleton.joints) {
      EXPECT_EQ(joint.rest_rotation.coeffs(), Quat::Identity().coeffs());
    }
    EXPECT_TRUE(same_bits(aligned->clip.values, motion.clip.values));
    expect_same_world(motion, *aligned, i, false);
    EXPECT_LT(world_difference(motion, *aligned, true).position, kSamePlace);
  }
  EXPECT_GT(num_accepted, 220);
}

TEST(ShapeProperties, WithoutTailTranslationsTheChildrenMoveInTheirPlace) {
  RandomSource random(102);
  int num_accepted = 0;
  for (int i = 0; i < 300; ++i) {
    const Motion motion = random_motion(random, {.without_frames = i % 10 == 0});
    const ExpectUnchanged unchanged(motion);
    Diagnostics diagnostics;
    const auto strict = shape::without_tail_translations(motion, false, diagnostics);
    EXPECT_TRUE(diagnostics.items().empty());
    const auto lenient = shape::without_tail_translations(motion, true, diagnostics);
    ASSERT_TRUE(lenient);
    EXPECT_EQ(count_code(diagnostics, "BRG002") == 0, strict.has_value()) << "what is lost is told";
    for (const Joint& joint : lenient->skeleton.joints) EXPECT_FALSE(has_tail_translation(joint));
    EXPECT_TRUE(same_bits(lenient->clip.values, motion.clip.values));
    EXPECT_TRUE(validate(lenient->skeleton));
    EXPECT_LT(world_difference(motion, *lenient).position, kSamePlace) << i;
    EXPECT_LT(world_difference(motion, *lenient, true).position, kSamePlace) << i;
    if (!strict) continue;
    ++num_accepted;
    const Motion bare = shape::without_inner_tips(motion);
    expect_same_world(bare, shape::without_inner_tips(*strict), i);
  }
  EXPECT_GT(num_accepted, 200);
}

TEST(ShapeProperties, WithoutUnreadColumnsTheWorldStays) {
  RandomSource random(103);
  int num_changed = 0;
  for (int i = 0; i < 200; ++i) {
    const Motion motion = random_motion(random, {.free_joints = true});
    const ExpectUnchanged unchanged(motion);
    const Motion changed = shape::without_unread_columns(motion);
    for (const std::size_t readers : num_readers_of_columns(changed.skeleton))
      EXPECT_GT(readers, 0u);
    num_changed += changed.clip.num_coordinates < motion.clip.num_coordinates ? 1 : 0;
    const WorldDifference difference = world_difference(motion, changed);
    EXPECT_EQ(difference.position, 0);
    EXPECT_EQ(difference.tip, 0);
    EXPECT_TRUE(validate(changed.skeleton));
  }
  EXPECT_GT(num_changed, 20);
}

TEST(ShapeProperties, WithoutInnerTipsNothingElseChanges) {
  RandomSource random(104);
  for (int i = 0; i < 200; ++i) {
    const Motion motion = random_motion(random, {.free_joints = true});
    const ExpectUnchanged unchanged(motion);
    Motion changed = shape::without_inner_tips(motion);
    const auto children = children_of_joints(motion.skeleton);
    for (std::size_t j = 0; j < children.size(); ++j) {
      for (const Tip& tip : changed.skeleton.joints[j].tips) {
        for (const std::size_t child : children[j]) {
          EXPECT_NE(tip.offset, motion.skeleton.joints[child].offset);
        }
      }
      changed.skeleton.joints[j].tips = motion.skeleton.joints[j].tips;
    }
    EXPECT_TRUE(same_skeleton(changed.skeleton, motion.skeleton));
    EXPECT_TRUE(same_bits(std::as_const(changed.clip.values), motion.clip.values));
  }
}

TEST(ShapeProperties, BonesKeepTheWorld) {
  RandomSource random(105);
  int num_accepted = 0;
  for (int i = 0; i < 400; ++i) {
    const Motion motion = i % 4 == 0 ? random_bones(random)
                                     : random_motion(random, {.tail_scales = i % 3 == 0,
                                                              .several_roots = i % 5 == 0,
                                                              .without_frames = i % 10 == 0});
    const ExpectUnchanged unchanged(motion);
    Diagnostics diagnostics;
    const auto bones = shape::with_bones(motion, false, diagnostics);
    if (!bones) {
      EXPECT_EQ(bones.error().code, "BRG003");
      continue;
    }
    ++num_accepted;
    EXPECT_TRUE(validate(bones->skeleton));
    const WorldDifference difference = world_difference(motion, *bones, false);
    // Without frames, the rest pose counts, and that of values that rest elsewhere is told.
    if (motion.clip.num_frames > 0 || count_code(diagnostics, "BRG005") == 0) {
      EXPECT_LT(difference.position, kSamePlace) << "skeleton " << i;
      EXPECT_LT(difference.shape, kSamePlace) << "skeleton " << i;
    }
    EXPECT_EQ(difference.num_shapes, num_shapes(motion.skeleton)) << "skeleton " << i;
    EXPECT_GE(difference.num_joints + 1, motion.skeleton.joints.size());
    for (std::size_t j = 0; j < bones->skeleton.joints.size(); ++j) {
      const Joint& joint = bones->skeleton.joints[j];
      EXPECT_EQ(joint.tips.size(), j == 0 ? 0u : 1u);
      for (const DegreeOfFreedom& dof : joint.dofs) EXPECT_EQ(dof.rest, 0);
      if (j > 0) {
        EXPECT_EQ(joint.rest_rotation.coeffs(), Quat::Identity().coeffs());
      }
    }
    Diagnostics none;
    const auto again = shape::with_bones(*bones, false, none);
    ASSERT_TRUE(again);
    EXPECT_TRUE(none.items().empty());
    EXPECT_TRUE(same_skeleton(again->skeleton, bones->skeleton));
    EXPECT_TRUE(same_bits(again->clip.values, bones->clip.values));
    bool has_unread = false;
    std::vector<std::size_t> readers = num_readers_of_columns(motion.skeleton);
    for (const FollowingColumn& following : following_columns(motion.skeleton)) {
      ++readers[following.column];  // what it holds is said by the joint
    }
    for (const std::size_t count : readers) has_unread |= count == 0;
    EXPECT_TRUE(!has_unread || count_code(diagnostics, "BRG005") > 0) << "what is lost is told";
  }
  EXPECT_GT(num_accepted, 260);
}

bool has_helpers(const Skeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [](const Joint& joint) { return joint.name.ends_with("_kf_helper"); });
}

TEST(ShapeProperties, WithoutHelperBonesTheJointsAreThoseOfBefore) {
  RandomSource random(110);
  int num_with_helpers = 0;
  for (int i = 0; i < 300; ++i) {
    Motion motion = random_motion(
        random, {.tail_scales = false, .several_roots = false, .without_frames = i % 10 == 0});
    for (Joint& joint : motion.skeleton.joints) {  // a tip at its joint is where bones may start
      std::erase_if(joint.tips, [](const Tip& tip) { return tip.offset.isZero(0); });
    }
    Diagnostics ignored;
    const auto bones = shape::with_bones(motion, false, ignored);
    ASSERT_TRUE(bones);
    const ExpectUnchanged unchanged(*bones);
    Diagnostics diagnostics;
    const Motion back = shape::without_helper_bones(*bones, diagnostics);
    num_with_helpers += has_helpers(bones->skeleton) ? 1 : 0;
    EXPECT_EQ(count_code(diagnostics, "BRG005") > 0, has_helpers(bones->skeleton));
    EXPECT_FALSE(has_helpers(back.skeleton));
    EXPECT_TRUE(same_bits(back.clip.values, bones->clip.values));
    // A root that moves its tail is a bone of its own there.
    const std::size_t num_more = has_tail_translation(motion.skeleton.joints[0]) ? 1 : 0;
    ASSERT_EQ(back.skeleton.joints.size(), motion.skeleton.joints.size() + num_more) << i;
    for (std::size_t j = num_more; j < motion.skeleton.joints.size(); ++j) {
      const Joint& joint = back.skeleton.joints[j + num_more];
      EXPECT_EQ(joint.name, motion.skeleton.joints[j].name);
      if (j > 0) {
        EXPECT_EQ(joint.parent, motion.skeleton.joints[j].parent + num_more);
      }
    }
    const WorldDifference of_bones = world_difference(*bones, back, false);
    EXPECT_LT(of_bones.position, kSamePlace) << i;
    EXPECT_LT(of_bones.shape, kSamePlace) << i;
    EXPECT_EQ(of_bones.num_shapes, num_shapes(motion.skeleton)) << i;
    EXPECT_LT(of_bones.rotation, kSameTurn) << i;
    if (motion.clip.num_frames == 0) continue;  // bones rest elsewhere
    const Motion bare = shape::without_inner_tips(motion);
    const WorldDifference difference = world_difference(bare, shape::without_inner_tips(back));
    EXPECT_LT(difference.position, kSamePlace) << i;
    if (num_more == 0) {
      EXPECT_LT(difference.tip, kSamePlace) << i;
    }
    EXPECT_GE(difference.num_joints, motion.skeleton.joints.size());
    Diagnostics none;
    EXPECT_TRUE(same_skeleton(shape::without_helper_bones(back, none).skeleton, back.skeleton));
    EXPECT_TRUE(none.items().empty());
  }
  EXPECT_GT(num_with_helpers, 250);
}

TEST(ShapeProperties, BonesWithoutHelpersStayAsTheyAre) {
  RandomSource random(111);
  for (int i = 0; i < 100; ++i) {
    const Motion motion = random_bones(random);
    Diagnostics diagnostics;
    const Motion same = shape::without_helper_bones(motion, diagnostics);
    EXPECT_TRUE(same_skeleton(same.skeleton, motion.skeleton));
    EXPECT_TRUE(same_bits(same.clip.values, motion.clip.values));
    EXPECT_TRUE(diagnostics.items().empty());
  }
}

bool has_plain_columns(const Motion& motion) {
  const auto readers = num_readers_of_columns(motion.skeleton);
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
    for (const DegreeOfFreedom& dof : motion.skeleton.joints[j].dofs) {
      const bool is_own = motion.skeleton.coordinates[dof.coordinate].joint == j;
      if (readers[dof.coordinate] != 1 || !is_own || !coordinate_axis(dof.axis)) return false;
      if (!is_plain(dof) || num_coordinates(dof) > 1) return false;
    }
  }
  return true;
}

TEST(ShapeProperties, OtherChannelsKeepTheWorldAndTheRestPose) {
  RandomSource random(106);
  int num_root_accepted = 0;
  int num_plain = 0;
  for (int i = 0; i < 1040; ++i) {
    const Motion motion = random_motion(random, {.oblique_axes = i % 4 != 0,
                                                 .shared_columns = i % 4 != 0,
                                                 .without_frames = i % 13 == 0,
                                                 .whole_rotations = i % 4 != 0,
                                                 .gains = i % 4 != 0});
    const ExpectUnchanged unchanged(motion);
    shape::ChannelOptions options;
    constexpr shape::PositionChannels kWays[] = {
        shape::PositionChannels::AsIs, shape::PositionChannels::All, shape::PositionChannels::Root};
    options.positions = kWays[i % 3];
    if (random_chance(random, 0.6)) {
      const std::size_t a = random_below(random, 3);
      const std::size_t b = (a + 1 + random_below(random, 2)) % 3;
      options.order = shape::RotationOrder{a, b, (b + 1 + random_below(random, 2)) % 3};
    }
    options.adds_positions = random_chance(random, 0.3);
    options.replaces_offsets = random_chance(random, 0.3);
    options.distinct_axes = random_chance(random, 0.2);
    Diagnostics diagnostics;
    const auto changed = shape::with_channels(motion, options, diagnostics);
    if (options.positions != shape::PositionChannels::Root) {
      ASSERT_TRUE(changed);
      const WorldDifference at_rest = world_difference(motion, *changed, true);
      EXPECT_LT(at_rest.position, kSamePlace) << i;
      EXPECT_LT(at_rest.rotation, kSameTurn) << i;
    } else if (!changed) {
      EXPECT_EQ(changed.error().code, "EDT001");
      options.lenient = true;
      EXPECT_TRUE(shape::with_channels(motion, options, diagnostics));
      EXPECT_GT(count_code(diagnostics, "EDT001"), 0u);
      continue;
    } else {
      ++num_root_accepted;
    }
    expect_same_world(motion, *changed, i);
    if (options.positions == shape::PositionChannels::AsIs && !options.order &&
        !options.distinct_axes && !options.replaces_offsets && has_plain_columns(motion)) {
      ++num_plain;
      for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
        const auto& old_dofs = motion.skeleton.joints[j].dofs;
        const auto& new_dofs = changed->skeleton.joints[j].dofs;
        ASSERT_EQ(old_dofs.size(), new_dofs.size());
        for (std::size_t d = 0; d < old_dofs.size(); ++d) {
          for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
            EXPECT_EQ(motion.clip.row(f)[old_dofs[d].coordinate],
                      changed->clip.row(f)[new_dofs[d].coordinate]);
          }
        }
      }
    }
  }
  EXPECT_GT(num_root_accepted, 50);
  EXPECT_GT(num_plain, 10);
}

TEST(ShapeProperties, PlainValuesAndAnglesKeepTheWorldAndTheRestPose) {
  RandomSource random(110);
  int num_changed = 0;
  for (int i = 0; i < 300; ++i) {
    const Motion motion =
        i % 5 == 0 ? random_robot(random) : random_motion(random, {.free_joints = i % 2 == 0});
    const ExpectUnchanged unchanged(motion);
    const Motion plain = shape::with_plain_values(motion);
    const Motion angles = shape::with_angles(plain, {1, 0, 2});
    for (const Joint& joint : angles.skeleton.joints) {
      for (const DegreeOfFreedom& dof : joint.dofs) {
        EXPECT_TRUE(is_plain(dof));
        EXPECT_TRUE(dof.kind == DofKind::Free || num_coordinates(dof) == 1);
      }
    }
    EXPECT_TRUE(following_columns(plain.skeleton).empty());
    for (const Motion* changed : {&plain, &angles}) {
      expect_same_world(motion, *changed, i);
      const WorldDifference at_rest = world_difference(motion, *changed, true);
      EXPECT_LT(at_rest.position, kSamePlace) << i;
      EXPECT_LT(at_rest.rotation, kSameTurn) << i;
    }
    num_changed += same_skeleton(motion.skeleton, angles.skeleton) ? 0 : 1;
  }
  EXPECT_GT(num_changed, 100);
}

TEST(ShapeProperties, OntoItselfAndOntoTurnedTwinsEveryBitStays) {
  RandomSource random(107);
  for (int i = 0; i < 300; ++i) {
    const Motion motion =
        i % 3 == 0 ? random_bones(random) : random_motion(random, {.unread_columns = false});
    const Motion twin = with_turned_frames(motion, random);
    EXPECT_LT(world_difference(motion, twin).position, kSamePlace);
    const ExpectUnchanged unchanged(motion);
    for (const Skeleton& skeleton : {motion.skeleton, twin.skeleton}) {
      Diagnostics diagnostics;
      const auto onto = shape::onto_skeleton(motion, skeleton, diagnostics);
      ASSERT_TRUE(onto);
      EXPECT_TRUE(diagnostics.items().empty()) << text_of(diagnostics);
      EXPECT_TRUE(same_skeleton(onto->skeleton, skeleton));
      EXPECT_TRUE(same_bits(onto->clip.values, motion.clip.values)) << "skeleton " << i;
      expect_same_world(motion, *onto, i, false);
    }
  }
}

/// Whether every joint turns about one axis or three that every rotation can be made of.
bool can_be_fitted(const Skeleton& skeleton) {
  return std::all_of(skeleton.joints.begin(), skeleton.joints.end(), [](const Joint& joint) {
    const auto rotations = rotations_of(joint);
    return rotations.size() <= 1 || euler_axes_of(rotations);
  });
}

TEST(ShapeProperties, WhatWasGivenOtherChannelsComesBackOntoItsSkeleton) {
  RandomSource random(108);
  int num_tried = 0;
  for (int i = 0; i < 500; ++i) {
    const Motion motion =
        i % 4 == 0
            ? random_bones(random)
            : random_motion(random, {.shared_columns = false, .whole_rotations = i % 2 == 1});
    if (!can_be_fitted(motion.skeleton)) continue;
    ++num_tried;
    Diagnostics diagnostics;
    const auto aligned = i % 2 == 0 ? shape::with_world_aligned_rest(motion)
                                    : Result<Motion>(with_turned_frames(motion, random));
    ASSERT_TRUE(aligned);
    shape::ChannelOptions options;
    options.order = shape::RotationOrder{2, 0, 1};
    options.positions = shape::PositionChannels::All;
    options.replaces_offsets = random_chance(random, 0.5);
    const auto channels = shape::with_channels(*aligned, options, diagnostics);
    ASSERT_TRUE(channels);
    const auto back = shape::onto_skeleton(*channels, motion.skeleton, diagnostics);
    ASSERT_TRUE(back);
    EXPECT_TRUE(diagnostics.items().empty()) << text_of(diagnostics);
    expect_same_world(motion, *back, i);
  }
  EXPECT_GT(num_tried, 110);
}

TEST(ShapeProperties, WhatASkeletonCannotDoIsTold) {
  RandomSource random(109);
  int num_told = 0;
  for (int i = 0; i < 200; ++i) {
    const Motion motion = random_motion(random, {});
    Skeleton stiff = motion.skeleton;
    const std::size_t joint = random_below(random, stiff.joints.size());
    const bool moves = std::any_of(stiff.joints[joint].dofs.begin(), stiff.joints[joint].dofs.end(),
                                   [&motion](const DegreeOfFreedom& dof) {
                                     return !is_always(motion.clip, dof.coordinate, dof.rest);
                                   });
    stiff.joints[joint].dofs.clear();
    Diagnostics diagnostics;
    const auto onto = shape::onto_skeleton(motion, stiff, diagnostics);
    ASSERT_TRUE(onto);
    EXPECT_EQ(count_code(diagnostics, "BRG006") > 0, moves) << "skeleton " << i;
    num_told += moves ? 1 : 0;
  }
  EXPECT_GT(num_told, 100);
}

}  // namespace
}  // namespace kinefile::test
