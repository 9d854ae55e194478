// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinefile/motion.hpp"
#include "kinematics/column_range.hpp"

namespace kinefile {

/// A whole turn: 360 degrees or 2 pi.
double whole_turn(AngleUnit unit);

/// Whether all numbers are finite.
bool all_finite(std::span<const double> numbers);

/// The period after which the number in each column gives the same rotations again; 0 for columns
/// that do not only give angles, or give angles without a common period; shape (coordinates).
std::vector<double> turns_of_columns(const Skeleton& skeleton);

/// The value of a degree of freedom that reads one column.
inline double value_in_row(const DegreeOfFreedom& dof, std::span<const double> row) {
  return value_of(dof, row[dof.coordinate]);
}

/// Whether `carried_over` only multiplies numbers by the factor: both have the same gain and shift.
bool keeps_numbers(const DegreeOfFreedom& from, const DegreeOfFreedom& to, double factor);

/// Converts the number in one degree of freedom's column to that of another.
/// \param factor  applied to the value: between units, or -1
double carried_over(const DegreeOfFreedom& from, const DegreeOfFreedom& to, double factor,
                    double number);

/// Which of a joint's degrees of freedom follow another joint: those with a column that it does
/// not lead (see `leaders_of_columns`); shape (dofs).
std::vector<bool> following_dofs(const std::vector<DegreeOfFreedom>& dofs, std::size_t joint,
                                 const std::vector<std::size_t>& leaders);

/// Sets the columns that repeat the values of following joints (see `following_columns`).
/// \param first  the first column to set; columns before it stay unchanged
void fill_following_columns(Motion& motion, std::size_t first);

/// A degree of freedom that translates a joint's origin, and its axis in the parent's frame.
struct Translation {
  Vec3 axis = Vec3::Zero();
  DegreeOfFreedom dof;
};

/// The translations of a joint's origin: its own, or the first three columns of a free joint.
std::vector<Translation> translations_of(const Joint& joint);

/// How far a joint may be from its place in its parent's frame without moving: as far as exporters
/// round. A thousandth of its bone, from the parent to the joint at rest; a bone shorter than a
/// hundredth of the skeleton counts as one of that length.
/// \param skeleton_size  see `rest_size`
double noise_of_place(const Joint& joint, double skeleton_size);

/// The number that a column would have without its noise.
struct SettledNumber {
  double number = 0;
  double loss = 0;  ///< how far the column is from it at the most
};

/// The number of a column that stays but for noise: its only one, or the rest value if all are as
/// near to that as noise, otherwise the middle if all are as near to each other. Nothing if the
/// column changes more.
std::optional<SettledNumber> settled_number(const ColumnRange& range, double rest, double noise);

/// The position of a point after translations, for a joint's origin in its parent's frame.
/// \param offset  the position without translations
Vec3 position_in_row(const Vec3& offset, const std::vector<Translation>& translations,
                     std::span<const double> row);

/// Finds the values of translations that move a point to a place, or as near to it as possible, by
/// least squares. If several solutions exist, the one nearest to the values in the row.
/// \param offset     the position without translations
/// \param follows     translations that keep their values; shape (translations), or empty for none
/// \returns the residual distance
double fit_position(const Vec3& offset, const std::vector<Translation>& translations,
                    const Vec3& position, std::span<double> row,
                    const std::vector<bool>& follows = {});

}  // namespace kinefile
