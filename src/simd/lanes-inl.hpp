// SPDX-License-Identifier: MIT
// Included once for every instruction set, so without an include guard.
//
// What kernels of several files need to get at single lanes.

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A bit for each lane of a mask.
template <class D, class Mask>
HWY_INLINE std::uint64_t bits_of(D d, Mask mask) {
  // Of the very size that is stored, or the processor waits for the store.
  constexpr std::size_t kLanes = hn::MaxLanes(D());
  std::conditional_t<kLanes <= 8, std::uint8_t,
                     std::conditional_t<kLanes == 16, std::uint16_t, std::uint32_t> >
      bits = 0;
  std::uint8_t bytes[8];
  hn::StoreMaskBits(d, mask, bytes);
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

/// Loads a double from each of `hn::Lanes(d)` addresses.
template <class D>
HWY_INLINE hn::Vec<D> load_each(D d, const double* const* from) {
  if constexpr (hn::MaxLanes(D()) == 1) {
    return hn::LoadU(d, from[0]);
  } else {
    const hn::Half<D> half;
    constexpr std::size_t kHalf = hn::MaxLanes(D()) / 2;
    return hn::Combine(d, load_each(half, from + kHalf), load_each(half, from));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
