// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/kept.hpp"
#include "kinefile/math.hpp"
#include "kinefile/result.hpp"
#include "kinefile/visual_shape.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

inline constexpr std::size_t kNoParent = std::numeric_limits<std::size_t>::max();

/// The columns that a free joint reads. They are the first ones of a robot, whose root is free.
inline constexpr std::size_t kRootColumns = 7;

enum class AngleUnit { Degrees, Radians };

/// Radians per unit of angle.
constexpr double radians_per(AngleUnit unit) {
  return unit == AngleUnit::Degrees ? kRadiansPerDegree : 1.0;
}

enum class DofKind {
  Rotation,        ///< about `axis`
  Translation,     ///< along `axis`
  Free,            ///< x y z qw qx qy qz: seven consecutive coordinates, `axis` unused
  Ball,            ///< any rotation, qw qx qy qz: four consecutive coordinates, `axis` unused
  RotationVector,  ///< any rotation, its axis times its angle: three consecutive coordinates in the
                   ///< skeleton's unit of angles, `axis` unused
  TailTranslation,  ///< moves the joint's children and tips along `axis`; not inherited (ASF `l`)
  TailScale,        ///< scales the positions of the joint's children and tips along `axis`; not
                    ///< inherited (BVH scale channels)
};

/// One way in which a joint can move, about or along a fixed axis. Its value, an angle or a length,
/// is gain * column + shift (see `value_of`). Gain and shift are 1 and 0, except if a joint follows
/// another joint's column (a mimic joint); for `Free`, `Ball` and `RotationVector` they always are.
struct DegreeOfFreedom {
  DofKind kind = DofKind::Rotation;
  Vec3 axis = Vec3::UnitX();   ///< unit length, in the joint's frame
  std::size_t coordinate = 0;  ///< the column of the clip that it reads, or the first of several
  /// What its column holds in the rest pose; the same for all readers of a column. Not used if
  /// several columns are read: `Free` rests at `Joint::free_rest`, `Ball` and `RotationVector` at
  /// the identity.
  double rest = 0;
  /// Limits of the value for the robot or the figure; infinite if not specified.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double max_speed = std::numeric_limits<double>::infinity();  ///< of the value, per second
  double gain = 1;
  double shift = 0;
};

/// Whether the value of a degree of freedom is the number in its column, bit for bit.
inline bool is_plain(const DegreeOfFreedom& dof) { return dof.gain == 1 && dof.shift == 0; }

/// The value of a degree of freedom for the number in its column.
inline double value_of(const DegreeOfFreedom& dof, double column) {
  return is_plain(dof) ? column : dof.gain * column + dof.shift;
}

/// The number in its column for a value of a degree of freedom. If the gain is 0, every number
/// gives the same value, and the rest value is returned.
inline double column_of(const DegreeOfFreedom& dof, double value) {
  if (is_plain(dof)) return value;
  return dof.gain == 0 ? dof.rest : (value - dof.shift) / dof.gain;
}

/// A named point that is fixed in its joint: a BVH End Site, the end of an ASF bone.
struct Tip {
  std::string name;  ///< may be empty
  Vec3 offset = Vec3::Zero();
};

/// A joint: parent_from_joint = T(offset) R_rest D1 ... Dn, D1 outermost, translations first.
/// Column vectors, right-handed; lengths in the skeleton's own unit.
struct Joint {
  std::string name;
  std::string joint_name;  ///< for a robot's link: the name of the joint that moves it, or empty
  std::size_t parent = kNoParent;  ///< an index below that of this joint, or kNoParent for a root
  Vec3 offset = Vec3::Zero();      ///< in the parent's frame
  Quat rest_rotation = Quat::Identity();
  std::vector<DegreeOfFreedom> dofs;  ///< in the order of multiplication
  std::vector<Tip> tips;
  std::vector<VisualShape> visuals;  ///< what a robot's link looks like, as far as it is primitives
  std::array<double, 7> free_rest = {0, 0, 0, 1, 0, 0, 0};  ///< the rest values if it moves freely
  /// What its format keeps of it beyond the model. A copy of the joint includes it.
  Kept kept;
};

/// The name of a column of a clip: a joint, and the channel as named in its format ("Zrotation"). A
/// column that no degree of freedom reads is kept and moves nothing.
struct Coordinate {
  std::size_t joint = 0;
  std::string channel;
};

/// A tree of joints, parents first, and the columns that move it.
struct Skeleton {
  std::string name;
  std::vector<Joint> joints;
  std::vector<Coordinate> coordinates;  ///< one per column, in the file's order of values
  AngleUnit angle_unit = AngleUnit::Degrees;
  double metres_per_unit = 0;  ///< 0 if the file does not specify it
  /// The axis that points up, 0 x, 1 y, 2 z, if the format defines it or the caller said it; absent
  /// otherwise (see `find_up_axis`).
  std::optional<std::size_t> up = std::nullopt;
};

/// Checks what every other function relies on: parents come first, axes have unit length, every
/// coordinate exists, numbers are finite, sizes of shapes are not below 0, translations precede
/// rotations within a joint, a free joint has no other degrees of freedom, a joint with a `Ball` or
/// a `RotationVector` has no other rotations, all readers of a column have the same rest value.
/// \errors MDL001 with the name of the first joint that breaks a rule
Result<void> validate(const Skeleton& skeleton);

/// The value of every coordinate in the rest pose; shape (coordinates).
std::vector<double> rest_coordinates(const Skeleton& skeleton);

/// The position of a joint in its parent's frame in the rest pose: its offset plus the rest values
/// of its translations.
Vec3 rest_offset(const Joint& joint);

/// Whether translations are added to offsets instead of replacing them, as in BVH files read with
/// `--positions add`: a translation along an axis in which the offset is not zero.
bool adds_positions(const Skeleton& skeleton);

/// Whether a joint moves freely (`DofKind::Free`); then it has no other degrees of freedom.
bool moves_freely(const Joint& joint);

/// The number of consecutive columns that a degree of freedom reads: seven, four, three or one.
std::size_t num_coordinates(const DegreeOfFreedom& dof);

/// Six for a free joint, three for a ball and a rotation vector, one for every other degree of
/// freedom.
std::size_t num_dofs(const Joint& joint);
std::size_t num_dofs(const Skeleton& skeleton);

/// The children of every joint, in skeleton order; shape (joints).
std::vector<std::vector<std::size_t>> children_of_joints(const Skeleton& skeleton);

/// How many degrees of freedom read each column; shape (coordinates). A free joint reads seven.
std::vector<std::size_t> num_readers_of_columns(const Skeleton& skeleton);

/// The leading joint of each column: the joint that the column belongs to, if that reads it,
/// otherwise the first one that does; kNoParent if none reads it; shape (coordinates). When a
/// motion is fitted to a skeleton, the leading joint determines a column; other readers follow.
std::vector<std::size_t> leaders_of_columns(const Skeleton& skeleton);

/// A column that no degree of freedom reads, of a joint that follows another joint's column: the
/// column of a mimic joint in a file of joint values. It repeats the joint's value.
struct FollowingColumn {
  std::size_t column = 0;
  std::size_t joint = 0;  ///< has one degree of freedom, which reads another joint's column
};

/// The columns that repeat the values of joints that follow others, in order.
std::vector<FollowingColumn> following_columns(const Skeleton& skeleton);

/// The column of each joint in files of joint values: the one that the joint reads, or its own if
/// it follows another joint's; nothing for a joint without or with several degrees of freedom;
/// shape (joints).
std::vector<std::optional<std::size_t>> value_columns(const Skeleton& skeleton);

/// The names of a robot's columns after those of its root: each has the name of its joint (of the
/// first one, if several read it); a joint id without a joint has a name that no joint has, such as
/// "joint3" for id 3. Files of joint values are written with these names and read by them.
/// Precondition: the root has `kRootColumns` columns.
std::vector<std::string> names_of_value_columns(const Skeleton& robot);

/// The columns of every joint, in order; shape (joints).
std::vector<std::vector<std::size_t>> columns_of_joints(const Skeleton& skeleton);

/// The number of tips of all joints.
std::size_t num_tips(const Skeleton& skeleton);

/// The index of every joint's first tip among the tips of all joints; shape (joints).
std::vector<std::size_t> first_tips_of_joints(const Skeleton& skeleton);

/// The name of a tip in tables: `JOINT.tip`, then `JOINT.tip2` and so on.
std::string tip_label(const Joint& joint, std::size_t tip);

/// Whether a joint's name is valid for a bone: one word without blanks, parentheses, commas or #,
/// that is not a number and not root, begin or end.
bool is_bone_name(std::string_view name);

/// A valid name for a bone: the same name, or a similar one.
std::string as_bone_name(std::string name);

/// The names of the columns, `JOINT.CHANNEL`.
std::vector<std::string> column_names(const Skeleton& skeleton);

/// The channel name of a degree of freedom along or about a coordinate axis (0 x, 1 y, 2 z) if no
/// file gives one: "Xposition", "Xrotation", "Xscale", as in BVH. For a kind that reads several
/// columns: the name of one of them ("qw", "rotvec_x").
/// \param axis  for `Free`, `Ball` and `RotationVector`: which of its columns
std::string channel_name(DofKind kind, std::size_t axis);

}  // namespace kinefile

#pragma GCC visibility pop
