// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/words.hpp"
#include "formats/acclaim/bind.hpp"
#include "formats/acclaim/codes.hpp"
#include "text/numbers.hpp"
#include "text/scanner.hpp"

namespace kinefile::acclaim {
namespace {

constexpr double kSquareTolerance = 1e-9;

Error not_expressible(const Joint& joint, std::string_view why) {
  return make_error(ErrorKind::DataLoss, code::kNotExpressible,
                    fmt::format("ASF cannot say that joint '{}' {}", joint.name, why));
}

/// A degree of freedom and its word.
struct Worded {
  const DegreeOfFreedom* dof;
  DofWord word;
};

/// The axis that a column's own word names, such as "rx" or "Xrotation"; 3 for none.
std::size_t axis_of_channel(std::string_view channel) {
  if (channel.size() == 2) channel.remove_prefix(1);  // rx, ty
  const std::size_t at =
      channel.empty() ? std::string_view::npos : std::string_view("xyzXYZ").find(channel.front());
  return at == std::string_view::npos ? 3 : at % 3;
}

/// The source of the words of a joint's rotations and translations.
enum class WordsFrom {
  Columns,  ///< the words of their columns, if these are all different
  Axes,     ///< their axes, if these are x, y and z
};

/// The coordinate axis for a degree of freedom's word; 3 for none.
std::size_t named_axis(const Skeleton& skeleton, const DegreeOfFreedom& dof, WordsFrom from) {
  return from == WordsFrom::Columns ? axis_of_channel(skeleton.coordinates[dof.coordinate].channel)
                                    : coordinate_axis(dof.axis).value_or(3);
}

/// Gives the rotations, or the translations, of a joint their words; x, y and z in turn if they
/// have no words of their own.
void add_words(const Skeleton& skeleton, const std::vector<const DegreeOfFreedom*>& dofs,
               WordsFrom from, DofWord first_word, std::vector<Worded>& worded) {
  std::set<std::size_t> axes;
  for (const DegreeOfFreedom* dof : dofs) axes.insert(named_axis(skeleton, *dof, from));
  const bool are_named = axes.size() == dofs.size() && !axes.contains(3);
  for (std::size_t d = 0; d < dofs.size(); ++d) {
    const std::size_t axis = are_named ? named_axis(skeleton, *dofs[d], from) : d;
    worded.push_back({dofs[d], static_cast<DofWord>(static_cast<std::size_t>(first_word) + axis)});
  }
}

/// The words of a joint in the order of application: translations, the length, then the rotations
/// from the innermost on.
Result<std::vector<Worded>> words_of(const Skeleton& skeleton, const Joint& joint, WordsFrom from) {
  std::vector<const DegreeOfFreedom*> translations;
  std::vector<const DegreeOfFreedom*> rotations;
  std::vector<const DegreeOfFreedom*> lengths;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    switch (dof.kind) {
      case DofKind::Translation:
        translations.push_back(&dof);
        break;
      case DofKind::Rotation:
        rotations.insert(rotations.begin(), &dof);
        break;
      case DofKind::TailTranslation:
        lengths.push_back(&dof);
        break;
      case DofKind::Ball:
      case DofKind::RotationVector:
        return fail(not_expressible(joint, "turns in any way"));
      case DofKind::Free:
      case DofKind::TailScale:
        return fail(not_expressible(joint, "moves freely or is scaled"));
    }
    if (!is_plain(dof)) {
      return fail(not_expressible(joint, "follows a column with a gain or a shift"));
    }
    if (dof.rest != 0) return fail(not_expressible(joint, "rests at another value than 0"));
  }
  if (translations.size() > 3 || rotations.size() > 3 || lengths.size() > 1) {
    return fail(not_expressible(joint, "has more than three movements of a kind"));
  }
  std::vector<Worded> worded;
  add_words(skeleton, translations, from, DofWord::Tx, worded);
  for (const DegreeOfFreedom* dof : lengths) worded.push_back({dof, DofWord::Length});
  add_words(skeleton, rotations, from, DofWord::Rx, worded);
  return worded;
}

/// A rotation that maps the coordinate axis k to a unit vector. (Eigen's FromTwoVectors finds the
/// axis of a half turn by an SVD, which takes longer to compile than this file.)
Quat turn_onto(Eigen::Index k, const Vec3& unit) {
  const Vec3 from = Vec3::Unit(k);
  const Vec3 onto = unit.normalized();
  const double cosine = from.dot(onto);
  const Vec3 across = from.cross(onto);
  if (cosine > -0.5) {
    const double twice_w = std::sqrt((1 + cosine) * 2);
    const Vec3 v = across * (1 / twice_w);
    return Quat(twice_w / 2, v.x(), v.y(), v.z());
  }
  const double sine = across.norm();  // near a half turn, 1 + cosine loses digits
  const Vec3 any = Vec3::Unit(k == 2 ? 1 : 2);
  const Vec3 v = (sine > 0 ? Vec3(across / sine) : any) * (1 - cosine);
  return Quat(sine, v.x(), v.y(), v.z()).normalized();
}

/// The axes of a bone's words, as a rotation from x, y and z, as far as its degrees of freedom
/// determine them; empty if they are not at right angles or form a mirror image.
std::optional<Mat3> axes_of(const std::vector<Worded>& worded) {
  Mat3 axes = Mat3::Zero();
  for (const Worded& one : worded) {
    if (one.word == DofWord::Length) continue;
    auto column = axes.col(static_cast<Eigen::Index>(axis_of(one.word)));
    if (column.squaredNorm() > 0 && column != one.dof->axis) return std::nullopt;
    column = one.dof->axis;
  }
  for (Eigen::Index k = 0; k < 3; ++k) {  // two known axes determine the third
    const Eigen::Index next = (k + 1) % 3;
    const Eigen::Index last = (k + 2) % 3;
    const bool is_missing = axes.col(k).squaredNorm() == 0;
    const bool has_others = axes.col(next).squaredNorm() > 0 && axes.col(last).squaredNorm() > 0;
    if (is_missing && has_others) axes.col(k) = axes.col(next).cross(axes.col(last)).normalized();
  }
  for (Eigen::Index k = 0; k < 3; ++k) {  // one known axis: any rotation that maps it there
    if (axes.col(k).squaredNorm() == 0 || axes.col((k + 1) % 3).squaredNorm() > 0) continue;
    axes = turn_onto(k, axes.col(k)).toRotationMatrix();
    break;
  }
  if (axes.isZero()) return Mat3::Identity();
  const bool is_rotation =
      (axes.transpose() * axes).isIdentity(kSquareTolerance) && axes.determinant() > 0;
  return is_rotation ? std::optional(axes) : std::nullopt;
}

Orientation orientation_of(const Mat3& rotation, AngleUnit unit) {
  const Vec3 angles = euler_angles(rotation, {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()});
  const double scale = radians_per(unit);
  return {{angles[2] / scale, angles[1] / scale, angles[0] / scale}, {0, 1, 2}};
}

/// Whether an orientation gives all degrees of freedom their axes, bit for bit.
bool says_axes(const Orientation& axis, const std::vector<Worded>& worded, AngleUnit unit) {
  const Mat3 axes = rotation_of(axis, unit);
  return std::all_of(worded.begin(), worded.end(), [&axes](const Worded& one) {
    return one.word == DofWord::Length ||
           Vec3(axes * Vec3::Unit(static_cast<Eigen::Index>(axis_of(one.word)))) == one.dof->axis;
  });
}

void set_end(Bone& bone, const Vec3& end) {
  if (end_of(bone) == end) return;
  bone.length = length_of(end);
  const Vec3 direction = bone.length > 0 ? Vec3(end / bone.length) : Vec3::UnitY();
  bone.direction = {direction[0], direction[1], direction[2]};
}

std::vector<DofWord> dofs_of(const std::vector<Worded>& worded) {
  std::vector<DofWord> dofs;
  for (const Worded& one : worded) dofs.push_back(one.word);
  return dofs;
}

std::vector<std::size_t> columns_of(const std::vector<Worded>& worded) {
  std::vector<std::size_t> columns;
  for (const Worded& one : worded) columns.push_back(one.dof->coordinate);
  return columns;
}

/// Puts the words into the order of their columns if this gives the same rotation, which means that
/// the rotations have the same order in both.
void order_by_columns(std::vector<Worded>& worded) {
  std::vector<Worded> sorted = worded;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Worded& a, const Worded& b) {
    return a.dof->coordinate < b.dof->coordinate;
  });
  const auto rotations = [](const std::vector<Worded>& all) {
    std::vector<DofWord> words;
    for (const Worded& one : all) {
      if (is_rotation(one.word)) words.push_back(one.word);
    }
    return words;
  };
  if (rotations(sorted) == rotations(worded)) worded = std::move(sorted);
}

/// The limits of a bone for other words about the same axes; empty if a word has no limit.
std::vector<Limit> limits_of(const Bone& bone, const std::vector<DofWord>& dofs) {
  std::vector<Limit> limits;
  for (const DofWord word : dofs) {
    const auto found = std::find(bone.dofs.begin(), bone.dofs.end(), word);
    const auto index = static_cast<std::size_t>(found - bone.dofs.begin());
    if (index >= bone.limits.size()) return {};
    limits.push_back(bone.limits[index]);
  }
  return limits;
}

Result<Bone> unbind_bone(const Skeleton& skeleton, std::size_t index, AngleUnit unit,
                         std::vector<std::size_t>& columns) {
  const Joint& joint = skeleton.joints[index];
  if (!is_bone_name(joint.name)) {
    return fail(not_expressible(joint, "has a name that is no word of its own"));
  }
  const Joint* parent = joint.parent == kNoParent ? nullptr : &skeleton.joints[joint.parent];
  if (parent == nullptr) return fail(not_expressible(joint, "is a second root"));
  const Vec3 start =
      joint.parent == 0 || parent->tips.empty() ? Vec3(Vec3::Zero()) : parent->tips.front().offset;
  if (joint.offset != start) return fail(not_expressible(joint, "does not sit where a bone ends"));
  if (joint.tips.size() != 1) return fail(not_expressible(joint, "has no end, or several"));
  if (!joint.rest_rotation.isApprox(Quat::Identity(), 0)) {
    return fail(not_expressible(joint, "is turned in its rest pose"));
  }
  const Bone* const kept = joint.kept.get<Bone>();
  Bone bone = kept != nullptr ? *kept : Bone{};
  bone.name = joint.name;
  const Vec3 end = joint.tips.front().offset;
  set_end(bone, end);
  if (!std::isfinite(bone.length))
    return fail(not_expressible(joint, "has a length beyond numbers"));
  auto worded = words_of(skeleton, joint, WordsFrom::Columns);
  if (!worded) return fail(std::move(worded.error()));
  const bool has_own_axes = says_axes(bone.axis, *worded, unit);
  if (!has_own_axes) {
    auto axes = axes_of(*worded);
    if (!axes) {
      worded = words_of(skeleton, joint, WordsFrom::Axes);
      axes = axes_of(*worded);
    }
    if (!axes) return fail(not_expressible(joint, "moves about axes that are not at right angles"));
    bone.axis = orientation_of(*axes, unit);
  }
  order_by_columns(*worded);
  for (const Worded& one : *worded) {
    const bool is_along = one.word != DofWord::Length || end.isZero(0) ||
                          one.dof->axis.isApprox(end / length_of(end), kSquareTolerance);
    if (!is_along) return fail(not_expressible(joint, "grows along another line than its bone"));
  }
  const std::vector<DofWord> dofs = dofs_of(*worded);
  if (bone.dofs != dofs || !has_own_axes) {
    bone.limits = has_own_axes ? limits_of(bone, dofs) : std::vector<Limit>{};
    bone.dofs = dofs;
  }
  columns = columns_of(*worded);
  return bone;
}

/// Whether the root's words fit its axes: it rotates about x, y and z after its orientation, and
/// moves along the world's axes.
bool says_root_axes(const Mat3& rest, const std::vector<Worded>& worded) {
  return std::all_of(worded.begin(), worded.end(), [&rest](const Worded& one) {
    const Vec3 axis = Vec3::Unit(static_cast<Eigen::Index>(axis_of(one.word)));
    const Vec3 stated = is_rotation(one.word) ? axis : Vec3(rest.transpose() * axis);
    return one.word != DofWord::Length && one.dof->axis.isApprox(stated, kSquareTolerance);
  });
}

Result<Root> unbind_root(const Skeleton& skeleton, AngleUnit unit,
                         std::vector<std::size_t>& columns) {
  const Joint& joint = skeleton.joints.front();
  const Root* const kept = joint.kept.get<Root>();
  if (joint.name != "root") return fail(not_expressible(joint, "is the root under this name"));
  if (!joint.tips.empty()) return fail(not_expressible(joint, "has an end, though it is the root"));
  const Mat3 rest = joint.rest_rotation.toRotationMatrix();
  auto worded = words_of(skeleton, joint, WordsFrom::Columns);
  if (worded && !says_root_axes(rest, *worded)) {
    worded = words_of(skeleton, joint, WordsFrom::Axes);
  }
  if (!worded) return fail(std::move(worded.error()));
  if (!says_root_axes(rest, *worded)) {
    return fail(not_expressible(joint, "moves about or along other axes than x, y and z"));
  }
  order_by_columns(*worded);
  if (!joint.offset.allFinite()) return fail(not_expressible(joint, "rests at no finite place"));
  Root root;
  root.position = {joint.offset[0], joint.offset[1], joint.offset[2]};
  root.order = dofs_of(*worded);
  if (kept != nullptr) root.orientation = kept->orientation;
  if (Quat(rotation_of(root.orientation, unit)).coeffs() != joint.rest_rotation.coeffs()) {
    root.orientation = orientation_of(rest, unit);
  }
  columns = columns_of(*worded);
  return root;
}

/// If every bone's words are those that :FORCE-ALL-JOINTS-BE-3DOF makes from the words in its file,
/// restores the words of the file. Returns whether it did.
bool restore_forced(Unbound& unbound, const Skeleton& skeleton,
                    const std::vector<std::size_t>& joint_of_bone) {
  std::vector<Bone> bones = unbound.file.bones;
  auto columns = unbound.columns;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const Bone* const kept = skeleton.joints[joint_of_bone[b]].kept.get<Bone>();
    if (kept == nullptr) return false;
    AsfFile alone;
    alone.bones.push_back(bones[b]);
    alone.bones[0].parent = kNoParent;
    alone.bones[0].dofs = kept->dofs;
    alone.angle = unbound.file.angle;
    const Skeleton forced = bind(alone, {true, 1.0});
    const Joint& joint = skeleton.joints[joint_of_bone[b]];
    const Joint& again = forced.joints[1];
    if (again.dofs.size() != joint.dofs.size()) return false;
    columns[b + 1].assign(forced.coordinates.size(), 0);
    for (std::size_t d = 0; d < joint.dofs.size(); ++d) {
      if (again.dofs[d].kind != joint.dofs[d].kind) return false;
      if (!again.dofs[d].axis.isApprox(joint.dofs[d].axis, kSquareTolerance)) return false;
      columns[b + 1][again.dofs[d].coordinate] = joint.dofs[d].coordinate;
    }
    bones[b].dofs = kept->dofs;
    bones[b].limits = kept->limits;
  }
  unbound.file.bones = std::move(bones);
  unbound.columns = std::move(columns);
  return true;
}

/// An error if no joint reads some column, because its values would be lost.
std::optional<Error> unread_column(const Skeleton& skeleton, const Unbound& unbound) {
  std::vector<bool> is_read(skeleton.coordinates.size(), false);
  for (const auto& columns : unbound.columns) {
    for (const std::size_t c : columns) is_read[c] = true;
  }
  for (std::size_t c = 0; c < is_read.size(); ++c) {
    if (is_read[c]) continue;
    const Coordinate& column = skeleton.coordinates[c];
    return not_expressible(skeleton.joints[column.joint],
                           fmt::format("has a column '{}' that moves nothing", column.channel));
  }
  return std::nullopt;
}

}  // namespace

Result<Unbound> unbind(const Skeleton& skeleton, const KeptFile& kept) {
  if (skeleton.joints.empty()) {
    return fail(make_error(ErrorKind::DataLoss, code::kNotExpressible,
                           "ASF cannot say that a skeleton has no joints"));
  }
  Unbound unbound;
  unbound.file = kept.asf;
  unbound.file.name = skeleton.name;
  if (!unbound.file.angle) unbound.file.angle = skeleton.angle_unit;
  const AngleUnit unit = *unbound.file.angle;
  if (!unbound.file.length && skeleton.metres_per_unit > 0) {
    unbound.file.length = kMetresPerInch / skeleton.metres_per_unit;
  }
  unbound.columns.emplace_back();
  auto root = unbind_root(skeleton, unit, unbound.columns.back());
  if (!root) return fail(std::move(root.error()));
  unbound.file.root = std::move(*root);

  std::set<std::string> names;
  std::vector<std::size_t> joint_of_bone;
  for (std::size_t j = 1; j < skeleton.joints.size(); ++j) {
    unbound.columns.emplace_back();
    auto bone = unbind_bone(skeleton, j, unit, unbound.columns.back());
    if (!bone) return fail(std::move(bone.error()));
    bone->parent = skeleton.joints[j].parent == 0 ? kNoParent : skeleton.joints[j].parent - 1;
    if (!names.insert(lowered(bone->name)).second) {
      return fail(not_expressible(skeleton.joints[j], "has a name that another one has, too"));
    }
    joint_of_bone.push_back(j);
    unbound.file.bones.push_back(std::move(*bone));
  }
  if (auto unread = unread_column(skeleton, unbound)) return fail(std::move(*unread));
  const bool was_forced = kept.motion && kept.motion->forces_3dof;
  unbound.forces_3dof = was_forced && restore_forced(unbound, skeleton, joint_of_bone);
  return unbound;
}

}  // namespace kinefile::acclaim
