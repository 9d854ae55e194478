// SPDX-License-Identifier: MIT
#include "retime/interpolate_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/turns.hpp"

namespace kinefile::retime {
namespace {

/// Adds a frame to the turns of an angle.
/// \param before  the angle's last finite number; updated
void add_turns(double angle, std::size_t frame, double& before, NumberColumn& column) {
  double jump = 0;
  if (std::isfinite(angle)) {
    if (std::isfinite(before)) jump = turns_towards(angle, before, column.turn);
    before = angle;
  }
  if (jump != 0 && column.turns.empty()) column.turns.assign(frame, 0.0);
  if (jump != 0 || !column.turns.empty()) {
    column.turns.push_back((column.turns.empty() ? 0.0 : column.turns.back()) + jump);
  }
}

/// How far a column's number goes from one old frame to another.
double way_between(const NumberColumn& column, const Clip& clip, std::size_t from, std::size_t to) {
  const double way = clip.row(to)[column.index] - clip.row(from)[column.index];
  return column.turns.empty() ? way : way + (column.turns[to] - column.turns[from]);
}

}  // namespace

std::vector<NumberColumn> number_columns_of(const Clip& old_clip, const InterpolationPlan& plan) {
  std::vector<NumberColumn> columns;
  for (const std::size_t c : plan.number_columns) columns.push_back({c, plan.turns[c]});
  std::vector<double> before(columns.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t f = 0; f < old_clip.num_frames; ++f) {
    const auto row = old_clip.row(f);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (columns[k].turn > 0) add_turns(row[columns[k].index], f, before[k], columns[k]);
    }
  }
  return columns;
}

void interpolate_rows(const Clip& old_clip, const std::vector<Step>& steps, Clip& new_clip) {
  for (const Step& step : steps) {
    const Around frames = around(step, old_clip.num_frames);
    const auto from = old_clip.row(frames.from);
    const auto to = old_clip.row(frames.to);
    const auto row = new_clip.mutate()[step.new_frame];
    if (step.t == 0) {
      std::copy(from.begin(), from.end(), row.begin());
      continue;
    }
    // Equal numbers give themselves, and the result is monotone in t.
    for (std::size_t c = 0; c < row.size(); ++c) row[c] = from[c] + step.t * (to[c] - from[c]);
  }
}

void turn_columns(const Clip& old_clip, const std::vector<Step>& steps,
                  const std::vector<NumberColumn>& columns, Clip& new_clip) {
  for (const NumberColumn& column : columns) {
    if (column.turns.empty()) continue;
    const Rows rows = new_clip.mutate();
    for (const Step& step : steps) {
      if (step.t == 0) continue;
      const Around frames = around(step, old_clip.num_frames);
      const double way = way_between(column, old_clip, frames.from, frames.to);
      rows[step.new_frame][column.index] = old_clip.row(frames.from)[column.index] + step.t * way;
    }
  }
}

void curve_columns(const Clip& old_clip, const std::vector<Step>& steps,
                   const std::vector<NumberColumn>& columns, Clip& new_clip) {
  for (const Step& step : steps) {
    if (step.t == 0) continue;
    const Around frames = around(step, old_clip.num_frames);
    const bool is_first = frames.before == frames.from;
    const bool is_last = frames.after == frames.to;
    const auto from = old_clip.row(frames.from);
    const auto row = new_clip.mutate()[step.new_frame];
    for (const NumberColumn& column : columns) {
      // The rate at a frame is half the difference between the next and the previous frame.
      const double way = way_between(column, old_clip, frames.from, frames.to);
      const double rate_from =
          is_first ? way : 0.5 * way_between(column, old_clip, frames.before, frames.to);
      const double rate_to =
          is_last ? way : 0.5 * way_between(column, old_clip, frames.from, frames.after);
      const double square = 3 * way - 2 * rate_from - rate_to;
      const double cube = rate_from + rate_to - 2 * way;
      row[column.index] =
          from[column.index] + step.t * (rate_from + step.t * (square + step.t * cube));
    }
  }
}

void average_columns(const Clip& old_clip, const std::vector<Step>& steps,
                     const std::vector<NumberColumn>& columns, Clip& new_clip) {
  for (const Step& step : steps) {
    if (!step.is_average()) continue;
    const auto from = old_clip.row(step.old_frame);
    const auto row = new_clip.mutate()[step.new_frame];
    for (const NumberColumn& column : columns) row[column.index] = from[column.index];
    // Differences are averaged, so that constant values keep every bit.
    for (const Tap& tap : taps_of(step, old_clip.num_frames)) {
      for (const NumberColumn& column : columns) {
        const double way = way_between(column, old_clip, step.old_frame, tap.old_frame);
        row[column.index] += tap.weight * way;
      }
    }
  }
}

}  // namespace kinefile::retime
