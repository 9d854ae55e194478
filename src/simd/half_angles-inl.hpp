// SPDX-License-Identifier: MIT
// Included once for every instruction set, behind lanes-inl.hpp, so without an include guard.
//
// Sines and cosines of half angles, up to the sign of both, which is all that a quaternion needs.
// A half angle is reduced to its remainder from the nearest quarter turn, in degrees without an
// error; behind an odd number of quarters sine and cosine change places. Errors are below 2.5e-16,
// or 2e-7.

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {

/// Some vectors whose functions are computed together: each step waits for the one before it, and
/// the others' steps fill that time.
template <class T>
struct Together {
  Lanes<T> v[kTogether];
};

/// Adding and subtracting 1.5 * 2^52, or 2^23, rounds to the nearest integer, which is then in the
/// last bits of the sum.
template <class T>
constexpr double kRounder = sizeof(T) == 8 ? 6755399441055744.0 : 12582912.0;

constexpr double kDegree = std::numbers::pi / 180;

/// Beyond this angle, in the angle's own unit, the reduction would lose digits.
constexpr double kMostDegrees = 90.0 * (1 << 20);
constexpr double kMostRadians = 1 << 20;

template <class T>
struct ReducedLanes {
  Lanes<T> quarters;   ///< whole quarter turns in the last bits
  Lanes<T> remainder;  ///< in radians, within an eighth of a turn
};

/// Half of an angle in degrees. The product and the difference are exact, so no digit is lost.
template <class T>
HWY_INLINE ReducedLanes<T> reduce_degrees(Lanes<T> degrees) {
  const Lanes<T> sum = degrees * fill<T>(1.0 / 180) + fill<T>(kRounder<T>);
  const Lanes<T> quarters = sum - fill<T>(kRounder<T>);
  return {sum, (degrees - quarters * fill<T>(180)) * fill<T>(kDegree / 2)};
}

HWY_INLINE ReducedLanes<double> reduce_radians(Lanes<double> radians) {
  // pi / 2 in three parts; the first two have 33 bits, so that their products are exact
  // (Cody and Waite, "Software Manual for the Elementary Functions", 1980; fdlibm e_rem_pio2.c).
  const auto part1 = fill<double>(1.57079632673412561417e+00);
  const auto part2 = fill<double>(6.07710050630396597660e-11);
  const auto part3 = fill<double>(2.02226624879595063154e-21);
  const auto angle = radians * fill<double>(0.5);
  const auto sum = angle * fill<double>(2 / std::numbers::pi) + fill<double>(kRounder<double>);
  const auto quarters = sum - fill<double>(kRounder<double>);
  return {sum, ((angle - quarters * part1) - quarters * part2) - quarters * part3};
}

/// A single angle has an error of its own already.
HWY_INLINE ReducedLanes<float> reduce_radians(Lanes<float> radians) {
  return reduce_degrees<float>(radians * fill<float>(1 / kDegree));
}

/// (c0 + c1 z) + z^2 ((c2 + c3 z) + z^2 (c4 + c5 z)): the brackets do not wait for each other.
HWY_INLINE void polynomials(const double (&c)[6], const Together<double>& z,
                            const Together<double>& square, Together<double>& out) {
  Together<double> low, middle;
  for (std::size_t i = 0; i < kTogether; ++i) {
    out.v[i] = fill<double>(c[4]) + fill<double>(c[5]) * z.v[i];
    middle.v[i] = fill<double>(c[2]) + fill<double>(c[3]) * z.v[i];
    low.v[i] = fill<double>(c[0]) + fill<double>(c[1]) * z.v[i];
  }
  for (std::size_t i = 0; i < kTogether; ++i) out.v[i] = middle.v[i] + square.v[i] * out.v[i];
  for (std::size_t i = 0; i < kTogether; ++i) out.v[i] = low.v[i] + square.v[i] * out.v[i];
}

HWY_INLINE void polynomials(const double (&c)[3], const Together<float>& z,
                            const Together<float>& square, Together<float>& out) {
  for (std::size_t i = 0; i < kTogether; ++i) {
    out.v[i] = (fill<float>(c[0]) + fill<float>(c[1]) * z.v[i]) + square.v[i] * fill<float>(c[2]);
  }
}

/// Minimax polynomials for |r| <= pi / 4.
template <class T>
struct Coefficients;

template <>
struct Coefficients<double> {  // fdlibm, k_sin.c and k_cos.c
  static constexpr double kSine[6] = {-1.66666666666666324348e-01, 8.33333333332248946124e-03,
                                      -1.98412698298579493134e-04, 2.75573137070700676789e-06,
                                      -2.50507602534068634195e-08, 1.58969099521155010221e-10};
  static constexpr double kCosine[6] = {4.16666666666666019037e-02, -1.38888888888741095749e-03,
                                        2.48015872894767294178e-05, -2.75573143513906633035e-07,
                                        2.08757232129817482790e-09, -1.13596475577881948265e-11};
};

template <>
struct Coefficients<float> {  // Cephes, sinf.c and cosf.c
  static constexpr double kSine[3] = {-1.6666654611e-1, 8.3321608736e-3, -1.9515295891e-4};
  static constexpr double kCosine[3] = {4.166664568298827e-2, -1.388731625493765e-3,
                                        2.443315711809948e-5};
};

/// Sines and cosines of remainders.
template <class T>
HWY_INLINE void sincos_polynomials(const Together<T>& r, Together<T>& sines, Together<T>& cosines) {
  Together<T> z, square;
  for (std::size_t i = 0; i < kTogether; ++i) z.v[i] = r.v[i] * r.v[i];
  for (std::size_t i = 0; i < kTogether; ++i) square.v[i] = z.v[i] * z.v[i];
  polynomials(Coefficients<T>::kSine, z, square, sines);
  polynomials(Coefficients<T>::kCosine, z, square, cosines);
  for (std::size_t i = 0; i < kTogether; ++i) {
    sines.v[i] = r.v[i] + r.v[i] * z.v[i] * sines.v[i];
    cosines.v[i] = (fill<T>(1) - fill<T>(0.5) * z.v[i]) + square.v[i] * cosines.v[i];
  }
}

/// `yes` where the sign bit is set, be it of a zero.
template <class T>
HWY_INLINE Lanes<T> by_sign_bit(Lanes<T> v, Lanes<T> yes, Lanes<T> no) {
#if HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_SSSE3
  // Without an instruction for it, Highway 1.0 does not see the sign of a zero.
  return hn::IfThenElse(hn::CopySign(fill<T>(1), v) < fill<T>(0), yes, no);
#else
  return hn::IfNegativeThenElse(v, yes, no);
#endif
}

/// Takes the quarters of a reduced angle into account: behind one, the cosine is the sine, and the
/// negative sine the cosine; two change the sign of both.
template <class T>
HWY_INLINE void place_quarter(Lanes<T> quarters, Lanes<T>& sine, Lanes<T>& cosine) {
  constexpr Tag<T> d;
  constexpr hn::RebindToUnsigned<Tag<T>> bits;
  constexpr int kSign = static_cast<int>(sizeof(T)) * 8 - 1;
  const auto is_odd = hn::BitCast(d, hn::ShiftLeft<kSign>(hn::BitCast(bits, quarters)));
  const Lanes<T> first = by_sign_bit<T>(is_odd, cosine, sine);
  const Lanes<T> second = by_sign_bit<T>(is_odd, sine, cosine);
  sine = first;
  cosine = hn::Xor(second, is_odd);
}

template <class T>
HWY_INLINE void near_sincos(const Together<T>& angles, bool is_in_degrees, Together<T>& sines,
                            Together<T>& cosines) {
  Together<T> quarters, remainders;
  for (std::size_t i = 0; i < kTogether; ++i) {
    const ReducedLanes<T> reduced =
        is_in_degrees ? reduce_degrees<T>(angles.v[i]) : reduce_radians(angles.v[i]);
    quarters.v[i] = reduced.quarters;
    remainders.v[i] = reduced.remainder;
  }
  sincos_polynomials<T>(remainders, sines, cosines);
  for (std::size_t i = 0; i < kTogether; ++i) {
    place_quarter<T>(quarters.v[i], sines.v[i], cosines.v[i]);
  }
}

/// One angle that is far or not finite, which gives NaN. In degrees whole turns are subtracted,
/// exactly.
inline void far_sincos(double angle, bool is_in_degrees, double& sine, double& cosine) {
  const double half = is_in_degrees ? std::remainder(angle, 360.0) * (kDegree / 2) : 0.5 * angle;
  sine = std::sin(half);
  cosine = std::cos(half);
}

/// Corrects those of angles that are far.
HWY_NOINLINE inline void place_far(const Together<double>& angles, bool is_in_degrees, double most,
                                   Together<double>& sines, Together<double>& cosines) {
  constexpr Tag<double> d;
  alignas(64) double angle[kLanes<double>];
  alignas(64) double sine[kLanes<double>];
  alignas(64) double cosine[kLanes<double>];
  for (std::size_t i = 0; i < kTogether; ++i) {
    hn::Store(angles.v[i], d, angle);
    hn::Store(sines.v[i], d, sine);
    hn::Store(cosines.v[i], d, cosine);
    for (std::size_t k = 0; k < kLanes<double>; ++k) {
      if (!(std::abs(angle[k]) <= most)) far_sincos(angle[k], is_in_degrees, sine[k], cosine[k]);
    }
    sines.v[i] = hn::Load(d, sine);
    cosines.v[i] = hn::Load(d, cosine);
  }
}

HWY_INLINE void half_sincos(const Together<double>& angles, bool is_in_degrees,
                            Together<double>& sines, Together<double>& cosines) {
  constexpr Tag<double> d;
  const double most = is_in_degrees ? kMostDegrees : kMostRadians;
  near_sincos<double>(angles, is_in_degrees, sines, cosines);
  auto are_near = hn::Abs(angles.v[0]) <= fill<double>(most);
  for (std::size_t i = 1; i < kTogether; ++i) {
    are_near = hn::And(are_near, hn::Abs(angles.v[i]) <= fill<double>(most));
  }
  if (HWY_UNLIKELY(!hn::AllTrue(d, are_near))) {
    place_far(angles, is_in_degrees, most, sines, cosines);
  }
}

/// For angles that are within a turn, or not finite (see `angles_of`).
HWY_INLINE void half_sincos(const Together<float>& angles, bool is_in_degrees,
                            Together<float>& sines, Together<float>& cosines) {
  near_sincos<float>(angles, is_in_degrees, sines, cosines);
}

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
