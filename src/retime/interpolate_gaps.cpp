// SPDX-License-Identifier: MIT
#include "retime/interpolate_gaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace kinefile::retime {
namespace {

/// Columns that are interpolated together.
using Group = std::vector<std::size_t>;

std::vector<Group> groups_of(const InterpolationPlan& plan) {
  std::vector<Group> groups;
  for (const TurningJoint& joint : plan.turning_joints) {
    Group& group = groups.emplace_back();
    for (const DegreeOfFreedom& dof : joint.rotations) group.push_back(dof.coordinate);
  }
  for (const WholeRotation& whole : plan.whole_rotations) {
    Group& group = groups.emplace_back();
    for (std::size_t k = 0; k < num_coordinates(whole.dof); ++k) {
      group.push_back(whole.dof.coordinate + k);
    }
  }
  for (const std::size_t column : plan.number_columns) groups.push_back({column});
  return groups;
}

/// A gap: a needed number that is not finite.
struct Gap {
  std::size_t column = 0;
  std::size_t old_frame = 0;
  std::size_t new_frame = 0;
  std::size_t num_frames = 0;  ///< new frames of the joint that have gaps
};

bool has_gap(const Clip& clip, std::size_t frame) {
  const auto row = clip.row(frame);
  return !std::all_of(row.begin(), row.end(), [](double value) { return std::isfinite(value); });
}

/// The old frames of a step that have gaps in any column.
std::vector<std::size_t> bad_frames(const Clip& clip, const std::vector<bool>& is_bad,
                                    const Step& step, bool is_cubic) {
  std::vector<std::size_t> frames;
  const auto add = [&](std::size_t frame) {
    if (is_bad[frame]) frames.push_back(frame);
  };
  const Around needed = around(step, clip.num_frames);
  add(needed.from);
  add(needed.to);
  if (is_cubic) {
    add(needed.before);
    add(needed.after);
  }
  if (step.is_average()) {
    for (const Tap& tap : taps_of(step, clip.num_frames)) add(tap.old_frame);
  }
  return frames;
}

/// The first number of a group that is not finite in one of some frames.
std::optional<Gap> find_gap(const Clip& clip, const Group& group,
                            const std::vector<std::size_t>& frames, std::size_t new_frame) {
  for (const std::size_t frame : frames) {
    for (const std::size_t column : group) {
      if (!std::isfinite(clip.row(frame)[column])) return Gap{column, frame, new_frame, 0};
    }
  }
  return std::nullopt;
}

std::string message_of(const Skeleton& skeleton, const Gap& gap) {
  const Coordinate& coordinate = skeleton.coordinates[gap.column];
  return fmt::format(
      "joint '{}': {} is not a finite number in frame {}, which the new frame {} needs",
      skeleton.joints[coordinate.joint].name, coordinate.channel, gap.old_frame, gap.new_frame);
}

/// Makes the gaps of one step NaN and adds them to those of their joints.
void mark_step(const Motion& motion, const std::vector<Group>& groups, const Step& step,
               const std::vector<std::size_t>& frames, std::vector<Gap>& gaps, Clip& new_clip) {
  std::vector<std::size_t> joints;
  for (const Group& group : groups) {
    const auto gap = find_gap(motion.clip, group, frames, step.new_frame);
    if (!gap) continue;
    for (const std::size_t column : group) {
      new_clip.mutate()[step.new_frame][column] = std::numeric_limits<double>::quiet_NaN();
    }
    const std::size_t joint = motion.skeleton.coordinates[gap->column].joint;
    if (gaps[joint].num_frames == 0) gaps[joint] = *gap;
    joints.push_back(joint);
  }
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  for (const std::size_t joint : joints) ++gaps[joint].num_frames;
}

}  // namespace

Result<void> mark_gaps(const Motion& motion, const std::vector<Step>& steps,
                       const InterpolationPlan& plan, const RetimeOptions& options, Clip& new_clip,
                       Diagnostics& diagnostics) {
  const Clip& clip = motion.clip;
  std::vector<bool> is_bad(clip.num_frames);
  for (std::size_t f = 0; f < clip.num_frames; ++f) is_bad[f] = has_gap(clip, f);
  if (std::find(is_bad.begin(), is_bad.end(), true) == is_bad.end()) return {};
  const std::vector<Group> groups = groups_of(plan);
  const bool is_cubic = options.rotation == RotationInterpolation::Cubic;
  std::vector<Gap> gaps(motion.skeleton.joints.size());  // the first gap of each joint
  for (const Step& step : steps) {
    if (step.is_copy()) continue;
    const auto frames = bad_frames(clip, is_bad, step, is_cubic);
    if (!frames.empty()) mark_step(motion, groups, step, frames, gaps, new_clip);
  }
  for (const Gap& gap : gaps) {
    if (gap.num_frames == 0) continue;
    Error error = make_error(ErrorKind::InvalidInput, "RTM005", message_of(motion.skeleton, gap));
    if (!options.lenient) return fail(std::move(error));
    error.severity = Severity::Warning;
    error.message += fmt::format("; {} new frame{} of the joint have gaps", gap.num_frames,
                                 gap.num_frames == 1 ? "" : "s");
    diagnostics.add(std::move(error));
  }
  return {};
}

}  // namespace kinefile::retime
