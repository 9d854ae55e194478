// SPDX-License-Identifier: MIT
// Files that are read piece by piece, held against the same files read whole.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>

#include "kinefile/bvh.hpp"
#include "support/motion_checks.hpp"
#include "support/support.hpp"
#include "support/threads.hpp"

namespace kinefile::test {
namespace {

/// Rows of nine numbers of different lengths.
std::vector<std::string> many_rows(std::size_t count) {
  std::mt19937 random(7);
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < count; ++i) {
    std::string row;
    for (int k = 0; k < 9; ++k) {
      const double value = (static_cast<double>(random()) - 2e9) * 1e-7;
      row += fmt::format(" {:.{}f}", value, random() % 12);
    }
    rows.push_back(row);
  }
  return rows;
}

std::string joined_lines(std::string text, const std::string& line_end) {
  std::string out;
  for (const char c : text) out += c == '\n' ? line_end : std::string(1, c);
  return out;
}

constexpr std::size_t kRows = 12'000;  // more than a megabyte

const std::string& large() {
  static const std::string text = bvh_with_rows(many_rows(kRows));
  return text;
}

/// Checks that a file is read by pieces, with the same result as whole.
void expect_same(const std::string& text, ReadOptions options = {}) {
  options.source_name = "t.bvh";
  const ReadText whole = read_bvh(text, options);
  for (const std::size_t count : {1u, 7u}) {
    const Threads threads(count);
    Diagnostics diagnostics;
    auto pieces = find_format("bvh")->read_pieces(source_of(text), options, diagnostics);
    ASSERT_TRUE(pieces);
    ASSERT_TRUE(*pieces);
    const Motion& a = std::get<Motion>((*pieces)->content);
    const Motion& b = whole.motion();
    EXPECT_EQ(a.clip.num_frames, b.clip.num_frames);
    EXPECT_TRUE(same_bits(a.clip.values, b.clip.values));
    EXPECT_EQ(frame_time(a.clip.timeline), frame_time(b.clip.timeline));
    EXPECT_EQ(a.skeleton.joints.size(), b.skeleton.joints.size());
    EXPECT_EQ(facts_of(**pieces).size(), facts_of(*whole.document).size());
    ASSERT_EQ(diagnostics.items().size(), whole.diagnostics.items().size());
    for (std::size_t i = 0; i < diagnostics.items().size(); ++i) {
      EXPECT_EQ(to_string(diagnostics.items()[i]), to_string(whole.diagnostics.items()[i]));
    }
  }
}

/// Checks that a file is left to who reads it whole, and that nothing is said of it.
void expect_left(const std::string& text, const ReadOptions& options = {}) {
  for (const std::size_t count : {1u, 7u}) {
    const Threads threads(count);
    Diagnostics diagnostics;
    EXPECT_FALSE(find_format("bvh")->read_pieces(source_of(text), options, diagnostics));
  }
}

TEST(BvhPieces, GiveWhatTheWholeFileGives) {
  ASSERT_GT(large().size(), std::size_t{1} << 20);
  expect_same(large());
  expect_same(joined_lines(large(), "\r\n"));
  expect_same(joined_lines(large(), "\n\n"));
  expect_same(large() + "\n \n\t\n");
  std::string no_end = large();
  no_end.pop_back();
  expect_same(no_end);
  expect_same("\xEF\xBB\xBF" + large());
}

TEST(BvhPieces, LinesMayEndAnywhereInAPiece) {
  // Blanks before the first row shift all rows.
  const std::size_t begin = large().find('\n', large().find("Frame Time")) + 1;
  for (std::size_t shift = 1; shift < 200; shift += 37) {
    std::string text = large();
    text.insert(begin, shift, ' ');
    expect_same(text);
  }
}

TEST(BvhPieces, LongLinesGoThroughManyPieces) {
  std::string text = large();
  const std::size_t line = text.find('\n', text.size() / 2) + 1;
  text.insert(text.find(' ', line + 1), 600'000, ' ');
  expect_same(text);
}

TEST(BvhPieces, AnotherCountOfFramesIsTold) {
  const std::string count = fmt::format("Frames: {}", kRows);
  expect_same(replaced(large(), count, "Frames: 12"));
  expect_same(replaced(large(), count, fmt::format("Frames: {}", kRows + 1)));
  expect_same(replaced(large(), count + "\n", ""));
}

TEST(BvhPieces, ALongHierarchyIsReadOn) {
  std::string blanks(300'000, ' ');
  std::replace(blanks.begin() + 1000, blanks.begin() + 2000, ' ', '\n');
  expect_same(blanks + large());
}

TEST(BvhPieces, OptionsCount) {
  expect_same(large(), ReadOptions{.fps = 50});
  expect_same(large(), ReadOptions{.up = 2});
}

TEST(BvhPieces, OddFilesAreLeft) {
  const std::size_t middle = large().find('\n', large().size() / 2);
  const auto with = [middle](const std::string& line) {
    std::string text = large();
    text.insert(middle, "\n" + line);
    return text;
  };
  expect_left(with("1 2 3"));
  expect_left(with("1 2 3 4 5 6 7 8 9 10"));
  expect_left(with("1 2 3 4 5 6 7 8 nan"));
  expect_left(with("1 2 3 4 5 6 7 8 x"));
  expect_left(with("# a comment"));
  expect_left(with("1 2 3 4 5 6 7 8 1e400"));
  expect_left(large() + "\x1A");
  expect_left(large() + "the end");
  expect_left(joined_lines(large(), "\r"));
  expect_left(replaced(large(), "Hips",
                       "H\xFC"
                       "fte"));
  expect_left(replaced(large(), "ROOT", "RUT"));
  expect_left(replaced(large(), fmt::format("Frames: {}", kRows), "Frames: 99999999999"));
  expect_left(std::string(2'000'000, 'x'));
  expect_left(std::string(2'000'000, '\n'));
  expect_left("");
}

TEST(BvhPieces, AFaultLeavesTheFile) {
  for (std::size_t number = 0; number < 6; ++number) {
    std::size_t count = 0;
    ByteSource source = source_of(large());
    source.read = [&count, number, read = source.read](std::size_t offset, std::span<char> out) {
      return count++ != number && read(offset, out);
    };
    const Threads threads(1);
    Diagnostics diagnostics;
    EXPECT_FALSE(find_format("bvh")->read_pieces(source, {}, diagnostics)) << number;
  }
}

}  // namespace
}  // namespace kinefile::test
