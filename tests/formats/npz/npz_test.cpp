// SPDX-License-Identifier: MIT
#include "kinefile/npz.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <map>
#include <span>

#include "formats/npz/npy.hpp"
#include "formats/npz/zip.hpp"
#include "kinefile/fk.hpp"
#include "walk.hpp"

namespace kinefile::npz {
namespace {

/// The low bytes first.
std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t k = size; k-- > 0;) {
    number = number << 8 | static_cast<unsigned char>(bytes.at(at + k));
  }
  return number;
}

/// An entry as the directory of an archive has it.
struct DirectoryEntry {
  std::uint64_t crc = 0;
  std::uint64_t size = 0;
  std::uint64_t offset = 0;
};

struct Directory {
  std::map<std::string, DirectoryEntry> entries;
  bool has_zip64_end = false;
};

/// Reads the directory at the end of an archive.
/// \param end     the last bytes, with all of the directory
/// \param before  the number of bytes before them
Directory directory_of(std::string_view end, std::uint64_t before) {
  const std::size_t last = end.size() - 22;
  EXPECT_EQ(number_at(end, last, 4), 0x06054b50u);
  std::uint64_t count = number_at(end, last + 10, 2);
  std::uint64_t start = number_at(end, last + 16, 4);
  Directory directory;
  directory.has_zip64_end = start == 0xFFFFFFFF;
  if (directory.has_zip64_end) {
    EXPECT_EQ(number_at(end, last - 20, 4), 0x07064b50u);
    const std::size_t record = number_at(end, last - 20 + 8, 8) - before;
    EXPECT_EQ(number_at(end, record, 4), 0x06064b50u);
    EXPECT_EQ(number_at(end, record + 4, 8), 44u);
    count = number_at(end, record + 32, 8);
    start = number_at(end, record + 48, 8);
    EXPECT_EQ(start + number_at(end, record + 40, 8), before + record);
  }
  for (std::size_t at = start - before; count-- > 0;) {
    EXPECT_EQ(number_at(end, at, 4), 0x02014b50u);
    DirectoryEntry entry{number_at(end, at + 16, 4), number_at(end, at + 24, 4),
                         number_at(end, at + 42, 4)};
    const std::size_t name_size = number_at(end, at + 28, 2);
    const std::size_t extra_size = number_at(end, at + 30, 2);
    std::size_t extra = at + 46 + name_size + 4;
    if (entry.size == 0xFFFFFFFF) {
      entry.size = number_at(end, extra, 8);
      EXPECT_EQ(number_at(end, extra + 8, 8), entry.size);
      extra += 16;
    }
    if (entry.offset == 0xFFFFFFFF) entry.offset = number_at(end, extra, 8);
    directory.entries[std::string(end.substr(at + 46, name_size))] = entry;
    at += 46 + name_size + extra_size;
  }
  return directory;
}

/// The contents of an archive, by name. Checks headers, descriptors and CRCs.
std::map<std::string, std::string> unzipped(std::string_view zip) {
  std::map<std::string, std::string> contents;
  for (const auto& [name, entry] : directory_of(zip, 0).entries) {
    const std::size_t begin = entry.offset + 30 + name.size();
    EXPECT_EQ(number_at(zip, entry.offset, 4), 0x04034b50u);
    EXPECT_EQ(zip.substr(entry.offset + 30, name.size()), name);
    const std::string content(zip.substr(begin, entry.size));
    EXPECT_EQ(number_at(zip, begin + entry.size, 4), 0x08074b50u);
    EXPECT_EQ(number_at(zip, begin + entry.size + 4, 4), entry.crc);
    EXPECT_EQ(number_at(zip, begin + entry.size + 8, 4), entry.size);
    EXPECT_EQ(::crc32(0, reinterpret_cast<const Bytef*>(content.data()),
                      static_cast<uInt>(content.size())),
              entry.crc);
    contents[name] = content;
  }
  return contents;
}

/// The archive of a walk.
std::string walk_npz(const FkOptions& options, const kinefile::WriteOptions& writing = {}) {
  Placed placed{examples::make_walk({.num_frames = 700})};
  placed.motion.skeleton.metres_per_unit = 0.01;
  placed.motion.skeleton.joints[1].name = "\u8170\U0001F9B4";
  const auto table = fk(std::move(placed), options);
  std::string bytes;
  EXPECT_TRUE(write_table(*table, *find_format("npz"), writing, [&bytes](std::string_view piece) {
    bytes += piece;
    return true;
  }));
  return bytes;
}

/// The data of an array, whose header must have a type and a shape.
template <class T>
std::vector<T> array_of(const std::string& npy, const std::string& type, const std::string& shape) {
  const std::size_t begin = 10 + number_at(npy, 8, 2);
  EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\1\0", 8));
  EXPECT_EQ(begin % 64, 0u);
  EXPECT_EQ(npy[begin - 1], '\n');
  EXPECT_TRUE(npy.substr(10).starts_with("{'descr': '" + type +
                                         "', 'fortran_order': False, 'shape': " + shape + ", } "))
      << npy.substr(10, begin - 10);
  std::vector<T> numbers((npy.size() - begin) / sizeof(T));
  EXPECT_EQ(numbers.size() * sizeof(T), npy.size() - begin);
  if (!numbers.empty()) std::memcpy(numbers.data(), npy.data() + begin, npy.size() - begin);
  return numbers;
}

TEST(Npz, HasAnArrayForEachQuantity) {
  const auto table = fk(Placed{examples::make_walk({.num_frames = 700})},
                        {.tips = true, .rotations = true, .directions = true});
  const PoseArrays poses = poses_of(*table, table->frames);
  const auto arrays = unzipped(walk_npz({.rotations = true, .directions = true}));
  EXPECT_EQ(arrays.size(), 6u);
  const auto positions = array_of<double>(arrays.at("positions.npy"), "<f8", "(700, 22, 3)");
  EXPECT_TRUE(std::equal(positions.begin(), positions.end(), poses.positions.begin()));
  const auto rotations = array_of<double>(arrays.at("rotations.npy"), "<f8", "(700, 22, 4)");
  EXPECT_TRUE(std::equal(rotations.begin(), rotations.end(), poses.rotations.begin()));
  const auto directions = array_of<double>(arrays.at("directions.npy"), "<f8", "(700, 22, 3)");
  EXPECT_TRUE(std::equal(directions.begin(), directions.end(), poses.directions.begin()));
  const auto times = array_of<double>(arrays.at("times.npy"), "<f8", "(700,)");
  EXPECT_EQ(times[600], time_of_frame(table->placed.motion.clip.timeline, 600));
  EXPECT_EQ(array_of<std::int64_t>(arrays.at("frames.npy"), "<i8", "(700,)")[699], 699);
  const auto names = array_of<char32_t>(arrays.at("names.npy"), "<U13", "(22,)");
  EXPECT_EQ(std::u32string(&names[0]), U"Hips");
  EXPECT_EQ(std::u32string(&names[13]), U"\u8170\U0001F9B4");
}

TEST(Npz, TakesFramesJointsTipsUnitsAndPrecision) {
  kinefile::WriteOptions writing;
  writing.of_formats = WriteOptions{Precision::Single};
  const auto all = array_of<double>(unzipped(walk_npz({.metres = true})).at("positions.npy"), "<f8",
                                    "(700, 22, 3)");
  const auto arrays = unzipped(walk_npz({.frames = "5:12:3",
                                         .joints = {"Head", "Hips"},
                                         .tips = true,
                                         .rotations = true,
                                         .metres = true},
                                        writing));
  const auto positions = array_of<float>(arrays.at("positions.npy"), "<f4", "(3, 3, 3)");
  EXPECT_EQ(positions[9], static_cast<float>(all[std::size_t{8} * 22 * 3]));
  EXPECT_EQ(array_of<float>(arrays.at("rotations.npy"), "<f4", "(3, 3, 4)").size(), 36u);
  EXPECT_EQ(array_of<std::int64_t>(arrays.at("frames.npy"), "<i8", "(3,)"),
            (std::vector<std::int64_t>{5, 8, 11}));
  const auto names = array_of<char32_t>(arrays.at("names.npy"), "<U8", "(3,)");
  EXPECT_EQ(std::u32string(&names[16], 8), U"Head.tip");
  EXPECT_EQ(arrays.count("directions.npy"), 0u);
}

TEST(Npz, WithoutFramesArraysAreEmpty) {
  const auto arrays = unzipped(walk_npz({.frames = "5:5", .rotations = true}));
  EXPECT_TRUE(array_of<double>(arrays.at("positions.npy"), "<f8", "(0, 22, 3)").empty());
  EXPECT_TRUE(array_of<double>(arrays.at("rotations.npy"), "<f8", "(0, 22, 4)").empty());
}

TEST(Npz, TheSameInputGivesTheSameBytes) {
  EXPECT_EQ(walk_npz({.rotations = true}), walk_npz({.rotations = true}));
}

TEST(Npz, StopsWithTheSink) {
  const auto table = fk(Placed{examples::make_walk({.num_frames = 2})}, {});
  EXPECT_FALSE(
      write_table(*table, *find_format("npz"), {}, [](std::string_view) { return false; }));
}

TEST(Npz, NamesThatAreNoUtf8AreReplaced) {
  const std::string names[] = {"a\xFFz", ""};
  EXPECT_EQ(texts_of(names).type, "<U3");
  EXPECT_EQ(texts_of(names).characters,
            (std::vector<char32_t>{U'a', 0xFFFD, U'z', U'\0', U'\0', U'\0'}));
  EXPECT_EQ(texts_of({&names[1], 1}).type, "<U1");
}

/// Writes an archive with a large entry between two small ones; keeps its end, and what stands
/// before and behind the large entry.
struct LargeArchive {
  static constexpr std::uint64_t kSize = (std::uint64_t{1} << 32) + 5;
  std::string head;
  std::string end;
  std::uint64_t num_bytes = 0;

  LargeArchive() {
    const Sink sink = [this](std::string_view piece) {
      num_bytes += piece.size();
      if (piece.size() < 1000) (num_bytes < kSize ? head : end) += piece;
      return true;
    };
    ZipWriter zip(sink);
    zip.begin("a", 1);
    zip.add("a");
    zip.begin("large", kSize);
    const std::string chunk(std::size_t{1} << 20, 'x');
    for (std::uint64_t done = 0; done < kSize - 5; done += chunk.size()) zip.add(chunk);
    zip.add("12345");
    zip.begin("z", 1);
    zip.add("z");
    zip.finish();
  }
};

TEST(Npz, EntriesBeyondFourGigabytesHaveZip64Fields) {
  const LargeArchive archive;
  const std::size_t size_before = 30 + 1 + 1 + 16;  // of "a"
  const std::string_view header = std::string_view(archive.head).substr(size_before);
  EXPECT_EQ(number_at(header, 4, 2), 45u);
  EXPECT_EQ(number_at(header, 18, 4), 0xFFFFFFFFu);
  EXPECT_EQ(number_at(header, 28, 2), 20u);
  EXPECT_EQ(header.size(), 30u + 5 + 20);
  const Directory directory = directory_of(archive.end, archive.num_bytes - archive.end.size());
  EXPECT_TRUE(directory.has_zip64_end);
  const DirectoryEntry& large = directory.entries.at("large");
  EXPECT_EQ(large.size, LargeArchive::kSize);
  EXPECT_EQ(large.offset, size_before);
  const DirectoryEntry& last = directory.entries.at("z");
  EXPECT_EQ(last.size, 1u);
  EXPECT_EQ(last.offset, size_before + header.size() + LargeArchive::kSize + 24);
  // The descriptor behind the large entry has eight bytes for each size.
  const std::string_view descriptor = std::string_view(archive.end).substr(5);
  EXPECT_EQ(number_at(descriptor, 0, 4), 0x08074b50u);
  EXPECT_EQ(number_at(descriptor, 4, 4), large.crc);
  EXPECT_EQ(number_at(descriptor, 8, 8), LargeArchive::kSize);
  EXPECT_EQ(number_at(descriptor, 16, 8), LargeArchive::kSize);
}

}  // namespace
}  // namespace kinefile::npz
