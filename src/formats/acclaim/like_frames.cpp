// SPDX-License-Identifier: MIT
#include "formats/acclaim/like_frames.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <utility>

#include "text/numbers.hpp"
#include "text/row_template.hpp"

namespace kinefile::acclaim {
namespace {

/// Whether a frame's number is written in digits alone, without zeros in front.
bool is_number_at(const char* at, const char* end, std::int64_t number) {
  char digits[24];
  const char* const digits_end = std::to_chars(digits, digits + sizeof digits, number).ptr;
  const auto size = static_cast<std::size_t>(digits_end - digits);
  return static_cast<std::size_t>(end - at) > size && std::memcmp(at, digits, size) == 0 &&
         simd::is_separator(at[size]);
}

/// The number of a frame, if a line has nothing else.
const char* number_in_line(const char* line, const char* end) {
  const char* at = line + (line != end && *line == '-' ? 1 : 0);
  const char* const digits = at;
  while (at != end && *at >= '0' && *at <= '9') ++at;
  const bool is_alone = at != digits && std::all_of(at, end, text::is_line_end);
  return is_alone ? line : nullptr;
}

/// Appends the first frames of a piece, those that are numbered without a gap; returns how many.
/// \param number  in: of the first one; out: of the next one
std::size_t append_frames(const LikeFrames& like, const text::RowPiece& piece, std::int64_t& number,
                          Array<double>& values) {
  std::size_t count = 0;
  while (count < piece.starts.size() && is_number_at(piece.starts[count], piece.end, number)) {
    ++count;
    ++number;
  }
  double* row = values.grow(count * like.num_columns).data();
  for (std::size_t i = 0; i < count; ++i, row += like.num_columns) {
    put_in_columns(like.columns, piece.values.data() + i * (like.num_columns + 1) + 1, row);
  }
  return count;
}

}  // namespace

std::optional<LikeFrames> like_frames(std::string_view first_frame,
                                      std::span<const std::size_t> columns) {
  const auto frame = text::template_of_row(first_frame, columns.size() + 1);
  if (!frame) return std::nullopt;
  LikeFrames like{text::template_row_reader(*frame), column_runs(columns), columns.size()};
  like.reader.row_in_line = number_in_line;
  return like;
}

ReadFrames read_like_frames(const LikeFrames& like, const char* begin, const char* end,
                            std::int64_t number, Array<double>& values) {
  ReadFrames read{0, begin};
  text::read_row_pieces(begin, end, like.reader, [&](const text::RowPiece& piece) {
    const std::size_t count = append_frames(like, piece, number, values);
    read.num_frames += count;
    if (count > 0) read.last = piece.starts[count - 1];
    return count == piece.starts.size();
  });
  return read;
}

std::optional<std::size_t> read_like_frames(const LikeFrames& like, const ByteSource& bytes,
                                            std::size_t offset, std::int64_t number,
                                            Array<double>& values) {
  std::size_t num_frames = 0;
  const auto use = [&](const text::RowPiece& piece) {
    if (num_frames == 0 && !piece.starts.empty()) {
      const std::size_t likely = text::likely_rows(bytes.size - offset, piece);
      values.reserve(values.size() + likely * like.num_columns);
    }
    num_frames += piece.starts.size();
    return append_frames(like, piece, number, values) == piece.starts.size();
  };
  const auto end = text::read_row_pieces(bytes, offset, like.reader, use);
  if (end != text::PiecesEnd::AllRead) return std::nullopt;
  return num_frames;
}

std::size_t third_frame_in(std::string_view text) {
  std::size_t num_frames = 0;
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t end = std::min(text.find('\n', line), text.size() - 1) + 1;
    const bool is_frame = number_in_line(text.data() + line, text.data() + end) != nullptr;
    if (is_frame && ++num_frames == 3) return line;
    line = end;
  }
  return 0;
}

}  // namespace kinefile::acclaim
