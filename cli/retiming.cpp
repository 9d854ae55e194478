// SPDX-License-Identifier: MIT
#include "retiming.hpp"

#include <fmt/format.h>

#include "options.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

retime::RotationInterpolation rotation_of(const std::string& word) {
  if (word == "nlerp") return retime::RotationInterpolation::Nlerp;
  if (word == "cubic") return retime::RotationInterpolation::Cubic;
  return word == "euler" ? retime::RotationInterpolation::Euler
                         : retime::RotationInterpolation::Slerp;
}

/// Prints `new,old` for every new frame.
void print_table(const retime::TimeMap& map) {
  fmt::memory_buffer text;
  for (std::size_t n = 0; n < map.old_frames.size(); ++n) {
    fmt::format_to(std::back_inserter(text), "{},{}\n", n, map.old_frames[n]);
  }
  print_data({text.data(), text.size()});
}

}  // namespace

retime::RetimeOptions retime_options(const Retiming& retiming) {
  retime::RetimeOptions options;
  options.rotation = rotation_of(retiming.rotation);
  options.antialias = retiming.has_antialias;
  options.lenient = retiming.reading.is_lenient;
  return options;
}

void add_retiming_options(CLI::App& command, Retiming& retiming, bool has_table) {
  command
      .add_option("--rotation", retiming.rotation,
                  "How rotations between two frames are found: slerp, nlerp, cubic (SQUAD), or "
                  "euler, angle by angle")
      ->check(CLI::IsMember({"slerp", "nlerp", "cubic", "euler"}))
      ->default_str("slerp")
      ->type_name("HOW");
  command.add_flag("--antialias", retiming.has_antialias,
                   "Average over the frames that are passed over where time runs fast");
  retiming.writing.out = "-";
  CLI::Option* out = command
                         .add_option("-o,--out", retiming.writing.out,
                                     "File to write; else standard output, in the input's format")
                         ->type_name("OUT");
  if (has_table) {
    command
        .add_flag("--table", retiming.prints_table,
                  "Print new,old for every new frame instead of the motion")
        ->excludes(out);
  }
  add_writing_options(command, retiming.writing);
  add_reading_options(command, retiming.reading);
}

std::optional<Document> load_motion(const std::string& path, const Reading& reading,
                                    const Globals& globals, int& exit_code) {
  auto document = load(path, reading, globals, exit_code);
  if (!document) return document;
  if (retime::has_frames(*document)) return document;
  exit_code = usage_error(globals, fmt::format("'{}' holds no motion", path));
  return std::nullopt;
}

int finish_retiming(Result<retime::TimeMap> map, Document&& document, const std::string& path,
                    const Retiming& retiming, Diagnostics& diagnostics, const Globals& globals) {
  const Format* format = output_format(retiming.writing, path, document);
  if (format == nullptr) return no_output_format(retiming.writing, globals);
  if (map && retiming.prints_table) {
    if (finish_reading(retiming.reading, globals, kDone) != kDone) return kUsage;
    print_diagnostics(stderr, diagnostics, globals);
    print_table(*map);
    return kDone;
  }
  auto made = map ? retime::apply(document, *map, retime_options(retiming), diagnostics)
                  : Result<void>(fail(std::move(map.error())));
  return write_document(std::move(made), std::move(document), *format, retiming.writing, path,
                        retiming.reading, diagnostics, globals);
}

}  // namespace kinefile::cli
