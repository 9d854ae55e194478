// SPDX-License-Identifier: MIT
#include "retime/dtw.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace kinefile::retime {
namespace {

constexpr double kNoWay = std::numeric_limits<double>::infinity();

/// How a pair was reached: by a step in both sequences, or by the nth consecutive straight step.
/// States are numbered 0 (both), 1 ... m (next column), m + 1 ... 2m (next row).
using State = std::uint16_t;

struct Cheapest {
  double cost = kNoWay;
  State state = 0;
};

/// The maximum number of consecutive straight steps.
std::size_t longest_run(std::size_t num_rows, std::size_t num_columns) {
  constexpr std::size_t kLongestRun = 3;
  const std::size_t more = std::max(num_rows, num_columns) - 1;
  const std::size_t fewer = std::min(num_rows, num_columns) - 1;
  if (more <= kLongestRun * fewer) return kLongestRun;
  return fewer == 0 ? more : 2 * (more / fewer + 1);
}

/// The costs of all states of the pairs of one row, and the previous state of the first step of
/// each kind.
class Table {
 public:
  Table(std::size_t num_rows, std::size_t num_columns)
      : run_(longest_run(num_rows, num_columns)),
        num_states_(2 * run_ + 1),
        num_columns_(num_columns),
        row_(num_columns * num_states_, kNoWay),
        above_(row_),
        origins_(num_rows * num_columns * 3) {}

  void set_start(double cost) { row_[0] = cost; }
  void next_row() {
    above_.swap(row_);
    std::fill(row_.begin(), row_.end(), kNoWay);
  }
  void fill(std::size_t row, std::size_t column, double cost);
  std::vector<FramePair> way_to(FramePair pair) const;

 private:
  double* states(std::vector<double>& row, std::size_t column) const {
    return row.data() + column * num_states_;
  }
  /// The cheapest of all states except the `count` states from `first` on.
  Cheapest cheapest(const double* states, std::size_t first, std::size_t count) const;
  /// Steps from a pair along a row or a column, whose states start at `first`.
  void step_straight(const double* from, double* to, std::size_t first, double cost,
                     State& origin) const;

  std::size_t run_;
  std::size_t num_states_;
  std::size_t num_columns_;
  std::vector<double> row_;
  std::vector<double> above_;
  std::vector<State> origins_;  ///< [row][column][both, next column, next row]
};

Cheapest Table::cheapest(const double* states, std::size_t first, std::size_t count) const {
  Cheapest best;
  for (std::size_t s = 0; s < num_states_; ++s) {
    if (s >= first && s < first + count) continue;
    if (states[s] < best.cost) best = {states[s], static_cast<State>(s)};
  }
  return best;
}

void Table::step_straight(const double* from, double* to, std::size_t first, double cost,
                          State& origin) const {
  const Cheapest best = cheapest(from, first, run_);
  to[first] = best.cost + cost;
  origin = best.state;
  for (std::size_t s = first + 1; s < first + run_; ++s) to[s] = from[s - 1] + cost;
}

void Table::fill(std::size_t row, std::size_t column, double cost) {
  double* to = states(row_, column);
  State* origins = &origins_[(row * num_columns_ + column) * 3];
  if (row > 0 && column > 0) {
    const Cheapest best = cheapest(states(above_, column - 1), 0, 0);
    to[0] = best.cost + cost;
    origins[0] = best.state;
  }
  if (column > 0) step_straight(states(row_, column - 1), to, 1, cost, origins[1]);
  if (row > 0) step_straight(states(above_, column), to, 1 + run_, cost, origins[2]);
}

std::vector<FramePair> Table::way_to(FramePair pair) const {
  std::vector<FramePair> way = {pair};
  std::size_t state = cheapest(row_.data() + pair.column * num_states_, 0, 0).state;
  while (pair.row > 0 || pair.column > 0) {
    const State* origins = &origins_[(pair.row * num_columns_ + pair.column) * 3];
    const bool is_both = state == 0;
    const bool is_column = !is_both && state <= run_;
    if (is_both || is_column) --pair.column;
    if (is_both || !is_column) --pair.row;
    if (is_both) {
      state = origins[0];
    } else if (state == 1 || state == 1 + run_) {
      state = origins[is_column ? 1 : 2];
    } else {
      --state;
    }
    way.push_back(pair);
  }
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace

std::vector<FramePair> align_sequences(
    std::size_t num_rows, std::size_t num_columns,
    const std::function<double(std::size_t, std::size_t)>& cost) {
  constexpr double kVeryHigh = 1e100;
  Table table(num_rows, num_columns);
  for (std::size_t row = 0; row < num_rows; ++row) {
    if (row > 0) table.next_row();
    for (std::size_t column = 0; column < num_columns; ++column) {
      const double own = cost(row, column);
      const double bounded = own < kVeryHigh ? own : kVeryHigh;
      if (row == 0 && column == 0) {
        table.set_start(bounded);
      } else {
        table.fill(row, column, bounded);
      }
    }
  }
  return table.way_to({num_rows - 1, num_columns - 1});
}

}  // namespace kinefile::retime
