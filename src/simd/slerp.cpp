// SPDX-License-Identifier: MIT
// Like forward_kinematics.cpp: simple loops over blocks, compiled once for every instruction set,
// with the same bits from each.

#include "simd/slerp.hpp"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#ifdef __EMSCRIPTEN__
#define HWY_COMPILE_ONLY_EMU128  // WebAssembly has no vectors of doubles in Highway 1.0
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/slerp.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/atan2-inl.hpp"
#include "simd/block_rows-inl.hpp"
#include "simd/sincos-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
namespace {  // names that another kernel may have, too

HWY_INLINE void dot(const QuaternionRows& a, const QuaternionRows& b, BlockRow& product) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    product.v[i] = a[0].v[i] * b[0].v[i] + a[1].v[i] * b[1].v[i] + a[2].v[i] * b[2].v[i] +
                   a[3].v[i] * b[3].v[i];
  }
}

/// -1 for quaternions on different sides, 1 for others.
HWY_INLINE void find_sides(const QuaternionRows& a, const QuaternionRows& b, BlockRow& sides) {
  dot(a, b, sides);
  for (std::size_t i = 0; i < kBlock; ++i) sides.v[i] = sides.v[i] < 0 ? -1.0 : 1.0;
}

HWY_INLINE void scale(const BlockRow& factors, QuaternionRows& q) {
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
  for (std::size_t k = 0; k < 4; ++k) {
    const double* const numbers = quaternions[k].data();
    for (std::size_t i = 0; i < kBlock; ++i) {
      ends.from[k].v[i] = numbers[places[i].from];
      ends.to[k].v[i] = numbers[places[i].to];
    }
  }
}

/// Loads a block of places, with both ends on the side of the first; `sides` are the signs applied.
HWY_INLINE void load_near(const Quaternions& quaternions, const Between* places, Ends& ends,
                          BlockRow& sides, BlockRow& t) {
  load_ends(quaternions, places, ends);
  for (std::size_t i = 0; i < kBlock; ++i) t.v[i] = places[i].t;
  find_sides(ends.from, ends.to, sides);
  scale(sides, ends.to);
}

/// Along the great circle from one end to the other, regardless of their sides.
HWY_INLINE void slerp_one_way(const Ends& ends, const BlockRow& t, QuaternionRows& out) {
  constexpr double kNearlyEqual = 1e-8;  // the chord differs from the arc by less than a bit
  BlockRow cosine, sine, part, sin_part, cos_part;
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

// Blocks are said to be hot: gcc 12 takes loops behind many checks for rare ones, and makes no
// vectors of them.
[[gnu::hot]] void slerp_block(const Quaternions& quaternions, const Between* places,
                              std::size_t first, Quaternions& out) {
  Ends ends;
  BlockRow sides, t;
  QuaternionRows q;
  load_near(quaternions, places, ends, sides, t);
  slerp_one_way(ends, t, q);
  store(q, first, out);
}

[[gnu::hot]] void squad_block(const Quaternions& quaternions, const Quaternions& controls,
                              const Between* places, std::size_t first, Quaternions& out) {
  Ends ends, inner_ends, middle;
  BlockRow sides, t, inwards;
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

using VectorRows = std::array<BlockRow, 3>;

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
  BlockRow angle, sine, cosine;
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

[[gnu::hot]] void squad_controls_block(const Quaternions& quaternions, const Neighbours* neighbours,
                                       std::size_t first, Quaternions& controls) {
  QuaternionRows at, before, after, control;
  VectorRows sum{};
  BlockRow factors;
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

[[gnu::hot]] void nlerp_block(const Quaternions& quaternions, const Between* places,
                              std::size_t first, Quaternions& out) {
  Ends ends;
  BlockRow sides, t;
  QuaternionRows q;
  load_near(quaternions, places, ends, sides, t);
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < kBlock; ++i) {
      q[k].v[i] = (1 - t.v[i]) * ends.from[k].v[i] + t.v[i] * ends.to[k].v[i];
    }
  }
  store(q, first, out);
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

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinefile::simd {
namespace {

HWY_EXPORT(slerp_all);
HWY_EXPORT(nlerp_all);
HWY_EXPORT(squad_controls_all);
HWY_EXPORT(squad_all);

template <std::size_t kSize>
void resize(Components<kSize>& components, std::size_t count) {
  assert(count % kBlock == 0);
  for (auto& component : components) component.resize(count);
}

}  // namespace

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

}  // namespace kinefile::simd
#endif  // HWY_ONCE
