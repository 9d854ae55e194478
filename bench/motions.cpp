// SPDX-License-Identifier: MIT
#include "motions.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "baselines.hpp"
#include "kinefile/retime.hpp"
#include "report.hpp"
#include "subject.hpp"
#include "walk.hpp"

namespace kinefile::bench {
namespace {

void fk_kinefile(benchmark::State& state) {
  const Motion& motion = subject().motion;
  for (auto _ : state) {
    benchmark::DoNotOptimize(forward_kinematics(motion.skeleton, motion.clip));
  }
}

/// Places all joints in memory that is there, as a caller does who goes on with it.
template <class T, bool kWithRotations>
void place_kinefile(benchmark::State& state) {
  const Motion& motion = subject().motion;
  const Kinematics kinematics(motion.skeleton);
  const std::size_t num_poses = motion.clip.num_frames * kinematics.num_joints();
  std::vector<T> positions(num_poses * 3);
  std::vector<T> rotations(kWithRotations ? num_poses * 4 : 0);
  const ValueRows rows{motion.clip.values, motion.clip.num_frames, motion.clip.num_coordinates};
  for (auto _ : state) {
    kinematics.place(rows, BasicPoseSpans<T>{.positions = positions, .rotations = rotations});
    benchmark::ClobberMemory();
  }
}

template <class T, bool kWithRotations>
void place_eigen(benchmark::State& state) {
  Placed<T> placed;
  place_with_eigen(subject().motion, kWithRotations, placed);
  for (auto _ : state) {
    place_with_eigen(subject().motion, kWithRotations, placed);
    benchmark::ClobberMemory();
  }
}

void fk_eigen(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(positions_with_eigen(subject().motion));
}

/// As a share of the largest number.
double largest_difference(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  double difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i]));
    difference = std::max(difference, std::abs(a[i] - b[i]));
  }
  return difference / largest;
}

/// A walk of some thousand frames and a map that shows 15 of its frames in 16, as when frame 150
/// is moved to frame 160.
struct WarpSubject {
  Motion motion = examples::make_walk({.num_frames = 7501});
  retime::TimeMap map;
};

const WarpSubject& warp_subject() {
  static const WarpSubject instance = [] {
    WarpSubject made;
    for (int n = 0; n <= 8000; ++n) made.map.old_frames.push_back(n * 150 / 160.0);
    return made;
  }();
  return instance;
}

Motion warped_with_kinefile(retime::RotationInterpolation rotation) {
  Diagnostics diagnostics;
  auto warped =
      retime::apply(warp_subject().motion, warp_subject().map, {.rotation = rotation}, diagnostics);
  return std::move(warped.value());
}

template <retime::RotationInterpolation kRotation>
void warp_kinefile(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(warped_with_kinefile(kRotation));
}

void warp_eigen(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(warped_with_eigen(warp_subject().motion, warp_subject().map));
  }
}

/// The largest distance of joints in the motions that the two ways to warp give, relative.
double warp_disagreement() {
  const Motion ours = warped_with_kinefile(retime::RotationInterpolation::Slerp);
  Motion theirs = ours;
  theirs.clip.values = warped_with_eigen(warp_subject().motion, warp_subject().map);
  const WorldPoses a = forward_kinematics(ours.skeleton, ours.clip);
  const WorldPoses b = forward_kinematics(theirs.skeleton, theirs.clip);
  return largest_difference(a.positions, b.positions);
}

/// The largest distance of the two ways to place joints, as a share of the largest coordinate.
double disagreement() {
  const Motion& motion = subject().motion;
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip);
  return largest_difference(positions_with_eigen(motion), poses.positions);
}

}  // namespace

void add_motions() {
  measure("fk/kinefile", fk_kinefile);
  measure("fk/eigen_per_frame", fk_eigen);
  measure("place/rotations", place_kinefile<double, true>);
  measure("place/rotations_float", place_kinefile<float, true>);
  measure("place/positions", place_kinefile<double, false>);
  measure("place/positions_float", place_kinefile<float, false>);
  measure("place/rotations_eigen", place_eigen<double, true>);
  measure("place/rotations_float_eigen", place_eigen<float, true>);
  measure("place/positions_eigen", place_eigen<double, false>);
  measure("place/positions_float_eigen", place_eigen<float, false>);
  measure("warp/kinefile", warp_kinefile<retime::RotationInterpolation::Slerp>);
  measure("warp/kinefile_cubic", warp_kinefile<retime::RotationInterpolation::Cubic>);
  measure("warp/eigen_slerp", warp_eigen);
  compare("forward kinematics, against Eigen's AngleAxis matrices", "fk/kinefile",
          "fk/eigen_per_frame");
  compare("FK, positions + rotations, against Eigen quaternions", "place/rotations",
          "place/rotations_eigen");
  compare("FK, positions + rotations, single precision", "place/rotations_float",
          "place/rotations_float_eigen");
  compare("FK, positions only", "place/positions", "place/positions_eigen");
  compare("FK, positions only, single precision", "place/positions_float",
          "place/positions_float_eigen");
  compare("warping time, against a plain Eigen slerp loop", "warp/kinefile", "warp/eigen_slerp");
  compare("warping time with cubics, against the same", "warp/kinefile_cubic", "warp/eigen_slerp");
}

void print_disagreements() {
  fmt::print("{:<58}{:.1e}\n", "largest difference of the two kinematics, relative",
             disagreement());
  fmt::print("{:<58}{:.1e}\n", "largest difference of the two warps, relative",
             warp_disagreement());
}

}  // namespace kinefile::bench
