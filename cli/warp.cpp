// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "numbers.hpp"
#include "report.hpp"
#include "retiming.hpp"

namespace kinefile::cli {
namespace {

struct Warp {
  std::string file;
  std::vector<std::string> keys;
  std::string tail = "keep";
  std::string curve = "linear";
  std::string ease;
  bool follows_contacts = false;
  bool allows_hold = false;
  bool allows_reverse = false;
  bool is_in_seconds = false;
  Retiming retiming;
};

/// Reads OLD:NEW.
std::optional<retime::WarpKey> parse_key(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto old_frame = parse_finite(text.substr(0, colon));
  const auto new_frame = parse_finite(text.substr(colon + 1));
  if (!old_frame || !new_frame) return std::nullopt;
  return retime::WarpKey{*old_frame, *new_frame};
}

std::string check_keys(const std::string& text) {
  for (const std::string& key : CLI::detail::split(text, ',')) {
    if (!parse_key(key)) return fmt::format("expected OLD:NEW, found '{}'", key);
  }
  return text.empty() ? "expected OLD:NEW" : "";
}

std::string check_ease(const std::string& text) {
  return retime::parse_ease(text) ? ""
                                  : "expected an ease such as smooth, in-out:3, bezier:0.4,0,0.6,1";
}

std::vector<retime::WarpKey> keys_of(const Warp& warp) {
  std::vector<retime::WarpKey> keys;
  for (const std::string& text : warp.keys) {
    for (const std::string& part : CLI::detail::split(text, ',')) keys.push_back(*parse_key(part));
  }
  return keys;
}

Result<retime::TimeMap> make_map(const Warp& warp, const Document& document,
                                 Diagnostics& diagnostics) {
  const Clip clip = clip_of(document);
  retime::WarpOptions options;
  options.keys = keys_of(warp);
  if (warp.tail == "extend") options.tail = retime::Tail::Extend;
  if (warp.tail == "uniform") options.tail = retime::Tail::Uniform;
  if (warp.curve == "pchip") options.curve = retime::WarpCurve::Pchip;
  if (warp.curve == "steffen") options.curve = retime::WarpCurve::Steffen;
  if (warp.curve == "hermite") options.curve = retime::WarpCurve::Hermite;
  if (!warp.ease.empty()) options.ease = *retime::parse_ease(warp.ease);
  options.allow_hold = warp.allows_hold;
  options.allow_reverse = warp.allows_reverse;
  if (warp.follows_contacts) {
    const Motion* motion = std::get_if<Motion>(&document.content);
    if (motion == nullptr) {
      return fail(make_error(ErrorKind::Usage, "CLI002",
                             "expected a motion with a skeleton for --contacts, found components"));
    }
    auto weights = retime::contact_weights(*motion, diagnostics);
    if (!weights) return fail(std::move(weights.error()));
    options.weights = std::move(*weights);
  }
  return retime::warp_map(clip.timeline, clip.num_frames, std::move(options), warp.is_in_seconds,
                          diagnostics);
}

int run(const Warp& warp, const Globals& globals) {
  int exit_code = kDone;
  auto document = load_motion(warp.file, warp.retiming.reading, globals, exit_code);
  if (!document) return exit_code;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = warp.retiming.reading.is_strict;
  auto map = make_map(warp, *document, diagnostics);
  return finish_retiming(std::move(map), std::move(*document), warp.file, warp.retiming,
                         diagnostics, globals);
}

}  // namespace

void add_warp(CLI::App& app, Globals& globals) {
  auto warp = std::make_shared<Warp>();
  CLI::App* command =
      app.add_subcommand("warp", "Move frames to other times, and all between with them");
  command->add_option("FILE", warp->file, "File to read; - is standard input")->required();
  command
      ->add_option("--key", warp->keys,
                   "Show old frame OLD at new frame NEW; 0:0 is implied, and what --tail says")
      ->check(check_keys)
      ->allow_extra_args(false)
      ->required()
      ->type_name("OLD:NEW[,...]");
  command
      ->add_option("--tail", warp->tail,
                   "After the last key: keep the length, extend it at the old rate, or go on at "
                   "the uniform rate of the last interval")
      ->check(CLI::IsMember({"keep", "extend", "uniform"}))
      ->default_str("keep")
      ->type_name("RULE");
  command->add_option("--curve", warp->curve, "The curve through the keys")
      ->check(CLI::IsMember({"linear", "pchip", "steffen", "hermite"}))
      ->default_str("linear")
      ->type_name("NAME");
  command
      ->add_option("--ease", warp->ease,
                   "How each interval is run through: smooth, smoother, in, out, in-out (with a "
                   "power: in:3), bezier:X1,Y1,X2,Y2")
      ->check(check_ease)
      ->type_name("NAME");
  command->add_flag("--contacts", warp->follows_contacts,
                    "Let time stretch only where a foot is on the ground");
  command->add_flag("--allow-hold", warp->allows_hold, "Keys may repeat an old frame");
  command->add_flag("--allow-reverse", warp->allows_reverse, "Keys may go back in the motion");
  command->add_flag("--seconds", warp->is_in_seconds, "Keys are in seconds, not frames");
  add_retiming_options(*command, warp->retiming, true);
  command->callback(
      [warp, &globals] { globals.run = [warp, &globals] { return run(*warp, globals); }; });
}

}  // namespace kinefile::cli
