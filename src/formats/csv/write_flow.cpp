// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "formats/csv/flow_table.hpp"
#include "formats/files.hpp"
#include "kinefile/robot_project.hpp"
#include "model/slider_words.hpp"
#include "text/printer.hpp"

namespace kinefile::csv {
namespace {

/// Converts words to fields.
struct WordPrinter {
  const RobotProject* project = nullptr;  ///< null: as words
  std::vector<std::int16_t> base;         ///< the words at which degrees are 0; missing: 0

  void print(text::Printer& printer, const SliderWord& word, std::size_t slider) const {
    const bool has_degrees = project != nullptr && word.is_enabled &&
                             slider < project->sliders.size() &&
                             project->sliders[slider].units_per_degree > 0;
    if (!has_degrees) {
      printer.print(word_text(word));
      return;
    }
    const int from = slider < base.size() ? base[slider] : 0;
    printer.print((word.value - from) / project->sliders[slider].units_per_degree);
  }
};

}  // namespace

Result<void> write_flow(const PoseFlow& flow, const kinefile::WriteOptions& options,
                        const Sink& sink) {
  const bool has_poses_alone =
      std::all_of(flow.blocks.begin(), flow.blocks.end(),
                  [](const Block& block) { return std::holds_alternative<PoseBlock>(block.body); });
  if (!has_poses_alone) {
    return fail(make_error(ErrorKind::Usage, "CSV001",
                           "expected a flow of poses alone to write as CSV, found other blocks"));
  }
  WordPrinter words;
  const auto& own = options.of_formats.get<csv::WriteOptions>();
  if (own.in_degrees) words.project = options.project.get();
  if (words.project != nullptr && own.is_relative) words.base = base_values(*words.project);
  text::Printer printer(sink, {.decimals = options.decimals});
  printer.print("time,next,break,sound");
  for (std::size_t s = 0; s < flow.num_sliders; ++s) printer.print(fmt::format(",s{}", s));
  printer.print('\n');
  for (const Block& block : flow.blocks) {
    const PoseBlock& pose = std::get<PoseBlock>(block.body);
    printer.print(fmt::format("{},{},{},{}", pose.ticks, block.normal, block.branch,
                              text::csv_field(pose.sound)));
    for (std::size_t s = 0; s < pose.words.size(); ++s) {
      printer.print(',');
      words.print(printer, pose.words[s], s);
    }
    printer.print('\n');
  }
  return finish(printer);
}

}  // namespace kinefile::csv
