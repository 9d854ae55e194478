// SPDX-License-Identifier: MIT
// The tables of the options of retiming, and their words.
#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinefile/retime_documents.hpp"
#include "text/option_words.hpp"

namespace kinefile::retime {
namespace {

using std::string_view;

constexpr std::array<string_view, 3> kTails = {"keep", "extend", "uniform"};
constexpr std::array<string_view, 4> kCurves = {"linear", "pchip", "steffen", "hermite"};
constexpr std::array<string_view, 4> kRotations = {"slerp", "nlerp", "cubic", "euler"};
constexpr std::array<string_view, 2> kComparisons = {"angles", "points"};

/// Reads OLD:NEW.
std::optional<WarpKey> parse_key(string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == string_view::npos) return std::nullopt;
  const auto old_frame = words::finite(text.substr(0, colon));
  const auto new_frame = words::finite(text.substr(colon + 1));
  if (!old_frame || !new_frame) return std::nullopt;
  return WarpKey{*old_frame, *new_frame};
}

/// Reads OLD:NEW[,...]; empty if it is not that.
std::vector<WarpKey> parse_keys(string_view text) {
  std::vector<WarpKey> keys;
  for (const std::string& part : words::split(text, ',')) {
    const auto key = parse_key(part);
    if (!key) return {};
    keys.push_back(*key);
  }
  return keys;
}

bool add_keys(DocumentWarp& warp, const OptionInfo&, string_view word) {
  const std::vector<WarpKey> keys = parse_keys(word);
  warp.options.keys.insert(warp.options.keys.end(), keys.begin(), keys.end());
  return !keys.empty();
}

bool set_ease(DocumentWarp& warp, const OptionInfo&, string_view word) {
  const auto ease = parse_ease(word);
  if (ease) warp.options.ease = *ease;
  return ease.has_value();
}

/// An option of a warp that sets a member of its `WarpOptions`.
template <auto Member>
constexpr Option<DocumentWarp> warp_option(const OptionInfo& info) {
  return {info, [](DocumentWarp& warp, const OptionInfo& own, string_view word) {
            return words::read_into(warp.options.*Member, own, word);
          }};
}

constexpr std::array<Option<DocumentWarp>, 8> kWarpOptions = {{
    {{.name = "key",
      .value_name = "OLD:NEW[,...]",
      .help = "Show old frame OLD at new frame NEW; 0:0 is implied, and what --tail says",
      .wanted = "OLD:NEW[,...]",
      .is_required = true,
      .can_repeat = true},
     add_keys},
    warp_option<&WarpOptions::tail>(
        {.name = "tail",
         .type = OptionType::Choice,
         .value_name = "RULE",
         .help = "After the last key: keep the length, extend it at the old rate, or go on at the "
                 "uniform rate of the last interval",
         .choices = kTails,
         .default_word = kTails[0]}),
    warp_option<&WarpOptions::curve>({.name = "curve",
                                      .type = OptionType::Choice,
                                      .value_name = "NAME",
                                      .help = "The curve through the keys",
                                      .choices = kCurves,
                                      .default_word = kCurves[0]}),
    {{.name = "ease",
      .value_name = "NAME",
      .help = "How each interval is run through: smooth, smoother, in, out, in-out (with a power: "
              "in:3), bezier:X1,Y1,X2,Y2",
      .wanted = "an ease such as smooth, in-out:3 or bezier:0.4,0,0.6,1"},
     set_ease},
    words::option<&DocumentWarp::follows_contacts>(
        {.name = "contacts",
         .type = OptionType::Flag,
         .help = "Let time stretch only where a foot is on the ground"}),
    warp_option<&WarpOptions::allow_hold>(
        {.name = "allow-hold", .type = OptionType::Flag, .help = "Keys may repeat an old frame"}),
    warp_option<&WarpOptions::allow_reverse>({.name = "allow-reverse",
                                              .type = OptionType::Flag,
                                              .help = "Keys may go back in the motion"}),
    words::option<&DocumentWarp::keys_in_seconds>(
        {.name = "seconds", .type = OptionType::Flag, .help = "Keys are in seconds, not frames"}),
}};

constexpr std::array<Option<RetimeOptions>, 2> kRetimeOptions = {{
    words::option<&RetimeOptions::rotation>(
        {.name = "rotation",
         .type = OptionType::Choice,
         .value_name = "HOW",
         .help = "How rotations between two frames are found: slerp, nlerp, cubic (SQUAD), or "
                 "euler, angle by angle",
         .choices = kRotations,
         .default_word = kRotations[0]}),
    words::option<&RetimeOptions::antialias>(
        {.name = "antialias",
         .type = OptionType::Flag,
         .help = "Average over the frames that are passed over where time runs fast"}),
}};

constexpr std::array<Option<AlignOptions>, 1> kAlignOptions = {{
    words::option<&AlignOptions::by>(
        {.name = "by",
         .type = OptionType::Choice,
         .value_name = "WHAT",
         .help = "What frames are compared by: the angles of joints, or the points where they are, "
                 "wherever on the ground",
         .choices = kComparisons,
         .default_word = kComparisons[0]}),
}};

std::string word_of(const std::vector<WarpKey>& keys) {
  std::string word;
  for (const WarpKey& key : keys) {
    word += fmt::format("{}{}:{}", word.empty() ? "" : ",", key.old_frame, key.new_frame);
  }
  return word;
}

void add_flag(std::vector<std::string>& words, string_view option, bool is_given) {
  if (is_given) words.push_back(fmt::format("--{}", option));
}

void add_option(std::vector<std::string>& words, string_view option, std::string word) {
  add_flag(words, option, true);
  words.push_back(std::move(word));
}

/// Adds a choice that is not the default, which is the first.
/// \param choices  in the order of the enum
template <class Enum, std::size_t Count>
void add_choice(std::vector<std::string>& words, string_view option, Enum value,
                const std::array<string_view, Count>& choices) {
  const auto index = static_cast<std::size_t>(value);
  if (index != 0) add_option(words, option, std::string(choices[index]));
}

}  // namespace

std::span<const Option<DocumentWarp>> warp_options() { return kWarpOptions; }

std::span<const Option<RetimeOptions>> retime_options() { return kRetimeOptions; }

std::span<const Option<AlignOptions>> align_options() { return kAlignOptions; }

std::vector<std::string> words_of(const DocumentWarp& warp) {
  const WarpOptions& options = warp.options;
  std::vector<std::string> words;
  if (!options.keys.empty()) add_option(words, "key", word_of(options.keys));
  add_choice(words, "tail", options.tail, kTails);
  add_choice(words, "curve", options.curve, kCurves);
  if (options.ease.kind != Ease::Kind::None) add_option(words, "ease", word_of(options.ease));
  add_flag(words, "contacts", warp.follows_contacts);
  add_flag(words, "allow-hold", options.allow_hold);
  add_flag(words, "allow-reverse", options.allow_reverse);
  add_flag(words, "seconds", warp.keys_in_seconds);
  return words;
}

std::vector<std::string> words_of(const RetimeOptions& options) {
  std::vector<std::string> words;
  add_choice(words, "rotation", options.rotation, kRotations);
  add_flag(words, "antialias", options.antialias);
  return words;
}

}  // namespace kinefile::retime
