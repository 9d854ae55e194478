// SPDX-License-Identifier: MIT
#include "formats/npz/pose_table.hpp"

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "formats/npz/npy.hpp"
#include "formats/npz/zip.hpp"
#include "formats/pose_rows.hpp"
#include "kinefile/npz.hpp"

namespace kinefile::npz {
namespace {

/// Starts the entry of an array: its data follow.
/// \param element_size  bytes
void begin_array(ZipWriter& zip, const std::string& name, const std::string& type,
                 std::size_t element_size, std::initializer_list<std::uint64_t> shape) {
  const std::string header = npy_header(type, {shape.begin(), shape.size()});
  std::uint64_t size = element_size;
  for (const std::uint64_t length : shape) size *= length;
  zip.begin(name + ".npy", header.size() + size);
  zip.add(header);
}

/// Starts the entry of an array of numbers.
template <class T>
void begin_numbers(ZipWriter& zip, const std::string& name,
                   std::initializer_list<std::uint64_t> shape) {
  begin_array(zip, name, type_of<T>(), sizeof(T), shape);
}

template <class T>
bool add_numbers(ZipWriter& zip, const std::vector<T>& numbers) {
  return zip.add(bytes_of(std::span<const T>(numbers)));
}

void write_names(ZipWriter& zip, const std::vector<tables::PoseRow>& rows) {
  std::vector<std::string> labels;
  for (const tables::PoseRow& row : rows) labels.push_back(row.label);
  const Texts texts = texts_of(labels);
  const std::size_t num_characters = labels.empty() ? 0 : texts.characters.size() / labels.size();
  begin_array(zip, "names", texts.type, num_characters * sizeof(char32_t), {labels.size()});
  add_numbers(zip, texts.characters);
}

void write_times(ZipWriter& zip, const PoseTable& table) {
  const std::size_t num_frames = table.frames.num_frames();
  std::vector<std::int64_t> frames;
  std::vector<double> times;
  for (std::size_t f = 0; f < num_frames; ++f) {
    const std::size_t frame = table.frames.begin + f * table.frames.step;
    frames.push_back(static_cast<std::int64_t>(frame));
    times.push_back(time_of_frame(*table.timeline, frame));
  }
  begin_numbers<std::int64_t>(zip, "frames", {num_frames});
  add_numbers(zip, frames);
  begin_numbers<double>(zip, "times", {num_frames});
  add_numbers(zip, times);
}

/// Whether an array of poses is, byte for byte, what is written.
template <class T>
bool is_as_written(const PoseTable& table, const std::vector<tables::PoseRow>& rows,
                   const PoseArrays& poses) {
  return std::is_same_v<T, double> && table.length_scale == 1 && rows.size() == poses.num_joints &&
         !table.tips;
}

/// Writes the archive with numbers of type T. Positions go on as they come. What stands behind them
/// waits for all of them, in the form that is written: computing the poses a second time would cost
/// more than that memory, since the file may have to be read a second time for it.
template <class T>
bool write_numbers(const PoseTable& table, PoseBlocks blocks, const Sink& sink) {
  const std::vector<tables::PoseRow> rows = tables::pose_rows(table);
  const std::size_t num_frames = table.frames.num_frames();
  ZipWriter zip(sink);
  write_names(zip, rows);
  write_times(zip, table);
  std::vector<T> positions;
  std::vector<T> rotations;
  std::vector<T> directions;
  if (table.rotations) rotations.reserve(num_frames * rows.size() * 4);
  if (table.directions) directions.reserve(num_frames * rows.size() * 3);
  begin_numbers<T>(zip, "positions", {num_frames, rows.size(), 3});
  const bool is_whole = blocks([&](const PoseArrays& poses) {
    if (table.rotations) tables::append_of_joints(rows, poses, poses.rotations, 4, rotations);
    if (table.directions) tables::append_of_joints(rows, poses, poses.directions, 3, directions);
    if (is_as_written<T>(table, rows, poses)) {
      return zip.add(bytes_of(std::span<const double>(poses.positions)));
    }
    positions.clear();
    tables::append_points(table, rows, poses, positions);
    return add_numbers(zip, positions);
  });
  if (!is_whole) return false;
  if (table.rotations) {
    begin_numbers<T>(zip, "rotations", {num_frames, rows.size(), 4});
    add_numbers(zip, rotations);
  }
  if (table.directions) {
    begin_numbers<T>(zip, "directions", {num_frames, rows.size(), 3});
    add_numbers(zip, directions);
  }
  return zip.finish();
}

}  // namespace

bool write_poses(const PoseTable& table, PoseBlocks blocks, const kinefile::WriteOptions& options,
                 const Sink& sink) {
  const bool is_single = options.of_formats.get<WriteOptions>().precision == Precision::Single;
  return is_single ? write_numbers<float>(table, blocks, sink)
                   : write_numbers<double>(table, blocks, sink);
}

}  // namespace kinefile::npz
