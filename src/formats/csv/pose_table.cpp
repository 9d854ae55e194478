// SPDX-License-Identifier: MIT
#include "formats/pose_rows.hpp"
#include "text/printer.hpp"

namespace kinefile {
namespace {

void print_numbers(text::Printer& printer, const double* numbers, std::size_t count, double scale) {
  for (std::size_t i = 0; i < count; ++i) {
    printer.print(',');
    printer.print(numbers[i] * scale);
  }
}

}  // namespace

bool write_pose_csv_header(const PoseTable& table, const Sink& sink) {
  std::string header = "frame,time,joint,x,y,z";
  if (table.rotations) header += ",qw,qx,qy,qz";
  if (table.directions) header += ",ux,uy,uz";
  return sink(header + "\n");
}

bool write_pose_csv(const PoseTable& table, const PoseArrays& poses, const Sink& sink) {
  std::vector<tables::PoseRow> rows = tables::pose_rows(table);
  for (tables::PoseRow& row : rows) row.label = text::csv_field(row.label);
  text::Printer printer(sink);
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    const std::size_t frame = poses.first_frame + f * poses.frame_step;
    const std::string frame_and_time =
        fmt::format("{},{},", frame, time_of_frame(*table.timeline, frame));
    for (const tables::PoseRow& row : rows) {
      printer.print(frame_and_time);
      printer.print(row.label);
      print_numbers(printer, tables::point_of(poses, f, row), 3, table.length_scale);
      const std::size_t joint = f * poses.num_joints + row.joint;
      if (table.rotations) print_numbers(printer, &poses.rotations[joint * 4], 4, 1);
      if (table.directions) print_numbers(printer, &poses.directions[joint * 3], 3, 1);
      printer.print('\n');
    }
  }
  return printer.finish();
}

}  // namespace kinefile
