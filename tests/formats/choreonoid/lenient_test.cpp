// SPDX-License-Identifier: MIT
// What --lenient repairs, and what it does not.

#include "support/seq.hpp"

namespace kinefile::test {
namespace {

using Values = std::vector<double>;

ReadText read_lenient(const std::string& text) { return read_seq(text, {.lenient = true}); }

ReadText read_invalid(const std::string& name) {
  return read_lenient(fixture("choreonoid/invalid/" + name));
}

TEST(SeqLenient, AVersionAbove4IsReadAs4) {
  const ReadText read = read_invalid("SEQ003_too_new.seq");
  EXPECT_EQ(text_of(read.diagnostics),
            "t.seq:3:16: warning[SEQ003]: expected a format version below 5, found '5'; it is read "
            "as 4\n  formatVersion: 5\n                 ^\n");
  ASSERT_TRUE(read.document);
  const std::string text = write_to_string(*read.document, "choreonoid");
  EXPECT_EQ(text_of(read_seq(text).diagnostics), "") << text;
}

TEST(SeqLenient, AnOrderOfNumbersInOtherLettersIsTakenForWhatItMeans) {
  const ReadText read = read_invalid("SEQ013_small_letters.seq");
  EXPECT_EQ(text_of(read.diagnostics),
            "t.seq:10:16: warning[SEQ013]: expected XYZQWQXQYQZ, found 'xyzqwqxqyqz'; it is taken "
            "for the former\n      SE3Format: xyzqwqxqyqz\n                 ^\n");
  EXPECT_EQ(components_of(read).at(0).values, (Values{1, 2, 3, 1, 0, 0, 0}));
}

TEST(SeqLenient, OnePoseAloneIsAListOfOne) {
  const ReadText read = read_invalid("SEQ015_one_pose_alone.seq");
  EXPECT_EQ(text_of(read.diagnostics),
            "t.seq:12:9: warning[SEQ015]: expected a list of poses, found one pose alone; it is "
            "read as a list of one\n        - [ 1, 2, 3, 1, 0, 0, 0 ]\n          ^\n");
  EXPECT_EQ(components_of(read).at(0).values, (Values{1, 2, 3, 1, 0, 0, 0}));
}

TEST(SeqLenient, OnePoseAloneBehindItsTimeIsOneToo) {
  const ReadText read = read_lenient(
      seq_of({poses({"[ 0, 1, 2, 3, 1, 0, 0, 0 ]", "[ 0.1, [ 4, 5, 6, nan, 0, 0, 1 ] ]"},
                    "    hasFrameTime: true\n")}));
  EXPECT_EQ(codes_of(read.diagnostics), (std::vector<std::string>{"SEQ015", "SEQ017"}));
  const Component& component = components_of(read).at(0);
  EXPECT_EQ(component.num_frames, 2u);
  EXPECT_EQ(component.row(0)[0], 1);
  EXPECT_EQ(component.row(1)[0], 4);
}

TEST(SeqLenient, AWordThatStartsWithANumberIsReadAsChoreonoidDoes) {
  const ReadText read =
      read_lenient(seq_of({joints({"[ 1.0abc, 1_000 ]", "[ 1:30, 1d3 ]", "[ 2.5e, -3x ]"})}));
  EXPECT_EQ(components_of(read).at(0).values, (Values{1, 1, 1, 1, 2.5, -3}));
  EXPECT_EQ(read.diagnostics.count_of("SEQ016", Severity::Warning), 6u);
  EXPECT_EQ(text_of(read_invalid("SEQ016_a_number_and_more.seq").diagnostics),
            "t.seq:11:14: warning[SEQ016]: expected a number, found '1.5x'; it is read as 1.5, as "
            "Choreonoid does\n        - [ 0, 1.5x ]\n               ^\n");
}

TEST(SeqLenient, WhatIsNoNumberAtAllStaysAnError) {
  for (const char* word : {"up", "~", "''", "true", "e5", "{ a: 1 }"}) {
    const ReadText read = read_lenient(seq_of({joints({"[ 0, " + std::string(word) + " ]"})}));
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"SEQ016"}) << word;
    EXPECT_FALSE(read.document) << word;
  }
}

TEST(SeqLenient, AFrameOfAnotherShapeStaysAnError) {
  for (const char* name : {"SEQ015_too_few.seq", "SEQ015_too_many.seq", "SEQ015_time_missing.seq",
                           "SEQ015_time_outside.seq", "SEQ015_no_list.seq"}) {
    EXPECT_FALSE(read_invalid(name).document) << name;
  }
}

TEST(SeqLenient, TimesThatGoBackAreReadAsChoreonoidDoes) {
  const ReadText read = read_invalid("SEQ019_back.seq");
  EXPECT_EQ(codes_of(read.diagnostics), (std::vector<std::string>{"SEQ019", "SEQ019", "SEQ021"}));
  EXPECT_EQ(components_of(read).at(0).values, (Values{1, 1, 4, 4, 2, 2}));
}

TEST(SeqLenient, HexadecimalAndQuotedNumbersNeedNoRepair) {
  const ReadText read = read_seq(seq_of({joints({"[ 0x10, -0X1f ]", "[ '7', \"0.5\" ]"})}));
  EXPECT_EQ(text_of(read.diagnostics), "");
  EXPECT_EQ(components_of(read).at(0).values, (Values{16, -31, 7, 0.5}));
}

}  // namespace
}  // namespace kinefile::test
