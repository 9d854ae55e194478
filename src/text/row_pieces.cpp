// SPDX-License-Identifier: MIT
#include "text/row_pieces.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "base/parallel.hpp"
#include "text/number_lines.hpp"
#include "text/numbers.hpp"

namespace kinefile::text {
namespace {

/// A piece of text and its numbers fit in a core's second cache.
constexpr std::size_t kBytesOfPiece = std::size_t{1} << 18;
/// How much more is read at a time to find the end of a piece's last row.
constexpr std::size_t kMoreBytes = std::size_t{1} << 12;
/// No row is longer; a file with such a row is not plain.
constexpr std::size_t kMostRowBytes = std::size_t{1} << 26;
/// Readers of rows look at some bytes behind the last one.
constexpr std::size_t kBehind = 1024;

constexpr std::size_t kNoPlace = static_cast<std::size_t>(-1);

/// Some bytes of a file: a view of all of them, or those that were read. Places are those in the
/// file.
struct Window {
  const ByteSource& bytes;
  std::size_t first = 0;  ///< the place of the first byte
  Array<char>& storage;   ///< of the bytes; none of a view
  bool has_fault = false;

  bool is_view() const { return bytes.view.data() != nullptr; }
  std::size_t end() const { return is_view() ? bytes.size : first + storage.size(); }
  const char* at(std::size_t place) const {
    return is_view() ? bytes.view.data() + place : storage.data() + (place - first);
  }
};

/// Reads bytes up to a place; false after a fault.
bool read_to(Window& window, std::size_t place) {
  const std::size_t end = window.end();
  if (window.is_view() || end >= place) return true;
  const bool is_read = window.bytes.read(end, window.storage.grow(place - end));
  window.has_fault |= !is_read;
  return is_read;
}

/// Reads some more; false at the end of the file, after a fault, and of too many.
bool read_more(Window& window) {
  const std::size_t end = window.end();
  if (end == window.bytes.size || window.storage.size() > kMostRowBytes) return false;
  return read_to(window, std::min(end + kMoreBytes, window.bytes.size));
}

/// Where the first line begins at or behind a place, and before a limit; none otherwise. The end of
/// the file counts as such a place.
/// \param from  not the first byte of the window
std::size_t next_line(Window& window, std::size_t from, std::size_t limit) {
  std::size_t searched = from - 1;
  while (searched < limit) {
    const std::size_t end = std::min(window.end(), limit);
    const void* const found = std::memchr(window.at(searched), '\n', end - searched);
    if (found != nullptr) {
      return searched +
             static_cast<std::size_t>(static_cast<const char*>(found) - window.at(searched)) + 1;
    }
    searched = end;
    if (searched < limit && !read_more(window)) break;
  }
  return searched == window.bytes.size ? searched : kNoPlace;
}

/// Where the first row begins whose line begins at or behind a place, and before a limit; none
/// otherwise. The end of the file counts as such a place.
std::size_t next_row(Window& window, const RowReader& reader, std::size_t from, std::size_t limit) {
  std::size_t line = next_line(window, from, limit);
  while (reader.row_in_line != nullptr && line < std::min(limit, window.bytes.size)) {
    const std::size_t end = next_line(window, line + 1, window.bytes.size);
    if (end == kNoPlace) return kNoPlace;
    const char* const begin = window.at(line);
    if (const char* const row = reader.row_in_line(begin, window.at(end))) {
      return line + static_cast<std::size_t>(row - begin);
    }
    line = end;
  }
  return line < limit || line == window.bytes.size ? line : kNoPlace;
}

struct Piece {
  Array<char> text;
  Array<double> values;
  std::vector<const char*> starts;
  std::size_t num_rows = 0;
  std::size_t num_bytes = 0;  ///< of its rows
  const char* text_end = nullptr;
  std::size_t next = kNoPlace;  ///< the place behind its rows, if it has any
  PiecesEnd end = PiecesEnd::AllRead;
};

/// Reads the rows at a place, of which the last ends at another.
void read_rows_between(Window& window, const RowReader& reader, std::size_t begin, std::size_t end,
                       Piece& piece) {
  if (!window.is_view()) {
    const std::span<char> rest = window.storage.grow(kBehind);
    std::fill(rest.begin(), rest.end(), '\n');
  }
  const char* const text = window.at(begin);
  const char* const text_end = window.at(std::min(end + kBehind, window.end()));
  // A number and its separator have two bytes at the least.
  const auto num_bytes = static_cast<std::size_t>(text_end - text);
  const std::size_t most_rows = num_bytes / (2 * reader.num_columns) + 1;
  piece.values.resize(most_rows * reader.num_columns);
  if (piece.starts.size() < most_rows) piece.starts.resize(most_rows);
  const simd::NumberRows read =
      reader.read(text, text_end, most_rows, piece.values.mutate().data(), piece.starts.data());
  const char* const rows_end = window.at(begin) + (end - begin);
  const char* next = read.next;
  piece.num_rows = read.num_rows;
  while (piece.num_rows > 0 && piece.starts[piece.num_rows - 1] >= rows_end) {
    next = piece.starts[--piece.num_rows];
  }
  next = std::min(next, rows_end);
  const bool is_last = !window.is_view() && end == window.bytes.size;
  if (is_last && std::all_of(next, rows_end, is_line_end)) next = rows_end;
  piece.text_end = next;
  piece.num_bytes = static_cast<std::size_t>(next - text);
  piece.next = begin + piece.num_bytes;
  piece.end = next == rows_end ? PiecesEnd::AllRead : PiecesEnd::Odd;
}

/// Reads the rows that begin in a piece of the file.
/// \param begin     of the piece
/// \param is_first  whether a row begins there
void read_piece(const ByteSource& bytes, std::size_t begin, bool is_first, const RowReader& reader,
                Piece& piece) {
  piece.num_rows = piece.num_bytes = 0;
  piece.end = PiecesEnd::AllRead;
  piece.text.clear();
  if (bytes.view.data() == nullptr) {
    piece.text.reserve(kBytesOfPiece + 16 * kMoreBytes);  // so that it need not grow, usually
  }
  const std::size_t limit = std::min(begin + kBytesOfPiece, bytes.size);
  Window window{bytes, is_first ? begin : begin - 1, piece.text};
  piece.next = kNoPlace;
  if (!read_to(window, limit)) {
    piece.end = PiecesEnd::Fault;
    return;
  }
  const std::size_t first = is_first ? begin : next_row(window, reader, begin, limit);
  const std::size_t end = first == kNoPlace || first == bytes.size
                              ? first
                              : next_row(window, reader, limit, bytes.size);
  if (window.has_fault) {
    piece.end = PiecesEnd::Fault;
  } else if (first != kNoPlace && end == kNoPlace) {
    piece.end = PiecesEnd::Odd;
    piece.next = first;
  } else if (first != end) {
    read_rows_between(window, reader, first, end, piece);
  }
}

/// How far some pieces were read.
struct PiecesRead {
  PiecesEnd end = PiecesEnd::AllRead;
  std::size_t next = kNoPlace;  ///< the place behind the rows that were used, if any were
};

/// As `read_row_pieces`, for `count` pieces from one on.
PiecesRead read_some_pieces(const ByteSource& bytes, std::size_t offset, const RowReader& reader,
                            std::size_t first, std::size_t count, const UseRows& use) {
  std::vector<Piece> pieces(std::min(count, slots_for_threads()));
  PiecesRead read;
  const auto make = [&](std::size_t i, std::size_t slot) {
    const std::size_t piece = first + i;
    read_piece(bytes, offset + piece * kBytesOfPiece, piece == 0, reader, pieces[slot]);
  };
  const auto use_piece = [&](std::size_t, std::size_t slot) {
    const Piece& piece = pieces[slot];
    read.end = piece.end;
    const RowPiece rows{{piece.values.data(), piece.num_rows * reader.num_columns},
                        {piece.starts.data(), piece.num_rows},
                        piece.text_end,
                        piece.num_bytes};
    if (piece.end == PiecesEnd::Fault) return false;
    if (!use(rows)) {
      read.end = PiecesEnd::Stopped;
      return false;
    }
    if (piece.next != kNoPlace) read.next = piece.next;
    return piece.end == PiecesEnd::AllRead;
  };
  make_in_order(count, pieces.size(), make, use_piece);
  return read;
}

std::size_t num_pieces(const ByteSource& bytes, std::size_t offset) {
  return (bytes.size - offset + kBytesOfPiece - 1) / kBytesOfPiece;
}

/// Reads a file's first bytes up to a line end, at most `size`; false after a fault, and if there
/// is no line end.
bool read_head(const ByteSource& bytes, std::size_t size, Array<char>& head) {
  head.resize(std::min(size, bytes.size));
  if (!bytes.read(0, head.mutate())) return false;
  while (!head.empty() && head.back() != '\n') head.resize(head.size() - 1);
  return !head.empty();
}

}  // namespace

RowReader comma_row_reader(std::size_t num_columns) {
  RowReader reader;
  reader.num_columns = num_columns;
  reader.read = [num_columns](const char* begin, const char* end, std::size_t max_rows, double* out,
                              const char** starts) {
    return simd::read_number_rows(begin, end, num_columns, max_rows, out, starts,
                                  simd::Separator::Comma);
  };
  return reader;
}

RowReader template_row_reader(const simd::RowTemplate& row) {
  RowReader reader;
  reader.num_columns = row.num_columns();
  reader.read = [row](const char* begin, const char* end, std::size_t max_rows, double* out,
                      const char** starts) {
    return simd::read_template_rows(begin, end, row, max_rows, out, starts);
  };
  return reader;
}

RowReader number_line_reader(std::size_t num_columns) {
  RowReader reader;
  reader.num_columns = num_columns;
  reader.read = [num_columns](const char* begin, const char* end, std::size_t max_rows, double* out,
                              const char** starts) {
    return read_number_lines(begin, end, num_columns, max_rows, out, starts);
  };
  return reader;
}

PiecesEnd read_row_pieces(const ByteSource& bytes, std::size_t offset, const RowReader& reader,
                          const UseRows& use) {
  return read_some_pieces(bytes, offset, reader, 0, num_pieces(bytes, offset), use).end;
}

const char* read_row_pieces(const char* begin, const char* end, const RowReader& reader,
                            const UseRows& use) {
  const auto size = static_cast<std::size_t>(end - begin);
  const ByteSource bytes{size, {}, {begin, size}};
  const std::size_t count = num_pieces(bytes, 0);
  // Threads are started where there is something to read.
  const PiecesRead first =
      read_some_pieces(bytes, 0, reader, 0, std::min<std::size_t>(count, 1), use);
  const bool goes_on = count > 1 && first.end == PiecesEnd::AllRead;
  const PiecesRead rest = goes_on ? read_some_pieces(bytes, 0, reader, 1, count - 1, use) : first;
  const std::size_t next = rest.next != kNoPlace ? rest.next : first.next;
  return begin + (next != kNoPlace ? next : 0);
}

std::size_t likely_rows(std::size_t num_bytes, const RowPiece& piece) {
  return (num_bytes / piece.num_bytes + 2) * piece.starts.size();
}

std::optional<IndexedRows> index_rows(const ByteSource& bytes, std::size_t offset,
                                      const RowReader& reader) {
  IndexedRows indexed{bytes, offset, reader};
  const auto note = [&](const RowPiece& piece) {
    indexed.first_rows.push_back(indexed.num_rows() + piece.starts.size());
    return true;
  };
  if (read_row_pieces(bytes, offset, reader, note) != PiecesEnd::AllRead) return std::nullopt;
  return indexed;
}

bool read_rows(const IndexedRows& rows, std::size_t first, std::size_t count, double* out) {
  if (count == 0) return true;
  const std::size_t num_columns = rows.reader.num_columns;
  const std::vector<std::size_t>& first_rows = rows.first_rows;
  const auto piece_of = [&first_rows](std::size_t row) {
    const auto behind = std::upper_bound(first_rows.begin(), first_rows.end(), row);
    return static_cast<std::size_t>(behind - first_rows.begin()) - 1;
  };
  const std::size_t end = first + count;
  const std::size_t first_piece = piece_of(first);
  std::size_t piece = first_piece;
  const auto copy = [&](const RowPiece& found) {
    const std::size_t begin_of_piece = first_rows[piece++];
    if (begin_of_piece + found.starts.size() != first_rows[piece]) return false;
    const std::size_t from = std::max(first, begin_of_piece);
    const std::size_t to = std::min(end, first_rows[piece]);
    if (from >= to) return true;  // a piece in which no row begins
    const auto wanted =
        found.values.subspan((from - begin_of_piece) * num_columns, (to - from) * num_columns);
    std::copy(wanted.begin(), wanted.end(), out + (from - first) * num_columns);
    return true;
  };
  return read_some_pieces(rows.bytes, rows.offset, rows.reader, first_piece,
                          piece_of(end - 1) + 1 - first_piece, copy)
             .end == PiecesEnd::AllRead;
}

Array<char> read_head_to(const ByteSource& bytes,
                         const std::function<std::size_t(std::string_view lines)>& end_of) {
  constexpr std::size_t kFirstHead = std::size_t{1} << 18, kMostHead = std::size_t{1} << 24;
  Array<char> head;
  for (std::size_t size = kFirstHead; size <= kMostHead; size *= 16) {
    if (!read_head(bytes, size, head)) break;
    const std::size_t end = end_of({head.data(), head.size()});
    head.resize(end);
    if (end > 0 || size >= bytes.size) return head;
  }
  return {};
}

}  // namespace kinefile::text
