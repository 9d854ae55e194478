// SPDX-License-Identifier: MIT
// Components of body motions as motions of separate parts, and back.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/words.hpp"
#include "kinefile/robot.hpp"
#include "kinematics/rotation_batches.hpp"
#include "model/part_names.hpp"

namespace kinefile::robot {
namespace {

constexpr std::array<const char*, 7> kFreeChannels = {"x", "y", "z", "qw", "qx", "qy", "qz"};
constexpr std::array<const char*, 6> kRpyChannels = {"x", "y", "z", "roll", "pitch", "yaw"};

void add_column(Skeleton& skeleton, const char* channel) {
  skeleton.coordinates.push_back({skeleton.joints.size() - 1, channel});
}

void add_translations(Skeleton& skeleton, std::size_t count) {
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < count; ++axis) {
    const std::size_t column = skeleton.coordinates.size();
    add_column(skeleton, count == 1 ? "q" : kNames[axis]);
    skeleton.joints.back().dofs.push_back(
        {DofKind::Translation, Vec3::Unit(static_cast<Eigen::Index>(axis)), column, 0});
  }
}

void add_pose(Skeleton& skeleton, PoseForm form) {
  const std::size_t first = skeleton.coordinates.size();
  if (form == PoseForm::Quaternion) {
    for (const char* channel : kFreeChannels) add_column(skeleton, channel);
    skeleton.joints.back().dofs.push_back({DofKind::Free, Vec3::UnitX(), first, 0});
    return;
  }
  for (const char* channel : kRpyChannels) add_column(skeleton, channel);
  auto& dofs = skeleton.joints.back().dofs;
  for (std::size_t k = 0; k < 3; ++k) {
    dofs.push_back({DofKind::Translation, Vec3::Unit(static_cast<Eigen::Index>(k)), first + k, 0});
  }
  for (std::size_t k = 3; k-- > 0;) {  // Rz(yaw) Ry(pitch) Rx(roll)
    dofs.push_back({DofKind::Rotation, Vec3::Unit(static_cast<Eigen::Index>(k)), first + 3 + k, 0});
  }
}

/// Adds the joints and columns of one skeleton to another.
void append_parts(const Skeleton& from, Skeleton& to) {
  const std::size_t first_joint = to.joints.size();
  const std::size_t first_column = to.coordinates.size();
  for (Joint joint : from.joints) {
    for (DegreeOfFreedom& dof : joint.dofs) dof.coordinate += first_column;
    to.joints.push_back(std::move(joint));
  }
  for (Coordinate coordinate : from.coordinates) {
    coordinate.joint += first_joint;
    to.coordinates.push_back(std::move(coordinate));
  }
}

}  // namespace

std::string name_of_part(const Component& component, std::size_t part) {
  if (part < component.part_names.size()) return component.part_names[part];
  if (component.kind == ComponentKind::Poses && component.content == kLinkPosition) {
    return fmt::format("link{}", part);
  }
  if (component.kind == ComponentKind::Values && component.content == kJointDisplacement) {
    return fmt::format("joint{}", part);
  }
  if (component.kind != ComponentKind::Vectors) return numbered_part(component.content, part);
  return component.content + (component.is_root_relative ? std::string(kRootRelativeSuffix) : "");
}

Motion motion_of_component(const Component& component) {
  Motion motion;
  Skeleton& skeleton = motion.skeleton;
  skeleton.angle_unit = AngleUnit::Radians;
  skeleton.metres_per_unit = 1;
  skeleton.up = 2;
  skeleton.joints.reserve(component.num_parts);
  skeleton.coordinates.reserve(component.row_size());
  for (std::size_t part = 0; part < component.num_parts; ++part) {
    skeleton.joints.emplace_back().name = name_of_part(component, part);
    if (component.kind == ComponentKind::Poses) {
      add_pose(skeleton, component.pose_form);
    } else {
      add_translations(skeleton, component.width());
    }
  }
  motion.clip.num_frames = component.num_frames;
  motion.clip.num_coordinates = component.row_size();
  motion.clip.values = component.values;
  motion.clip.timeline = component.timeline;
  return motion;
}

bool is_in_world(const Component& component) {
  const bool is_link = component.kind == ComponentKind::Poses && component.content == kLinkPosition;
  const bool is_zmp = component.kind == ComponentKind::Vectors && component.content == kZmp;
  return is_link || (is_zmp && !component.is_root_relative);
}

Motion side_by_side(std::span<const Component* const> components) {
  Motion all;
  if (components.empty()) return all;
  all.skeleton.angle_unit = AngleUnit::Radians;
  all.skeleton.metres_per_unit = 1;
  all.skeleton.up = 2;
  all.clip.timeline = components[0]->timeline;
  all.clip.num_frames = components[0]->num_frames;
  for (const Component* part : components) {
    append_parts(motion_of_component(*part).skeleton, all.skeleton);
  }
  all.clip.num_coordinates = all.skeleton.coordinates.size();
  all.clip.values.reserve(all.clip.num_frames * all.clip.num_coordinates);
  for (std::size_t f = 0; f < all.clip.num_frames; ++f) {
    for (const Component* part : components) all.clip.values.append(part->row(f));
  }
  return all;
}

void put_side_by_side(const Motion& motion, std::span<Component* const> components) {
  std::size_t first_column = 0;
  for (Component* part : components) {
    const std::size_t width = part->row_size();
    part->num_frames = motion.clip.num_frames;
    part->timeline = motion.clip.timeline;
    part->values = {};
    part->values.reserve(part->num_frames * width);
    for (std::size_t f = 0; f < part->num_frames; ++f) {
      part->values.append(motion.clip.row(f).subspan(first_column, width));
    }
    first_column += width;
  }
}

bool agree(const Component& a, const Component& b) {
  return a.num_frames == b.num_frames && have_same_times(a.timeline, b.timeline);
}

const Component* find_disagreement(const BodyMotion& motion) {
  const Component* const main = main_component(motion);
  const auto found = std::find_if(
      motion.components.begin(), motion.components.end(),
      [&](const Component& one) { return one.kind != ComponentKind::Other && !agree(one, *main); });
  return found == motion.components.end() ? nullptr : &*found;
}

std::string words_of_disagreement(const Component& component, const Component& main) {
  return fmt::format("{} frame{} at {:.6g} a second of '{}' beside {} at {:.6g} of '{}'",
                     component.num_frames, component.num_frames == 1 ? "" : "s",
                     nominal_frame_rate(component.timeline), component.content, main.num_frames,
                     nominal_frame_rate(main.timeline), main.content);
}

Result<Motion> motion_of_components(const BodyMotion& motion, bool lenient,
                                    Diagnostics& diagnostics) {
  const Component* const main = main_component(motion);
  if (main == nullptr) {
    return fail(make_error(ErrorKind::Usage, "BRG010",
                           "expected components to put side by side, found none"));
  }
  const Component* const other = find_disagreement(motion);
  if (other != nullptr && !lenient) {
    return fail(
        ErrorKind::DataLoss, "BRG021",
        fmt::format("expected components of one length and rate, found {}; 'kinefile "
                    "resample --fps {:.6g}' brings them to one, --lenient leaves some out",
                    words_of_disagreement(*other, *main), nominal_frame_rate(main->timeline)));
  }
  std::vector<const Component*> parts;
  std::vector<std::string> left_out;
  for (const Component& component : motion.components) {
    if (component.kind != ComponentKind::Other && agree(component, *main)) {
      parts.push_back(&component);
    } else {
      left_out.push_back(component.content);
    }
  }
  if (!left_out.empty()) {
    diagnostics.add(Severity::Warning, "BRG014",
                    fmt::format("components of {}unknown type are left out: {}",
                                other != nullptr ? "another length, at other times or of " : "",
                                listed(left_out)));
  }
  Motion all = side_by_side(parts);
  all.clip.timeline = main->timeline;
  return all;
}

Component with_frames_of(const Component& component, const Motion& motion) {
  Component changed = component;
  changed.num_frames = motion.clip.num_frames;
  changed.values = motion.clip.values;
  changed.timeline = motion.clip.timeline;
  return changed;
}

Result<Motion> motion_of_links(const BodyMotion& motion) {
  const Component* links = find_component(motion, ComponentKind::Poses, kLinkPosition);
  if (links == nullptr) {
    return fail(make_error(ErrorKind::Usage, "BRG010",
                           "expected poses of links (LinkPosition), found none; joints alone need "
                           "a model: --skeleton names one"));
  }
  return motion_of_component(*links);
}

namespace {

/// The joints that move freely, and the first of their columns in the old and the new clip.
struct FreedJoint {
  std::size_t old_column;
  std::size_t new_column;
};

/// The axes of the angles that replace a free joint's quaternion.
EulerAxes freed_axes() { return {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()}; }

/// The rotation of a free pose.
Quat rotation_of_pose(std::span<const double> pose) {
  return unit_quaternion({pose[3], pose[4], pose[5], pose[6]});
}

/// Converts the free poses of a joint to positions and angles, each near the previous ones.
void write_freed(const Clip& from, const FreedJoint& joint, AngleUnit unit, const Rows& rows) {
  rotation::AngleFinder finder(freed_axes(), unit == AngleUnit::Degrees, Vec3::Zero());
  simd::Quaternions quaternions;
  simd::Angles angles;
  for (const FrameBatch& frames : batches_of(from.num_frames)) {
    rotation::resize(quaternions, frames.count);
    rotation::resize(angles, frames.count);
    for (std::size_t i = 0; i < frames.count; ++i) {
      const auto pose = from.row(frames.first + i).subspan(joint.old_column, 7);
      rotation::put_quaternion(rotation_of_pose(pose), i, quaternions);
      std::copy_n(pose.begin(), 3, &rows[frames.first + i][joint.new_column]);
    }
    finder.find(quaternions, frames.count, angles);
    for (std::size_t i = 0; i < frames.count; ++i) {
      const auto out = rows[frames.first + i].subspan(joint.new_column + 3, 3);
      for (std::size_t k = 0; k < 3; ++k) out[k] = angles[k][i];
    }
  }
}

}  // namespace

Motion without_free_joints(const Motion& motion) {
  const auto& joints = motion.skeleton.joints;
  if (std::none_of(joints.begin(), joints.end(), moves_freely)) return motion;
  Motion changed{motion.skeleton, {}};
  Skeleton& skeleton = changed.skeleton;
  skeleton.coordinates.clear();
  std::vector<FreedJoint> freed;
  std::vector<std::size_t> old_columns;  // for each new column that is copied
  std::vector<std::size_t> new_of_old(motion.clip.num_coordinates, 0);
  std::vector<std::size_t> first_free(motion.clip.num_coordinates, kNoParent);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (moves_freely(skeleton.joints[j])) first_free[skeleton.joints[j].dofs[0].coordinate] = j;
  }
  constexpr std::array<const char*, 6> kChannels = {"Xposition", "Yposition", "Zposition",
                                                    "Zrotation", "Yrotation", "Xrotation"};
  for (std::size_t c = 0; c < motion.skeleton.coordinates.size(); ++c) {
    const std::size_t joint = first_free[c];
    const std::size_t column = skeleton.coordinates.size();
    if (joint == kNoParent) {
      new_of_old[c] = column;
      old_columns.push_back(c);
      skeleton.coordinates.push_back(motion.skeleton.coordinates[c]);
      continue;
    }
    freed.push_back({c, column});
    for (const char* channel : kChannels) skeleton.coordinates.push_back({joint, channel});
    old_columns.insert(old_columns.end(), 6, kNoParent);
    c += 6;  // the seven of the joint
  }
  const double radians = radians_per(skeleton.angle_unit);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    Joint& joint = skeleton.joints[j];
    if (!moves_freely(joint)) {
      for (DegreeOfFreedom& dof : joint.dofs) dof.coordinate = new_of_old[dof.coordinate];
      continue;
    }
    const auto own = std::find_if(freed.begin(), freed.end(), [&](const FreedJoint& candidate) {
      return candidate.old_column == joint.dofs[0].coordinate;
    });
    const Vec3 angles =
        euler_angles(rotation_of_pose(joint.free_rest).toRotationMatrix(), freed_axes());
    joint.dofs.clear();
    for (std::size_t k = 0; k < 6; ++k) {
      const auto axis = static_cast<Eigen::Index>(k < 3 ? k : 5 - k);
      joint.dofs.push_back(
          {k < 3 ? DofKind::Translation : DofKind::Rotation, Vec3::Unit(axis), own->new_column + k,
           k < 3 ? joint.free_rest[k] : angles[static_cast<Eigen::Index>(k - 3)] / radians});
    }
  }
  Clip& clip = changed.clip;
  clip.num_frames = motion.clip.num_frames;
  clip.num_coordinates = skeleton.coordinates.size();
  clip.timeline = motion.clip.timeline;
  clip.values.resize(clip.num_frames * clip.num_coordinates);
  const Rows rows = clip.mutate();
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const auto from = motion.clip.row(f);
    for (std::size_t c = 0; c < old_columns.size(); ++c) {
      if (old_columns[c] != kNoParent) rows[f][c] = from[old_columns[c]];
    }
  }
  for (const FreedJoint& joint : freed) {
    write_freed(motion.clip, joint, skeleton.angle_unit, rows);
  }
  return changed;
}

}  // namespace kinefile::robot
