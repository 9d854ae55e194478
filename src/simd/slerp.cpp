// SPDX-License-Identifier: MIT
// Like forward_kinematics.cpp: simple loops over blocks, compiled once for every instruction set,
// with the same bits from each.

#include "simd/slerp.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#ifdef __EMSCRIPTEN__
#define HWY_COMPILE_ONLY_EMU128  // WebAssembly has no vectors of doubles in Highway 1.0
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/slerp.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/atan2-inl.hpp"
#include "simd/sincos-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
namespace {  // names that another kernel may have, too

/// One number in every lane of a block.
struct alignas(64) Row {
  double v[kBlock];
};

using QuaternionRows = std::array<Row, 4>;

/// The angle plus whole turns that is nearest to `near`; the number of turns is rounded as in
/// sincos.
HWY_INLINE double nearest_turn(double angle, double near, double turn) {
  const double turns = ((near - angle) * (1 / turn) + kRounder) - kRounder;
  return angle + turns * turn;
}

HWY_INLINE void load(const Quaternions& from, std::size_t first, QuaternionRows& rows) {
  for (std::size_t k = 0; k < 4; ++k) {
    const double* HWY_RESTRICT numbers = from[k].data() + first;
    for (std::size_t i = 0; i < kBlock; ++i) rows[k].v[i] = numbers[i];
  }
}

HWY_INLINE void store(const QuaternionRows& rows, std::size_t first, Quaternions& to) {
  for (std::size_t k = 0; k < 4; ++k) {
    double* HWY_RESTRICT numbers = to[k].data() + first;
    for (std::size_t i = 0; i < kBlock; ++i) numbers[i] = rows[k].v[i];
  }
}

void quaternions_of_block(const EulerForm& form, const Angles& angles, std::size_t first,
                          Quaternions& quaternions) {
  const double* HWY_RESTRICT a = angles[0].data() + first;
  const double* HWY_RESTRICT b = angles[1].data() + first;
  const double* HWY_RESTRICT c = angles[2].data() + first;
  Row plus, minus, middle;
  for (std::size_t i = 0; i < kBlock; ++i) {
    plus.v[i] = 0.5 * (a[i] + form.sign * c[i]);
    minus.v[i] = 0.5 * (a[i] - form.sign * c[i]);
    middle.v[i] = 0.5 * (b[i] - form.shift);
  }
  Row sin_plus, cos_plus, sin_minus, cos_minus, sin_middle, cos_middle;
  const auto sincos_of = form.is_in_degrees ? sincos_degrees : sincos_radians;
  sincos_of(plus.v, sin_plus.v, cos_plus.v);
  sincos_of(minus.v, sin_minus.v, cos_minus.v);
  sincos_of(middle.v, sin_middle.v, cos_middle.v);
  QuaternionRows q;
  for (std::size_t i = 0; i < kBlock; ++i) {
    q[0].v[i] = cos_middle.v[i] * cos_plus.v[i];
    q[1].v[i] = cos_middle.v[i] * sin_plus.v[i];
    q[2].v[i] = sin_middle.v[i] * cos_minus.v[i];
    q[3].v[i] = sin_middle.v[i] * sin_minus.v[i];
  }
  store(q, first, quaternions);
}

/// The half angles of a block, in the unit of the angles.
struct HalfAngles {
  Row plus;    ///< (a + sign c) / 2
  Row minus;   ///< (a - sign c) / 2
  Row middle;  ///< b - shift, not halved
};

/// \param near  the angles that are used in gimbal lock
HWY_INLINE void half_angles(const EulerForm& form, const QuaternionRows& q, const HalfAngles& near,
                            HalfAngles& found) {
  constexpr double kLocked = 1e-13;
  const double per_radian = form.is_in_degrees ? 180 / std::numbers::pi : 1;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double outer = std::sqrt(q[0].v[i] * q[0].v[i] + q[1].v[i] * q[1].v[i]);
    const double inner = std::sqrt(q[2].v[i] * q[2].v[i] + q[3].v[i] * q[3].v[i]);
    const double plus = per_radian * atan2_of(q[1].v[i], q[0].v[i]);
    const double minus = per_radian * atan2_of(q[3].v[i], q[2].v[i]);
    found.plus.v[i] = outer <= kLocked * inner ? near.plus.v[i] : plus;
    found.minus.v[i] = inner <= kLocked * outer ? near.minus.v[i] : minus;
    found.middle.v[i] = 2 * per_radian * atan2_of(inner, outer);
  }
}

void half_angles_of_block(const EulerForm& form, const Quaternions& quaternions, std::size_t first,
                          Angles& halves) {
  QuaternionRows q;
  const HalfAngles nothing_near{};
  HalfAngles found;
  load(quaternions, first, q);
  half_angles(form, q, nothing_near, found);
  const std::array<const Row*, 3> rows = {&found.plus, &found.minus, &found.middle};
  for (std::size_t k = 0; k < 3; ++k) {
    double* HWY_RESTRICT out = halves[k].data() + first;
    for (std::size_t i = 0; i < kBlock; ++i) out[i] = rows[k]->v[i];
  }
}

/// Two triples of angles for the same rotation: their middle angles have opposite signs.
struct Candidates {
  std::array<Row, 3> first;
  std::array<Row, 3> second;
};

HWY_INLINE void find_candidates(const EulerForm& form, const HalfAngles& found, Candidates& out) {
  const double half_turn = form.is_in_degrees ? 180 : std::numbers::pi;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double a = found.plus.v[i] + found.minus.v[i];
    const double c = form.sign * (found.plus.v[i] - found.minus.v[i]);
    out.first[0].v[i] = a;
    out.first[1].v[i] = form.shift + found.middle.v[i];
    out.first[2].v[i] = c;
    out.second[0].v[i] = a + half_turn;
    out.second[1].v[i] = form.shift - found.middle.v[i];
    out.second[2].v[i] = c + half_turn;
  }
}

/// Replaces given angles by the nearer of two triples.
HWY_INLINE void choose_nearer(double turn, Candidates& candidates, std::size_t first,
                              Angles& angles) {
  Row gain;  // the difference of the squared distances; positive if the second is nearer
  for (std::size_t i = 0; i < kBlock; ++i) gain.v[i] = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double* HWY_RESTRICT near = angles[k].data() + first;
    Row& a = candidates.first[k];
    Row& b = candidates.second[k];
    for (std::size_t i = 0; i < kBlock; ++i) {
      a.v[i] = nearest_turn(a.v[i], near[i], turn);
      b.v[i] = nearest_turn(b.v[i], near[i], turn);
      const double from_a = a.v[i] - near[i];
      const double from_b = b.v[i] - near[i];
      gain.v[i] += from_a * from_a - from_b * from_b;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    double* HWY_RESTRICT out = angles[k].data() + first;
    for (std::size_t i = 0; i < kBlock; ++i) {
      const double a = candidates.first[k].v[i];
      const double b = candidates.second[k].v[i];
      out[i] = gain.v[i] > 0 ? b : a;
    }
  }
}

void angles_of_block(const EulerForm& form, const Quaternions& quaternions, std::size_t first,
                     Angles& angles) {
  const double* HWY_RESTRICT a = angles[0].data() + first;
  const double* HWY_RESTRICT c = angles[2].data() + first;
  QuaternionRows q;
  HalfAngles near;
  HalfAngles found;
  Candidates candidates;
  load(quaternions, first, q);
  for (std::size_t i = 0; i < kBlock; ++i) {
    near.plus.v[i] = 0.5 * (a[i] + form.sign * c[i]);
    near.minus.v[i] = 0.5 * (a[i] - form.sign * c[i]);
  }
  half_angles(form, q, near, found);
  find_candidates(form, found, candidates);
  choose_nearer(form.is_in_degrees ? 360 : 2 * std::numbers::pi, candidates, first, angles);
}

HWY_INLINE void dot(const QuaternionRows& a, const QuaternionRows& b, Row& product) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    product.v[i] = a[0].v[i] * b[0].v[i] + a[1].v[i] * b[1].v[i] + a[2].v[i] * b[2].v[i] +
                   a[3].v[i] * b[3].v[i];
  }
}

/// -1 for quaternions on different sides, 1 for others.
HWY_INLINE void find_sides(const QuaternionRows& a, const QuaternionRows& b, Row& sides) {
  dot(a, b, sides);
  for (std::size_t i = 0; i < kBlock; ++i) sides.v[i] = sides.v[i] < 0 ? -1.0 : 1.0;
}

HWY_INLINE void scale(const Row& factors, QuaternionRows& q) {
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < kBlock; ++i) q[k].v[i] *= factors.v[i];
  }
}

/// The quaternions at both ends of a block of places.
struct Ends {
  QuaternionRows from;
  QuaternionRows to;
};

HWY_INLINE void load_ends(const Quaternions& quaternions, const Between* places, Ends& ends) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      ends.from[k].v[i] = quaternions[k][places[i].from];
      ends.to[k].v[i] = quaternions[k][places[i].to];
    }
  }
}

/// Loads a block of places, with both ends on the side of the first; `sides` are the signs applied.
HWY_INLINE void load_near(const Quaternions& quaternions, const Between* places, Ends& ends,
                          Row& sides, Row& t) {
  load_ends(quaternions, places, ends);
  for (std::size_t i = 0; i < kBlock; ++i) t.v[i] = places[i].t;
  find_sides(ends.from, ends.to, sides);
  scale(sides, ends.to);
}

/// Along the great circle from one end to the other, regardless of their sides.
HWY_INLINE void slerp_one_way(const Ends& ends, const Row& t, QuaternionRows& out) {
  constexpr double kNearlyEqual = 1e-8;  // the chord differs from the arc by less than a bit
  Row cosine, sine, part, sin_part, cos_part;
  QuaternionRows across;
  dot(ends.from, ends.to, cosine);
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < kBlock; ++i) {
      across[k].v[i] = ends.to[k].v[i] - cosine.v[i] * ends.from[k].v[i];
    }
  }
  dot(across, across, sine);
  for (std::size_t i = 0; i < kBlock; ++i) {
    sine.v[i] = std::sqrt(sine.v[i]);
    const double angle = atan2_of(sine.v[i], cosine.v[i]);
    part.v[i] = t.v[i] * (sine.v[i] < kNearlyEqual ? 0.0 : angle);
  }
  sincos_radians(part.v, sin_part.v, cos_part.v);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double along = t.v[i];
    const double ratio = sin_part.v[i] / sine.v[i];
    sin_part.v[i] = sine.v[i] < kNearlyEqual ? along : ratio;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < kBlock; ++i) {
      out[k].v[i] = cos_part.v[i] * ends.from[k].v[i] + sin_part.v[i] * across[k].v[i];
    }
  }
}

void slerp_block(const Quaternions& quaternions, const Between* places, std::size_t first,
                 Quaternions& out) {
  Ends ends;
  Row sides, t;
  QuaternionRows q;
  load_near(quaternions, places, ends, sides, t);
  slerp_one_way(ends, t, q);
  store(q, first, out);
}

void squad_block(const Quaternions& quaternions, const Quaternions& controls, const Between* places,
                 std::size_t first, Quaternions& out) {
  Ends ends, inner_ends, middle;
  Row sides, t, inwards;
  QuaternionRows q;
  load_near(quaternions, places, ends, sides, t);
  load_ends(controls, places, inner_ends);
  scale(sides, inner_ends.to);  // a control point has the sign of its quaternion
  slerp_one_way(ends, t, middle.from);
  slerp_one_way(inner_ends, t, middle.to);
  for (std::size_t i = 0; i < kBlock; ++i) inwards.v[i] = 2 * t.v[i] * (1 - t.v[i]);
  slerp_one_way(middle, inwards, q);
  store(q, first, out);
}

using VectorRows = std::array<Row, 3>;

/// Adds the logarithm of conjugate(a) b, or of its negative if that is shorter.
HWY_INLINE void add_log(const QuaternionRows& a, const QuaternionRows& b, VectorRows& sum) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double aw = a[0].v[i], ax = a[1].v[i], ay = a[2].v[i], az = a[3].v[i];
    const double bw = b[0].v[i], bx = b[1].v[i], by = b[2].v[i], bz = b[3].v[i];
    const double w = aw * bw + ax * bx + ay * by + az * bz;
    const double x = aw * bx - ax * bw - ay * bz + az * by;
    const double y = aw * by + ax * bz - ay * bw - az * bx;
    const double z = aw * bz - ax * by + ay * bx - az * bw;
    const double sine = std::sqrt(x * x + y * y + z * z);
    const double angle = atan2_of(sine, std::fabs(w));
    const double size = sine == 0 ? 1.0 : angle / (sine == 0 ? 1.0 : sine);
    const double factor = (w < 0 ? -1.0 : 1.0) * size;
    sum[0].v[i] += factor * x;
    sum[1].v[i] += factor * y;
    sum[2].v[i] += factor * z;
  }
}

/// a exp(v)
HWY_INLINE void multiply_exp(const QuaternionRows& a, const VectorRows& v, QuaternionRows& out) {
  Row angle, sine, cosine;
  for (std::size_t i = 0; i < kBlock; ++i) {
    angle.v[i] = std::sqrt(v[0].v[i] * v[0].v[i] + v[1].v[i] * v[1].v[i] + v[2].v[i] * v[2].v[i]);
  }
  sincos_radians(angle.v, sine.v, cosine.v);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double ratio = sine.v[i] / (angle.v[i] == 0 ? 1.0 : angle.v[i]);
    const double factor = angle.v[i] == 0 ? 1.0 : ratio;
    const double aw = a[0].v[i], ax = a[1].v[i], ay = a[2].v[i], az = a[3].v[i];
    const double w = cosine.v[i];
    const double x = factor * v[0].v[i], y = factor * v[1].v[i], z = factor * v[2].v[i];
    out[0].v[i] = aw * w - ax * x - ay * y - az * z;
    out[1].v[i] = aw * x + ax * w + ay * z - az * y;
    out[2].v[i] = aw * y - ax * z + ay * w + az * x;
    out[3].v[i] = aw * z + ax * y - ay * x + az * w;
  }
}

void squad_controls_block(const Quaternions& quaternions, const Neighbours* neighbours,
                          std::size_t first, Quaternions& controls) {
  QuaternionRows at, before, after, control;
  VectorRows sum{};
  Row factors;
  load(quaternions, first, at);
  for (std::size_t i = 0; i < kBlock; ++i) {
    const bool has_both = neighbours[i].before != first + i && neighbours[i].after != first + i;
    factors.v[i] = has_both ? -0.25 : 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      before[k].v[i] = quaternions[k][neighbours[i].before];
      after[k].v[i] = quaternions[k][neighbours[i].after];
    }
  }
  add_log(at, before, sum);
  add_log(at, after, sum);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < kBlock; ++i) sum[k].v[i] *= factors.v[i];
  }
  multiply_exp(at, sum, control);
  store(control, first, controls);
}

void nlerp_block(const Quaternions& quaternions, const Between* places, std::size_t first,
                 Quaternions& out) {
  Ends ends;
  Row sides, t;
  QuaternionRows q;
  load_near(quaternions, places, ends, sides, t);
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < kBlock; ++i) {
      q[k].v[i] = (1 - t.v[i]) * ends.from[k].v[i] + t.v[i] * ends.to[k].v[i];
    }
  }
  store(q, first, out);
}

void quaternions_of_all(const EulerForm& form, const Angles& angles, Quaternions& quaternions) {
  for (std::size_t first = 0; first < angles[0].size(); first += kBlock) {
    quaternions_of_block(form, angles, first, quaternions);
  }
}

void angles_of_all(const EulerForm& form, const Quaternions& quaternions, Angles& angles) {
  for (std::size_t first = 0; first < angles[0].size(); first += kBlock) {
    angles_of_block(form, quaternions, first, angles);
  }
}

void half_angles_of_all(const EulerForm& form, const Quaternions& quaternions, Angles& halves) {
  for (std::size_t first = 0; first < halves[0].size(); first += kBlock) {
    half_angles_of_block(form, quaternions, first, halves);
  }
}

void slerp_all(const Quaternions& quaternions, const std::vector<Between>& places,
               Quaternions& out) {
  for (std::size_t first = 0; first < places.size(); first += kBlock) {
    slerp_block(quaternions, places.data() + first, first, out);
  }
}

void nlerp_all(const Quaternions& quaternions, const std::vector<Between>& places,
               Quaternions& out) {
  for (std::size_t first = 0; first < places.size(); first += kBlock) {
    nlerp_block(quaternions, places.data() + first, first, out);
  }
}

void squad_controls_all(const Quaternions& quaternions, const std::vector<Neighbours>& neighbours,
                        Quaternions& controls) {
  for (std::size_t first = 0; first < neighbours.size(); first += kBlock) {
    squad_controls_block(quaternions, neighbours.data() + first, first, controls);
  }
}

void squad_all(const Quaternions& quaternions, const Quaternions& controls,
               const std::vector<Between>& places, Quaternions& out) {
  for (std::size_t first = 0; first < places.size(); first += kBlock) {
    squad_block(quaternions, controls, places.data() + first, first, out);
  }
}

void atan2_all(const double* HWY_RESTRICT y, const double* HWY_RESTRICT x, std::size_t count,
               double* HWY_RESTRICT angles) {
  for (std::size_t first = 0; first < count; first += kBlock) {
    for (std::size_t i = first; i < first + kBlock; ++i) angles[i] = atan2_of(y[i], x[i]);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinefile::simd {
namespace {

HWY_EXPORT(quaternions_of_all);
HWY_EXPORT(angles_of_all);
HWY_EXPORT(half_angles_of_all);
HWY_EXPORT(slerp_all);
HWY_EXPORT(nlerp_all);
HWY_EXPORT(squad_controls_all);
HWY_EXPORT(squad_all);
HWY_EXPORT(atan2_all);

template <std::size_t kSize>
void resize(Components<kSize>& components, std::size_t count) {
  assert(count % kBlock == 0);
  for (auto& component : components) component.resize(count);
}

}  // namespace

void quaternions_of_angles(const EulerForm& form, const Angles& angles, Quaternions& quaternions) {
  resize(quaternions, angles[0].size());
  HWY_DYNAMIC_DISPATCH(quaternions_of_all)(form, angles, quaternions);
}

void angles_of_quaternions(const EulerForm& form, const Quaternions& quaternions, Angles& angles) {
  assert(quaternions[0].size() == angles[0].size());
  HWY_DYNAMIC_DISPATCH(angles_of_all)(form, quaternions, angles);
}

void half_angles_of_quaternions(const EulerForm& form, const Quaternions& quaternions,
                                Angles& halves) {
  resize(halves, quaternions[0].size());
  HWY_DYNAMIC_DISPATCH(half_angles_of_all)(form, quaternions, halves);
}

void slerp(const Quaternions& quaternions, const std::vector<Between>& places, Quaternions& out) {
  resize(out, places.size());
  HWY_DYNAMIC_DISPATCH(slerp_all)(quaternions, places, out);
}

void nlerp(const Quaternions& quaternions, const std::vector<Between>& places, Quaternions& out) {
  resize(out, places.size());
  HWY_DYNAMIC_DISPATCH(nlerp_all)(quaternions, places, out);
}

void squad_controls(const Quaternions& quaternions, const std::vector<Neighbours>& neighbours,
                    Quaternions& controls) {
  assert(quaternions[0].size() == neighbours.size());
  resize(controls, neighbours.size());
  HWY_DYNAMIC_DISPATCH(squad_controls_all)(quaternions, neighbours, controls);
}

void squad(const Quaternions& quaternions, const Quaternions& controls,
           const std::vector<Between>& places, Quaternions& out) {
  resize(out, places.size());
  HWY_DYNAMIC_DISPATCH(squad_all)(quaternions, controls, places, out);
}

void atan2(const std::vector<double>& y, const std::vector<double>& x,
           std::vector<double>& angles) {
  assert(y.size() % kBlock == 0 && x.size() == y.size());
  angles.resize(y.size());
  HWY_DYNAMIC_DISPATCH(atan2_all)(y.data(), x.data(), y.size(), angles.data());
}

}  // namespace kinefile::simd
#endif  // HWY_ONCE
