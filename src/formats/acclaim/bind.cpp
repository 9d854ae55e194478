// SPDX-License-Identifier: MIT
#include "formats/acclaim/bind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinefile::acclaim {
namespace {

Mat3 rotation_about(std::size_t axis, double angle, AngleUnit unit) {
  double sine = 0;
  double cosine = 1;
  if (unit == AngleUnit::Degrees) {
    // Whole quarter turns are removed first, so that they stay exact.
    const double quarters = std::nearbyint(std::remainder(angle, 360.0) / 90);
    const double rest = (std::remainder(angle, 360.0) - 90 * quarters) * kRadiansPerDegree;
    const double s = std::sin(rest);
    const double c = std::cos(rest);
    const int quarter = (static_cast<int>(quarters) + 4) % 4;
    const std::array<double, 4> sines = {s, c, -s, -c};
    sine = sines[static_cast<std::size_t>(quarter)];
    cosine = sines[static_cast<std::size_t>((quarter + 1) % 4)];
  } else {
    sine = std::sin(angle);
    cosine = std::cos(angle);
  }
  const auto a = static_cast<Eigen::Index>((axis + 1) % 3);
  const auto b = static_cast<Eigen::Index>((axis + 2) % 3);
  Mat3 rotation = Mat3::Identity();
  rotation(a, a) = cosine;
  rotation(b, b) = cosine;
  rotation(a, b) = -sine;
  rotation(b, a) = sine;
  return rotation;
}

Vec3 unit_vector(DofWord word) { return Vec3::Unit(static_cast<Eigen::Index>(axis_of(word))); }

/// The axes of a joint's words.
struct WordAxes {
  Mat3 translations = Mat3::Identity();
  Mat3 rotations = Mat3::Identity();
  Vec3 along = Vec3::Zero();  ///< its bone
};

DegreeOfFreedom dof_of(DofWord word, std::size_t column, const WordAxes& axes) {
  if (is_rotation(word)) return {DofKind::Rotation, axes.rotations * unit_vector(word), column, 0};
  if (!is_translation(word)) return {DofKind::TailTranslation, axes.along, column, 0};
  return {DofKind::Translation, axes.translations * unit_vector(word), column, 0};
}

/// Adds the columns of a joint, one per word, and its degrees of freedom in the order of
/// multiplication: translations first, then the rotations, where the first word is the innermost.
/// \param limits  one per word; further words have none
void add_dofs(Skeleton& skeleton, std::size_t joint_index, const std::vector<DofWord>& words,
              const std::vector<Limit>& limits, const WordAxes& axes) {
  Joint& joint = skeleton.joints[joint_index];
  std::vector<DegreeOfFreedom> rotations;
  for (std::size_t w = 0; w < words.size(); ++w) {
    const std::size_t column = skeleton.coordinates.size();
    skeleton.coordinates.push_back({joint_index, std::string(spelling(words[w]))});
    DegreeOfFreedom dof = dof_of(words[w], column, axes);
    if (w < limits.size()) {
      dof.lower = std::min(limits[w].low, limits[w].high);
      dof.upper = std::max(limits[w].low, limits[w].high);
    }
    if (is_rotation(words[w])) {
      rotations.insert(rotations.begin(), dof);
    } else {
      joint.dofs.push_back(dof);
    }
  }
  std::stable_partition(joint.dofs.begin(), joint.dofs.end(), [](const DegreeOfFreedom& dof) {
    return dof.kind == DofKind::Translation;
  });
  joint.dofs.insert(joint.dofs.end(), rotations.begin(), rotations.end());
}

/// The words for the values of a bone in an AMC file with :FORCE-ALL-JOINTS-BE-3DOF: the rotations
/// that it lacks follow its own.
std::vector<DofWord> forced_dofs(std::vector<DofWord> words) {
  if (words.empty()) return words;
  for (const DofWord word : {DofWord::Rx, DofWord::Ry, DofWord::Rz}) {
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
  }
  return words;
}

/// Puts the rotations of a forced bone into the order in which they are evaluated: Rz Ry Rx,
/// whatever the order of the values.
void order_forced(Joint& joint, const Skeleton& skeleton) {
  std::stable_sort(joint.dofs.begin(), joint.dofs.end(),
                   [&skeleton](const DegreeOfFreedom& a, const DegreeOfFreedom& b) {
                     const auto rank = [&skeleton](const DegreeOfFreedom& dof) {
                       if (dof.kind != DofKind::Rotation) return 0;
                       return 'z' + 1 - skeleton.coordinates[dof.coordinate].channel[1];
                     };
                     return rank(a) < rank(b);
                   });
}

Joint bind_root(const Root& root, AngleUnit unit) {
  Joint joint;
  joint.name = "root";
  joint.offset = {root.position[0], root.position[1], root.position[2]};
  joint.rest_rotation = Quat(rotation_of(root.orientation, unit));
  joint.kept = Kept(root);
  return joint;
}

/// A bone without the data that is valid only during parsing.
Kept kept_bone(Bone bone) {
  bone.at = nullptr;
  bone.parent = kNoParent;
  return Kept(std::move(bone));
}

}  // namespace

Mat3 rotation_of(const Orientation& orientation, AngleUnit unit) {
  Mat3 rotation = Mat3::Identity();
  for (const std::size_t axis : orientation.order) {
    rotation = rotation_about(axis, orientation.angles[axis], unit) * rotation;
  }
  return rotation;
}

double length_of(const Vec3& vector) {
  // Scaling rounds, so it is done only where it must be.
  constexpr double kLeast = 1e-140, kMost = 1e140;
  const double length = vector.norm();
  return length > kLeast && length < kMost ? length : vector.stableNorm();
}

Vec3 end_of(const Bone& bone) {
  const Vec3 direction(bone.direction[0], bone.direction[1], bone.direction[2]);
  const double norm = length_of(direction);
  if (!(norm > 0) || !std::isfinite(norm)) return Vec3::Zero();
  return direction / norm * bone.length;
}

std::vector<std::size_t> parents_first(const AsfFile& file) {
  std::vector<std::size_t> order;
  std::vector<bool> is_placed(file.bones.size(), false);
  std::vector<std::size_t> chain;  // a bone and its ancestors that are not placed yet
  for (std::size_t b = 0; b < file.bones.size(); ++b) {
    for (std::size_t above = b; above != kNoParent && !is_placed[above];
         above = file.bones[above].parent) {
      chain.push_back(above);
      is_placed[above] = true;
    }
    order.insert(order.end(), chain.rbegin(), chain.rend());
    chain.clear();
  }
  return order;
}

Skeleton bind(const AsfFile& file, const BindOptions& options) {
  const AngleUnit unit = file.angle.value_or(AngleUnit::Degrees);
  Skeleton skeleton;
  skeleton.name = file.name;
  skeleton.angle_unit = unit;
  skeleton.metres_per_unit = options.metres_per_quotient / file.length.value_or(1.0);
  skeleton.up = options.up;
  skeleton.joints.push_back(bind_root(file.root, unit));
  const Mat3 root_axes = skeleton.joints[0].rest_rotation.toRotationMatrix().transpose();
  add_dofs(skeleton, 0, file.root.order, {}, {root_axes, Mat3::Identity(), Vec3::Zero()});

  std::vector<std::size_t> joint_of_bone(file.bones.size());
  for (const std::size_t b : parents_first(file)) {
    const Bone& bone = file.bones[b];
    const std::size_t index = skeleton.joints.size();
    joint_of_bone[b] = index;
    Joint joint;
    joint.name = bone.name;
    joint.parent = bone.parent == kNoParent ? 0 : joint_of_bone[bone.parent];
    if (bone.parent != kNoParent) joint.offset = end_of(file.bones[bone.parent]);
    const Vec3 end = end_of(bone);
    joint.tips.push_back({"", end});
    joint.kept = kept_bone(bone);
    skeleton.joints.push_back(std::move(joint));
    const Mat3 axes = rotation_of(bone.axis, unit);
    const Vec3 along = end.isZero(0) ? Vec3(Vec3::UnitY()) : Vec3(end / length_of(end));
    const bool is_forced = options.forces_3dof && !bone.dofs.empty();
    add_dofs(skeleton, index, is_forced ? forced_dofs(bone.dofs) : bone.dofs, bone.limits,
             {axes, axes, along});
    if (is_forced) order_forced(skeleton.joints[index], skeleton);
  }
  return skeleton;
}

void tell_angles_in(AngleUnit unit, Skeleton& skeleton) {
  const double factor = radians_per(skeleton.angle_unit) / radians_per(unit);
  if (skeleton.angle_unit == unit) return;
  skeleton.angle_unit = unit;
  for (Joint& joint : skeleton.joints) {
    for (DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::Rotation) continue;
      dof.lower *= factor;
      dof.upper *= factor;
    }
  }
}

std::vector<BoneColumns> columns_of_bones(const Skeleton& skeleton) {
  std::vector<BoneColumns> bones;
  for (std::size_t c = 0; c < skeleton.coordinates.size(); ++c) {
    const std::size_t joint = skeleton.coordinates[c].joint;
    const bool is_next = !bones.empty() && skeleton.coordinates[c - 1].joint == joint;
    if (is_next) {
      ++bones.back().num_columns;
    } else {
      bones.push_back({skeleton.joints[joint].name, c, 1});
    }
  }
  return bones;
}

}  // namespace kinefile::acclaim
