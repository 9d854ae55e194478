// SPDX-License-Identifier: MIT
// Converts a run to joint angles, and finds the joint angles that a servo map names.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words.hpp"
#include "kinefile/robot.hpp"
#include "kinefile/servo.hpp"
#include "servo/angles.hpp"
#include "servo/keyframe_search.hpp"

namespace kinefile::servo {

std::optional<AngleColumn> find_angle(const Skeleton& skeleton, const std::string& name) {
  const double radians = radians_per(skeleton.angle_unit);
  const std::vector<std::string> columns = column_names(skeleton);
  const auto own_columns = value_columns(skeleton);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    if (joint.dofs.size() != 1 || joint.dofs[0].kind != DofKind::Rotation || joint.name != name) {
      continue;
    }
    const bool follows = *own_columns[j] != joint.dofs[0].coordinate;
    return AngleColumn{*own_columns[j], radians, follows ? DegreeOfFreedom{} : joint.dofs[0]};
  }
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind == DofKind::Rotation && columns[dof.coordinate] == name) {
        return AngleColumn{dof.coordinate, radians, dof};
      }
    }
  }
  return std::nullopt;
}

namespace {

/// A joint of a map and the column of its angle in a row.
struct MappedAngle {
  std::size_t entry = 0;
  AngleColumn angle = {};
};

Error no_joints(const std::vector<std::string>& missing, std::string_view where) {
  return make_error(
      ErrorKind::Usage, "SVM010",
      fmt::format("expected joints of the servo map ({}) in the {}, found none of "
                  "them; a joint that turns about several axes is JOINT.CHANNEL, such "
                  "as LeftArm.Zrotation",
                  listed(missing), where));
}

/// The joints of a map that a row has; a diagnostic reports the others.
template <class Find>
Result<std::vector<MappedAngle>> mapped_angles(const ServoMap& map, const Find& find,
                                               std::string_view where, Diagnostics& diagnostics) {
  std::vector<MappedAngle> angles;
  std::vector<std::string> missing;
  for (std::size_t e = 0; e < map.entries.size(); ++e) {
    const std::optional<AngleColumn> found = find(e);
    if (found) {
      angles.push_back({e, *found});
    } else {
      missing.push_back(map.entries[e].joint);
    }
  }
  if (angles.empty()) return fail(no_joints(missing, where));
  if (!missing.empty()) {
    diagnostics.add(Severity::Warning, "SVM011",
                    fmt::format("joints of the servo map that the {} does not have, or not as one "
                                "angle, are left out: {}",
                                where, listed(missing)));
  }
  return angles;
}

/// The columns of the angles of a skeleton's joints in its clip's rows.
Result<std::vector<MappedAngle>> angles_in(const Skeleton& skeleton, const ServoMap& map,
                                           std::string_view where, Diagnostics& diagnostics) {
  const auto find = [&](std::size_t e) { return find_angle(skeleton, map.entries[e].joint); };
  return mapped_angles(map, find, where, diagnostics);
}

/// The columns of joints in joint displacements: by a robot's columns after its root's, by the
/// names of parts, or in the order of the map.
Result<std::vector<MappedAngle>> displaced(const ServoMap& map, const Skeleton* robot,
                                           std::size_t num_parts,
                                           const std::vector<std::string>& names,
                                           Diagnostics& diagnostics) {
  using Found = std::optional<AngleColumn>;
  const auto find = [&](std::size_t e) {
    if (robot == nullptr && !names.empty()) {
      const auto name = std::find(names.begin(), names.end(), map.entries[e].joint);
      return name == names.end()
                 ? Found()
                 : Found(AngleColumn{static_cast<std::size_t>(name - names.begin())});
    }
    if (robot == nullptr) return e < num_parts ? Found(AngleColumn{e}) : Found();
    Found found = find_angle(*robot, map.entries[e].joint);
    if (!found || found->column < kRootColumns) return Found();
    found->column -= kRootColumns;
    return found->column < num_parts ? found : Found();
  };
  return mapped_angles(map, find, "motion of the robot", diagnostics);
}

Result<void> expect_robot(const Skeleton* robot) {
  if (robot == nullptr || robot::is_robot(*robot)) return {};
  return fail(make_error(ErrorKind::Usage, "BRG012",
                         "expected the skeleton of a robot, whose root moves freely and whose "
                         "joints move in one way each"));
}

/// The angle of a joint at a tick; for a slider that the flow does not have, that of the base pose.
double angle_at(const flow::Run& run, std::size_t tick, const ServoMap& map,
                const ServoMapEntry& entry) {
  if (entry.slider >= run.num_sliders) {
    const bool has_base = entry.slider < map.base_pose.size();
    return angle_of_word(entry, has_base ? map.base_pose[entry.slider] : 0);
  }
  return angle_of_word(entry, run.sliders[tick * run.num_sliders + entry.slider]);
}

Timeline timeline_of(const ServoMap& map) {
  return {FrameRate{map.tick_seconds == 1.0 / 60 ? 60 : 1 / map.tick_seconds}, 0};
}

/// The rows of a run: copies of a rest row, with the joints' angles written into them.
Array<double> rows_of(const flow::Run& run, const ServoMap& map, const std::vector<double>& rest,
                      const std::vector<MappedAngle>& angles) {
  Array<double> values;
  values.reserve((run.num_ticks + 1) * rest.size());
  for (std::size_t tick = 0; tick <= run.num_ticks; ++tick) {
    const std::span<double> row = values.grow(rest.size());
    std::copy(rest.begin(), rest.end(), row.begin());
    for (const MappedAngle& angle : angles) {
      const double found = angle_at(run, tick, map, map.entries[angle.entry]);
      row[angle.angle.column] = angle.angle.number_of(found);
    }
  }
  return values;
}

/// Computes the joints that follow others in rows of a robot's displacements, except those that
/// have a servo.
void fill_following(const Skeleton& robot, const std::vector<MappedAngle>& angles,
                    Component& component) {
  const Rows rows = component.mutate();
  for (const FollowingColumn& following : following_columns(robot)) {
    const DegreeOfFreedom& dof = robot.joints[following.joint].dofs[0];
    const bool has_servo = std::any_of(angles.begin(), angles.end(), [&](const MappedAngle& own) {
      return own.angle.column + kRootColumns == following.column;
    });
    if (has_servo || dof.coordinate < kRootColumns) continue;
    for (std::size_t f = 0; f < component.num_frames; ++f) {
      rows[f][following.column - kRootColumns] =
          value_of(dof, rows[f][dof.coordinate - kRootColumns]);
    }
  }
}

/// Reports sliders that the flow does not have.
void report_missing_sliders(const flow::Run& run, const ServoMap& map,
                            const std::vector<MappedAngle>& angles, Diagnostics& diagnostics) {
  std::vector<std::string> missing;
  for (const MappedAngle& angle : angles) {
    const ServoMapEntry& entry = map.entries[angle.entry];
    if (entry.slider >= run.num_sliders) missing.push_back(entry.joint);
  }
  if (missing.empty()) return;
  diagnostics.add(Severity::Warning, "SVM015",
                  fmt::format("the flow has {} sliders, and none for {}: these joints stay in the "
                              "map's base pose",
                              run.num_sliders, listed(missing)));
}

/// Rows of numbers over time, from which a trajectory reads some columns.
struct RecordedRows {
  std::span<const double> values;
  std::size_t num_frames;
  std::size_t row_size;
  const Timeline& timeline;
};

Result<JointTrajectory> trajectory_of_rows(const RecordedRows& rows, const ServoMap& map,
                                           const std::vector<MappedAngle>& angles) {
  JointTrajectory trajectory;
  for (const MappedAngle& angle : angles) {
    trajectory.joints.push_back(map.entries[angle.entry].joint);
  }
  const auto value = [&](std::size_t frame, const MappedAngle& angle) {
    return angle.angle.angle_of(rows.values[frame * rows.row_size + angle.angle.column]);
  };
  const Array<double>& times = own_times(rows.timeline);
  if (times.empty()) {
    trajectory.num_frames = rows.num_frames;
    trajectory.frame_time = 1 / nominal_frame_rate(rows.timeline);
    for (std::size_t f = 0; f < rows.num_frames; ++f) {
      for (const MappedAngle& angle : angles) trajectory.angles.push_back(value(f, angle));
    }
    return trajectory;
  }
  const auto num_ticks = num_ticks_of(times.back() - times.front(), map.tick_seconds);
  if (!num_ticks) return fail(num_ticks.error());
  trajectory.frame_time = map.tick_seconds;
  trajectory.num_frames = *num_ticks + 1;
  for (std::size_t tick = 0; tick < trajectory.num_frames; ++tick) {
    const auto [frame, share] =
        position_in_time(times, times.front() + static_cast<double>(tick) * map.tick_seconds);
    for (const MappedAngle& angle : angles) {
      const double from = value(frame, angle);
      trajectory.angles.push_back(share == 0 ? from
                                             : from + (value(frame + 1, angle) - from) * share);
    }
  }
  return trajectory;
}

}  // namespace

Result<BodyMotion> unroll(const flow::Run& run, const ServoMap& map, const Skeleton* robot,
                          Diagnostics& diagnostics) {
  if (const auto is_good = expect_robot(robot); !is_good) return fail(is_good.error());
  std::vector<double> rest(map.entries.size(), 0);
  if (robot != nullptr) {
    rest = rest_coordinates(*robot);
    rest.erase(rest.begin(), rest.begin() + kRootColumns);
  }
  const auto angles = displaced(map, robot, rest.size(), {}, diagnostics);
  if (!angles) return fail(angles.error());
  report_missing_sliders(run, map, *angles, diagnostics);
  BodyMotion motion;
  Component& component = motion.components.emplace_back();
  component.kind = ComponentKind::Values;
  component.content = kJointDisplacement;
  component.num_parts = rest.size();
  component.num_frames = run.num_ticks + 1;
  component.timeline = timeline_of(map);
  component.values = rows_of(run, map, rest, *angles);
  if (robot != nullptr) fill_following(*robot, *angles, component);
  if (robot == nullptr) {
    for (const ServoMapEntry& entry : map.entries) component.part_names.push_back(entry.joint);
  }
  return motion;
}

Result<Motion> motion_of_run(const flow::Run& run, const ServoMap& map, const Skeleton& skeleton,
                             Diagnostics& diagnostics) {
  const auto angles = angles_in(skeleton, map, "skeleton", diagnostics);
  if (!angles) return fail(angles.error());
  report_missing_sliders(run, map, *angles, diagnostics);
  Motion motion{skeleton, {}};
  motion.clip.num_frames = run.num_ticks + 1;
  motion.clip.num_coordinates = skeleton.coordinates.size();
  motion.clip.timeline = timeline_of(map);
  motion.clip.values = rows_of(run, map, rest_coordinates(skeleton), *angles);
  return motion;
}

Result<JointTrajectory> trajectory_of(const Motion& motion, const ServoMap& map,
                                      Diagnostics& diagnostics) {
  const auto angles = angles_in(motion.skeleton, map, "motion", diagnostics);
  if (!angles) return fail(angles.error());
  const std::size_t num_columns = motion.clip.num_coordinates;
  if (angles->size() < num_columns) {
    diagnostics.add(
        Severity::Note, "SVM014",
        fmt::format("servos follow {} of the motion's {} columns; the others, and where "
                    "the figure goes, are left out",
                    angles->size(), num_columns));
  }
  const Clip& clip = motion.clip;
  return trajectory_of_rows({clip.values, clip.num_frames, clip.num_coordinates, clip.timeline},
                            map, *angles);
}

Result<JointTrajectory> trajectory_of(const BodyMotion& motion, const ServoMap& map,
                                      const Skeleton* robot, Diagnostics& diagnostics) {
  if (const auto is_good = expect_robot(robot); !is_good) return fail(is_good.error());
  const Component* joints = find_component(motion, ComponentKind::Values, kJointDisplacement);
  if (joints == nullptr) {
    return fail(make_error(ErrorKind::Usage, "BRG010",
                           "expected displacements of joints (JointDisplacement), found none"));
  }
  const auto angles = displaced(map, robot, joints->num_parts, joints->part_names, diagnostics);
  if (!angles) return fail(angles.error());
  if (motion.components.size() > 1 || angles->size() < joints->num_parts) {
    diagnostics.add(Severity::Note, "SVM014",
                    fmt::format("servos follow {} of {} joints; the others and other components, "
                                "such as where the robot goes, are left out",
                                angles->size(), joints->num_parts));
  }
  if (robot == nullptr && joints->part_names.empty() && joints->num_parts != map.entries.size()) {
    diagnostics.add(Severity::Warning, "SVM012",
                    fmt::format("expected {} joints, as the servo map has, found {}; without "
                                "--skeleton they are taken in its order",
                                map.entries.size(), joints->num_parts));
  }
  return trajectory_of_rows(
      {joints->values, joints->num_frames, joints->num_parts, joints->timeline}, map, *angles);
}

}  // namespace kinefile::servo
