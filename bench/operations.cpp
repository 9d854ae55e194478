// SPDX-License-Identifier: MIT
#include "operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "baselines.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/shape.hpp"
#include "report.hpp"
#include "walk.hpp"

namespace kinefile::bench {
namespace {

constexpr double kCutoff = 6;                    // Hz
constexpr shape::RotationOrder kOrder{2, 1, 0};  // ZYX; the walk has ZXY

const Motion& walk() {
  static const Motion instance = examples::make_walk({.num_frames = 7501});
  return instance;
}

/// A walk whose left joints have axes in another order, so that the mirror finds their angles.
const Motion& uneven_walk() {
  static const Motion instance = [] {
    Motion motion = walk();
    for (Joint& joint : motion.skeleton.joints) {
      const bool is_left = joint.name.rfind("Left", 0) == 0 && joint.dofs.size() == 3;
      if (is_left) std::swap(joint.dofs[0].axis, joint.dofs[1].axis);
    }
    return motion;
  }();
  return instance;
}

Motion reordered() {
  Diagnostics diagnostics;
  shape::ChannelOptions options;
  options.order = kOrder;
  return std::move(shape::with_channels(walk(), options, diagnostics).value());
}

Motion smoothed() { return std::move(edit::smooth(walk(), kCutoff).value()); }

Motion mirrored(const Motion& motion) {
  Diagnostics diagnostics;
  return std::move(edit::mirror(motion, 0, false, diagnostics).value());
}

std::vector<double> reordered_by_baseline() { return reordered_with_eigen(walk(), {2, 1, 0}); }

void order_kinefile(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(reordered());
}

void order_eigen(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(reordered_by_baseline());
}

void smooth_kinefile(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(smoothed());
}

void smooth_eigen(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(smoothed_with_eigen(walk(), kCutoff));
}

void mirror_kinefile(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(mirrored(walk()));
}

void mirror_eigen(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(mirrored_with_eigen(walk()));
}

void mirror_uneven_kinefile(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(mirrored(uneven_walk()));
}

void mirror_uneven_eigen(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(mirrored_with_eigen(uneven_walk()));
}

/// The largest distance of joints in a motion and in that with other values, as a share of the
/// largest coordinate.
double disagreement(const Motion& ours, std::vector<double> values) {
  const WorldPoses a = forward_kinematics(ours.skeleton, ours.clip);
  Motion theirs = ours;
  theirs.clip.values = std::move(values);
  const WorldPoses b = forward_kinematics(theirs.skeleton, theirs.clip);
  double largest = 0;
  double difference = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    largest = std::max(largest, std::abs(a.positions[i]));
    difference = std::max(difference, std::abs(a.positions[i] - b.positions[i]));
  }
  return difference / largest;
}

}  // namespace

void add_operations() {
  measure("operations/order", order_kinefile);
  measure("operations/order_eigen", order_eigen);
  measure("operations/smooth", smooth_kinefile);
  measure("operations/smooth_eigen", smooth_eigen);
  measure("operations/mirror", mirror_kinefile);
  measure("operations/mirror_eigen", mirror_eigen);
  measure("operations/mirror_uneven", mirror_uneven_kinefile);
  measure("operations/mirror_uneven_eigen", mirror_uneven_eigen);
  compare("another rotation order, against a plain Eigen loop", "operations/order",
          "operations/order_eigen");
  compare("smoothing, against a plain Eigen loop", "operations/smooth", "operations/smooth_eigen");
  compare("mirroring where numbers are copied, against the same", "operations/mirror",
          "operations/mirror_eigen");
  compare("mirroring where half of the angles are found", "operations/mirror_uneven",
          "operations/mirror_uneven_eigen");
}

void print_operation_disagreements() {
  const double largest =
      std::max({disagreement(reordered(), reordered_by_baseline()),
                disagreement(smoothed(), smoothed_with_eigen(walk(), kCutoff)),
                disagreement(mirrored(walk()), mirrored_with_eigen(walk())),
                disagreement(mirrored(uneven_walk()), mirrored_with_eigen(uneven_walk()))});
  fmt::print("{:<58}{:.1e}\n", "largest difference of operations, relative", largest);
}

}  // namespace kinefile::bench
