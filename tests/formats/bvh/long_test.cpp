// SPDX-License-Identifier: MIT
// Motions whose frames are read when they are asked for, held against the same files read whole.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "kinefile/fk.hpp"
#include "kinefile/frame_source.hpp"
#include "kinefile/retime.hpp"
#include "support/motion_checks.hpp"
#include "support/support.hpp"
#include "support/threads.hpp"

namespace kinefile::test {
namespace {

constexpr std::size_t kLongRows = 20'000;  // of nine numbers: several pieces of the file

/// A figure that turns and walks, with angles that pass half a turn.
std::string long_text(const std::string& line_end = "\n") {
  std::mt19937 random(11);
  std::vector<std::string> rows;
  std::array<double, 9> values{};
  for (std::size_t i = 0; i < kLongRows; ++i) {
    std::string row;
    for (double& value : values) {
      value += (static_cast<double>(random() % 2001) - 1000) * 0.017;
      if (std::abs(value) > 180) value -= std::copysign(360, value);
      row += fmt::format("{}{:.{}f}", row.empty() ? "" : " ", value, random() % 9);
    }
    rows.push_back(row);
  }
  std::string text;
  for (const char c : bvh_with_rows(rows)) text += c == '\n' ? line_end : std::string(1, c);
  return text;
}

const std::string& plain_long_text() {
  static const std::string text = long_text();
  return text;
}

std::optional<LongMotion> opened(const std::string& text, ReadOptions options = {},
                                 double most_bytes = 0) {
  options.source_name = "t.bvh";
  return find_format("bvh")->open_frames(source_of(text), most_bytes, options, ignored());
}

Sink adding_to(std::string& text) {
  return [&text](std::string_view piece) {
    text += piece;
    return true;
  };
}

std::string text_of_long(const LongMotion& motion, const char* format,
                         const WriteOptions& options = {}) {
  std::string text;
  EXPECT_TRUE(find_format(format)->write_frames(motion, options, adding_to(text), ignored()));
  return text;
}

TEST(LongMotion, HasTheFramesOfTheWholeFile) {
  for (const std::string line_end : {"\n", "\r\n"}) {
    const std::string text = long_text(line_end);
    const Motion whole = read_bvh(text).motion();
    for (const std::size_t threads : kThreadCounts) {
      const Threads some(threads);
      const auto motion = opened(text);
      ASSERT_TRUE(motion);
      EXPECT_EQ(motion->frames.num_frames, kLongRows);
      EXPECT_EQ(motion->frames.num_coordinates, 9u);
      EXPECT_EQ(std::get<Motion>(motion->document.content).clip.num_frames, 0u);
      std::mt19937 random(3);
      for (int i = 0; i < 40; ++i) {
        const std::size_t first = random() % kLongRows;
        const std::size_t count = random() % (kLongRows - first) + 1;
        const auto rows = motion->frames.rows(first, count);
        ASSERT_TRUE(rows);
        const std::span<const double> values = whole.clip.values;
        EXPECT_TRUE(std::ranges::equal(*rows, values.subspan(first * 9, count * 9)));
      }
    }
  }
}

TEST(LongMotion, TellsWhatTheWholeFileTells) {
  std::string text = plain_long_text();
  const std::string count = fmt::format("Frames: {}", kLongRows);
  text.replace(text.find(count), count.size(), "Frames: 77777");
  ReadOptions options;
  options.source_name = "t.bvh";
  const ReadText whole = read_bvh(text, options);
  Diagnostics found;
  const auto motion = find_format("bvh")->open_frames(source_of(text), 0, options, found);
  ASSERT_TRUE(motion);
  EXPECT_FALSE(whole.diagnostics.items().empty());
  ASSERT_EQ(found.items().size(), whole.diagnostics.items().size());
  for (std::size_t i = 0; i < found.items().size(); ++i) {
    EXPECT_EQ(to_string(found.items()[i]), to_string(whole.diagnostics.items()[i]));
  }
}

TEST(LongMotion, IsLeftToWhoReadsTheFileWhole) {
  EXPECT_FALSE(opened(plain_long_text(), {}, 1e9));  // small enough for memory
  std::string odd = plain_long_text();
  odd.insert(odd.size() - 10, "x");
  EXPECT_FALSE(opened(odd));
  std::string short_row = plain_long_text();
  short_row.insert(short_row.size() / 2, "\n");
  EXPECT_FALSE(opened(short_row));
  EXPECT_FALSE(opened("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 0\n}\n"));
}

TEST(LongMotion, IsWrittenAsTheWholeFile) {
  const Document whole = *read_bvh(plain_long_text()).document;
  for (const std::size_t threads : kThreadCounts) {
    const Threads some(threads);
    const auto motion = opened(plain_long_text());
    ASSERT_TRUE(motion);
    for (const char* format : {"bvh", "csv", "json"}) {
      EXPECT_EQ(text_of_long(*motion, format), write_to_string(whole, format)) << format;
      const WriteOptions rounded{.decimals = 3};
      EXPECT_EQ(text_of_long(*motion, format, rounded), write_to_string(whole, format, rounded))
          << format;
    }
  }
}

TEST(LongMotion, IsResampledAsTheWholeFile) {
  const Motion whole = read_bvh(plain_long_text()).motion();
  using Rotation = retime::RotationInterpolation;
  for (const Rotation rotation :
       {Rotation::Slerp, Rotation::Nlerp, Rotation::Cubic, Rotation::Euler}) {
    for (const bool antialias : {false, true}) {
      for (const double rate : {7.0, 111.0}) {
        const retime::RetimeOptions options{.rotation = rotation, .antialias = antialias};
        const auto map = retime::resample_map(whole.clip, rate);
        ASSERT_TRUE(map);
        const auto applied = [&](std::size_t threads) {
          const Threads some(threads);
          return retime::apply(whole, *map, options, ignored());
        };
        const auto expected = applied(1);
        ASSERT_TRUE(expected);
        EXPECT_TRUE(same_bits(applied(7)->clip.values, expected->clip.values));
        const Threads some(rate < 30 ? 2 : 7);
        auto resampled = retime::resample(*opened(plain_long_text()), rate, options, ignored());
        ASSERT_TRUE(resampled);
        EXPECT_EQ(resampled->frames.num_frames, expected->clip.num_frames);
        EXPECT_TRUE(text_of_long(*resampled, "bvh") == write_to_string({*expected, "bvh", {}}))
            << rate << antialias << static_cast<int>(rotation);
      }
    }
  }
}

TEST(LongMotion, IsResampledInBlocksOfAnySize) {
  const Motion whole = read_bvh(plain_long_text()).motion();
  const retime::RetimeOptions options{.rotation = retime::RotationInterpolation::Cubic,
                                      .antialias = true};
  const auto expected =
      retime::apply(whole, *retime::resample_map(whole.clip, 11), options, ignored());
  const auto resampled = retime::resample(*opened(plain_long_text()), 11, options, ignored());
  const std::size_t num_frames = resampled->frames.num_frames;
  for (std::size_t first = 0, count = 1; first < num_frames; first += count, count += 3) {
    count = std::min(count, num_frames - first);
    const auto rows = resampled->frames.rows(first, count);
    ASSERT_TRUE(rows);
    const std::span<const double> values = expected->clip.values;
    EXPECT_TRUE(std::ranges::equal(*rows, values.subspan(first * 9, count * 9))) << first;
  }
}

TEST(LongMotion, IsPlacedAsTheWholeFile) {
  const Motion whole = read_bvh(plain_long_text()).motion();
  for (const char* format : {"csv", "json", "npz"}) {
    for (const char* frames : {"", "5:19000:7", "19999:20000", "4:4"}) {
      FkOptions options;
      options.frames = frames;
      options.rotations = true;
      options.tips = true;
      std::string expected;
      const auto table = fk(Placed{whole}, options);
      ASSERT_TRUE(table);
      EXPECT_TRUE(write_table(*table, *find_format(format), {}, adding_to(expected)));
      std::string found;
      const auto motion = opened(plain_long_text());
      const auto long_table = fk(*motion, options);
      ASSERT_TRUE(long_table);
      EXPECT_TRUE(write_table(*long_table, *find_format(format), {}, adding_to(found)));
      EXPECT_TRUE(found == expected) << format << " " << frames;
    }
  }
}

TEST(LongMotion, SaysThatItsFileChanged) {
  std::string text = plain_long_text();
  const auto motion = opened(text);
  ASSERT_TRUE(motion);
  text[text.size() / 2] = '\n';
  const auto rows = motion->frames.rows(0, kLongRows);
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().code, "IO001");
  const auto written = find_format("bvh")->write_frames(
      *motion, {}, [](std::string_view) { return true; }, ignored());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, "IO001");
}

}  // namespace
}  // namespace kinefile::test
