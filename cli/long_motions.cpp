// SPDX-License-Identifier: MIT
#include "long_motions.hpp"

#include <utility>

#include "options.hpp"
#include "report.hpp"
#include "signals.hpp"

namespace kinefile::cli {

std::optional<LongMotion> open_long(const std::string& path, const Reading& reading,
                                    bool is_changed, Diagnostics& diagnostics) {
  diagnostics.warnings_are_errors = reading.is_strict;
  if (!reading.skeleton.empty() || !reading.project.empty()) return std::nullopt;
  const Format* const from = reading.from.empty() ? nullptr : find_format(reading.from);
  auto motion = open_long_motion(path, from, most_bytes_in_memory(is_changed),
                                 read_options(reading), diagnostics);
  if (motion) note_format(find_format(motion->document.format), reading);
  return motion;
}

namespace {

/// Changes a motion and converts it for the format.
/// \param change  null: the motion stays as it is
/// \returns       empty if that needs all frames at once
std::optional<Result<LongMotion>> converted(LongMotion motion, const Format& format,
                                            const Writing& writing, const Reading& reading,
                                            const ChangeLong& change, Diagnostics& diagnostics) {
  Diagnostics ignored;
  const auto adapting = adapting_options(writing, reading, ignored);
  if (!adapting) return std::nullopt;
  auto changed =
      change ? change(std::move(motion), diagnostics) : Result<LongMotion>(std::move(motion));
  if (!changed) return changed;
  const Format* const output = &format;
  if (auto made = expect_options_of(reading, {&output, 1}); !made) {
    return fail(std::move(made.error()));
  }
  return adapt_in_blocks(*changed, format, *adapting, diagnostics);
}

Result<void> write_files(const LongMotion& motion, const Format& format, const Writing& writing,
                         Diagnostics& diagnostics) {
  const OutputFiles files = files_on_disk(output_options(writing.may_replace));
  auto written = write_in_blocks(writing.out, motion, format, writing.format, files, diagnostics);
  return written ? files.commit() : written;
}

}  // namespace

std::optional<int> write_long(const std::string& path, const Format& format, const Writing& writing,
                              const Reading& reading, const ChangeLong& change,
                              const Globals& globals) {
  if (format.write_frames == nullptr) return std::nullopt;
  Diagnostics found;
  auto motion = open_long(path, reading, change != nullptr, found);
  if (!motion) return std::nullopt;
  const Format* const output = output_format(writing, path, motion->document);
  if (output == nullptr || output->write_frames == nullptr) return std::nullopt;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = reading.is_strict;
  const auto made = converted(*std::move(motion), *output, writing, reading, change, diagnostics);
  if (!made) return std::nullopt;
  print_diagnostics(STDERR_FILENO, found, globals);
  Result<void> written = *made ? write_files(**made, *output, writing, diagnostics)
                               : Result<void>(fail(made->error()));
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (written) return kDone;
  return print_failure(std::move(written.error()), diagnostics, path, globals);
}

}  // namespace kinefile::cli
