// SPDX-License-Identifier: MIT
#include <memory>

#include "command.hpp"
#include "report.hpp"
#include "signals.hpp"

namespace kinefile::cli {
namespace {

struct MakeServoMap {
  std::string file;
  std::string out = "-";
  bool may_replace = false;
};

Result<void> write(const MakeServoMap& make, const ServoMap& map) {
  auto file = OutputFile::create(make.out, output_options(make.may_replace));
  if (!file) return fail(file.error());
  file->write(to_yaml(map));
  return file->commit();
}

int run(const MakeServoMap& make, const Globals& globals) {
  Diagnostics diagnostics;
  const auto map = make_servo_map(make.file, diagnostics);
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  const auto written = map ? write(make, *map) : Result<void>(fail(map.error()));
  if (written) return kDone;
  if (!diagnostics.has_errors()) print_error(written.error(), globals);
  return exit_code_of(written.error());
}

}  // namespace

void add_servo_map(CLI::App& app, Globals& globals) {
  auto make = std::make_shared<MakeServoMap>();
  CLI::App* command =
      app.add_subcommand("servo-map", "Make a servo map (YAML) of a RobovieMaker robot project");
  command->add_option("PROJECT", make->file, "The project, a .rpj file")->required();
  command->add_option("-o,--out", make->out, "File to write; else standard output")
      ->type_name("OUT");
  command->add_flag("--force", make->may_replace, "Replace an existing file");
  command->callback(
      [make, &globals] { globals.run = [make, &globals] { return run(*make, globals); }; });
}

}  // namespace kinefile::cli
