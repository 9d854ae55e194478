// SPDX-License-Identifier: MIT
#include "kinefile/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/anomalies.hpp"
#include "kinefile/limits.hpp"
#include "kinefile/place.hpp"

namespace kinefile {
namespace {

/// A breach of a limit, as a sentence.
std::string sentence_of(const LimitBreach& breach, const Skeleton& skeleton) {
  const std::string& joint = skeleton.joints[breach.joint].name;
  if (breach.kind == LimitBreach::Kind::TooFast) {
    return fmt::format(
        "joint '{}' moves at up to {:.6g} a second (to frame {}), its limit is "
        "{:.6g}; too fast in {} frames, first in {}",
        joint, breach.worst, breach.worst_frame, breach.limit, breach.num_frames,
        breach.first_frame);
  }
  const bool is_below = breach.kind == LimitBreach::Kind::Below;
  return fmt::format(
      "joint '{}' goes {} to {:.6g} (frame {}), its limit is {:.6g}; beyond it in "
      "{} frames, first in {}",
      joint, is_below ? "down" : "up", breach.worst, breach.worst_frame, breach.limit,
      breach.num_frames, breach.first_frame);
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

void note_sudden_turns(const Motion& motion, Diagnostics& diagnostics) {
  for (const SuddenTurn& turn : find_sudden_turns(motion)) {
    diagnostics.add(Severity::Note, turn.return_frame != 0 ? "MOT001" : "MOT002",
                    sentence_of(turn, motion.skeleton));
  }
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

/// A robot cannot exceed its limits; the limits of a figure in an ASF file
/// are often narrower than the person's.
void tell_breaches(const Motion& motion, Diagnostics& diagnostics) {
  const bool is_robot = robot::is_robot(motion.skeleton);
  auto breaches = find_limit_breaches(motion);
  if (!is_robot) breaches = one_a_joint(breaches);
  for (const LimitBreach& breach : breaches) {
    diagnostics.add(is_robot ? Severity::Warning : Severity::Note,
                    breach.kind == LimitBreach::Kind::TooFast ? "MOT004" : "MOT003",
                    sentence_of(breach, motion.skeleton));
  }
}

/// Puts a document that is not a motion (a body motion or a flow) on the robot.
void check_on_robot(const Document& document, const CheckOptions& options,
                    Diagnostics& diagnostics) {
  const auto placed = place(document, options.robot, options.lenient, diagnostics);
  if (placed) tell_breaches(placed->motion, diagnostics);
  if (!placed && !diagnostics.has_errors()) diagnostics.add(placed.error());
}

}  // namespace

void check(const Document& document, const CheckOptions& options, Diagnostics& diagnostics) {
  Diagnostics found;
  found.warnings_are_errors = diagnostics.warnings_are_errors;
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    note_sudden_turns(*motion, found);
    tell_breaches(*motion, found);
  } else if (options.robot && !has_skeleton(document)) {
    check_on_robot(document, options, found);
  }
  for (Diagnostic item : found.items()) {
    if (item.place.source.empty()) item.place.source = options.name;
    diagnostics.add(std::move(item));
  }
}

Result<void> check(const DocumentSource& source, const CheckOptions& options,
                   Diagnostics& diagnostics) {
  const auto document = source(diagnostics);
  if (document) {
    check(**document, options, diagnostics);
    return {};
  }
  // A fault of the file itself, and not of its content, is not in the diagnostics yet.
  if (!diagnostics.has_errors()) diagnostics.add(document.error());
  return fail(document.error());
}

}  // namespace kinefile
