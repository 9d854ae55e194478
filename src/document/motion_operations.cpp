// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <limits>
#include <string_view>

#include "document/operation_tables.hpp"
#include "document/operation_words.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/retime.hpp"
#include "kinefile/robot.hpp"

namespace kinefile::operation {

namespace {

std::optional<double> parse_above_zero(const std::string* text) {
  const auto number = text != nullptr ? words::finite(*text) : std::nullopt;
  return number && *number > 0 ? number : std::nullopt;
}

/// An operation that makes a motion out of a motion.
template <class Change>
ApplyOperation on_motion(Change change) {
  return [change](Document& document, const OperationContext& context, Diagnostics& diagnostics) {
    return change_motion(document, [&](const Motion& motion) -> Result<Motion> {
      return change(motion, context, diagnostics);
    });
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
      words::integer<std::size_t>(std::string_view(*argument).substr(at + kBlend.size()));
  if (!num_frames) return std::nullopt;
  return Blended{argument->substr(0, at), *num_frames};
}

}  // namespace

ApplyOperation parse_trim(const std::string* argument) {
  constexpr std::size_t kAnyFrames = std::numeric_limits<std::size_t>::max() - 1;
  if (argument == nullptr || argument->empty()) return {};
  const auto any = parse_range(*argument, kAnyFrames);
  if (!any || any->step != 1) return {};
  return on_motion(
      [text = *argument, any](const Motion& motion, const OperationContext&, Diagnostics&) {
        const auto range = parse_range(text, motion.clip.num_frames);
        // What is out of range is left to the library to refuse, with the numbers that were given.
        const bool is_open = any->end == kAnyFrames;
        return range ? edit::trim(motion, range->begin, range->end)
                     : edit::trim(motion, any->begin, is_open ? motion.clip.num_frames : any->end);
      });
}

ApplyOperation parse_reverse(const std::string* argument) {
  if (argument != nullptr) return {};
  return on_motion([](const Motion& motion, const OperationContext&, Diagnostics&) {
    return edit::reverse(motion);
  });
}

ApplyOperation parse_speed(const std::string* argument) {
  const auto speed = parse_above_zero(argument);
  if (!speed) return {};
  return on_motion([speed](const Motion& motion, const OperationContext& context,
                           Diagnostics& diagnostics) -> Result<Motion> {
    const auto map = retime::speed_map(motion.clip, *speed);
    if (!map) return fail(map.error());
    retime::RetimeOptions options;
    options.lenient = context.lenient;
    return retime::apply(motion, *map, options, diagnostics);
  });
}

namespace {

/// The number of an axis among some letters, or nothing.
std::optional<std::size_t> parse_axis(const std::string& text, std::string_view letters) {
  if (text.size() != 1 || letters.find(text[0]) == std::string_view::npos) return std::nullopt;
  return static_cast<std::size_t>(text[0] - 'x');
}

}  // namespace

ApplyOperation parse_mirror(const std::string* argument) {
  const auto axis = argument != nullptr ? parse_axis(*argument, "xyz") : std::nullopt;
  if (argument != nullptr && !axis) return {};
  return on_motion(
      [axis](const Motion& motion, const OperationContext& context, Diagnostics& diagnostics) {
        return edit::mirror(motion, axis ? *axis : edit::guess_mirror_axis(motion.skeleton),
                            context.lenient, diagnostics);
      });
}

ApplyOperation parse_scale(const std::string* argument) {
  const auto factor = parse_above_zero(argument);
  if (!factor) return {};
  return on_motion([factor](const Motion& motion, const OperationContext&, Diagnostics&) {
    return edit::scale(motion, *factor);
  });
}

ApplyOperation parse_up(const std::string* argument) {
  const auto axis = argument != nullptr ? parse_axis(*argument, "yz") : std::nullopt;
  if (!axis) return {};
  return on_motion([axis](const Motion& motion, const OperationContext&, Diagnostics& diagnostics) {
    return edit::up(motion, *axis, diagnostics);
  });
}

ApplyOperation parse_in_place(const std::string* argument) {
  if (argument != nullptr) return {};
  return on_motion([](const Motion& motion, const OperationContext&, Diagnostics&) {
    return edit::in_place(motion);
  });
}

ApplyOperation parse_loop(const std::string* argument) {
  const auto blended = split_blend(argument);
  const auto count = blended ? words::integer<std::size_t>(blended->argument) : std::nullopt;
  if (!count) return {};
  return on_motion([count, num_frames = blended->num_frames](
                       const Motion& motion, const OperationContext&, Diagnostics&) {
    return edit::loop(motion, *count, num_frames);
  });
}

namespace {

Result<Motion> append_file(const Motion& motion, const Blended& blended,
                           const OperationContext& context) {
  const auto other = open_other(blended.argument, context);
  if (!other) return fail(other.error());
  const Motion* second = std::get_if<Motion>(&other->content);
  if (second == nullptr) {
    return fail(make_error(ErrorKind::Usage, "CLI001",
                           fmt::format("'{}' holds {}", blended.argument,
                                       has_skeleton(*other) ? "a skeleton alone" : "no motion")));
  }
  return edit::append(motion, *second, blended.num_frames);
}

}  // namespace

ApplyOperation parse_append(const std::string* argument) {
  const auto blended = split_blend(argument);
  if (!blended || blended->argument.empty()) return {};
  return on_motion([blended](const Motion& motion, const OperationContext& context, Diagnostics&) {
    return append_file(motion, *blended, context);
  });
}

ApplyOperation parse_joints(const std::string* argument) {
  if (argument == nullptr || argument->empty()) return {};
  const auto names = words::split(*argument, ',');
  return on_motion(
      [names](const Motion& motion, const OperationContext&, Diagnostics& diagnostics) {
        return edit::joints(motion, names, diagnostics);
      });
}

namespace {

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

}  // namespace

ApplyOperation parse_rename(const std::string* argument) {
  if (argument == nullptr || argument->find(':') == std::string::npos) return {};
  return [text = *argument](Document& document, const OperationContext&, Diagnostics&) {
    const std::size_t colon = find_colon(skeleton_of(document), text);
    return edit::rename(document, text.substr(0, colon), text.substr(colon + 1));
  };
}

ApplyOperation parse_smooth(const std::string* argument) {
  const auto cutoff = parse_above_zero(argument);
  if (!cutoff) return {};
  return on_motion([cutoff](const Motion& motion, const OperationContext&, Diagnostics&) {
    return edit::smooth(motion, *cutoff);
  });
}

ApplyOperation parse_unwrap(const std::string* argument) {
  if (argument != nullptr) return {};
  return on_motion([](const Motion& motion, const OperationContext&, Diagnostics&) {
    return edit::unwrap(motion);
  });
}

ApplyOperation parse_zmp(const std::string* argument) {
  if (argument == nullptr || (*argument != "global" && *argument != "root")) return {};
  return [is_relative = *argument == "root"](Document& document, const OperationContext&,
                                             Diagnostics& diagnostics) -> Result<void> {
    const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
    auto changed = robot::zmp(body != nullptr ? *body : BodyMotion{}, is_relative, diagnostics);
    if (!changed) return fail(std::move(changed.error()));
    document.content = std::move(*changed);
    return {};
  };
}

}  // namespace kinefile::operation
