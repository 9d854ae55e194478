// SPDX-License-Identifier: MIT
// The table of operations, and how they are applied to documents of every kind.
#include <fmt/format.h>

#include <algorithm>

#include "document/operation_tables.hpp"
#include "kinefile/operation.hpp"
#include "kinefile/robot.hpp"

namespace kinefile {
namespace {

constexpr OperationInfo kOperations[] = {
    {"trim", "trim=A:B", "Some frames alone", true, true, operation::parse_trim},
    {"reverse", "reverse", "From the last frame to the first", true, true, operation::parse_reverse,
     "reverse", operation::parse_flow_reverse},
    {"speed", "speed=X", "X times as fast", true, true, operation::parse_speed, "speed=X",
     operation::parse_flow_speed},
    {"mirror", "mirror[=x|y|z]", "What the left side did, the right side does", true, false,
     operation::parse_mirror, "mirror[=A:B[:SIGN],...]", operation::parse_flow_mirror},
    {"scale", "scale=X", "All lengths times X", false, false, operation::parse_scale},
    {"up", "up=y|z", "Another axis points up", false, false, operation::parse_up},
    {"in-place", "in-place", "Roots stay over the place where they start", true, false,
     operation::parse_in_place},
    {"loop", "loop=N[,blend=F]", "N times, over F frames from one into the next", true, true,
     operation::parse_loop},
    {"append", "append=FILE[,blend=F]", "Another motion of the same skeleton after this one", true,
     false, operation::parse_append},
    {"joints", "joints=A,B,...", "Some joints alone, and those above them", false, false,
     operation::parse_joints},
    {"rename", "rename=OLD:NEW", "Another name for a joint", false, false, operation::parse_rename},
    {"smooth", "smooth=HZ", "Nothing faster than HZ", true, true, operation::parse_smooth},
    {"unwrap", "unwrap", "Angles that do not jump by whole turns", true, false,
     operation::parse_unwrap},
    {"zmp", "zmp=global|root", "The ZMP of a body motion in the frame of the world or the root",
     true, true, operation::parse_zmp},
    {"offset", "", "Adds to the words of a slider", true, false, nullptr, "offset=SLIDER:VALUE",
     operation::parse_flow_offset},
    {"merge", "", "Sliders of another flow", true, false, nullptr, "merge=FILE,SLIDERS",
     operation::parse_flow_merge},
    {"insert", "", "Poses of another flow after a block", true, false, nullptr, "insert=BLOCK,FILE",
     operation::parse_flow_insert},
    {"delete", "", "A flow without a block", true, false, nullptr, "delete=BLOCK",
     operation::parse_flow_delete},
};

tl::unexpected<Error> refuse_operation(std::string message) {
  return fail(ErrorKind::Usage, "CLI001", std::move(message));
}

/// How an operation is called, for one document or another.
std::string usage_of(const OperationInfo& info) {
  if (info.flow_usage.empty() || info.flow_usage == info.usage) return std::string(info.usage);
  if (info.usage.empty()) return std::string(info.flow_usage);
  return fmt::format("{} (of a flow: {})", info.usage, info.flow_usage);
}

/// What keeps an operation from a document; empty if nothing does.
std::string hindrance(const Operation& operation, const Document& document) {
  if (std::holds_alternative<PoseFlow>(document.content)) {
    return operation.apply_to_flow ? "" : "a motion, and the file holds a flow of poses";
  }
  if (!operation.apply) return "a flow of poses, and the file holds none";
  if (!has_skeleton(document) && !operation.info->works_on_components) {
    return "a skeleton, and the file holds components";
  }
  if (operation.info->needs_motion && std::holds_alternative<Skeleton>(document.content)) {
    return "a motion, and the file holds a skeleton alone";
  }
  return {};
}

/// Whether a component can be changed, and its length or rate is not the main one's.
bool disagrees(const Component& component, const Component& main) {
  if (component.kind == ComponentKind::Other) return false;
  return component.num_frames != main.num_frames ||
         !have_same_times(component.timeline, main.timeline);
}

}  // namespace

std::span<const OperationInfo> operations() { return kOperations; }

std::string list_of_operations() {
  std::string list, of_flows;
  for (const OperationInfo& info : operations()) {
    if (!info.usage.empty()) list += fmt::format("{}{}", list.empty() ? "" : ", ", info.usage);
    if (info.flow_usage.empty()) continue;
    of_flows += fmt::format("{}{}", of_flows.empty() ? "" : ", ", info.flow_usage);
  }
  return list + "; of a flow: " + of_flows;
}

Result<Operation> parse_operation(const std::string& word) {
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const std::string text = equals == std::string::npos ? "" : word.substr(equals + 1);
  const std::string* const argument = equals == std::string::npos ? nullptr : &text;
  for (const OperationInfo& info : operations()) {
    if (info.name != name) continue;
    Operation made{word, &info};
    if (info.parse != nullptr) made.apply = info.parse(argument);
    if (info.parse_for_flow != nullptr) made.apply_to_flow = info.parse_for_flow(argument);
    if (made.apply || made.apply_to_flow) return made;
    return refuse_operation(fmt::format("expected {}, found '{}'", usage_of(info), word));
  }
  return refuse_operation(
      fmt::format("there is no operation '{}'; there are {}", name, list_of_operations()));
}

Result<std::vector<Operation>> parse_operations(std::span<const std::string> words) {
  std::vector<Operation> made;
  for (const std::string& word : words) {
    auto one = parse_operation(word);
    if (!one) return fail(std::move(one.error()));
    made.push_back(std::move(*one));
  }
  return made;
}

Result<void> apply(std::span<const Operation> operations, Document& document,
                   const OperationContext& context, Diagnostics& diagnostics) {
  for (const Operation& operation : operations) {
    if (const std::string needed = hindrance(operation, document); !needed.empty()) {
      return refuse_operation(fmt::format("'{}' needs {}", operation.word, needed));
    }
    const bool is_flow = std::holds_alternative<PoseFlow>(document.content);
    auto applied =
        (is_flow ? operation.apply_to_flow : operation.apply)(document, context, diagnostics);
    if (applied) continue;
    Error error = std::move(applied.error());
    if (error.place.source.empty()) error.message = operation.word + ": " + error.message;
    return fail(std::move(error));
  }
  return {};
}

Result<void> change_components(BodyMotion& body, bool must_agree,
                               const std::function<Result<Motion>(const Motion&)>& change) {
  const Component* main = main_component(body);
  for (const Component& component : body.components) {
    if (!must_agree || main == nullptr || !disagrees(component, *main)) continue;
    return fail(
        ErrorKind::Usage, "CLI002",
        fmt::format("expected components of one length and rate, found {} frames at {} a second of "
                    "'{}' beside {} at {}",
                    component.num_frames, frame_rate(component.timeline), component.content,
                    main->num_frames, frame_rate(main->timeline)));
  }
  for (Component& component : body.components) {
    if (component.kind == ComponentKind::Other) continue;
    auto changed = change(robot::motion_of_component(component));
    if (!changed) return fail(std::move(changed.error()));
    component = robot::with_frames_of(component, *changed);
  }
  return {};
}

Result<void> change_motion(Document& document,
                           const std::function<Result<Motion>(const Motion&)>& change) {
  if (BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    return change_components(*body, true, change);
  }
  if (!has_skeleton(document)) return refuse_operation("expected a motion, found a flow of poses");
  const bool has_motion = std::holds_alternative<Motion>(document.content);
  Result<Motion> changed = change(still_or_moving(document));
  if (!changed) return fail(std::move(changed.error()));
  if (has_motion) {
    document.content = std::move(*changed);
  } else {
    document.content = std::move(changed->skeleton);
  }
  return {};
}

}  // namespace kinefile
