// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kinefile/skeleton.hpp"

namespace kinefile {

/// A whole turn: 360 degrees or 2 pi.
double whole_turn(AngleUnit unit);

/// Whether all numbers are finite.
bool all_finite(std::span<const double> numbers);

/// A column that moves a joint's origin, and along which axis of its parent's frame.
struct TranslationColumn {
  Vec3 axis = Vec3::Zero();
  std::size_t column = 0;
};

/// What moves a joint's origin: its translations, or the first three columns of a free joint.
std::vector<TranslationColumn> translation_columns(const Joint& joint);

/// Where translations put a point, for a joint's origin in its parent's frame.
/// \param offset  where the point is without them
Vec3 position_in_row(const Vec3& offset, const std::vector<TranslationColumn>& translations,
                     std::span<const double> row);

/// Finds the values of translations that put a point in a place, or as near to it as they can, by
/// least squares. Where several values do, those nearest to the ones in the row.
/// \param offset  where the point is without them
/// \returns the distance that remains
double fit_position(const Vec3& offset, const std::vector<TranslationColumn>& translations,
                    const Vec3& position, std::span<double> row);

/// The column of a joint's free movement, or nothing for a joint that has none.
std::optional<std::size_t> free_column(const Joint& joint);

/// The quaternion in the columns of a joint that moves freely, normalised.
Quat free_rotation(std::span<const double> row, std::size_t column);

/// Writes a quaternion into the columns of a joint that moves freely.
void set_free_rotation(std::span<double> row, std::size_t column, const Quat& rotation);

}  // namespace kinefile
