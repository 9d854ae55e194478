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

/// The matching joints. The first joints, which are roots, match regardless of their names.
std::vector<JointPair> match_with_roots(const Skeleton& from, const Skeleton& to) {
  if (from.joints.empty() || to.joints.empty()) return {};
  std::vector<JointPair> pairs = {{0, 0}};
  for (const JointPair pair : match_joints(from, to)) {
    if (pair.first != 0 && pair.second != 0) pairs.push_back(pair);
  }
  // If only the roots match, this is no match, unless there are no other joints.
  const bool is_real = pairs.size() > 1 || from.joints.size() == 1 || to.joints.size() == 1;
  return is_real ? pairs : std::vector<JointPair>{};
}

/// The rotation of a joint's frame in the world at rest.
struct RestFrame {
  Quat parent = Quat::Identity();     ///< its parent's
  Quat unturned = Quat::Identity();   ///< its own if its angles are 0
  Quat rest_turn = Quat::Identity();  ///< the rotation by its angles at rest
  Quat turned() const { return unturned * rest_turn; }
};

std::vector<RestFrame> rest_frames_of(const Skeleton& skeleton) {
  std::vector<RestFrame> frames;
  for (const Joint& joint : skeleton.joints) {
    RestFrame frame;
    if (joint.parent != kNoParent) frame.parent = frames[joint.parent].turned();
    frame.unturned = frame.parent * joint.rest_rotation;
    frame.rest_turn = rotation_at_rest(joint, skeleton.angle_unit);
    frames.push_back(frame);
  }
  return frames;
}

/// Degrees of freedom of one kind, outermost first; rotations include a ball and a rotation vector.
std::vector<DegreeOfFreedom> dofs_of(const Joint& joint, DofKind kind) {
  if (kind == DofKind::Rotation) return rotations_of(joint);
  std::vector<DegreeOfFreedom> dofs;
  std::copy_if(joint.dofs.begin(), joint.dofs.end(), std::back_inserter(dofs),
               [kind](const DegreeOfFreedom& dof) { return dof.kind == kind; });
  return dofs;
}

/// How the values of one joint's degrees of freedom of a kind are converted to another's.
struct Transfer {
  std::vector<DegreeOfFreedom> from;
  std::vector<DegreeOfFreedom> to;
  Mat3 to_from = Mat3::Identity();  ///< from the frame of the source axes to that of the target
                                    ///< axes
  double factor = 1;                ///< between the units
  bool are_copied = false;          ///< both have the same motion from the same values
  std::vector<bool> follows;        ///< which of `to` follow another joint
};

bool follows_any(const Transfer& transfer) {
  return std::find(transfer.follows.begin(), transfer.follows.end(), true) !=
         transfer.follows.end();
}

/// Whether two degrees of freedom have the same motion from the same values.
bool do_the_same(const DegreeOfFreedom& a, const DegreeOfFreedom& b, const Mat3& b_from_a,
                 double factor) {
  if (a.kind != b.kind) return false;
  if (num_coordinates(a) > 1) return (b_from_a - Mat3::Identity()).norm() <= kSameDirection;
  const double rest = value_of(b, b.rest);
  return (b_from_a * a.axis - b.axis).norm() <= kSameDirection &&
         std::abs(value_of(a, a.rest) * factor - rest) <= kSameDirection * std::abs(rest);
}

void copy_value(const DegreeOfFreedom& from, const DegreeOfFreedom& to, double factor,
                std::span<const double> row, std::span<double> result) {
  if (num_coordinates(from) == 1) {
    result[to.coordinate] = carried_over(from, to, factor, row[from.coordinate]);
    return;
  }
  const double scale = from.kind == DofKind::RotationVector ? factor : 1;
  for (std::size_t k = 0; k < num_coordinates(from); ++k) {
    result[to.coordinate + k] = scale * row[from.coordinate + k];
  }
}

void copy_values(const Transfer& transfer, std::span<const double> from, std::span<double> to) {
  for (std::size_t k = 0; k < transfer.to.size(); ++k) {
    if (transfer.follows[k]) continue;
    copy_value(transfer.from[k], transfer.to[k], transfer.factor, from, to);
  }
}

std::vector<Translation> along_axes(const std::vector<DegreeOfFreedom>& dofs) {
  std::vector<Translation> translations;
  for (const DegreeOfFreedom& dof : dofs) translations.push_back({dof.axis, dof});
  return translations;
}

Vec3 at_rest(const std::vector<DegreeOfFreedom>& translations) {
  Vec3 sum = Vec3::Zero();
  for (const DegreeOfFreedom& dof : translations) sum += value_of(dof, dof.rest) * dof.axis;
  return sum;
}

/// What to do with a row of the new motion.
enum class Pass {
  Write,    ///< compute its numbers
  Measure,  ///< compute the residuals
};

/// Gives a joint, or its tail, the same translation from its rest position as another joint.
/// \param more  an additional translation, in the target's frame
/// \returns     the residual distance
double translate(const Transfer& transfer, const Vec3& more, Pass pass,
                 std::span<const double> from, std::span<double> to) {
  if (pass == Pass::Write && transfer.are_copied && more.isZero(0)) {
    copy_values(transfer, from, to);
    return 0;
  }
  const Vec3 translation =
      position_in_row(-at_rest(transfer.from), along_axes(transfer.from), from);
  const Vec3 wanted = transfer.factor * (transfer.to_from * translation) + more;
  const Vec3 start = -at_rest(transfer.to);
  const auto translations = along_axes(transfer.to);
  if (pass == Pass::Measure) return (position_in_row(start, translations, to) - wanted).norm();
  return fit_position(start, translations, wanted, to, transfer.follows);
}

/// The residuals of a joint.
struct Residual {
  double angle = 0;     ///< the largest, in radians
  double distance = 0;  ///< the largest, in the unit of the other skeleton
  bool is_scaled = false;
};

/// Two skeletons, of which one gets the motion of the other.
struct Sides {
  const Motion& from;
  std::vector<RestFrame> from_rest;
  std::vector<RestFrame> to_rest;
  std::vector<std::size_t> to_leaders;  ///< of columns
  double scale = 1;                     ///< between the units of length
};

/// \param kind  of the degrees of freedom; rotations include balls and rotation vectors
Transfer transfer_of(const Sides& sides, const Skeleton& to, JointPair pair, DofKind kind,
                     const Quat& to_from, double factor) {
  Transfer transfer{dofs_of(sides.from.skeleton.joints[pair.first], kind),
                    dofs_of(to.joints[pair.second], kind),
                    to_from.toRotationMatrix(),
                    factor,
                    false,
                    {}};
  transfer.are_copied =
      std::equal(transfer.from.begin(), transfer.from.end(), transfer.to.begin(), transfer.to.end(),
                 [&](const DegreeOfFreedom& a, const DegreeOfFreedom& b) {
                   return do_the_same(a, b, transfer.to_from, factor);
                 });
  transfer.follows = following_dofs(transfer.to, pair.second, sides.to_leaders);
  return transfer;
}

/// The rotations of a joint. It gets the same rotation relative to its rest pose as the source: the
/// two are equal in the world's axes.
class Turn {
 public:
  Turn(const Sides& sides, const Motion& result, JointPair pair)
      : unit_(sides.from.skeleton.angle_unit), to_unit_(result.skeleton.angle_unit) {
    const RestFrame& from = sides.from_rest[pair.first];
    const RestFrame& to = sides.to_rest[pair.second];
    const Quat to_from = to.unturned.conjugate() * from.unturned;
    const double factor = unit_ == to_unit_ ? 1 : radians_per(unit_) / radians_per(to_unit_);
    transfer_ = transfer_of(sides, result.skeleton, pair, DofKind::Rotation, to_from, factor);
    right_ = (from.rest_turn.conjugate() * to_from.conjugate() * to.rest_turn).toRotationMatrix();
  }

  /// \param before  the previous row, or the same one in the first frame
  /// \returns       the residual angle, in radians
  double apply(Pass pass, std::span<const double> from, std::span<const double> before,
               std::span<double> to) const {
    if (pass == Pass::Write && transfer_.are_copied) {
      copy_values(transfer_, from, to);
      return 0;
    }
    const Mat3 rotation = transfer_.to_from * rotation_in_row(transfer_.from, from, unit_) * right_;
    if (pass == Pass::Measure) {
      const double angle =
          angle_between(Quat(rotation), quaternion_in_row(transfer_.to, to, to_unit_));
      return std::isfinite(angle) ? angle : 0;
    }
    start_near(before, to);
    if (rotation.allFinite()) {
      return fit_rotation(transfer_.to, rotation, to_unit_, to, transfer_.follows);
    }
    for (const std::size_t column : led_columns()) to[column] = std::nan("");
    return 0;
  }

  bool follows() const { return follows_any(transfer_); }

 private:
  std::vector<std::size_t> led_columns() const {
    std::vector<std::size_t> columns;
    for (std::size_t d = 0; d < transfer_.to.size(); ++d) {
      const DegreeOfFreedom& dof = transfer_.to[d];
      for (std::size_t k = 0; !transfer_.follows[d] && k < num_coordinates(dof); ++k) {
        columns.push_back(dof.coordinate + k);
      }
    }
    return columns;
  }

  /// Numbers are computed near those of the previous frame.
  void start_near(std::span<const double> before, std::span<double> to) const {
    for (const std::size_t column : led_columns()) {
      if (std::isfinite(before[column])) to[column] = before[column];
    }
  }

  AngleUnit unit_;
  AngleUnit to_unit_;
  Transfer transfer_;
  Mat3 right_ = Mat3::Identity();
};

/// Gives one joint the motion of another.
class Mover {
 public:
  Mover(const Sides& sides, const Motion& result, JointPair pair)
      : sides_(sides), turn_(sides, result, pair) {
    const Joint& source = sides.from.skeleton.joints[pair.first];
    const Joint& target = result.skeleton.joints[pair.second];
    const RestFrame& from_rest = sides.from_rest[pair.first];
    const RestFrame& to_rest = sides.to_rest[pair.second];
    const auto transfer = [&](DofKind kind, const Quat& to_from, double factor) {
      return transfer_of(sides, result.skeleton, pair, kind, to_from, factor);
    };
    place_ = transfer(DofKind::Translation, to_rest.unturned.conjugate() * from_rest.unturned,
                      sides.scale);
    const Quat tail_turn = to_rest.turned().conjugate() * from_rest.turned();
    tail_ = transfer(DofKind::TailTranslation, tail_turn, sides.scale);
    scales_ = transfer(DofKind::TailScale, tail_turn, 1);
    // Roots get the positions of the source roots; other joints get the same translation from rest.
    if (source.parent != kNoParent || target.parent != kNoParent) return;
    const Vec3 apart = place_.are_copied
                           ? Vec3(sides.scale * source.offset - target.offset)
                           : Vec3(sides.scale * rest_offset(source) - rest_offset(target));
    if (!apart.isZero(0)) more_ = target.rest_rotation.conjugate() * apart;
  }

  /// Whether the joint follows others, so that its pose is known only after all have moved.
  bool follows() const {
    return turn_.follows() || follows_any(place_) || follows_any(tail_) || follows_any(scales_);
  }

  Residual apply(Pass pass, Motion& result) const {
    Residual residual;
    residual.is_scaled = is_scale_lost();
    const Rows rows = result.clip.mutate();
    for (std::size_t f = 0; f < sides_.from.clip.num_frames; ++f) {
      const auto from = sides_.from.clip.row(f);
      const std::span<double> row = rows[f];
      residual.distance = std::max({residual.distance, translate(place_, more_, pass, from, row),
                                    translate(tail_, Vec3::Zero(), pass, from, row)});
      residual.angle =
          std::max(residual.angle, turn_.apply(pass, from, rows[f > 0 ? f - 1 : 0], row));
      if (pass == Pass::Write && scales_.are_copied) copy_values(scales_, from, row);
    }
    return residual;
  }

 private:
  bool is_scale_lost() const {
    return !scales_.are_copied &&
           std::any_of(scales_.from.begin(), scales_.from.end(), [this](const auto& dof) {
             return !is_always(sides_.from.clip, dof.coordinate, dof.rest);
           });
  }

  const Sides& sides_;
  Turn turn_;
  Transfer place_;
  Transfer tail_;
  Transfer scales_;
  Vec3 more_ = Vec3::Zero();
};

bool moves_freely(const Skeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [](const Joint& joint) { return kinefile::moves_freely(joint); });
}

void report_unmatched(const Motion& motion, const Skeleton& skeleton,
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
  const Sides sides{motion, rest_frames_of(motion.skeleton), rest_frames_of(skeleton),
                    leaders_of_columns(skeleton), scale};
  std::vector<Residual> residuals;
  for (const JointPair pair : pairs) {
    residuals.push_back(Mover(sides, result, pair).apply(Pass::Write, result));
  }
  fill_following_columns(result, 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const JointPair pair = pairs[i];
    const Mover mover(sides, result, pair);
    const Residual residual = mover.follows() ? mover.apply(Pass::Measure, result) : residuals[i];
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
  report_unmatched(motion, skeleton, pairs, diagnostics);
  return result;
}

}  // namespace kinefile::shape
