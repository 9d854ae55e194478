// SPDX-License-Identifier: MIT
#include "kinefile/skeleton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/words.hpp"

namespace kinefile {
namespace {

constexpr double kUnitTolerance = 1e-9;

/// Whether a character cannot be part of a bone's name.
bool ends_word(char c) {
  return static_cast<unsigned char>(c) <= ' ' || c == '(' || c == ')' || c == ',' || c == '#';
}

bool reads_one_column(const DegreeOfFreedom& dof) { return num_coordinates(dof) == 1; }

bool is_whole_rotation(DofKind kind) {
  return kind == DofKind::Ball || kind == DofKind::RotationVector;
}

/// The rule that a degree of freedom breaks, or an empty text.
std::string fault_of(const DegreeOfFreedom& dof, std::size_t num_columns) {
  if (dof.coordinate + num_coordinates(dof) > num_columns ||
      dof.coordinate + num_coordinates(dof) < dof.coordinate) {
    return fmt::format("reads coordinate {} of {}", dof.coordinate, num_columns);
  }
  if (reads_one_column(dof) && !(std::abs(dof.axis.norm() - 1) <= kUnitTolerance)) {
    return "has an axis that is not of unit length";
  }
  if (!std::isfinite(dof.rest)) return "has a rest value that is not finite";
  if (!std::isfinite(dof.gain) || !std::isfinite(dof.shift)) {
    return "has a gain or a shift that is not finite";
  }
  if (!reads_one_column(dof) && !is_plain(dof)) return "has a gain or a shift of several columns";
  return {};
}

bool is_valid(const VisualShape& shape) {
  const Vec3 colour = shape.colour.value_or(Vec3::Zero());
  return shape.size.allFinite() && shape.size.minCoeff() >= 0 && shape.position.allFinite() &&
         std::abs(shape.rotation.norm() - 1) <= kUnitTolerance && colour.minCoeff() >= 0 &&
         colour.maxCoeff() <= 1;
}

std::string fault_of(const Joint& joint, std::size_t index, std::size_t num_columns) {
  if (joint.parent != kNoParent && joint.parent >= index) return "comes before its parent";
  if (!joint.offset.allFinite()) return "has an offset that is not finite";
  if (!(std::abs(joint.rest_rotation.norm() - 1) <= kUnitTolerance)) {
    return "has a rest rotation that is not of unit length";
  }
  bool has_rotation = false;
  bool has_whole = false;
  bool has_free = false;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (std::string fault = fault_of(dof, num_columns); !fault.empty()) return fault;
    if (dof.kind == DofKind::Translation && has_rotation) return "translates after it rotates";
    const bool is_whole = is_whole_rotation(dof.kind);
    if (is_whole && has_rotation) return "turns in any way and in another way, too";
    const bool turns = is_whole || dof.kind == DofKind::Rotation;
    if (turns && has_whole) return "turns in any way and in another way, too";
    has_rotation |= turns;
    has_whole |= is_whole;
    has_free |= dof.kind == DofKind::Free;
  }
  if (has_free && joint.dofs.size() > 1) return "is free and moves in another way, too";
  for (const Tip& tip : joint.tips) {
    if (!tip.offset.allFinite()) return "has a tip that is not finite";
  }
  for (const VisualShape& shape : joint.visuals) {
    if (!is_valid(shape)) return "has a shape with numbers that it cannot have";
  }
  return {};
}

/// The rest values in the columns of a degree of freedom; shape (its coordinates).
std::vector<double> rest_numbers(const Joint& joint, const DegreeOfFreedom& dof) {
  switch (dof.kind) {
    case DofKind::Free:
      return {joint.free_rest.begin(), joint.free_rest.end()};
    case DofKind::Ball:
      return {1, 0, 0, 0};
    case DofKind::RotationVector:
      return {0, 0, 0};
    default:
      return {dof.rest};
  }
}

/// A description of the first column with two different rest values, or an empty text.
std::string disagreement_at_rest(const Skeleton& skeleton) {
  const std::vector<double> rest = rest_coordinates(skeleton);
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const std::vector<double> own = rest_numbers(joint, dof);
      for (std::size_t k = 0; k < own.size(); ++k) {
        const std::size_t column = dof.coordinate + k;
        if (own[k] == rest[column] || !std::isfinite(own[k])) continue;
        return fmt::format("joint '{}' rests at {} in column {}, another one of its readers at {}",
                           joint.name, own[k], column, rest[column]);
      }
    }
  }
  return {};
}

/// Whether a joint reads a column.
bool reads(const Joint& joint, std::size_t column) {
  return std::any_of(joint.dofs.begin(), joint.dofs.end(), [column](const DegreeOfFreedom& dof) {
    return column >= dof.coordinate && column < dof.coordinate + num_coordinates(dof);
  });
}

}  // namespace

std::size_t num_coordinates(const DegreeOfFreedom& dof) {
  switch (dof.kind) {
    case DofKind::Free:
      return kRootColumns;
    case DofKind::Ball:
      return 4;
    case DofKind::RotationVector:
      return 3;
    default:
      return 1;
  }
}

Result<void> validate(const Skeleton& skeleton) {
  const std::size_t num_columns = skeleton.coordinates.size();
  if (skeleton.up.value_or(0) > 2) {
    return fail(make_error(ErrorKind::InvalidInput, "MDL001",
                           fmt::format("there is no axis {} to point up", *skeleton.up)));
  }
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const std::string fault = fault_of(skeleton.joints[j], j, num_columns);
    if (!fault.empty()) {
      return fail(make_error(ErrorKind::InvalidInput, "MDL001",
                             fmt::format("joint '{}' {}", skeleton.joints[j].name, fault)));
    }
  }
  for (std::size_t c = 0; c < num_columns; ++c) {
    if (skeleton.coordinates[c].joint >= skeleton.joints.size()) {
      return fail(make_error(ErrorKind::InvalidInput, "MDL001",
                             fmt::format("coordinate {} belongs to no joint", c)));
    }
  }
  if (const std::string fault = disagreement_at_rest(skeleton); !fault.empty()) {
    return fail(make_error(ErrorKind::InvalidInput, "MDL001", fault));
  }
  return {};
}

std::vector<double> rest_coordinates(const Skeleton& skeleton) {
  std::vector<double> values(skeleton.coordinates.size(), 0.0);
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const std::vector<double> rest = rest_numbers(joint, dof);
      std::copy(rest.begin(), rest.end(),
                values.begin() + static_cast<std::ptrdiff_t>(dof.coordinate));
    }
  }
  for (const FollowingColumn& following : following_columns(skeleton)) {
    const DegreeOfFreedom& dof = skeleton.joints[following.joint].dofs[0];
    values[following.column] = value_of(dof, dof.rest);
  }
  return values;
}

Vec3 rest_offset(const Joint& joint) {
  Vec3 offset = joint.offset;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Translation) continue;
    offset += joint.rest_rotation * (value_of(dof, dof.rest) * dof.axis);
  }
  return offset;
}

bool adds_positions(const Skeleton& skeleton) {
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      const Vec3 axis = joint.rest_rotation * dof.axis;
      if (dof.kind == DofKind::Translation && joint.offset.dot(axis) != 0) return true;
    }
  }
  return false;
}

bool moves_freely(const Joint& joint) {
  return !joint.dofs.empty() && joint.dofs.front().kind == DofKind::Free;
}

std::size_t num_dofs(const Joint& joint) {
  std::size_t count = 0;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    const std::size_t num_columns = num_coordinates(dof);
    // A quaternion has one number more than it has degrees of freedom.
    count += num_columns - (dof.kind == DofKind::Free || dof.kind == DofKind::Ball ? 1 : 0);
  }
  return count;
}

std::size_t num_dofs(const Skeleton& skeleton) {
  std::size_t count = 0;
  for (const Joint& joint : skeleton.joints) count += num_dofs(joint);
  return count;
}

std::vector<std::vector<std::size_t>> children_of_joints(const Skeleton& skeleton) {
  std::vector<std::vector<std::size_t>> children(skeleton.joints.size());
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const std::size_t parent = skeleton.joints[j].parent;
    if (parent != kNoParent) children[parent].push_back(j);
  }
  return children;
}

std::vector<std::size_t> num_readers_of_columns(const Skeleton& skeleton) {
  std::vector<std::size_t> readers(skeleton.coordinates.size(), 0);
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      for (std::size_t k = 0; k < num_coordinates(dof); ++k) ++readers[dof.coordinate + k];
    }
  }
  return readers;
}

std::vector<std::size_t> leaders_of_columns(const Skeleton& skeleton) {
  std::vector<std::size_t> leaders(skeleton.coordinates.size(), kNoParent);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    for (const DegreeOfFreedom& dof : skeleton.joints[j].dofs) {
      for (std::size_t k = 0; k < num_coordinates(dof); ++k) {
        const std::size_t column = dof.coordinate + k;
        const bool is_own = skeleton.coordinates[column].joint == j;
        if (is_own || leaders[column] == kNoParent) leaders[column] = j;
      }
    }
  }
  return leaders;
}

std::vector<FollowingColumn> following_columns(const Skeleton& skeleton) {
  const std::vector<std::size_t> readers = num_readers_of_columns(skeleton);
  std::vector<FollowingColumn> following;
  for (std::size_t c = 0; c < readers.size(); ++c) {
    if (readers[c] > 0) continue;
    const std::size_t j = skeleton.coordinates[c].joint;
    const Joint& joint = skeleton.joints[j];
    const bool moves_in_one_way = joint.dofs.size() == 1 && reads_one_column(joint.dofs[0]);
    if (!moves_in_one_way) continue;
    const std::size_t leader = skeleton.coordinates[joint.dofs[0].coordinate].joint;
    if (leader != j && reads(skeleton.joints[leader], joint.dofs[0].coordinate)) {
      following.push_back({c, j});
    }
  }
  return following;
}

std::vector<std::optional<std::size_t>> value_columns(const Skeleton& skeleton) {
  std::vector<std::optional<std::size_t>> columns;
  for (const Joint& joint : skeleton.joints) {
    const bool moves_in_one_way = joint.dofs.size() == 1 && reads_one_column(joint.dofs[0]);
    columns.push_back(moves_in_one_way ? std::optional(joint.dofs[0].coordinate) : std::nullopt);
  }
  for (const FollowingColumn& following : following_columns(skeleton)) {
    columns[following.joint] = following.column;
  }
  return columns;
}

namespace {

/// A name for a joint id that no joint has. Links may be called joint1, joint2, ..., too.
std::string name_of_id(std::size_t id, const Skeleton& robot) {
  std::string name = "joint" + std::to_string(id);
  const auto is_taken = [&name](const Joint& joint) {
    return joint.name == name || joint.joint_name == name;
  };
  while (std::any_of(robot.joints.begin(), robot.joints.end(), is_taken)) name += '_';
  return name;
}

}  // namespace

std::vector<std::string> names_of_value_columns(const Skeleton& robot) {
  std::vector<std::string> names(robot.coordinates.size() - kRootColumns);
  const auto columns = value_columns(robot);
  for (std::size_t j = columns.size(); j-- > 0;) {
    if (columns[j] && *columns[j] >= kRootColumns) {
      names[*columns[j] - kRootColumns] = robot.joints[j].name;
    }
  }
  for (std::size_t id = 0; id < names.size(); ++id) {
    if (names[id].empty()) names[id] = name_of_id(id, robot);
  }
  return names;
}

bool is_bone_name(std::string_view name) {
  constexpr std::array<std::string_view, 6> kTaken = {"root", "begin",    "end",
                                                      "inf",  "infinity", "nan"};
  if (name.empty() || name.front() == ':' || std::any_of(name.begin(), name.end(), ends_word)) {
    return false;
  }
  if (name.find_first_not_of("0123456789+-.eE") == std::string_view::npos) return false;
  const bool has_sign = name.front() == '+' || name.front() == '-';
  const std::string word = lowered(name.substr(has_sign ? 1 : 0));
  return std::find(kTaken.begin(), kTaken.end(), word) == kTaken.end();
}

std::string as_bone_name(std::string name) {
  std::replace_if(name.begin(), name.end(), ends_word, '_');
  return is_bone_name(name) ? name : "joint_" + name;
}

std::vector<std::vector<std::size_t>> columns_of_joints(const Skeleton& skeleton) {
  std::vector<std::vector<std::size_t>> columns(skeleton.joints.size());
  for (std::size_t c = 0; c < skeleton.coordinates.size(); ++c) {
    columns[skeleton.coordinates[c].joint].push_back(c);
  }
  return columns;
}

std::size_t num_tips(const Skeleton& skeleton) {
  std::size_t count = 0;
  for (const Joint& joint : skeleton.joints) count += joint.tips.size();
  return count;
}

std::vector<std::size_t> first_tips_of_joints(const Skeleton& skeleton) {
  std::vector<std::size_t> first;
  std::size_t count = 0;
  for (const Joint& joint : skeleton.joints) {
    first.push_back(count);
    count += joint.tips.size();
  }
  return first;
}

std::string tip_label(const Joint& joint, std::size_t tip) {
  return tip == 0 ? joint.name + ".tip" : fmt::format("{}.tip{}", joint.name, tip + 1);
}

std::vector<std::string> column_names(const Skeleton& skeleton) {
  std::vector<std::string> names;
  names.reserve(skeleton.coordinates.size());
  for (const Coordinate& coordinate : skeleton.coordinates) {
    names.push_back(skeleton.joints[coordinate.joint].name + "." + coordinate.channel);
  }
  return names;
}

std::string channel_name(DofKind kind, std::size_t axis) {
  constexpr std::array<const char*, 7> kFree = {"x", "y", "z", "qw", "qx", "qy", "qz"};
  constexpr std::array<const char*, 3> kVector = {"rotvec_x", "rotvec_y", "rotvec_z"};
  const std::string name(1, static_cast<char>('X' + axis));
  switch (kind) {
    case DofKind::Rotation:
      return name + "rotation";
    case DofKind::Translation:
    case DofKind::TailTranslation:
      return name + "position";
    case DofKind::TailScale:
      return name + "scale";
    case DofKind::Free:
      return kFree[axis];
    case DofKind::Ball:
      return kFree[3 + axis];
    case DofKind::RotationVector:
      return kVector[axis];
  }
  return name;
}

}  // namespace kinefile
