// SPDX-License-Identifier: MIT
// Tables and Acclaim motions that are read piece by piece, held against the same files read whole;
// and large texts in memory, which several threads read.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "formats/acclaim/arm.hpp"
#include "support/motion_checks.hpp"
#include "support/threads.hpp"
#include "text/row_pieces.hpp"

namespace kinefile::test {
namespace {

constexpr std::size_t kManyRows = 20'000;  // more than a megabyte

/// Numbers of different lengths, with some text between them.
std::string numbers_between(std::mt19937& random, std::size_t count, std::string_view between) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = (static_cast<double>(random()) - 2e9) * 1e-7;
    if (i > 0) text += between;
    text += fmt::format("{:.{}f}", value, random() % 12);
  }
  return text;
}

std::string table_of(std::string_view between, std::string_view line_end) {
  std::mt19937 random(3);
  std::string text = "time,a.q,b.q,c.q,d.q,e.q" + std::string(line_end);
  for (std::size_t i = 0; i < kManyRows; ++i) {
    text += fmt::format("{:.3f}", static_cast<double>(i) * 0.005) + std::string(between) +
            numbers_between(random, 5, between) + std::string(line_end);
  }
  return text;
}

const std::string& large_table() {
  static const std::string text = table_of(",", "\n");
  return text;
}

std::string amc_of(const std::string& line_end) {
  std::mt19937 random(4);
  std::string text = ":FULLY-SPECIFIED" + line_end + ":DEGREES" + line_end;
  for (std::size_t i = 0; i < kManyRows; ++i) {
    text += fmt::format("{}", i + 1) + line_end + "root " + numbers_between(random, 6, " ") +
            line_end + "b " + numbers_between(random, 3, " ") + line_end;
  }
  return text;
}

const std::string& large_amc() {
  static const std::string text = amc_of("\n");
  return text;
}

std::string large_seq() {
  std::mt19937 random(5);
  std::string text =
      "type: CompositeSeq\ncontent: BodyMotion\nformatVersion: 2\nframeRate: 200\ncomponents:\n";
  for (const char* content : {"JointDisplacement", "JointTorque"}) {
    text += fmt::format(
        "  - \n    type: MultiValueSeq\n    content: {}\n    frameRate: 200\n    numParts: 6\n"
        "    numFrames: {}\n    frames: \n",
        content, kManyRows);
    for (std::size_t i = 0; i < kManyRows; ++i) {
      text += "      - [ " + numbers_between(random, 6, ", ") + " ]\n";
    }
  }
  return text;
}

ReadOptions options_for(const std::string& format) {
  ReadOptions options;
  options.source_name = "t." + format;
  const std::string skeleton = asf_with("axis 0 0 0 XYZ\ndof rx ry rz\n");
  options.companions = beside({{"t.asf", skeleton}});
  return options;
}

/// The numbers of a document, in one list.
std::vector<double> values_of(const Document& document) {
  std::vector<double> values;
  const auto add = [&values](const Array<double>& some) {
    values.insert(values.end(), some.begin(), some.end());
  };
  if (const Motion* motion = std::get_if<Motion>(&document.content)) add(motion->clip.values);
  if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    for (const Component& component : body->components) add(component.values);
  }
  return values;
}

/// Times and other facts of a document, as text.
std::string facts_as_text(const Document& document) {
  std::string text;
  for (const Fact& fact : facts_of(document)) text += fact.key + "=" + fact.value + "\n";
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    text += fmt::format("{} {} {}", motion->clip.num_frames, frame_time(motion->clip.timeline),
                        motion->clip.timeline.first_frame_number);
  }
  if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    for (const Component& component : body->components) {
      text += fmt::format("{} {} {}\n", component.content, component.num_frames,
                          frame_time(component.timeline));
    }
  }
  return text;
}

void expect_equal(const Document& a, const Document& b) {
  EXPECT_EQ(facts_as_text(a), facts_as_text(b));
  const std::vector<double> values = values_of(a);
  EXPECT_FALSE(values.empty());
  EXPECT_TRUE(same_bits(Array<double>(values), Array<double>(values_of(b))));
}

/// Whether many rows are read at once here; a processor without vectors reads such files whole.
bool has_vectors() {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "1,2\n";
  double numbers[200];
  const char* starts[100];
  return text::comma_row_reader(2)
             .read(text.data(), text.data() + text.size(), 100, numbers, starts)
             .num_rows > 0;
}

/// Checks that a file is read by pieces, with the same result as whole on one thread.
void expect_same_in_pieces(const std::string& format, const std::string& text,
                           const ReadOptions& options) {
  Diagnostics whole_diagnostics;
  const Threads one(1);
  const auto whole = find_format(format)->read(text, options, whole_diagnostics);
  ASSERT_TRUE(whole) << text_of(whole_diagnostics);
  for (const std::size_t count : {1u, 7u}) {
    const Threads threads(count);
    Diagnostics diagnostics;
    const auto pieces = find_format(format)->read_pieces(source_of(text), options, diagnostics);
    ASSERT_EQ(pieces.has_value(), has_vectors()) << text_of(diagnostics);
    if (pieces) {
      ASSERT_TRUE(*pieces);
      expect_equal(**pieces, *whole);
      EXPECT_EQ(text_of(diagnostics), text_of(whole_diagnostics));
    }
    Diagnostics ignored_again;
    const auto in_memory = find_format(format)->read(text, options, ignored_again);
    ASSERT_TRUE(in_memory);
    expect_equal(*in_memory, *whole);
  }
}

/// Checks that a file is not read by pieces, and is read whole as by one thread.
void expect_whole(const std::string& format, const std::string& text,
                  const std::string& what = {}) {
  const ReadOptions options = options_for(format);
  Diagnostics one_diagnostics;
  std::optional<Result<Document>> one;
  {
    const Threads threads(1);
    one = find_format(format)->read(text, options, one_diagnostics);
  }
  for (const std::size_t count : {1u, 7u}) {
    const Threads threads(count);
    Diagnostics diagnostics;
    EXPECT_FALSE(find_format(format)->read_pieces(source_of(text), options, diagnostics)) << what;
    Diagnostics whole_diagnostics;
    const auto whole = find_format(format)->read(text, options, whole_diagnostics);
    EXPECT_EQ(text_of(whole_diagnostics), text_of(one_diagnostics));
    ASSERT_EQ(whole.has_value(), one->has_value());
    if (whole && !values_of(*whole).empty()) expect_equal(*whole, **one);
  }
}

std::string with_line_in_the_middle(const std::string& text, const std::string& line) {
  std::string changed = text;
  changed.insert(text.find('\n', text.size() / 2) + 1, line + "\n");
  return changed;
}

TEST(TablePieces, GiveWhatTheWholeFileGives) {
  ASSERT_GT(large_table().size(), std::size_t{1} << 20);
  const ReadOptions options = options_for("csv");
  expect_same_in_pieces("csv", large_table(), options);
  expect_same_in_pieces("csv", table_of(",", "\r\n"), options);
  expect_same_in_pieces("csv", table_of(", ", "\n"), options);
  expect_same_in_pieces("csv", "\xEF\xBB\xBF" + large_table(), options);
  expect_same_in_pieces("csv", large_table() + "\n\n", options);
  std::string no_end = large_table();
  no_end.pop_back();
  expect_same_in_pieces("csv", no_end, options);
  ReadOptions other = options;
  other.fps = 50;
  expect_same_in_pieces("csv", large_table(), other);
}

TEST(TablePieces, RowsMayEndAnywhereInAPiece) {
  for (std::size_t length = 1; length < 200; length += 37) {
    const std::string name(length, 'a');
    expect_same_in_pieces("csv", replaced(large_table(), "a.q", name + ".q"), options_for("csv"));
  }
}

TEST(TablePieces, OddFilesAreReadWhole) {
  for (const char* line : {"1,2,3", "x", "50.001,1,2,3,4,5,6", "50,1,2,3,4,nan", "\"50\",1,2,3,4,5",
                           "50, 1,2,3,4,5", "1,1,1,1,1,1", "1e9,1,1,1,1,1"}) {
    expect_whole("csv", with_line_in_the_middle(large_table(), line), line);
  }
  expect_whole("csv", large_table() + "the end");
  expect_whole("csv", replaced(large_table(), "a.q", "\xFC.q"));
  expect_whole("csv", replaced(large_table(), "a.q", "\"a.q"));
  expect_whole("csv", "time,a.q\n");
  expect_whole("csv", "");
}

TEST(TablePieces, AFaultLeavesTheFile) {
  for (std::size_t number = 0; number < 6; ++number) {
    std::size_t count = 0;
    ByteSource source = source_of(large_table());
    source.read = [&count, number, read = source.read](std::size_t offset, std::span<char> out) {
      return count++ != number && read(offset, out);
    };
    const Threads threads(1);
    Diagnostics diagnostics;
    EXPECT_FALSE(find_format("csv")->read_pieces(source, options_for("csv"), diagnostics));
  }
}

TEST(AcclaimPieces, GiveWhatTheWholeFileGives) {
  ASSERT_GT(large_amc().size(), std::size_t{1} << 20);
  const ReadOptions options = options_for("amc");
  expect_same_in_pieces("amc", large_amc(), options);
  expect_same_in_pieces("amc", amc_of("\r\n"), options);
  expect_same_in_pieces("amc", large_amc() + "\n\n", options);
  std::string no_end = large_amc();
  no_end.pop_back();
  expect_same_in_pieces("amc", no_end, options);
}

TEST(AcclaimPieces, FramesMayEndAnywhereInAPiece) {
  for (std::size_t length = 1; length < 300; length += 61) {
    const std::string comment = "#" + std::string(length, 'x') + "\n";
    expect_same_in_pieces("amc", comment + large_amc(), options_for("amc"));
  }
}

TEST(AcclaimPieces, OddFilesAreReadWhole) {
  for (const char* line : {"# text", "b 1 2 3", "1", "99999", "x", "nan", "root 1 2 3 4 5 6"}) {
    expect_whole("amc", with_line_in_the_middle(large_amc(), line), line);
  }
  expect_whole("amc", large_amc() + "20001\nroot 1 2 3 4 5 6\n");
  expect_whole("amc", large_amc() + "20002\nroot 1 2 3 4 5 6\nb 1 2 3\n");
  expect_whole("amc", large_amc().substr(0, 30), "short");
  expect_whole("amc", replaced(large_amc(), "\n2\n", "\n3\n"), "numbers");
  expect_whole("amc", "");
}

TEST(SeqPieces, ManyRowsAreTheSameForAnyNumberOfThreads) {
  const std::string text = large_seq();
  const ReadOptions options = options_for("seq");
  const std::size_t middle = text.find("\n      - ", text.size() / 4) + 1;
  for (const char* line : {"", "      - [ 1, 2, 3, 4, 5, .nan ]\n", "      - [1,2,3,4,5,6]\n",
                           "      # text\n", "      - [ 1, 2, 3, 4, 5 ]\n", "      - 5\n"}) {
    std::string changed = text;
    changed.insert(middle, line);
    Diagnostics one_diagnostics;
    std::optional<Result<Document>> one;
    {
      const Threads threads(1);
      one = find_format("choreonoid")->read(changed, options, one_diagnostics);
    }
    const Threads threads(7);
    Diagnostics diagnostics;
    const auto many = find_format("choreonoid")->read(changed, options, diagnostics);
    EXPECT_EQ(text_of(diagnostics), text_of(one_diagnostics)) << line;
    ASSERT_EQ(many.has_value(), one->has_value()) << line;
    if (many) expect_equal(*many, **one);
  }
}

TEST(RowPieces, EndAtARowWhereverTheirReaderIsStopped) {
  // A row that goes through several pieces, in which no other begins.
  const std::string long_row = "1 2" + std::string(700'000, ' ') + "3\n";
  std::string rows;
  for (int i = 0; i < 60'000; ++i) rows += "4 5 6\n";
  const std::string text = rows + long_row + rows;
  const text::RowReader reader = text::number_line_reader(3);
  for (const std::size_t count : {1u, 7u}) {
    const Threads threads(count);
    for (std::size_t most = 0; most < 12; ++most) {
      std::size_t num_calls = 0;
      std::size_t num_bytes = 0;
      const auto use = [&](const text::RowPiece& piece) {
        if (num_calls++ == most) return false;
        num_bytes += piece.num_bytes;
        return true;
      };
      const char* const begin = text.data();
      const char* const next = text::read_row_pieces(begin, begin + text.size(), reader, use);
      EXPECT_EQ(static_cast<std::size_t>(next - begin), num_bytes);
    }
  }
}

}  // namespace
}  // namespace kinefile::test
