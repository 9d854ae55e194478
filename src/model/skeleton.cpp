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

std::size_t num_coordinates(const DegreeOfFreedom& dof) {
  return dof.kind == DofKind::Free ? 7 : 1;
}

/// What a degree of freedom breaks, or an empty text.
std::string fault_of(const DegreeOfFreedom& dof, std::size_t num_columns) {
  if (dof.coordinate + num_coordinates(dof) > num_columns ||
      dof.coordinate + num_coordinates(dof) < dof.coordinate) {
    return fmt::format("reads coordinate {} of {}", dof.coordinate, num_columns);
  }
  if (dof.kind != DofKind::Free && !(std::abs(dof.axis.norm() - 1) <= kUnitTolerance)) {
    return "has an axis that is not of unit length";
  }
  if (!std::isfinite(dof.rest)) return "has a rest value that is not finite";
  return {};
}

std::string fault_of(const Joint& joint, std::size_t index, std::size_t num_columns) {
  if (joint.parent != kNoParent && joint.parent >= index) return "comes before its parent";
  if (!joint.offset.allFinite()) return "has an offset that is not finite";
  if (!(std::abs(joint.rest_rotation.norm() - 1) <= kUnitTolerance)) {
    return "has a rest rotation that is not of unit length";
  }
  bool has_rotation = false;
  bool has_free = false;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (std::string fault = fault_of(dof, num_columns); !fault.empty()) return fault;
    if (dof.kind == DofKind::Translation && has_rotation) return "translates after it rotates";
    has_rotation |= dof.kind == DofKind::Rotation;
    has_free |= dof.kind == DofKind::Free;
  }
  if (has_free && joint.dofs.size() > 1) return "is free and moves in another way, too";
  for (const Tip& tip : joint.tips) {
    if (!tip.offset.allFinite()) return "has a tip that is not finite";
  }
  return {};
}

}  // namespace

Result<void> validate(const Skeleton& skeleton) {
  const std::size_t num_columns = skeleton.coordinates.size();
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
  return {};
}

std::vector<double> rest_coordinates(const Skeleton& skeleton) {
  std::vector<double> values(skeleton.coordinates.size(), 0.0);
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind == DofKind::Free) {
        std::copy(joint.free_rest.begin(), joint.free_rest.end(),
                  values.begin() + static_cast<std::ptrdiff_t>(dof.coordinate));
      } else {
        values[dof.coordinate] = dof.rest;
      }
    }
  }
  return values;
}

Vec3 rest_offset(const Joint& joint) {
  Vec3 offset = joint.offset;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind == DofKind::Translation) offset += joint.rest_rotation * (dof.rest * dof.axis);
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
  for (const DegreeOfFreedom& dof : joint.dofs) count += dof.kind == DofKind::Free ? 6 : 1;
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
  std::string name(1, static_cast<char>('X' + axis));
  switch (kind) {
    case DofKind::Rotation:
      return name + "rotation";
    case DofKind::Translation:
    case DofKind::TailTranslation:
      return name + "position";
    case DofKind::TailScale:
      return name + "scale";
    case DofKind::Free:
      break;
  }
  return name;
}

}  // namespace kinefile
