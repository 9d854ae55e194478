// SPDX-License-Identifier: MIT
#include <algorithm>

#include "document/conventions.hpp"
#include "kinefile/convert.hpp"
#include "kinefile/operation.hpp"
#include "kinefile/robot.hpp"
#include "kinefile/shape.hpp"
#include "shape/frame_change.hpp"

namespace kinefile {
namespace {

/// The order that Acclaim's bones turn in, and the usual one of BVH files made from them.
constexpr shape::RotationOrder kUsualOrder = {2, 1, 0};

bool turns_at_rest(const Joint& joint) {
  return !joint.rest_rotation.isApprox(Quat::Identity(), 0);
}

bool asks_for_channels(const shape::ChannelOptions& channels) {
  return channels.order || channels.positions.value_or(shape::PositionChannels::AsIs) !=
                               shape::PositionChannels::AsIs;
}

/// The motion with its angles in degrees. One degree of freedom reads each column, and its value is
/// the column's number.
Motion in_degrees(Motion motion) {
  if (motion.skeleton.angle_unit == AngleUnit::Degrees) return motion;
  motion.skeleton.angle_unit = AngleUnit::Degrees;
  for (Joint& joint : motion.skeleton.joints) {
    for (DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::Rotation) continue;
      for (double* value : {&dof.rest, &dof.lower, &dof.upper, &dof.max_speed}) {
        *value /= kRadiansPerDegree;
      }
      for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
        motion.clip.mutate()[f][dof.coordinate] /= kRadiansPerDegree;
      }
    }
  }
  return motion;
}

/// The same skeleton with an end on every joint without children, which many BVH readers require.
Motion with_ends(Motion motion) {
  const auto children = children_of_joints(motion.skeleton);
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
    Joint& joint = motion.skeleton.joints[j];
    if (children[j].empty() && joint.tips.empty()) joint.tips.push_back({{}, Vec3::Zero()});
  }
  return motion;
}

/// Puts a changed motion in the place of the motion, so that no more of them are kept than needed.
template <class AnyMotion>
Result<void> put(Result<AnyMotion> changed, AnyMotion& motion) {
  if (!changed) return fail(std::move(changed.error()));
  motion = std::move(*changed);
  return {};
}

/// Angles rotate with their joints' frames; quaternions cannot.
template <class AnyMotion>
AnyMotion with_usual_angles(const AnyMotion& motion) {
  return shape::with_angles(shape::with_plain_values(motion), kUsualOrder);
}

Result<Motion> for_bvh(Motion motion, shape::ChannelOptions channels, Diagnostics& diagnostics) {
  motion = robot::without_free_joints(with_ends(std::move(motion)));
  motion = with_usual_angles(motion);
  auto done = put(shape::with_world_aligned_rest(motion), motion);
  if (!done) return fail(std::move(done.error()));
  done = put(shape::without_tail_translations(motion, channels.lenient, diagnostics), motion);
  if (!done) return fail(std::move(done.error()));
  motion = shape::without_inner_tips(motion);
  channels.usual_order = kUsualOrder;
  channels.replaces_offsets = true;  // as BVH files are read
  done = put(shape::with_channels(motion, channels, diagnostics), motion);
  if (!done) return fail(std::move(done.error()));
  return in_degrees(shape::without_unread_columns(motion));
}

/// A motion in memory, or one whose frames are read when they are asked for.
template <class AnyMotion>
Result<AnyMotion> for_bones(AnyMotion motion, shape::ChannelOptions channels,
                            Diagnostics& diagnostics) {
  motion = with_usual_angles(motion);
  const auto& joints = shape::skeleton_in(motion).joints;
  const bool is_turned = std::any_of(joints.begin(), joints.end(), [](const Joint& joint) {
    return joint.parent != kNoParent && turns_at_rest(joint);
  });
  if (is_turned) {
    auto aligned = put(shape::with_world_aligned_rest(motion), motion);
    if (!aligned) return fail(std::move(aligned.error()));
  }
  // A bone does not turn twice about the same axis, or move twice along one.
  const auto& aligned = shape::skeleton_in(motion).joints;
  const bool has_repeated_axes =
      std::any_of(aligned.begin(), aligned.end(), shape::repeats_an_axis);
  if (has_repeated_axes || asks_for_channels(channels)) {
    channels.usual_order = kUsualOrder;
    channels.distinct_axes = true;
    auto changed = put(shape::with_channels(motion, channels, diagnostics), motion);
    if (!changed) return fail(std::move(changed.error()));
  }
  return shape::with_bones(motion, channels.lenient, diagnostics);
}

/// The channels that a document gets: those that are asked for, otherwise what the readers of its
/// new format expect.
shape::ChannelOptions expected_channels(const Format& format, const Document& document,
                                        shape::ChannelOptions channels) {
  if (!format.conventions.has_whole_channels || document.format == format.name) return channels;
  channels.usual_positions = shape::PositionChannels::RootAndOwn;
  channels.distinct_axes = !channels.positions && !channels.order;
  return channels;
}

bool becomes_bvh(const Format& format, const Document& document) {
  return !format.conventions.turns_at_rest && document.format != format.name;
}

/// Whether a document is converted from a format with bones to one without.
bool leaves_bones(const Format& format, const Document& document) {
  const Format* from = find_format(document.format);
  return from != nullptr && from->conventions.has_one_end && !format.conventions.has_one_end &&
         has_skeleton(document);
}

}  // namespace

Document without_helper_bones(const Format& format, Document document, Diagnostics& diagnostics) {
  if (!leaves_bones(format, document)) return document;
  put_motion(shape::without_helper_bones(still_or_moving(document), diagnostics), document);
  return document;
}

Result<Document> adapted_to(const Format& format, Document document,
                            const shape::ChannelOptions& channels, Diagnostics& diagnostics) {
  auto steady = at_steady_rate(format, std::move(document), channels.lenient, diagnostics);
  if (!steady) return steady;
  document = std::move(*steady);
  const bool is_for_bones = format.conventions.has_one_end;
  const bool is_for_bvh = becomes_bvh(format, document);
  if (!is_for_bones && !is_for_bvh && !asks_for_channels(channels)) return document;
  if (!has_skeleton(document)) {
    return fail(wrong_kind(document, "a motion or a skeleton, which have channels"));
  }
  if (auto valid = validate(document); !valid) return fail(std::move(valid.error()));
  document = without_helper_bones(format, std::move(document), diagnostics);
  const shape::ChannelOptions wanted = expected_channels(format, document, channels);
  auto adapted = change_motion(document, [&](Motion motion) {
    if (is_for_bones) return for_bones(std::move(motion), wanted, diagnostics);
    if (is_for_bvh) return for_bvh(std::move(motion), wanted, diagnostics);
    return shape::with_channels(motion, wanted, diagnostics);
  });
  if (!adapted) return fail(std::move(adapted.error()));
  return document;
}

std::optional<Result<LongMotion>> adapted_in_blocks(const Format& format, const LongMotion& motion,
                                                    const shape::ChannelOptions& channels,
                                                    Diagnostics& diagnostics) {
  const Document& document = motion.document;
  const bool has_times = has_own_times(std::get<Motion>(document.content).clip.timeline);
  if (has_times || becomes_bvh(format, document) || leaves_bones(format, document)) {
    return std::nullopt;
  }
  if (!format.conventions.has_one_end && !asks_for_channels(channels)) return motion;
  if (auto valid = validate(document); !valid) return fail(std::move(valid.error()));
  const shape::ChannelOptions wanted = expected_channels(format, document, channels);
  return format.conventions.has_one_end ? for_bones(motion, wanted, diagnostics)
                                        : shape::with_channels(motion, wanted, diagnostics);
}

bool are_written_alike(const Format& format, const Document& a, const Document& b) {
  const auto written = [&format](const Document& document) -> std::optional<std::string> {
    std::string text;
    Diagnostics ignored;
    const Sink sink = [&text](std::string_view piece) {
      text += piece;
      return true;
    };
    if (!format.write || !format.write(document, {}, sink, ignored)) return std::nullopt;
    std::erase(text, '\r');  // line ends do not count as a difference
    return text;
  };
  const auto first = written(a);
  return first && first == written(b);
}

Result<Document> on_skeleton_of(const Document& skeleton, Document document,
                                Diagnostics& diagnostics) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (motion == nullptr) {
    Error error = wrong_kind(document, "a motion to put on another skeleton");
    error.code = "CNV001";
    return fail(std::move(error));
  }
  if (!has_skeleton(skeleton)) return fail(wrong_kind(skeleton, "a skeleton to put a motion on"));
  auto moved = shape::onto_skeleton(*motion, skeleton_of(skeleton), diagnostics);
  if (!moved) return fail(std::move(moved.error()));
  document.content = std::move(*moved);
  document.kept = skeleton.kept;
  return document;
}

}  // namespace kinefile
