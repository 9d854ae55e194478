// SPDX-License-Identifier: MIT
// Included once for every instruction set, by every kernel, so without an include guard.
//
// Loops over a block without branches or calls, so that the compiler can vectorise them, which it
// cannot do with sin and cos of the C library. Results do not depend on the vector width: products
// and sums are rounded one by one, so every machine gets the same bits.

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {

/// Adding and subtracting 1.5 * 2^52 rounds to the nearest integer, which is then in the last bits
/// of the sum.
constexpr double kRounder = 6755399441055744.0;

constexpr double kDegree = std::numbers::pi / 180;

/// Beyond this angle, in the angle's own unit, the reduction would lose digits.
constexpr double kMostDegrees = 90.0 * (1 << 20);
constexpr double kMostRadians = 1 << 20;

struct Angle {
  double quarters;   ///< whole quarter turns, in the last bits
  double remainder;  ///< the remainder in radians, within an eighth of a turn
};

HWY_INLINE Angle reduce_degrees(double degrees) {
  const double sum = degrees * (1.0 / 90) + kRounder;
  const double quarters = sum - kRounder;
  // The product and the difference are exact, so no digit of the angle is lost.
  return {sum, (degrees - quarters * 90) * kDegree};
}

HWY_INLINE Angle reduce_radians(double radians) {
  // pi / 2 in three parts; the first two have 33 bits, so that their products are exact
  // (Cody and Waite, "Software Manual for the Elementary Functions", 1980; fdlibm e_rem_pio2.c).
  constexpr double kPart1 = 1.57079632673412561417e+00;
  constexpr double kPart2 = 6.07710050630396597660e-11;
  constexpr double kPart3 = 2.02226624879595063154e-21;
  const double sum = radians * (2 / std::numbers::pi) + kRounder;
  const double quarters = sum - kRounder;
  return {sum, ((radians - quarters * kPart1) - quarters * kPart2) - quarters * kPart3};
}

/// Minimax polynomials for |r| <= pi / 4 (fdlibm, k_sin.c and k_cos.c).
HWY_INLINE double sin_polynomial(double r) {
  const double z = r * r;
  const double p =
      -1.66666666666666324348e-01 +
      z * (8.33333333332248946124e-03 +
           z * (-1.98412698298579493134e-04 +
                z * (2.75573137070700676789e-06 +
                     z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))));
  return r + r * z * p;
}

HWY_INLINE double cos_polynomial(double r) {
  const double z = r * r;
  const double p =
      4.16666666666666019037e-02 +
      z * (-1.38888888888741095749e-03 +
           z * (2.48015872894767294178e-05 +
                z * (-2.75573143513906633035e-07 +
                     z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))));
  const double half = 0.5 * z;
  const double head = 1 - half;
  return head + (((1 - head) - half) + z * z * p);
}

HWY_INLINE std::uint64_t bits_of(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return bits;
}

/// A number with the other sign where the first bit of `bits` is set.
HWY_INLINE double with_sign(double number, std::uint64_t bits) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  const std::uint64_t changed = bits_of(number) ^ (bits & kSign);
  std::memcpy(&number, &changed, sizeof number);
  return number;
}

HWY_INLINE void place_quarter(const Angle& angle, double& sine, double& cosine) {
  const double s = sin_polynomial(angle.remainder);
  const double c = cos_polynomial(angle.remainder);
  // Behind an odd number of quarters sine and cosine change places. The sine is negative behind two
  // and three, the cosine behind one and two.
  const std::uint64_t odd = bits_of(angle.quarters) << 63;
  const std::uint64_t half = bits_of(angle.quarters) << 62;
  sine = with_sign(odd != 0 ? c : s, half);
  cosine = with_sign(odd != 0 ? s : c, half ^ odd);
}

/// Whole turns are subtracted exactly; values that are not finite give NaN.
HWY_INLINE void far_degrees(double angle, double& sine, double& cosine) {
  place_quarter(reduce_degrees(std::remainder(angle, 360.0)), sine, cosine);
}

HWY_INLINE void far_radians(double angle, double& sine, double& cosine) {
  sine = std::sin(angle);
  cosine = std::cos(angle);
}

/// Sines and cosines of a block of angles; those beyond `most`, or not finite, one at a time.
template <Angle (*kReduce)(double), void (*kFar)(double, double&, double&)>
HWY_INLINE void sincos_block(const double* HWY_RESTRICT angles, double most,
                             double* HWY_RESTRICT sines, double* HWY_RESTRICT cosines) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    place_quarter(kReduce(angles[i]), sines[i], cosines[i]);
  }
  std::uint64_t is_any_far = 0;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double size = angles[i] < 0 ? -angles[i] : angles[i];
    is_any_far |= size <= most ? 0u : 1u;
  }
  if (is_any_far == 0) return;
  for (std::size_t i = 0; i < kBlock; ++i) {
    if (!(std::abs(angles[i]) <= most)) kFar(angles[i], sines[i], cosines[i]);
  }
}

/// Multiples of 90 degrees are exact; the error is below 1.5 units in the last place.
inline HWY_NOINLINE void sincos_degrees(const double* angles, double* sines, double* cosines) {
  sincos_block<reduce_degrees, far_degrees>(angles, kMostDegrees, sines, cosines);
}

inline HWY_NOINLINE void sincos_radians(const double* angles, double* sines, double* cosines) {
  sincos_block<reduce_radians, far_radians>(angles, kMostRadians, sines, cosines);
}

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
