// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "command.hpp"
#include "report.hpp"
#include "signals.hpp"

namespace kinefile::cli {
namespace {

/// The first word that is not an option: the place of the command.
std::string first_word(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (argv[i][0] != '-') return argv[i];
    if (std::string_view(argv[i]) == "--color") ++i;
  }
  return {};
}

/// Whether --out-dir is among the words, which makes every positional an input.
bool asks_for_many(int argc, char** argv) {
  return std::any_of(argv + std::min(argc, 1), argv + argc, [](std::string_view word) {
    return word == "--out-dir" || word.starts_with("--out-dir=");
  });
}

/// Prints the help or the version that was asked for, or what is wrong with the words.
/// \returns the exit code
int end_parsing(const CLI::App& app, const CLI::ParseError& error, const Globals& globals) {
  std::ostringstream asked;
  std::ostringstream wrong;
  const bool is_asked = app.exit(error, asked, wrong) == 0;
  print_data(asked.str());
  print_message(wrong.str());
  return finish_output(is_asked ? kDone : kUsage, globals);
}

int run(int argc, char** argv) {
  CLI::App app{"kinefile reads, checks, computes and converts the motion of skeletons and robots.",
               "kinefile"};
  app.set_version_flag("--version", fmt::format("kinefile {}", kVersion));
  app.require_subcommand(1);
  app.fallthrough();
  app.get_formatter()->column_width(34);
  app.footer(
      "Data goes to stdout, everything else to stderr.\n"
      "Exit codes: 0 done, 1 the input is not valid (diff: the motions differ), 2 usage,\n"
      "3 a file could not be read or written, 4 refused because data would be lost,\n"
      "5 some of many files failed.\n"
      "'kinefile COMMAND --help' tells more of a command.");
  Globals globals;
  globals.takes_many = asks_for_many(argc, argv);
  app.add_flag("-q,--quiet", globals.is_quiet, "No notes, no warnings: errors alone");
  app.add_option("--color", globals.color, "Colour messages: auto, always, never")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->default_str("auto")
      ->type_name("WHEN");
  std::string manual_kind;
  // For packagers: the man page and the completions are made from the options themselves.
  app.add_option("--generate", manual_kind)
      ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}))
      ->group("");
  add_info(app, globals);
  add_check(app, globals);
  add_fk(app, globals);
  add_convert(app, globals);
  add_diff(app, globals);
  add_warp(app, globals);
  add_align(app, globals);
  add_resample(app, globals);
  add_edit(app, globals);
  add_run(app, globals);
  add_graph(app, globals);
  add_keyframe(app, globals);
  add_servo_map(app, globals);
  add_view(app, globals);
  add_formats(app, globals);
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]).starts_with("--generate")) app.require_subcommand(0);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    const std::string word = first_word(argc, argv);
    const auto is_named = [&word](const CLI::App* command) { return command->get_name() == word; };
    if (word.empty() || !app.get_subcommands(is_named).empty()) {
      return end_parsing(app, error, globals);
    }
    return usage_error(globals,
                       fmt::format("there is no command '{}'; --help lists those there are", word));
  } catch (const CLI::ParseError& error) {
    return end_parsing(app, error, globals);
  }
  if (!manual_kind.empty()) {
    print_data(manual(app, manual_kind));
    return finish_output(kDone, globals);
  }
  return finish_output(globals.run(), globals);
}

}  // namespace

/// Opens standard streams that the caller closed on the null device. Otherwise a file that is
/// opened later would get their number, and our messages would go into that file. They are opened
/// the wrong way round, so that reading or writing them is the fault that it is.
void open_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (::fcntl(stream, F_GETFD) != -1) continue;
    ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace kinefile::cli

int main(int argc, char** argv) {
  kinefile::cli::open_standard_streams();
  kinefile::cli::handle_signals();
  try {
    const int exit_code = kinefile::cli::run(argc, argv);
    kinefile::cli::end_by_noted_signal();
    return exit_code;
  } catch (const std::bad_alloc&) {
    kinefile::cli::print_message("kinefile: error[MEM001]: out of memory\n");
  } catch (const std::exception& error) {
    kinefile::cli::print_message(fmt::format("kinefile: error[INT001]: {}\n", error.what()));
  }
  return kinefile::cli::kIo;
}
