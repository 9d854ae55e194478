// SPDX-License-Identifier: MIT
// tests/formats/servo_map/invalid holds files for every code that reading a map can give, and
// beside each the exact diagnostics.

#include "kinefile/servo_map.hpp"

#include <gtest/gtest.h>

#include "support/support.hpp"

namespace kinefile::test {
namespace {

struct ReadMap {
  std::optional<ServoMap> map;
  Diagnostics diagnostics;
};

ReadMap read_map(std::string_view text, const std::string& name = "m.yaml") {
  ReadMap read;
  auto map = parse_servo_map(text, name, read.diagnostics);
  if (map) read.map = std::move(*map);
  return read;
}

void expect_same(const ServoMap& found, const ServoMap& expected) {
  EXPECT_EQ(found.num_sliders, expected.num_sliders);
  EXPECT_EQ(found.tick_seconds, expected.tick_seconds);
  EXPECT_EQ(found.base_pose, expected.base_pose);
  ASSERT_EQ(found.entries.size(), expected.entries.size());
  for (std::size_t i = 0; i < found.entries.size(); ++i) {
    const ServoMapEntry &a = found.entries[i], &b = expected.entries[i];
    EXPECT_EQ(a.slider, b.slider);
    EXPECT_EQ(a.joint, b.joint);
    EXPECT_EQ(a.sign, b.sign);
    EXPECT_EQ(a.units_per_degree, b.units_per_degree);
    EXPECT_EQ(a.offset, b.offset);
    EXPECT_EQ(a.minimum, b.minimum);
    EXPECT_EQ(a.maximum, b.maximum);
    EXPECT_EQ(a.step, b.step);
  }
}

TEST(ServoMapFile, EveryKeyIsRead) {
  const ReadMap read = read_map(
      "sliders: 30\n"
      "tick: 20000\n"
      "base_pose: [0, -128, 256]\n"
      "servos:\n"
      "  - {slider: 3, joint: LSY, sign: -1, units_per_degree: 182.0417, offset: 64, min: -16384, "
      "max: 16383, step: 128}\n"
      "  - slider: 0\n"
      "    joint: Hips.Xrotation\n"
      "    units_per_degree: 100\n");
  ASSERT_TRUE(read.map) << text_of(read.diagnostics);
  EXPECT_EQ(text_of(read.diagnostics), "");
  ServoMap expected;
  expected.num_sliders = 30;
  expected.tick_seconds = 0.02;
  expected.base_pose = {0, -128, 256};
  expected.entries = {{3, "LSY", -1, 182.0417, 64, -16384, 16383, 128},
                      {0, "Hips.Xrotation", 1, 100, 0, -32768, 32767, 1}};
  expect_same(*read.map, expected);
}

TEST(ServoMapFile, WhatEditorsWriteForASixtiethOfASecondIsOne) {
  EXPECT_EQ(read_map("tick: 16667\nservos: []\n").map.value().tick_seconds, 1.0 / 60);
  EXPECT_EQ(read_map("servos: []\n").map.value().tick_seconds, 1.0 / 60);
  EXPECT_EQ(read_map("tick: 16666\nservos: []\n").map.value().tick_seconds, 0.016666);
}

TEST(ServoMapFile, WhatIsWrittenReadsTheSame) {
  ServoMap map;
  expect_same(read_map(to_yaml(map)).map.value(), map);
  map.num_sliders = 64;
  map.base_pose = {-32768, 32767};
  map.entries = {{63, "a \"b\" #c: {d}", -1, 364.0833, -0.125, -32767, 32767, 128},
                 {0, "\xe8\x85\x95", 1, 1e-3, 1e6, -1, 0, 1},
                 {1, "yes", 1, 100, 0, -1, 0, 1}};
  for (int tick = 100; tick < 100'000; tick += 333) {
    map.tick_seconds = tick / 1e6;
    const ReadMap read = read_map(to_yaml(map));
    EXPECT_EQ(text_of(read.diagnostics), "");
    expect_same(read.map.value(), map);
  }
}

TEST(ServoMapInvalid, EveryFileHasItsExactDiagnostics) {
  const auto names = fixtures("servo_map/invalid", ".yaml");
  ASSERT_GE(names.size(), 12u);
  for (const std::string& name : names) {
    const std::string expected = fixture(name.substr(0, name.size() - 4) + "txt");
    const ReadMap read = read_map(fixture(name), name.substr(name.find_last_of('/') + 1));
    EXPECT_EQ(text_of(read.diagnostics), expected) << name;
    EXPECT_EQ(read.map.has_value(), !read.diagnostics.has_errors()) << name;
    for (const Diagnostic& item : read.diagnostics.items()) EXPECT_GT(item.place.line, 0u) << name;
  }
}

TEST(ServoMapInvalid, EveryTruncationIsReadOrRefused) {
  ServoMap map;
  map.base_pose = {1, 2, 3};
  map.entries = {{3, "LSY", -1, 182.0417, 64, -16384, 16383, 128}};
  const std::string whole = to_yaml(map);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const ReadMap read = read_map(whole.substr(0, length));
    EXPECT_EQ(read.map.has_value(), !read.diagnostics.has_errors()) << length;
  }
}

}  // namespace
}  // namespace kinefile::test
