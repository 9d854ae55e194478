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

/// Writes an array with a number for each frame, some thousand of them at a time.
template <class T, class NumberOf>
void write_of_frames(ZipWriter& zip, const std::string& name, const FrameRange& frames,
                     const NumberOf& number_of) {
  constexpr std::size_t kMostNumbers = std::size_t{1} << 13;
  begin_numbers<T>(zip, name, {frames.num_frames()});
  std::vector<T> numbers;
  for (std::size_t f = 0; f < frames.num_frames(); ++f) {
    numbers.push_back(number_of(frames.begin + f * frames.step));
    if (numbers.size() < kMostNumbers) continue;
    add_numbers(zip, numbers);
    numbers.clear();
  }
  add_numbers(zip, numbers);
}

void write_times(ZipWriter& zip, const PoseTable& table) {
  write_of_frames<std::int64_t>(zip, "frames", table.frames,
                                [](std::size_t frame) { return static_cast<std::int64_t>(frame); });
  write_of_frames<double>(zip, "times", table.frames, [&table](std::size_t frame) {
    return time_of_frame(*table.timeline, frame);
  });
}

/// Writes an array of numbers of type T, [frame][line][width].
/// \param whole   the array of some poses that is, byte for byte, what is written of them; null:
///                none is
/// \param append  appends what is written of some poses
template <class T, class Append>
bool write_frames(ZipWriter& zip, const std::string& name, PoseBlocks blocks,
                  std::initializer_list<std::uint64_t> shape,
                  const Array<double> PoseArrays::*whole, const Append& append) {
  std::vector<T> numbers;
  begin_numbers<T>(zip, name, shape);
  return blocks([&](const PoseArrays& poses) {
    if (std::is_same_v<T, double> && whole != nullptr) {
      return zip.add(bytes_of(std::span<const double>(poses.*whole)));
    }
    numbers.clear();
    append(poses, numbers);
    return add_numbers(zip, numbers);
  });
}

/// Writes the archive with numbers of type T. For each array the poses are computed again: to keep
/// what stands behind the positions would take more memory the longer the motion is, and as long.
template <class T>
bool write_numbers(const PoseTable& table, PoseBlocks blocks, const Sink& sink) {
  const std::vector<tables::PoseRow> rows = tables::pose_rows(table);
  const std::size_t num_frames = table.frames.num_frames();
  const bool has_all_joints = rows.size() == table.skeleton->joints.size() && !table.tips;
  const auto if_all_joints = [has_all_joints](const Array<double> PoseArrays::*array) {
    return has_all_joints ? array : nullptr;
  };
  ZipWriter zip(sink);
  write_names(zip, rows);
  write_times(zip, table);
  bool is_good =
      write_frames<T>(zip, "positions", blocks, {num_frames, rows.size(), 3},
                      table.length_scale == 1 ? if_all_joints(&PoseArrays::positions) : nullptr,
                      [&](const PoseArrays& poses, std::vector<T>& numbers) {
                        tables::append_points(table, rows, poses, numbers);
                      });
  if (is_good && table.rotations) {
    is_good = write_frames<T>(zip, "rotations", blocks, {num_frames, rows.size(), 4},
                              if_all_joints(&PoseArrays::rotations),
                              [&](const PoseArrays& poses, std::vector<T>& numbers) {
                                tables::append_of_joints(rows, poses, poses.rotations, 4, numbers);
                              });
  }
  if (is_good && table.directions) {
    is_good = write_frames<T>(zip, "directions", blocks, {num_frames, rows.size(), 3},
                              if_all_joints(&PoseArrays::directions),
                              [&](const PoseArrays& poses, std::vector<T>& numbers) {
                                tables::append_of_joints(rows, poses, poses.directions, 3, numbers);
                              });
  }
  return is_good && zip.finish();
}

}  // namespace

bool write_poses(const PoseTable& table, PoseBlocks blocks, const kinefile::WriteOptions& options,
                 const Sink& sink) {
  const bool is_single = options.of_formats.get<WriteOptions>().precision == Precision::Single;
  return is_single ? write_numbers<float>(table, blocks, sink)
                   : write_numbers<double>(table, blocks, sink);
}

}  // namespace kinefile::npz
