// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kinefile/math.hpp"

namespace kinefile {
namespace {

Quat turn(const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis)); }

Quat negated(const Quat& q) { return Quat(Quat::Coefficients(-q.coeffs())); }

double distance(const Quat& a, const Quat& b) { return (a.coeffs() - b.coeffs()).norm(); }

class RandomQuats {
 public:
  Quat operator()() {
    Quat q(normal_(random_), normal_(random_), normal_(random_), normal_(random_));
    return q.normalized();
  }

 private:
  std::mt19937_64 random_{11};
  std::normal_distribution<double> normal_;
};

TEST(UnitQuaternion, KeepsTheDirectionOfAnyLength) {
  const Quat expected = turn(Vec3(2, -1, 2) / 3, 0.7);
  for (const double length : {1.0, 2.0, 1e-5, 1e150, 1e200, 1e308, 1e-150, 1e-200, 1e-300}) {
    const Quat scaled(Quat::Coefficients(length * expected.coeffs()));
    EXPECT_LT(distance(unit_quaternion(scaled), expected), 3e-16) << length;
    EXPECT_LT(distance(unit_quaternion(negated(scaled)), negated(expected)), 3e-16) << length;
  }
  // A number so small that a double has few digits of it.
  EXPECT_EQ(unit_quaternion({0, 0, 5e-324, 0}).coeffs(), Quat(0, 0, 1, 0).coeffs());
}

TEST(UnitQuaternion, ZeroTurnsNothingAndNanIsNoRotation) {
  EXPECT_EQ(unit_quaternion({0, -0.0, 0, 0}).coeffs(), Quat::Identity().coeffs());
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double broken : {std::nan(""), infinity, -infinity}) {
    const Quat result = unit_quaternion({broken, 0, 0, 0});
    for (Eigen::Index k = 0; k < 4; ++k) EXPECT_FALSE(std::isfinite(result.coeffs()[k])) << k;
  }
}

TEST(Slerp, TurnsAtAConstantRate) {
  RandomQuats random;
  for (int i = 0; i < 200; ++i) {
    const Quat a = random();
    const Quat b = random();
    const double whole = angle_between(a, b);
    for (const double t : {0.0, 0.1, 0.5, 0.75, 1.0}) {
      const Quat q = slerp(a, b, t);
      EXPECT_NEAR(q.norm(), 1, 1e-15);
      EXPECT_NEAR(angle_between(a, q), t * whole, 1e-14);
      EXPECT_NEAR(angle_between(q, b), (1 - t) * whole, 1e-14);
      EXPECT_GE(q.dot(a), 0) << "on the side of the first";
    }
  }
}

TEST(Slerp, EqualQuaternionsGiveThemselves) {
  RandomQuats random;
  for (int i = 0; i < 50; ++i) {
    const Quat q = random();
    EXPECT_LT(distance(slerp(q, q, 0.3), q), 1e-15);
    EXPECT_LT(distance(slerp(q, negated(q), 0.3), q), 1e-15);
  }
}

TEST(Slerp, NearlyEqualQuaternionsKeepTheirDigits) {
  const Quat a = turn(Vec3(1, 2, -2) / 3, 0.7);
  for (double angle = 1e-3; angle > 1e-14; angle /= 10) {
    const Quat b = a * turn(Vec3::UnitY(), angle);
    EXPECT_LT(distance(slerp(a, b, 0.25), a * turn(Vec3::UnitY(), angle / 4)), 3e-16) << angle;
  }
}

TEST(Slerp, HalfATurnApartTakesOneOfTheTwoWays) {
  const Quat a = turn(Vec3::UnitZ(), 0.4);
  const Quat b = a * turn(Vec3::UnitX(), std::numbers::pi);
  const Quat q = slerp(a, b, 0.5);
  EXPECT_NEAR(angle_between(a, q), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(angle_between(b, q), std::numbers::pi / 2, 1e-15);
}

TEST(Nlerp, TakesTheSameWayAsSlerp) {
  RandomQuats random;
  for (int i = 0; i < 200; ++i) {
    const Quat a = random();
    const Quat b = random();
    EXPECT_LT(distance(nlerp(a, b, 0.5), slerp(a, b, 0.5)), 1e-14) << "half way they meet";
    const double whole = angle_between(a, b);
    const Quat q = nlerp(a, b, 0.2);
    EXPECT_NEAR(angle_between(a, q) + angle_between(q, b), whole, 1e-14);
    EXPECT_NEAR(angle_between(a, q), 0.2 * whole, 0.1 * whole);
  }
}

TEST(LogAndExp, AreInverseToEachOther) {
  RandomQuats random;
  for (int i = 0; i < 200; ++i) {
    const Quat q = random();
    EXPECT_LT(distance(exp_of(log_of(q)), on_side_of(q, Quat::Identity())), 1e-15);
  }
  for (double angle = 1; angle > 1e-200; angle *= 1e-7) {
    const Vec3 v = angle * Vec3(2, -1, 2) / 3;
    EXPECT_LT((log_of(exp_of(v)) - v).norm(), 1e-15 * angle);
  }
  EXPECT_EQ(log_of(Quat::Identity()), Vec3::Zero());
  EXPECT_EQ(exp_of(Vec3::Zero()).coeffs(), Quat::Identity().coeffs());
}

TEST(Log, IsHalfTheRotationVectorOfEitherTwin) {
  const Vec3 axis = Vec3(3, 4, 12) / 13;
  EXPECT_LT((log_of(turn(axis, 1.2)) - 0.6 * axis).norm(), 1e-15);
  EXPECT_LT((log_of(negated(turn(axis, 1.2))) - 0.6 * axis).norm(), 1e-15);
}

TEST(Squad, GoesThroughItsEnds) {
  RandomQuats random;
  for (int i = 0; i < 50; ++i) {
    const Quat before = random();
    const Quat a = on_side_of(random(), before);
    const Quat b = on_side_of(random(), a);
    const Quat after = on_side_of(random(), b);
    const Quat control_a = squad_control(before, a, b);
    const Quat control_b = squad_control(a, b, after);
    EXPECT_LT(distance(squad(a, control_a, control_b, b, 0), a), 1e-15);
    EXPECT_LT(distance(squad(a, control_a, control_b, b, 1), b), 1e-15);
  }
}

TEST(Squad, IsSmoothWhereTwoPiecesMeet) {
  const Quat q[] = {turn(Vec3::UnitX(), 0.1), turn(Vec3(0.6, 0.8, 0), 0.5),
                    turn(Vec3(0, 0.6, 0.8), 0.7), turn(Vec3::UnitY(), 1.1),
                    turn(Vec3(0.8, 0, 0.6), 1.0)};
  const Quat control[] = {squad_control(q[0], q[1], q[2]), squad_control(q[1], q[2], q[3]),
                          squad_control(q[2], q[3], q[4])};
  constexpr double kStep = 1e-5;
  const Quat before = squad(q[1], control[0], control[1], q[2], 1 - kStep);
  const Quat after = squad(q[2], control[1], control[2], q[3], kStep);
  const Vec3 rate_before = log_of(before.conjugate() * q[2]) / kStep;
  const Vec3 rate_after = log_of(q[2].conjugate() * after) / kStep;
  EXPECT_LT((rate_before - rate_after).norm(), 1e-4);
  const Vec3 expected = 0.5 * (log_of(q[2].conjugate() * q[3]) - log_of(q[2].conjugate() * q[1]));
  EXPECT_LT((rate_after - expected).norm(), 1e-4) << "the mean of the rates on both sides";
}

TEST(Squad, AConstantTurnStaysConstant) {
  const Vec3 axis = Vec3(2, 3, 6) / 7;
  const auto at = [&axis](double frame) { return turn(axis, 0.3 * frame); };
  const Quat control_a = squad_control(at(0), at(1), at(2));
  const Quat control_b = squad_control(at(1), at(2), at(3));
  EXPECT_LT(distance(squad(at(1), control_a, control_b, at(2), 0.3), at(1.3)), 1e-15);
}

}  // namespace
}  // namespace kinefile
