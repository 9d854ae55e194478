// SPDX-License-Identifier: MIT
#include "long_motions.hpp"

#include <utility>

#include "options.hpp"
#include "report.hpp"
#include "signals.hpp"

namespace kinefile::cli {

std::optional<LongMotion> open_long(const std::string& path, const Reading& reading,
                                    double most_bytes_in_memory, Diagnostics& diagnostics) {
  diagnostics.warnings_are_errors = reading.is_strict;
  if (!reading.skeleton.empty() || !reading.project.empty()) return std::nullopt;
  const Format* const from = reading.from.empty() ? nullptr : find_format(reading.from);
  auto motion =
      open_long_motion(path, from, most_bytes_in_memory, read_options(reading), diagnostics);
  if (motion) note_format(find_format(motion->document.format), reading);
  return motion;
}

namespace {

/// Whether a motion is written in a format without a change of its values.
bool stays_as_it_is(const LongMotion& motion, const Format& format, const Writing& writing,
                    const Reading& reading) {
  Diagnostics ignored;
  const auto adapting = adapting_options(writing, reading, ignored);
  return adapting && needs_no_adapting(motion.document, format, *adapting);
}

}  // namespace

std::optional<int> write_long(const std::string& path, const Format& format, const Writing& writing,
                              const Reading& reading, const ChangeLong& change,
                              const Globals& globals) {
  if (format.write_frames == nullptr) return std::nullopt;
  // A change makes a second motion, which reading whole would keep, too.
  const double most_bytes = change ? kMostBytesInMemory / 2 : kMostBytesInMemory;
  Diagnostics found;
  auto motion = open_long(path, reading, most_bytes, found);
  if (!motion) return std::nullopt;
  const Format* const output = output_format(writing, path, motion->document);
  const bool is_plain = output != nullptr && output->write_frames != nullptr &&
                        stays_as_it_is(*motion, *output, writing, reading);
  if (!is_plain) return std::nullopt;
  print_diagnostics(STDERR_FILENO, found, globals);
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = reading.is_strict;
  auto changed =
      change ? change(*std::move(motion), diagnostics) : Result<LongMotion>(*std::move(motion));
  auto made = changed ? expect_options_of(reading, {&output, 1})
                      : Result<void>(fail(std::move(changed.error())));
  if (made) {
    made = write_long_file(writing.out, *changed, *output, writing.format,
                           output_options(writing.may_replace), diagnostics);
  }
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (made) return kDone;
  return print_failure(std::move(made.error()), diagnostics, path, globals);
}

}  // namespace kinefile::cli
