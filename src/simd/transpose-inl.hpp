// SPDX-License-Identifier: MIT
// Included once for every instruction set, behind lanes-inl.hpp, so without an include guard.
// Rows of frames become columns with a frame in each lane, and columns rows.

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {

/// Column by column, without vectors.
template <class T>
HWY_INLINE void load_column(const double* const* frames, std::size_t c, Row<double, T>& column) {
  for (std::size_t f = 0; f < kPass<T>; ++f) column.v[f] = frames[f][c];
}

template <class T>
HWY_INLINE void write_column(const Row<T>& column, std::size_t count, std::size_t stride, T* out) {
  for (std::size_t f = 0; f < count; ++f) out[f * stride] = column.v[f];
}

#if HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SCALAR

template <class T>
HWY_INLINE void load_columns(const double* const* frames, std::size_t num_columns,
                             Row<double, T>* columns) {
  for (std::size_t c = 0; c < num_columns; ++c) load_column<T>(frames, c, columns[c]);
}

template <class T>
HWY_INLINE std::size_t write_full_rows(const Row<T>*, std::size_t, T*) {
  return 0;
}

#else

/// Two numbers of every second frame, one frame in each block of 16 bytes.
template <class D>
HWY_INLINE hn::Vec<D> load_pairs(D d, const double* const* frames, std::size_t c) {
  if constexpr (hn::MaxLanes(d) == 2) {
    return hn::LoadU(d, frames[0] + c);
  } else {
    constexpr hn::Half<D> half;
    return hn::Combine(d, load_pairs(half, frames + hn::MaxLanes(half), c),
                       load_pairs(half, frames, c));
  }
}

/// \param frames  the rows of a pass
template <class T>
HWY_INLINE void load_columns(const double* const* frames, std::size_t num_columns,
                             Row<double, T>* columns) {
  constexpr Tag<double> d;
  for (std::size_t c = 0; c + 1 < num_columns; c += 2) {
    for (std::size_t lane = 0; lane < kPass<T>; lane += kLanes<double>) {
      const auto even = load_pairs(d, frames + lane, c);
      const auto odd = load_pairs(d, frames + lane + 1, c);
      hn::Store(hn::InterleaveLower(d, even, odd), d, columns[c].v + lane);
      hn::Store(hn::InterleaveUpper(d, even, odd), d, columns[c + 1].v + lane);
    }
  }
  if (num_columns % 2 == 1) {
    load_column<T>(frames, num_columns - 1, columns[num_columns - 1]);
  }
}

/// Writes each block of 16 bytes to a row.
template <class D>
HWY_INLINE void write_blocks(D d, hn::Vec<D> blocks, std::size_t stride, hn::TFromD<D>* out) {
  using T = hn::TFromD<D>;
  if constexpr (hn::MaxLanes(d) * sizeof(T) == 16) {
    hn::StoreU(blocks, d, out);
  } else {
    constexpr hn::Half<D> half;
    constexpr std::size_t kBlocks = hn::MaxLanes(half) * sizeof(T) / 16;
    write_blocks(half, hn::LowerHalf(half, blocks), stride, out);
    write_blocks(half, hn::UpperHalf(half, blocks), stride, out + kBlocks * stride);
  }
}

/// Writes as many numbers as a block of 16 bytes has to the rows of a vector's frames.
HWY_INLINE void write_few(const Row<double>* numbers, std::size_t lane, std::size_t stride,
                          double* out) {
  constexpr Tag<double> d;
  const auto a = load<double>(numbers[0], lane);
  const auto b = load<double>(numbers[1], lane);
  write_blocks(d, hn::InterleaveLower(d, a, b), 2 * stride, out);
  write_blocks(d, hn::InterleaveUpper(d, a, b), 2 * stride, out + stride);
}

HWY_INLINE void write_few(const Row<float>* numbers, std::size_t lane, std::size_t stride,
                          float* out) {
  constexpr Tag<float> d;
  constexpr hn::RepartitionToWide<Tag<float>> pairs;
  const auto a = load<float>(numbers[0], lane);
  const auto b = load<float>(numbers[1], lane);
  const auto c = load<float>(numbers[2], lane);
  const auto e = load<float>(numbers[3], lane);
  const auto ab_lower = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));
  const auto ab_upper = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
  const auto ce_lower = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
  const auto ce_upper = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
  const auto first = hn::BitCast(d, hn::InterleaveLower(pairs, ab_lower, ce_lower));
  const auto second = hn::BitCast(d, hn::InterleaveUpper(pairs, ab_lower, ce_lower));
  const auto third = hn::BitCast(d, hn::InterleaveLower(pairs, ab_upper, ce_upper));
  const auto fourth = hn::BitCast(d, hn::InterleaveUpper(pairs, ab_upper, ce_upper));
  write_blocks(d, first, 4 * stride, out);
  write_blocks(d, second, 4 * stride, out + stride);
  write_blocks(d, third, 4 * stride, out + 2 * stride);
  write_blocks(d, fourth, 4 * stride, out + 3 * stride);
}

/// Writes rows of a whole pass, but for the last few numbers. Returns how many numbers are written.
template <class T>
HWY_INLINE std::size_t write_full_rows(const Row<T>* numbers, std::size_t num_numbers, T* out) {
  constexpr std::size_t kFew = 16 / sizeof(T);
  std::size_t k = 0;
  for (; k + kFew <= num_numbers; k += kFew) {
    for (std::size_t lane = 0; lane < kPass<T>; lane += kLanes<T>) {
      write_few(numbers + k, lane, num_numbers, out + lane * num_numbers + k);
    }
  }
  return k;
}

#endif

/// Writes the first rows of a pass, one behind the other.
template <class T>
HWY_INLINE void write_rows(const std::vector<Row<T>>& numbers, std::size_t num_frames, T* out) {
  const std::size_t num = numbers.size();
  std::size_t k = num_frames == kPass<T> ? write_full_rows<T>(numbers.data(), num, out) : 0;
  for (; k < num; ++k) write_column<T>(numbers[k], num_frames, num, out + k);
}

/// Results of which a cache could hold but a part are written past it: otherwise their memory would
/// be read before it is written.
constexpr std::size_t kStreamedBytes = std::size_t{8} << 20;

/// Copies numbers past the cache, but for those of cache lines that others share.
template <class T>
HWY_INLINE void stream(const T* from, std::size_t count, T* to) {
  constexpr Tag<T> d;
  constexpr std::size_t kLine = 64 / sizeof(T);
  const std::size_t misplaced = reinterpret_cast<std::uintptr_t>(to) / sizeof(T) % kLine;
  std::size_t i = std::min(count, (kLine - misplaced) % kLine);
  std::copy_n(from, i, to);
  for (; i + kLine <= count; i += kLine) {
    for (std::size_t k = 0; k < kLine; k += kLanes<T>) {
      hn::Stream(hn::LoadU(d, from + i + k), d, to + i + k);
    }
  }
  std::copy_n(from + i, count - i, to + i);
}

/// Where rows are written: in place, or by way of memory that stays in the cache.
template <class T>
class RowWriter {
 public:
  RowWriter(T* out, std::size_t row_size, std::size_t num_frames) : out_(out) {
    const bool is_streamed = row_size * num_frames * sizeof(T) >= kStreamedBytes;
    if (is_streamed) staged_.resize(row_size * kPass<T>);
  }

  HWY_INLINE void write(const std::vector<Row<T>>& numbers, std::size_t num_frames) {
    const std::size_t count = numbers.size() * num_frames;
    if (staged_.empty()) {
      write_rows<T>(numbers, num_frames, out_);
    } else {
      write_rows<T>(numbers, num_frames, staged_.data());
      stream<T>(staged_.data(), count, out_);
    }
    out_ += count;
  }

 private:
  T* out_;
  std::vector<T> staged_;
};

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
