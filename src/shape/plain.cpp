// SPDX-License-Identifier: MIT
// Motions for formats in which a column is just one angle or length.

#include <algorithm>

#include "kinefile/joint_rotation.hpp"
#include "kinefile/shape.hpp"
#include "kinematics/rotation_batches.hpp"
#include "shape/frame_change.hpp"

namespace kinefile::shape {
namespace {

/// Which column a new column is computed from, and by which degree of freedom.
struct Valued {
  std::size_t from = 0;
  std::size_t to = 0;
  DegreeOfFreedom dof;
};

/// Gives a degree of freedom its own column, which holds its values.
void read_values_from(std::size_t column, DegreeOfFreedom& dof, std::vector<Valued>& valued) {
  valued.push_back({dof.coordinate, column, dof});
  dof.rest = value_of(dof, dof.rest);
  dof.coordinate = column;
  dof.gain = 1;
  dof.shift = 0;
}

/// The following column of a joint (see `following_columns`), if it has one.
std::optional<std::size_t> own_column_of(const std::vector<FollowingColumn>& following,
                                         std::size_t joint) {
  const auto own = std::find_if(following.begin(), following.end(),
                                [joint](const FollowingColumn& one) { return one.joint == joint; });
  return own == following.end() ? std::nullopt : std::optional(own->column);
}

/// A column of a motion without whole rotations: an old one, or an angle of a joint.
struct AngleSource {
  std::size_t old_column = kNoParent;
  std::size_t joint = 0;
  std::size_t component = 0;
};

/// The joints that turn as a whole (see `is_whole_rotation`) and do not move freely.
std::vector<std::size_t> whole_turning_joints(const Skeleton& skeleton) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    if (!moves_freely(joint) && is_whole_rotation(rotations_of(joint))) joints.push_back(j);
  }
  return joints;
}

/// Columns that only the whole rotations of some joints read.
std::vector<bool> columns_of_whole_rotations(const Skeleton& skeleton,
                                             const std::vector<std::size_t>& joints) {
  std::vector<std::size_t> readers = num_readers_of_columns(skeleton);
  std::vector<bool> is_read(readers.size(), false);
  for (const std::size_t j : joints) {
    const DegreeOfFreedom dof = rotations_of(skeleton.joints[j])[0];
    for (std::size_t k = 0; k < num_coordinates(dof); ++k) {
      is_read[dof.coordinate + k] = true;
      --readers[dof.coordinate + k];
    }
  }
  for (std::size_t c = 0; c < readers.size(); ++c) is_read[c] = is_read[c] && readers[c] == 0;
  return is_read;
}

/// The columns of the new motion: the three angles of a joint are where its old columns begin.
std::vector<AngleSource> plan_angles(const Skeleton& skeleton,
                                     const std::vector<std::size_t>& joints) {
  const std::vector<bool> is_replaced = columns_of_whole_rotations(skeleton, joints);
  std::vector<AngleSource> sources;
  for (std::size_t c = 0; c < skeleton.coordinates.size(); ++c) {
    for (const std::size_t j : joints) {
      if (rotations_of(skeleton.joints[j])[0].coordinate != c) continue;
      for (std::size_t k = 0; k < 3; ++k) sources.push_back({kNoParent, j, k});
    }
    if (!is_replaced[c]) sources.push_back({c, 0, 0});
  }
  return sources;
}

/// A joint that turns as a whole, and gets three angles.
struct NewAngles {
  RotationReader reader;
  std::size_t first;  ///< of its three columns
  rotation::AngleFinder finder;
};

/// Writes the angles of a joint's whole rotation.
void fill_angles(const Clip& clip, NewAngles& made, const Rows& rows) {
  simd::Quaternions found;
  simd::Angles angles;
  for (const FrameBatch& frames : batches_of(clip.num_frames)) {
    made.reader.read(clip, frames, found);
    made.finder.find(found, frames.count, angles);
    for (std::size_t i = 0; i < frames.count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) rows[frames.first + i][made.first + k] = angles[k][i];
    }
  }
}

/// Replaces a joint's whole rotation by three rotations.
void turn_by_angles(Joint& joint, const RotationOrder& order, std::size_t first) {
  const auto whole = std::find_if(joint.dofs.begin(), joint.dofs.end(), [](const auto& dof) {
    return dof.kind == DofKind::Ball || dof.kind == DofKind::RotationVector;
  });
  const auto at = joint.dofs.erase(whole);
  std::vector<DegreeOfFreedom> turns;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(static_cast<Eigen::Index>(order[k]));
    turns.push_back({DofKind::Rotation, axis, first + k, 0});
  }
  joint.dofs.insert(at, turns.begin(), turns.end());
}

/// Copies rows, with zeros in columns that are new behind the old ones.
void widen(const Clip& clip, const Rows& rows) {
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const auto row = clip.row(f);
    std::fill(std::copy(row.begin(), row.end(), rows[f].begin()), rows[f].end(), 0.0);
  }
}

/// The change of `with_plain_values`; the skeleton alone if all values are plain.
FrameChange plain_values(const Skeleton& old) {
  const auto following = following_columns(old);
  const std::vector<std::size_t> readers = num_readers_of_columns(old);
  FrameChange change{old};
  Skeleton& skeleton = change.skeleton;
  std::vector<Valued> valued;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const auto own = own_column_of(following, j);
    for (DegreeOfFreedom& dof : skeleton.joints[j].dofs) {
      if (is_plain(dof) && !own) continue;
      std::size_t column = own.value_or(dof.coordinate);
      if (!own && readers[column] > 1) {
        column = skeleton.coordinates.size();
        skeleton.coordinates.push_back({j, skeleton.coordinates[dof.coordinate].channel});
      }
      read_values_from(column, dof, valued);
    }
  }
  if (valued.empty()) return change;
  change.fill = [valued = std::move(valued)](const Clip& next, const Rows& rows) {
    widen(next, rows);
    for (std::size_t f = 0; f < next.num_frames; ++f) {
      for (const Valued& one : valued) rows[f][one.to] = value_of(one.dof, next.row(f)[one.from]);
    }
  };
  return change;
}

EulerAxes axes_of(const RotationOrder& order) {
  return {Vec3::Unit(static_cast<Eigen::Index>(order[0])),
          Vec3::Unit(static_cast<Eigen::Index>(order[1])),
          Vec3::Unit(static_cast<Eigen::Index>(order[2]))};
}

/// Fills the rows of a motion without whole rotations.
void fill_columns(const Clip& clip, const std::vector<AngleSource>& sources,
                  std::vector<NewAngles>& angles, const Rows& rows) {
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    for (std::size_t c = 0; c < sources.size(); ++c) {
      if (sources[c].old_column != kNoParent) rows[f][c] = clip.row(f)[sources[c].old_column];
    }
  }
  for (NewAngles& made : angles) fill_angles(clip, made, rows);
}

/// The change of `with_angles`; the skeleton alone if no joint turns as a whole.
FrameChange angles_of(const Skeleton& old, const RotationOrder& order) {
  const std::vector<std::size_t> joints = whole_turning_joints(old);
  FrameChange change{old};
  if (joints.empty()) return change;
  std::vector<AngleSource> sources = plan_angles(old, joints);
  Skeleton& skeleton = change.skeleton;
  skeleton.coordinates.clear();
  std::vector<std::size_t> new_of_old(old.coordinates.size(), 0);
  std::vector<std::size_t> first_angle(skeleton.joints.size(), kNoParent);
  for (std::size_t c = 0; c < sources.size(); ++c) {
    const AngleSource& source = sources[c];
    if (source.old_column != kNoParent) {
      new_of_old[source.old_column] = c;
      skeleton.coordinates.push_back(old.coordinates[source.old_column]);
      continue;
    }
    if (source.component == 0) first_angle[source.joint] = c;
    skeleton.coordinates.push_back(
        {source.joint, channel_name(DofKind::Rotation, order[source.component])});
  }
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    Joint& joint = skeleton.joints[j];
    for (DegreeOfFreedom& dof : joint.dofs) dof.coordinate = new_of_old[dof.coordinate];
    if (first_angle[j] != kNoParent) turn_by_angles(joint, order, first_angle[j]);
  }
  std::vector<NewAngles> angles;
  for (const std::size_t j : joints) {
    const bool is_in_degrees = old.angle_unit == AngleUnit::Degrees;
    angles.push_back({RotationReader(rotations_of(old.joints[j]), old.angle_unit), first_angle[j],
                      rotation::AngleFinder(axes_of(order), is_in_degrees, Vec3::Zero())});
  }
  change.fill = [sources = std::move(sources), angles = std::move(angles)](
                    const Clip& next, const Rows& rows) mutable {
    fill_columns(next, sources, angles, rows);
  };
  return change;
}

}  // namespace

Motion with_plain_values(const Motion& motion) {
  return changed(motion, plain_values(motion.skeleton));
}
LongMotion with_plain_values(const LongMotion& motion) {
  return changed(motion, plain_values(skeleton_in(motion)));
}

Motion with_angles(const Motion& motion, const RotationOrder& order) {
  return changed(motion, angles_of(motion.skeleton, order));
}
LongMotion with_angles(const LongMotion& motion, const RotationOrder& order) {
  return changed(motion, angles_of(skeleton_in(motion), order));
}

}  // namespace kinefile::shape
