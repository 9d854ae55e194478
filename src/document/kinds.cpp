// SPDX-License-Identifier: MIT
// Motions for formats of motions, body motions for formats of those.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "kinefile/convert.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/retime.hpp"

namespace kinefile {
namespace {

/// A figure whose rest pose is larger than this is taken to be measured in centimetres.
constexpr double kTallestInMetres = 10;

/// What one unit of a motion's lengths is in metres, guessed where the file does not say.
double settle_unit(const Skeleton& skeleton, Diagnostics& diagnostics) {
  if (skeleton.metres_per_unit > 0) return skeleton.metres_per_unit;
  const double size = rest_size(skeleton);
  const bool is_in_metres = !(size > kTallestInMetres);
  diagnostics.add(Severity::Note, "CNV003",
                  fmt::format("the file does not say its unit of length; the rest pose is {:.3g} "
                              "units large and taken to be in {} (--unit-in says otherwise)",
                              size, is_in_metres ? "metres" : "centimetres"));
  return is_in_metres ? 1 : 0.01;
}

Result<Motion> turned_up(Motion motion, std::size_t usual, const KindOptions& options,
                         Diagnostics& diagnostics) {
  const std::size_t up = options.up.value_or(usual);
  if (options.keeps_up || guess_up_axis(motion) == up) return motion;
  diagnostics.add(Severity::Note, "CNV004",
                  fmt::format("the motion is turned so that {} points up (--up as-is leaves it)",
                              up == 1 ? 'y' : 'z'));
  return edit::up(std::move(motion), up, diagnostics);
}

Result<BodyMotion> in_form(const BodyMotion& body, const KindOptions& options,
                           Diagnostics& diagnostics) {
  if (options.model == nullptr) {
    return fail(make_error(ErrorKind::Usage, "CNV002",
                           "expected a model for --form, found none; --skeleton names one"));
  }
  const auto posed = robot::pose(body, skeleton_of(*options.model), options.lenient, diagnostics);
  if (!posed) return fail(posed.error());
  if (!robot::is_robot(posed->skeleton)) {
    return fail(make_error(ErrorKind::Usage, "CNV002",
                           "expected a root pose with a quaternion for --form; convert it with "
                           "--se3-format XYZQWQXQYQZ first"));
  }
  return robot::project(*posed, *options.form, &body, diagnostics);
}

/// What the robot's joints are called, and what they follow.
robot::RobotNames names_of(const KindOptions& options) {
  robot::RobotNames names;
  names.source_of = options.joint_map;
  for (const auto& [link, words] : options.model->extras.joints) {
    const auto joint = words.find("joint_name");
    if (joint != words.end()) names.joint_of_link[link] = joint->second;
  }
  return names;
}

Result<BodyMotion> body_of(Motion motion, const KindOptions& options, Diagnostics& diagnostics) {
  const bool is_of_robot = robot::is_robot(motion.skeleton);
  const bool wants_joints = options.form && *options.form != robot::BodyForm::Links;
  const robot::BodyForm usual = is_of_robot ? robot::BodyForm::Joints : robot::BodyForm::Links;
  if (!is_of_robot) {
    motion.skeleton.metres_per_unit = settle_unit(motion.skeleton, diagnostics);
    auto turned = turned_up(std::move(motion), 2, options, diagnostics);
    if (!turned) return fail(std::move(turned.error()));
    motion = std::move(*turned);
  }
  if (is_of_robot || !wants_joints || options.model == nullptr) {
    return robot::project(motion, options.form.value_or(usual), nullptr, diagnostics);
  }
  auto body =
      robot::onto_robot(motion, skeleton_of(*options.model), names_of(options), diagnostics);
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

Result<Motion> motion_of(const BodyMotion& body, const KindOptions& options,
                         Diagnostics& diagnostics) {
  tell_dropped(body, options.model != nullptr, diagnostics);
  auto posed = options.model != nullptr
                   ? robot::pose(body, skeleton_of(*options.model), options.lenient, diagnostics)
                   : robot::motion_of_links(body);
  if (!posed) return posed;
  return turned_up(robot::without_free_joints(*posed), 1, options, diagnostics);
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
    names.clear();
    for (std::size_t id = 0; id < component.num_parts; ++id) {
      names.push_back(robot.joints[robot.coordinates[kRootColumns + id].joint].name);
    }
  }
  return body;
}

/// What an hrpsys set has a place for: joints, the root's pose, a ZMP relative to the root.
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

void tell_rate(const Format& format, const SteadyRate& rate, Diagnostics& diagnostics) {
  diagnostics.add(
      rate.holds_times ? Severity::Note : Severity::Warning, "CNV007",
      fmt::format(
          "{} has no place for times of single frames; they are interpolated to {} frames a "
          "second{}",
          format.name, rate.per_second,
          rate.holds_times ? "" : ", by their median step: no usual rate holds them all"));
}

/// The rate for components of which some have times of their own: the main one's where it has one,
/// else one for all times together.
Result<SteadyRate> rate_of_components(const BodyMotion& body) {
  const Component& main = *main_component(body);
  const FrameTimes* own = std::get_if<FrameTimes>(&main.timeline.given);
  if (own == nullptr || own->per_second) return retime::rate_for(main.timeline);
  FrameTimes all;
  for (const Component& component : body.components) {
    if (auto rate = retime::rate_for(component.timeline); !rate) return rate;
    const std::vector<double>& times = own_times(component.timeline);
    all.seconds.insert(all.seconds.end(), times.begin(), times.end());
  }
  std::sort(all.seconds.begin(), all.seconds.end());
  all.seconds.erase(std::unique(all.seconds.begin(), all.seconds.end()), all.seconds.end());
  return retime::rate_for({all, 0});
}

/// When the first frame happens of those that begin before others.
double start_of(const BodyMotion& body) {
  double start = std::numeric_limits<double>::infinity();
  for (const Component& component : body.components) {
    if (component.kind == ComponentKind::Other || component.num_frames == 0) continue;
    start = std::min(start, time_of_frame(component.timeline, 0));
  }
  return start;
}

bool has_irregular(const BodyMotion& body) {
  const auto is_irregular = [](const Component& component) {
    return component.kind != ComponentKind::Other && component.num_frames > 0 &&
           has_own_times(component.timeline);
  };
  return main_component(body) != nullptr &&
         std::any_of(body.components.begin(), body.components.end(), is_irregular);
}

Result<void> steady_components(const Format& format, BodyMotion& body, bool lenient,
                               Diagnostics& diagnostics) {
  if (!has_irregular(body)) return {};
  const auto rate = rate_of_components(body);
  if (!rate) return fail(rate.error());
  retime::RetimeOptions options;
  options.lenient = lenient;
  const double start = start_of(body);
  for (Component& component : body.components) {
    if (component.kind == ComponentKind::Other || !has_own_times(component.timeline)) continue;
    const auto steady = retime::with_steady_rate(robot::motion_of_component(component),
                                                 rate->per_second, start, options, diagnostics);
    if (!steady) return fail(steady.error());
    component = robot::with_frames_of(component, *steady);
  }
  tell_rate(format, *rate, diagnostics);
  return {};
}

}  // namespace

Result<Document> at_steady_rate(const Format& format, Document document, bool lenient,
                                Diagnostics& diagnostics) {
  if (format.keeps_times) return document;
  if (BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    const auto made = steady_components(format, *body, lenient, diagnostics);
    if (!made) return fail(made.error());
    return document;
  }
  Motion* motion = std::get_if<Motion>(&document.content);
  if (motion == nullptr || !has_own_times(motion->clip.timeline)) return document;
  const auto rate = retime::rate_for(motion->clip.timeline);
  if (!rate) return fail(rate.error());
  retime::RetimeOptions options;
  options.lenient = lenient;
  auto steady = retime::with_steady_rate(
      *motion, rate->per_second, time_of_frame(motion->clip.timeline, 0), options, diagnostics);
  if (!steady) return fail(std::move(steady.error()));
  *motion = std::move(*steady);
  tell_rate(format, *rate, diagnostics);
  return document;
}

Result<Document> in_kind_of(const Format& format, Document document, const KindOptions& options,
                            Diagnostics& diagnostics) {
  const bool is_flow = std::holds_alternative<PoseFlow>(document.content);
  const bool takes_flows = format.name == "csv" || format.name == "json";
  if (is_flow != (format.name == "robovie") && !(is_flow && takes_flows)) {
    return fail(make_error(
        ErrorKind::Usage, "CNV006",
        is_flow ? "a flow of poses has no motion until it is run: 'kinefile run' with a servo map "
                  "makes one"
                : "a motion becomes a flow of servo poses by 'kinefile keyframe' with a servo "
                  "map"));
  }
  auto steady = at_steady_rate(format, std::move(document), options.lenient, diagnostics);
  if (!steady) return steady;
  document = std::move(*steady);
  const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
  const Motion* motion = std::get_if<Motion>(&document.content);
  const auto put = [&](auto&& made) -> Result<Document> {
    if (!made) return fail(std::move(made.error()));
    document.content = std::move(*made);
    return std::move(document);
  };
  if (is_flow) {
    // A table has a row a pose, each with its next and break.
    const auto wanted =
        format.name == "csv" ? std::optional(FlowFormat::WordN) : options.flow_format;
    if (!wanted) return document;
    return put(flow::in_format(std::get<PoseFlow>(document.content), *wanted, diagnostics));
  }
  if (format.name == "hrpsys") return put(set_of(document, options, diagnostics));
  if (format.name == "choreonoid") {
    if (body != nullptr && !options.form) return document;
    if (body != nullptr) return put(in_form(*body, options, diagnostics));
    if (motion != nullptr) return put(body_of(*motion, options, diagnostics));
    return fail(make_error(ErrorKind::Usage, "CNV002",
                           "expected a motion to write as .seq, found a skeleton alone"));
  }
  if (body == nullptr || format.name == "json") return document;
  document.extras = {};
  document.format.clear();
  if (format.name == "csv" && options.model != nullptr) {
    return put(Result<Motion>(robot::motion_of_components(
        with_names_of(*body, skeleton_of(*options.model)), diagnostics)));
  }
  if (format.name == "csv") {
    return put(Result<Motion>(robot::motion_of_components(*body, diagnostics)));
  }
  return put(motion_of(*body, options, diagnostics));
}

}  // namespace kinefile
