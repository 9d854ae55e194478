// SPDX-License-Identifier: MIT
#include "walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "kinefile/kinematics.hpp"

namespace kinefile::examples {
namespace {

/// The middle of a joint's swing and the first two waves of it, in degrees: over a cycle phi of
/// two steps, mean + amplitude sin(phi + phase) + amplitude2 sin(2 phi + phase2).
struct Swing {
  double mean = 0;
  double amplitude = 0;
  double phase = 0;
  double amplitude2 = 0;
  double phase2 = 0;

  double at(double cycle) const {
    return mean + amplitude * std::sin(cycle + phase) + amplitude2 * std::sin(2 * cycle + phase2);
  }
};

/// A joint of the figure: where it sits on its parent, in centimetres, and how it swings about
/// z (sideways), x (forwards) and y (turning).
struct Part {
  std::string name;
  std::string parent;
  Vec3 offset;
  Swing z;
  Swing x;
  Swing y;
  std::vector<Vec3> tip = {};
};

/// An arm or a leg: `side` is +1 for the left (+X) and -1 for the right; the right one is half a
/// cycle late and its sideways and turning angles are mirrored.
std::vector<Part> limb_parts(double side) {
  const std::string name = side > 0 ? "Left" : "Right";
  const double late = side > 0 ? 0 : std::numbers::pi;
  const auto at = [side](double x, double y, double z) { return Vec3(side * x, y, z); };
  const auto forwards = [late](double mean, double amplitude, double phase, double amplitude2 = 0,
                               double phase2 = 0) {
    return Swing{mean, amplitude, phase + late, amplitude2, phase2};
  };
  const auto sideways = [late, side](double mean, double amplitude, double phase = 0) {
    return Swing{side * mean, side * amplitude, phase + late};
  };
  return {
      {name + "Collar", "Chest", at(3, 14, 2), sideways(0, 1), forwards(0, 1, 0), sideways(0, 4)},
      {name + "UpperArm", name + "Collar", at(15, 0, -1), sideways(-78, 3), forwards(2, 2, 0),
       sideways(-4, 24)},
      {name + "LowerArm", name + "UpperArm", at(28, 0, 0), sideways(0, 0), forwards(0, 0, 0),
       sideways(-22, 12, 0.4)},
      {name + "Hand",
       name + "LowerArm",
       at(25, 0, 0),
       sideways(-4, 3),
       forwards(0, 2, 1),
       sideways(0, 6, 0.8),
       {at(17, 0, 0)}},
      {name + "UpperLeg", "Hips", at(9, -4, 0), sideways(2, 2), forwards(-6, -23, 0, 4, 0.6),
       sideways(3, 3)},
      {name + "LowerLeg", name + "UpperLeg", at(0, -43, 0), sideways(0, 0),
       forwards(26, 22, -1.1, -14, 0.9), sideways(0, 1)},
      {name + "Foot", name + "LowerLeg", at(0, -42, 0), sideways(-2, 1),
       forwards(-4, 9, 2.6, 7, 0.2), sideways(6, 2)},
      {name + "Toe",
       name + "Foot",
       at(0, -6, 14),
       sideways(0, 0),
       forwards(-6, 10, 2.2, 5, 1.9),
       sideways(0, 0),
       {Vec3(0, 0, 7)}},
  };
}

std::vector<Part> figure() {
  std::vector<Part> parts = {
      {"Hips", "", Vec3(0, 96, 0), {0, 3, 0.2}, {4, 0, 0, 1.5, 0.3}, {0, 5, 0.1}},
      {"Spine", "Hips", Vec3(0, 11, 0), {0, -2, 0.2}, {3, 0, 0, 1, 1.2}, {0, -4, 0.1}},
      {"Spine1", "Spine", Vec3(0, 12, -1), {0, -1, 0.2}, {1, 0, 0, 0.5, 1.2}, {0, -4, 0.1}},
      {"Chest", "Spine1", Vec3(0, 13, -1), {0, 1, 0.2}, {-2, 0, 0, 1, 2}, {0, -4, 0.1}},
      {"Neck", "Chest", Vec3(0, 19, 1), {0, 0, 0}, {8, 0, 0, -1, 1.6}, {0, 3, 0.1}},
      {"Head",
       "Neck",
       Vec3(0, 10, 2),
       {0, -1, 0.2},
       {-9, 0, 0, -1, 1.9},
       {0, 4, 0.1},
       {Vec3(0, 18, 0)}},
  };
  for (const double side : {1.0, -1.0}) {
    for (Part& part : limb_parts(side)) parts.push_back(std::move(part));
  }
  return parts;
}

void add_channel(Skeleton& skeleton, DofKind kind, std::size_t axis, double rest) {
  const std::size_t joint = skeleton.joints.size() - 1;
  const Vec3 direction = Vec3::Unit(static_cast<Eigen::Index>(axis));
  skeleton.joints.back().dofs.push_back({kind, direction, skeleton.coordinates.size(), rest});
  skeleton.coordinates.push_back({joint, channel_name(kind, axis)});
}

Skeleton make_skeleton(const std::vector<Part>& parts) {
  Skeleton skeleton;
  for (const Part& part : parts) {
    Joint joint;
    joint.name = part.name;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      if (skeleton.joints[j].name == part.parent) joint.parent = j;
    }
    const bool is_root = joint.parent == kNoParent;
    if (!is_root) joint.offset = part.offset;
    for (const Vec3& tip : part.tip) joint.tips.push_back({"", tip});
    skeleton.joints.push_back(std::move(joint));
    for (std::size_t axis = 0; is_root && axis < 3; ++axis) {
      add_channel(skeleton, DofKind::Translation, axis,
                  part.offset[static_cast<Eigen::Index>(axis)]);
    }
    for (const std::size_t axis : {2u, 0u, 1u}) add_channel(skeleton, DofKind::Rotation, axis, 0);
  }
  return skeleton;
}

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

/// Lifts the hips in every frame so that the lowest point of the figure touches the ground.
void stand_on_ground(Motion& motion) {
  const std::size_t block = frames_per_block(motion.skeleton);
  constexpr std::size_t kHipsY = 1;
  KinematicsOptions options;
  options.num_frames = block;
  options.tips = true;
  for (; options.first_frame < motion.clip.num_frames; options.first_frame += block) {
    const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip, options);
    for (std::size_t f = 0; f < poses.num_frames; ++f) {
      double lowest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < poses.num_joints; ++j) {
        lowest = std::min(lowest, poses.positions[(f * poses.num_joints + j) * 3 + 1]);
      }
      for (std::size_t t = 0; t < poses.num_tips; ++t) {
        lowest = std::min(lowest, poses.tips[(f * poses.num_tips + t) * 3 + 1]);
      }
      motion.clip.mutate()[poses.first_frame + f][kHipsY] = rounded(-lowest);
    }
  }
}

}  // namespace

Motion make_walk(const WalkOptions& options) {
  const std::vector<Part> parts = figure();
  Motion motion;
  motion.skeleton = make_skeleton(parts);
  Clip& clip = motion.clip;
  clip.num_frames = options.num_frames;
  clip.num_coordinates = motion.skeleton.coordinates.size();
  clip.timeline.given = FrameTime{1 / options.frame_rate};
  clip.values.reserve(clip.num_frames * clip.num_coordinates);

  constexpr double kTurnPerSecond = 6;  // degrees
  const double turn_radians = kTurnPerSecond * kRadiansPerDegree;
  const double radius = options.metres_per_second * 100 / turn_radians;
  for (std::size_t frame = 0; frame < clip.num_frames; ++frame) {
    const double time = static_cast<double>(frame) / options.frame_rate;
    const double cycle = std::numbers::pi * options.steps_per_second * time;
    const double heading = turn_radians * time;
    const Vec3 hips(radius * (1 - std::cos(heading)) + 2 * std::sin(cycle), 0,
                    radius * std::sin(heading));
    for (const double component : hips) clip.values.push_back(rounded(component));
    for (std::size_t p = 0; p < parts.size(); ++p) {
      clip.values.push_back(rounded(parts[p].z.at(cycle)));
      clip.values.push_back(rounded(parts[p].x.at(cycle)));
      const double turn = p == 0 ? std::fmod(kTurnPerSecond * time, 360.0) : 0;
      clip.values.push_back(rounded(parts[p].y.at(cycle) + turn));
    }
  }
  stand_on_ground(motion);
  return motion;
}

}  // namespace kinefile::examples
