// SPDX-License-Identifier: MIT
#include "retime/ease.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "simd/number_index.hpp"

namespace kinefile::retime {
namespace {

/// One coordinate of a cubic Bezier curve from 0 to 1.
double bezier(double p1, double p2, double t) {
  const double s = 1 - t;
  return 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t;
}

double bezier_slope(double p1, double p2, double t) {
  const double s = 1 - t;
  return 3 * s * s * p1 + 6 * s * t * (p2 - p1) + 3 * t * t * (1 - p2);
}

/// The parameter at which x is u: Newton steps while they stay in the bracket, otherwise its
/// middle.
double bezier_parameter(const Ease& ease, double u) {
  double low = 0;
  double high = 1;
  double t = u;
  for (int step = 0; step < 64; ++step) {
    const double miss = bezier(ease.x1, ease.x2, t) - u;
    if (std::abs(miss) < 1e-15) break;
    (miss < 0 ? low : high) = t;
    const double newton = t - miss / bezier_slope(ease.x1, ease.x2, t);
    t = newton > low && newton < high ? newton : (low + high) / 2;
  }
  return t;
}

double in_out(double power, double u) {
  return u < 0.5 ? std::pow(2 * u, power) / 2 : 1 - std::pow(2 * (1 - u), power) / 2;
}

/// Finite numbers with commas between them, or nothing.
std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::string_view token = text.substr(0, text.find(','));
    double& number = numbers.emplace_back();
    if (token.empty() || !simd::read_odd_token(token.data(), token.data() + token.size(), number)) {
      return std::nullopt;
    }
    if (token.size() == text.size()) return numbers;
    text.remove_prefix(token.size() + 1);
  }
}

/// In the order of `Ease::Kind`.
constexpr std::array<std::string_view, 7> kEaseNames = {"none", "smooth", "smoother", "in",
                                                        "out",  "in-out", "bezier"};

std::optional<Ease::Kind> kind_of(std::string_view name) {
  for (std::size_t kind = 0; kind < kEaseNames.size(); ++kind) {
    if (kEaseNames[kind] == name) return static_cast<Ease::Kind>(kind);
  }
  return std::nullopt;
}

bool has_power(Ease::Kind kind) {
  return kind == Ease::Kind::In || kind == Ease::Kind::Out || kind == Ease::Kind::InOut;
}

}  // namespace

std::optional<Ease> parse_ease(std::string_view text) {
  const std::size_t colon = text.find(':');
  const auto kind = kind_of(text.substr(0, colon));
  if (!kind) return std::nullopt;
  Ease ease;
  ease.kind = *kind;
  if (colon == std::string_view::npos) {
    return ease.kind == Ease::Kind::Bezier ? std::nullopt : std::optional(ease);
  }
  const auto numbers = parse_numbers(text.substr(colon + 1));
  if (!numbers) return std::nullopt;
  if (has_power(ease.kind) && numbers->size() == 1) {
    ease.power = numbers->front();
  } else if (ease.kind == Ease::Kind::Bezier && numbers->size() == 4) {
    ease.x1 = (*numbers)[0];
    ease.y1 = (*numbers)[1];
    ease.x2 = (*numbers)[2];
    ease.y2 = (*numbers)[3];
  } else {
    return std::nullopt;
  }
  return is_valid(ease) ? std::optional(ease) : std::nullopt;
}

std::string word_of(const Ease& ease) {
  const std::string_view name = kEaseNames[static_cast<std::size_t>(ease.kind)];
  if (ease.kind == Ease::Kind::Bezier) {
    return fmt::format("{}:{},{},{},{}", name, ease.x1, ease.y1, ease.x2, ease.y2);
  }
  const bool has_other_power = has_power(ease.kind) && ease.power != Ease{}.power;
  return has_other_power ? fmt::format("{}:{}", name, ease.power) : std::string(name);
}

double ease_at(const Ease& ease, double u) {
  if (u <= 0) return 0;
  if (u >= 1) return 1;
  switch (ease.kind) {
    case Ease::Kind::None:
      return u;
    case Ease::Kind::Smooth:
      return u * u * (3 - 2 * u);
    case Ease::Kind::Smoother:
      return u * u * u * (u * (6 * u - 15) + 10);
    case Ease::Kind::In:
      return std::pow(u, ease.power);
    case Ease::Kind::Out:
      return 1 - std::pow(1 - u, ease.power);
    case Ease::Kind::InOut:
      return in_out(ease.power, u);
    case Ease::Kind::Bezier:
      return bezier(ease.y1, ease.y2, bezier_parameter(ease, u));
  }
  return u;
}

bool is_valid(const Ease& ease) {
  if (has_power(ease.kind)) return ease.power > 0 && std::isfinite(ease.power);
  if (ease.kind != Ease::Kind::Bezier) return true;
  // No overshoot needs larger values, and products of the numbers stay finite.
  constexpr double kMost = 1e6;
  const auto is_share = [](double x) { return x >= 0 && x <= 1; };
  return is_share(ease.x1) && is_share(ease.x2) && std::abs(ease.y1) <= kMost &&
         std::abs(ease.y2) <= kMost;
}

bool goes_back(const Ease& ease) {
  if (ease.kind != Ease::Kind::Bezier) return false;
  // The slope of y is a quadratic Bezier curve with these ends and this middle; it is nowhere
  // negative if its ends are not and its middle is no lower than minus their geometric mean.
  const double first = ease.y1;
  const double middle = ease.y2 - ease.y1;
  const double last = 1 - ease.y2;
  return first < 0 || last < 0 || middle < -std::sqrt(first * last);
}

}  // namespace kinefile::retime
