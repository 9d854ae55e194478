// SPDX-License-Identifier: MIT
#include "keyframes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "support/keyframes.hpp"

namespace kinefile::bench {
namespace {

constexpr std::size_t kJoints = 20;
constexpr std::size_t kPoses = 20;
constexpr std::size_t kTenSeconds = 601, kTenMinutes = 36'001;

/// Runs once, which is long enough to tell seconds from fractions; returns the seconds.
template <class Function>
double seconds_of(const Function& function) {
  const auto start = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

servo::Keyframes made(const servo::JointTrajectory& trajectory,
                      const servo::KeyframeOptions& options) {
  Diagnostics diagnostics;
  auto keyframes = servo::keyframe(trajectory, test::map_of_joints(kJoints), options, diagnostics);
  if (keyframes) return std::move(*keyframes);
  fmt::print(stderr, "{}\n", to_string(keyframes.error()));
  std::exit(1);
}

double largest_error(const servo::Keyframes& keyframes) {
  double largest = 0;
  for (const servo::KeyframeError& error : keyframes.errors)
    largest = std::max(largest, error.largest);
  return largest;
}

}  // namespace

void print_keyframes() {
  const servo::JointTrajectory trajectory = test::swinging(kJoints, kTenSeconds, 1);
  const ServoMap map = test::map_of_joints(kJoints);
  double own = 0, longest = 0, farthest = 0;
  const double own_seconds = seconds_of(
      [&] { own = largest_error(made(trajectory, {.num_poses = kPoses, .tolerance = {}})); });
  const double longest_seconds =
      seconds_of([&] { longest = test::greedy_error(trajectory, map, kPoses); });
  farthest = test::farthest_first_error(trajectory, map, kPoses);
  const servo::JointTrajectory minutes = test::swinging(kJoints, kTenMinutes, 1);
  const double tolerance_seconds =
      seconds_of([&] { made(minutes, {.num_poses = {}, .tolerance = 1}); });
  const auto print = [](const char* what, double value) {
    fmt::print("{:<58}{:.3f}\n", what, value);
  };
  fmt::print("\n{} joints, {} frames, {} poses\n", kJoints, kTenSeconds, kPoses);
  print("largest error of keyframes, degrees", own);
  print("of greedy reduction by longest segments, as a multiple", longest / own);
  print("of greedy reduction by farthest frames, as a multiple", farthest / own);
  print("seconds for keyframes", own_seconds);
  print("seconds for longest segments, plainly written", longest_seconds);
  print("seconds for keyframes of 10 minutes within 1 degree", tolerance_seconds);
}

}  // namespace kinefile::bench
