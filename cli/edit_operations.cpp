// SPDX-License-Identifier: MIT
#include "edit_operations.hpp"

#include <fmt/format.h>

#include <limits>
#include <string_view>

#include "edit_flows.hpp"
#include "frame_range.hpp"
#include "numbers.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

/// An operation by name: how it is called, and how its argument is read.
struct OperationKind {
  std::string_view name;
  std::string_view usage;
  bool needs_motion;
  bool works_on_parts;
  /// \param argument  what follows "=", or null
  /// \returns         nothing if the argument is not what `usage` says
  Apply (*parse)(const std::string* argument);
  /// The same for flows, where the operation is one for them.
  std::string_view flow_usage = {};
  Apply (*parse_for_flow)(const std::string* argument) = nullptr;
};

std::optional<double> parse_above_zero(const std::string* text) {
  const auto number = text != nullptr ? parse_finite(*text) : std::nullopt;
  return number && *number > 0 ? number : std::nullopt;
}

/// An operation that makes a motion out of a motion.
template <class Change>
Apply on_motion(Change change) {
  return [change](Document& document, const EditContext& context) {
    return change_motion(
        document, [&](const Motion& motion) -> Result<Motion> { return change(motion, context); });
  };
}

/// Splits ",blend=F" from the end of an argument; nothing if F is no number.
struct Blended {
  std::string argument;
  std::size_t num_frames = 0;
};

std::optional<Blended> split_blend(const std::string* argument) {
  constexpr std::string_view kBlend = ",blend=";
  if (argument == nullptr) return std::nullopt;
  const std::size_t at = argument->rfind(kBlend);
  if (at == std::string::npos) return Blended{*argument, 0};
  const auto num_frames =
      parse_number<std::size_t>(std::string_view(*argument).substr(at + kBlend.size()));
  if (!num_frames) return std::nullopt;
  return Blended{argument->substr(0, at), *num_frames};
}

Apply parse_trim(const std::string* argument) {
  constexpr std::size_t kAnyFrames = std::numeric_limits<std::size_t>::max() - 1;
  if (argument == nullptr || argument->empty()) return {};
  const auto any = parse_range(*argument, kAnyFrames);
  if (!any || any->step != 1) return {};
  return on_motion([text = *argument, any](const Motion& motion, const EditContext&) {
    const auto range = parse_range(text, motion.clip.num_frames);
    // What is out of range is left to the library to refuse, with the numbers that were given.
    const bool is_open = any->end == kAnyFrames;
    return range ? edit::trim(motion, range->begin, range->end)
                 : edit::trim(motion, any->begin, is_open ? motion.clip.num_frames : any->end);
  });
}

Apply parse_reverse(const std::string* argument) {
  if (argument != nullptr) return {};
  return on_motion([](const Motion& motion, const EditContext&) { return edit::reverse(motion); });
}

Apply parse_speed(const std::string* argument) {
  const auto speed = parse_above_zero(argument);
  if (!speed) return {};
  return on_motion([speed](const Motion& motion, const EditContext& context) -> Result<Motion> {
    const auto map = retime::speed_map(motion.clip, *speed);
    if (!map) return fail(map.error());
    retime::RetimeOptions options;
    options.lenient = context.reading.is_lenient;
    return retime::apply(motion, *map, options, context.diagnostics);
  });
}

/// The number of an axis among some letters, or nothing.
std::optional<std::size_t> parse_axis(const std::string& text, std::string_view letters) {
  if (text.size() != 1 || letters.find(text[0]) == std::string_view::npos) return std::nullopt;
  return static_cast<std::size_t>(text[0] - 'x');
}

Apply parse_mirror(const std::string* argument) {
  const auto axis = argument != nullptr ? parse_axis(*argument, "xyz") : std::nullopt;
  if (argument != nullptr && !axis) return {};
  return on_motion([axis](const Motion& motion, const EditContext& context) {
    return edit::mirror(motion, axis ? *axis : edit::guess_mirror_axis(motion.skeleton),
                        context.reading.is_lenient, context.diagnostics);
  });
}

Apply parse_scale(const std::string* argument) {
  const auto factor = parse_above_zero(argument);
  if (!factor) return {};
  return on_motion(
      [factor](const Motion& motion, const EditContext&) { return edit::scale(motion, *factor); });
}

Apply parse_up(const std::string* argument) {
  const auto axis = argument != nullptr ? parse_axis(*argument, "yz") : std::nullopt;
  if (!axis) return {};
  return on_motion([axis](const Motion& motion, const EditContext& context) {
    return edit::up(motion, *axis, context.diagnostics);
  });
}

Apply parse_in_place(const std::string* argument) {
  if (argument != nullptr) return {};
  return on_motion([](const Motion& motion, const EditContext&) { return edit::in_place(motion); });
}

Apply parse_loop(const std::string* argument) {
  const auto blended = split_blend(argument);
  const auto count = blended ? parse_number<std::size_t>(blended->argument) : std::nullopt;
  if (!count) return {};
  return on_motion(
      [count, num_frames = blended->num_frames](const Motion& motion, const EditContext&) {
        return edit::loop(motion, *count, num_frames);
      });
}

Result<Motion> append_file(const Motion& motion, const Blended& blended,
                           const EditContext& context) {
  const auto other = load_quietly(blended.argument, context.reading, context.diagnostics);
  if (!other) return fail(other.error());
  const Motion* second = std::get_if<Motion>(&other->content);
  if (second == nullptr) {
    return fail(make_error(ErrorKind::Usage, "CLI001",
                           fmt::format("'{}' holds a skeleton alone", blended.argument)));
  }
  return edit::append(motion, *second, blended.num_frames);
}

Apply parse_append(const std::string* argument) {
  const auto blended = split_blend(argument);
  if (!blended || blended->argument.empty()) return {};
  return on_motion([blended](const Motion& motion, const EditContext& context) {
    return append_file(motion, *blended, context);
  });
}

/// Leaves out what a format keeps of joints that are no more.
void drop_extras(Document& document) {
  std::map<std::string, std::map<std::string, std::string>> kept;
  for (const Joint& joint : skeleton_of(document).joints) {
    auto extras = document.extras.joints.extract(joint.name);
    if (!extras.empty()) kept.insert(std::move(extras));
  }
  document.extras.joints = std::move(kept);
}

Apply parse_joints(const std::string* argument) {
  if (argument == nullptr || argument->empty()) return {};
  const auto names = CLI::detail::split(*argument, ',');
  return [names](Document& document, const EditContext& context) -> Result<void> {
    auto changed = change_motion(document, [&](const Motion& motion) {
      return edit::joints(motion, names, context.diagnostics);
    });
    if (changed) drop_extras(document);
    return changed;
  };
}

/// Where OLD:NEW is to be parted: names may hold colons, so OLD is the longest that is a joint's.
std::size_t find_colon(const Skeleton& skeleton, const std::string& text) {
  for (std::size_t at = text.rfind(':'); at != std::string::npos && at > 0;
       at = text.rfind(':', at - 1)) {
    for (const Joint& joint : skeleton.joints) {
      if (text.compare(0, at, joint.name) == 0) return at;
    }
  }
  return text.find(':');
}

Apply parse_rename(const std::string* argument) {
  if (argument == nullptr || argument->find(':') == std::string::npos) return {};
  return [text = *argument](Document& document, const EditContext&) {
    const std::size_t colon = find_colon(skeleton_of(document), text);
    return edit::rename(document, text.substr(0, colon), text.substr(colon + 1));
  };
}

Apply parse_smooth(const std::string* argument) {
  const auto cutoff = parse_above_zero(argument);
  if (!cutoff) return {};
  return on_motion(
      [cutoff](const Motion& motion, const EditContext&) { return edit::smooth(motion, *cutoff); });
}

Apply parse_unwrap(const std::string* argument) {
  if (argument != nullptr) return {};
  return on_motion([](const Motion& motion, const EditContext&) { return edit::unwrap(motion); });
}

Apply parse_zmp(const std::string* argument) {
  if (argument == nullptr || (*argument != "global" && *argument != "root")) return {};
  return [is_relative = *argument == "root"](Document& document,
                                             const EditContext& context) -> Result<void> {
    const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
    auto changed =
        robot::zmp(body != nullptr ? *body : BodyMotion{}, is_relative, context.diagnostics);
    if (!changed) return fail(std::move(changed.error()));
    document.content = std::move(*changed);
    return {};
  };
}

constexpr OperationKind kKinds[] = {
    {"trim", "trim=A:B", true, true, parse_trim},
    {"reverse", "reverse", true, true, parse_reverse, "reverse", parse_flow_reverse},
    {"speed", "speed=X", true, true, parse_speed, "speed=X", parse_flow_speed},
    {"mirror", "mirror[=x|y|z]", true, false, parse_mirror, "mirror[=A:B[:SIGN],...]",
     parse_flow_mirror},
    {"scale", "scale=X", false, false, parse_scale},
    {"up", "up=y|z", false, false, parse_up},
    {"in-place", "in-place", true, false, parse_in_place},
    {"loop", "loop=N[,blend=F]", true, true, parse_loop},
    {"append", "append=FILE[,blend=F]", true, false, parse_append},
    {"joints", "joints=A,B,...", false, false, parse_joints},
    {"rename", "rename=OLD:NEW", false, false, parse_rename},
    {"smooth", "smooth=HZ", true, true, parse_smooth},
    {"unwrap", "unwrap", true, false, parse_unwrap},
    {"zmp", "zmp=global|root", true, true, parse_zmp},
    {"offset", "", true, false, nullptr, "offset=SLIDER:VALUE", parse_flow_offset},
    {"merge", "", true, false, nullptr, "merge=FILE,SLIDERS", parse_flow_merge},
    {"insert", "", true, false, nullptr, "insert=BLOCK,FILE", parse_flow_insert},
    {"delete", "", true, false, nullptr, "delete=BLOCK", parse_flow_delete},
};

/// How an operation is called, for one document or another.
std::string usage_of(const OperationKind& kind) {
  if (kind.flow_usage.empty() || kind.flow_usage == kind.usage) return std::string(kind.usage);
  if (kind.usage.empty()) return std::string(kind.flow_usage);
  return fmt::format("{} (of a flow: {})", kind.usage, kind.flow_usage);
}

Error usage(std::string message) {
  return make_error(ErrorKind::Usage, "CLI001", std::move(message));
}

}  // namespace

Result<Operation> parse_operation(const std::string& word) {
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const std::string text = equals == std::string::npos ? "" : word.substr(equals + 1);
  const std::string* const argument = equals == std::string::npos ? nullptr : &text;
  for (const OperationKind& kind : kKinds) {
    if (kind.name != name) continue;
    Apply apply = kind.parse != nullptr ? kind.parse(argument) : Apply();
    Apply apply_to_flow = kind.parse_for_flow != nullptr ? kind.parse_for_flow(argument) : Apply();
    if (apply || apply_to_flow) {
      return Operation{word, kind.needs_motion, kind.works_on_parts, std::move(apply),
                       std::move(apply_to_flow)};
    }
    return fail(usage(fmt::format("expected {}, found '{}'", usage_of(kind), word)));
  }
  return fail(
      usage(fmt::format("there is no operation '{}'; there are {}", name, list_of_operations())));
}

std::string list_of_operations() {
  std::string list, of_flows;
  for (const OperationKind& kind : kKinds) {
    if (!kind.usage.empty()) list += fmt::format("{}{}", list.empty() ? "" : ", ", kind.usage);
    if (kind.flow_usage.empty()) continue;
    of_flows += fmt::format("{}{}", of_flows.empty() ? "" : ", ", kind.flow_usage);
  }
  return list + "; of a flow: " + of_flows;
}

}  // namespace kinefile::cli
