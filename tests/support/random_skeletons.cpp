// SPDX-License-Identifier: MIT
#include "support/random_skeletons.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/random_clips.hpp"

namespace kinefile::test {

namespace {

/// A skeleton in the making.
struct Maker {
  RandomSource& random;
  RandomTraits traits;
  Motion motion = {};
  std::vector<Means> meanings = {};

  Skeleton& skeleton() { return motion.skeleton; }
};

/// Gives about every second joint a shape. They have random numbers of their own, and a red each.
void add_shapes(Skeleton& skeleton) {
  RandomSource random(skeleton.joints.size() + 100 * skeleton.coordinates.size());
  double red = 0;
  for (Joint& joint : skeleton.joints) {
    while (random_chance(random, 0.4)) {
      VisualShape& shape = joint.visuals.emplace_back();
      shape.kind = static_cast<ShapeKind>(random_below(random, 5));
      shape.size = random_vector(random, 1).cwiseAbs();
      shape.position = random_vector(random, 1);
      shape.rotation = random_rotation(random);
      shape.colour = Vec3(++red / 1000, 0.5, 1);
    }
  }
}

std::size_t new_column(Maker& maker, std::size_t joint, Means means) {
  maker.meanings.push_back(means);
  const std::size_t column = maker.skeleton().coordinates.size();
  maker.skeleton().coordinates.push_back({joint, fmt::format("c{}", column)});
  return column;
}

/// A new column, or one that is there.
std::size_t some_column(Maker& maker, std::size_t joint, Means means) {
  if (maker.traits.shared_columns && random_chance(maker.random, 0.07)) {
    std::vector<std::size_t> known;
    for (std::size_t c = 0; c < maker.meanings.size(); ++c) {
      if (maker.meanings[c] == means) known.push_back(c);
    }
    if (!known.empty()) return known[random_below(maker.random, known.size())];
  }
  return new_column(maker, joint, means);
}

/// Three axes: x, y and z in an order, such that are turned, or oblique ones.
std::array<Vec3, 3> random_axes(Maker& maker) {
  std::array<Vec3, 3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  std::swap(axes[0], axes[random_below(maker.random, 3)]);
  std::swap(axes[1], axes[1 + random_below(maker.random, 2)]);
  if (!maker.traits.oblique_axes || random_chance(maker.random, 0.4)) return axes;
  const Quat turn = random_rotation(maker.random);
  for (Vec3& axis : axes) axis = (turn * axis).normalized();
  if (random_chance(maker.random, 0.5)) return axes;
  for (Vec3& axis : axes) axis = (axis + random_vector(maker.random, 0.25)).normalized();
  return axes;
}

double random_rest(Maker& maker, double probability, double size) {
  const bool has_rest = maker.traits.rest_values && random_chance(maker.random, probability);
  return has_rest ? random_number(maker.random, -size, size) : 0;
}

/// Gives a degree of freedom a value that is not its column's number.
void add_gain(Maker& maker, DegreeOfFreedom& dof) {
  const bool is_wanted = maker.traits.gains && dof.kind != DofKind::TailScale;
  if (!is_wanted || !random_chance(maker.random, 0.15)) return;
  const double size = dof.kind == DofKind::Rotation ? 10 : 0.5;
  dof.gain = random_number(maker.random, 0.5, 2) * (random_chance(maker.random, 0.5) ? -1 : 1);
  dof.shift = random_chance(maker.random, 0.5) ? 0 : random_number(maker.random, -size, size);
}

void add_dof(Maker& maker, std::size_t joint, DofKind kind, const Vec3& axis, double rest,
             std::size_t column) {
  std::string& channel = maker.skeleton().coordinates[column].channel;
  const auto along = coordinate_axis(axis);
  if (along && channel.front() == 'c') channel = channel_name(kind, *along);
  for (const Joint& other : maker.skeleton().joints) {  // a column has one rest value
    for (const DegreeOfFreedom& dof : other.dofs) {
      if (num_coordinates(dof) == 1 && dof.coordinate == column) rest = dof.rest;
    }
  }
  DegreeOfFreedom dof{kind, axis, column, rest};
  add_gain(maker, dof);
  maker.skeleton().joints[joint].dofs.push_back(dof);
}

/// A ball or a rotation vector.
void add_whole(Maker& maker, std::size_t joint, DofKind kind) {
  const Means means = kind == DofKind::Ball ? Means::Ball : Means::Vector;
  const std::size_t first = new_column(maker, joint, means);
  for (std::size_t k = 1; k < columns_of_meaning(means); ++k) new_column(maker, joint, means);
  for (std::size_t k = 0; k < columns_of_meaning(means); ++k) {
    maker.skeleton().coordinates[first + k].channel = channel_name(kind, k);
  }
  maker.skeleton().joints[joint].dofs.push_back({kind, Vec3::UnitX(), first, 0});
}

void add_free(Maker& maker, std::size_t joint) {
  const std::size_t first = new_column(maker, joint, Means::Free);
  for (std::size_t k = 1; k < 7; ++k) new_column(maker, joint, Means::Free);
  maker.skeleton().joints[joint].dofs.push_back({DofKind::Free, Vec3::UnitX(), first, 0});
  const Vec3 place = random_vector(maker.random, 1);
  const Quat turn = random_rotation(maker.random);
  maker.skeleton().joints[joint].free_rest = {place[0], place[1], place[2], turn.w(),
                                              turn.x(), turn.y(), turn.z()};
}

void add_dofs(Maker& maker, std::size_t joint, bool is_root) {
  RandomSource& random = maker.random;
  const auto translations = random_axes(maker);
  const std::size_t num_translations =
      random_chance(random, is_root ? 0.8 : 0.2) ? 1 + random_below(random, 3) : 0;
  for (std::size_t k = 0; k < num_translations; ++k) {
    add_dof(maker, joint, DofKind::Translation, translations[k], random_rest(maker, 0.5, 1),
            some_column(maker, joint, Means::Length));
  }
  const auto rotations = random_axes(maker);
  const bool is_whole = maker.traits.whole_rotations && random_chance(random, 0.2);
  if (is_whole) {
    add_whole(maker, joint, random_chance(random, 0.5) ? DofKind::Ball : DofKind::RotationVector);
  }
  const std::size_t num_rotations =
      is_whole ? 0 : (random_chance(random, 0.5) ? 3 : random_below(random, 3));
  for (std::size_t k = 0; k < num_rotations; ++k) {
    add_dof(maker, joint, DofKind::Rotation, rotations[k],
            random_rest(maker, 0.3, quarter_turn(maker.skeleton())),
            some_column(maker, joint, Means::Angle));
  }
  const auto tails = random_axes(maker);
  const std::size_t num_tails = random_chance(random, 0.15) ? 1 + random_below(random, 2) : 0;
  const bool is_scale = random_chance(random, 0.5);
  for (std::size_t k = 0; k < num_tails; ++k) {
    if (is_scale && maker.traits.tail_scales) {
      add_dof(maker, joint, DofKind::TailScale, tails[k], 1,
              some_column(maker, joint, Means::Scale));
    } else if (!is_scale && maker.traits.tail_translations) {
      add_dof(maker, joint, DofKind::TailTranslation, tails[k], random_rest(maker, 0.3, 0.5),
              some_column(maker, joint, Means::Length));
    }
  }
}

Quat random_rest_rotation(RandomSource& random) {
  if (random_chance(random, 0.7)) return random_rotation(random);
  return Quat(Eigen::AngleAxisd(std::numbers::pi / 2,
                                Vec3::Unit(static_cast<Eigen::Index>(random_below(random, 3)))));
}

Vec3 random_offset(RandomSource& random) {
  if (random_chance(random, 0.1)) return Vec3::Zero();
  Vec3 offset = random_vector(random, 1);
  if (random_chance(random, 0.3)) offset[0] = offset[2] = 0;
  return offset;
}

/// Puts the columns into another order; those that mean one thing stay together.
void shuffle_columns(Maker& maker) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t c = 0; c < maker.meanings.size(); ++c) {
    groups.emplace_back();
    const std::size_t count = columns_of_meaning(maker.meanings[c]);
    for (std::size_t k = 0; k < count; ++k) groups.back().push_back(c + k);
    c += count - 1;
  }
  for (std::size_t i = groups.size(); i > 1; --i) {
    std::swap(groups[i - 1], groups[random_below(maker.random, i)]);
  }
  std::vector<std::size_t> new_of_old(maker.meanings.size());
  std::vector<Coordinate> coordinates;
  std::vector<Means> meanings;
  for (const auto& group : groups) {
    for (const std::size_t old : group) {
      new_of_old[old] = coordinates.size();
      coordinates.push_back(maker.skeleton().coordinates[old]);
      meanings.push_back(maker.meanings[old]);
    }
  }
  maker.skeleton().coordinates = std::move(coordinates);
  maker.meanings = std::move(meanings);
  for (Joint& joint : maker.skeleton().joints) {
    for (DegreeOfFreedom& dof : joint.dofs) dof.coordinate = new_of_old[dof.coordinate];
  }
}

void fill_clip(Maker& maker) {
  fill_random_clip(maker.random, maker.meanings, maker.traits.without_frames, maker.motion);
}

}  // namespace

Motion random_motion(RandomSource& random, const RandomTraits& traits) {
  Maker maker{random, traits};
  Skeleton& skeleton = maker.skeleton();
  skeleton.name = "random";
  skeleton.angle_unit = random_chance(random, 0.3) ? AngleUnit::Radians : AngleUnit::Degrees;
  skeleton.metres_per_unit = 0.01;
  const std::size_t num_joints = 1 + random_below(random, 9);
  for (std::size_t j = 0; j < num_joints; ++j) {
    Joint joint;
    joint.name = fmt::format("j{}", j);
    const bool is_root = j == 0 || (traits.several_roots && random_chance(random, 0.1));
    if (!is_root) joint.parent = random_below(random, j);
    joint.offset = random_offset(random);
    if (traits.rest_rotations && random_chance(random, 0.4)) {
      joint.rest_rotation = random_rest_rotation(random);
    }
    for (std::size_t t = random_below(random, 3); t > 0; --t) {
      joint.tips.push_back(
          {random_chance(random, 0.5) ? fmt::format("t{}_{}", j, t) : "", random_offset(random)});
    }
    skeleton.joints.push_back(std::move(joint));
    if (traits.free_joints && random_chance(random, 0.3)) {
      add_free(maker, j);
    } else {
      add_dofs(maker, j, is_root);
    }
    if (traits.unread_columns && random_chance(random, 0.05)) {
      new_column(maker, j, Means::Nothing);
    }
  }
  // The inner ends of bones are tips where a child sits.
  for (std::size_t j = 1; j < num_joints; ++j) {
    const std::size_t parent = skeleton.joints[j].parent;
    if (parent != kNoParent && random_chance(random, 0.2)) {
      skeleton.joints[parent].tips.push_back({"", skeleton.joints[j].offset});
    }
  }
  if (random_chance(random, 0.5)) shuffle_columns(maker);
  add_shapes(maker.skeleton());
  fill_clip(maker);
  EXPECT_TRUE(validate(skeleton));
  return std::move(maker.motion);
}

Motion random_bones(RandomSource& random) {
  Maker maker{random, {}};
  maker.traits.shared_columns = false;
  Skeleton& skeleton = maker.skeleton();
  skeleton.angle_unit = random_chance(random, 0.3) ? AngleUnit::Radians : AngleUnit::Degrees;
  skeleton.metres_per_unit = 0.0254;
  const std::size_t num_joints = 2 + random_below(random, 7);
  for (std::size_t j = 0; j < num_joints; ++j) {
    Joint joint;
    joint.name = j == 0 ? "root" : fmt::format("bone{}", j);
    if (j == 0) {
      joint.offset = random_offset(random);
      joint.rest_rotation = random_rest_rotation(random);
    } else {
      joint.parent = random_below(random, j);
      if (joint.parent != 0) joint.offset = skeleton.joints[joint.parent].tips[0].offset;
      joint.tips.push_back({"", random_offset(random)});
    }
    skeleton.joints.push_back(std::move(joint));
    Quat axes = skeleton.joints[0].rest_rotation.conjugate();
    if (j > 0) axes = random_rotation(random);
    const auto axis = [&axes](Eigen::Index k) { return (axes * Vec3::Unit(k)).normalized(); };
    for (Eigen::Index k = 0; k < 3 && j == 0; ++k) {
      const std::size_t column = new_column(maker, 0, Means::Length);
      skeleton.joints[0].dofs.push_back({DofKind::Translation, axis(k), column, 0});
    }
    const std::size_t num_rotations = j == 0 ? 3 : random_below(random, 4);
    for (std::size_t k = num_rotations; k-- > 0;) {
      const Vec3 about =
          j == 0 ? Vec3::Unit(static_cast<Eigen::Index>(k)) : axis(static_cast<Eigen::Index>(k));
      const std::size_t column = new_column(maker, j, Means::Angle);
      skeleton.joints[j].dofs.push_back({DofKind::Rotation, about, column, 0});
    }
  }
  add_shapes(maker.skeleton());
  fill_clip(maker);
  EXPECT_TRUE(validate(skeleton));
  return std::move(maker.motion);
}

namespace {

/// Lets a joint follow an earlier one of its kind, sometimes; false where it does not. Its own
/// column stands beside. Gains are whole, so that angles a whole turn apart are followed alike.
bool follow_another(Maker& maker, std::size_t joint, DofKind kind) {
  std::vector<DegreeOfFreedom> leaders;
  for (const Joint& other : maker.skeleton().joints) {
    for (const DegreeOfFreedom& dof : other.dofs) {
      if (dof.kind == kind && is_plain(dof)) leaders.push_back(dof);
    }
  }
  if (leaders.empty() || !random_chance(maker.random, 0.25)) return false;
  constexpr std::array<double, 3> kGains = {-1, 1, 2};
  DegreeOfFreedom dof = leaders[random_below(maker.random, leaders.size())];
  dof.axis = random_axes(maker)[0];
  dof.gain = kGains[random_below(maker.random, kGains.size())];
  dof.shift = random_chance(maker.random, 0.5) ? 0 : random_number(maker.random, -0.5, 0.5);
  maker.skeleton().joints[joint].dofs.push_back(dof);
  new_column(maker, joint, Means::Nothing);
  return true;
}

}  // namespace

Motion random_robot(RandomSource& random) {
  Maker maker{random, {}};
  Skeleton& skeleton = maker.skeleton();
  skeleton.angle_unit = AngleUnit::Radians;
  skeleton.metres_per_unit = 1;
  const std::size_t num_joints = 2 + random_below(random, 9);
  for (std::size_t j = 0; j < num_joints; ++j) {
    Joint joint;
    joint.name = fmt::format("LINK{}", j);
    if (j > 0) {
      joint.parent = random_chance(random, 0.7) ? j - 1 : random_below(random, j);
      joint.offset = random_offset(random);
      if (random_chance(random, 0.6)) joint.rest_rotation = random_rest_rotation(random);
    }
    skeleton.joints.push_back(std::move(joint));
    if (j == 0) add_free(maker, 0);
    if (j == 0 || random_chance(random, 0.1)) continue;
    const DofKind kind = random_chance(random, 0.8) ? DofKind::Rotation : DofKind::Translation;
    if (follow_another(maker, j, kind)) continue;
    const std::size_t column =
        new_column(maker, j, kind == DofKind::Rotation ? Means::Angle : Means::Length);
    skeleton.joints[j].dofs.push_back(
        {kind, random_axes(maker)[0], column, random_rest(maker, 0.5, 1)});
  }
  add_shapes(maker.skeleton());
  fill_clip(maker);
  EXPECT_TRUE(validate(skeleton));
  return std::move(maker.motion);
}

namespace {

/// Adds the other half of a joint: its image in the plane x = 0, with axes that are the images.
void add_image(Maker& maker, std::size_t original, std::size_t parent) {
  const Vec3 signs(-1, 1, 1);
  Joint image = maker.skeleton().joints[original];
  image.name.replace(0, 4, "Right");
  image.parent = parent;
  image.offset = signs.cwiseProduct(image.offset);
  image.rest_rotation.y() = -image.rest_rotation.y();
  image.rest_rotation.z() = -image.rest_rotation.z();
  for (Tip& tip : image.tips) tip.offset = signs.cwiseProduct(tip.offset);
  const std::size_t index = maker.skeleton().joints.size();
  const std::vector<DegreeOfFreedom> dofs = std::exchange(image.dofs, {});
  maker.skeleton().joints.push_back(image);
  for (const DegreeOfFreedom& dof : dofs) {
    if (num_coordinates(dof) > 1) {
      add_whole(maker, index, dof.kind);
      continue;
    }
    const Means means = dof.kind == DofKind::Rotation ? Means::Angle : Means::Length;
    maker.skeleton().joints[index].dofs.push_back(dof);
    maker.skeleton().joints[index].dofs.back().coordinate = new_column(maker, index, means);
  }
  image = maker.skeleton().joints[index];
  if (random_chance(maker.random, 0.5)) {
    for (DegreeOfFreedom& dof : image.dofs) dof.axis = signs.cwiseProduct(dof.axis);
  }
  maker.skeleton().joints[index] = std::move(image);
}

}  // namespace

Motion random_symmetric_motion(RandomSource& random, bool rest_rotations) {
  Maker maker{random, {}};
  maker.traits = {.rest_rotations = rest_rotations,
                  .oblique_axes = false,
                  .rest_values = false,
                  .gains = false};
  Skeleton& skeleton = maker.skeleton();
  skeleton.angle_unit = random_chance(random, 0.3) ? AngleUnit::Radians : AngleUnit::Degrees;
  skeleton.metres_per_unit = 1;
  const auto add = [&](std::string name, std::size_t parent, const Vec3& offset, bool is_middle) {
    const std::size_t index = skeleton.joints.size();
    Joint joint;
    joint.name = std::move(name);
    joint.parent = parent;
    joint.offset = offset;
    if (rest_rotations && random_chance(random, 0.5)) {
      joint.rest_rotation =
          is_middle ? Quat(Eigen::AngleAxisd(random_number(random, -3, 3), Vec3::UnitX()))
                    : random_rotation(random);
    }
    skeleton.joints.push_back(std::move(joint));
    const auto axes = random_axes(maker);
    for (std::size_t k = 0; k < 3 && parent == kNoParent; ++k) {
      add_dof(maker, index, DofKind::Translation, axes[k], 0,
              new_column(maker, index, Means::Length));
    }
    if (random_chance(random, 0.2)) {
      add_whole(maker, index, random_chance(random, 0.5) ? DofKind::Ball : DofKind::RotationVector);
      return index;
    }
    const std::size_t num_rotations = is_middle || random_chance(random, 0.5) ? 3 : 1;
    for (std::size_t k = 0; k < num_rotations; ++k) {
      add_dof(maker, index, DofKind::Rotation, axes[k], 0, new_column(maker, index, Means::Angle));
      if (random_chance(random, 0.1)) skeleton.joints[index].dofs.back().gain = -0.5;
    }
    return index;
  };
  const std::size_t hips = add("Hips", kNoParent, Vec3(0, 2, 0.1), true);
  const std::size_t spine = add("Spine", hips, Vec3(0, 0.6, 0.05), true);
  for (const auto& [part, parent] : {std::pair("Leg", hips), std::pair("Arm", spine)}) {
    std::size_t above = parent;
    std::size_t above_image = parent;
    const std::size_t length = 1 + random_below(random, 3);
    for (std::size_t i = 0; i < length; ++i) {
      Vec3 offset = random_vector(random, 0.4) + Vec3(0.7, 0, 0);
      const std::size_t left = add(fmt::format("Left{}{}", part, i), above, offset, false);
      skeleton.joints[left].tips.push_back({"", random_vector(random, 0.3)});
      add_image(maker, left, above_image);
      above = left;
      above_image = left + 1;
    }
  }
  add_shapes(maker.skeleton());
  fill_clip(maker);
  EXPECT_TRUE(validate(skeleton));
  return std::move(maker.motion);
}

Motion with_turned_frames(const Motion& motion, RandomSource& random) {
  Motion turned = motion;
  std::vector<Quat> old_from_new;
  for (Joint& joint : turned.skeleton.joints) {
    const bool is_whole = std::any_of(joint.dofs.begin(), joint.dofs.end(),
                                      [](const auto& dof) { return num_coordinates(dof) > 1; });
    const Quat own = is_whole ? Quat(Quat::Identity()) : random_rotation(random);
    const Quat above =
        joint.parent == kNoParent ? Quat(Quat::Identity()) : old_from_new[joint.parent];
    old_from_new.push_back(own);
    joint.offset = above.conjugate() * joint.offset;
    joint.rest_rotation = (above.conjugate() * joint.rest_rotation * own).normalized();
    for (DegreeOfFreedom& dof : joint.dofs) dof.axis = (own.conjugate() * dof.axis).normalized();
    for (Tip& tip : joint.tips) tip.offset = own.conjugate() * tip.offset;
    for (VisualShape& shape : joint.visuals) {
      shape = in_other_frame(shape, own.conjugate(), Vec3::Zero());
    }
  }
  EXPECT_TRUE(validate(turned.skeleton));
  return turned;
}

}  // namespace kinefile::test
