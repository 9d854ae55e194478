// SPDX-License-Identifier: MIT
#include <algorithm>

#include "kinefile/bridge.hpp"
#include "kinefile/channels.hpp"
#include "kinefile/convert.hpp"

namespace kinefile {
namespace {

/// The order that Acclaim's bones turn in, and the usual one of BVH files made from them.
constexpr RotationOrder kUsualOrder = {2, 1, 0};

bool turns_at_rest(const Joint& joint) {
  return !joint.rest_rotation.isApprox(Quat::Identity(), 0);
}

/// Whether a joint turns twice about one axis, as no bone can.
bool repeats_an_axis(const Joint& joint) {
  for (std::size_t a = 0; a < joint.dofs.size(); ++a) {
    for (std::size_t b = a + 1; b < joint.dofs.size(); ++b) {
      const bool are_rotations =
          joint.dofs[a].kind == DofKind::Rotation && joint.dofs[b].kind == DofKind::Rotation;
      if (are_rotations && joint.dofs[a].axis.cross(joint.dofs[b].axis).norm() < 0.5) return true;
    }
  }
  return false;
}

Result<Motion> for_bvh(Motion motion, bool lenient, Diagnostics& diagnostics) {
  auto aligned = with_world_aligned_rest(motion);
  if (!aligned) return aligned;
  auto inherited = without_tail_translations(*aligned, lenient, diagnostics);
  if (!inherited) return inherited;
  ChannelOptions options;
  options.usual_order = kUsualOrder;
  options.lenient = lenient;
  auto plain = with_channels(without_inner_tips(*inherited), options, diagnostics);
  if (!plain) return plain;
  return without_unread_columns(*plain);
}

Result<Motion> for_bones(Motion motion, bool lenient, Diagnostics& diagnostics) {
  const auto& joints = motion.skeleton.joints;
  const bool is_turned = std::any_of(joints.begin(), joints.end(), [](const Joint& joint) {
    return joint.parent != kNoParent && turns_at_rest(joint);
  });
  if (is_turned) {
    auto aligned = with_world_aligned_rest(motion);
    if (!aligned) return aligned;
    motion = std::move(*aligned);
  }
  if (std::any_of(motion.skeleton.joints.begin(), motion.skeleton.joints.end(), repeats_an_axis)) {
    ChannelOptions options;
    options.order = kUsualOrder;
    auto turned = with_channels(motion, options, diagnostics);
    if (!turned) return turned;
    motion = std::move(*turned);
  }
  return with_bones(motion, lenient, diagnostics);
}

}  // namespace

Result<Document> adapted_to(const Format& format, Document document, bool lenient,
                            Diagnostics& diagnostics) {
  const bool is_for_bones = format.name == "asf" || format.name == "amc";
  const bool is_for_bvh = format.name == "bvh";
  // What a BVH file was read as, BVH can write.
  const bool is_ready = !is_for_bones && (!is_for_bvh || document.format == "bvh");
  if (is_ready) return document;
  Motion* motion = std::get_if<Motion>(&document.content);
  Motion work = motion != nullptr ? std::move(*motion)
                                  : Motion{std::get<Skeleton>(std::move(document.content)), {}};
  work.clip.num_coordinates = work.skeleton.coordinates.size();
  auto adapted = is_for_bones ? for_bones(std::move(work), lenient, diagnostics)
                              : for_bvh(std::move(work), lenient, diagnostics);
  if (!adapted) return fail(std::move(adapted.error()));
  if (motion != nullptr) {
    document.content = std::move(*adapted);
  } else {
    document.content = std::move(adapted->skeleton);
  }
  return document;
}

}  // namespace kinefile
