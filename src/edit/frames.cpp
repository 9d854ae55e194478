// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "edit/skeleton_facts.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

constexpr Eigen::Index kY = 1;
constexpr Eigen::Index kZ = 2;

bool is_length(DofKind kind) {
  return kind == DofKind::Translation || kind == DofKind::TailTranslation;
}

/// The columns that hold lengths.
std::vector<bool> length_columns(const Skeleton& skeleton) {
  std::vector<bool> is_length_column(skeleton.coordinates.size(), false);
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const std::size_t count = dof.kind == DofKind::Free ? 3 : (is_length(dof.kind) ? 1 : 0);
      for (std::size_t k = 0; k < count; ++k) is_length_column[dof.coordinate + k] = true;
    }
  }
  return is_length_column;
}

/// How a figure stands along y and z, over some frames.
struct Standing {
  std::size_t num_frames = 0;
  Eigen::Array3d height = Eigen::Array3d::Zero();  ///< sum of the joints' mean over the lowest
  Eigen::Array3d lowest = Eigen::Array3d::Zero();  ///< sum of where the lowest point is
  Eigen::Array3d lowest_squares = Eigen::Array3d::Zero();
};

void add_frame(const WorldPoses& poses, std::size_t frame, Standing& standing) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  Eigen::Array3d lowest = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  const auto count = static_cast<double>(poses.num_joints);
  for (std::size_t j = 0; j < poses.num_joints; ++j) {
    const Eigen::Map<const Eigen::Array3d> place(
        &poses.positions[(frame * poses.num_joints + j) * 3]);
    sum += place;
    lowest = lowest.min(place);
  }
  for (std::size_t t = 0; t < poses.num_tips; ++t) {
    lowest =
        lowest.min(Eigen::Map<const Eigen::Array3d>(&poses.tips[(frame * poses.num_tips + t) * 3]));
  }
  if (!(sum + lowest).isFinite().all()) return;
  ++standing.num_frames;
  standing.height += sum / count - lowest;
  standing.lowest += lowest;
  standing.lowest_squares += lowest.square();
}

/// How high the joints lie over the lowest point, less what that point wanders: large along the
/// axis that points up, since feet come back to one ground.
Eigen::Array3d uprightness(const Standing& standing) {
  const double count = static_cast<double>(std::max<std::size_t>(standing.num_frames, 1));
  const Eigen::Array3d mean = standing.lowest / count;
  const Eigen::Array3d variance = standing.lowest_squares / count - mean.square();
  return standing.height / count - variance.max(0.0).sqrt();
}

/// A quarter turn about x, which brings y to z or z to y.
struct QuarterTurn {
  bool is_to_z = true;

  Vec3 operator()(const Vec3& v) const {
    return is_to_z ? Vec3(v[0], -v[kZ], v[kY]) : Vec3(v[0], v[kZ], -v[kY]);
  }
};

/// The other way around, with zeros that have no sign.
Vec3 opposite(const Vec3& axis) { return Vec3::Zero() - axis; }

void negate_column(Clip& clip, std::size_t column) {
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    clip.row(f)[column] = -clip.row(f)[column];
  }
}

void turn_free_columns(const QuarterTurn& turn, std::size_t first, Clip& clip) {
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    for (const std::size_t part : {first, first + 4}) {
      const Eigen::Map<Vec3> vector(&clip.row(f)[part]);
      const Vec3 turned = turn(vector);
      std::copy(turned.begin(), turned.end(), &clip.row(f)[part]);
    }
  }
}

/// Turns an axis. One that comes to lie along -x, -y or -z is turned around with its values, so
/// that formats which know coordinate axes alone can still say it.
void turn_axis(const QuarterTurn& turn, bool has_own_column, DegreeOfFreedom& dof, Motion& motion) {
  const auto old_axis = coordinate_axis(dof.axis);
  dof.axis = opposite(opposite(turn(dof.axis)));
  const bool is_turned_around = coordinate_axis(-dof.axis).has_value();
  // A scale along -y is one along y; a length along the bone stays one.
  if (is_turned_around && dof.kind == DofKind::TailScale) dof.axis = opposite(dof.axis);
  if (is_turned_around && has_own_column &&
      (dof.kind == DofKind::Rotation || dof.kind == DofKind::Translation)) {
    dof.axis = opposite(dof.axis);
    dof.rest = -dof.rest;
    negate_column(motion.clip, dof.coordinate);
  }
  std::string& channel = motion.skeleton.coordinates[dof.coordinate].channel;
  const auto new_axis = coordinate_axis(dof.axis);
  if (old_axis && new_axis && channel == channel_name(dof.kind, *old_axis)) {
    channel = channel_name(dof.kind, *new_axis);
  }
}

void turn_joint(const QuarterTurn& turn, const std::vector<std::size_t>& readers, Joint& joint,
                Motion& motion) {
  joint.offset = turn(joint.offset);
  for (Tip& tip : joint.tips) tip.offset = turn(tip.offset);
  joint.rest_rotation.vec() = turn(joint.rest_rotation.vec());
  for (DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind == DofKind::Free) {
      turn_free_columns(turn, dof.coordinate, motion.clip);
    } else {
      turn_axis(turn, readers[dof.coordinate] == 1, dof, motion);
    }
  }
}

/// Holds a column at its first number that is finite.
void hold_column(Clip& clip, std::size_t column) {
  std::size_t first = 0;
  while (first < clip.num_frames && !std::isfinite(clip.row(first)[column])) ++first;
  for (std::size_t f = first; f < clip.num_frames; ++f) {
    if (std::isfinite(clip.row(f)[column])) clip.row(f)[column] = clip.row(first)[column];
  }
}

/// Brings a root that slides along oblique axes back over its first place in every frame.
void hold_over_ground(const Joint& root, const std::vector<Slide>& slides, Eigen::Index up,
                      Clip& clip) {
  std::optional<Vec3> start;
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    Vec3 place = position_in_row(root, slides, clip.row(f));
    if (!place.allFinite()) continue;
    if (!start) start = place;
    const double height = place[up];
    place = *start;
    place[up] = height;
    fit_position(root, slides, place, clip.row(f));
  }
}

}  // namespace

Motion scaled(const Motion& motion, double factor) {
  Motion result = motion;
  for (Joint& joint : result.skeleton.joints) {
    joint.offset *= factor;
    for (Tip& tip : joint.tips) tip.offset *= factor;
    for (DegreeOfFreedom& dof : joint.dofs) {
      if (is_length(dof.kind)) dof.rest *= factor;
    }
  }
  const std::vector<bool> is_scaled = length_columns(motion.skeleton);
  for (std::size_t f = 0; f < result.clip.num_frames; ++f) {
    const auto row = result.clip.row(f);
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (is_scaled[c]) row[c] *= factor;
    }
  }
  return result;
}

std::size_t guess_up_axis(const Motion& motion) {
  constexpr std::size_t kMostFrames = 64;
  constexpr double kSurely = 1.5;
  if (motion.skeleton.joints.empty()) return kY;
  const Clip rest = rest_clip(motion.skeleton);
  const Clip& clip = motion.clip.num_frames > 0 ? motion.clip : rest;
  KinematicsOptions options;
  options.frame_step = (clip.num_frames + kMostFrames - 1) / kMostFrames;
  options.num_frames = kMostFrames;
  options.tips = true;
  const WorldPoses poses = forward_kinematics(motion.skeleton, clip, options);
  Standing standing;
  for (std::size_t f = 0; f < poses.num_frames; ++f) add_frame(poses, f, standing);
  const Eigen::Array3d upright = uprightness(standing);
  return upright[kZ] > kSurely * std::max(upright[kY], 0.0) ? kZ : kY;
}

Motion with_up_axis(const Motion& motion, std::size_t axis, Diagnostics& diagnostics) {
  if (guess_up_axis(motion) == axis) {
    Diagnostic note;
    note.severity = Severity::Note;
    note.code = "EDT009";
    note.message = axis == 2 ? "z points up already" : "y points up already";
    diagnostics.add(std::move(note));
    return motion;
  }
  Motion result = motion;
  const QuarterTurn turn{axis == 2};
  const auto readers = num_readers_of_columns(motion.skeleton);
  for (Joint& joint : result.skeleton.joints) turn_joint(turn, readers, joint, result);
  return result;
}

Motion in_place(const Motion& motion) {
  constexpr double kStraight = 1e-12;
  Motion result = motion;
  const auto up = static_cast<Eigen::Index>(guess_up_axis(motion));
  for (const Joint& joint : motion.skeleton.joints) {
    if (joint.parent != kNoParent) continue;
    const std::vector<Slide> slides = slides_of(joint);
    const auto is_level = [up](const Slide& s) { return std::abs(s.axis[up]) < kStraight; };
    const auto is_straight = [up, is_level](const Slide& s) {
      return is_level(s) || std::abs(std::abs(s.axis[up]) - 1) < kStraight;
    };
    if (!std::all_of(slides.begin(), slides.end(), is_straight)) {
      hold_over_ground(joint, slides, up, result.clip);
      continue;
    }
    for (const Slide& slide : slides) {
      if (is_level(slide)) hold_column(result.clip, slide.column);
    }
  }
  return result;
}

}  // namespace kinefile
