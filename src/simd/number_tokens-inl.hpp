// SPDX-License-Identifier: MIT
// Included once for every instruction set, so without an include guard.
//
// Tokens become doubles, several at a time, with one block of 16 bytes for each, which ends where
// the token ends. The point is taken out by a shuffle, digits are joined to pairs, fours, eights
// and sixteens, and the whole number is divided by a power of ten. Both are exact for up to 15
// digits, so that the quotient is rounded correctly (Clinger, "How to Read Floating Point Numbers
// Accurately", 1990). Tokens of up to 19 digits are joined in the same way, in one block of 32
// bytes each. Their number is exact as a sum of two doubles. The quotient of the greater one and
// the power of ten is corrected by the rest of the division, which a fused multiplication gives
// exactly (Markstein, "Computation of elementary functions on the IBM RISC System/6000 processor",
// 1990). If the correction, made a little smaller or greater than its rounding error, leads to the
// same double, that is the nearest one. What lies so close to the middle between two doubles, and
// every such token where there is no fused multiplication, is read alone and rounded by
// fast_float's arithmetic (Lemire, "Number Parsing at a Gigabyte per Second", 2021). Any byte that
// is no digit, sign in front or first point shows as a digit above 9: such a token is not read.

#include "simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// At most four tokens at a time: of more, one that is odd is more often among them.
using Bytes = hn::CappedTag<std::uint8_t, 32>;
using Block = hn::FixedTag<std::uint8_t, 16>;

using DoubleLanes = hn::CappedTag<double, 4>;

/// Loads 16 bytes of each of `hn::Lanes(d) / 16` addresses.
template <class D>
HWY_INLINE hn::Vec<D> load_blocks(D d, const std::uint8_t* const* from) {
  if constexpr (hn::MaxLanes(D()) == 16) {
    return hn::LoadU(d, from[0]);
  } else {
    const hn::Half<D> half;
    constexpr std::size_t kHalf = hn::MaxLanes(D()) / 32;
    return hn::Combine(d, load_blocks(half, from + kHalf), load_blocks(half, from));
  }
}

/// Joins 16 digits of each block to two numbers of 8 digits, in the two 64-bit lanes of the block.
template <class D, class V>
HWY_INLINE hn::Vec<hn::Repartition<std::uint64_t, D> > joined_eights(D, V digits) {
  const hn::Repartition<std::uint16_t, D> d16;
  const hn::Repartition<std::uint32_t, D> d32;
  const hn::Repartition<std::uint64_t, D> d64;
  // The first of two digits is the low byte: its tenfold is added to the high byte.
  const auto bytes = hn::BitCast(d16, digits);
  const auto pairs = hn::ShiftRight<8>(hn::Mul(bytes, hn::Set(d16, 10 * 256 + 1)));
  // The first pair of two is in the low half of 32 bits.
  const auto hundreds = hn::BitCast(d16, hn::Set(d32, 0x00010064));
  const auto products = hn::BitCast(d32, hn::Mul(pairs, hundreds));
  const auto fours = hn::And(hn::Add(products, hn::ShiftRight<16>(products)), hn::Set(d32, 0xFFFF));
  const auto high = hn::MulEven(fours, hn::Set(d32, 10000));
  return hn::Add(high, hn::ShiftRight<32>(hn::BitCast(d64, fours)));
}

/// Tokens that are read at a time: one for each lane of a vector of doubles.
constexpr std::size_t kTokens = hn::MaxLanes(DoubleLanes());
constexpr std::size_t kBlocks = hn::MaxLanes(Bytes()) / 16;

/// The tokens of a group: their bytes as digits, without signs; what stands before them is 0.
struct Group {
  hn::Vec<Bytes> digits[2];
  std::uint64_t points = 0;  ///< a bit for each byte
  std::size_t signs = 0;     ///< a bit for each token
};

/// Loads a group; false if a token has no bytes, or more than a block.
/// \param is_long  set if a token has more than a block, and none more than two
HWY_INLINE bool load_group(const std::uint8_t* text, const std::uint32_t* begins,
                           const std::uint32_t* ends, bool& is_long, Group& group) {
  const Bytes d8;
  const std::uint8_t* from[kTokens];
  const std::uint8_t* masks[kTokens];
  std::size_t longest = 0;
  for (std::size_t i = 0; i < kTokens; ++i) {
    const std::size_t sign = text[begins[i]] == '-' ? 1 : 0;
    const std::size_t length = ends[i] - begins[i] - sign;
    group.signs |= sign << i;
    longest |= length - 1;
    from[i] = text + ends[i] - kToken;
    masks[i] = kLengthMasks.of(length % (2 * kToken));
  }
  is_long = longest >= kToken && longest < kLongToken;
  if (longest >= kToken) return false;
  for (std::size_t half = 0; half < 2; ++half) {
    const auto bytes = hn::Xor(load_blocks(d8, from + half * kBlocks), hn::Set(d8, '0'));
    group.digits[half] = hn::And(bytes, load_blocks(d8, masks + half * kBlocks));
    group.points |= bits_of(d8, group.digits[half] == hn::Set(d8, '.' ^ '0'))
                    << (16 * kBlocks * half);
  }
  return true;
}

/// Takes the points out of a group's digits; returns the powers of ten below them.
HWY_INLINE hn::Vec<DoubleLanes> take_points_out(Group& group, ForeseenPoint& foreseen) {
  const DoubleLanes dd;
  const Bytes d8;
  if (foreseen.trust > 0 && group.points == foreseen.bits) {
    const auto shuffle = hn::LoadDup128(d8, kPointShuffles.bytes[foreseen.place].data());
    for (auto& digits : group.digits) digits = hn::TableLookupBytesOr0(digits, shuffle);
    foreseen.is_met();
    return hn::Set(dd, kDivisors.values[foreseen.place]);
  }
  const std::uint8_t* shuffles[kTokens];
  const double* divisors[kTokens];
  std::size_t point = kNoPoint;
  for (std::size_t i = kTokens; i-- > 0;) {
    const auto bits = static_cast<std::uint32_t>(group.points >> (16 * i)) & 0xFFFF;
    point = static_cast<std::size_t>(std::countr_zero(bits | 0x10000));
    shuffles[i] = kPointShuffles.bytes[point].data();
    divisors[i] = &kDivisors.values[point];
  }
  for (std::size_t half = 0; half < 2; ++half) {
    group.digits[half] =
        hn::TableLookupBytesOr0(group.digits[half], load_blocks(d8, shuffles + half * kBlocks));
  }
  if (foreseen.trust > 0) foreseen.is_missed(point, kTokens);
  return load_each(dd, divisors);
}

/// Reads as many tokens as a vector has doubles; whether all of them are plain.
/// \param begins, ends  of the tokens; 16 bytes before each end can be read
/// \param is_long       out: whether `read_long_group` may read them
HWY_INLINE bool read_group(const std::uint8_t* text, const std::uint32_t* begins,
                           const std::uint32_t* ends, ForeseenPoint& foreseen, bool& is_long,
                           double* out) {
  const DoubleLanes dd;
  const Bytes d8;
  const hn::RebindToUnsigned<DoubleLanes> d64;
  const hn::Repartition<std::uint32_t, DoubleLanes> d32;
  Group group;
  if (!load_group(text, begins, ends, is_long, group)) return false;
  const auto divisors = take_points_out(group, foreseen);
  const auto limits = hn::LoadDup128(d8, kShortLimits);
  const auto excess =
      hn::Or(hn::SaturatedSub(group.digits[0], limits), hn::SaturatedSub(group.digits[1], limits));
  if (!hn::AllTrue(d8, excess == hn::Zero(d8))) return false;
  const auto first = joined_eights(d8, group.digits[0]);
  const auto second = joined_eights(d8, group.digits[1]);
  // The upper eight digits of each token are in even lanes, the lower ones in odd lanes.
  const auto upper = hn::BitCast(d32, hn::ConcatEven(d64, second, first));
  const auto lower = hn::ConcatOdd(d64, second, first);
  const auto whole = hn::Add(hn::MulEven(upper, hn::Set(d32, 100'000'000)), lower);
  // Below 2^52 a whole number is the low bits of 2^52 plus it.
  const auto magic = hn::Set(d64, 0x4330000000000000);
  const auto number = hn::Sub(hn::BitCast(dd, hn::Or(whole, magic)), hn::BitCast(dd, magic));
  const auto signs = hn::LoadU(d64, kSignBits.values[group.signs].data());
  hn::StoreU(hn::Div(number, hn::Xor(divisors, hn::BitCast(dd, signs))), dd, out);
  return true;
}

#if HWY_TARGET == HWY_AVX2  // it has fused multiplication, and blocks of 32 bytes

/// Joins 32 digits to four numbers of 8 digits. Those of four tokens, of which the first number is
/// 0, become the numbers of 16 digits at their ends and what stands before these.
struct LongNumbers {
  hn::Vec<hn::Repartition<std::uint64_t, Bytes> > above;
  hn::Vec<hn::Repartition<std::uint64_t, Bytes> > whole;
};

HWY_INLINE LongNumbers long_numbers(const hn::Vec<Bytes>* digits) {
  const Bytes d8;
  const hn::Repartition<std::uint32_t, Bytes> d32;
  const hn::Repartition<std::uint64_t, Bytes> d64;
  const auto eights0 = joined_eights(d8, digits[0]);
  const auto eights1 = joined_eights(d8, digits[1]);
  const auto eights2 = joined_eights(d8, digits[2]);
  const auto eights3 = joined_eights(d8, digits[3]);
  const auto odd01 = hn::InterleaveUpper(d64, eights0, eights1);
  const auto odd23 = hn::InterleaveUpper(d64, eights2, eights3);
  const auto even01 = hn::InterleaveLower(d64, eights0, eights1);
  const auto even23 = hn::InterleaveLower(d64, eights2, eights3);
  const auto upper = hn::BitCast(d32, hn::ConcatUpperUpper(d64, even23, even01));
  const auto lower = hn::ConcatUpperUpper(d64, odd23, odd01);
  return {hn::ConcatLowerLower(d64, odd23, odd01),
          hn::Add(hn::MulEven(upper, hn::Set(d32, 100'000'000)), lower)};
}

/// Rounds the quotients of numbers and powers of ten up to 10^22; whether all are certain.
HWY_INLINE bool divide_long(const LongNumbers& numbers, hn::Vec<DoubleLanes> powers,
                            hn::Vec<DoubleLanes>& quotients) {
  const DoubleLanes dd;
  const hn::RebindToUnsigned<DoubleLanes> d64;
  // Whole numbers as the low bits of 2^52, and of 2^84 in units of 2^32.
  const auto magic = hn::Set(d64, 0x4330000000000000);
  const auto magic32 = hn::Set(d64, 0x4530000000000000);
  const auto as_double = [&](auto bits, auto base) HWY_ATTR {
    return hn::Sub(hn::BitCast(dd, hn::Or(bits, base)), hn::BitCast(dd, base));
  };
  // Both addends are multiples of 2^16 below 2^64: the sum is exact.
  const auto high = hn::Add(hn::Mul(as_double(numbers.above, magic), hn::Set(dd, 1e16)),
                            as_double(hn::ShiftRight<32>(numbers.whole), magic32));
  const auto low = as_double(hn::And(numbers.whole, hn::Set(d64, 0xFFFFFFFF)), magic);
  const auto sum = hn::Add(high, low);
  const auto error = hn::Sub(low, hn::Sub(sum, high));
  const auto quotient = hn::Div(sum, powers);
  const auto rest = hn::Add(hn::NegMulAdd(quotient, powers, sum), error);
  const auto correction = hn::Div(rest, powers);  // with an error of 2^-52 of itself
  quotients = hn::MulAdd(correction, hn::Set(dd, 1 + 0x1p-50), quotient);
  return hn::AllTrue(dd, quotients == hn::MulAdd(correction, hn::Set(dd, 1 - 0x1p-50), quotient));
}

/// As `read_group`, for tokens of up to 19 digits and 22 decimals. 33 bytes before each end can be
/// read.
HWY_INLINE bool read_long_group(const std::uint8_t* text, const std::uint32_t* begins,
                                const std::uint32_t* ends, bool& is_long, double* out) {
  const Bytes d;
  const DoubleLanes dd;
  const hn::RebindToUnsigned<DoubleLanes> d64;
  const auto limits = hn::LoadU(d, kLongGroupLimits);
  auto excess = hn::Zero(d);
  hn::Vec<Bytes> digits[kTokens];
  const double* powers[kTokens];
  std::size_t signs = 0;
  std::size_t longest = 0;
  std::size_t no_digits = 0;
  for (std::size_t i = 0; i < kTokens; ++i) {
    const std::size_t sign = text[begins[i]] == '-' ? 1 : 0;
    const std::size_t length = ends[i] - begins[i] - sign;
    signs |= sign << i;
    longest |= length - 1;
    const std::uint8_t* const from = text + ends[i] - kLongToken;
    const auto bytes = hn::LoadU(d, from);
    const std::uint64_t points =
        bits_of(d, bytes == hn::Set(d, '.')) & ~std::uint64_t{0} << (-length % kLongToken);
    const auto point =
        static_cast<std::size_t>(std::countr_zero(points | std::uint64_t{1} << kLongToken));
    const std::size_t num_moved = (point + 1) % (kLongToken + 1);  // bytes up to the point
    const std::size_t num_digits = (length - (num_moved == 0 ? 0 : 1)) % (2 * kLongToken);
    no_digits |= num_digits == 0 ? 1 : 0;
    const auto joined =
        hn::IfVecThenElse(hn::LoadU(d, kLongMasks.first(num_moved)), hn::LoadU(d, from - 1), bytes);
    digits[i] = hn::And(hn::Xor(joined, hn::Set(d, '0')),
                        hn::LoadU(d, kLongMasks.last(num_digits % (kLongToken + 1))));
    excess = hn::Or(excess, hn::SaturatedSub(digits[i], limits));
    powers[i] = &kLongDivisors.values[point];
  }
  is_long = longest >= kToken && longest < kLongToken;
  if (longest >= kLongToken || no_digits != 0 || !hn::AllTrue(d, excess == hn::Zero(d))) {
    return false;
  }
  hn::Vec<DoubleLanes> quotients;
  if (!divide_long(long_numbers(digits), load_each(dd, powers), quotients)) return false;
  const auto sign_bits = hn::BitCast(dd, hn::LoadU(d64, kSignBits.values[signs].data()));
  hn::StoreU(hn::Xor(quotients, sign_bits), dd, out);
  return true;
}

#else

HWY_INLINE bool read_long_group(const std::uint8_t*, const std::uint32_t*, const std::uint32_t*,
                                bool& is_long, double*) {
  is_long = false;
  return false;
}

#endif

/// Reads a token of up to 19 digits; whether it is plain. 33 bytes before its end can be read.
HWY_INLINE bool read_single(const std::uint8_t* text, std::uint32_t begin, std::uint32_t end,
                            double& value) {
  const Block d;
  const hn::Repartition<std::int8_t, Block> i8;
  const bool is_negative = text[begin] == '-';
  const std::size_t length = end - begin - (is_negative ? 1 : 0);
  if (length - 1 >= kLongToken) return false;
  const std::uint8_t* const from = text + end - kLongToken;
  const auto zeros = hn::Set(d, '0');
  const auto point_byte = hn::Set(d, '.');
  const auto bytes0 = hn::LoadU(d, from);
  const auto bytes1 = hn::LoadU(d, from + kToken);
  const std::uint64_t places = bits_of(d, bytes0 == point_byte) | bits_of(d, bytes1 == point_byte)
                                                                      << kToken;
  const std::uint64_t points = places >> (kLongToken - length) << (kLongToken - length);
  const int point = points == 0 ? -1 : std::countr_zero(points);
  const std::size_t num_digits = length - (points == 0 ? 0 : 1);
  // Bytes up to the point move by one.
  const auto up_to0 = hn::MaskFromVec(
      hn::BitCast(d, hn::VecFromMask(i8, hn::BitCast(i8, hn::Load(d, kPlaces)) <
                                             hn::Set(i8, static_cast<std::int8_t>(point + 1)))));
  const auto up_to1 = hn::MaskFromVec(
      hn::BitCast(d, hn::VecFromMask(i8, hn::BitCast(i8, hn::Load(d, kPlaces)) <
                                             hn::Set(i8, static_cast<std::int8_t>(point - 15)))));
  const auto joined0 = hn::IfThenElse(up_to0, hn::LoadU(d, from - 1), bytes0);
  const auto joined1 = hn::IfThenElse(up_to1, hn::LoadU(d, from + kToken - 1), bytes1);
  const std::size_t digits_in_1 = std::min(num_digits, kToken);
  const auto digits0 =
      hn::And(hn::Xor(joined0, zeros), hn::LoadU(d, kLengthMasks.of(num_digits - digits_in_1)));
  const auto digits1 = hn::And(hn::Xor(joined1, zeros), hn::LoadU(d, kLengthMasks.of(digits_in_1)));
  const auto excess = hn::Or(hn::SaturatedSub(digits0, hn::Load(d, kLongLimits)),
                             hn::SaturatedSub(digits1, hn::Set(d, 9)));
  if (num_digits == 0 || !hn::AllTrue(d, excess == hn::Zero(d))) return false;
  std::uint64_t eights0[2];
  std::uint64_t eights1[2];
  const hn::Repartition<std::uint64_t, Block> d64;
  hn::StoreU(joined_eights(d, digits0), d64, eights0);
  hn::StoreU(joined_eights(d, digits1), d64, eights1);
  const std::uint64_t number = (eights0[1] * 100'000'000 + eights1[0]) * 100'000'000 + eights1[1];
  const std::int64_t num_decimals =
      points == 0 ? 0 : static_cast<std::int64_t>(kLongToken) - 1 - point;
  const fast_float::adjusted_mantissa bits =
      fast_float::compute_float<fast_float::binary_format<double> >(-num_decimals, number);
  if (bits.power2 < 0) return false;  // too close to the middle between two doubles
  fast_float::to_float(is_negative, bits, value);
  return true;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
