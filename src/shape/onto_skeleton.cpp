// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/words.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/shape.hpp"
#include "kinematics/joint_columns.hpp"
#include "model/joint_names.hpp"

namespace kinefile::shape {
namespace {

void warn(Diagnostics& diagnostics, std::string message) {
  diagnostics.add(Severity::Warning, "BRG006", std::move(message));
}

/// The joints that belong together. The first joints, which are roots, do whatever their names.
std::vector<JointPair> match_with_roots(const Skeleton& from, const Skeleton& to) {
  if (from.joints.empty() || to.joints.empty()) return {};
  std::vector<JointPair> pairs = {{0, 0}};
  for (const JointPair pair : match_joints(from, to)) {
    if (pair.first != 0 && pair.second != 0) pairs.push_back(pair);
  }
  // The roots alone make no match, unless there is nothing else.
  const bool is_real = pairs.size() > 1 || from.joints.size() == 1 || to.joints.size() == 1;
  return is_real ? pairs : std::vector<JointPair>{};
}

/// How a joint's frame is turned in the world at rest.
struct RestFrame {
  Quat parent = Quat::Identity();     ///< its parent's
  Quat unturned = Quat::Identity();   ///< its own where its angles are 0
  Quat rest_turn = Quat::Identity();  ///< what its angles at rest add to that
  Quat turned() const { return unturned * rest_turn; }
};

std::vector<RestFrame> rest_frames_of(const Skeleton& skeleton) {
  std::vector<RestFrame> frames;
  for (const Joint& joint : skeleton.joints) {
    RestFrame frame;
    if (joint.parent != kNoParent) frame.parent = frames[joint.parent].turned();
    frame.unturned = frame.parent * joint.rest_rotation;
    for (const DegreeOfFreedom& dof : rotations_of(joint)) {
      const double angle = dof.rest * radians_per(skeleton.angle_unit);
      if (angle != 0) frame.rest_turn = frame.rest_turn * Quat(Eigen::AngleAxisd(angle, dof.axis));
    }
    frames.push_back(frame);
  }
  return frames;
}

/// Degrees of freedom of one kind, outermost first.
std::vector<DegreeOfFreedom> dofs_of(const Joint& joint, DofKind kind) {
  std::vector<DegreeOfFreedom> dofs;
  std::copy_if(joint.dofs.begin(), joint.dofs.end(), std::back_inserter(dofs),
               [kind](const DegreeOfFreedom& dof) { return dof.kind == kind; });
  return dofs;
}

/// How the values of one joint's degrees of freedom of a kind become another's.
struct Transfer {
  std::vector<DegreeOfFreedom> from;
  std::vector<DegreeOfFreedom> to;
  Mat3 to_from = Mat3::Identity();  ///< from the frame that the ones' axes are in to the others'
  double factor = 1;                ///< between the units
  bool are_copied = false;          ///< both do the same by the same values
};

Transfer transfer_of(const Joint& source, const Joint& target, DofKind kind, const Quat& to_from,
                     double factor) {
  Transfer transfer{dofs_of(source, kind), dofs_of(target, kind), to_from.toRotationMatrix(),
                    factor, false};
  const auto is_same = [&](const DegreeOfFreedom& a, const DegreeOfFreedom& b) {
    return (transfer.to_from * a.axis - b.axis).norm() <= kSameDirection &&
           std::abs(a.rest * factor - b.rest) <= kSameDirection * std::abs(b.rest);
  };
  transfer.are_copied = std::equal(transfer.from.begin(), transfer.from.end(), transfer.to.begin(),
                                   transfer.to.end(), is_same);
  return transfer;
}

void copy_values(const Transfer& transfer, std::span<const double> from, std::span<double> to) {
  for (std::size_t k = 0; k < transfer.to.size(); ++k) {
    const double value = from[transfer.from[k].coordinate];
    to[transfer.to[k].coordinate] = transfer.factor == 1 ? value : transfer.factor * value;
  }
}

std::vector<TranslationColumn> columns_along(const std::vector<DegreeOfFreedom>& dofs) {
  std::vector<TranslationColumn> columns;
  for (const DegreeOfFreedom& dof : dofs) columns.push_back({dof.axis, dof.coordinate});
  return columns;
}

Vec3 at_rest(const std::vector<DegreeOfFreedom>& translations) {
  Vec3 sum = Vec3::Zero();
  for (const DegreeOfFreedom& dof : translations) sum += dof.rest * dof.axis;
  return sum;
}

/// Translates a joint, or its tail, as far from its rest position as another's is from its own.
/// \param more  how much further, in the target's frame
/// \returns     the distance that remains
double translate(const Transfer& transfer, const Vec3& more, std::span<const double> from,
                 std::span<double> to) {
  if (transfer.are_copied && more.isZero(0)) {
    copy_values(transfer, from, to);
    return 0;
  }
  const Vec3 translation =
      position_in_row(-at_rest(transfer.from), columns_along(transfer.from), from);
  const Vec3 wanted = transfer.factor * (transfer.to_from * translation) + more;
  return fit_position(-at_rest(transfer.to), columns_along(transfer.to), wanted, to);
}

/// What one joint could not do as the other did.
struct Residual {
  double angle = 0;     ///< the largest, in radians
  double distance = 0;  ///< the largest, in the unit of the other skeleton
  bool is_scaled = false;
};

/// Two skeletons of which one takes over the motion of the other.
struct Sides {
  const Motion& from;
  std::vector<RestFrame> from_rest;
  std::vector<RestFrame> to_rest;
  double scale = 1;  ///< between the units of length
};

/// The rotations of a joint. It turns from its rest pose as the source does from its own: in the
/// world's axes the turns are the same.
class Turn {
 public:
  Turn(const Sides& sides, const Motion& result, JointPair pair)
      : unit_(sides.from.skeleton.angle_unit), to_unit_(result.skeleton.angle_unit) {
    const RestFrame& from = sides.from_rest[pair.first];
    const RestFrame& to = sides.to_rest[pair.second];
    const Quat to_from = to.unturned.conjugate() * from.unturned;
    const double factor = unit_ == to_unit_ ? 1 : radians_per(unit_) / radians_per(to_unit_);
    transfer_ =
        transfer_of(sides.from.skeleton.joints[pair.first], result.skeleton.joints[pair.second],
                    DofKind::Rotation, to_from, factor);
    right_ = (from.rest_turn.conjugate() * to_from.conjugate() * to.rest_turn).toRotationMatrix();
  }

  /// \param before  the row before, or the same one in the first frame
  /// \returns       the angle that remains, in radians
  double apply(std::span<const double> from, std::span<const double> before,
               std::span<double> to) const {
    if (transfer_.are_copied) {
      copy_values(transfer_, from, to);
      return 0;
    }
    for (const DegreeOfFreedom& dof : transfer_.to) {  // near the frame before
      if (std::isfinite(before[dof.coordinate])) to[dof.coordinate] = before[dof.coordinate];
    }
    const Mat3 rotation = transfer_.to_from * rotation_in_row(transfer_.from, from, unit_) * right_;
    if (rotation.allFinite()) return fit_rotation(transfer_.to, rotation, to_unit_, to);
    for (const DegreeOfFreedom& dof : transfer_.to) to[dof.coordinate] = std::nan("");
    return 0;
  }

 private:
  AngleUnit unit_;
  AngleUnit to_unit_;
  Transfer transfer_;
  Mat3 right_ = Mat3::Identity();
};

/// Moves one matched joint, frame by frame.
Residual move_joint(const Sides& sides, JointPair pair, Motion& result) {
  const Joint& source = sides.from.skeleton.joints[pair.first];
  const Joint& target = result.skeleton.joints[pair.second];
  const RestFrame& from_rest = sides.from_rest[pair.first];
  const RestFrame& to_rest = sides.to_rest[pair.second];
  const Turn turn(sides, result, pair);
  const auto transfer = [&](DofKind kind, const Quat& to_from, double factor) {
    return transfer_of(source, target, kind, to_from, factor);
  };
  const Transfer place = transfer(DofKind::Translation,
                                  to_rest.unturned.conjugate() * from_rest.unturned, sides.scale);
  const Quat tail_turn = to_rest.turned().conjugate() * from_rest.turned();
  const Transfer tail = transfer(DofKind::TailTranslation, tail_turn, sides.scale);
  const Transfer scales = transfer(DofKind::TailScale, tail_turn, 1);
  // Roots go where the others are; other joints are as far from where they rest.
  const bool are_roots = source.parent == kNoParent && target.parent == kNoParent;
  Vec3 more = Vec3::Zero();
  if (are_roots) {
    const Vec3 apart = place.are_copied
                           ? Vec3(sides.scale * source.offset - target.offset)
                           : Vec3(sides.scale * rest_offset(source) - rest_offset(target));
    if (!apart.isZero(0)) more = target.rest_rotation.conjugate() * apart;
  }
  Residual residual;
  residual.is_scaled =
      !scales.are_copied &&
      std::any_of(scales.from.begin(), scales.from.end(), [&sides](const DegreeOfFreedom& dof) {
        return !is_always(sides.from.clip, dof.coordinate, dof.rest);
      });
  const Rows rows = result.clip.mutate();
  for (std::size_t f = 0; f < sides.from.clip.num_frames; ++f) {
    const auto from = sides.from.clip.row(f);
    const std::span<double> row = rows[f];
    residual.distance = std::max({residual.distance, translate(place, more, from, row),
                                  translate(tail, Vec3::Zero(), from, row)});
    residual.angle = std::max(residual.angle, turn.apply(from, rows[f > 0 ? f - 1 : 0], row));
    if (scales.are_copied) copy_values(scales, from, row);
  }
  return residual;
}

bool moves_freely(const Skeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [](const Joint& joint) { return kinefile::moves_freely(joint); });
}

void tell_unmatched(const Motion& motion, const Skeleton& skeleton,
                    const std::vector<JointPair>& pairs, Diagnostics& diagnostics) {
  std::vector<bool> is_used(motion.skeleton.joints.size(), false);
  std::vector<bool> is_moved(skeleton.joints.size(), false);
  for (const JointPair pair : pairs) {
    is_used[pair.first] = true;
    is_moved[pair.second] = true;
  }
  std::vector<std::string> left_out;
  std::vector<std::string> at_rest;
  for (std::size_t j = 0; j < is_used.size(); ++j) {
    const Joint& joint = motion.skeleton.joints[j];
    if (!is_used[j] && !joint.dofs.empty()) left_out.push_back(joint.name);
  }
  for (std::size_t j = 0; j < is_moved.size(); ++j) {
    if (!is_moved[j] && !skeleton.joints[j].dofs.empty())
      at_rest.push_back(skeleton.joints[j].name);
  }
  if (!left_out.empty()) {
    warn(diagnostics,
         "joints that the other skeleton does not have are left out: " + listed(left_out));
  }
  if (!at_rest.empty()) {
    warn(diagnostics, "joints that only the other skeleton has rest: " + listed(at_rest));
  }
}

}  // namespace

Result<Motion> onto_skeleton(const Motion& motion, const Skeleton& skeleton,
                             Diagnostics& diagnostics) {
  const std::vector<JointPair> pairs = match_with_roots(motion.skeleton, skeleton);
  if (pairs.empty() || moves_freely(motion.skeleton) || moves_freely(skeleton)) {
    return fail(make_error(ErrorKind::Usage, "BRG004",
                           pairs.empty() ? "no joint of the motion has the name of one of the "
                                           "skeleton"
                                         : "a joint moves freely, which this cannot bring over"));
  }
  Motion result;
  result.skeleton = skeleton;
  result.clip.timeline = motion.clip.timeline;
  result.clip.num_frames = motion.clip.num_frames;
  result.clip.num_coordinates = skeleton.coordinates.size();
  const std::vector<double> rest = rest_coordinates(skeleton);
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    result.clip.values.append(rest);
  }
  const double from_unit = motion.skeleton.metres_per_unit;
  const bool has_units = from_unit > 0 && skeleton.metres_per_unit > 0;
  if (!has_units) {
    warn(diagnostics,
         "a file does not say its unit of length, so positions are taken over as they "
         "are (--unit-in says it)");
  }
  const double scale = has_units ? from_unit / skeleton.metres_per_unit : 1.0;
  constexpr double kNoticeable = 1e-6;
  const Sides sides{motion, rest_frames_of(motion.skeleton), rest_frames_of(skeleton), scale};
  for (const JointPair pair : pairs) {
    const Residual residual = move_joint(sides, pair, result);
    const std::string& name = skeleton.joints[pair.second].name;
    if (residual.angle > kNoticeable) {
      warn(diagnostics, fmt::format("joint '{}' cannot turn as it did: up to {:.3g} degrees are "
                                    "left out",
                                    name, residual.angle / kRadiansPerDegree));
    }
    if (residual.distance > kNoticeable) {
      warn(diagnostics, fmt::format("joint '{}' cannot move as it did: up to {:.3g} units of "
                                    "length are left out",
                                    name, residual.distance));
    }
    if (residual.is_scaled) {
      warn(diagnostics, fmt::format("joint '{}' cannot be scaled as it was", name));
    }
  }
  tell_unmatched(motion, skeleton, pairs, diagnostics);
  return result;
}

}  // namespace kinefile::shape
