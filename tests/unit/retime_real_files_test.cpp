// SPDX-License-Identifier: MIT
// How well real motions are found again when every second frame is left out.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "kinefile/io.hpp"
#include "support/motions.hpp"
#include "support/support.hpp"

namespace kinefile {
namespace {

TEST(RetimeRealFiles, CubicFindsFramesThatWereLeftOutBest) {
  SKIP_WITHOUT_DATA();
  const std::string path = test::data_folder() + "/acclaim/cmu/01_01.bvh";
  Diagnostics diagnostics;
  const auto document = read_file(path, find_format("bvh"), {}, diagnostics);
  if (!document) GTEST_SKIP() << path << " is not there";
  const Motion& motion = std::get<Motion>(document->content);
  const auto error_of = [&motion](const char* name, RotationInterpolation rotation) {
    const test::LeaveOutError error = test::leave_out_error(motion, 2, {.rotation = rotation});
    fmt::print("every second frame of 01_01, {}: {:.4f} degrees, {:.4f} units of length\n", name,
               error.degrees, error.distance);
    return error;
  };
  const auto slerp = error_of("slerp", RotationInterpolation::Slerp);
  const auto nlerp = error_of("nlerp", RotationInterpolation::Nlerp);
  const auto euler = error_of("euler", RotationInterpolation::Euler);
  const auto cubic = error_of("cubic", RotationInterpolation::Cubic);
  EXPECT_LT(cubic.degrees, slerp.degrees);
  EXPECT_LT(cubic.distance, slerp.distance);
  EXPECT_LE(slerp.degrees, euler.degrees * 1.01);
  EXPECT_NEAR(nlerp.degrees, slerp.degrees, 0.01 * slerp.degrees);
}

}  // namespace
}  // namespace kinefile
