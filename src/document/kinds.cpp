// SPDX-License-Identifier: MIT
// Converts documents to the kind that a format can hold: motions or body motions.

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/words.hpp"
#include "document/conventions.hpp"
#include "kinefile/convert.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/operation.hpp"
#include "kinefile/retime.hpp"

namespace kinefile {
namespace {

constexpr const char* kZIsUp =
    "z points up in a body motion of a robot, whatever --up says: the joints' values stay";

/// One unit of a motion's lengths in metres, guessed if the file does not specify it.
double settle_unit(const Motion& motion, Diagnostics& diagnostics) {
  const LengthUnit unit = find_length_unit(motion);
  if (unit.certainty == Certainty::Known) return unit.metres;
  diagnostics.add(Severity::Note, "CNV003",
                  fmt::format("the file does not say its unit of length; {}, so a unit is taken to "
                              "be {} m{} (--unit-in says otherwise)",
                              unit.reason, unit.metres,
                              unit.certainty == Certainty::Doubtful ? ", which is doubtful" : ""));
  return unit.metres;
}

Result<Motion> turned_up(Motion motion, std::size_t usual, const KindOptions& options,
                         Diagnostics& diagnostics) {
  const std::size_t up = options.up.value_or(usual);
  if (options.keeps_up) return motion;
  motion.skeleton.up = settle_up_axis(motion, diagnostics).axis;
  if (motion.skeleton.up == up) return motion;
  diagnostics.add(Severity::Note, "CNV004",
                  fmt::format("the motion is turned so that {} points up (--up as-is leaves it)",
                              up == 1 ? 'y' : 'z'));
  return edit::up(std::move(motion), up, diagnostics);
}

/// Reports values of joint ids that no joint of the robot has; poses do not contain them.
void tell_unread(const Motion& motion, Diagnostics& diagnostics) {
  std::vector<std::size_t> num_readers = num_readers_of_columns(motion.skeleton);
  for (const FollowingColumn& following : following_columns(motion.skeleton)) {
    ++num_readers[following.column];  // the joint gets this value by following another
  }
  std::vector<std::string> ids;
  for (std::size_t c = kRootColumns; c < num_readers.size(); ++c) {
    const bool is_lost = num_readers[c] == 0 && !is_always(motion.clip, c, 0);
    if (is_lost) ids.push_back(fmt::format("{}", c - kRootColumns));
  }
  if (ids.empty()) return;
  diagnostics.add(
      Severity::Warning, "CNV008",
      fmt::format("the values of joint ids that no joint of the robot has are left out: "
                  "{}",
                  listed(ids)));
}

Result<BodyMotion> in_form(const BodyMotion& body, const KindOptions& options,
                           Diagnostics& diagnostics) {
  if (options.model == nullptr) {
    return fail(make_error(ErrorKind::Usage, "CNV002",
                           "expected a model for --form, found none; --skeleton names one"));
  }
  const auto posed = robot::pose(body, skeleton_of(*options.model), options.lenient, diagnostics);
  if (!posed) return fail(posed.error());
  if (*options.form == robot::BodyForm::Links) tell_unread(*posed, diagnostics);
  if (!robot::is_robot(posed->skeleton)) {
    return fail(make_error(ErrorKind::Usage, "CNV002",
                           "expected a root pose with a quaternion for --form; convert it with "
                           "--se3-format XYZQWQXQYQZ first"));
  }
  return robot::project(*posed, *options.form, &body, diagnostics);
}

/// The names of the robot's joints, and what they follow.
robot::RobotNames names_of(const KindOptions& options) {
  robot::RobotNames names;
  names.source_of = options.joint_map;
  return names;
}

/// The names of a robot's links and joints.
std::set<std::string_view> names_of_parts(const Skeleton& robot) {
  std::set<std::string_view> names;
  for (const Joint& joint : robot.joints) {
    names.insert(joint.name);
    if (!joint.joint_name.empty()) names.insert(joint.joint_name);
  }
  return names;
}

/// \errors CNV007 (Usage) if a name in an entry of the map is not a link or joint of the robot, or
/// not a joint of the figure
Result<void> expect_known(const robot::RobotNames& names, const Skeleton& figure,
                          const Skeleton& robot) {
  const std::set<std::string_view> parts = names_of_parts(robot);
  std::set<std::string> joints;
  for (const Joint& joint : figure.joints) joints.insert(lowered(joint.name));
  for (const auto& [name, source] : names.source_of) {
    const bool is_part = parts.contains(name);
    if (is_part && joints.contains(lowered(source))) continue;
    return fail(ErrorKind::Usage, "CNV007",
                fmt::format("the line '{}: {}' of the map has no effect: there is no {} '{}'", name,
                            source, is_part ? "joint of the motion" : "link or joint of the robot",
                            is_part ? source : name));
  }
  return {};
}

Result<BodyMotion> body_of(Motion motion, const KindOptions& options, Diagnostics& diagnostics) {
  const bool is_of_robot = robot::is_robot(motion.skeleton);
  const bool wants_joints = options.form && *options.form != robot::BodyForm::Links;
  const robot::BodyForm usual = is_of_robot ? robot::BodyForm::Joints : robot::BodyForm::Links;
  if (!is_of_robot) {
    motion.skeleton.metres_per_unit = settle_unit(motion, diagnostics);
    auto turned = turned_up(std::move(motion), 2, options, diagnostics);
    if (!turned) return fail(std::move(turned.error()));
    motion = std::move(*turned);
  }
  if (is_of_robot || !wants_joints || options.model == nullptr) {
    return robot::project(motion, options.form.value_or(usual), nullptr, diagnostics);
  }
  const robot::RobotNames names = names_of(options);
  if (auto known = expect_known(names, motion.skeleton, skeleton_of(*options.model)); !known) {
    return fail(std::move(known.error()));
  }
  auto body =
      robot::onto_robot(motion, skeleton_of(*options.model), names, options.lenient, diagnostics);
  if (!body || *options.form == robot::BodyForm::Joints) return body;
  return in_form(*body, options, diagnostics);
}

void tell_left_out(const Component& component, Diagnostics& diagnostics) {
  diagnostics.add(Severity::Warning, "CNV005",
                  fmt::format("the component '{}' is left out: the output has no place for it",
                              component.content));
}

void tell_dropped(const BodyMotion& body, bool has_model, Diagnostics& diagnostics) {
  for (const Component& component : body.components) {
    const bool is_link = component.content == kLinkPosition;
    const bool is_joint = component.content == kJointDisplacement && has_model;
    if (!is_link && !is_joint) tell_left_out(component, diagnostics);
  }
}

/// \param usual_up  1 y, 2 z
Result<Motion> motion_of(const BodyMotion& body, std::size_t usual_up, const KindOptions& options,
                         Diagnostics& diagnostics) {
  tell_dropped(body, options.model != nullptr, diagnostics);
  const bool has_root = find_component(body, ComponentKind::Poses, kLinkPosition) != nullptr;
  if (options.model != nullptr && !has_root) {
    diagnostics.add(Severity::Note, "CNV010",
                    "the file has no pose of the root link, which stays where it rests");
  }
  auto posed = options.model != nullptr
                   ? robot::pose(body, skeleton_of(*options.model), options.lenient, diagnostics)
                   : robot::motion_of_links(body);
  if (!posed) return posed;
  tell_unread(*posed, diagnostics);
  return turned_up(robot::without_free_joints(*posed), usual_up, options, diagnostics);
}

/// The same components with the robot's names of joints, in order of their ids, and of links.
BodyMotion with_names_of(BodyMotion body, const Skeleton& robot) {
  for (Component& component : body.components) {
    auto& names = component.part_names;
    if (component.content == kLinkPosition && component.num_parts <= robot.joints.size()) {
      names.clear();
      for (std::size_t part = 0; part < component.num_parts; ++part) {
        names.push_back(robot.joints[part].name);
      }
    }
    const bool has_ids = component.content == kJointDisplacement && robot::is_robot(robot) &&
                         component.num_parts + kRootColumns <= robot.coordinates.size();
    if (!has_ids) continue;
    names = names_of_value_columns(robot);
    names.resize(component.num_parts);
  }
  return body;
}

/// The data that an hrpsys set can store: joints, the root's pose, a ZMP relative to the root.
Result<BodyMotion> set_of(const Document& document, const KindOptions& options,
                          Diagnostics& diagnostics) {
  KindOptions as_joints = options;
  if (options.model != nullptr) as_joints.form = options.form.value_or(robot::BodyForm::Joints);
  const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (body == nullptr &&
      (motion == nullptr || (options.model == nullptr && !robot::is_robot(motion->skeleton)))) {
    return fail(make_error(ErrorKind::Usage, "CNV002",
                           "expected a robot's motion for hrpsys; --skeleton names a robot to put "
                           "others on"));
  }
  auto made = body == nullptr            ? body_of(*motion, as_joints, diagnostics)
              : options.model != nullptr ? in_form(*body, as_joints, diagnostics)
                                         : Result<BodyMotion>(*body);
  if (!made) return made;
  std::erase_if(made->components, [&](const Component& component) {
    const bool has_place = component.content == kLinkPosition || component.content == kZmp ||
                           component.content == kJointDisplacement;
    if (!has_place) tell_left_out(component, diagnostics);
    return !has_place;
  });
  const Component* links = find_component(*made, ComponentKind::Poses, kLinkPosition);
  if (links != nullptr && links->num_parts > 1) {
    diagnostics.add(Severity::Warning, "CNV005",
                    "the poses of links but the first are left out: the output has no place for "
                    "them");
  }
  const Component* zmp = find_component(*made, ComponentKind::Vectors, kZmp);
  return zmp == nullptr ? made : robot::zmp(*made, true, diagnostics);
}

bool takes_flows_alone(const Conventions& conventions) {
  const Kinds& writes = conventions.writes;
  return writes.flows && !writes.motions && !writes.skeletons && !writes.body_motions;
}

/// Why a format does not read a table of these columns as the components that they are; nothing if
/// it does, or reads no tables.
std::optional<std::string> fault_of_columns(const Format& format, const Motion& columns,
                                            const BodyMotion& body) {
  if (format.read == nullptr) return std::nullopt;
  Document row;  // of zeros: only the names matter
  row.content = Motion{columns.skeleton, {1, columns.clip.num_coordinates, {}, {FrameRate{1}, 0}}};
  std::get<Motion>(row.content).clip.values.resize(columns.clip.num_coordinates);
  std::string text;
  const Sink sink = [&text](std::string_view piece) {
    text += piece;
    return true;
  };
  Diagnostics ignored;
  if (auto written = format.write(row, {}, sink, ignored); !written) return written.error().message;
  const auto read = format.read(text, {}, ignored);
  if (!read) return read.error().message;
  const BodyMotion* const found = std::get_if<BodyMotion>(&read->content);
  std::vector<const Component*> parts;
  for (const Component& component : body.components) {
    if (component.kind == ComponentKind::Other) continue;
    if (robot::agree(component, *main_component(body))) parts.push_back(&component);
  }
  const bool is_same =
      found != nullptr &&
      std::equal(parts.begin(), parts.end(), found->components.begin(), found->components.end(),
                 [](const Component* a, const Component& b) {
                   return a->kind == b.kind && a->content == b.content &&
                          a->num_parts == b.num_parts && a->pose_form == b.pose_form &&
                          a->is_root_relative == b.is_root_relative;
                 });
  if (is_same) return std::nullopt;
  return "its columns would be taken for other components";
}

/// A body motion as a motion whose columns are its components' values.
Result<Document> as_columns(const Format& format, Document document, const BodyMotion& body,
                            const Skeleton* robot, bool lenient, Diagnostics& diagnostics) {
  const BodyMotion named = robot == nullptr ? body : with_names_of(body, *robot);
  auto columns = robot::motion_of_components(named, lenient, diagnostics);
  if (!columns) return fail(std::move(columns.error()));
  if (const auto fault = fault_of_columns(format, *columns, named)) {
    const std::string message = "a table of these components cannot be read back: " + *fault;
    if (!lenient) {
      return fail(ErrorKind::DataLoss, "CNV012", message + "; --lenient writes it all the same");
    }
    diagnostics.add(Severity::Warning, "CNV012", message);
  }
  document.content = std::move(*columns);
  document.format.clear();
  return document;
}

/// A motion or a skeleton with the requested up axis.
/// \param usual  the format's; absent: either
Result<Document> with_up_axis(Document document, std::optional<std::size_t> usual,
                              const KindOptions& options, Diagnostics& diagnostics) {
  const std::optional<std::size_t> up = options.up ? options.up : usual;
  if (!up || options.keeps_up) return document;
  auto turned = change_motion(document, [&](Motion motion) {
    return turned_up(std::move(motion), *up, options, diagnostics);
  });
  if (!turned) return fail(std::move(turned.error()));
  return document;
}

/// Converts a motion or a skeleton to a kind that the format can write.
Result<Document> motion_for(const Format& format, Document document, const KindOptions& options,
                            Diagnostics& diagnostics) {
  const Conventions& conventions = format.conventions;
  const Motion* motion = std::get_if<Motion>(&document.content);
  const bool wants_columns = conventions.has_columns_of_components && options.form && motion;
  if (!takes_bodies_alone(conventions) && !wants_columns) {
    return with_up_axis(std::move(document), conventions.up, options, diagnostics);
  }
  if (motion == nullptr) {
    return fail(make_error(ErrorKind::Usage, "CNV002",
                           "expected a motion to make a body motion of, found a skeleton alone"));
  }
  if (options.up == std::size_t{1} && robot::is_robot(motion->skeleton)) {
    return fail(ErrorKind::Usage, "CNV007", kZIsUp);
  }
  auto body = body_of(*motion, options, diagnostics);
  if (!body) return fail(std::move(body.error()));
  if (wants_columns) {
    const Skeleton own = motion->skeleton;
    const Skeleton* robot = options.model != nullptr ? &skeleton_of(*options.model) : &own;
    return as_columns(format, std::move(document), *body, robot, options.lenient, diagnostics);
  }
  document.content = std::move(*body);
  return document;
}

/// Converts a body motion to a kind that the format can write.
Result<Document> body_for(const Format& format, Document document, const KindOptions& options,
                          Diagnostics& diagnostics) {
  const Conventions& conventions = format.conventions;
  BodyMotion body = *std::get_if<BodyMotion>(&document.content);
  const bool stays = conventions.writes.body_motions;
  if (stays && options.up == std::size_t{1}) {
    return fail(ErrorKind::Usage, "CNV007", kZIsUp);
  }
  if (options.form && takes_components(conventions)) {
    auto formed = in_form(body, options, diagnostics);
    if (!formed) return fail(std::move(formed.error()));
    body = std::move(*formed);
  }
  if (conventions.has_columns_of_components) {
    return as_columns(format, std::move(document), body,
                      options.model == nullptr ? nullptr : &skeleton_of(*options.model),
                      options.lenient, diagnostics);
  }
  if (stays) {
    document.content = std::move(body);
    return document;
  }
  document.format.clear();
  auto motion = motion_of(body, conventions.up.value_or(1), options, diagnostics);
  if (!motion) return fail(std::move(motion.error()));
  document.content = std::move(*motion);
  return document;
}

Error no_way(const Document& document) {
  const bool is_flow = std::holds_alternative<PoseFlow>(document.content);
  return make_error(
      ErrorKind::Usage, "CNV006",
      is_flow ? "a flow of poses has no motion until it is run: 'kinefile run' with a servo map "
                "makes one"
              : "a motion becomes a flow of servo poses by 'kinefile keyframe' with a servo map");
}

/// Whether the motion is mapped to the joints of the model.
bool goes_onto_joints(const Conventions& conventions, const Document& document,
                      const KindOptions& options) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  const bool has_place = takes_bodies_alone(conventions) || conventions.has_columns_of_components;
  if (motion == nullptr || robot::is_robot(motion->skeleton) || !has_place) return false;
  return options.form ? *options.form != robot::BodyForm::Links : conventions.is_root_and_joints;
}

}  // namespace

bool uses_model(const Format& format, const Document& document, const KindOptions& options) {
  if (!std::holds_alternative<BodyMotion>(document.content)) {
    return goes_onto_joints(format.conventions, document, options);
  }
  return !format.conventions.writes.body_motions || format.conventions.is_root_and_joints ||
         options.form;
}

Result<Document> in_kind_of(const Format& format, Document document, const KindOptions& options,
                            Diagnostics& diagnostics) {
  const Conventions& conventions = format.conventions;
  if (auto valid = validate(document); !valid) return fail(std::move(valid.error()));
  if (options.model != nullptr && !has_skeleton(*options.model)) {
    return fail(wrong_kind(*options.model, "a robot as the model"));
  }
  if (std::holds_alternative<PoseFlow>(document.content) ? !conventions.writes.flows
                                                         : takes_flows_alone(conventions)) {
    return fail(no_way(document));
  }
  auto steady = at_steady_rate(format, std::move(document), options.lenient, diagnostics);
  if (!steady) return steady;
  document = without_helper_bones(format, std::move(*steady), diagnostics);
  const PoseFlow* flow = std::get_if<PoseFlow>(&document.content);
  const bool is_onto_joints =
      options.model != nullptr && goes_onto_joints(conventions, document, options);
  if (!options.joint_map.empty() && !is_onto_joints) {
    return fail(
        ErrorKind::Usage, "CNV007",
        "a map of joints has no effect here: it is for a motion that goes onto the joints of "
        "a robot (--form joints or both, and a robot)");
  }
  if (flow != nullptr) {
    const auto wanted = conventions.flow_format ? conventions.flow_format : options.flow_format;
    if (!wanted) return document;
    auto formed = flow::in_format(*flow, *wanted, diagnostics);
    if (!formed) return fail(std::move(formed.error()));
    document.content = std::move(*formed);
    return document;
  }
  if (conventions.is_root_and_joints) {
    auto set = set_of(document, options, diagnostics);
    if (!set) return fail(std::move(set.error()));
    document.content = std::move(*set);
    return document;
  }
  return std::holds_alternative<BodyMotion>(document.content)
             ? body_for(format, std::move(document), options, diagnostics)
             : motion_for(format, std::move(document), options, diagnostics);
}

}  // namespace kinefile
