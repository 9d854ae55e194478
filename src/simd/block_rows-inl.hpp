// SPDX-License-Identifier: MIT
// Included once for every instruction set, so without an include guard.
//
// Blocks of rotations: short loops over them become vector instructions.

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {

/// One number in every lane of a block.
struct alignas(64) BlockRow {
  double v[kBlock];
};

using QuaternionRows = std::array<BlockRow, 4>;

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

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
