// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinefile/motion.hpp"

namespace kinefile {

/// A whole turn: 360 degrees or 2 pi.
double whole_turn(AngleUnit unit);

/// Whether all numbers are finite.
bool all_finite(std::span<const double> numbers);

/// After how much the number of each column gives the same rotations again; 0 for columns that give
/// more than angles, or angles that do not all come round together; shape (coordinates).
std::vector<double> turns_of_columns(const Skeleton& skeleton);

/// The value of a degree of freedom that reads one column.
inline double value_in_row(const DegreeOfFreedom& dof, std::span<const double> row) {
  return value_of(dof, row[dof.coordinate]);
}

/// Brings the number in one degree of freedom's column to another's. It keeps its bits where both
/// make the same of it.
/// \param factor  of the values: between units, or -1
double carried_over(const DegreeOfFreedom& from, const DegreeOfFreedom& to, double factor,
                    double number);

/// Which of a joint's degrees of freedom follow another joint: those with a column that it does
/// not lead (see `leaders_of_columns`); shape (dofs).
std::vector<bool> following_dofs(const std::vector<DegreeOfFreedom>& dofs, std::size_t joint,
                                 const std::vector<std::size_t>& leaders);

/// Gives the columns that repeat the values of following joints (see `following_columns`) those
/// values.
/// \param first  of the columns; those before it keep theirs
void fill_following_columns(Motion& motion, std::size_t first);

/// A degree of freedom that moves a joint's origin, and along which axis of its parent's frame.
struct Translation {
  Vec3 axis = Vec3::Zero();
  DegreeOfFreedom dof;
};

/// What moves a joint's origin: its translations, or the first three columns of a free joint.
std::vector<Translation> translations_of(const Joint& joint);

/// Where translations put a point, for a joint's origin in its parent's frame.
/// \param offset  where the point is without them
Vec3 position_in_row(const Vec3& offset, const std::vector<Translation>& translations,
                     std::span<const double> row);

/// Finds the values of translations that put a point in a place, or as near to it as they can, by
/// least squares. Where several values do, those nearest to the ones in the row.
/// \param offset     where the point is without them
/// \param follows    translations that stay as they are; shape (translations), or empty for none
/// \returns the distance that remains
double fit_position(const Vec3& offset, const std::vector<Translation>& translations,
                    const Vec3& position, std::span<double> row,
                    const std::vector<bool>& follows = {});

}  // namespace kinefile
