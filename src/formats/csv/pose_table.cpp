// SPDX-License-Identifier: MIT
#include "formats/csv/pose_table.hpp"

#include "formats/pose_rows.hpp"
#include "text/printer.hpp"

namespace kinefile::csv {
namespace {

/// Prints the rows of frames [begin, end) of some poses.
/// \param rows  with labels as fields
void print_poses(const PoseTable& table, const std::vector<tables::PoseRow>& rows,
                 const PoseArrays& poses, std::size_t begin, std::size_t end,
                 text::Printer& printer) {
  std::vector<double> numbers;
  for (std::size_t f = begin; f < end; ++f) {
    const std::size_t frame = poses.first_frame + f * poses.frame_step;
    const std::string frame_and_time =
        fmt::format("{},{},", frame, time_of_frame(*table.timeline, frame));
    for (const tables::PoseRow& row : rows) {
      printer.print(frame_and_time);
      printer.print(row.label);
      const double* const point = tables::point_of(poses, f, row);
      numbers.clear();
      for (std::size_t k = 0; k < 3; ++k) numbers.push_back(point[k] * table.length_scale);
      const std::size_t joint = f * poses.num_joints + row.joint;
      const auto append = [&](std::span<const double> array, std::size_t width) {
        const auto of_joint = array.subspan(joint * width, width);
        numbers.insert(numbers.end(), of_joint.begin(), of_joint.end());
      };
      if (table.rotations) append(poses.rotations, 4);
      if (table.directions) append(poses.directions, 3);
      printer.continue_row(numbers, ",");
      printer.print('\n');
    }
  }
}

}  // namespace

bool write_poses(const PoseTable& table, PoseBlocks blocks, const kinefile::WriteOptions&,
                 const Sink& sink) {
  std::vector<tables::PoseRow> rows = tables::pose_rows(table);
  for (tables::PoseRow& row : rows) row.label = text::csv_field(row.label);
  text::Printer printer(sink);
  printer.print("frame,time,joint,x,y,z");
  if (table.rotations) printer.print(",qw,qx,qy,qz");
  if (table.directions) printer.print(",ux,uy,uz");
  printer.print('\n');
  const std::size_t numbers_per_row =
      3u + (table.rotations ? 4u : 0u) + (table.directions ? 3u : 0u);
  const bool is_whole = blocks([&](const PoseArrays& poses) {
    printer.print_rows(poses.num_frames, rows.size() * numbers_per_row,
                       [&](text::Printer& part, std::size_t begin, std::size_t end) {
                         print_poses(table, rows, poses, begin, end, part);
                       });
    return printer.is_good();
  });
  return printer.finish() && is_whole;
}

}  // namespace kinefile::csv
