// SPDX-License-Identifier: MIT
#include "formats/csv/format.hpp"

#include <array>

#include "formats/common_options.hpp"
#include "formats/csv/flow_table.hpp"
#include "formats/csv/pose_table.hpp"
#include "formats/csv/read.hpp"
#include "formats/files.hpp"
#include "text/printer.hpp"
#include "text/scanner.hpp"

namespace kinefile::csv {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".csv"};

constexpr OptionInfo kDegrees = {
    .name = "degrees",
    .type = OptionType::Flag,
    .help = "Words of a flow's table are degrees, by --project",
};
constexpr OptionInfo kRelative = {
    .name = "relative",
    .type = OptionType::Flag,
    .help = "Degrees from the base pose on",
};
constexpr std::array<ReadOption, 5> kReadOptions = {
    options::kProject,
    words::format_option<kinefile::ReadOptions, &csv::ReadOptions::in_degrees>(kDegrees),
    words::format_option<kinefile::ReadOptions, &csv::ReadOptions::is_relative>(kRelative),
    options::kFps,
    options::kEncoding,
};
constexpr std::array<WriteOption, 4> kWriteOptions = {
    options::kProjectOfOutput,
    words::format_option<kinefile::WriteOptions, &csv::WriteOptions::in_degrees>(kDegrees),
    words::format_option<kinefile::WriteOptions, &csv::WriteOptions::is_relative>(kRelative),
    options::kDecimals,
};

constexpr Kinds kWrites = {.motions = true, .flows = true};

/// Tables that are read begin with the time.
bool probe(std::string_view head) { return text::starts_with_ignoring_case(head, "time,"); }

/// \param frames  of the motion, whose own clip is not looked at
Result<void> write_motion(const Motion& motion, EachBlock frames,
                          const kinefile::WriteOptions& options, const Sink& sink) {
  text::Printer printer(sink, {.decimals = options.decimals});
  printer.print("time");
  for (const std::string& name : column_names(motion.skeleton)) {
    printer.print(',');
    printer.print(text::csv_field(name));
  }
  printer.print('\n');
  const std::size_t num_columns = motion.skeleton.coordinates.size();
  auto printed = frames([&](const FrameBlock& block) {
    const auto print = [&](text::Printer& part, std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        part.print_exact(time_of_frame(motion.clip.timeline, block.first_frame + f));
        part.continue_row(block.rows.subspan(f * num_columns, num_columns), ",");
        part.print('\n');
      }
    };
    printer.print_rows(block.num_frames, num_columns + 1, print);
    return printer.is_good();
  });
  return finish(printer, std::move(printed));
}

Result<void> write(const Document& document, const kinefile::WriteOptions& options,
                   const Sink& sink, Diagnostics&) {
  if (const PoseFlow* flow = std::get_if<PoseFlow>(&document.content)) {
    return write_flow(*flow, options, sink);
  }
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (motion == nullptr && has_skeleton(document)) {
    return fail(make_error(ErrorKind::Usage, "CSV001",
                           "expected a motion to write as CSV, found a skeleton alone"));
  }
  if (auto taken = expect_kind(document, kWrites, "a motion to write as CSV"); !taken) return taken;
  return write_motion(
      *motion, [motion](UseBlock use) { return for_each_block(motion->clip, use); }, options, sink);
}

Result<void> write_frames(const LongMotion& motion, const kinefile::WriteOptions& options,
                          const Sink& sink, Diagnostics&) {
  return write_motion(
      std::get<Motion>(motion.document.content),
      [&motion](UseBlock use) { return for_each_block(motion.frames, use); }, options, sink);
}

}  // namespace

Format format() {
  Format format;
  format.name = "csv";
  format.description = "comma-separated values: a row a frame, a column a channel";
  format.extensions = kExtensions;
  format.probe = probe;
  format.read = read;
  format.write = write;
  if (kReadsInBlocks) {
    format.read_pieces = read_pieces;
    format.write_frames = write_frames;
  }
  format.facts = facts_of_layout;
  format.write_poses = write_poses;
  format.takes_skeleton = true;
  format.conventions.writes = kWrites;
  format.conventions.has_columns_of_components = true;
  // A table has one row per pose, each with its next and break.
  format.conventions.flow_format = FlowFormat::WordN;
  format.read_options = kReadOptions;
  format.write_options = kWriteOptions;
  format.conventions.keeps_times = true;
  return format;
}

}  // namespace kinefile::csv
