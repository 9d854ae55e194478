// SPDX-License-Identifier: MIT
// Numbers become text several at a time. With d decimals, a number v is k / 10^d, and the digits of
// the whole number k are its text.
//
// Fixed decimals: s = v 10^d is rounded once (10^d is exact), so it is wrong by 2^-53 s at most; k
// is s rounded to the nearest whole number. If s is farther than that from the middle between two
// whole numbers, then k is what the exact product rounds to. Eight times as much is demanded, which
// covers the rounding of the test itself. Exact middles are among what is left.
//
// The shortest text: if the double k / 10^d is v, and k has 15 digits at most, then k's digits
// without trailing zeros are the shortest text of v, and the only one of that length:
// - It reads back as v, because k < 2^53 and 10^d (d <= 22) are exact doubles, so that the quotient
//   is what a correct reader makes of the text (Clinger, "How to Read Floating Point Numbers
//   Accurately", 1990).
// - Different decimals of at most 15 digits are different doubles, since 10^15 < 2^52 (Matula,
//   "In-and-out Conversions", 1968; none here is near the subnormal doubles). So no other text of
//   at most 15 digits reads back as v, whether shorter or as long.
// Which d is tried does not matter for that. The most decimals that leave 15 digits are tried, so
// that numbers with fewer are found, too, without a guess: for v = fl(k / 10^d), s is wrong by
// 2^-52 k < 0.23, so that k is found again.
//
// The digits of k < 10^15: two halves of 8 digits by doubles, then fours, pairs and digits by
// products with rounded-up reciprocals, which are exact in these ranges (Granlund and Montgomery,
// "Division by Invariant Integers using Multiplication", 1994). Of the 16 digits the first is 0,
// which makes room for the point. One shuffle takes out leading zeros and puts the point in its
// place; trailing zeros are overwritten.
//
// Longer shortest texts have the digits that fmt finds (Jeon, "Dragonbox", 2020), and the same
// kernel prints them. What remains (nan, infinities, 10^15 and more, below 10^-4, near the middle)
// is left to fmt, number by number, so that it does not slow its neighbours. Highway compiles this
// file once for every instruction set and selects one at run time.

#include "simd/number_text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <type_traits>

#ifdef __EMSCRIPTEN__
#define HWY_COMPILE_ONLY_EMU128  // WebAssembly has no vectors of doubles in Highway 1.0
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/number_text.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/number_text_tables.hpp"

#ifndef KINEFILE_NUMBER_TEXT_ODD
#define KINEFILE_NUMBER_TEXT_ODD
namespace kinefile::simd {
namespace {

inline void append_text(std::string_view text, fmt::memory_buffer& out) {
  out.append(text.data(), text.data() + text.size());
}

/// Puts a point into an exponent without one. The text begins at a place of a buffer.
inline void point_exponent(std::size_t begin, fmt::memory_buffer& out) {
  const std::string_view text(out.data() + begin, out.size() - begin);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string_view::npos || text.find('.') != std::string_view::npos) return;
  const std::string pointed = ".0" + std::string(text.substr(exponent));
  out.resize(begin + exponent);
  append_text(pointed, out);
}

/// Appends a number that the kernels leave.
inline void append_odd_number(double number, const NumberSpelling& spelling,
                              fmt::memory_buffer& out) {
  if (!std::isfinite(number)) {
    const std::string_view quote = spelling.quotes_non_finite ? "\"" : "";
    append_text(quote, out);
    append_text(std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf", out);
    append_text(quote, out);
  } else if (spelling.decimals) {
    fmt::format_to(std::back_inserter(out), "{:.{}f}", number, *spelling.decimals);
  } else {
    const std::size_t begin = out.size();
    fmt::format_to(std::back_inserter(out), "{}", number);
    if (spelling.points_exponents) point_exponent(begin, out);
  }
}

}  // namespace
}  // namespace kinefile::simd
#endif  // KINEFILE_NUMBER_TEXT_ODD

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#include "simd/lanes-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
namespace {  // other files have kernels with types of the same names
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128

void append_all(std::span<const double> numbers, std::string_view separator,
                const NumberSpelling& spelling, fmt::memory_buffer& out) {
  for (const double number : numbers) {
    append_odd_number(number, spelling, out);
    append_text(separator, out);
  }
}

#else

using Doubles = hn::CappedTag<double, 4>;
using Wholes = hn::RebindToUnsigned<Doubles>;
using Bytes = hn::Repartition<std::uint8_t, Doubles>;
constexpr std::size_t kLanes = hn::MaxLanes(Doubles());
constexpr std::size_t kBlocks = kLanes / 2;  ///< of 16 bytes in a vector
/// Printed at a time: of one vector, each step would wait for the one before.
constexpr std::size_t kNumbers = 8;
constexpr std::size_t kVectors = kNumbers / kLanes;
using Magnitudes = std::array<hn::Vec<Doubles>, kVectors>;

/// Added to a whole number below 2^51, it makes the number the low bits of the sum; and it rounds
/// others to the nearest whole number.
constexpr double kMagic = 6755399441055744.0;  // 1.5 * 2^52

HWY_INLINE hn::Vec<Doubles> rounded(hn::Vec<Doubles> v) {
  const Doubles d;
  return hn::Sub(hn::Add(v, hn::Set(d, kMagic)), hn::Set(d, kMagic));
}

/// Numbers as whole numbers of units of their last decimal.
struct Group {
  Magnitudes wholes;
  std::uint64_t plain_ones = 0;  ///< a bit for each number; others are not in `wholes`

  bool is_plain() const { return plain_ones == (1u << kNumbers) - 1; }
};

/// Splits numbers of 8 digits, in the low 32 bits of 64-bit lanes, into digits.
template <class D64>
HWY_INLINE hn::Vec<hn::Repartition<std::uint8_t, D64> > digits_of(D64, hn::Vec<D64> eights) {
  const hn::Repartition<std::uint32_t, D64> d32;
  const hn::Repartition<std::uint16_t, D64> d16;
  const hn::Repartition<std::uint8_t, D64> d8;
  const auto upper_fours =
      hn::ShiftRight<40>(hn::MulEven(hn::BitCast(d32, eights), hn::Set(d32, 109'951'163)));
  const auto above = hn::MulEven(hn::BitCast(d32, upper_fours), hn::Set(d32, 10'000));
  const auto fours =
      hn::BitCast(d16, hn::Or(upper_fours, hn::ShiftLeft<32>(hn::Sub(eights, above))));
  const auto upper_pairs = hn::ShiftRight<3>(hn::MulHigh(fours, hn::Set(d16, 5243)));
  const auto lower_pairs = hn::Sub(fours, hn::Mul(upper_pairs, hn::Set(d16, 100)));
  const auto pairs = hn::BitCast(
      d16, hn::Or(hn::BitCast(d32, upper_pairs), hn::ShiftLeft<16>(hn::BitCast(d32, lower_pairs))));
  const auto upper = hn::MulHigh(pairs, hn::Set(d16, 6554));
  const auto lower = hn::Sub(pairs, hn::Mul(upper, hn::Set(d16, 10)));
  return hn::BitCast(d8, hn::Or(upper, hn::ShiftLeft<8>(lower)));
}

/// What stands behind each number, and the minus sign of the next, which is overwritten if that is
/// positive.
struct Separator {
  std::uint32_t bytes = 0;
  std::size_t size;

  explicit Separator(std::string_view text) : size(std::min<std::size_t>(text.size(), 2)) {
    char characters[4] = {'-', '-', '-', '-'};
    std::copy_n(text.data(), size, characters);
    std::memcpy(&bytes, characters, sizeof bytes);
  }
};

HWY_INLINE char* print_separator(Separator separator, char* out) {
  std::memcpy(out, &separator.bytes, sizeof separator.bytes);
  return out + separator.size;
}

/// Prints the shortest text of a number and returns the end, or null if fmt is to do it.
HWY_INLINE char* print_long(double number, Separator separator, char* out) {
  const hn::FixedTag<std::uint64_t, 2> d64;
  const hn::FixedTag<std::uint8_t, 16> d8;
  const double magnitude = std::abs(number);  // others are plain, or have an exponent
  if (!(magnitude >= 1e-4 && magnitude < 1e15)) return nullptr;
  const auto decimal = fmt::detail::dragonbox::to_decimal(magnitude);
  if (decimal.exponent >= 0) return nullptr;
  constexpr std::uint64_t kEight = 100'000'000;
  const std::uint64_t upper = decimal.significand / kEight;
  const auto eights = hn::InterleaveLower(d64, hn::Set(d64, upper % kEight),
                                          hn::Set(d64, decimal.significand % kEight));
  const auto zeros = hn::Set(d8, '0');
  // Up to 17 digits behind zeros, and room that is read.
  std::array<std::uint8_t, 64> digits;
  hn::StoreU(zeros, d8, digits.data());
  hn::StoreU(hn::Add(digits_of(d64, eights), zeros), d8, digits.data() + kTextBytes);
  digits[kTextBytes - 1] = static_cast<std::uint8_t>('0' + upper / kEight);
  const auto num_decimals = static_cast<std::size_t>(-decimal.exponent);
  const auto num_digits = std::max(
      static_cast<std::size_t>(fmt::detail::count_digits(decimal.significand)), num_decimals + 1);
  const std::size_t num_whole = num_digits - num_decimals;
  const std::uint8_t* const from = digits.data() + 2 * kTextBytes - num_digits;
  auto* const text = reinterpret_cast<std::uint8_t*>(out + (std::signbit(number) ? 1 : 0));
  hn::StoreU(hn::LoadU(d8, from), d8, text);
  text[num_whole] = '.';
  hn::StoreU(hn::LoadU(d8, from + num_whole), d8, text + num_whole + 1);
  hn::StoreU(hn::LoadU(d8, from + num_whole + kTextBytes), d8, text + num_whole + 1 + kTextBytes);
  return print_separator(separator, reinterpret_cast<char*>(text) + num_digits + 1);
}

/// Of a text's 16 digits, those that are printed.
struct Printed {
  std::size_t first = 0;
  std::size_t length = 0;  ///< with the point
};

/// What is printed with fixed decimals.
struct FixedLayout {
  std::size_t decimals;
  const TextShuffles::OfDecimals* table;
  std::size_t end;  ///< of the text, if it began with all digits

  explicit FixedLayout(std::size_t num_decimals)
      : decimals(num_decimals),
        table(&kTextShuffles.bytes[num_decimals]),
        end(kTextBytes + (num_decimals > 0 ? 1 : 0)) {}

  HWY_INLINE Group group_of(const double* numbers) {
    const Doubles d;
    const auto power = hn::Set(d, kTenPowers.values[decimals]);
    Group group;
    for (std::size_t v = 0; v < kVectors; ++v) {
      const auto scaled = hn::Mul(hn::Abs(hn::LoadU(d, numbers + v * kLanes)), power);
      const auto wholes = rounded(scaled);
      const auto distance = hn::Abs(hn::Sub(scaled, wholes));
      const auto limit = hn::Sub(hn::Set(d, 0.5), hn::Mul(scaled, hn::Set(d, 0x1p-50)));
      const auto is_plain = hn::And(distance <= limit, wholes < hn::Set(d, 1e15));
      group.wholes[v] = wholes;
      group.plain_ones |= bits_of(d, is_plain) << (v * kLanes);
    }
    return group;
  }
  HWY_INLINE const TextShuffles::OfDecimals& shuffles(std::size_t) const { return *table; }
  /// \param digits  a bit for each that is not 0, from the first digit on; above them, any bits
  HWY_INLINE Printed printed(std::uint32_t digits, std::size_t) const {
    const std::uint32_t ones = std::uint32_t{1} << (kTextBytes - 1 - decimals);  // 0 or not
    const auto first = static_cast<std::size_t>(std::countr_zero(digits | ones));
    return {first, end - first};
  }
  HWY_INLINE char* print_other(double, Separator, char*) const { return nullptr; }
};

/// What is printed in the shortest form.
struct ShortestLayout {
  std::array<std::uint8_t, kNumbers> decimals{};

  HWY_INLINE Group group_of(const double* numbers) {
    const Doubles d;
    const double* powers[kNumbers];
    for (std::size_t i = 0; i < kNumbers; ++i) {
      std::uint64_t bits;
      std::memcpy(&bits, numbers + i, sizeof bits);
      decimals[i] = kDecimalsOfExponent.values[bits >> 52 & 0x7FF];
      powers[i] = &kTenPowers.values[decimals[i]];
    }
    Group group;
    for (std::size_t v = 0; v < kVectors; ++v) {
      const auto magnitudes = hn::Abs(hn::LoadU(d, numbers + v * kLanes));
      const auto divisors = load_each(d, powers + v * kLanes);
      group.wholes[v] = rounded(hn::Mul(magnitudes, divisors));
      const auto is_plain = hn::Div(group.wholes[v], divisors) == magnitudes;
      group.plain_ones |= bits_of(d, is_plain) << (v * kLanes);
    }
    return group;
  }
  HWY_INLINE const TextShuffles::OfDecimals& shuffles(std::size_t i) const {
    return kTextShuffles.bytes[decimals[i]];
  }
  HWY_INLINE Printed printed(std::uint32_t digits, std::size_t i) const {
    const std::uint32_t ones = 0x8000u >> decimals[i];
    const std::uint32_t kept = (digits & 0xFFFF) | ones;
    const auto first = static_cast<std::size_t>(std::countr_zero(kept));
    const auto end = static_cast<std::size_t>(32 - std::countl_zero(kept));
    return {first, end - first + (kept >= 2 * ones ? 1 : 0)};
  }
  HWY_INLINE char* print_other(double number, Separator separator, char* out) const {
    return print_long(number, separator, out);
  }
};

/// Digits of all numbers of a group: a vector for the numbers of even lanes, then one for the odd
/// lanes, of each vector of doubles.
constexpr std::size_t kHalves = 2 * kVectors;
using Eights = std::array<hn::Vec<Wholes>, kHalves>;

/// Splits whole numbers into 8 upper and 8 lower digits, in the low 32 bits of the lanes of a
/// block.
HWY_INLINE Eights eights_of(const Magnitudes& wholes) {
  const Doubles d;
  const Wholes d64;
  const auto magic = hn::Set(d, kMagic);
  Eights eights;
  for (std::size_t v = 0; v < kVectors; ++v) {
    // The quotient less almost a half rounds as the quotient's floor: k + 1/2 is 5e-9 from a
    // multiple of 1e8, and all roundings together are less than 3.2e-9.
    const auto quotient = hn::Mul(wholes[v], hn::Set(d, 1e-8));
    const auto upper = hn::Add(hn::Add(quotient, hn::Set(d, -0.499'999'995)), magic);
    const auto above = hn::Mul(hn::Sub(upper, magic), hn::Set(d, 1e8));
    const auto lower = hn::Add(hn::Sub(wholes[v], above), magic);
    const auto upper64 = hn::BitCast(d64, upper);
    const auto lower64 = hn::BitCast(d64, lower);
    eights[2 * v] = hn::InterleaveLower(d64, upper64, lower64);
    eights[2 * v + 1] = hn::InterleaveUpper(d64, upper64, lower64);
  }
  return eights;
}

/// The digits of a group as characters, with a point before each number's.
struct GroupDigits {
  alignas(32) std::array<std::uint8_t, kNumbers * kTextBytes> bytes;
  std::array<std::uint32_t, kHalves> not_zero;  ///< a bit for each digit

  HWY_INLINE void fill(const Magnitudes& wholes) {
    const Bytes d;
    alignas(16) static constexpr std::uint8_t kCharacters[kTextBytes] = {
        '.', '0', '0', '0', '0', '0', '0', '0', '0', '0', '0', '0', '0', '0', '0', '0'};
    const auto characters = hn::LoadDup128(d, kCharacters);
    const Eights eights = eights_of(wholes);
    for (std::size_t half = 0; half < kHalves; ++half) {
      const auto digits = digits_of(Wholes(), eights[half]);
      not_zero[half] = ~static_cast<std::uint32_t>(bits_of(d, digits == hn::Zero(d)));
      hn::Store(hn::Add(digits, characters), d, bytes.data() + half * kBlocks * kTextBytes);
    }
  }
  static constexpr std::size_t half(std::size_t i) { return i / kLanes * 2 + i % 2; }
  static constexpr std::size_t block(std::size_t i) { return i % kLanes / 2; }
  HWY_INLINE const std::uint8_t* of(std::size_t i) const {
    return bytes.data() + (half(i) * kBlocks + block(i)) * kTextBytes;
  }
  /// A bit for each digit of a number that is not 0; above 16 bits, any.
  HWY_INLINE std::uint32_t places(std::size_t i) const {
    return not_zero[half(i)] >> (kTextBytes * block(i));
  }
};

/// Prints a number of a group and returns the end. A minus sign stands there already.
template <class Layout>
HWY_INLINE char* print_plain(const GroupDigits& digits, const Layout& layout, std::size_t i,
                             double number, Separator separator, char* out) {
  const hn::FixedTag<std::uint8_t, 16> d8;
  const Printed printed = layout.printed(digits.places(i), i);
  std::uint64_t bits;
  std::memcpy(&bits, &number, sizeof bits);
  out += bits >> 63;
  const auto text = hn::TableLookupBytes(hn::Load(d8, digits.of(i)),
                                         hn::Load(d8, layout.shuffles(i)[printed.first].data()));
  hn::StoreU(text, d8, reinterpret_cast<std::uint8_t*>(out));
  out += printed.length;
  return print_separator(separator, out);
}

/// Makes room for numbers and returns where they go. Numbers of the kernels have up to 25 bytes
/// with their separator, and 32 behind the last are overwritten.
inline char* room_for(std::size_t count, fmt::memory_buffer& out) {
  out.reserve(out.size() + count * 25 + 32);
  char* const begin = out.data() + out.size();
  *begin = '-';
  return begin;
}

inline void end_at(const char* end, fmt::memory_buffer& out) {
  out.resize(static_cast<std::size_t>(end - out.data()));
}

/// Appends numbers of a group, of which some are not plain. Takes copies, so that those of the fast
/// loop stay in registers.
template <class Layout>
HWY_NOINLINE void append_mixed(const Layout layout, const Group group,
                               std::span<const double> numbers, std::string_view separator_text,
                               const NumberSpelling& spelling, fmt::memory_buffer& out) {
  const Separator separator(separator_text);
  GroupDigits digits;
  if (group.plain_ones != 0) digits.fill(group.wholes);
  char* to = room_for(numbers.size(), out);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    char* const end = (group.plain_ones >> i & 1) != 0
                          ? print_plain(digits, layout, i, numbers[i], separator, to)
                          : layout.print_other(numbers[i], separator, to);
    if (end != nullptr) {
      to = end;
      continue;
    }
    end_at(to, out);
    append_odd_number(numbers[i], spelling, out);
    append_text(separator_text, out);
    to = room_for(numbers.size() - i, out);
  }
  end_at(to, out);
}

template <class Layout>
void append_by(Layout layout, std::span<const double> numbers, std::string_view separator_text,
               const NumberSpelling& spelling, fmt::memory_buffer& out) {
  const Separator separator(separator_text);
  char* to = room_for(numbers.size(), out);
  std::size_t next = 0;
  for (; next + kNumbers <= numbers.size(); next += kNumbers) {
    const double* const from = numbers.data() + next;
    const Group group = layout.group_of(from);
    if (!group.is_plain()) {
      end_at(to, out);
      append_mixed(layout, group, {from, kNumbers}, separator_text, spelling, out);
      to = room_for(numbers.size() - next, out);
      continue;
    }
    GroupDigits digits;
    digits.fill(group.wholes);
    for (std::size_t i = 0; i < kNumbers; ++i) {
      to = print_plain(digits, layout, i, from[i], separator, to);
    }
  }
  end_at(to, out);
  if (next == numbers.size()) return;
  std::array<double, kNumbers> last{};
  std::copy(numbers.begin() + static_cast<std::ptrdiff_t>(next), numbers.end(), last.begin());
  const Group group = layout.group_of(last.data());
  append_mixed(layout, group, std::span(last).first(numbers.size() - next), separator_text,
               spelling, out);
}

void append_all(std::span<const double> numbers, std::string_view separator,
                const NumberSpelling& spelling, fmt::memory_buffer& out) {
  if (!spelling.decimals) {
    append_by(ShortestLayout(), numbers, separator, spelling, out);
  } else if (*spelling.decimals >= 0 && *spelling.decimals <= kMostDecimals) {
    append_by(FixedLayout(static_cast<std::size_t>(*spelling.decimals)), numbers, separator,
              spelling, out);
  } else {
    for (const double number : numbers) {
      append_odd_number(number, spelling, out);
      append_text(separator, out);
    }
  }
}

#endif  // HWY_TARGET

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinefile::simd {
namespace {
HWY_EXPORT(append_all);
}  // namespace

void append_numbers(std::span<const double> numbers, std::string_view separator,
                    const NumberSpelling& spelling, fmt::memory_buffer& out) {
  HWY_DYNAMIC_DISPATCH(append_all)(numbers, separator, spelling, out);
}

}  // namespace kinefile::simd
#endif  // HWY_ONCE
