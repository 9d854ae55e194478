// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/motion.hpp"
#include "support/random_skeletons.hpp"

namespace kinefile::test {

/// What a column means.
enum class Means { Angle, Length, Scale, Free, Ball, Vector, Nothing };

/// How many columns in a row mean one thing.
std::size_t columns_of_meaning(Means means);

/// A quarter of a turn in the skeleton's unit.
double quarter_turn(const Skeleton& skeleton);

/// Fills a clip for a skeleton: smooth curves. Columns that repeat the values of joints which
/// follow others do so. \param meanings  shape (columns)
void fill_random_clip(RandomSource& random, const std::vector<Means>& meanings, bool without_frames,
                      Motion& motion);

}  // namespace kinefile::test
