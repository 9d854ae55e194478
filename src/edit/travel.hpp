// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinefile/motion.hpp"
#include "kinematics/joint_columns.hpp"

namespace kinefile::edit {

/// A joint that carries the figure over the ground (see `find_travellers`). Its parent does not
/// move.
struct Traveller {
  std::size_t joint = 0;
  bool is_root = true;
  Quat world_from_parent = Quat::Identity();
  Vec3 parent_position = Vec3::Zero();
  Vec3 offset = Vec3::Zero();
  std::vector<Translation> translations = {};
};

/// The travellers of a motion, with their parents' poses in its first frame.
/// \param joints  of `find_travellers`
std::vector<Traveller> travellers_of(const Motion& motion, std::span<const std::size_t> joints);

/// The position of a traveller in the world.
Vec3 position_of(const Traveller& traveller, std::span<const double> row);

/// Moves a traveller to a position in the world.
void move_to(const Traveller& traveller, const Vec3& position, std::span<double> row);

/// A vector of the parent's frame in the world, and the other way round; the same bits for a root.
Vec3 to_world(const Traveller& traveller, const Vec3& vector);
Vec3 to_parent(const Traveller& traveller, const Vec3& vector);

}  // namespace kinefile::edit
