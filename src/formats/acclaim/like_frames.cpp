// SPDX-License-Identifier: MIT
#include "formats/acclaim/like_frames.hpp"

#include <charconv>
#include <cstring>
#include <utility>

#include "text/row_template.hpp"

namespace kinefile::acclaim {
namespace {

constexpr std::size_t kSomeNumbers = std::size_t{1} << 14;

/// Whether a frame's number is written in digits alone, without zeros in front.
bool is_number_at(const char* at, const char* end, std::int64_t number) {
  char digits[24];
  const char* const digits_end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  const auto size = static_cast<std::size_t>(digits_end - digits);
  return static_cast<std::size_t>(end - at) > size && std::memcmp(at, digits, size) == 0 &&
         simd::is_separator(at[size]);
}

}  // namespace

std::optional<LikeFrames> like_frames(std::string_view first_frame,
                                      std::span<const std::size_t> columns) {
  auto frame = text::template_of_row(first_frame, columns.size() + 1);
  if (!frame) return std::nullopt;
  return LikeFrames{std::move(*frame), column_runs(columns), columns.size()};
}

ReadFrames read_like_frames(const LikeFrames& like, const char* begin, const char* end,
                            std::int64_t number, Array<double>& values) {
  const std::size_t num_columns = like.num_columns;
  const std::size_t most = kSomeNumbers / (num_columns + 1) + 1;
  Array<double> numbers(most * (num_columns + 1));
  std::vector<const char*> places(most);
  ReadFrames read{0, begin, begin};
  while (true) {
    const simd::NumberRows rows = simd::read_template_rows(read.next, end, like.frame, most,
                                                           numbers.mutate().data(), places.data());
    std::size_t count = 0;
    while (count < rows.num_rows &&
           is_number_at(places[count], end, number + static_cast<std::int64_t>(count))) {
      ++count;
    }
    double* row = values.grow(count * num_columns).data();
    for (std::size_t i = 0; i < count; ++i, row += num_columns) {
      put_in_columns(like.columns, numbers.data() + i * (num_columns + 1) + 1, row);
    }
    read.num_frames += count;
    number += static_cast<std::int64_t>(count);
    if (count > 0) read.last = places[count - 1];
    read.next = count < rows.num_rows ? places[count] : rows.next;
    if (count < most) return read;
  }
}

}  // namespace kinefile::acclaim
