// SPDX-License-Identifier: MIT
// Triples that are found many at a time have the bits of those that the rule gives one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "math/turns.hpp"
#include "rotation/rotations.hpp"
#include "support/motions.hpp"

namespace kinefile::rotation {
namespace {

using Random = std::mt19937_64;

/// What the finder shall do, one rotation after the other.
class Twin {
 public:
  Twin(const simd::EulerForm& form, const Vec3& start)
      : form_(form), half_(form.is_in_degrees ? 180 : std::numbers::pi), before_(start) {}

  Vec3 next(const Vec3& halves) {
    if (!halves.allFinite()) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    return before_ = nearest(halves[0], halves[1], halves[2]);
  }

 private:
  Vec3 nearest(double plus, double minus, double middle) const {
    const double locked = 1e-12 / std::numbers::pi * half_;
    const bool is_at_start = middle < locked;
    const double a = before_[0];
    const double c = form_.sign * (is_at_start ? 2 * plus - a : a - 2 * minus);
    const Vec3 in_lock(a, nearest_turn(form_.shift + middle, before_[1], 2 * half_),
                       nearest_turn(c, before_[2], 2 * half_));
    if (is_at_start || half_ - middle < locked) return in_lock;
    const double sum = plus + minus;
    const double difference = form_.sign * (plus - minus);
    const Vec3 one = nearest_turns({sum, form_.shift + middle, difference}, before_, 2 * half_);
    const Vec3 other =
        nearest_turns({sum + half_, form_.shift - middle, difference + half_}, before_, 2 * half_);
    return (other - before_).squaredNorm() < (one - before_).squaredNorm() ? other : one;
  }

  simd::EulerForm form_;
  double half_;
  Vec3 before_;
};

bool have_same_bits(const Vec3& a, const Vec3& b) {
  if (a.array().isNaN().all() && b.array().isNaN().all()) return true;
  return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0;
}

Quat about(const EulerAxes& axes, const Vec3& degrees) {
  Quat q = Quat::Identity();
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = degrees[static_cast<Eigen::Index>(k)] * kRadiansPerDegree;
    q = q * Quat(Eigen::AngleAxisd(angle, axes[k]));
  }
  return q;
}

/// Finds the angles of rotations in pieces, and those of the twin.
void expect_twins_bits(const EulerAxes& axes, bool is_in_degrees, const std::vector<Quat>& turns,
                       const Vec3& start, std::size_t piece) {
  AngleFinder finder(axes, is_in_degrees, start);
  const simd::EulerForm form = euler_form(axes, is_in_degrees);
  Twin twin(form, start);
  for (std::size_t first = 0; first < turns.size(); first += piece) {
    const std::size_t count = std::min(piece, turns.size() - first);
    simd::Quaternions q;
    resize(q, count);
    for (auto& component : q) std::fill(component.begin(), component.end(), std::nan(""));
    for (std::size_t i = 0; i < count; ++i) put_quaternion(turns[first + i], i, q);
    simd::Quaternions in_form = q;
    simd::turn_to_form(form, kernel_from_joint(axes), in_form);
    simd::Angles halves;
    simd::half_angles_of_quaternions(form, in_form, halves);
    simd::Angles found;
    finder.find(q, count, found);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 wanted = twin.next({halves[0][i], halves[1][i], halves[2][i]});
      const Vec3 angles(found[0][i], found[1][i], found[2][i]);
      ASSERT_TRUE(have_same_bits(angles, wanted))
          << first + i << ": " << angles.transpose() << " for " << wanted.transpose();
    }
  }
}

/// Rotations that change by about `step` degrees a frame.
std::vector<Quat> walk_of(Random& random, const EulerAxes& axes, double step, std::size_t count) {
  std::normal_distribution<double> normal;
  std::vector<Quat> turns;
  Vec3 angles = 90 * Vec3(normal(random), normal(random), normal(random));
  for (std::size_t f = 0; f < count; ++f) {
    angles += step * Vec3(normal(random), normal(random), normal(random));
    turns.push_back(about(axes, angles));
  }
  return turns;
}

TEST(AngleFinder, GivesTheBitsOfTheRuleForStepsOfAllSizes) {
  Random random(1);
  for (const EulerAxes& axes : test::all_euler_axes()) {
    for (const double step : {0.0, 0.01, 1.0, 10.0, 60.0, 300.0}) {
      const std::vector<Quat> turns = walk_of(random, axes, step, 200);
      for (const bool is_in_degrees : {true, false}) {
        expect_twins_bits(axes, is_in_degrees, turns, Vec3::Zero(), turns.size());
      }
    }
  }
}

TEST(AngleFinder, GivesTheBitsOfTheRuleForAllLengthsOfPieces) {
  Random random(2);
  const EulerAxes axes = test::all_euler_axes()[4];
  const std::vector<Quat> turns = walk_of(random, axes, 8, 150);
  for (std::size_t piece = 1; piece < 70; ++piece) {
    expect_twins_bits(axes, true, turns, Vec3(1, 2, 3), piece);
  }
  for (std::size_t count = 0; count < 50; ++count) {
    const std::vector<Quat> few(turns.begin(), turns.begin() + static_cast<std::ptrdiff_t>(count));
    expect_twins_bits(axes, true, few, Vec3::Zero(), 64);
  }
}

TEST(AngleFinder, GivesTheBitsOfTheRuleInAndNearGimbalLock) {
  Random random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const EulerAxes& axes : test::all_euler_axes()) {
    const bool is_proper = std::abs(axes[0].dot(axes[2])) > 0.5;
    std::vector<Quat> turns;
    for (std::size_t f = 0; f < 400; ++f) {
      const double near = f % 7 == 0 ? 0 : std::pow(10.0, -static_cast<double>(f % 17));
      const double lock = (is_proper ? 0 : 90) + (f / 100 % 2 == 0 ? 0 : 180);
      const bool is_away = f % 50 > 40;
      turns.push_back(about(axes, {static_cast<double>(f), lock + (is_away ? 30 : near),
                                   f % 3 == 0 ? 0 : 20 * number(random)}));
    }
    for (const bool is_in_degrees : {true, false}) {
      expect_twins_bits(axes, is_in_degrees, turns, Vec3::Zero(), 100);
    }
  }
}

TEST(AngleFinder, GivesTheBitsOfTheRuleForJumpsAndTies) {
  // Right angles and half turns, after which two triples are equally near.
  Random random(4);
  for (const EulerAxes& axes : test::all_euler_axes()) {
    std::vector<Quat> turns;
    for (std::size_t f = 0; f < 300; ++f) {
      Vec3 angles = 45 * Vec3(static_cast<double>(random() % 9), static_cast<double>(random() % 9),
                              static_cast<double>(random() % 9));
      if (f % 4 != 0) angles += Vec3(1, 20, 3);
      for (std::size_t repeated = 0; repeated < 1 + f % 20; ++repeated) {
        turns.push_back(about(axes, angles));
      }
    }
    expect_twins_bits(axes, true, turns, Vec3(180, 180, -180), 128);
  }
}

TEST(AngleFinder, GivesTheBitsOfTheRuleAroundFramesThatAreNotFinite) {
  Random random(5);
  const EulerAxes axes = test::all_euler_axes()[1];
  std::vector<Quat> turns = walk_of(random, axes, 5, 300);
  for (const std::size_t f : {0u, 15u, 16u, 40u, 41u, 130u, 299u}) {
    turns[f] = Quat(std::nan(""), 0, 0, 1);
    turns[(f + 90) % 300] = Quat(1, HUGE_VAL, 0, 0);
  }
  expect_twins_bits(axes, true, turns, Vec3::Zero(), 64);
}

TEST(AngleFinder, GivesTheBitsOfTheRuleFarFromZero) {
  Random random(6);
  const EulerAxes axes = test::all_euler_axes()[2];
  const std::vector<Quat> turns = walk_of(random, axes, 5, 100);
  for (const double start : {1e3, -1e6, 1e8, 3e9, -1e13, 1e17}) {
    expect_twins_bits(axes, true, turns, Vec3(start, -start, start / 3), 100);
    expect_twins_bits(axes, false, turns, Vec3(start, -start, start / 3), 100);
  }
}

TEST(AngleFinder, GoesOnAcrossAllTurns) {
  // A joint that spins, so that each block has other whole turns than the one before it.
  const EulerAxes axes = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  for (const double speed : {3.0, 11.0, 25.0, 100.0, 179.0}) {
    std::vector<Quat> turns;
    for (std::size_t f = 0; f < 200; ++f) {
      turns.push_back(about(axes, {speed * static_cast<double>(f), 20, 5}));
    }
    expect_twins_bits(axes, true, turns, Vec3(0, 20, 5), 200);
    AngleFinder finder(axes, true, Vec3(0, 20, 5));
    simd::Quaternions q;
    resize(q, turns.size());
    for (std::size_t f = 0; f < turns.size(); ++f) put_quaternion(turns[f], f, q);
    simd::Angles found;
    finder.find(q, turns.size(), found);
    EXPECT_NEAR(found[0][199], speed * 199, 1e-9);
    EXPECT_NEAR(found[1][199], 20, 1e-11);
  }
}

}  // namespace
}  // namespace kinefile::rotation
