// SPDX-License-Identifier: MIT
// How well real motions are found again when every second frame is left out.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "formats/acclaim/golden.hpp"
#include "kinefile/io.hpp"
#include "support/motions.hpp"
#include "support/support.hpp"

namespace kinefile {
namespace {

/// A motion of the real files.
Motion real_motion(const std::string& name) {
  Diagnostics diagnostics;
  auto document = read_file(test::data_folder() + "/acclaim/cmu/" + name, nullptr, {}, diagnostics);
  EXPECT_TRUE(document) << test::text_of(diagnostics);
  return document ? std::get<Motion>(std::move(document->content)) : Motion{};
}

/// The errors of every way of interpolation where every second frame is left out; printed, too.
void expect_cubic_to_be_best(const std::string& name) {
  const Motion motion = real_motion(name);
  const auto error_of = [&](const char* way, retime::RotationInterpolation rotation) {
    const test::LeaveOutError error = test::leave_out_error(motion, 2, {.rotation = rotation});
    fmt::print("every second frame of {}, {}: {:.4f} degrees, {:.4f} units of length\n", name, way,
               error.degrees, error.distance);
    return error;
  };
  const auto slerp = error_of("slerp", retime::RotationInterpolation::Slerp);
  const auto nlerp = error_of("nlerp", retime::RotationInterpolation::Nlerp);
  const auto euler = error_of("euler", retime::RotationInterpolation::Euler);
  const auto cubic = error_of("cubic", retime::RotationInterpolation::Cubic);
  EXPECT_LT(cubic.degrees, slerp.degrees);
  EXPECT_LT(cubic.distance, slerp.distance);
  EXPECT_LE(slerp.degrees, euler.degrees * 1.01);
  EXPECT_NEAR(nlerp.degrees, slerp.degrees, 0.01 * slerp.degrees);
}

TEST(RetimeRealFiles, CubicFindsFramesThatWereLeftOutBest) {
  SKIP_WITHOUT_DATA();
  expect_cubic_to_be_best("punch_kick.amc");
  expect_cubic_to_be_best("01_01.amc");
}

TEST(RetimeRealFiles, ErrorsOfABoxerAreInLineWithAnotherProgram) {
  SKIP_WITHOUT_DATA();
  // Another program's figures for this clip, over the ends of bones, not their starts: slerp .019
  // cm, SQUAD .007.
  const Motion motion = real_motion("punch_kick.amc");
  const double cm_per_unit = 100 * motion.skeleton.metres_per_unit;
  const auto slerp = test::leave_out_error(motion, 2, {});
  const auto cubic =
      test::leave_out_error(motion, 2, {.rotation = retime::RotationInterpolation::Cubic});
  EXPECT_GT(slerp.distance * cm_per_unit, 0.010);
  EXPECT_LT(slerp.distance * cm_per_unit, 0.019);
  EXPECT_LT(cubic.distance * cm_per_unit, 0.007);
  EXPECT_LT(cubic.degrees, slerp.degrees / 3);
}

TEST(RetimeRealFiles, ABoxerWhoPunchesLaterIsWhereAnotherProgramPutsHim) {
  SKIP_WITHOUT_DATA();
  const Motion motion = real_motion("punch_kick.amc");
  const auto map = retime::warp_map(motion.clip.num_frames, {.keys = {{150, 160}}});
  ASSERT_TRUE(map);
  Diagnostics diagnostics;
  const auto check = [&](retime::RotationInterpolation rotation, const char* table,
                         double tolerance) {
    const auto warped = retime::apply(motion, *map, {.rotation = rotation}, diagnostics);
    ASSERT_TRUE(warped);
    EXPECT_LE(test::distance_from_table(*warped, table), tolerance) << table;
  };
  check(retime::RotationInterpolation::Slerp, "punch_kick_160_slerp.csv", 1e-3);
  check(retime::RotationInterpolation::Cubic, "punch_kick_160_squad.csv", 0.05);
}

}  // namespace
}  // namespace kinefile
