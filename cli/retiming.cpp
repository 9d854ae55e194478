// SPDX-License-Identifier: MIT
#include "retiming.hpp"

#include <fmt/format.h>

#include "options.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

/// Prints `new,old` for every new frame.
void print_table(const retime::TimeMap& map) {
  fmt::memory_buffer text;
  for (std::size_t n = 0; n < map.old_frames.size(); ++n) {
    fmt::format_to(std::back_inserter(text), "{},{}\n", n, map.old_frames[n]);
  }
  print_data({text.data(), text.size()});
}

Error no_motion(const std::string& path) {
  return make_error(ErrorKind::Usage, "CLI001", fmt::format("'{}' holds no motion", path));
}

}  // namespace

retime::RetimeOptions options_of(const Retiming& retiming) {
  retime::RetimeOptions options = retiming.options;
  options.lenient = retiming.reading.is_lenient;
  return options;
}

void add_retiming_inputs(CLI::App& command, std::string& file, Retiming& retiming,
                         const Globals& globals) {
  if (globals.takes_many) {
    add_inputs(command, retiming.many);
  } else {
    command.add_option("FILE", file, "File to read; - is standard input")->required();
  }
}

int retime_many(
    const Retiming& retiming,
    const std::function<Result<void>(Document& document, Diagnostics& diagnostics)>& retime,
    const ChangeLong& retime_in_blocks, const Globals& globals) {
  const ManyChange change = [&retime](const ManyFile& file, Document& document, const Reading&,
                                      Diagnostics& diagnostics) -> Result<void> {
    if (!retime::has_frames(document)) return fail(no_motion(file.path));
    return retime(document, diagnostics);
  };
  return run_many_documents(retiming.many, retiming.reading, retiming.writing, change,
                            retime_in_blocks, {}, globals);
}

void add_retiming_options(CLI::App& command, Retiming& retiming, bool has_table, bool takes_many) {
  add_flags(command, retime::retime_options(), retiming.options);
  retiming.writing.out = "-";
  CLI::Option* out = command
                         .add_option("-o,--out", retiming.writing.out,
                                     "File to write; else standard output, in the input's format")
                         ->type_name("OUT");
  std::vector<CLI::Option*> for_one_file = {out};
  if (has_table) {
    CLI::Option* table = command
                             .add_flag("--table", retiming.prints_table,
                                       "Print new,old for every new frame instead of the motion")
                             ->excludes(out);
    for_one_file.push_back(table);
  }
  if (takes_many) add_many_options(command, retiming.many, for_one_file);
  add_writing_options(command, retiming.writing);
  add_reading_options(command, retiming.reading);
}

std::optional<Document> load_motion(const std::string& path, const Reading& reading,
                                    const Globals& globals, int& exit_code) {
  auto document = load(path, reading, globals, exit_code);
  if (!document) return document;
  if (retime::has_frames(*document)) return document;
  exit_code = usage_error(globals, no_motion(path).message);
  return std::nullopt;
}

int finish_retiming(Result<retime::TimeMap> map, Document&& document, const std::string& path,
                    const Retiming& retiming, Diagnostics& diagnostics, const Globals& globals) {
  const Format* format = output_format(retiming.writing, path, document);
  if (format == nullptr) return no_output_format(retiming.writing, globals);
  if (map && retiming.prints_table) {
    if (finish_reading(retiming.reading, globals, kDone) != kDone) return kUsage;
    print_diagnostics(STDERR_FILENO, diagnostics, globals);
    print_table(*map);
    return kDone;
  }
  auto made = map ? retime::apply(document, *map, options_of(retiming), diagnostics)
                  : Result<void>(fail(std::move(map.error())));
  return write_document(std::move(made), std::move(document), *format, retiming.writing, path,
                        retiming.reading, diagnostics, globals);
}

}  // namespace kinefile::cli
