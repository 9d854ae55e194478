// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/kept.hpp"
#include "kinefile/math.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

inline constexpr std::size_t kNoParent = std::numeric_limits<std::size_t>::max();

/// The columns that a free joint reads. They are the first ones of a robot, whose root is free.
inline constexpr std::size_t kRootColumns = 7;

enum class AngleUnit { Degrees, Radians };

/// The radians in one unit of an angle.
constexpr double radians_per(AngleUnit unit) {
  return unit == AngleUnit::Degrees ? kRadiansPerDegree : 1.0;
}

enum class DofKind {
  Rotation,         ///< about `axis`
  Translation,      ///< along `axis`
  Free,             ///< x y z qw qx qy qz: seven consecutive coordinates, `axis` unused
  TailTranslation,  ///< moves the joint's children and tips along `axis`; not inherited (ASF `l`)
  TailScale,        ///< scales where the joint's children and tips sit along `axis`; not
                    ///< inherited (BVH scale channels)
};

/// One way in which a joint can move, about or along a fixed axis.
struct DegreeOfFreedom {
  DofKind kind = DofKind::Rotation;
  Vec3 axis = Vec3::UnitX();   ///< unit length, in the joint's frame
  std::size_t coordinate = 0;  ///< the column of the clip that it reads
  double rest = 0;             ///< its value in the rest pose (of `Free`: `Joint::free_rest`)
  /// What the robot or the figure can do, in the coordinate's unit; infinite where nothing is said.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double max_speed = std::numeric_limits<double>::infinity();  ///< a second
};

/// A named point that is fixed in its joint: a BVH End Site, the end of an ASF bone.
struct Tip {
  std::string name;  ///< may be empty
  Vec3 offset = Vec3::Zero();
};

/// A joint: parent_from_joint = T(offset) R_rest D1 ... Dn, D1 outermost, translations first.
/// Column vectors, right-handed; lengths in the skeleton's own unit.
struct Joint {
  std::string name;
  std::string joint_name;  ///< of a robot's link: what the joint is called that moves it, or empty
  std::size_t parent = kNoParent;  ///< an index below the joint's own, or kNoParent for a root
  Vec3 offset = Vec3::Zero();      ///< in the parent's frame
  Quat rest_rotation = Quat::Identity();
  std::vector<DegreeOfFreedom> dofs;  ///< in the order of multiplication
  std::vector<Tip> tips;
  std::array<double, 7> free_rest = {0, 0, 0, 1, 0, 0, 0};  ///< where it rests if it moves freely
  /// What its format keeps of it beyond the model. Whoever copies the joint copies it, too.
  Kept kept;
};

/// What one column of a clip is called: the channel of a joint in the words of its format
/// ("Zrotation"). A column that no degree of freedom reads is kept and moves nothing.
struct Coordinate {
  std::size_t joint = 0;
  std::string channel;
};

/// A tree of joints, parents first, and the columns that move it.
struct Skeleton {
  std::string name;
  std::vector<Joint> joints;
  std::vector<Coordinate> coordinates;  ///< one a column, in the file's order of values
  AngleUnit angle_unit = AngleUnit::Degrees;
  double metres_per_unit = 0;  ///< 0 where the file does not say
};

/// Checks what every other function relies on: parents come first, axes have unit length, every
/// coordinate exists, numbers are finite, translations precede rotations within a joint, a free
/// joint moves in no other way.
/// \errors MDL001 with the name of the first joint that breaks a rule
Result<void> validate(const Skeleton& skeleton);

/// The value of every coordinate in the rest pose; shape (coordinates).
std::vector<double> rest_coordinates(const Skeleton& skeleton);

/// Where a joint sits in its parent's frame in the rest pose: its offset and the rest values of
/// its translations.
Vec3 rest_offset(const Joint& joint);

/// Whether translations are added to offsets that they do not replace, as BVH files read with
/// `--positions add` have it: a translation along an axis in which the offset is not zero.
bool adds_positions(const Skeleton& skeleton);

/// Whether a joint moves freely (`DofKind::Free`), which it then does in no other way.
bool moves_freely(const Joint& joint);

/// Six for a free joint, one for every other degree of freedom.
std::size_t num_dofs(const Joint& joint);
std::size_t num_dofs(const Skeleton& skeleton);

/// The children of every joint, in skeleton order; shape (joints).
std::vector<std::vector<std::size_t>> children_of_joints(const Skeleton& skeleton);

/// How many degrees of freedom read each column; shape (coordinates). A free joint reads seven.
std::vector<std::size_t> num_readers_of_columns(const Skeleton& skeleton);

/// The columns of every joint, in order; shape (joints).
std::vector<std::vector<std::size_t>> columns_of_joints(const Skeleton& skeleton);

/// The number of tips of all joints.
std::size_t num_tips(const Skeleton& skeleton);

/// The first tip of every joint among the tips of all joints; shape (joints).
std::vector<std::size_t> first_tips_of_joints(const Skeleton& skeleton);

/// What a tip is called in tables: `JOINT.tip`, then `JOINT.tip2` and so on.
std::string tip_label(const Joint& joint, std::size_t tip);

/// Whether a joint's name can be a bone's: one word without blanks, parentheses, commas or #, that
/// is no number and none of root, begin and end.
bool is_bone_name(std::string_view name);

/// A name that a bone can have: the same, or one like it.
std::string as_bone_name(std::string name);

/// The names of the columns, `JOINT.CHANNEL`.
std::vector<std::string> column_names(const Skeleton& skeleton);

/// The word for a movement along or about a coordinate axis (0 x, 1 y, 2 z) where no file gives
/// one: "Xposition", "Xrotation", "Xscale", as in BVH.
std::string channel_name(DofKind kind, std::size_t axis);

}  // namespace kinefile

#pragma GCC visibility pop
