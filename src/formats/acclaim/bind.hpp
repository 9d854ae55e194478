// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/acclaim/kept.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"
#include "kinefile/result.hpp"

namespace kinefile::acclaim {

/// How a skeleton is given its meaning.
struct BindOptions {
  bool forces_3dof = false;                     ///< bones that can turn, turn about all three axes
  double metres_per_quotient = kMetresPerInch;  ///< what lengths divided by the unit of length are
                                                ///< in; 0: nobody knows
};

/// The rotation of an orientation: "XYZ" makes Rz Ry Rx. Whole quarter turns are exact.
Mat3 rotation_of(const Orientation& orientation, AngleUnit unit);

/// Where a bone ends, in its own frame, which has the world's axes in the rest pose.
Vec3 end_of(const Bone& bone);

/// The order in which the model has the bones: that of the file, but parents first.
std::vector<std::size_t> parents_first(const AsfFile& file);

/// Gives a skeleton its meaning. Joint 0 is the root; the joints behind it are the bones in the
/// order of `parents_first`. A bone's joint is where it starts, its tip where it ends; it keeps the
/// `Bone`, and the first one the `Root`. Limits belong to the words of `dof`, one after the other.
Skeleton bind(const AsfFile& file, const BindOptions& options);

/// Takes the angles of the motion to be in a unit that is not the skeleton file's; limits become
/// the same ones in that.
void tell_angles_in(AngleUnit unit, Skeleton& skeleton);

/// The columns of the bones that have any.
std::vector<BoneColumns> columns_of_bones(const Skeleton& skeleton);

/// The ASF form of a skeleton, and how its clip becomes the lines of an AMC file.
struct Unbound {
  AsfFile file;
  bool forces_3dof = false;
  /// The clip's columns for the values of the root and then of each bone of `file`.
  std::vector<std::vector<std::size_t>> columns;
};

/// Finds the ASF form of a skeleton: the opposite of `bind`. What is kept of the file that it was
/// read from, in `kept` and in its joints, is used as far as it still says the same.
/// \errors ASF020 (DataLoss) if a joint is or moves in a way that ASF has no words for
Result<Unbound> unbind(const Skeleton& skeleton, const KeptFile& kept);

}  // namespace kinefile::acclaim
