// SPDX-License-Identifier: MIT
#include <memory>
#include <optional>
#include <utility>

#include "long_motions.hpp"
#include "report.hpp"
#include "retiming.hpp"

namespace kinefile::cli {
namespace {

struct Resample {
  std::string file;
  double frame_rate = 0;
  Retiming retiming;
};

/// Resamples motions that are too large for memory.
ChangeLong in_blocks(const Resample& resample) {
  return [&resample](LongMotion motion, Diagnostics& diagnostics) {
    return retime::resample(std::move(motion), resample.frame_rate, options_of(resample.retiming),
                            diagnostics);
  };
}

int run_on_many(const Resample& resample, const Globals& globals) {
  const auto retime = [&resample](Document& document, Diagnostics& diagnostics) {
    return retime::resample(document, resample.frame_rate, options_of(resample.retiming),
                            diagnostics);
  };
  return retime_many(resample.retiming, retime, in_blocks(resample), globals);
}

/// Resamples a motion that is too large for memory; empty if it is not.
std::optional<int> run_on_long(const Resample& resample, const Globals& globals) {
  const Retiming& retiming = resample.retiming;
  const Writing& writing = retiming.writing;
  const Format* format = output_format(writing);
  if (format == nullptr) format = format_of_name(resample.file);
  if (format == nullptr) return std::nullopt;
  return write_long(resample.file, *format, writing, retiming.reading, in_blocks(resample),
                    globals);
}

int run(const Resample& resample, const Globals& globals) {
  if (globals.takes_many) return run_on_many(resample, globals);
  if (const auto done = run_on_long(resample, globals)) return *done;
  int exit_code = kDone;
  auto document = load_motion(resample.file, resample.retiming.reading, globals, exit_code);
  if (!document) return exit_code;
  const Retiming& retiming = resample.retiming;
  const Format* format = output_format(retiming.writing, resample.file, *document);
  if (format == nullptr) return no_output_format(retiming.writing, globals);
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = retiming.reading.is_strict;
  auto made = retime::resample(*document, resample.frame_rate, options_of(retiming), diagnostics);
  return write_document(std::move(made), std::move(*document), *format, retiming.writing,
                        resample.file, retiming.reading, diagnostics, globals);
}

}  // namespace

void add_resample(CLI::App& app, Globals& globals) {
  auto resample = std::make_shared<Resample>();
  CLI::App* command =
      app.add_subcommand("resample", "Give a motion another frame rate and the same duration");
  add_retiming_inputs(*command, resample->file, resample->retiming, globals);
  add_retiming_options(*command, resample->retiming, false, true);
  // Here --fps is the output's rate; the input's rate comes from the file.
  command->remove_option(command->get_option("--fps"));
  command->add_option("--fps", resample->frame_rate, "Frames a second of the output")
      ->check(check_rate)
      ->required()
      ->type_name("RATE");
  command
      ->add_option("--fps-in", resample->retiming.reading.options.fps,
                   "Frames a second of the input, instead of what the file says")
      ->check(check_rate)
      ->type_name("RATE");
  command->callback([resample, &globals] {
    globals.run = [resample, &globals] { return run(*resample, globals); };
  });
}

}  // namespace kinefile::cli
