// SPDX-License-Identifier: MIT
#include "kinematics/joint_columns.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

/// Columns that are there once each: where several translations read one, it moves along the sum.
std::vector<TranslationColumn> without_repeated_columns(
    const std::vector<TranslationColumn>& translations) {
  std::vector<TranslationColumn> columns;
  for (const TranslationColumn& translation : translations) {
    const auto same = std::find_if(columns.begin(), columns.end(),
                                   [&translation](const TranslationColumn& other) {
                                     return other.column == translation.column;
                                   });
    if (same == columns.end()) {
      columns.push_back(translation);
    } else {
      same->axis += translation.axis;
    }
  }
  return columns;
}

}  // namespace

double whole_turn(AngleUnit unit) {
  return unit == AngleUnit::Degrees ? 360.0 : 2 * std::numbers::pi;
}

bool all_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](double number) { return std::isfinite(number); });
}

std::vector<TranslationColumn> translation_columns(const Joint& joint) {
  std::vector<TranslationColumn> translations;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind == DofKind::Translation) {
      translations.push_back({joint.rest_rotation * dof.axis, dof.coordinate});
    }
    for (std::size_t k = 0; dof.kind == DofKind::Free && k < 3; ++k) {
      const Vec3 axis = Vec3::Unit(static_cast<Eigen::Index>(k));
      translations.push_back({joint.rest_rotation * axis, dof.coordinate + k});
    }
  }
  return translations;
}

Vec3 position_in_row(const Vec3& offset, const std::vector<TranslationColumn>& translations,
                     std::span<const double> row) {
  Vec3 position = offset;
  for (const TranslationColumn& translation : translations)
    position += row[translation.column] * translation.axis;
  return position;
}

double fit_position(const Vec3& offset, const std::vector<TranslationColumn>& translations,
                    const Vec3& position, std::span<double> row) {
  const std::vector<TranslationColumn> columns = without_repeated_columns(translations);
  const Vec3 wanted = position - offset;
  if (columns.empty()) return wanted.norm();
  Eigen::Matrix3Xd axes(3, static_cast<Eigen::Index>(columns.size()));
  Eigen::VectorXd values(axes.cols());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double now = row[columns[k].column];
    axes.col(static_cast<Eigen::Index>(k)) = columns[k].axis;
    values[static_cast<Eigen::Index>(k)] = std::isfinite(now) ? now : 0;
  }
  constexpr double kSquare = 1e-12;
  // Axes at right angles, which is the rule, need no equations: exact where they are x, y and z.
  if ((axes.transpose() * axes).isIdentity(kSquare)) {
    values = axes.transpose() * wanted;
  } else {
    const auto solver = axes.completeOrthogonalDecomposition();
    // The second step takes off what rounding left of the first.
    for (int step = 0; step < 2; ++step) values += solver.solve(wanted - axes * values);
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    row[columns[k].column] = values[static_cast<Eigen::Index>(k)];
  }
  return (axes * values - wanted).norm();
}

std::optional<std::size_t> free_column(const Joint& joint) {
  return moves_freely(joint) ? std::optional(joint.dofs[0].coordinate) : std::nullopt;
}

Quat free_rotation(std::span<const double> row, std::size_t column) {
  return Quat(row[column + 3], row[column + 4], row[column + 5], row[column + 6]).normalized();
}

void set_free_rotation(std::span<double> row, std::size_t column, const Quat& rotation) {
  row[column + 3] = rotation.w();
  for (std::size_t k = 0; k < 3; ++k) {
    row[column + 4 + k] = rotation.vec()[static_cast<Eigen::Index>(k)];
  }
}

}  // namespace kinefile
