// SPDX-License-Identifier: MIT
// Frames that are read many at once, held against the same frames one by one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "formats/acclaim/arm.hpp"
#include "support/motion_checks.hpp"

namespace kinefile::test {
namespace {

const std::string kSkeleton = asf_with("axis 0 0 0 XYZ\ndof rx ry rz\n");
constexpr int kFrames = 400;

/// Frames of the skeleton.
/// \param ends_of_lines  of which each frame takes one in turn; frames that differ in them are read
///                       one by one
std::vector<std::string> frames(const std::vector<std::string>& ends_of_lines) {
  std::mt19937 random(2);
  std::vector<std::string> made;
  for (int i = 0; i < kFrames; ++i) {
    const std::string& end = ends_of_lines[static_cast<std::size_t>(i) % ends_of_lines.size()];
    const auto numbers = [&random](int count) {
      std::string text;
      for (int k = 0; k < count; ++k) {
        const double value = (static_cast<double>(random()) - 2e9) * 1e-8;
        text += fmt::format(" {:.{}f}", value, random() % 18);
      }
      return text;
    };
    std::string frame = fmt::format("{}", i + 1) + end;
    frame += "root" + numbers(6) + end;
    frame += "b" + numbers(3) + end;
    made.push_back(frame);
  }
  return made;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text = ":FULLY-SPECIFIED\n:DEGREES\n";
  for (const std::string& part : parts) text += part;
  return text;
}

TEST(AcclaimLikeFrames, AreTheSameAsOneByOne) {
  const Motion apart = amc_motion(joined(frames({"\n", " \n", "\r\n", "\t\n"})), kSkeleton);
  ASSERT_EQ(apart.clip.num_frames, static_cast<std::size_t>(kFrames));
  for (const std::string end : {"\n", "\r\n", " \n"}) {
    const Motion many = amc_motion(joined(frames({end})), kSkeleton);
    EXPECT_EQ(many.clip.num_frames, apart.clip.num_frames);
    EXPECT_TRUE(same_bits(many.clip.values, apart.clip.values));
  }
}

TEST(AcclaimLikeFrames, WhatIsOddAmongThemIsTold) {
  constexpr std::size_t kOddFrame = 200;
  const auto codes_with = [](const std::string& from, const std::string& to) {
    const auto codes = [&](const std::vector<std::string>& ends) {
      std::vector<std::string> all = frames(ends);
      const std::size_t at = all[kOddFrame].find(from);
      all[kOddFrame].replace(at, from.size(), to);
      const ReadText read = read_acclaim("amc", joined(all), kSkeleton);
      return codes_of(read.diagnostics);
    };
    const std::vector<std::string> many = codes({"\n"});
    EXPECT_EQ(many, codes({"\n", " \n"})) << from << " to " << to;
    return many;
  };
  const std::vector<std::string> usual = codes_with("201", "201");
  for (const std::string silent : {"0201", "# text\n201"}) {
    EXPECT_EQ(codes_with("201", silent), usual) << silent;
  }
  for (const std::string told : {"202", "201.0", "-201", "b 1 2 3\n201"}) {
    EXPECT_NE(codes_with("201", told), usual) << told;
  }
  for (const std::string told : {"root nan", "root 1", "boot"}) {
    EXPECT_NE(codes_with("root", told), usual) << told;
  }
}

TEST(AcclaimLikeFrames, ABoneMayBeMissingAndLinesMayChangePlaces) {
  std::vector<std::string> all = frames({"\n"});
  const std::string usual = joined(all);
  const std::size_t line = all[100].find("b ");
  all[100] = all[100].substr(0, 4) + all[100].substr(line) + all[100].substr(4, line - 4);
  const Motion changed = amc_motion(joined(all), kSkeleton);
  EXPECT_TRUE(same_bits(changed.clip.values, amc_motion(usual, kSkeleton).clip.values));
  all[100] = "101\n" + all[100].substr(all[100].find("root"));
  const ReadText missing = read_acclaim("amc", joined(all), kSkeleton);
  const ReadText whole = read_acclaim("amc", usual, kSkeleton);
  EXPECT_EQ(codes_of(missing.diagnostics).size(), codes_of(whole.diagnostics).size() + 1);
  EXPECT_EQ(missing.motion().clip.num_frames, static_cast<std::size_t>(kFrames));
}

}  // namespace
}  // namespace kinefile::test
