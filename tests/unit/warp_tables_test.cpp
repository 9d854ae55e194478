// SPDX-License-Identifier: MIT
// Maps held against tables of old frames that another program made from the same formulas, and
// feet on the ground in a real walk.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "kinefile/retime.hpp"
#include "support/support.hpp"

namespace kinefile {
namespace {

void expect_table(const std::string& name, const retime::WarpOptions& options) {
  const auto map = retime::warp_map(450, options);
  ASSERT_TRUE(map) << to_string(map.error());
  std::istringstream table(test::bytes_of(test::data_folder() + "/acclaim/golden/" + name));
  std::size_t num_rows = 0;
  std::size_t new_frame = 0;
  double old_frame = 0;
  char comma = 0;
  while (table >> new_frame >> comma >> old_frame) {
    ASSERT_LT(new_frame, map->old_frames.size()) << name;
    // The tables have twelve digits, of up to three before the point.
    EXPECT_NEAR(map->old_frames[new_frame], old_frame, 0.5001e-9) << name << " " << new_frame;
    EXPECT_EQ(new_frame, num_rows++);
  }
  EXPECT_EQ(num_rows, map->old_frames.size()) << name;
}

TEST(WarpTables, AreMet) {
  SKIP_WITHOUT_DATA();
  retime::WarpOptions options;
  options.keys = {{150, 160}};
  expect_table("table_150to160_keep450.csv", options);
  options.curve = retime::WarpCurve::Pchip;
  expect_table("table_150to160_keep450_pchip.csv", options);
  options.curve = retime::WarpCurve::Steffen;
  expect_table("table_150to160_keep450_steffen.csv", options);
  options.curve = retime::WarpCurve::Hermite;
  expect_table("table_150to160_keep450_hermite1.csv", options);
  options.curve = retime::WarpCurve::Linear;
  options.tail = retime::Tail::Extend;
  expect_table("table_150to160_extend460.csv", options);
  options.tail = retime::Tail::Keep;
  options.keys = {{150, 140}};
  expect_table("table_150to140_keep450.csv", options);
}

TEST(ContactWeights, ARealWalkTouchesTheGround) {
  SKIP_WITHOUT_DATA();
  const auto read =
      test::read_bvh(test::bytes_of(test::data_folder() + "/acclaim/cgspeed_bvh/05_01.bvh"));
  Diagnostics diagnostics;
  const auto weights = retime::contact_weights(read.motion(), diagnostics);
  ASSERT_TRUE(weights) << to_string(weights.error());
  const auto num_contacts = std::count(weights->begin(), weights->end(), 1.0);
  EXPECT_NEAR(static_cast<double>(num_contacts) / static_cast<double>(weights->size()), 0.41, 0.02);
}

}  // namespace
}  // namespace kinefile
