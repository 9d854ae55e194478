// SPDX-License-Identifier: MIT
#include "simd/low_pass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace kinefile::simd {
namespace {

const LowPass kFilter = {0.02, -1.56, 0.64, 20};

/// One pass over a column.
template <class Iterator>
void run_one_way(const LowPass& filter, Iterator begin, Iterator end) {
  double z1 = (1 - filter.b0) * *begin;
  double z2 = (filter.b0 - filter.a2) * *begin;
  for (Iterator number = begin; number != end; ++number) {
    const double in = *number;
    const double out = filter.b0 * in + z1;
    z1 = 2 * filter.b0 * in - filter.a1 * out + z2;
    z2 = filter.b0 * in - filter.a2 * out;
    *number = out;
  }
}

/// The same for one column, all of whose numbers lie one behind the other.
std::vector<double> filtered(const LowPass& filter, const std::vector<double>& column) {
  const std::size_t count = column.size();
  if (count < 2) return column;
  const std::size_t padding = std::min(filter.padding, count - 1);
  const double slope = (column.back() - column[0]) / static_cast<double>(count - 1);
  const auto line = [&](std::size_t i) { return column[0] + slope * static_cast<double>(i); };
  std::vector<double> padded(count + 2 * padding);
  for (std::size_t i = 0; i + 1 < count; ++i) padded[padding + i] = column[i] - line(i);
  for (std::size_t i = 1; i <= padding; ++i) {
    padded[padding - i] = -padded[padding + i];
    padded[padding + count - 1 + i] = -padded[padding + count - 1 - i];
  }
  run_one_way(filter, padded.begin(), padded.end());
  run_one_way(filter, padded.rbegin(), padded.rend());
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i) out[i] = line(i) + padded[padding + i];
  return out;
}

TEST(LowPass, GivesTheBitsOfOneColumnAlone) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const std::size_t count : {0u, 1u, 2u, 3u, 19u, 20u, 21u, 22u, 100u}) {
    for (const std::size_t groups : {1u, 3u, 4u, 5u}) {
      LaneFrames frames(count, groups, kFilter.padding);
      std::vector<std::vector<double>> columns(groups * LaneGroup::kSize);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        double number = 100 * normal(random);
        for (std::size_t f = 0; f < count; ++f) {
          if (c % 5 != 2) number += normal(random);
          columns[c].push_back(number);
          frames.frame(f)[c / LaneGroup::kSize].v[c % LaneGroup::kSize] = number;
        }
      }
      low_pass(kFilter, frames);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const bool is_constant = c % 5 == 2;
        const auto wanted = is_constant ? columns[c] : filtered(kFilter, columns[c]);
        for (std::size_t f = 0; f < count; ++f) {
          ASSERT_EQ(frames.frame(f)[c / LaneGroup::kSize].v[c % LaneGroup::kSize], wanted[f])
              << count << " " << c << " " << f;
        }
      }
    }
  }
}

TEST(LowPass, QuaternionsAreOnTheSideOfTheOneBefore) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (const std::size_t count : {0u, 1u, 2u, 50u}) {
    LaneFrames frames(count, 4);
    for (LaneGroup& group : frames.groups) {
      for (double& number : group.v) number = random() % 5 == 0 ? 0 : normal(random);
    }
    LaneFrames wanted = frames;
    for (std::size_t lane = 0; lane < LaneGroup::kSize; ++lane) {
      for (std::size_t f = 1; f < count; ++f) {
        double side = 0;
        for (std::size_t k = 0; k < 4; ++k) {
          const double product = wanted.frame(f)[k].v[lane] * wanted.frame(f - 1)[k].v[lane];
          side = k == 0 ? product : side + product;
        }
        if (side >= 0) continue;
        for (std::size_t k = 0; k < 4; ++k) wanted.frame(f)[k].v[lane] *= -1;
      }
    }
    take_same_sides(frames);
    for (std::size_t n = 0; n < frames.groups.size(); ++n) {
      for (std::size_t lane = 0; lane < LaneGroup::kSize; ++lane) {
        ASSERT_EQ(frames.groups[n].v[lane], wanted.groups[n].v[lane]);
      }
    }
  }
}

}  // namespace
}  // namespace kinefile::simd
