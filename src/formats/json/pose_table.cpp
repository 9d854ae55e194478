// SPDX-License-Identifier: MIT
#include "formats/json/pose_table.hpp"

#include <string>
#include <vector>

#include "formats/json/writer.hpp"
#include "formats/pose_rows.hpp"

namespace kinefile::json {
namespace {

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

/// Appends the numbers of some frames for all lines.
using AppendNumbers = FunctionRef<void(const PoseArrays& poses, std::vector<double>& numbers)>;

/// Prints an array [frame][line][width], each frame on a line of its own.
bool print_frames(text::Printer& printer, PoseBlocks blocks, std::size_t num_rows,
                  std::size_t width, AppendNumbers append) {
  std::vector<double> numbers;
  std::size_t first = 0;
  printer.print('[');
  const bool is_whole = blocks([&](const PoseArrays& poses) {
    numbers.clear();
    append(poses, numbers);
    const std::span<const double> all = numbers;
    const auto print_frame = [&](text::Printer& part, std::size_t f) {
      if (first + f > 0) part.print(",\n  ");
      print_elements(part, num_rows, ",", [&](std::size_t row) {
        print_array(part, all.subspan((f * num_rows + row) * width, width));
      });
    };
    printer.print_rows(poses.num_frames, num_rows * width,
                       [&](text::Printer& part, std::size_t begin, std::size_t end) {
                         for (std::size_t f = begin; f < end; ++f) print_frame(part, f);
                       });
    first += poses.num_frames;
    return printer.is_good();
  });
  printer.print(']');
  return is_whole;
}

}  // namespace

bool write_poses(const PoseTable& table, PoseBlocks blocks, const WriteOptions&, const Sink& sink) {
  const std::vector<tables::PoseRow> rows = tables::pose_rows(table);
  text::Printer printer(sink, number_spelling(std::nullopt));
  print_lines_and_times(printer, table, rows);
  printer.print(",\n\"positions\":");
  bool is_whole =
      print_frames(printer, blocks, rows.size(), 3, [&](const auto& poses, auto& numbers) {
        tables::append_points(table, rows, poses, numbers);
      });
  if (is_whole && table.rotations) {
    printer.print(",\n\"rotations\":");
    is_whole = print_frames(printer, blocks, rows.size(), 4, [&](const auto& poses, auto& numbers) {
      tables::append_of_joints(rows, poses, poses.rotations, 4, numbers);
    });
  }
  if (is_whole && table.directions) {
    printer.print(",\n\"directions\":");
    is_whole = print_frames(printer, blocks, rows.size(), 3, [&](const auto& poses, auto& numbers) {
      tables::append_of_joints(rows, poses, poses.directions, 3, numbers);
    });
  }
  printer.print("}\n");
  return printer.finish() && is_whole;
}

}  // namespace kinefile::json
