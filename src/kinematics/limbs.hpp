// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "kinefile/motion.hpp"
#include "kinefile/world_poses.hpp"

namespace kinefile {

/// A leg: the line from its upper end to its lower one.
struct Leg {
  std::size_t top = 0;                            ///< the joint at which the leg begins
  std::size_t bottom = 0;                         ///< the last joint of the leg
  std::optional<std::size_t> tip = std::nullopt;  ///< instead of `bottom`, a tip (of all joints)
};

/// The number of joints below every joint, itself included; shape (joints).
std::vector<std::size_t> subtree_sizes(const Skeleton& skeleton);

/// The joints of a kind that have none of it below them, in skeleton order.
/// \param is_of_kind  shape (joints)
std::vector<std::size_t> last_of_kind(const Skeleton& skeleton,
                                      const std::vector<bool>& is_of_kind);

/// The legs of a skeleton, found by the names of joints, in English and Japanese.
std::vector<Leg> find_legs(const Skeleton& skeleton);

/// The pairs of halves where limbs leave the trunk: those that are apart at rest, and not below
/// other such pairs. Hips and shoulders show where left and right are; hands and feet swing.
/// \param pairs  the partner of every joint; kNoParent, or itself, if it has none
std::vector<std::size_t> pairs_on_trunk(const Skeleton& skeleton,
                                        const std::vector<std::size_t>& pairs);

/// Whether the legs hang down along an axis in the rest pose; nothing if there are none.
std::optional<bool> stands_at_rest(const Skeleton& skeleton, std::size_t up);

/// The unit vector from a leg's lower end to its upper one; zero if it has no length.
Vec3 direction_of(const Leg& leg, const PoseArrays& poses, std::size_t row);

/// Whether a name is that of a foot or a part of it.
bool is_called_foot(const std::string& name);

/// Evidence of a motion is that of every so many frames, from the first on: 64 at the most.
std::size_t step_of_samples(std::size_t num_frames);

/// At most 64 frames of a motion, placed in the world with tips; the rest pose if it has no frames.
WorldPoses sampled_poses(const Motion& motion);

/// The position of a joint or a tip in a row of poses.
Vec3 joint_position(const PoseArrays& poses, std::size_t row, std::size_t joint);
Vec3 tip_position(const PoseArrays& poses, std::size_t row, std::size_t tip);

}  // namespace kinefile
