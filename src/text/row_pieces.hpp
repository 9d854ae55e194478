// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/byte_source.hpp"
#include "simd/template_rows.hpp"

namespace kinefile::text {

/// How rows of one kind are read.
struct RowReader {
  std::size_t num_columns = 0;
  /// Reads many rows, as `simd::read_number_rows` does; it gives where each begins. Behind the end
  /// of the last row may be other text. May be called from several threads at once.
  std::function<simd::NumberRows(const char* begin, const char* end, std::size_t max_rows,
                                 double* out, const char** starts)>
      read = {};
  /// Where in a line a row begins, null if none does. Absent: rows begin where lines do.
  /// \param end  behind the line's end
  const char* (*row_in_line)(const char* line, const char* end) = nullptr;
};

/// Lines of numbers, a comma between each two.
RowReader comma_row_reader(std::size_t num_columns);

/// Rows with a template.
RowReader template_row_reader(const simd::RowTemplate& row);

/// Lines of numbers between blanks; empty lines are passed over.
RowReader number_line_reader(std::size_t num_columns);

/// Whole rows, one after the other.
struct RowPiece {
  std::span<const double> values;       ///< [row][column]
  std::span<const char* const> starts;  ///< where the text of each begins, valid for the call
  const char* end = nullptr;            ///< behind their text
  std::size_t num_bytes = 0;            ///< of their text
};

/// Receives rows, in order, on the calling thread; returns false to stop.
using UseRows = std::function<bool(const RowPiece&)>;

/// How reading rows by pieces ended.
enum class PiecesEnd {
  AllRead,
  Odd,      ///< some text is no row
  Fault,    ///< some bytes could not be read
  Stopped,  ///< by the user of the rows
};

/// Reads rows from a place in a file to its end, on several threads if there is much to read. No
/// more than some pieces are in memory. Rows before an odd one in its piece are used, too. Line
/// ends at the end of the file are passed over. \param offset  where a row begins
PiecesEnd read_row_pieces(const ByteSource& bytes, std::size_t offset, const RowReader& reader,
                          const UseRows& use);

/// The same for a text in memory. The last rows before its end may be left to another reader.
/// \returns  the first row that is another, or is left; or the end
const char* read_row_pieces(const char* begin, const char* end, const RowReader& reader,
                            const UseRows& use);

/// Rows that are read again by their numbers.
struct IndexedRows {
  ByteSource bytes;
  std::size_t offset = 0;  ///< as in `read_row_pieces`
  RowReader reader;
  std::vector<std::size_t> first_rows = {0};  ///< of each piece; then the number of all rows

  std::size_t num_rows() const { return first_rows.back(); }
};

/// Reads all rows once, and notes where they are; empty if `read_row_pieces` does not read all.
std::optional<IndexedRows> index_rows(const ByteSource& bytes, std::size_t offset,
                                      const RowReader& reader);

/// Reads rows [first, first + count), all of which exist, on several threads if they are many.
/// \param out  shape (count, num_columns)
/// \returns    false after a fault, and if the file has other rows now
bool read_rows(const IndexedRows& rows, std::size_t first, std::size_t count, double* out);

/// How much of a file is looked at for the beginning of its rows: at first, and at the most.
inline constexpr std::size_t kFirstHead = std::size_t{1} << 18, kMostHead = std::size_t{1} << 24;

/// Reads a file's first bytes up to a line end, at most `size`; all of them if there are no more.
/// \param head  out: bytes; not empty
/// \returns     false after a fault, and if there is no line end
bool read_head(const ByteSource& bytes, std::size_t size, Array<char>& head);

/// Reads as much of a file's beginning as has an end that is looked for; empty if there is none.
/// \param end_of  the number of bytes that are wanted of some lines; 0 if more are needed
Array<char> read_head_to(const ByteSource& bytes, std::size_t (*end_of)(std::string_view lines));

}  // namespace kinefile::text
