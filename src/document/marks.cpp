// SPDX-License-Identifier: MIT
#include "kinefile/marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinefile/anomalies.hpp"
#include "kinefile/limits.hpp"
#include "kinefile/robot.hpp"

namespace kinefile {
namespace {

/// A value of a degree of freedom with its unit: "12.5 deg", of a speed "12.5 deg/s".
std::string with_unit(double value, const ToldUnit& unit, bool is_speed) {
  std::string text = fmt::format("{:.6g}", value * unit.factor);
  if (!unit.name.empty()) text.append(" ").append(unit.name);
  return is_speed ? text + "/s" : text;
}

/// A breach of a limit, as a sentence.
std::string sentence_of(const LimitBreach& breach, const Skeleton& skeleton) {
  const Joint& joint = skeleton.joints[breach.joint];
  const ToldUnit unit = told_unit(joint.dofs[breach.dof], skeleton);
  const bool is_speed = breach.kind == LimitBreach::Kind::TooFast;
  const std::string worst = with_unit(breach.worst, unit, is_speed);
  const std::string limit = with_unit(breach.limit, unit, is_speed);
  if (is_speed) {
    return fmt::format(
        "joint '{}' moves at up to {} (to frame {}), its limit is {}; too fast in {} frames, first "
        "in {}",
        joint.name, worst, breach.worst_frame, limit, breach.num_frames, breach.first_frame);
  }
  const bool is_below = breach.kind == LimitBreach::Kind::Below;
  return fmt::format(
      "joint '{}' goes {} to {} (frame {}), its limit is {}; beyond it in {} frames, first in {}",
      joint.name, is_below ? "down" : "up", worst, breach.worst_frame, limit, breach.num_frames,
      breach.first_frame);
}

/// A sudden turn, as a sentence.
std::string sentence_of(const SuddenTurn& turn, const Skeleton& skeleton) {
  std::string sentence =
      fmt::format("joint '{}' turns by {:.0f} degrees from frame {} to {}",
                  skeleton.joints[turn.joint].name, turn.degrees, turn.frame - 1, turn.frame);
  if (turn.return_frame != 0)
    sentence += fmt::format(" and is back in frame {}", turn.return_frame);
  return sentence;
}

Mark mark_of(const SuddenTurn& turn, const Skeleton& skeleton) {
  const bool returns = turn.return_frame != 0;
  Mark mark;
  mark.kind = returns ? Mark::Kind::Spike : Mark::Kind::Flip;
  mark.joint = turn.joint;
  mark.first_frame = turn.frame;
  mark.num_frames = returns ? turn.return_frame - turn.frame : 1;
  mark.worst_frame = turn.frame;
  mark.code = returns ? "MOT001" : "MOT002";
  mark.message = sentence_of(turn, skeleton);
  return mark;
}

Mark::Kind kind_of(LimitBreach::Kind kind) {
  if (kind == LimitBreach::Kind::TooFast) return Mark::Kind::TooFast;
  return kind == LimitBreach::Kind::Below ? Mark::Kind::BelowLimit : Mark::Kind::AboveLimit;
}

Mark mark_of(const LimitBreach& breach, const Skeleton& skeleton) {
  Mark mark;
  mark.kind = kind_of(breach.kind);
  mark.joint = breach.joint;
  mark.first_frame = breach.first_frame;
  mark.num_frames = breach.num_frames;
  mark.worst_frame = breach.worst_frame;
  mark.code = breach.kind == LimitBreach::Kind::TooFast ? "MOT004" : "MOT003";
  mark.message = sentence_of(breach, skeleton);
  return mark;
}

/// How far a breach is beyond its limit.
double excess(const LimitBreach& breach) { return std::abs(breach.worst - breach.limit); }

/// For each joint of a figure, which turns about several axes, the worst breach of each kind.
std::vector<LimitBreach> one_a_joint(const std::vector<LimitBreach>& breaches) {
  std::vector<LimitBreach> worst;
  for (const LimitBreach& breach : breaches) {
    const auto other = std::find_if(worst.begin(), worst.end(), [&](const LimitBreach& known) {
      return known.joint == breach.joint && known.kind == breach.kind;
    });
    if (other == worst.end()) {
      worst.push_back(breach);
    } else if (excess(breach) > excess(*other)) {
      *other = breach;
    }
  }
  return worst;
}

}  // namespace

std::vector<Mark> find_limit_marks(const Motion& motion) {
  // A robot cannot exceed its limits; the limits of a figure in an ASF file
  // are often narrower than the person's.
  const bool is_robot = robot::is_robot(motion.skeleton);
  auto breaches = find_limit_breaches(motion);
  if (!is_robot) breaches = one_a_joint(breaches);
  std::vector<Mark> marks;
  for (const LimitBreach& breach : breaches) {
    marks.push_back(mark_of(breach, motion.skeleton));
    marks.back().severity = is_robot ? Severity::Warning : Severity::Note;
  }
  return marks;
}

std::vector<Mark> find_marks(const Motion& motion) {
  std::vector<Mark> marks;
  for (const SuddenTurn& turn : find_sudden_turns(motion)) {
    marks.push_back(mark_of(turn, motion.skeleton));
  }
  for (Mark& mark : find_limit_marks(motion)) marks.push_back(std::move(mark));
  return marks;
}

}  // namespace kinefile
