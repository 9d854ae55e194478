// SPDX-License-Identifier: MIT
// Body motions on robots: joints by kinematics, links as recorded.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/robot.hpp"
#include "kinematics/joint_columns.hpp"
#include "robot/robot.hpp"

namespace kinefile::robot {
namespace {

void warn(Diagnostics& diagnostics, std::string message) {
  diagnostics.add(Severity::Warning, "BRG014", std::move(message));
}

/// The components of a body motion that move a robot.
struct Recorded {
  const Component* links = nullptr;
  const Component* joints = nullptr;
};

/// Gives the root rotations by roll, pitch and yaw, so that their values stay the same.
void give_root_angles(Skeleton& skeleton) {
  Component one;
  one.kind = ComponentKind::Poses;
  one.content = kLinkPosition;
  one.pose_form = PoseForm::RollPitchYaw;
  const Skeleton rpy = motion_of_component(one).skeleton;
  skeleton.joints[0].dofs = rpy.joints[0].dofs;
  skeleton.coordinates.erase(skeleton.coordinates.begin());
  std::copy(rpy.coordinates.begin(), rpy.coordinates.end(), skeleton.coordinates.begin());
  for (std::size_t j = 1; j < skeleton.joints.size(); ++j) {
    for (DegreeOfFreedom& dof : skeleton.joints[j].dofs) --dof.coordinate;
  }
}

Result<std::size_t> settle_frames(const Recorded& recorded, bool lenient,
                                  Diagnostics& diagnostics) {
  const Component& main = recorded.links != nullptr ? *recorded.links : *recorded.joints;
  if (recorded.links == nullptr || recorded.joints == nullptr) return main.num_frames;
  const std::size_t num_joint_frames = recorded.joints->num_frames;
  const bool is_same_rate = have_same_times(recorded.joints->timeline, main.timeline);
  if (num_joint_frames > main.num_frames || !is_same_rate) {
    const std::string found = words_of_disagreement(*recorded.joints, main);
    if (!lenient) {
      return fail(ErrorKind::DataLoss, "BRG021",
                  fmt::format("expected joints and links of one length and rate, found {}; "
                              "'kinefile resample --fps {:.6g}' brings them to one, --lenient goes "
                              "by the numbers of the frames",
                              found, nominal_frame_rate(main.timeline)));
    }
    warn(diagnostics, fmt::format("there are {}; frames belong together by their numbers, as many "
                                  "as there are of links",
                                  found));
  }
  if (num_joint_frames < main.num_frames) {
    const std::string message = fmt::format("expected {} frames of joints, as of links, found {}",
                                            main.num_frames, num_joint_frames);
    if (!lenient || num_joint_frames == 0) {
      return fail(make_error(ErrorKind::InvalidInput, "BRG011", message));
    }
    diagnostics.add(Severity::Warning, "BRG011", message + "; the last one is held");
  }
  return main.num_frames;
}

void report_counts(const Recorded& recorded, const Skeleton& skeleton, Diagnostics& diagnostics) {
  const auto report = [&](std::size_t found, std::size_t wanted, std::string_view what) {
    if (found == wanted) return;
    warn(diagnostics,
         fmt::format("the model has {} {}, the motion {}; {}", wanted, what, found,
                     found > wanted ? "the last ones are left out" : "the others stay at rest"));
  };
  const std::size_t num_joints = skeleton.coordinates.size() - kRootColumns;
  if (recorded.joints != nullptr) report(recorded.joints->num_parts, num_joints, "joints");
  const bool has_all_links = recorded.links != nullptr && recorded.links->num_parts > 1;
  if (has_all_links && recorded.links->num_parts > skeleton.joints.size()) {
    report(recorded.links->num_parts, skeleton.joints.size(), "links");
  }
}

}  // namespace

bool is_robot(const Skeleton& skeleton) {
  if (skeleton.joints.empty() || !moves_freely(skeleton.joints[0])) return false;
  const Joint& root = skeleton.joints[0];
  if (root.dofs[0].coordinate != 0 || !root.offset.isZero(0) ||
      !root.rest_rotation.isApprox(Quat::Identity(), 0)) {
    return false;
  }
  return std::all_of(skeleton.joints.begin() + 1, skeleton.joints.end(), [](const Joint& joint) {
    const bool moves_in_one_way =
        joint.dofs.empty() ||
        (joint.dofs.size() == 1 && joint.dofs[0].coordinate >= kRootColumns &&
         (joint.dofs[0].kind == DofKind::Rotation || joint.dofs[0].kind == DofKind::Translation));
    return joint.parent != kNoParent && moves_in_one_way;
  });
}

Result<Motion> pose(const BodyMotion& motion, const Skeleton& skeleton, bool lenient,
                    Diagnostics& diagnostics) {
  const Recorded recorded{find_component(motion, ComponentKind::Poses, kLinkPosition),
                          find_component(motion, ComponentKind::Values, kJointDisplacement)};
  if (recorded.links == nullptr && recorded.joints == nullptr) {
    return fail(make_error(ErrorKind::Usage, "BRG010",
                           "expected poses of links or displacements of joints, found neither"));
  }
  if (!is_robot(skeleton)) {
    return fail(make_error(ErrorKind::Usage, "BRG012",
                           "expected the skeleton of a robot, whose root moves freely and whose "
                           "joints move in one way each"));
  }
  const auto num_frames = settle_frames(recorded, lenient, diagnostics);
  if (!num_frames) return fail(num_frames.error());
  report_counts(recorded, skeleton, diagnostics);

  Motion posed{skeleton, {}};
  const bool is_rpy =
      recorded.links != nullptr && recorded.links->pose_form == PoseForm::RollPitchYaw;
  std::vector<double> rest = rest_coordinates(skeleton);
  if (is_rpy) {
    give_root_angles(posed.skeleton);
    rest.erase(rest.begin());
  }
  const std::size_t num_root = is_rpy ? 6 : kRootColumns;
  Clip& clip = posed.clip;
  const Component& main = recorded.links != nullptr ? *recorded.links : *recorded.joints;
  clip.num_frames = *num_frames;
  clip.num_coordinates = posed.skeleton.coordinates.size();
  clip.timeline = main.timeline;
  clip.values.reserve(clip.num_frames * clip.num_coordinates);
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const std::span<double> row = clip.values.grow(rest.size());
    std::copy(rest.begin(), rest.end(), row.begin());
    if (recorded.links != nullptr) {
      const auto root = recorded.links->row(f).first(num_root);
      std::copy(root.begin(), root.end(), row.begin());
    }
    if (recorded.joints != nullptr) {
      const auto from = recorded.joints->row(std::min(f, recorded.joints->num_frames - 1));
      const std::size_t count = std::min(from.size(), row.size() - num_root);
      std::copy_n(from.begin(), count, row.begin() + static_cast<std::ptrdiff_t>(num_root));
    }
  }
  const bool has_all_links =
      recorded.links != nullptr && recorded.links->num_parts >= skeleton.joints.size();
  const bool are_found = recorded.joints == nullptr && has_all_links;
  if (are_found) find_joints(*recorded.links, posed);
  if (!are_found) {  // if joint values were not recorded
    const std::size_t num_joints = recorded.joints == nullptr ? 0 : recorded.joints->num_parts;
    fill_following_columns(posed, num_root + num_joints);
  }
  if (auto settled = settle_following_columns(posed, lenient, diagnostics); !settled) {
    return fail(std::move(settled.error()));
  }
  return posed;
}

void put_recorded_links(const BodyMotion& motion, const Skeleton& skeleton, PoseArrays& poses) {
  const Component* links = find_component(motion, ComponentKind::Poses, kLinkPosition);
  if (links == nullptr || links->num_parts < 2) return;
  const std::size_t count = std::min(links->num_parts, poses.num_joints);
  const std::vector<Vec3> directions =
      poses.directions.empty() ? std::vector<Vec3>() : bone_directions(skeleton);
  for (std::size_t row = 0; row < poses.num_frames; ++row) {
    const std::size_t frame = poses.first_frame + row * poses.frame_step;
    for (std::size_t j = 1; j < count; ++j) {
      const auto recorded = links->row(frame).subspan(j * links->width(), links->width());
      const std::size_t at = row * poses.num_joints + j;
      std::copy_n(recorded.begin(), 3,
                  poses.positions.mutate().begin() + static_cast<std::ptrdiff_t>(at * 3));
      const Quat q = rotation_of(*links, recorded);
      if (!poses.rotations.empty()) {
        const Quat shown = q.w() < 0 ? Quat(-q.coeffs()) : q;
        const double numbers[] = {shown.w(), shown.x(), shown.y(), shown.z()};
        std::copy_n(numbers, 4,
                    poses.rotations.mutate().begin() + static_cast<std::ptrdiff_t>(at * 4));
      }
      if (!poses.directions.empty()) {
        const Vec3 direction = q * directions[j];
        std::copy_n(direction.data(), 3,
                    poses.directions.mutate().begin() + static_cast<std::ptrdiff_t>(at * 3));
      }
    }
  }
}

Result<std::vector<LinkDeviation>> compare_recorded_links(const BodyMotion& motion,
                                                          const Skeleton& skeleton, bool lenient,
                                                          Diagnostics& diagnostics) {
  const Component* links = find_component(motion, ComponentKind::Poses, kLinkPosition);
  if (links == nullptr) {
    return fail(make_error(ErrorKind::Usage, "BRG010",
                           "expected recorded poses of links (LinkPosition), found none"));
  }
  const auto posed = pose(motion, skeleton, lenient, diagnostics);
  if (!posed) return fail(posed.error());
  const std::size_t count = std::min(links->num_parts, skeleton.joints.size());
  std::vector<LinkDeviation> deviations(count);
  for (std::size_t j = 0; j < count; ++j) deviations[j].link = skeleton.joints[j].name;
  const std::size_t block = frames_per_block(posed->skeleton);
  for (std::size_t first = 0; first < posed->clip.num_frames; first += block) {
    const WorldPoses poses =
        forward_kinematics(posed->skeleton, posed->clip,
                           {.first_frame = first, .num_frames = block, .rotations = true});
    for (std::size_t row = 0; row < poses.num_frames; ++row) {
      for (std::size_t j = 0; j < count; ++j) {
        const std::size_t at = row * poses.num_joints + j;
        const auto recorded = links->row(first + row).subspan(j * links->width(), links->width());
        const Vec3 position(recorded[0], recorded[1], recorded[2]);
        const double distance = (Vec3(poses.positions.data() + at * 3) - position).norm();
        const double* q = poses.rotations.data() + at * 4;
        const double degrees =
            angle_between(Quat(q[0], q[1], q[2], q[3]), rotation_of(*links, recorded)) /
            kRadiansPerDegree;
        LinkDeviation& deviation = deviations[j];
        if (distance > deviation.distance) {
          deviation.distance = distance;
          deviation.distance_frame = first + row;
        }
        if (degrees > deviation.degrees) {
          deviation.degrees = degrees;
          deviation.degrees_frame = first + row;
        }
      }
    }
  }
  return deviations;
}

}  // namespace kinefile::robot
