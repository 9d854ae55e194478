// SPDX-License-Identifier: MIT
// Short loops over blocks, compiled once for every instruction set, with the same bits from each.

#include "simd/angles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#ifdef __EMSCRIPTEN__
#define HWY_COMPILE_ONLY_EMU128  // WebAssembly has no vectors of doubles in Highway 1.0
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/angles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/atan2-inl.hpp"
#include "simd/block_rows-inl.hpp"
#include "simd/frame_lanes-inl.hpp"
#include "simd/sincos-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
namespace {  // names that another kernel may have, too

/// The angle plus whole turns that is nearest to `near`; the number of turns is rounded as in
/// sincos.
HWY_INLINE double nearest_turn(double angle, double near, double turn) {
  const double turns = ((near - angle) * (1 / turn) + kRounder) - kRounder;
  return angle + turns * turn;
}

void quaternions_of_block(const EulerForm& form, const Angles& angles, std::size_t first,
                          Quaternions& quaternions) {
  const double* HWY_RESTRICT a = angles[0].data() + first;
  const double* HWY_RESTRICT b = angles[1].data() + first;
  const double* HWY_RESTRICT c = angles[2].data() + first;
  BlockRow plus, minus, middle;
  for (std::size_t i = 0; i < kBlock; ++i) {
    plus.v[i] = 0.5 * (a[i] + form.sign * c[i]);
    minus.v[i] = 0.5 * (a[i] - form.sign * c[i]);
    middle.v[i] = 0.5 * (b[i] - form.shift);
  }
  BlockRow sin_plus, cos_plus, sin_minus, cos_minus, sin_middle, cos_middle;
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

/// Some blocks of numbers of one kind.
constexpr std::size_t kBlocks = 8;
using Numbers = std::array<BlockRow, kBlocks>;

/// Half of the angles of a turn in some rows; zeros behind them.
HWY_INLINE void load_halves(const Rows& rows, const Input& input, Numbers& halves) {
  double* HWY_RESTRICT out = halves[0].v;
  const double* from = rows.values + input.coordinate;
  for (std::size_t i = 0; i < rows.num_frames; ++i) out[i] = from[i * rows.stride];
  std::fill(out + rows.num_frames, out + padded(rows.num_frames), 0.0);
  const bool is_plain = input.gain == 1 && input.shift == 0;
  for (std::size_t i = 0; i < padded(rows.num_frames); ++i) {
    out[i] = 0.5 * (is_plain ? out[i] : input.gain * out[i] + input.shift);
  }
}

/// Multiplies the rotations of a block by those of a turn, on the right.
HWY_INLINE void turn_block(const Turn& turn, const BlockRow& sines, const BlockRow& cosines,
                           QuaternionRows& q) {
  const double ax = turn.direction[0], ay = turn.direction[1], az = turn.direction[2];
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double w = q[0].v[i], x = q[1].v[i], y = q[2].v[i], z = q[3].v[i];
    const double c = cosines.v[i], s = sines.v[i];
    q[0].v[i] = c * w - s * (ax * x + ay * y + az * z);
    q[1].v[i] = c * x + s * (ax * w + az * y - ay * z);
    q[2].v[i] = c * y + s * (ay * w + ax * z - az * x);
    q[3].v[i] = c * z + s * (az * w + ay * x - ax * y);
  }
}

void quaternions_of_all(const EulerForm& form, const Angles& angles, Quaternions& quaternions) {
  for (std::size_t first = 0; first < angles[0].size(); first += kBlock) {
    quaternions_of_block(form, angles, first, quaternions);
  }
}

/// The rotations of a first turn: those of `turn_block` after no turn.
HWY_INLINE void begin_block(const Turn& turn, const BlockRow& sines, const BlockRow& cosines,
                            QuaternionRows& q) {
  for (std::size_t i = 0; i < kBlock; ++i) q[0].v[i] = cosines.v[i] - sines.v[i] * 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = turn.direction[k];
    for (std::size_t i = 0; i < kBlock; ++i) {
      q[k + 1].v[i] = cosines.v[i] * 0.0 + sines.v[i] * along;
    }
  }
}

/// \param rows  up to kBlocks blocks
void products_of_blocks(std::span<const Turn> turns, bool is_in_degrees, const Rows& rows,
                        std::size_t first, Quaternions& out) {
  const auto sincos_of = is_in_degrees ? sincos_degrees : sincos_radians;
  const std::size_t num_blocks = padded(rows.num_frames) / kBlock;
  std::array<QuaternionRows, kBlocks> products;
  for (std::size_t t = 0; t < turns.size(); ++t) {
    Numbers halves;
    load_halves(rows, turns[t].input, halves);
    for (std::size_t b = 0; b < num_blocks; ++b) {
      BlockRow sines, cosines;
      sincos_of(halves[b].v, sines.v, cosines.v);
      if (t == 0) {
        begin_block(turns[t], sines, cosines, products[b]);
      } else {
        turn_block(turns[t], sines, cosines, products[b]);
      }
    }
  }
  for (std::size_t b = 0; b < num_blocks; ++b) store(products[b], first + b * kBlock, out);
}

void products_of_all(std::span<const Turn> turns, bool is_in_degrees, const Rows& rows,
                     Quaternions& out) {
  if (turns.empty()) {
    std::fill(out[0].begin(), out[0].end(), 1.0);
    for (std::size_t k = 1; k < 4; ++k) std::fill(out[k].begin(), out[k].end(), 0.0);
    return;
  }
  constexpr std::size_t kFrames = kBlocks * kBlock;
  for (std::size_t first = 0; first < rows.num_frames; first += kFrames) {
    const Rows some{rows.values + first * rows.stride, std::min(kFrames, rows.num_frames - first),
                    rows.stride};
    products_of_blocks(turns, is_in_degrees, some, first, out);
  }
}

HWY_INLINE void turn_vectors(const Matrix& turn, QuaternionRows& q) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double x = q[1].v[i], y = q[2].v[i], z = q[3].v[i];
    q[1].v[i] = turn[0][0] * x + turn[1][0] * y + turn[2][0] * z;
    q[2].v[i] = turn[0][1] * x + turn[1][1] * y + turn[2][1] * z;
    q[3].v[i] = turn[0][2] * x + turn[1][2] * y + turn[2][2] * z;
  }
}

/// A quarter turn back about the second axis, not normalised.
HWY_INLINE void turn_quarter(QuaternionRows& q) {
  for (std::size_t i = 0; i < kBlock; ++i) {
    const double w = q[0].v[i], x = q[1].v[i], y = q[2].v[i], z = q[3].v[i];
    q[0].v[i] = w + y;
    q[1].v[i] = x + z;
    q[2].v[i] = y - w;
    q[3].v[i] = z - x;
  }
}

void turn_all(const Matrix& turn, bool has_quarter, Quaternions& quaternions) {
  for (std::size_t first = 0; first < quaternions[0].size(); first += kBlock) {
    QuaternionRows q;
    load(quaternions, first, q);
    turn_vectors(turn, q);
    if (has_quarter) turn_quarter(q);
    store(q, first, quaternions);
  }
}

/// The half angles of a block, in the unit of the angles.
struct HalfAngles {
  BlockRow plus;    ///< (a + sign c) / 2
  BlockRow minus;   ///< (a - sign c) / 2
  BlockRow middle;  ///< b - shift, not halved
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
  const std::array<const BlockRow*, 3> rows = {&found.plus, &found.minus, &found.middle};
  for (std::size_t k = 0; k < 3; ++k) {
    double* HWY_RESTRICT out = halves[k].data() + first;
    for (std::size_t i = 0; i < kBlock; ++i) out[i] = rows[k]->v[i];
  }
}

/// Two triples of angles for the same rotation: their middle angles have opposite signs.
struct Candidates {
  std::array<BlockRow, 3> first;
  std::array<BlockRow, 3> second;
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
  BlockRow gain;  // the difference of the squared distances; positive if the second is nearer
  for (std::size_t i = 0; i < kBlock; ++i) gain.v[i] = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double* HWY_RESTRICT near = angles[k].data() + first;
    BlockRow& a = candidates.first[k];
    BlockRow& b = candidates.second[k];
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

/// The triples of a block, behind the triple before it.
struct Following {
  static constexpr std::size_t kBefore = 7;  ///< the block itself is aligned
  alignas(64) double v[3][kBefore + 1 + kBlock];
};

/// Each angle plus the whole turns that bring it nearest to another. It keeps its bits if it needs
/// none.
HWY_INLINE Lanes<double> turned_near(Lanes<double> angle, Lanes<double> near, double turn) {
  const auto turns =
      ((near - angle) * fill<double>(1 / turn) + fill<double>(kRounder)) - fill<double>(kRounder);
  return hn::IfThenElse(turns == fill<double>(0), angle, angle + turns * fill<double>(turn));
}

/// The triples of one kind that are nearest to the one before the block.
HWY_INLINE void guess_triples(const EulerForm& form, const LastTriple& last, bool is_second,
                              std::size_t first, const Angles& halves, Following& out) {
  constexpr Tag<double> d;
  const double half_turn = form.is_in_degrees ? 180 : std::numbers::pi;
  for (std::size_t k = 0; k < 3; ++k) out.v[k][Following::kBefore] = last.angles[k];
  for (std::size_t lane = 0; lane < kBlock; lane += kLanes<double>) {
    const auto plus = hn::LoadU(d, halves[0].data() + first + lane);
    const auto minus = hn::LoadU(d, halves[1].data() + first + lane);
    const auto middle = hn::LoadU(d, halves[2].data() + first + lane);
    auto a = plus + minus;
    auto b = fill<double>(form.shift) + middle;
    auto c = fill<double>(form.sign) * (plus - minus);
    if (is_second) {
      a = a + fill<double>(half_turn);
      b = fill<double>(form.shift) - middle;
      c = c + fill<double>(half_turn);
    }
    const Lanes<double> angles[3] = {a, b, c};
    for (std::size_t k = 0; k < 3; ++k) {
      hn::Store(turned_near(angles[k], fill<double>(last.angles[k]), 2 * half_turn), d,
                out.v[k] + Following::kBefore + 1 + lane);
    }
  }
}

/// Whether the rule gives these triples, each for the one before it. The other kind of triple has
/// outer angles that are half a turn from these, so it is further away if the square of the
/// distance to this one, da^2 + db^2 + dc^2, is below (half - |da|)^2 + (half - |dc|)^2. A margin
/// covers all rounding, as long as angles are not very large.
HWY_INLINE bool are_nearest(const EulerForm& form, const Following& triples, std::size_t first,
                            std::size_t count, const Angles& halves) {
  constexpr Tag<double> d;
  constexpr double kMargin = 1e-6;
  constexpr double kMostHalfTurns = 1 << 20;
  constexpr double kLocked = 1e-12;  // radians
  const double half_turn = form.is_in_degrees ? 180 : std::numbers::pi;
  const double locked = 2 * kLocked / std::numbers::pi * half_turn;
  const auto longest = fill<double>((1 - kMargin) * half_turn);
  const auto largest = fill<double>(kMostHalfTurns * half_turn);
  const auto limit = fill<double>((1 - kMargin) * 2 * half_turn * half_turn);
  for (std::size_t lane = 0; lane < kBlock; lane += kLanes<double>) {
    Lanes<double> steps[3];
    const auto middle = hn::LoadU(d, halves[2].data() + first + lane);
    auto is_good =
        hn::And(fill<double>(locked) < middle, middle < fill<double>(half_turn - locked));
    for (std::size_t k = 0; k < 3; ++k) {
      const double* before = triples.v[k] + Following::kBefore + lane;
      const auto angle = hn::Load(d, before + 1);
      steps[k] = hn::Abs(angle - hn::LoadU(d, before));
      is_good = hn::And(is_good, hn::Abs(angle) < largest);
    }
    const auto outer = steps[0] + steps[2];
    is_good = hn::And(is_good, steps[1] < longest);
    is_good = hn::And(is_good, steps[1] * steps[1] + fill<double>(2 * half_turn) * outer < limit);
    const auto rest = static_cast<double>(count - first) - static_cast<double>(lane);
    is_good = hn::Or(is_good, fill<double>(rest) <= hn::Iota(d, 0));
    if (!hn::AllTrue(d, is_good)) return false;
  }
  return true;
}

/// Follows the triples of a block, if they are plain and of one kind.
bool follow_block(const EulerForm& form, bool is_second, std::size_t first, std::size_t count,
                  LastTriple& last, Angles& angles) {
  Following triples;
  guess_triples(form, last, is_second, first, angles, triples);
  if (!are_nearest(form, triples, first, count, angles)) return false;
  const std::size_t size = std::min(kBlock, count - first);
  for (std::size_t k = 0; k < 3; ++k) {
    const double* from = triples.v[k] + Following::kBefore + 1;
    std::copy_n(from, kBlock, angles[k].data() + first);
    last.angles[k] = from[size - 1];
  }
  last.is_second = is_second;
  return true;
}

std::size_t follow_all(const EulerForm& form, std::size_t first, std::size_t count,
                       LastTriple& last, Angles& angles) {
  for (; first < count; first += kBlock) {
    if (!follow_block(form, last.is_second, first, count, last, angles) &&
        !follow_block(form, !last.is_second, first, count, last, angles)) {
      return first;
    }
  }
  return count;
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
HWY_EXPORT(products_of_all);
HWY_EXPORT(turn_all);
HWY_EXPORT(angles_of_all);
HWY_EXPORT(half_angles_of_all);
HWY_EXPORT(follow_all);
HWY_EXPORT(atan2_all);

}  // namespace

void quaternions_of_angles(const EulerForm& form, const Angles& angles, Quaternions& quaternions) {
  for (auto& component : quaternions) component.resize(angles[0].size());
  HWY_DYNAMIC_DISPATCH(quaternions_of_all)(form, angles, quaternions);
}

void products_of_turns(std::span<const Turn> turns, bool is_in_degrees, const Rows& rows,
                       Quaternions& out) {
  for (auto& component : out) component.resize(padded(rows.num_frames));
  HWY_DYNAMIC_DISPATCH(products_of_all)(turns, is_in_degrees, rows, out);
}

void turn_axes(const Matrix& turn, Quaternions& quaternions) {
  HWY_DYNAMIC_DISPATCH(turn_all)(turn, false, quaternions);
}

void turn_to_form(const EulerForm& form, const Matrix& kernel_from_joint,
                  Quaternions& quaternions) {
  HWY_DYNAMIC_DISPATCH(turn_all)(kernel_from_joint, form.shift != 0, quaternions);
}

void angles_of_quaternions(const EulerForm& form, const Quaternions& quaternions, Angles& angles) {
  assert(quaternions[0].size() == angles[0].size());
  HWY_DYNAMIC_DISPATCH(angles_of_all)(form, quaternions, angles);
}

void half_angles_of_quaternions(const EulerForm& form, const Quaternions& quaternions,
                                Angles& halves) {
  for (auto& component : halves) component.resize(quaternions[0].size());
  HWY_DYNAMIC_DISPATCH(half_angles_of_all)(form, quaternions, halves);
}

std::size_t follow_triples(const EulerForm& form, std::size_t first, std::size_t count,
                           LastTriple& last, Angles& angles) {
  assert(first % kBlock == 0 && count <= angles[0].size());
  return HWY_DYNAMIC_DISPATCH(follow_all)(form, first, count, last, angles);
}

void atan2(const std::vector<double>& y, const std::vector<double>& x,
           std::vector<double>& angles) {
  assert(y.size() % kBlock == 0 && x.size() == y.size());
  angles.resize(y.size());
  HWY_DYNAMIC_DISPATCH(atan2_all)(y.data(), x.data(), y.size(), angles.data());
}

}  // namespace kinefile::simd
#endif  // HWY_ONCE
