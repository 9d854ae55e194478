// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "kinefile/math.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

enum class ShapeKind {
  Box,
  Cylinder,  ///< along z
  Sphere,
  Capsule,  ///< along z: a cylinder between two half-spheres
  Cone,     ///< along z, its apex at +z
};

/// A primitive shape that shows what a link of a robot looks like. It is fixed in its joint's
/// frame: joint_from_shape = T(position) rotation. Its own frame is in the middle of its bounding
/// box.
struct VisualShape {
  ShapeKind kind = ShapeKind::Box;
  /// The full extents of its bounding box along its own axes, a capsule's caps included, in the
  /// skeleton's unit of length; finite, 0 or above. If those across z differ, the shape is
  /// elliptic; a sphere may be an ellipsoid.
  Vec3 size = Vec3::Ones();
  Vec3 position = Vec3::Zero();  ///< of the middle of its bounding box
  Quat rotation = Quat::Identity();
  std::optional<Vec3> colour = std::nullopt;  ///< red, green and blue, 0 to 1; absent: not in the
                                              ///< file
};

/// The same shape in another frame.
/// \param new_from_old  the rotation from the old frame's axes to those of the new one
/// \param origin        the place of the old frame in the new one
VisualShape in_other_frame(VisualShape shape, const Quat& new_from_old, const Vec3& origin);

}  // namespace kinefile

#pragma GCC visibility pop
