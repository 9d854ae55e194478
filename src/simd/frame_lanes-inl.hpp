// SPDX-License-Identifier: MIT
// Included once for every instruction set, by every kernel, so without an include guard.
//
// Vectors of numbers, one lane a frame. Every product and every sum is rounded, in the order that
// the code names: the number of lanes changes no bit of a result.

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SCALAR
template <class T>
using Tag = hn::CappedTag<T, 1>;  // emulated lanes save nothing; one is the least code
constexpr std::size_t kTogether = 1;
#else
template <class T>
using Tag = hn::ScalableTag<T>;
constexpr std::size_t kTogether =
    2;  ///< vectors that are computed by turns, see half_angles-inl.hpp
#endif

template <class T>
using Lanes = hn::Vec<Tag<T>>;

template <class T>
constexpr std::size_t kLanes = hn::MaxLanes(Tag<T>());

template <class T>
HWY_INLINE Lanes<T> fill(double value) {
  return hn::Set(Tag<T>(), static_cast<T>(value));
}

/// A vector in each lane.
template <class T>
struct VectorLanes {
  Lanes<T> x, y, z;
};

/// A quaternion in each lane.
template <class T>
struct QuaternionLanes {
  Lanes<T> w, x, y, z;
};

template <class T>
HWY_INLINE VectorLanes<T> fill(const Vector& v) {
  return {fill<T>(v[0]), fill<T>(v[1]), fill<T>(v[2])};
}

template <class T>
HWY_INLINE VectorLanes<T> operator+(const VectorLanes<T>& a, const VectorLanes<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

/// How many frames are placed at a time.
template <class T>
constexpr std::size_t kPass = std::max(64 / sizeof(T), kTogether* kLanes<T>);

/// One number in each frame of a pass of T.
template <class U, class T = U>
struct alignas(64) Row {
  U v[kPass<T>];
};

template <class T>
HWY_INLINE Lanes<T> load(const Row<T>& row, std::size_t lane) {
  return hn::Load(Tag<T>(), row.v + lane);
}

template <class T>
HWY_INLINE void store(const Lanes<T>& lanes, std::size_t lane, Row<T>& row) {
  hn::Store(lanes, Tag<T>(), row.v + lane);
}

template <class T>
HWY_INLINE VectorLanes<T> load_vector(const Row<T>* rows, std::size_t lane) {
  return {load<T>(rows[0], lane), load<T>(rows[1], lane), load<T>(rows[2], lane)};
}

template <class T>
HWY_INLINE void store_vector(const VectorLanes<T>& v, std::size_t lane, Row<T>* rows) {
  store<T>(v.x, lane, rows[0]);
  store<T>(v.y, lane, rows[1]);
  store<T>(v.z, lane, rows[2]);
}

/// a x b
template <class T>
HWY_INLINE VectorLanes<T> cross(const VectorLanes<T>& a, const VectorLanes<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A vector turned by a unit quaternion: v + 2 w (u x v) + 2 u x (u x v).
template <class T>
HWY_INLINE VectorLanes<T> operator*(const QuaternionLanes<T>& q, const VectorLanes<T>& v) {
  const VectorLanes<T> u{q.x, q.y, q.z};
  const VectorLanes<T> half = cross<T>(u, v);
  const VectorLanes<T> t = half + half;
  return (v + VectorLanes<T>{q.w * t.x, q.w * t.y, q.w * t.z}) + cross<T>(u, t);
}

template <class T>
HWY_INLINE QuaternionLanes<T> operator*(const QuaternionLanes<T>& a, const QuaternionLanes<T>& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

template <class T>
HWY_INLINE QuaternionLanes<T> load_quaternion(const Row<T>* rows, std::size_t lane) {
  return {load<T>(rows[0], lane), load<T>(rows[1], lane), load<T>(rows[2], lane),
          load<T>(rows[3], lane)};
}

template <class T>
HWY_INLINE void store_quaternion(const QuaternionLanes<T>& q, std::size_t lane, Row<T>* rows) {
  store<T>(q.w, lane, rows[0]);
  store_vector<T>({q.x, q.y, q.z}, lane, rows + 1);
}

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
