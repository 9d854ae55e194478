// SPDX-License-Identifier: MIT
#include "edit/travel.hpp"

#include "kinefile/kinematics.hpp"

namespace kinefile::edit {

std::vector<Traveller> travellers_of(const Motion& motion, std::span<const std::size_t> joints) {
  const Skeleton& skeleton = motion.skeleton;
  std::vector<JointFrame> frames(skeleton.joints.size());
  const Clip rest = rest_clip(skeleton);
  const Clip& clip = motion.clip.num_frames > 0 ? motion.clip : rest;
  Kinematics(skeleton).place_row(clip.row(0), frames);
  std::vector<Traveller> travellers;
  for (const std::size_t j : joints) {
    const Joint& joint = skeleton.joints[j];
    Traveller traveller;
    traveller.joint = j;
    traveller.is_root = joint.parent == kNoParent;
    if (!traveller.is_root) {
      traveller.world_from_parent = Quat(frames[joint.parent].rotation);
      traveller.parent_position = frames[joint.parent].position;
    }
    traveller.offset = joint.offset;
    traveller.translations = translations_of(joint);
    travellers.push_back(std::move(traveller));
  }
  return travellers;
}

Vec3 to_world(const Traveller& traveller, const Vec3& vector) {
  return traveller.is_root ? vector : traveller.world_from_parent * vector;
}

Vec3 to_parent(const Traveller& traveller, const Vec3& vector) {
  return traveller.is_root ? vector : traveller.world_from_parent.conjugate() * vector;
}

Vec3 position_of(const Traveller& traveller, std::span<const double> row) {
  const Vec3 place = position_in_row(traveller.offset, traveller.translations, row);
  return traveller.is_root ? place : Vec3(to_world(traveller, place) + traveller.parent_position);
}

void move_to(const Traveller& traveller, const Vec3& position, std::span<double> row) {
  const Vec3 place =
      traveller.is_root ? position : to_parent(traveller, position - traveller.parent_position);
  fit_position(traveller.offset, traveller.translations, place, row);
}

}  // namespace kinefile::edit
