// SPDX-License-Identifier: MIT
#include <array>

#include "formats/json/writer.hpp"
#include "formats/pose_rows.hpp"

namespace kinefile {
namespace {

std::array<double, 3> scaled(const double* point, double scale) {
  return {point[0] * scale, point[1] * scale, point[2] * scale};
}

}  // namespace

bool write_pose_json(const PoseTable& table, const PoseArrays& poses, const Sink& sink) {
  const std::vector<tables::PoseRow> rows = tables::pose_rows(table);
  const std::size_t num_frames = poses.num_frames;
  text::Printer printer(sink, json::number_spelling(std::nullopt));
  const auto frame_of = [&](std::size_t i) { return poses.first_frame + i * poses.frame_step; };
  // One array of arrays, [frame][row]; `print_part` prints the innermost part.
  const auto print_table = [&](const auto& print_part) {
    json::print_elements(printer, num_frames, ",\n  ", [&](std::size_t i) {
      json::print_elements(printer, rows.size(), ",",
                           [&](std::size_t r) { print_part(i, rows[r]); });
    });
  };

  printer.print("{\"joints\":");
  json::print_elements(printer, rows.size(), ",",
                       [&](std::size_t r) { printer.print(text::json_string(rows[r].label)); });
  printer.print(",\n\"frames\":");
  json::print_elements(printer, num_frames, ",",
                       [&](std::size_t i) { printer.print(fmt::to_string(frame_of(i))); });
  printer.print(",\n\"times\":");
  json::print_elements(printer, num_frames, ",", [&](std::size_t i) {
    printer.print(time_of_frame(*table.timeline, frame_of(i)));
  });
  printer.print(",\n\"positions\":");
  print_table([&](std::size_t f, const tables::PoseRow& row) {
    json::print_array(printer, scaled(tables::point_of(poses, f, row), table.length_scale));
  });
  const auto numbers_of_joint = [&](std::span<const double> array, std::size_t width, std::size_t f,
                                    const tables::PoseRow& row) {
    return std::span(&array[(f * poses.num_joints + row.joint) * width], width);
  };
  if (table.rotations) {
    printer.print(",\n\"rotations\":");
    print_table([&](std::size_t f, const tables::PoseRow& row) {
      json::print_array(printer, numbers_of_joint(poses.rotations, 4, f, row));
    });
  }
  if (table.directions) {
    printer.print(",\n\"directions\":");
    print_table([&](std::size_t f, const tables::PoseRow& row) {
      json::print_array(printer, numbers_of_joint(poses.directions, 3, f, row));
    });
  }
  printer.print("}\n");
  return printer.finish();
}

}  // namespace kinefile
