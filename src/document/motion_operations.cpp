// SPDX-License-Identifier: MIT
// The operations of the table on motions, and on body motions by their components.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <string_view>

#include "document/join_components.hpp"
#include "document/operation_tables.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/retime.hpp"
#include "kinefile/robot.hpp"

namespace kinefile::operation {
namespace {

using std::string_view;

constexpr double kAboveZero = std::numeric_limits<double>::min();
constexpr std::array<string_view, 3> kAxes = {"x", "y", "z"};

/// A coordinate axis: 0 x, 1 y, 2 z.
enum class Axis { X, Y, Z };

struct Trim {
  std::optional<std::size_t> begin, end;
};

Result<Motion> trim_frames(const Motion& motion, const Trim& range, const OperationContext&,
                           Diagnostics&) {
  return edit::trim(motion, range.begin.value_or(0), range.end.value_or(motion.clip.num_frames));
}

constexpr std::array<Parameter, 2> kTrim = {
    parameter<&Trim::begin>({.name = "begin",
                             .type = OptionType::Count,
                             .value_name = "A",
                             .help = "The first frame; else the motion's first",
                             .is_required = true,
                             .separator = '='}),
    parameter<&Trim::end>({.name = "end",
                           .type = OptionType::Count,
                           .value_name = "B",
                           .help = "The frame after the last; else all to the end",
                           .is_required = true,
                           .separator = ':'}),
};

Result<Motion> reverse_frames(Motion motion, const NoOptions&, const OperationContext&,
                              Diagnostics&) {
  return edit::reverse(std::move(motion));
}

struct Factor {
  double factor = 1;
};

/// A parameter that is a factor above 0.
constexpr Parameter factor_parameter(string_view help) {
  return parameter<&Factor::factor>({.name = "factor",
                                     .type = OptionType::Number,
                                     .value_name = "X",
                                     .help = help,
                                     .least = kAboveZero,
                                     .is_required = true,
                                     .separator = '='});
}

constexpr std::array<Parameter, 1> kSpeed = {factor_parameter("How many times as fast")};
constexpr std::array<Parameter, 1> kScale = {factor_parameter("What lengths are multiplied by")};

Result<Motion> change_speed(const Motion& motion, const Factor& speed,
                            const OperationContext& context, Diagnostics& diagnostics) {
  const auto map = retime::speed_map(motion.clip, speed.factor);
  if (!map) return fail(map.error());
  retime::RetimeOptions options;
  options.lenient = context.lenient;
  return retime::apply(motion, *map, options, diagnostics);
}

struct Mirror {
  std::optional<Axis> axis;
};

Result<Motion> mirror_motion(const Motion& motion, const Mirror& mirror,
                             const OperationContext& context, Diagnostics& diagnostics) {
  std::optional<std::size_t> axis;
  if (mirror.axis) axis = static_cast<std::size_t>(*mirror.axis);
  return edit::mirror(motion, axis, context.lenient, diagnostics);
}

constexpr std::array<Parameter, 1> kMirror = {
    parameter<&Mirror::axis>(
        {.name = "axis",
         .type = OptionType::Choice,
         .value_name = "x|y|z",
         .help = "The normal of the mirror; else the horizontal axis between the halves",
         .choices = kAxes,
         .separator = '='}),
};

Result<Motion> scale_lengths(Motion motion, const Factor& scale, const OperationContext&,
                             Diagnostics&) {
  return edit::scale(std::move(motion), scale.factor);
}

/// An axis that can point up.
enum class UpAxis { Y, Z };

struct Up {
  UpAxis axis = UpAxis::Y;
};

Result<Motion> turn_up(Motion motion, const Up& up, const OperationContext&,
                       Diagnostics& diagnostics) {
  return edit::up(std::move(motion), up.axis == UpAxis::Y ? 1 : 2, diagnostics);
}

constexpr std::array<string_view, 2> kUpAxes = {"y", "z"};
constexpr std::array<Parameter, 1> kUp = {
    parameter<&Up::axis>({.name = "axis",
                          .type = OptionType::Choice,
                          .value_name = "y|z",
                          .help = "The axis that is to point up",
                          .choices = kUpAxes,
                          .is_required = true,
                          .separator = '='}),
};

Result<Motion> stay_in_place(Motion motion, const NoOptions&, const OperationContext&,
                             Diagnostics& diagnostics) {
  return edit::in_place(std::move(motion), diagnostics);
}

struct Loop {
  std::size_t count = 1;
  std::size_t blend = 0;
};

Result<void> repeat(Document& document, const Loop& loop, const OperationContext&,
                    Diagnostics& diagnostics) {
  if (BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    return join_components(*body, nullptr, [&](const Motion& motion, const Motion*, bool is_moved) {
      return edit::loop(motion, loop.count, loop.blend, diagnostics, is_moved);
    });
  }
  return change_motion(document, [&](const Motion& motion) {
    return edit::loop(motion, loop.count, loop.blend, diagnostics);
  });
}

constexpr OptionInfo kBlend = {.name = "blend",
                               .type = OptionType::Count,
                               .value_name = "F",
                               .help = "Over how many frames one goes into the next",
                               .default_word = "0"};

constexpr std::array<Parameter, 2> kLoop = {
    parameter<&Loop::count>({.name = "count",
                             .type = OptionType::Count,
                             .value_name = "N",
                             .help = "How many times",
                             .is_required = true,
                             .separator = '='}),
    parameter<&Loop::blend>(kBlend),
};

struct Append {
  std::string file;
  std::size_t blend = 0;
};

/// What a file that cannot follow holds.
std::string_view content_of(const Document& document) {
  if (std::holds_alternative<Motion>(document.content)) return "a motion, and no components";
  if (std::holds_alternative<BodyMotion>(document.content)) return "components, and no skeleton";
  return has_skeleton(document) ? "a skeleton alone" : "no motion";
}

Result<void> append_file(Document& document, const Append& append, const OperationContext& context,
                         Diagnostics& diagnostics) {
  const auto other = open_other(append.file, context);
  if (!other) return fail(other.error());
  BodyMotion* const body = std::get_if<BodyMotion>(&document.content);
  const BodyMotion* const next = std::get_if<BodyMotion>(&other->content);
  if (body != nullptr && next != nullptr) {
    return join_components(*body, next, [&](Motion first, const Motion* second, bool is_moved) {
      return edit::append(std::move(first), *second, append.blend, diagnostics, is_moved);
    });
  }
  const Motion* second = std::get_if<Motion>(&other->content);
  if (body == nullptr && second != nullptr) {
    return change_motion(document, [&](Motion first) {
      return edit::append(std::move(first), *second, append.blend, diagnostics);
    });
  }
  return fail(make_error(ErrorKind::Usage, "CLI001",
                         fmt::format("'{}' holds {}", append.file, content_of(*other))));
}

constexpr std::array<Parameter, 2> kAppend = {
    parameter<&Append::file>({.name = "file",
                              .type = OptionType::File,
                              .value_name = "FILE",
                              .help = "The motion that follows",
                              .is_required = true,
                              .separator = '='}),
    parameter<&Append::blend>(kBlend),
};

struct Joints {
  std::vector<std::string> names;
};

Result<Motion> keep_joints(const Motion& motion, const Joints& joints, const OperationContext&,
                           Diagnostics& diagnostics) {
  return edit::joints(motion, joints.names, diagnostics);
}

constexpr std::array<Parameter, 1> kJoints = {
    parameter<&Joints::names>({.name = "names",
                               .type = OptionType::Text,
                               .value_name = "A,B,...",
                               .help = "The joints that stay",
                               .is_required = true,
                               .separator = '='}),
};

struct Rename {
  std::string names;  ///< OLD:NEW
};

/// The colon at which OLD:NEW is split. Names may contain colons, so OLD is the longest prefix that
/// is the name of a joint.
std::size_t find_colon(const Skeleton& skeleton, const std::string& text) {
  for (std::size_t at = text.rfind(':'); at != std::string::npos && at > 0;
       at = text.rfind(':', at - 1)) {
    for (const Joint& joint : skeleton.joints) {
      if (text.compare(0, at, joint.name) == 0) return at;
    }
  }
  return text.find(':');
}

Result<void> rename_joint(Document& document, const Rename& rename, const OperationContext&,
                          Diagnostics&) {
  const std::size_t colon = find_colon(skeleton_of(document), rename.names);
  return edit::rename(document, rename.names.substr(0, colon), rename.names.substr(colon + 1));
}

std::optional<std::string> parse_names(string_view word) {
  const bool has_two = word.find(':') != string_view::npos;
  return has_two ? std::optional(std::string(word)) : std::nullopt;
}

constexpr std::array<Parameter, 1> kRename = {
    parameter<&Rename::names, parse_names>({.name = "names",
                                            .type = OptionType::Text,
                                            .value_name = "OLD:NEW",
                                            .help = "The joint's name and its new one",
                                            .is_required = true,
                                            .separator = '='}),
};

struct Smooth {
  double cutoff = 0;
};

Result<Motion> smooth_motion(Motion motion, const Smooth& smooth, const OperationContext&,
                             Diagnostics&) {
  return edit::smooth(std::move(motion), smooth.cutoff);
}

constexpr std::array<Parameter, 1> kSmooth = {
    parameter<&Smooth::cutoff>({.name = "cutoff",
                                .type = OptionType::Number,
                                .value_name = "HZ",
                                .help = "The frequency of the filter",
                                .least = kAboveZero,
                                .is_required = true,
                                .separator = '='}),
};

Result<Motion> unwrap_angles(Motion motion, const NoOptions&, const OperationContext&,
                             Diagnostics&) {
  return edit::unwrap(std::move(motion));
}

/// The frames that a ZMP can be relative to.
enum class ZmpFrame { Global, Root };

struct Zmp {
  ZmpFrame frame = ZmpFrame::Global;
};

Result<void> change_zmp(Document& document, const Zmp& zmp, const OperationContext&,
                        Diagnostics& diagnostics) {
  const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
  auto changed =
      robot::zmp(body != nullptr ? *body : BodyMotion{}, zmp.frame == ZmpFrame::Root, diagnostics);
  if (!changed) return fail(std::move(changed.error()));
  document.content = std::move(*changed);
  return {};
}

constexpr std::array<string_view, 2> kZmpFrames = {"global", "root"};
constexpr std::array<Parameter, 1> kZmp = {
    parameter<&Zmp::frame>({.name = "frame",
                            .type = OptionType::Choice,
                            .value_name = "global|root",
                            .help = "The frame of the ZMP: the world's or the root link's",
                            .choices = kZmpFrames,
                            .is_required = true,
                            .separator = '='}),
};

}  // namespace

OperationInfo trim() {
  return {.name = "trim",
          .help = "Some frames alone",
          .works_on_components = true,
          .form = motion_form<Trim, trim_frames>(kTrim)};
}

OperationInfo reverse() {
  return {.name = "reverse",
          .help = "From the last frame to the first",
          .works_on_components = true,
          .form = motion_form<NoOptions, reverse_frames>(),
          .flow_form = reverse_of_flow()};
}

OperationInfo speed() {
  return {.name = "speed",
          .help = "X times as fast",
          .works_on_components = true,
          .form = motion_form<Factor, change_speed>(kSpeed),
          .flow_form = speed_of_flow()};
}

OperationInfo mirror() {
  return {.name = "mirror",
          .help = "What the left side did, the right side does",
          .form = motion_form<Mirror, mirror_motion>(kMirror),
          .flow_form = mirror_of_flow()};
}

OperationInfo scale() {
  return {.name = "scale",
          .help = "All lengths times X",
          .needs_motion = false,
          .form = motion_form<Factor, scale_lengths>(kScale)};
}

OperationInfo up() {
  return {.name = "up",
          .help = "Another axis points up",
          .needs_motion = false,
          .form = motion_form<Up, turn_up>(kUp)};
}

OperationInfo in_place() {
  return {.name = "in-place",
          .help = "Roots stay over the place where they start",
          .form = motion_form<NoOptions, stay_in_place>()};
}

OperationInfo loop() {
  return {.name = "loop",
          .help = "N times, over F frames from one into the next",
          .works_on_components = true,
          .form = form<Loop, repeat>(kLoop)};
}

OperationInfo append() {
  return {.name = "append",
          .help = "Another motion of the same skeleton after this one",
          .works_on_components = true,
          .form = form<Append, append_file>(kAppend)};
}

OperationInfo joints() {
  return {.name = "joints",
          .help = "Some joints alone, and those above them",
          .needs_motion = false,
          .form = motion_form<Joints, keep_joints>(kJoints)};
}

OperationInfo rename() {
  return {.name = "rename",
          .help = "Another name for a joint",
          .needs_motion = false,
          .form = form<Rename, rename_joint>(kRename)};
}

OperationInfo smooth() {
  return {.name = "smooth",
          .help = "Nothing faster than HZ",
          .works_on_components = true,
          .form = motion_form<Smooth, smooth_motion>(kSmooth)};
}

OperationInfo unwrap() {
  return {.name = "unwrap",
          .help = "Angles that do not jump by whole turns",
          .form = motion_form<NoOptions, unwrap_angles>()};
}

OperationInfo zmp() {
  return {.name = "zmp",
          .help = "The ZMP of a body motion in the frame of the world or the root",
          .works_on_components = true,
          .form = form<Zmp, change_zmp>(kZmp)};
}

}  // namespace kinefile::operation
