// SPDX-License-Identifier: MIT
#include "writing.hpp"

#include <fmt/format.h>

#include "report.hpp"

namespace kinefile::cli {
namespace {

std::vector<std::string> writable_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (format.write != nullptr) names.emplace_back(format.name);
  }
  return names;
}

}  // namespace

void add_writing_options(CLI::App& command, Writing& writing) {
  command.add_option("--to", writing.to, "Format of the output; else its name tells")
      ->check(CLI::IsMember(writable_formats()))
      ->type_name("FORMAT");
  command
      .add_option("--decimals", writing.decimals,
                  "Digits after the point; else as many as the exact value needs")
      ->check(CLI::Range(0, 30))
      ->type_name("N");
  command.add_flag("--force", writing.may_replace, "Replace an existing file");
}

const Format* output_format(const Writing& writing) {
  return writing.to.empty() ? format_of_name(writing.out) : find_format(writing.to);
}

int no_output_format(const Writing& writing, const Globals& globals) {
  return usage_error(globals,
                     fmt::format("'{}' shows no format by its name; --to names it", writing.out));
}

int write_document(Result<void> made, const Document& document, const Format& format,
                   const Writing& writing, const std::string& source, Diagnostics& diagnostics,
                   const Globals& globals) {
  if (made) {
    WriteOptions options;
    options.decimals = writing.decimals;
    made = write_file(writing.out, document, format, options, writing.may_replace, diagnostics);
  }
  print_diagnostics(stderr, diagnostics, globals);
  if (made) return kDone;
  if (made.error().place.source.empty()) made.error().place.source = source;
  // What --strict made an error of has been printed already.
  if (!diagnostics.has_errors()) print_error(made.error(), globals);
  return exit_code_of(made.error());
}

}  // namespace kinefile::cli
