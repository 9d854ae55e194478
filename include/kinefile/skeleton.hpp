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
  Rotation,        ///< about `axis`
  Translation,     ///< along `axis`
  Free,            ///< x y z qw qx qy qz: seven consecutive coordinates, `axis` unused
  Ball,            ///< any rotation, qw qx qy qz: four consecutive coordinates, `axis` unused
  RotationVector,  ///< any rotation, its axis times its angle: three consecutive coordinates in the
                   ///< skeleton's unit of angles, `axis` unused
  TailTranslation,  ///< moves the joint's children and tips along `axis`; not inherited (ASF `l`)
  TailScale,        ///< scales where the joint's children and tips sit along `axis`; not
                    ///< inherited (BVH scale channels)
};

/// One way in which a joint can move, about or along a fixed axis. Its value, an angle or a length,
/// is gain * column + shift (see `value_of`). Gain and shift are 1 and 0, but where a joint follows
/// another one's column (a mimic joint); those of `Free`, `Ball` and `RotationVector` always are.
struct DegreeOfFreedom {
  DofKind kind = DofKind::Rotation;
  Vec3 axis = Vec3::UnitX();   ///< unit length, in the joint's frame
  std::size_t coordinate = 0;  ///< the column of the clip that it reads, or the first of several
  /// What its column holds in the rest pose; all readers of a column agree on it. Without meaning
  /// where several columns are read: `Free` rests as `Joint::free_rest` says, `Ball` and
  /// `RotationVector` do not turn at rest.
  double rest = 0;
  /// What the robot or the figure can do: bounds of the value; infinite where nothing is said.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double max_speed = std::numeric_limits<double>::infinity();  ///< of the value, a second
  double gain = 1;
  double shift = 0;
};

/// Whether the value of a degree of freedom is its column's number, bit for bit.
inline bool is_plain(const DegreeOfFreedom& dof) { return dof.gain == 1 && dof.shift == 0; }

/// The value that a degree of freedom has where its column holds a number.
inline double value_of(const DegreeOfFreedom& dof, double column) {
  return is_plain(dof) ? column : dof.gain * column + dof.shift;
}

/// The number that its column must hold for a degree of freedom to have a value. Where the gain is
/// 0, no number gives another value than any other: its rest.
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
/// joint moves in no other way, one with a `Ball` or a `RotationVector` turns in no other way, all
/// readers of a column rest at one number of it.
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

/// How many consecutive columns a degree of freedom reads: seven, four, three or one.
std::size_t num_coordinates(const DegreeOfFreedom& dof);

/// Six for a free joint, three for a ball and a rotation vector, one for every other degree of
/// freedom.
std::size_t num_dofs(const Joint& joint);
std::size_t num_dofs(const Skeleton& skeleton);

/// The children of every joint, in skeleton order; shape (joints).
std::vector<std::vector<std::size_t>> children_of_joints(const Skeleton& skeleton);

/// How many degrees of freedom read each column; shape (coordinates). A free joint reads seven.
std::vector<std::size_t> num_readers_of_columns(const Skeleton& skeleton);

/// The joint that leads each column: the one that it belongs to, if that reads it, else the first
/// one that does; kNoParent where nothing reads it; shape (coordinates). A motion that is brought
/// back to a skeleton is written where a joint leads; other readers follow.
std::vector<std::size_t> leaders_of_columns(const Skeleton& skeleton);

/// A column that nothing reads, of a joint that follows another's column: what a file of joint
/// values has for a mimic joint. It repeats the joint's value.
struct FollowingColumn {
  std::size_t column = 0;
  std::size_t joint = 0;  ///< of one degree of freedom, which reads another joint's column
};

/// The columns that repeat what joints have by following others, in order.
std::vector<FollowingColumn> following_columns(const Skeleton& skeleton);

/// The columns by which files of joint values know joints: the one that a joint reads, or its own
/// where it follows another's; nothing for a joint that moves in no way or in several; shape
/// (joints).
std::vector<std::optional<std::size_t>> value_columns(const Skeleton& skeleton);

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
/// one: "Xposition", "Xrotation", "Xscale", as in BVH. Of a kind that reads several columns: the
/// word for one of them ("qw", "rotvec_x").
/// \param axis  of `Free`, `Ball` and `RotationVector`: which of its columns
std::string channel_name(DofKind kind, std::size_t axis);

}  // namespace kinefile

#pragma GCC visibility pop
