// SPDX-License-Identifier: MIT
#include <memory>

#include "report.hpp"
#include "retiming.hpp"

namespace kinefile::cli {
namespace {

struct Resample {
  std::string file;
  double frame_rate = 0;
  Retiming retiming;
};

/// Resamples every component from its own rate.
int resample_body(BodyMotion& body, const Resample& resample, Document&& document,
                  Diagnostics& diagnostics, const Globals& globals) {
  const Retiming& retiming = resample.retiming;
  const Format* format = output_format(retiming.writing, document);
  if (format == nullptr) return no_output_format(retiming.writing, globals);
  const retime::RetimeOptions options = retime_options(retiming);
  auto made = change_components(body, false, [&](const Motion& motion) -> Result<Motion> {
    const auto map = retime::resample_map(motion.clip, resample.frame_rate);
    if (!map) return fail(map.error());
    return retime::apply(motion, *map, options, diagnostics);
  });
  return write_document(std::move(made), std::move(document), *format, retiming.writing,
                        resample.file, retiming.reading, diagnostics, globals);
}

int run(const Resample& resample, const Globals& globals) {
  int exit_code = kDone;
  auto document = load_motion(resample.file, resample.retiming.reading, globals, exit_code);
  if (!document) return exit_code;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = resample.retiming.reading.is_strict;
  if (BodyMotion* body = std::get_if<BodyMotion>(&document->content)) {
    return resample_body(*body, resample, std::move(*document), diagnostics, globals);
  }
  auto map =
      retime::resample_map(std::get_if<Motion>(&document->content)->clip, resample.frame_rate);
  return finish_retiming(std::move(map), std::move(*document), resample.file, resample.retiming,
                         diagnostics, globals);
}

}  // namespace

void add_resample(CLI::App& app, Globals& globals) {
  auto resample = std::make_shared<Resample>();
  CLI::App* command =
      app.add_subcommand("resample", "Give a motion another frame rate and the same duration");
  command->add_option("FILE", resample->file, "File to read; - is standard input")->required();
  add_retiming_options(*command, resample->retiming, false);
  // Here the rate is the output's; what the input's is, the file says.
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
