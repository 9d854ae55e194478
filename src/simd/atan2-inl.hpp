// SPDX-License-Identifier: MIT
// Included once for every instruction set, so without an include guard. Like sincos-inl.hpp,
// without branches or calls, with the same bits on every machine.

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {

/// atan(r) - r, as a factor of -r, for |r| <= 7 / 16 (fdlibm, s_atan.c).
HWY_INLINE double atan_polynomial(double r) {
  const double z = r * r;
  const double w = z * z;
  const double odd =
      z * (3.33333333333329318027e-01 +
           w * (1.42857142725034663711e-01 +
                w * (9.09088713343650656196e-02 +
                     w * (6.66107313738753120669e-02 +
                          w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
  const double even =
      w * (-1.99999999998764832476e-01 +
           w * (-1.11111104054623557880e-01 +
                w * (-7.69187620504482999495e-02 +
                     w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
  return odd + even;
}

/// The angle of the point (x, y), -pi to pi. The signs of zeros count in y and not in x.
HWY_INLINE double atan2_of(double y, double x) {
  // Each constant as the nearest double and its rounding error.
  constexpr double kHalfPi = 1.57079632679489655800e+00;
  constexpr double kHalfPiRest = 6.12323399573676603587e-17;
  constexpr double kTanOfEighth = 0.41421356237309503;  // of pi / 8, half way between 0 and pi / 4
  const double height = std::fabs(y);
  const double width = std::fabs(x);
  const double small = height < width ? height : width;
  const double large = height < width ? width : height;
  // atan(s / l) = pi / 4 + atan((s - l) / (s + l)): never far from zero, and one division.
  const double eighths = small > kTanOfEighth * large ? 1.0 : 0.0;
  const double above = small - eighths * large;
  const double below = large + eighths * small;
  const double r = above / (below == 0 ? 1.0 : below);
  const double in_octant =
      eighths * (0.5 * kHalfPi) - ((r * atan_polynomial(r) - eighths * (0.5 * kHalfPiRest)) - r);
  const double from_right = kHalfPi - (in_octant - kHalfPiRest);
  const double in_quadrant = height > width ? from_right : in_octant;
  const double from_left = 2 * kHalfPi - (in_quadrant - 2 * kHalfPiRest);
  return std::copysign(x < 0 ? from_left : in_quadrant, y);
}

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
