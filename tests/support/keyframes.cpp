// SPDX-License-Identifier: MIT
#include "support/keyframes.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace kinefile::test {
namespace {

double word_at(const servo::JointTrajectory& trajectory, const ServoMap& map, std::size_t tick,
               std::size_t joint) {
  const ServoMapEntry& entry = map.entries[joint];
  return word_of_angle(entry, trajectory.angles[tick * trajectory.joints.size() + joint]);
}

int rounded_word(const ServoMapEntry& entry, double word) {
  const int highest = (entry.maximum - entry.minimum) / entry.step;
  const double steps = std::round((word - entry.minimum) / entry.step);
  return entry.minimum + entry.step * static_cast<int>(std::clamp(steps, 0.0, 1.0 * highest));
}

/// The error of a segment and the tick where it is.
struct SegmentFault {
  double error = 0;
  std::size_t tick = 0;
};

SegmentFault fault_of_segment(const servo::JointTrajectory& trajectory, const ServoMap& map,
                              std::size_t from, std::size_t to) {
  SegmentFault fault;
  const int length = static_cast<int>(to - from);
  for (std::size_t j = 0; j < trajectory.joints.size(); ++j) {
    const ServoMapEntry& entry = map.entries[j];
    const int a = rounded_word(entry, word_at(trajectory, map, from, j));
    const int b = rounded_word(entry, word_at(trajectory, map, to, j));
    for (int k = 0; k <= length; ++k) {
      const std::size_t tick = from + static_cast<std::size_t>(k);
      const int word = length == 0 ? a : a + (b - a) * k / length;
      const double error =
          std::abs(word - word_at(trajectory, map, tick, j)) / entry.units_per_degree;
      if (error > fault.error) fault = {error, tick};
    }
  }
  return fault;
}

}  // namespace

ServoMap map_of_joints(std::size_t num_joints, int step) {
  ServoMap map;
  for (std::size_t j = 0; j < num_joints; ++j) {
    ServoMapEntry& entry = map.entries.emplace_back();
    entry.slider = j;
    entry.joint = "j" + std::to_string(j);
    entry.units_per_degree = 100;
    entry.step = step;
  }
  return map;
}

servo::JointTrajectory trajectory_of_degrees(const std::vector<double>& degrees) {
  servo::JointTrajectory trajectory;
  trajectory.joints = {"j0"};
  trajectory.num_frames = degrees.size();
  trajectory.frame_time = 1.0 / 60;
  for (const double angle : degrees) trajectory.angles.push_back(angle * kRadiansPerDegree);
  return trajectory;
}

servo::JointTrajectory swinging(std::size_t num_joints, std::size_t num_frames,
                                std::uint32_t seed) {
  std::mt19937 random(seed);  // which has the same numbers everywhere
  const auto up_to = [&random](double most) {
    return most * static_cast<double>(random()) / 4294967296.0;
  };
  servo::JointTrajectory trajectory;
  trajectory.num_frames = num_frames;
  trajectory.frame_time = 1.0 / 60;
  trajectory.angles.assign(num_frames * num_joints, 0.0);
  for (std::size_t j = 0; j < num_joints; ++j) {
    trajectory.joints.push_back("j" + std::to_string(j));
    for (int wave = 1; wave <= 3; ++wave) {
      const double size = up_to(0.6) / wave, rate = wave * (0.02 + up_to(0.04)), phase = up_to(6);
      for (std::size_t f = 0; f < num_frames; ++f) {
        trajectory.angles.mutate()[f * num_joints + j] +=
            size * std::sin(rate * static_cast<double>(f) + phase);
      }
    }
  }
  return trajectory;
}

double error_of_ticks(const servo::JointTrajectory& trajectory, const ServoMap& map,
                      const std::vector<std::size_t>& ticks) {
  double largest = fault_of_segment(trajectory, map, ticks.front(), ticks.front()).error;
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    largest = std::max(largest, fault_of_segment(trajectory, map, ticks[i - 1], ticks[i]).error);
  }
  return largest;
}

std::vector<std::size_t> greedy_ticks(const servo::JointTrajectory& trajectory, const ServoMap& map,
                                      double tolerance) {
  const std::size_t last = trajectory.num_frames - 1;
  std::vector<std::size_t> ticks = {0};
  while (ticks.back() < last) {
    const std::size_t from = ticks.back();
    std::size_t to = std::min<std::size_t>(last, from + kMaxTicks);
    while (to > from && fault_of_segment(trajectory, map, from, to).error > tolerance) --to;
    if (to == from) return {};
    ticks.push_back(to);
  }
  return ticks;
}

double greedy_error(const servo::JointTrajectory& trajectory, const ServoMap& map,
                    std::size_t num_poses) {
  double low = 0, high = 60;
  for (int i = 0; i < 20; ++i) {
    const double middle = (low + high) / 2;
    const auto ticks = greedy_ticks(trajectory, map, middle);
    const bool fits = !ticks.empty() && ticks.size() <= num_poses;
    (fits ? high : low) = middle;
  }
  return error_of_ticks(trajectory, map, greedy_ticks(trajectory, map, high));
}

double farthest_first_error(const servo::JointTrajectory& trajectory, const ServoMap& map,
                            std::size_t num_poses) {
  std::vector<std::size_t> ticks;
  for (std::size_t tick = 0; tick < trajectory.num_frames - 1; tick += kMaxTicks) {
    ticks.push_back(tick);
  }
  ticks.push_back(trajectory.num_frames - 1);
  double least = error_of_ticks(trajectory, map, ticks);
  while (ticks.size() < num_poses) {
    SegmentFault worst;
    for (std::size_t i = 1; i < ticks.size(); ++i) {
      const SegmentFault fault = fault_of_segment(trajectory, map, ticks[i - 1], ticks[i]);
      const bool is_within = fault.tick > ticks[i - 1] && fault.tick < ticks[i];
      if (is_within && fault.error > worst.error) worst = fault;
    }
    if (worst.error == 0) break;
    ticks.insert(std::upper_bound(ticks.begin(), ticks.end(), worst.tick), worst.tick);
    least = std::min(least, error_of_ticks(trajectory, map, ticks));
  }
  return least;
}

}  // namespace kinefile::test
