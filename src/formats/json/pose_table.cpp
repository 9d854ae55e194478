// SPDX-License-Identifier: MIT
#include "formats/json/pose_table.hpp"

#include <string>
#include <vector>

#include "formats/json/writer.hpp"
#include "formats/pose_rows.hpp"

namespace kinefile::json {
namespace {

/// Prints frames of an array [frame][row][width], each on a line of its own.
/// \param numbers  of the frames from `first` to `end`
void print_frames(text::Printer& printer, std::size_t first, std::size_t end, std::size_t num_rows,
                  std::size_t width, std::span<const double> numbers) {
  for (std::size_t f = first; f < end; ++f) {
    if (f > 0) printer.print(",\n  ");
    print_elements(printer, num_rows, ",", [&](std::size_t) {
      print_array(printer, numbers.first(width));
      numbers = numbers.subspan(width);
    });
  }
}

/// Prints what stands before the poses.
void print_lines_and_times(text::Printer& printer, const PoseTable& table,
                           const std::vector<tables::PoseRow>& rows) {
  const std::size_t num_frames = table.frames.num_frames();
  const auto frame_of = [&](std::size_t i) { return table.frames.begin + i * table.frames.step; };
  printer.print("{\"joints\":");
  print_elements(printer, rows.size(), ",",
                 [&](std::size_t r) { printer.print(text::json_string(rows[r].label)); });
  printer.print(",\n\"frames\":");
  print_elements(printer, num_frames, ",",
                 [&](std::size_t i) { printer.print(fmt::to_string(frame_of(i))); });
  printer.print(",\n\"times\":");
  print_elements(printer, num_frames, ",", [&](std::size_t i) {
    printer.print(time_of_frame(*table.timeline, frame_of(i)));
  });
}

}  // namespace

bool write_poses(const PoseTable& table, PoseBlocks blocks, const WriteOptions&, const Sink& sink) {
  const std::vector<tables::PoseRow> rows = tables::pose_rows(table);
  text::Printer printer(sink, number_spelling(std::nullopt));
  print_lines_and_times(printer, table, rows);
  printer.print(",\n\"positions\":[");
  // Rotations and directions stand behind all positions.
  std::vector<double> positions;
  std::vector<double> rotations;
  std::vector<double> directions;
  std::size_t num_printed = 0;
  const bool is_whole = blocks([&](const PoseArrays& poses) {
    positions.clear();
    tables::append_points(table, rows, poses, positions);
    print_frames(printer, num_printed, num_printed + poses.num_frames, rows.size(), 3, positions);
    num_printed += poses.num_frames;
    if (table.rotations) tables::append_of_joints(rows, poses, poses.rotations, 4, rotations);
    if (table.directions) tables::append_of_joints(rows, poses, poses.directions, 3, directions);
    return printer.finish();
  });
  if (table.rotations) {
    printer.print("],\n\"rotations\":[");
    print_frames(printer, 0, num_printed, rows.size(), 4, rotations);
  }
  if (table.directions) {
    printer.print("],\n\"directions\":[");
    print_frames(printer, 0, num_printed, rows.size(), 3, directions);
  }
  printer.print("]}\n");
  return printer.finish() && is_whole;
}

}  // namespace kinefile::json
