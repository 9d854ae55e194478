// SPDX-License-Identifier: MIT
#include "kinefile/visual_shape.hpp"

namespace kinefile {

VisualShape in_other_frame(VisualShape shape, const Quat& new_from_old, const Vec3& origin) {
  shape.position = origin + new_from_old * shape.position;
  shape.rotation = (new_from_old * shape.rotation).normalized();
  return shape;
}

}  // namespace kinefile
