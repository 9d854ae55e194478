// SPDX-License-Identifier: MIT
#include "formats/row_pieces.hpp"

#include <algorithm>
#include <vector>

#include "base/parallel.hpp"
#include "kinefile/array.hpp"
#include "text/number_lines.hpp"

namespace kinefile {
namespace {

/// A piece of text and its numbers fit in a core's second cache.
constexpr std::size_t kPieceBytes = std::size_t{1} << 18;
/// How much more is read at a time to find the end of a piece's last line.
constexpr std::size_t kMoreBytes = std::size_t{1} << 12;
/// No row is longer; a file with such a line is not plain.
constexpr std::size_t kMostLineBytes = std::size_t{1} << 26;

struct Piece {
  Array<char> text;
  Array<double> values;
  std::size_t num_rows = 0;
  std::size_t num_bytes = 0;  ///< of its lines
  PiecesEnd end = PiecesEnd::AllRead;
};

/// Appends bytes of the file.
bool append(const ByteSource& bytes, std::size_t offset, std::size_t count, Array<char>& text) {
  return bytes.read(offset, text.grow(count));
}

/// The number of bytes up to the first line end, and with it.
std::size_t end_of_line(std::span<const char> text) {
  const auto found = std::find(text.begin(), text.end(), '\n');
  return static_cast<std::size_t>(found - text.begin()) + (found == text.end() ? 0 : 1);
}

/// Reads on up to the next line end, or the end of the file.
/// \param offset  in: the first byte that was not read; out: likewise
bool complete_line(const ByteSource& bytes, std::size_t& offset, Piece& piece) {
  std::size_t num_searched = piece.text.size() - 1;  // the last byte may be a line end
  while (true) {
    const char* const found = std::find(piece.text.begin() + num_searched, piece.text.end(), '\n');
    if (found != piece.text.end()) {
      piece.text.resize(static_cast<std::size_t>(found - piece.text.begin()) + 1);
      return true;
    }
    if (offset == bytes.size) return true;
    num_searched = piece.text.size();
    const std::size_t count = std::min(kMoreBytes, bytes.size - offset);
    if (num_searched > kMostLineBytes || !append(bytes, offset, count, piece.text)) return false;
    offset += count;
  }
}

/// Reads the lines that begin in a piece of the file.
/// \param begin     of the piece
/// \param is_first  whether a line begins there
void read_piece(const ByteSource& bytes, std::size_t begin, bool is_first, std::size_t num_columns,
                Piece& piece) {
  piece.num_rows = piece.num_bytes = 0;
  piece.end = PiecesEnd::Fault;
  piece.text.clear();
  std::size_t offset = is_first ? begin : begin - 1;  // the byte before may be a line end
  const std::size_t count = std::min(begin + kPieceBytes, bytes.size) - offset;
  if (!append(bytes, offset, count, piece.text)) return;
  offset += count;
  const std::size_t skipped = is_first ? 0 : end_of_line(piece.text);
  if (skipped == piece.text.size()) {  // a line that began before
    piece.end = PiecesEnd::AllRead;
    return;
  }
  if (!complete_line(bytes, offset, piece)) {
    piece.end = piece.text.size() > kMostLineBytes ? PiecesEnd::Odd : PiecesEnd::Fault;
    return;
  }
  piece.end = PiecesEnd::AllRead;
  const char* const first = piece.text.begin() + skipped;
  // A number and its blank have two bytes at the least.
  piece.num_bytes = static_cast<std::size_t>(piece.text.end() - first);
  const std::size_t most_rows = piece.num_bytes / (2 * num_columns) + 1;
  piece.values.resize(most_rows * num_columns);
  const text::NumberLines read = text::read_number_lines(first, piece.text.end(), num_columns,
                                                         most_rows, piece.values.mutate().data());
  piece.num_rows = read.num_rows;
  if (read.next != piece.text.end()) piece.end = PiecesEnd::Odd;
}

}  // namespace

namespace {

/// As `read_row_pieces`, for `count` pieces from one on.
PiecesEnd read_some_pieces(const ByteSource& bytes, std::size_t offset, std::size_t num_columns,
                           std::size_t first, std::size_t count, const UseRows& use) {
  std::vector<Piece> pieces(std::min(count, slots_for_threads()));
  PiecesEnd end = PiecesEnd::AllRead;
  const auto make = [&](std::size_t i, std::size_t slot) {
    const std::size_t piece = first + i;
    read_piece(bytes, offset + piece * kPieceBytes, piece == 0, num_columns, pieces[slot]);
  };
  const auto use_piece = [&](std::size_t, std::size_t slot) {
    const Piece& piece = pieces[slot];
    const std::size_t num_values = piece.num_rows * num_columns;
    end = piece.end;
    if (end == PiecesEnd::AllRead && !use({piece.values.data(), num_values}, piece.num_bytes)) {
      end = PiecesEnd::Stopped;
    }
    return end == PiecesEnd::AllRead;
  };
  make_in_order(count, pieces.size(), make, use_piece);
  return end;
}

}  // namespace

PiecesEnd read_row_pieces(const ByteSource& bytes, std::size_t offset, std::size_t num_columns,
                          const UseRows& use) {
  const std::size_t count = (bytes.size - offset + kPieceBytes - 1) / kPieceBytes;
  return read_some_pieces(bytes, offset, num_columns, 0, count, use);
}

std::optional<IndexedRows> index_rows(const ByteSource& bytes, std::size_t offset,
                                      std::size_t num_columns) {
  IndexedRows indexed{bytes, offset, num_columns};
  const auto note = [&](std::span<const double> rows, std::size_t) {
    indexed.first_rows.push_back(indexed.num_rows() + rows.size() / num_columns);
    return true;
  };
  if (read_row_pieces(bytes, offset, num_columns, note) != PiecesEnd::AllRead) return std::nullopt;
  return indexed;
}

bool read_rows(const IndexedRows& rows, std::size_t first, std::size_t count, double* out) {
  if (count == 0) return true;
  const std::vector<std::size_t>& first_rows = rows.first_rows;
  const auto piece_of = [&first_rows](std::size_t row) {
    const auto behind = std::upper_bound(first_rows.begin(), first_rows.end(), row);
    return static_cast<std::size_t>(behind - first_rows.begin()) - 1;
  };
  const std::size_t end = first + count;
  const std::size_t first_piece = piece_of(first);
  std::size_t piece = first_piece;
  const auto copy = [&](std::span<const double> values, std::size_t) {
    const std::size_t begin_of_piece = first_rows[piece++];
    if (begin_of_piece + values.size() / rows.num_columns != first_rows[piece]) return false;
    const std::size_t from = std::max(first, begin_of_piece);
    const std::size_t to = std::min(end, first_rows[piece]);
    if (from >= to) return true;  // a piece in which no row begins
    const auto wanted =
        values.subspan((from - begin_of_piece) * rows.num_columns, (to - from) * rows.num_columns);
    std::copy(wanted.begin(), wanted.end(), out + (from - first) * rows.num_columns);
    return true;
  };
  return read_some_pieces(rows.bytes, rows.offset, rows.num_columns, first_piece,
                          piece_of(end - 1) + 1 - first_piece, copy) == PiecesEnd::AllRead;
}

}  // namespace kinefile
