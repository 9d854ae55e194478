// SPDX-License-Identifier: MIT
// A CRC is the remainder of a polynomial over GF(2), so any part of a message may be replaced by a
// shorter one with the same remainder. Four registers of 16 bytes each are moved 64 bytes towards
// the end of the message at a time: each half is multiplied without carries by the remainder of its
// distance, and added to the bytes there (Gopal et al., "Fast CRC Computation for Generic
// Polynomials Using PCLMULQDQ Instruction", Intel, 2009). The 16 bytes that remain go through the
// tables that read all bytes on targets without such products: eight tables, one lookup a byte, of
// which eight do not wait for each other (Kounavis and Berry, "Novel Table Lookup-Based Algorithms
// for High-Performance CRC Generation", 2008). All is exact.
// Wider registers would be faster still, but files cannot be written as fast as this.

#include "simd/crc32.hpp"

#include <array>
#include <cstddef>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/crc32.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/crc32_powers.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {

#if (HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4) || (HWY_ARCH_ARM_A64 && HWY_TARGET == HWY_NEON)
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kRegister = 16;
constexpr std::size_t kStep = 4 * kRegister;

using Halves = hn::FixedTag<std::uint64_t, 2>;
using Register = hn::Vec<Halves>;

HWY_INLINE Register load_register(const char* bytes) {
  const hn::FixedTag<std::uint8_t, kRegister> d;
  return hn::BitCast(Halves(), hn::LoadU(d, reinterpret_cast<const std::uint8_t*>(bytes)));
}

/// What a register becomes some bytes further on, plus the bytes there.
HWY_INLINE Register moved(Register value, Register distance, Register bytes) {
  return hn::Xor(hn::Xor(hn::CLMulLower(value, distance), hn::CLMulUpper(value, distance)), bytes);
}

/// The factors for the halves of a register that moves on by some bytes.
template <unsigned num_bytes>
HWY_INLINE Register distance_of() {
  alignas(16) static constexpr std::uint64_t kFactors[2] = {crc32_power(8 * num_bytes + 32),
                                                            crc32_power(8 * num_bytes - 32)};
  return hn::Load(Halves(), kFactors);
}

}  // namespace

std::size_t fold(std::uint32_t state, std::string_view bytes, char* folded) {
  if (bytes.size() < kStep) return 0;
  const char* at = bytes.data();
  const std::size_t size = bytes.size() / kRegister * kRegister;
  const char* const end = at + size;
  alignas(16) const std::uint64_t start[2] = {state, 0};
  Register a = hn::Xor(load_register(at), hn::Load(Halves(), start));
  Register b = load_register(at + kRegister);
  Register c = load_register(at + 2 * kRegister);
  Register d = load_register(at + 3 * kRegister);
  const Register step = distance_of<kStep>();
  for (at += kStep; static_cast<std::size_t>(end - at) >= kStep; at += kStep) {
    a = moved(a, step, load_register(at));
    b = moved(b, step, load_register(at + kRegister));
    c = moved(c, step, load_register(at + 2 * kRegister));
    d = moved(d, step, load_register(at + 3 * kRegister));
  }
  const Register next = distance_of<kRegister>();
  Register all = moved(moved(moved(a, next, b), next, c), next, d);
  for (; at < end; at += kRegister) all = moved(all, next, load_register(at));
  hn::StoreU(hn::BitCast(hn::FixedTag<std::uint8_t, kRegister>(), all),
             hn::FixedTag<std::uint8_t, kRegister>(), reinterpret_cast<std::uint8_t*>(folded));
  return size;
}

#else

std::size_t fold(std::uint32_t, std::string_view, char*) { return 0; }

#endif

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinefile::simd {
namespace {

// Replaces the first bytes of a message, and the state before them, by 16 bytes that leave the same
// state behind them if it is 0 before. Returns how many bytes those are; 0 where it is not done.
HWY_EXPORT(fold);

using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

/// What a byte adds to the state, by the number of bytes that follow it in its group of eight.
constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t state = byte;
    for (int bit = 0; bit < 8; ++bit) state = times_x(state);
    tables[0][byte] = state;
  }
  for (std::size_t k = 1; k < tables.size(); ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = (before >> 8) ^ tables[0][before & 0xFF];
    }
  }
  return tables;
}

constexpr Tables kTables = make_tables();

std::uint32_t word_at(const char* bytes) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    word |= std::uint32_t{static_cast<unsigned char>(bytes[k])} << (8 * k);
  }
  return word;
}

/// The state after some more bytes.
std::uint32_t look_up(std::uint32_t state, std::string_view bytes) {
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    const std::uint32_t low = state ^ word_at(bytes.data());
    const std::uint32_t high = word_at(bytes.data() + 4);
    state = kTables[7][low & 0xFF] ^ kTables[6][low >> 8 & 0xFF] ^ kTables[5][low >> 16 & 0xFF] ^
            kTables[4][low >> 24] ^ kTables[3][high & 0xFF] ^ kTables[2][high >> 8 & 0xFF] ^
            kTables[1][high >> 16 & 0xFF] ^ kTables[0][high >> 24];
  }
  for (const char byte : bytes) {
    state = (state >> 8) ^ kTables[0][(state ^ static_cast<unsigned char>(byte)) & 0xFF];
  }
  return state;
}

}  // namespace

std::uint32_t crc32(std::uint32_t crc, std::string_view bytes) {
  std::uint32_t state = ~crc;
  std::array<char, 16> folded;
  if (const std::size_t count = HWY_DYNAMIC_DISPATCH(fold)(state, bytes, folded.data())) {
    state = look_up(0, {folded.data(), folded.size()});
    bytes.remove_prefix(count);
  }
  return ~look_up(state, bytes);
}

}  // namespace kinefile::simd
#endif  // HWY_ONCE
