// SPDX-License-Identifier: MIT
#include "shape/helper_bones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/words.hpp"
#include "kinefile/shape.hpp"

namespace kinefile::shape {
namespace {

/// Properties of the joints of a skeleton, before any is removed; shapes (joints).
struct Helpers {
  std::vector<bool> is_helper;
  std::vector<bool> leads;           ///< a joint that stays is a child of it, or of helpers below
                                     ///< it
  std::vector<std::size_t> stays;    ///< the joint itself, or its nearest ancestor that stays
  std::vector<Vec3> place;           ///< in the frame of that joint; zero for itself
  std::optional<std::size_t> named;  ///< the helper that has the root's name
};

/// A name without its ending.
std::string without_suffix(const std::string& name, std::string_view suffix) {
  return name.substr(0, name.size() - suffix.size());
}

bool has_suffix(const std::string& name, std::string_view suffix) {
  return name.size() > suffix.size() && name.ends_with(suffix);
}

std::vector<bool> find_helpers(const Skeleton& skeleton) {
  std::vector<bool> is_helper;
  for (const Joint& joint : skeleton.joints) {
    is_helper.push_back(joint.parent != kNoParent && has_suffix(joint.name, kHelperSuffix) &&
                        joint.dofs.empty() && joint.rest_rotation.isApprox(Quat::Identity(), 0));
  }
  // A column without effect is kept with the joint that it belongs to.
  for (const Coordinate& column : skeleton.coordinates) is_helper[column.joint] = false;
  return is_helper;
}

/// The sum of two offsets in which a zero adds nothing, not even to the sign of another zero.
Vec3 sum_of(const Vec3& a, const Vec3& b) {
  Vec3 sum = a + b;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (a[k] == 0) sum[k] = b[k];
  }
  return sum;
}

/// The first bone, if it is the helper that has the root's name: one that no joint has.
std::optional<std::size_t> name_of_root(const Skeleton& skeleton,
                                        const std::vector<bool>& is_helper) {
  const auto& joints = skeleton.joints;
  const bool is_named = joints.size() > 1 && is_helper[1] && joints[1].parent == 0 &&
                        joints[0].name == "root" && has_suffix(joints[1].name, kRootHelperSuffix);
  if (!is_named) return std::nullopt;
  // If a joint's own name ends in _root, such a name is that of the helper that leads to the joint.
  const auto is_taken = [&joints](const std::string& name) {
    return std::any_of(joints.begin(), joints.end(), [&name](const Joint& joint) {
      return lowered(joint.name) == lowered(name);
    });
  };
  const bool leads_to_joint = is_taken(without_suffix(joints[1].name, kHelperSuffix)) ||
                              is_taken(without_suffix(joints[1].name, kRootHelperSuffix));
  return leads_to_joint ? std::nullopt : std::optional<std::size_t>(1);
}

Helpers helpers_of(const Skeleton& skeleton) {
  const std::size_t num_joints = skeleton.joints.size();
  Helpers helpers{find_helpers(skeleton), std::vector<bool>(num_joints, false), {}, {}, {}};
  for (std::size_t j = num_joints; j-- > 0;) {
    const std::size_t parent = skeleton.joints[j].parent;
    if (parent != kNoParent && (!helpers.is_helper[j] || helpers.leads[j])) {
      helpers.leads[parent] = true;
    }
  }
  for (std::size_t j = 0; j < num_joints; ++j) {
    const Joint& joint = skeleton.joints[j];
    helpers.stays.push_back(helpers.is_helper[j] ? helpers.stays[joint.parent] : j);
    helpers.place.push_back(helpers.is_helper[j] ? sum_of(helpers.place[joint.parent], joint.offset)
                                                 : Vec3(Vec3::Zero()));
  }
  helpers.named = name_of_root(skeleton, helpers.is_helper);
  return helpers;
}

/// Whether a tip of a joint exists only for the helpers that start at it and lead to other joints.
bool is_for_helpers(const Skeleton& skeleton, const Helpers& helpers, const Tip& tip,
                    const std::vector<std::size_t>& children) {
  return std::any_of(children.begin(), children.end(), [&](std::size_t child) {
    return helpers.is_helper[child] && helpers.leads[child] &&
           skeleton.joints[child].offset == tip.offset;
  });
}

/// Whether a joint that stays is at a tip of a helper.
bool is_at_joint(const Skeleton& skeleton, const Helpers& helpers, const Tip& tip,
                 const std::vector<std::size_t>& children) {
  return std::any_of(children.begin(), children.end(), [&](std::size_t child) {
    return !helpers.is_helper[child] && skeleton.joints[child].offset == tip.offset;
  });
}

/// The tips of a helper become tips of its parent, unless a joint is at their place.
void hand_up_tips(const Skeleton& skeleton, const Helpers& helpers, std::size_t helper,
                  const std::vector<std::size_t>& children, Joint& holder) {
  const bool is_named = helpers.named == helper;
  const std::string stem = without_suffix(skeleton.joints[helper].name, kHelperSuffix);
  const bool has_no_name = is_named || stem.starts_with(holder.name + "_end");
  for (const Tip& tip : skeleton.joints[helper].tips) {
    const bool is_inner = is_for_helpers(skeleton, helpers, tip, children) ||
                          is_at_joint(skeleton, helpers, tip, children);
    const Vec3 place = sum_of(helpers.place[helper], tip.offset);
    if (is_inner || (is_named && place.isZero(0))) continue;
    holder.tips.push_back({has_no_name ? tip.name : stem, place});
  }
}

void hand_up_shapes(const Skeleton& skeleton, const Helpers& helpers, std::size_t helper,
                    Joint& holder) {
  for (const VisualShape& shape : skeleton.joints[helper].visuals) {
    holder.visuals.push_back(in_other_frame(shape, Quat::Identity(), helpers.place[helper]));
  }
}

void report_removed(const Skeleton& skeleton, const Helpers& helpers, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (helpers.is_helper[j]) names.push_back(skeleton.joints[j].name);
  }
  diagnostics.add(Severity::Note, "BRG005", "helper bones are taken out: " + listed(names));
}

}  // namespace

Motion without_helper_bones(Motion motion, Diagnostics& diagnostics) {
  const Skeleton old = std::move(motion.skeleton);
  const Helpers helpers = helpers_of(old);
  const auto children = children_of_joints(old);
  Skeleton& skeleton = motion.skeleton;
  skeleton = old;
  skeleton.joints.clear();
  std::vector<std::size_t> new_of_old;
  for (std::size_t j = 0; j < old.joints.size(); ++j) {
    if (helpers.is_helper[j]) {
      new_of_old.push_back(new_of_old[helpers.stays[j]]);
      hand_up_tips(old, helpers, j, children[j], skeleton.joints[new_of_old.back()]);
      hand_up_shapes(old, helpers, j, skeleton.joints[new_of_old.back()]);
      continue;
    }
    new_of_old.push_back(skeleton.joints.size());
    Joint joint = old.joints[j];
    std::erase_if(joint.tips,
                  [&](const Tip& tip) { return is_for_helpers(old, helpers, tip, children[j]); });
    if (joint.parent != kNoParent) {
      joint.offset = sum_of(helpers.place[joint.parent], joint.offset);
      joint.parent = new_of_old[joint.parent];
    }
    if (j == 0 && helpers.named) {
      joint.name = without_suffix(old.joints[*helpers.named].name, kRootHelperSuffix);
    }
    skeleton.joints.push_back(std::move(joint));
  }
  for (Coordinate& column : skeleton.coordinates) column.joint = new_of_old[column.joint];
  if (skeleton.joints.size() < old.joints.size()) report_removed(old, helpers, diagnostics);
  return motion;
}

}  // namespace kinefile::shape
