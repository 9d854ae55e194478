// SPDX-License-Identifier: MIT
// Motions whose frames are converted when they are asked for, held against the same motions in
// memory.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "kinefile/process.hpp"
#include "support/random_skeletons.hpp"
#include "support/support.hpp"
#include "support/threads.hpp"

namespace kinefile::test {
namespace {

/// A motion in memory as if it were read when it is asked for.
LongMotion as_long(const Document& document) {
  const auto& motion = std::get<Motion>(document.content);
  LongMotion made{document, {motion.clip.num_frames, motion.clip.num_coordinates}};
  Clip& head = std::get<Motion>(made.document.content).clip;
  head.values.clear();
  head.num_frames = 0;
  made.frames.rows = [clip = motion.clip](std::size_t first,
                                          std::size_t count) -> Result<std::span<const double>> {
    const std::span<const double> all = clip.values;
    return all.subspan(first * clip.num_coordinates, count * clip.num_coordinates);
  };
  return made;
}

std::vector<std::string> words_of(const Diagnostics& diagnostics) {
  std::vector<std::string> words;
  for (const Diagnostic& item : diagnostics.items()) words.push_back(to_string(item));
  return words;
}

/// Reads frames in blocks of several sizes, and once more from a frame in the middle.
void expect_frames(const FrameSource& frames, const Clip& expected, const std::string& what) {
  ASSERT_EQ(frames.num_frames, expected.num_frames) << what;
  ASSERT_EQ(frames.num_coordinates, expected.num_coordinates) << what;
  const std::span<const double> all = expected.values;
  const auto expect_rows = [&](std::size_t first, std::size_t count) {
    const auto rows = frames.rows(first, count);
    ASSERT_TRUE(rows) << what;
    EXPECT_TRUE(same_bits(
        *rows, all.subspan(first * expected.num_coordinates, count * expected.num_coordinates)))
        << what << " from frame " << first;
  };
  for (std::size_t first = 0, count = 1; first < expected.num_frames; first += count, count += 5) {
    count = std::min(count, expected.num_frames - first);
    expect_rows(first, count);
  }
  const std::size_t middle = expected.num_frames / 2;
  expect_rows(middle, std::min<std::size_t>(3, expected.num_frames - middle));
  expect_rows(0, expected.num_frames);
}

/// Converts a motion in memory and in blocks, which give the same frames, skeleton, messages and
/// files.
void expect_same(const Document& document, const char* name, const AdaptOptions& adapting,
                 const std::string& what) {
  const Format& format = *find_format(name);
  Diagnostics told;
  WriteOptions writing;
  const auto whole = adapt(document, format, adapting, writing, told);
  Diagnostics told_in_blocks;
  const auto in_blocks = adapt_in_blocks(as_long(document), format, adapting, told_in_blocks);
  ASSERT_TRUE(in_blocks) << what;
  EXPECT_EQ(words_of(told_in_blocks), words_of(told)) << what;
  ASSERT_EQ(in_blocks->has_value(), whole.has_value()) << what;
  if (!whole) {
    EXPECT_EQ(to_string(in_blocks->error()), to_string(whole.error())) << what;
    return;
  }
  const LongMotion& motion = **in_blocks;
  EXPECT_TRUE(same_skeleton(skeleton_of(motion.document), skeleton_of(*whole))) << what;
  expect_frames(motion.frames, std::get<Motion>(whole->content).clip, what);
  const auto text_of = [](const auto& write) {
    std::string text;
    const auto written = write([&text](std::string_view piece) {
      text += piece;
      return true;
    });
    return written ? text : to_string(written.error());
  };
  EXPECT_TRUE(
      text_of([&](const Sink& sink) { return format.write_frames(motion, {}, sink, ignored()); }) ==
      text_of([&](const Sink& sink) { return format.write(*whole, {}, sink, ignored()); }))
      << what;
}

enum class HandPositions { Constant, Noisy, Moving };

/// A figure that turns and walks, with angles that pass half a turn, and a hand with positions.
/// \param order  of all rotations, such as "ZXY"
std::string figure_text(const std::string& order, HandPositions hand, std::size_t num_frames) {
  const std::string rotations =
      fmt::format("{}rotation {}rotation {}rotation", order[0], order[1], order[2]);
  const std::string positions = "Xposition Yposition Zposition";
  std::string text = fmt::format(
      "HIERARCHY\nROOT hips\n{{\nOFFSET 0 0 0\nCHANNELS 6 {1} {0}\n"
      "JOINT left arm\n{{\nOFFSET 0 10 0\nCHANNELS 3 {0}\n"
      "JOINT hand\n{{\nOFFSET 1 5 0\nCHANNELS 6 {1} {0}\n"
      "End Site\n{{\nOFFSET 0 2 0\n}}\n}}\n}}\n}}\nMOTION\nFrames: {2}\nFrame Time: 0.01\n",
      rotations, positions, num_frames);
  std::mt19937 random(7);
  std::array<double, 15> values{};
  for (std::size_t f = 0; f < num_frames; ++f) {
    for (double& value : values) {
      value += (static_cast<double>(random() % 2001) - 1000) * 0.017;
      if (std::abs(value) > 180) value -= std::copysign(360, value);
    }
    const double moved = hand == HandPositions::Moving  ? static_cast<double>(f)
                         : hand == HandPositions::Noisy ? static_cast<double>(random() % 5) * 1e-4
                                                        : 0;
    const std::array<double, 3> place = {1, 5 + moved, 0};
    std::copy(place.begin(), place.end(), values.begin() + 9);
    text += fmt::format("{}\n", fmt::join(values, " "));
  }
  return text;
}

std::vector<AdaptOptions> ways_to_adapt() {
  std::vector<AdaptOptions> ways(7);
  ways[1].channels.order = shape::RotationOrder{0, 1, 2};
  ways[2].channels.positions = shape::PositionChannels::Root;
  ways[3].channels.positions = shape::PositionChannels::Root;
  ways[3].channels.lenient = true;
  ways[4].channels.positions = shape::PositionChannels::All;
  ways[5].kinds.up = 2;
  ways[6].kinds.up = 1;
  ways[6].channels.order = shape::RotationOrder{2, 0, 2};
  return ways;
}

TEST(LongAdapt, MakesTheBonesOfTheWholeMotionInEveryOrder) {
  const std::vector<AdaptOptions> ways = ways_to_adapt();
  std::size_t num_made = 0;
  for (const char* order :
       {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX", "XYX", "XZX", "YXY", "YZY", "ZXZ", "ZYZ"}) {
    for (const auto hand : {HandPositions::Constant, HandPositions::Noisy, HandPositions::Moving}) {
      const Document document = *read_bvh(figure_text(order, hand, 150)).document;
      for (std::size_t way = 0; way < ways.size(); ++way) {
        const std::string what = fmt::format("{} {} {}", order, static_cast<int>(hand), way);
        const Threads some(kThreadCounts[num_made++ % std::size(kThreadCounts)]);
        for (const char* format : {"amc", "asf", "bvh", "csv"}) {
          expect_same(document, format, ways[way], fmt::format("{} {}", format, what));
        }
      }
    }
  }
}

/// A figure whose hand is at another height in the last frame of several blocks.
Document figure_of_blocks(double last_height) {
  Document document = *read_bvh(figure_text("ZXY", HandPositions::Constant, 100)).document;
  Clip& clip = std::get<Motion>(document.content).clip;
  const Array<double> some = clip.values;
  const std::size_t num_frames = frames_per_read({0, clip.num_coordinates, {}}) + 1000;
  while (clip.num_frames < num_frames) {
    clip.values.append(some);
    clip.num_frames += 100;
  }
  clip.mutate()[clip.num_frames - 1][10] = last_height;
  return document;
}

TEST(LongAdapt, DecidesByAllBlocks) {
  const Format& amc = *find_format("amc");
  for (const double last_height : {5.001, 6.0}) {
    const Document document = figure_of_blocks(last_height);
    AdaptOptions adapting;
    if (last_height < 6) adapting.channels.positions = shape::PositionChannels::Root;
    WriteOptions writing;
    Diagnostics told;
    Diagnostics told_in_blocks;
    const auto whole = adapt(document, amc, adapting, writing, told);
    const auto in_blocks = adapt_in_blocks(as_long(document), amc, adapting, told_in_blocks);
    ASSERT_TRUE(whole && in_blocks && *in_blocks);
    EXPECT_EQ(count_code(told, last_height < 6 ? "EDT013" : "BRG005"), last_height < 6 ? 1u : 2u);
    EXPECT_EQ(words_of(told_in_blocks), words_of(told));
    const LongMotion& motion = **in_blocks;
    EXPECT_TRUE(same_skeleton(skeleton_of(motion.document), skeleton_of(*whole)));
    const std::span<const double> all = std::get<Motion>(whole->content).clip.values;
    const std::size_t width = motion.frames.num_coordinates;
    EXPECT_TRUE(for_each_block(motion.frames, [&](const FrameBlock& block) {
      return same_bits(block.rows,
                       all.subspan(block.first_frame * width, block.num_frames * width));
    }));
  }
}

TEST(LongAdapt, ChangesRandomSkeletonsAsInMemory) {
  RandomSource random(31);
  for (int i = 0; i < 400; ++i) {
    const Motion motion = random_motion(random, {.free_joints = i % 9 == 0});
    const auto compare = [&](const auto& change) {
      Diagnostics told;
      Diagnostics told_in_blocks;
      const auto whole = change(motion, told);
      const auto in_blocks = change(as_long({motion, "", {}}), told_in_blocks);
      const std::string what = fmt::format("skeleton {}", i);
      EXPECT_EQ(words_of(told_in_blocks), words_of(told)) << what;
      ASSERT_EQ(in_blocks.has_value(), whole.has_value()) << what;
      if (!whole) return;
      EXPECT_TRUE(same_skeleton(skeleton_of(in_blocks->document), whole->skeleton)) << what;
      expect_frames(in_blocks->frames, whole->clip, what);
    };
    compare([](const auto& any, Diagnostics& told) { return shape::with_bones(any, true, told); });
    compare([](const auto& any, Diagnostics& told) {
      return shape::with_channels(any, {.positions = shape::PositionChannels::Root}, told);
    });
  }
}

TEST(LongAdapt, IsLeftToWhoReadsTheFileWhole) {
  const LongMotion motion =
      as_long(*read_bvh(figure_text("ZXY", HandPositions::Constant, 100)).document);
  const auto is_left = [&](const char* format, const AdaptOptions& adapting) {
    Diagnostics told;
    const bool is_empty = !adapt_in_blocks(motion, *find_format(format), adapting, told);
    EXPECT_TRUE(!is_empty || told.items().empty());
    return is_empty;
  };
  EXPECT_FALSE(is_left("amc", {}));
  EXPECT_TRUE(is_left("choreonoid", {}));
  AdaptOptions links;
  links.kinds.form = robot::BodyForm::Links;
  EXPECT_TRUE(is_left("csv", links));
  AdaptOptions named;
  named.skeleton_name = "a.asf";
  EXPECT_TRUE(is_left("amc", named));
}

TEST(LongAdapt, AsksTheFramesWhichAxisPointsUp) {
  // It stands along y at rest, and along z in every frame.
  std::string text = figure_text("ZXY", HandPositions::Constant, 1);
  text = text.substr(0, text.find("MOTION")) + "MOTION\nFrames: 3\nFrame Time: 0.01\n";
  for (const int x : {1, 100, 7}) text += fmt::format("{} 0 0 0 90 0 0 0 0 1 5 0 0 0 0\n", x);
  const Document document = *read_bvh(text).document;
  AdaptOptions adapting;
  adapting.kinds.up = 1;
  for (const char* format : {"bvh", "amc", "csv"}) {
    Diagnostics told;
    ASSERT_TRUE(adapt_in_blocks(as_long(document), *find_format(format), adapting, told));
    EXPECT_EQ(count_code(told, "CNV004"), 1u);
    expect_same(document, format, adapting, format);
  }
}

TEST(LongAdapt, RefusesANumberThatBecomesTooLarge) {
  std::string text = figure_text("ZXY", HandPositions::Constant, 1);
  text = text.substr(0, text.find("MOTION")) + "MOTION\nFrames: 2\nFrame Time: 0.01\n";
  text.replace(text.find("OFFSET 1 5 0"), 12, "OFFSET 1 1.7e308 0");
  for (const char* y : {"1.7e308", "-1.7e308"}) {
    text += fmt::format("0 0 0 0 0 0 0 0 0 1 {} 0 0 0 0\n", y);
  }
  const Document document = *read_bvh(text).document;
  Diagnostics told;
  WriteOptions writing;
  const Format& amc = *find_format("amc");
  const auto whole = adapt(document, amc, {}, writing, told);
  ASSERT_FALSE(whole);
  EXPECT_EQ(whole.error().code, "CNV011");
  const auto in_blocks = adapt_in_blocks(as_long(document), amc, {}, ignored());
  ASSERT_TRUE(in_blocks && *in_blocks);
  const auto written = amc.write_frames(
      **in_blocks, {}, [](std::string_view) { return true; }, ignored());
  ASSERT_FALSE(written);
  EXPECT_EQ(to_string(written.error()), to_string(whole.error()));
}

}  // namespace
}  // namespace kinefile::test
