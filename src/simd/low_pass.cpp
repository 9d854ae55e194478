// SPDX-License-Identifier: MIT
// Compiled once for every instruction set, with the same bits from each.

#include "simd/low_pass.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#ifdef __EMSCRIPTEN__
#define HWY_COMPILE_ONLY_EMU128  // WebAssembly has no vectors of doubles in Highway 1.0
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/low_pass.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
namespace {  // names that another kernel may have, too

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, LaneGroup::kSize>;
using Lanes = hn::Vec<Tag>;
constexpr Tag d;
constexpr std::size_t kLanes = hn::MaxLanes(Tag());

HWY_INLINE Lanes fill(double value) { return hn::Set(d, value); }

/// Some vectors of a frame, which do not wait for each other.
template <std::size_t kCount>
struct Vectors {
  Lanes v[kCount];
};

/// The numbers of some vectors in all frames.
template <std::size_t kCount>
struct Track {
  double* first;
  std::size_t stride;
  std::size_t num_frames;

  HWY_INLINE Vectors<kCount> at(std::size_t frame) const {
    Vectors<kCount> out;
    for (std::size_t k = 0; k < kCount; ++k) {
      out.v[k] = hn::Load(d, first + frame * stride + k * kLanes);
    }
    return out;
  }

  HWY_INLINE void put(const Vectors<kCount>& numbers, std::size_t frame) const {
    for (std::size_t k = 0; k < kCount; ++k) {
      hn::Store(numbers.v[k], d, first + frame * stride + k * kLanes);
    }
  }
};

/// The straight line between the ends. The filter keeps it, so it is subtracted first: then the
/// filter starts at rest, and what is slower than the length of the motion remains as that line.
template <std::size_t kCount>
struct Line {
  Vectors<kCount> origin;
  Vectors<kCount> slope;

  HWY_INLINE Lanes at(std::size_t k, Lanes frame) const { return origin.v[k] + slope.v[k] * frame; }
};

template <std::size_t kCount>
HWY_INLINE Line<kCount> line_of(const Track<kCount>& track) {
  Line<kCount> line;
  line.origin = track.at(0);
  const Vectors<kCount> end = track.at(track.num_frames - 1);
  for (std::size_t k = 0; k < kCount; ++k) {
    line.slope.v[k] =
        (end.v[k] - line.origin.v[k]) / fill(static_cast<double>(track.num_frames - 1));
  }
  return line;
}

/// Subtracts the line.
/// \returns  1 for numbers that differ from those of the frame before in some frame, otherwise 0
template <std::size_t kCount>
HWY_INLINE Vectors<kCount> subtract(const Line<kCount>& line, const Track<kCount>& track) {
  Vectors<kCount> is_moving;
  Vectors<kCount> before = track.at(0);
  for (std::size_t k = 0; k < kCount; ++k) is_moving.v[k] = hn::Zero(d);
  for (std::size_t f = 0; f < track.num_frames; ++f) {
    const Vectors<kCount> now = track.at(f);
    Vectors<kCount> apart;
    for (std::size_t k = 0; k < kCount; ++k) {
      apart.v[k] = now.v[k] - line.at(k, fill(static_cast<double>(f)));
      is_moving.v[k] = hn::IfThenElse(now.v[k] == before.v[k], is_moving.v[k], fill(1));
    }
    track.put(apart, f);
    before = now;
  }
  Vectors<kCount> zero;
  for (std::size_t k = 0; k < kCount; ++k) zero.v[k] = hn::Zero(d);
  track.put(zero, track.num_frames - 1);
  return is_moving;
}

/// One pass (transposed direct form).
template <std::size_t kCount>
class Pass {
 public:
  /// Starts from the steady state for the first number.
  HWY_INLINE Pass(const LowPass& filter, const Vectors<kCount>& first)
      : b0_(fill(filter.b0)),
        twice_b0_(fill(2 * filter.b0)),
        a1_(fill(filter.a1)),
        a2_(fill(filter.a2)) {
    for (std::size_t k = 0; k < kCount; ++k) {
      z1_.v[k] = fill(1 - filter.b0) * first.v[k];
      z2_.v[k] = fill(filter.b0 - filter.a2) * first.v[k];
    }
  }

  HWY_INLINE Vectors<kCount> next(const Vectors<kCount>& in) {
    Vectors<kCount> out;
    for (std::size_t k = 0; k < kCount; ++k) {
      out.v[k] = b0_ * in.v[k] + z1_.v[k];
      z1_.v[k] = twice_b0_ * in.v[k] - a1_ * out.v[k] + z2_.v[k];
      z2_.v[k] = b0_ * in.v[k] - a2_ * out.v[k];
    }
    return out;
  }

 private:
  Lanes b0_, twice_b0_, a1_, a2_;
  Vectors<kCount> z1_, z2_;
};

template <std::size_t kCount>
HWY_INLINE Vectors<kCount> negated(Vectors<kCount> numbers) {
  for (std::size_t k = 0; k < kCount; ++k) numbers.v[k] = hn::Neg(numbers.v[k]);
  return numbers;
}

/// Filters some vectors. What is in front of the first frame is not kept: only the state behind it
/// matters. What is behind the last frame is kept there, for the way back.
template <std::size_t kCount>
HWY_INLINE void filter_track(const LowPass& filter, std::size_t padding,
                             const Track<kCount>& track) {
  const std::size_t count = track.num_frames;
  const Vectors<kCount> start = track.at(0);
  const Line<kCount> line = line_of(track);
  const Vectors<kCount> is_moving = subtract(line, track);
  for (std::size_t i = 1; i <= padding; ++i) {
    track.put(negated(track.at(count - 1 - i)), count - 1 + i);
  }
  Pass<kCount> forwards(filter, negated(track.at(padding)));
  for (std::size_t i = padding; i > 0; --i) forwards.next(negated(track.at(i)));
  for (std::size_t f = 0; f < count + padding; ++f) track.put(forwards.next(track.at(f)), f);
  Pass<kCount> backwards(filter, track.at(count + padding - 1));
  for (std::size_t f = count + padding; f-- > count;) backwards.next(track.at(f));
  for (std::size_t f = count; f-- > 0;) {
    Vectors<kCount> out = backwards.next(track.at(f));
    for (std::size_t k = 0; k < kCount; ++k) {
      const Lanes smooth = line.at(k, fill(static_cast<double>(f))) + out.v[k];
      out.v[k] = hn::IfThenElse(is_moving.v[k] == hn::Zero(d), start.v[k], smooth);
    }
    track.put(out, f);
  }
}

void low_pass_all(const LowPass& filter, LaneFrames& frames) {
  constexpr std::size_t kMany = 4;
  const std::size_t width = frames.num_groups * LaneGroup::kSize;
  double* numbers = frames.groups[0].v;
  for (std::size_t lane = 0; lane < width;) {
    if (width - lane >= kMany * kLanes) {
      filter_track(filter, frames.padding, Track<kMany>{numbers + lane, width, frames.num_frames});
      lane += kMany * kLanes;
    } else {
      filter_track(filter, frames.padding, Track<1>{numbers + lane, width, frames.num_frames});
      lane += kLanes;
    }
  }
}

void take_sides_all(LaneFrames& frames) {
  for (std::size_t lane = 0; lane < LaneGroup::kSize; lane += kLanes) {
    Lanes before[4];
    for (std::size_t k = 0; k < 4; ++k) before[k] = hn::Load(d, frames.frame(0)[k].v + lane);
    for (std::size_t f = 1; f < frames.num_frames; ++f) {
      LaneGroup* const q = frames.frame(f);
      Lanes now[4];
      for (std::size_t k = 0; k < 4; ++k) now[k] = hn::Load(d, q[k].v + lane);
      const Lanes side =
          now[0] * before[0] + now[1] * before[1] + now[2] * before[2] + now[3] * before[3];
      for (std::size_t k = 0; k < 4; ++k) {
        before[k] = hn::IfThenElse(side >= hn::Zero(d), now[k], hn::Neg(now[k]));
        hn::Store(before[k], d, q[k].v + lane);
      }
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinefile::simd {
namespace {

HWY_EXPORT(low_pass_all);
HWY_EXPORT(take_sides_all);

}  // namespace

void low_pass(const LowPass& filter, LaneFrames& frames) {
  if (frames.num_frames < 2 || frames.num_groups == 0) return;
  assert(frames.padding == std::min(filter.padding, frames.num_frames - 1));
  HWY_DYNAMIC_DISPATCH(low_pass_all)(filter, frames);
}

void take_same_sides(LaneFrames& frames) {
  assert(frames.num_groups == 4);
  if (frames.num_frames == 0) return;
  HWY_DYNAMIC_DISPATCH(take_sides_all)(frames);
}

}  // namespace kinefile::simd
#endif  // HWY_ONCE
