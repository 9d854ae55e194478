// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/retime.hpp"

// What the benchmarks are measured against: the plainest code that does the same job.

namespace kinefile::bench {

/// The text behind the line "Frame Time: ...": numbers and blanks alone.
std::string_view numbers_of_bvh(std::string_view text);

/// Skips blanks, reads a number with fast_float, adds it up; nothing is stored.
double sum_with_fast_float(std::string_view numbers);

/// As `sum_with_fast_float`, but over a text that has other words, too, such as the names of bones:
/// a word that is no number is passed over to the next blank.
double sum_words_with_fast_float(std::string_view text);

/// As `sum_with_fast_float`, over a table with a header, a comma or a line end behind each number.
double sum_with_commas(std::string_view table);

/// Reads the numbers of a BVH file with `ifstream >>` and adds them up.
double sum_with_ifstream(const std::string& path);

/// Goes over a YAML text with libyaml, event by event, and adds up its scalars as `strtod` reads
/// them: the core of Choreonoid's reader.
double sum_with_libyaml(std::string_view text);

/// Positions of all joints and frames, a frame at a time: for each joint the product of three
/// Eigen rotation matrices, then of the parent's.
/// \returns [frame][joint][3]
std::vector<double> positions_with_eigen(const Motion& motion);

/// Positions and rotations of all joints and frames.
template <class T>
struct Placed {
  std::vector<T> positions;  ///< [frame][joint][3]
  std::vector<T> rotations;  ///< [frame][joint][4], w x y z, or empty
};

/// The same with quaternions, a frame at a time: for each joint the product of those about its
/// axes, with the C library's sine and cosine, then of the parent's.
/// \param placed  in: any; out: the results, in the same memory if it is large enough
void place_with_eigen(const Motion& motion, bool with_rotations, Placed<double>& placed);
void place_with_eigen(const Motion& motion, bool with_rotations, Placed<float>& placed);

/// The rows of a motion by a time map, a frame and a joint at a time: two quaternions from products
/// of Eigen's AngleAxis, Eigen's `slerp` and `eulerAngles`; positions on the straight line. For
/// joints with three rotations about x, y and z, in degrees.
/// \returns [frame][coordinate]
std::vector<double> warped_with_eigen(const Motion& motion, const retime::TimeMap& map);

/// A motion whose joints turn about three other axes, a joint and a frame at a time: the product of
/// Eigen's AngleAxis, `eulerAngles`, and of the two triples for the rotation the one nearest to
/// that of the frame before. For joints with three rotations about x, y and z, in degrees. \param
/// order  of the axes: 0 x, 1 y, 2 z \returns [frame][coordinate]
std::vector<double> reordered_with_eigen(const Motion& motion,
                                         const std::array<Eigen::Index, 3>& order);

/// A motion after a Butterworth filter of second order in both directions, with two periods of
/// padding, a joint at a time: the four numbers of quaternions on one side, then `eulerAngles` near
/// the old ones. Positions are filtered as numbers.
/// \returns [frame][coordinate]
std::vector<double> smoothed_with_eigen(const Motion& motion, double cutoff_hz);

/// A motion mirrored in x, a joint and a frame at a time: the product of its rotations, mirrored,
/// and `eulerAngles` of its partner, near those of the frame before. Partners are named Left and
/// Right.
/// \returns [frame][coordinate]
std::vector<double> mirrored_with_eigen(const Motion& motion);

}  // namespace kinefile::bench
