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

const Format* output_format(const Writing& writing, const Document& input) {
  if (writing.out == "-" && writing.to.empty()) return find_format(input.format);
  return output_format(writing);
}

namespace {

/// Reads the skeleton that the output is to have.
Result<Document> load_skeleton(const Reading& reading, Diagnostics& diagnostics) {
  Reading skeleton_reading = reading;
  skeleton_reading.from.clear();
  skeleton_reading.encoding.clear();
  skeleton_reading.skeleton.clear();
  return load_quietly(reading.skeleton, skeleton_reading, diagnostics);
}

Result<void> write_adapted(Document&& document, const Format& format, const Writing& writing,
                           const Reading& reading, Diagnostics& diagnostics) {
  ChannelOptions channels = writing.channels;
  channels.lenient = reading.is_lenient;
  const auto kept = document.extras.file.find("positions");
  channels.adds_positions = kept != document.extras.file.end() && kept->second == "add";
  WriteOptions options;
  options.decimals = writing.decimals;
  const bool has_named_skeleton = !reading.skeleton.empty() && !format.companion.empty();
  std::optional<Document> skeleton;
  if (has_named_skeleton) {
    Diagnostics ignored;  // a motion that needs it has told of it already
    const bool is_new = document.format != format.name;
    auto loaded = load_skeleton(reading, is_new ? diagnostics : ignored);
    if (!loaded) return fail(std::move(loaded.error()));
    skeleton = std::move(*loaded);
    if (is_new) {
      auto moved = on_skeleton_of(*skeleton, std::move(document), diagnostics);
      if (!moved) return fail(std::move(moved.error()));
      document = std::move(*moved);
    }
  }
  auto adapted = adapted_to(format, std::move(document), channels, diagnostics);
  if (!adapted) return fail(std::move(adapted.error()));
  // The named skeleton serves the output, too, as long as the motion still fits it.
  if (skeleton && skeleton->format == format.companion &&
      are_written_alike(*find_format(format.companion), *skeleton, *adapted)) {
    options.writes_companion = false;
    options.companion = reading.skeleton.substr(reading.skeleton.find_last_of('/') + 1);
  }
  return write_file(writing.out, *adapted, format, options, writing.may_replace, diagnostics);
}

}  // namespace

int write_document(Result<void> made, Document&& document, const Format& format,
                   const Writing& writing, const std::string& source, const Reading& reading,
                   Diagnostics& diagnostics, const Globals& globals) {
  if (made) made = write_adapted(std::move(document), format, writing, reading, diagnostics);
  print_diagnostics(stderr, diagnostics, globals);
  if (made) return kDone;
  if (made.error().place.source.empty()) made.error().place.source = source;
  // What --strict made an error of has been printed already.
  if (!diagnostics.has_errors()) print_error(made.error(), globals);
  return exit_code_of(made.error());
}

}  // namespace kinefile::cli
