// SPDX-License-Identifier: MIT
// The table of the options of `adapt`, and the formats on which each option has an effect.
#include <array>
#include <string>

#include "document/conventions.hpp"
#include "kinefile/process.hpp"
#include "text/option_words.hpp"

namespace kinefile {
namespace {

using std::string_view;

bool writes_skeletons(const Format& format) {
  return format.conventions.writes.motions || format.conventions.writes.skeletons;
}

bool writes_components(const Format& format) { return takes_components(format.conventions); }

bool writes_space(const Format& format) {
  return writes_skeletons(format) || format.conventions.writes.body_motions;
}

bool writes_flows_of_any_format(const Format& format) {
  return format.conventions.writes.flows && !format.conventions.flow_format;
}

bool set_order(AdaptOptions& options, const OptionInfo&, string_view word) {
  const auto order = shape::parse_rotation_order(std::string(word));
  if (order) options.channels.order = order;
  return order.has_value();
}

bool set_channels(AdaptOptions& options, const OptionInfo& info, string_view word) {
  return words::read_into(options.channels.positions, info, word);
}

bool set_form(AdaptOptions& options, const OptionInfo& info, string_view word) {
  return words::read_into(options.kinds.form, info, word);
}

bool set_flow_format(AdaptOptions& options, const OptionInfo& info, string_view word) {
  return words::read_into(options.kinds.flow_format, info, word);
}

bool set_up(AdaptOptions& options, const OptionInfo&, string_view word) {
  options.kinds.keeps_up = word == "as-is";
  options.kinds.up.reset();
  if (word == "y") options.kinds.up = 1;
  if (word == "z") options.kinds.up = 2;
  return options.kinds.keeps_up || options.kinds.up;
}

constexpr std::array<string_view, 3> kChannels = {"as-is", "root", "all"};
constexpr std::array<string_view, 3> kForms = {"links", "joints", "both"};
constexpr std::array<string_view, 2> kFlowFormats = {"word_n", "v1r4"};
constexpr std::array<string_view, 3> kUps = {"y", "z", "as-is"};

constexpr std::array<AdaptOption, 7> kOptions = {{
    {{{.name = "order",
       .value_name = "ZXY|...",
       .help = "Order of rotations, outermost first",
       .wanted = "three axes such as ZXY"},
      set_order},
     writes_skeletons},
    {{{.name = "channels",
       .type = OptionType::Choice,
       .value_name = "WHICH",
       .help = "Which joints have position channels: root, all, or as-is. Default: as-is; in BVH "
               "from another format, the root and joints that have some",
       .choices = kChannels},
      set_channels},
     writes_skeletons},
    {{{.name = "form",
       .type = OptionType::Choice,
       .value_name = "FORM",
       .help = "Of a body motion (.seq): the poses of all links, the root's pose and all joints, "
               "or both",
       .choices = kForms},
      set_form},
     writes_components},
    {{{.name = "robot",
       .type = OptionType::File,
       .value_name = "FILE",
       .help = "The robot that a motion goes onto, where --skeleton names the motion's own "
               "skeleton (.amc)"}},
     writes_components},
    {{{.name = "map",
       .type = OptionType::File,
       .value_name = "FILE",
       .help = "A YAML file that says which joint of a motion each joint of a robot follows, where "
               "their names differ"}},
     writes_components},
    {{{.name = "flow-format",
       .type = OptionType::Choice,
       .value_name = "FORMAT",
       .help = "Of a flow of servo poses: word_n (RobovieMaker for VS-RC003) or v1r4 "
               "(RobovieMaker2)",
       .choices = kFlowFormats},
      set_flow_format},
     writes_flows_of_any_format},
    {{{.name = "up",
       .type = OptionType::Choice,
       .value_name = "AXIS",
       .help = "The axis that points up in the output: z is usual for .seq, y for others",
       .choices = kUps},
      set_up},
     writes_space},
}};

}  // namespace

std::span<const AdaptOption> adapt_options() { return kOptions; }

}  // namespace kinefile
