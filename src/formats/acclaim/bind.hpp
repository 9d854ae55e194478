// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/acclaim/kept.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"
#include "kinefile/result.hpp"

namespace kinefile::acclaim {

/// How the syntax of a skeleton is interpreted.
struct BindOptions {
  bool forces_3dof = false;                      ///< bones that can turn get all three rotations
  double metres_per_quotient = kMetresPerInch;   ///< the unit of lengths after division by the unit
                                                 ///< of length; 0: unknown
  std::optional<std::size_t> up = std::nullopt;  ///< see `Skeleton::up`
};

/// The rotation of an orientation: "XYZ" gives Rz Ry Rx. Whole quarter turns are exact.
Mat3 rotation_of(const Orientation& orientation, AngleUnit unit);

/// The length of a vector, also where its square is infinite or 0.
double length_of(const Vec3& vector);

/// Where a bone ends, in its own frame, which has the world's axes in the rest pose.
Vec3 end_of(const Bone& bone);

/// The order of the bones in the model: that of the file, but parents first.
std::vector<std::size_t> parents_first(const AsfFile& file);

/// Makes the skeleton of an ASF file. Joint 0 is the root; the joints after it are the bones in the
/// order of `parents_first`. The joint of a bone is at its start, the tip at its end; it keeps the
/// `Bone`, and joint 0 keeps the `Root`. Limits belong to the words of `dof`, in order.
Skeleton bind(const AsfFile& file, const BindOptions& options);

/// Sets the unit of the motion's angles, which differs from the skeleton file's; limits are
/// converted to it.
void tell_angles_in(AngleUnit unit, Skeleton& skeleton);

/// The columns of the bones that have any.
std::vector<BoneColumns> columns_of_bones(const Skeleton& skeleton);

/// The ASF form of a skeleton, and the map from its clip to the lines of an AMC file.
struct Unbound {
  AsfFile file;
  bool forces_3dof = false;
  /// The clip's columns for the values of the root and then of each bone of `file`.
  std::vector<std::vector<std::size_t>> columns;
};

/// Finds the ASF form of a skeleton: the opposite of `bind`. The data from the file that it was
/// read from, in `kept` and in its joints, is used as far as it is still valid.
/// \errors ASF020 (DataLoss) if a joint is or moves in a way that ASF cannot express
Result<Unbound> unbind(const Skeleton& skeleton, const KeptFile& kept);

}  // namespace kinefile::acclaim
