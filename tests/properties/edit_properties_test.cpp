// SPDX-License-Identifier: MIT
// What holds for any motion when it is edited or retimed, tried on random ones with fixed seeds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinefile/edit.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/retime.hpp"
#include "kinefile/shape.hpp"
#include "support/random_skeletons.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

constexpr double kSameEditedPlace = 1e-9;
constexpr double kSameEditedTurn = 1e-7;

void expect_world(const Motion& a, const Motion& b, int seed) {
  const WorldDifference difference = world_difference(a, b);
  EXPECT_LT(difference.position, kSameEditedPlace) << "skeleton " << seed;
  EXPECT_LT(difference.tip, kSameEditedPlace) << "skeleton " << seed;
  EXPECT_LT(difference.shape, kSameEditedPlace) << "skeleton " << seed;
  EXPECT_LT(difference.rotation, kSameEditedTurn) << "skeleton " << seed;
  EXPECT_TRUE(validate(b.skeleton)) << "skeleton " << seed;
}

/// A motion of the kinds that operations take, by turns.
Motion any_motion(RandomSource& random, int i) {
  if (i % 5 == 0) return random_bones(random);
  if (i % 5 == 1) return random_robot(random);
  return random_motion(random, {.free_joints = i % 2 == 0});
}

/// Where joints are in the world, frame by frame; shape (frames, joints).
std::vector<Vec3> places_of(const Motion& motion) {
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < poses.positions.size(); i += 3) {
    places.emplace_back(poses.positions.data() + i);
  }
  return places;
}

/// The largest distance of places from others that are moved by a function.
template <class Move>
double largest_distance(const std::vector<Vec3>& from, const std::vector<Vec3>& to, Move move) {
  EXPECT_EQ(from.size(), to.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) {
    largest = std::max(largest, (move(from[i]) - to[i]).norm());
  }
  return largest;
}

TEST(EditProperties, CutsAndJoinsKeepEveryBit) {
  RandomSource random(301);
  for (int i = 0; i < 200; ++i) {
    const Motion motion = any_motion(random, i);
    const ExpectUnchanged unchanged(motion);
    const std::size_t cut = random_below(random, motion.clip.num_frames + 1);
    const auto begin = edit::trim(motion, 0, cut);
    const auto end = edit::trim(motion, cut, motion.clip.num_frames);
    ASSERT_TRUE(begin && end);
    const auto joined = edit::append(*begin, *end, 0, test::ignored());
    ASSERT_TRUE(joined);
    EXPECT_TRUE(same_bits(joined->clip.values, motion.clip.values));
    EXPECT_TRUE(same_skeleton(joined->skeleton, motion.skeleton));
    const Motion back = edit::reverse(edit::reverse(motion));
    EXPECT_TRUE(same_bits(back.clip.values, motion.clip.values));
    const auto twice = edit::loop(motion, 2, 0, test::ignored());
    ASSERT_TRUE(twice);
    const auto second = edit::trim(*twice, motion.clip.num_frames, 2 * motion.clip.num_frames);
    ASSERT_TRUE(second);
    EXPECT_TRUE(same_bits(second->clip.values, motion.clip.values));
    EXPECT_TRUE(same_skeleton(second->skeleton, motion.skeleton));
  }
}

TEST(EditProperties, ReverseShowsTheFramesBackwards) {
  RandomSource random(302);
  for (int i = 0; i < 100; ++i) {
    const Motion motion = any_motion(random, i);
    const ExpectUnchanged unchanged(motion);
    const Motion reversed = edit::reverse(motion);
    for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
      EXPECT_TRUE(same_bits(reversed.clip.row(f), motion.clip.row(motion.clip.num_frames - 1 - f)));
    }
  }
}

/// The joint that carries each joint over the ground (see `find_travellers`); kNoParent above them.
std::vector<std::size_t> carriers_of(const Motion& motion) {
  const auto travellers = find_travellers(motion);
  std::vector<std::size_t> carriers;
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
    const std::size_t parent = motion.skeleton.joints[j].parent;
    const bool travels = std::find(travellers.begin(), travellers.end(), j) != travellers.end();
    carriers.push_back(travels ? j : parent == kNoParent ? kNoParent : carriers[parent]);
  }
  return carriers;
}

TEST(EditProperties, BlendedJoinsKeepTheFramesOutsideAndHowTheFigureMoves) {
  RandomSource random(303);
  int num_moved = 0;
  for (int i = 0; i < 200; ++i) {
    const Motion motion =
        i % 3 == 0 ? random_bones(random)
                   : random_motion(random, {.shared_columns = false, .several_roots = false});
    const ExpectUnchanged unchanged(motion);
    const std::size_t count = motion.clip.num_frames;
    const std::size_t blended = 1 + random_below(random, count / 2);
    const auto looped = edit::loop(motion, 2, blended, test::ignored());
    ASSERT_TRUE(looped);
    ASSERT_EQ(looped->clip.num_frames, 2 * count - blended);
    for (std::size_t f = 0; f + blended < count; ++f) {
      EXPECT_TRUE(same_bits(looped->clip.row(f), motion.clip.row(f)));
    }
    // Behind the overlap, joints are as far from each other as they were.
    const auto rest = edit::trim(*looped, count, 2 * count - blended);
    const auto same = edit::trim(motion, blended, count);
    ASSERT_TRUE(rest && same);
    const auto old_places = places_of(*same);
    const auto new_places = places_of(*rest);
    const std::size_t num_joints = motion.skeleton.joints.size();
    const double size = world_size(*looped);
    const auto carriers = carriers_of(motion);
    ASSERT_EQ(old_places.size(), new_places.size());
    for (std::size_t k = 0; k < old_places.size(); ++k) {
      const std::size_t root = k - k % num_joints + carriers[k % num_joints];
      if (carriers[k % num_joints] == kNoParent) continue;
      const double old_distance = (old_places[k] - old_places[root]).norm();
      EXPECT_NEAR((new_places[k] - new_places[root]).norm(), old_distance, 1e-9 * size) << i;
    }
    num_moved += world_difference(*same, *rest).position > 1e-3 ? 1 : 0;
  }
  EXPECT_GT(num_moved, 50);
}

TEST(EditProperties, ScaleScalesTheWorld) {
  RandomSource random(304);
  for (int i = 0; i < 200; ++i) {
    const Motion motion = any_motion(random, i);
    const ExpectUnchanged unchanged(motion);
    const double factor = i % 2 == 0 ? 4 : 0.3;
    const Motion scaled = edit::scale(motion, factor);
    const double largest = largest_distance(places_of(motion), places_of(scaled),
                                            [factor](const Vec3& v) { return Vec3(factor * v); });
    EXPECT_LT(largest, kSameEditedPlace * world_size(scaled)) << i;
    const double largest_of_shapes =
        largest_distance(places_of_shapes(motion), places_of_shapes(scaled),
                         [factor](const Vec3& v) { return Vec3(factor * v); });
    EXPECT_LT(largest_of_shapes, kSameEditedPlace * world_size(scaled)) << i;
    EXPECT_TRUE(validate(scaled.skeleton));
    if (factor != 4) continue;
    const Motion back = edit::scale(scaled, 0.25);
    EXPECT_TRUE(same_bits(back.clip.values, motion.clip.values));
    EXPECT_TRUE(same_skeleton(back.skeleton, motion.skeleton));
  }
}

TEST(EditProperties, AnotherAxisUpTurnsTheWorldByAQuarterAndBackToTheSameBits) {
  RandomSource random(305);
  int num_turned = 0;
  for (int i = 0; i < 200; ++i) {
    const Motion motion = any_motion(random, i);
    const ExpectUnchanged unchanged(motion);
    const std::size_t old_axis = find_up_axis(motion).axis;
    Diagnostics diagnostics;
    const Motion turned = edit::up(motion, 3 - old_axis, diagnostics);
    EXPECT_EQ(diagnostics.count_of("MOT005", Severity::Note), diagnostics.items().size());
    EXPECT_TRUE(validate(turned.skeleton));
    const double sign = old_axis == 1 ? 1 : -1;
    const auto turn = [sign](const Vec3& v) { return Vec3(v[0], -sign * v[2], sign * v[1]); };
    const double largest = largest_distance(places_of(motion), places_of(turned), turn);
    EXPECT_LT(largest, kSameEditedPlace * world_size(motion)) << i;
    const double largest_of_shapes =
        largest_distance(places_of_shapes(motion), places_of_shapes(turned), turn);
    EXPECT_LT(largest_of_shapes, kSameEditedPlace * world_size(motion)) << i;
    ++num_turned;
    const Motion back = edit::up(turned, old_axis, diagnostics);
    EXPECT_TRUE(same_skeleton(back.skeleton, motion.skeleton)) << i;
    EXPECT_TRUE(same_bits(back.clip.values, motion.clip.values)) << i;
  }
  EXPECT_EQ(num_turned, 200);
}

TEST(EditProperties, InPlaceHoldsRootsOverTheGroundAndLeavesTheFigureAlone) {
  RandomSource random(306);
  int num_held = 0;
  for (int i = 0; i < 200; ++i) {
    const Motion motion =
        i % 3 == 0 ? random_bones(random)
                   : random_motion(random, {.free_joints = i % 2 == 0, .shared_columns = false});
    const ExpectUnchanged unchanged(motion);
    const Motion held = edit::in_place(motion, test::ignored());
    EXPECT_TRUE(same_skeleton(held.skeleton, motion.skeleton));
    const auto up = static_cast<Eigen::Index>(find_up_axis(motion).axis);
    const auto old_places = places_of(motion);
    const auto new_places = places_of(held);
    const std::size_t num_joints = motion.skeleton.joints.size();
    const double tolerance = kSameEditedPlace * world_size(motion);
    const auto carriers = carriers_of(motion);
    for (std::size_t j = 0; j < num_joints; ++j) {
      const Joint& joint = motion.skeleton.joints[j];
      std::size_t num_translations = moves_freely(joint) ? 3 : 0;
      for (const DegreeOfFreedom& dof : joint.dofs) {
        num_translations += dof.kind == DofKind::Translation ? 1 : 0;
      }
      const std::size_t root = carriers[j];
      if (root == kNoParent) continue;
      const bool is_root = root == j;
      num_held += is_root && num_translations == 3 ? 1 : 0;
      for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
        const std::size_t at = f * num_joints;
        const Vec3 old_way = old_places[at + j] - old_places[at + root];
        EXPECT_LT((new_places[at + j] - new_places[at + root] - old_way).norm(), tolerance) << i;
        if (!is_root || num_translations != 3) continue;
        Vec3 wanted = old_places[j];  // of frame 0
        wanted[up] = old_places[at + j][up];
        EXPECT_LT((new_places[at + j] - wanted).norm(), tolerance) << i;
      }
    }
  }
  EXPECT_GT(num_held, 100);
}

TEST(EditProperties, JointsThatStayKeepTheirPlacesAndTheirBits) {
  RandomSource random(307);
  int num_dropped = 0;
  for (int i = 0; i < 200; ++i) {
    const Motion motion = any_motion(random, i);
    const ExpectUnchanged unchanged(motion);
    const std::size_t kept = random_below(random, motion.skeleton.joints.size());
    const std::string names[] = {motion.skeleton.joints[kept].name};
    Diagnostics diagnostics;
    const auto part = edit::joints(motion, names, diagnostics);
    ASSERT_TRUE(part);
    EXPECT_TRUE(validate(part->skeleton));
    num_dropped += part->skeleton.joints.size() < motion.skeleton.joints.size() ? 1 : 0;
    const WorldDifference difference = world_difference(motion, *part);
    EXPECT_EQ(difference.num_joints, part->skeleton.joints.size());
    EXPECT_LT(difference.position, kSameEditedPlace);
    EXPECT_LT(difference.tip, kSameEditedPlace);
    EXPECT_LT(difference.shape, kSameEditedPlace);
    EXPECT_EQ(difference.num_shapes, num_shapes(part->skeleton));
    // Every column that is left is one of the old ones.
    for (std::size_t c = 0; c < part->clip.num_coordinates; ++c) {
      bool is_there = false;
      for (std::size_t old = 0; old < motion.clip.num_coordinates && !is_there; ++old) {
        is_there = true;
        for (std::size_t f = 0; f < motion.clip.num_frames && is_there; ++f) {
          is_there = motion.clip.row(f)[old] == part->clip.row(f)[c];
        }
      }
      EXPECT_TRUE(is_there);
    }
    const std::string every[] = {"*"};
    const auto all = edit::joints(motion, every, diagnostics);
    ASSERT_TRUE(all);
    EXPECT_TRUE(same_bits(all->clip.values, motion.clip.values));
  }
  EXPECT_GT(num_dropped, 100);
}

TEST(EditProperties, RenameChangesANameAndNoMore) {
  RandomSource random(308);
  for (int i = 0; i < 100; ++i) {
    Document document;
    document.content = any_motion(random, i);
    const Motion before = std::get<Motion>(document.content);
    const std::size_t joint = random_below(random, before.skeleton.joints.size());
    const std::string name = before.skeleton.joints[joint].name;
    ASSERT_TRUE(edit::rename(document, name, "other"));
    Motion& after = std::get<Motion>(document.content);
    EXPECT_EQ(after.skeleton.joints[joint].name, "other");
    after.skeleton.joints[joint].name = name;
    EXPECT_TRUE(same_skeleton(after.skeleton, before.skeleton));
    EXPECT_TRUE(same_bits(std::as_const(after).clip.values, before.clip.values));
  }
}

TEST(EditProperties, UnwrapKeepsTheWorldAndSmoothWhatIsStill) {
  RandomSource random(309);
  for (int i = 0; i < 200; ++i) {
    Motion motion = any_motion(random, i);
    const ExpectUnchanged unchanged(motion);
    expect_world(motion, edit::unwrap(motion), i);
    const auto first = edit::trim(motion, 0, 1);
    ASSERT_TRUE(first);
    const auto still = edit::loop(*first, 12, 0, test::ignored());
    ASSERT_TRUE(still);
    const auto smooth = edit::smooth(*still, 6);
    ASSERT_TRUE(smooth);
    EXPECT_TRUE(same_bits(smooth->clip.values, still->clip.values));
    EXPECT_TRUE(same_skeleton(smooth->skeleton, motion.skeleton));
  }
}

TEST(EditProperties, UnwrapTakesJumpsOut) {
  RandomSource random(310);
  for (int i = 0; i < 100; ++i) {
    const Motion motion = any_motion(random, i);
    Motion jumping = motion;
    const double turn =
        motion.skeleton.angle_unit == AngleUnit::Degrees ? 360 : 2 * std::numbers::pi;
    const Rows rows = jumping.clip.mutate();
    std::vector<bool> jumps(motion.clip.num_coordinates, true);  // by whole turns of all readers
    for (const Joint& joint : motion.skeleton.joints) {
      for (const DegreeOfFreedom& dof : joint.dofs) {
        if (dof.gain != std::round(dof.gain)) jumps[dof.coordinate] = false;
      }
    }
    for (const Joint& joint : motion.skeleton.joints) {
      for (const DegreeOfFreedom& dof : joint.dofs) {
        if (dof.kind != DofKind::Rotation || !jumps[dof.coordinate]) continue;
        for (std::size_t f = 1; f < motion.clip.num_frames; f += 3) rows[f][dof.coordinate] += turn;
      }
    }
    expect_world(motion, edit::unwrap(jumping), i);
  }
}

TEST(EditProperties, RetimingKeepsWholeFramesBitForBit) {
  RandomSource random(311);
  for (int i = 0; i < 200; ++i) {
    const Motion motion = any_motion(random, i);
    const ExpectUnchanged unchanged(motion);
    const std::size_t count = motion.clip.num_frames;
    retime::TimeMap map;
    for (std::size_t f = 0; f < count; ++f) map.old_frames.push_back(static_cast<double>(f));
    Diagnostics diagnostics;
    const auto same = retime::apply(motion, map, {}, diagnostics);
    ASSERT_TRUE(same);
    EXPECT_TRUE(same_bits(same->clip.values, motion.clip.values));
    EXPECT_TRUE(same_skeleton(same->skeleton, motion.skeleton));
    const auto finer = retime::resample_map(motion.clip, 120);  // of 60
    ASSERT_TRUE(finer);
    const auto resampled = retime::apply(motion, *finer, {}, diagnostics);
    ASSERT_TRUE(resampled);
    ASSERT_EQ(resampled->clip.num_frames, 2 * count - 1);
    for (std::size_t f = 0; f < count; ++f) {
      EXPECT_TRUE(same_bits(resampled->clip.row(2 * f), motion.clip.row(f)));
    }
  }
}

TEST(EditProperties, OperationsDoTheSameWhateverTheRestFrames) {
  RandomSource random(312);
  for (int i = 0; i < 100; ++i) {
    const Motion motion =
        i % 3 == 0 ? random_bones(random) : random_motion(random, {.shared_columns = false});
    Motion twin = with_turned_frames(motion, random);
    const ExpectUnchanged unchanged(motion);
    const auto expect_alike = [&](const auto& operation, std::string_view name) {
      const WorldDifference difference = world_difference(operation(motion), operation(twin));
      EXPECT_LT(difference.position, 1e-8) << name << " of skeleton " << i;
      EXPECT_LT(difference.shape, 1e-8) << name << " of skeleton " << i;
    };
    expect_alike([](const Motion& m) { return edit::in_place(m, test::ignored()); }, "in_place");
    expect_alike([](const Motion& m) { return edit::unwrap(m); }, "unwrap");
    expect_alike([](const Motion& m) { return edit::scale(m, 3); }, "scale");
    expect_alike([](const Motion& m) { return edit::smooth(m, 8).value(); }, "smooth");
    expect_alike([](const Motion& m) { return edit::loop(m, 2, 4, test::ignored()).value(); },
                 "loop");
    Diagnostics diagnostics;
    expect_alike([&](const Motion& m) { return edit::up(m, 2, diagnostics); }, "up");
    expect_alike(
        [&](const Motion& m) {
          const auto map = retime::resample_map(m.clip, 97).value();
          return retime::apply(m, map, {}, diagnostics).value();
        },
        "resample");
  }
}

TEST(EditProperties, TheMirrorImageIsTheMotionInTheMirrorAndTwiceTheMotion) {
  RandomSource random(313);
  for (int i = 0; i < 100; ++i) {
    const Motion motion = random_symmetric_motion(random, i % 2 == 0);
    const ExpectUnchanged unchanged(motion);
    Diagnostics diagnostics;
    const auto image = edit::mirror(motion, 0, false, diagnostics);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_TRUE(diagnostics.items().empty());
    EXPECT_TRUE(same_skeleton(image->skeleton, motion.skeleton));
    const auto twice = edit::mirror(*image, 0, false, diagnostics);
    ASSERT_TRUE(twice);
    expect_world(motion, *twice, i);
    const auto of_twin = edit::mirror(with_turned_frames(motion, random), 0, false, diagnostics);
    ASSERT_TRUE(of_twin);
    EXPECT_LT(world_difference(*image, *of_twin).position, kSameEditedPlace);
    // A joint is where its other half was, on the other side.
    Motion named = *image;
    for (Joint& joint : named.skeleton.joints) {
      if (joint.name.starts_with("Left")) {
        joint.name.replace(0, 4, "Right");
      } else if (joint.name.starts_with("Right")) {
        joint.name.replace(0, 5, "Left");
      }
    }
    const auto places = places_of(motion);
    const auto image_places = places_of(*image);
    const std::size_t num_joints = motion.skeleton.joints.size();
    for (std::size_t j = 0; j < num_joints; ++j) {
      const auto half = std::find_if(
          motion.skeleton.joints.begin(), motion.skeleton.joints.end(),
          [&](const Joint& joint) { return joint.name == named.skeleton.joints[j].name; });
      ASSERT_NE(half, motion.skeleton.joints.end());
      const auto k = static_cast<std::size_t>(half - motion.skeleton.joints.begin());
      for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
        const Vec3 wanted = Vec3(-1, 1, 1).cwiseProduct(places[f * num_joints + j]);
        EXPECT_LT((image_places[f * num_joints + k] - wanted).norm(),
                  kSameEditedPlace * world_size(motion))
            << motion.skeleton.joints[j].name << " of skeleton " << i;
      }
    }
  }
}

}  // namespace
}  // namespace kinefile::test
