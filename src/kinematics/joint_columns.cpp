// SPDX-License-Identifier: MIT
#include "kinematics/joint_columns.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

/// A column that moves a point, and the displacement per unit.
struct Way {
  Vec3 along = Vec3::Zero();
  std::size_t column = 0;
};

/// The columns that may change, once each: if several translations read one, their directions are
/// added.
std::vector<Way> ways_of(const std::vector<Translation>& translations,
                         const std::vector<bool>& follows) {
  std::vector<Way> ways;
  for (std::size_t t = 0; t < translations.size(); ++t) {
    if (!follows.empty() && follows[t]) continue;
    const DegreeOfFreedom& dof = translations[t].dof;
    const Vec3 along = is_plain(dof) ? translations[t].axis : Vec3(dof.gain * translations[t].axis);
    const auto same = std::find_if(ways.begin(), ways.end(), [&dof](const Way& other) {
      return other.column == dof.coordinate;
    });
    if (same == ways.end()) {
      ways.push_back({along, dof.coordinate});
    } else {
      same->along += along;
    }
  }
  return ways;
}

/// The period of a column that only rotations with these gains read.
double turn_of_gains(const std::vector<double>& gains, double whole_turn) {
  constexpr double kTolerance = 1e-9;
  double least = 0;
  for (const double gain : gains) {
    if (gain != 0 && (least == 0 || gain < least)) least = gain;
  }
  if (least == 0) return 0;
  const bool come_round = std::all_of(gains.begin(), gains.end(), [least](double gain) {
    return std::abs(gain / least - std::round(gain / least)) <= kTolerance;
  });
  return come_round ? whole_turn / least : 0;
}

}  // namespace

double whole_turn(AngleUnit unit) {
  return unit == AngleUnit::Degrees ? 360.0 : 2 * std::numbers::pi;
}

bool all_finite(std::span<const double> numbers) {
  constexpr std::size_t kTogether = 8;  // sums that do not wait for each other
  std::array<double, kTogether> sums{};
  const double* number = numbers.data();
  std::size_t rest = numbers.size();
  for (; rest >= kTogether; rest -= kTogether, number += kTogether) {
    // 0 for a finite number, NaN for others, and NaN stays.
    for (std::size_t k = 0; k < kTogether; ++k) sums[k] += 0 * number[k];
  }
  return std::all_of(sums.begin(), sums.end(), [](double sum) { return sum == 0; }) &&
         std::all_of(number, number + rest, [](double last) { return std::isfinite(last); });
}

std::vector<double> turns_of_columns(const Skeleton& skeleton) {
  std::vector<std::vector<double>> gains(skeleton.coordinates.size());
  std::vector<bool> is_other(skeleton.coordinates.size(), false);
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind == DofKind::Rotation) gains[dof.coordinate].push_back(std::abs(dof.gain));
      for (std::size_t k = 0; dof.kind != DofKind::Rotation && k < num_coordinates(dof); ++k) {
        is_other[dof.coordinate + k] = true;
      }
    }
  }
  std::vector<double> turns(gains.size(), 0.0);
  for (std::size_t c = 0; c < turns.size(); ++c) {
    if (!is_other[c]) turns[c] = turn_of_gains(gains[c], whole_turn(skeleton.angle_unit));
  }
  return turns;
}

bool keeps_numbers(const DegreeOfFreedom& from, const DegreeOfFreedom& to, double factor) {
  return from.gain == to.gain && factor * from.shift == to.shift;
}

double carried_over(const DegreeOfFreedom& from, const DegreeOfFreedom& to, double factor,
                    double number) {
  if (keeps_numbers(from, to, factor)) return factor * number;
  return column_of(to, factor * value_of(from, number));
}

std::vector<bool> following_dofs(const std::vector<DegreeOfFreedom>& dofs, std::size_t joint,
                                 const std::vector<std::size_t>& leaders) {
  std::vector<bool> follows;
  for (const DegreeOfFreedom& dof : dofs) {
    bool leads = true;
    for (std::size_t k = 0; k < num_coordinates(dof); ++k) {
      leads = leads && leaders[dof.coordinate + k] == joint;
    }
    follows.push_back(!leads);
  }
  return follows;
}

void fill_following_columns(Motion& motion, std::size_t first) {
  const std::vector<FollowingColumn> columns = following_columns(motion.skeleton);
  if (columns.empty()) return;
  const Rows rows = motion.clip.mutate();
  for (const FollowingColumn& following : columns) {
    if (following.column < first) continue;
    const DegreeOfFreedom& dof = motion.skeleton.joints[following.joint].dofs[0];
    for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
      rows[f][following.column] = value_of(dof, rows[f][dof.coordinate]);
    }
  }
}

std::vector<Translation> translations_of(const Joint& joint) {
  std::vector<Translation> translations;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind == DofKind::Translation) {
      translations.push_back({joint.rest_rotation * dof.axis, dof});
    }
    for (std::size_t k = 0; dof.kind == DofKind::Free && k < 3; ++k) {
      const Vec3 axis = Vec3::Unit(static_cast<Eigen::Index>(k));
      translations.push_back(
          {joint.rest_rotation * axis,
           {DofKind::Translation, axis, dof.coordinate + k, joint.free_rest[k]}});
    }
  }
  return translations;
}

double noise_of_place(const Joint& joint, double skeleton_size) {
  constexpr double kNoise = 1e-3;
  constexpr double kShortest = 1e-2;
  return kNoise * std::max(rest_offset(joint).norm(), kShortest * skeleton_size);
}

std::optional<SettledNumber> settled_number(const ColumnRange& range, double rest, double noise) {
  if (range.num_frames == 0) return SettledNumber{rest, 0};
  if (!range.is_finite) return std::nullopt;
  if (range.is_constant) return SettledNumber{range.first, 0};
  const double from_rest = std::max(range.greatest - rest, rest - range.least);
  if (from_rest <= noise) return SettledNumber{rest, from_rest};
  if (!(range.greatest - range.least <= noise)) return std::nullopt;
  const double middle = range.least + 0.5 * (range.greatest - range.least);
  return SettledNumber{middle, std::max(range.greatest - middle, middle - range.least)};
}

Vec3 position_in_row(const Vec3& offset, const std::vector<Translation>& translations,
                     std::span<const double> row) {
  Vec3 position = offset;
  for (const Translation& translation : translations) {
    position += value_in_row(translation.dof, row) * translation.axis;
  }
  return position;
}

double fit_position(const Vec3& offset, const std::vector<Translation>& translations,
                    const Vec3& position, std::span<double> row, const std::vector<bool>& follows) {
  const std::vector<Way> ways = ways_of(translations, follows);
  // The position of the point if the columns that may change are 0.
  Vec3 start = offset;
  for (std::size_t t = 0; t < translations.size(); ++t) {
    const DegreeOfFreedom& dof = translations[t].dof;
    const bool is_fixed = !follows.empty() && follows[t];
    if (is_fixed || dof.shift != 0) {
      start += (is_fixed ? value_in_row(dof, row) : dof.shift) * translations[t].axis;
    }
  }
  const Vec3 wanted = position - start;
  if (ways.empty()) return wanted.norm();
  Eigen::Matrix3Xd axes(3, static_cast<Eigen::Index>(ways.size()));
  Eigen::VectorXd values(axes.cols());
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const double now = row[ways[k].column];
    axes.col(static_cast<Eigen::Index>(k)) = ways[k].along;
    values[static_cast<Eigen::Index>(k)] = std::isfinite(now) ? now : 0;
  }
  constexpr double kSquare = 1e-12;
  // Perpendicular axes, the usual case, need no equations: exact if they are x, y and z.
  if ((axes.transpose() * axes).isIdentity(kSquare)) {
    values = axes.transpose() * wanted;
  } else {
    const auto solver = axes.completeOrthogonalDecomposition();
    // The second step removes the rounding error of the first.
    for (int step = 0; step < 2; ++step) values += solver.solve(wanted - axes * values);
  }
  for (std::size_t k = 0; k < ways.size(); ++k) {
    row[ways[k].column] = values[static_cast<Eigen::Index>(k)];
  }
  return (axes * values - wanted).norm();
}

}  // namespace kinefile
