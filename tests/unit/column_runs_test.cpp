// SPDX-License-Identifier: MIT
#include "formats/column_runs.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace kinefile {
namespace {

TEST(ColumnRuns, AreAsLongAsColumnsFollowEachOther) {
  const std::vector<std::size_t> columns = {2, 3, 4, 0, 1, 1, kNoColumn, kNoColumn, 5};
  const std::vector<ColumnRun> runs = column_runs(columns);
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_EQ(runs[0].count, 3u);
  EXPECT_EQ(runs[1].count, 2u);
  const std::vector<double> row = {0, 10, 20, 30, 40, 50};
  std::vector<double> list(columns.size(), -1);
  take_columns(runs, row.data(), list.data());
  EXPECT_EQ(list, (std::vector<double>{20, 30, 40, 0, 10, 10, 0, 0, 50}));
}

TEST(ColumnRuns, BringAListBackToARow) {
  const std::vector<std::size_t> columns = {2, 3, 0, 1};
  const std::vector<double> list = {20, 30, 0, 10};
  std::vector<double> row(4);
  put_in_columns(column_runs(columns), list.data(), row.data());
  EXPECT_EQ(row, (std::vector<double>{0, 10, 20, 30}));
  EXPECT_TRUE(column_runs({}).empty());
}

}  // namespace
}  // namespace kinefile
