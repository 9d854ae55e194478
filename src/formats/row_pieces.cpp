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

PiecesEnd read_row_pieces(const ByteSource& bytes, std::size_t offset, std::size_t num_columns,
                          const UseRows& use) {
  const std::size_t count = (bytes.size - offset + kPieceBytes - 1) / kPieceBytes;
  std::vector<Piece> pieces(std::min(count, slots_for_threads()));
  PiecesEnd end = PiecesEnd::AllRead;
  const auto make = [&](std::size_t i, std::size_t slot) {
    read_piece(bytes, offset + i * kPieceBytes, i == 0, num_columns, pieces[slot]);
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

}  // namespace kinefile
