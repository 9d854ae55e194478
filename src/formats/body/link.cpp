// SPDX-License-Identifier: MIT
#include "formats/body/link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/words.hpp"
#include "formats/body/codes.hpp"

namespace kinefile::body {
namespace {

using robot_file::JointType;
using robot_file::Link;
using text::yaml::Node;
using text::yaml::NodeKind;

constexpr double kLargestId = 4e9;  // far beyond the limit, and fits a size_t on every machine

/// The known keys of links, between blanks: those that we read, and those that move nothing. In
/// lower case and without underscores, because every key has two spellings.
constexpr std::string_view kKnownKeys =
    " "
    "actuationmode amor autosleep centerofmass childlinks collision contactmaterial "
    "damping density deviceprefix elements encoderpulse forcerange gearratio "
    "grouserheight grouserthickness import inertia info initialjointangles isoptional "
    "jointangle jointaxis jointdisplacement jointeffortrange jointid jointidoffset "
    "jointname jointoffset jointrange jointtype jointvelocityrange lights mass masstype "
    "material maxjointeffort maxjointvelocity name numjoints parent prefix restitution "
    "rotation rotorinertia rotorresistor selfcollision sensors suffix torqueconst "
    "translation type uri ";

bool fail(Values& values, const Node& node, const char* code, std::string message) {
  values.error(node, code, std::move(message));
  return false;
}

bool is_known_key(std::string_view key) {
  std::string word = lowered(key);
  word.erase(std::remove(word.begin(), word.end(), '_'), word.end());
  return word.find(' ') == std::string::npos &&
         kKnownKeys.find(" " + word + " ") != std::string_view::npos;
}

void note_unknown_keys(Values& values, const Node& node) {
  for (std::size_t i = 0; i + 1 < node.children.size(); i += 2) {
    const Node& name = *node.children[i];
    if (name.kind != NodeKind::Scalar || is_known_key(name.text)) continue;
    values.spot(name).report(
        values.diagnostics, Severity::Note, code::kUnknownKey,
        fmt::format("the key {} of a link is not known, and ignored", text::quoted(name.text)));
  }
}

bool read_joint_type(Values& values, const Node& node, Link& link) {
  const Node* value = find_any(node, {"joint_type", "jointType"});
  if (value == nullptr) return true;
  if (value->text == "revolute") {
    link.type = JointType::Revolute;
  } else if (value->text == "prismatic" || value->text == "slide") {
    link.type = JointType::Prismatic;
  } else if (value->text == "free") {
    link.type = JointType::Free;
  } else if (value->text == "fixed") {
    link.type = JointType::Fixed;
  } else if (value->text == "pseudo_continuous_track" || value->text == "pseudoContinuousTrack") {
    link.type = JointType::ContinuousTrack;
  } else {
    return fail(values, *value, code::kUnknownWord,
                fmt::format("expected revolute, prismatic, free, fixed or "
                            "pseudo_continuous_track as joint_type, found {}",
                            text::quoted(value->text)));
  }
  return true;
}

bool read_joint_id(Values& values, const Node& node, Link& link) {
  const Node* value = find_any(node, {"joint_id", "jointId"});
  if (value == nullptr) return true;
  const auto number = values.number(*value, "joint_id");
  if (!number) return false;
  if (*number != std::floor(*number)) {
    return fail(
        values, *value, code::kBadValue,
        fmt::format("expected a whole number as joint_id, found {}", text::quoted(value->text)));
  }
  set_id(link, *number, values.spot(*value));
  return true;
}

bool read_axis_word(Values& values, const Node& value, Link& link) {
  std::string word = lowered(value.text);
  const bool is_negative = word.starts_with('-');
  if (is_negative) word.erase(0, 1);
  if (word.size() != 1 || word[0] < 'x' || word[0] > 'z') {
    return fail(values, value, code::kUnknownWord,
                fmt::format("expected three numbers, X, Y, Z, -X, -Y or -Z as joint_axis, found "
                            "{}",
                            text::quoted(value.text)));
  }
  link.axis = Vec3::Unit(word[0] - 'x') * (is_negative ? -1 : 1);
  return true;
}

bool read_axis(Values& values, const Node& node, Link& link) {
  const Node* value = find_any(node, {"joint_axis", "jointAxis"});
  if (value == nullptr) return true;
  link.axis_spot = values.spot(*value);
  if (value->kind == NodeKind::Scalar) return read_axis_word(values, *value, link);
  const auto axis = values.vector(*value, "joint_axis");
  if (axis) link.axis = *axis;
  return axis.has_value();
}

bool read_displacement(Values& values, const Node& node, Link& link) {
  const Node* angle = find_any(node, {"joint_angle", "jointAngle"});
  const Node* value = find_any(node, {"joint_displacement", "jointDisplacement"});
  if (value == nullptr) value = angle;
  if (value == nullptr) return true;
  const auto number = values.number(*value, "the joint's displacement");
  if (!number) return false;
  const bool is_angle = value == angle || link.type == JointType::Revolute;
  link.rest = is_angle ? values.radians(*number) : *number;
  return true;
}

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// A limit in the joint's unit.
/// \param none  what an infinite one becomes, whatever its sign
bool read_limit(Values& values, const Node& value, const Link& link, double none, double& limit) {
  const auto number = values.limit(value);
  if (!number) return false;
  const bool is_angle = link.type == JointType::Revolute;
  limit = std::isinf(*number) ? none : is_angle ? values.radians(*number) : *number;
  return true;
}

/// A list of two limits.
/// \param wanted  what is expected, for a message
bool read_both(Values& values, const Node& node, std::string_view wanted, const Link& link,
               double& lower, double& upper) {
  if (node.kind != NodeKind::Sequence || node.children.size() != 2) {
    return fail(values, node, code::kBadValue, fmt::format("expected {}", wanted));
  }
  return read_limit(values, *node.children[0], link, -kUnlimited, lower) &&
         read_limit(values, *node.children[1], link, kUnlimited, upper);
}

bool read_range(Values& values, const Node& node, Link& link) {
  const Node* value = find_any(node, {"joint_range", "jointRange"});
  if (value == nullptr) return true;
  if (value->kind == NodeKind::Scalar) {
    if (!read_limit(values, *value, link, kUnlimited, link.upper)) return false;
    link.lower = -link.upper;
    return true;
  }
  return read_both(values, *value, "two numbers or one as joint_range", link, link.lower,
                   link.upper);
}

bool read_speed(Values& values, const Node& node, Link& link) {
  const Node* value = find_any(node, {"max_joint_velocity", "maxJointVelocity"});
  if (value != nullptr && !read_limit(values, *value, link, kUnlimited, link.max_speed)) {
    return false;
  }
  const Node* range = find_any(node, {"joint_velocity_range", "jointVelocityRange"});
  if (range != nullptr) {
    double slowest = 0;
    double fastest = 0;
    if (!read_both(values, *range, "two numbers as joint_velocity_range", link, slowest, fastest))
      return false;
    link.max_speed = std::max(std::abs(slowest), std::abs(fastest));
  }
  link.max_speed = std::abs(link.max_speed);
  return true;
}

}  // namespace

void set_id(Link& link, double id, const robot_file::Spot& spot) {
  link.joint_id.reset();
  if (id >= 0) link.joint_id = static_cast<std::size_t>(std::min(id, kLargestId));
  link.id_spot = spot;
}

bool read_translation(Values& values, const Node& node, Vec3& translation) {
  const Node* value = find_any(node, {"translation"});
  if (value == nullptr) return true;
  const auto rows = values.rows(*value, "translation", 3);
  if (!rows) return false;
  translation = Vec3::Zero();
  for (const auto& row : *rows) translation += Vec3(row[0], row[1], row[2]);
  return translation.allFinite() ||
         fail(values, *value, code::kBadValue, "expected a finite translation, found a larger one");
}

bool read_rotation(Values& values, const Node& node, Quat& rotation) {
  const Node* value = find_any(node, {"rotation"});
  if (value == nullptr) return true;
  const auto rows = values.rows(*value, "rotation", 4);
  if (!rows) return false;
  rotation = Quat::Identity();
  for (const auto& row : *rows) {
    const Quat turn = robot_file::rotation_about({row[0], row[1], row[2]}, values.radians(row[3]));
    rotation = (rotation * turn).normalized();
  }
  return true;
}

bool read_contents(Values& values, const Node& node, Link& link) {
  note_unknown_keys(values, node);
  if (const Node* parent = find_any(node, {"parent"})) {
    link.parent = parent->text;
    link.parent_spot = values.spot(*parent);
  }
  bool is_good = read_translation(values, node, link.translation);
  is_good &= read_rotation(values, node, link.rotation);
  is_good &= read_joint_type(values, node, link);
  is_good &= read_joint_id(values, node, link);
  is_good &= read_axis(values, node, link);
  is_good &= read_displacement(values, node, link);
  is_good &= read_range(values, node, link);
  is_good &= read_speed(values, node, link);
  return is_good;
}

}  // namespace kinefile::body
