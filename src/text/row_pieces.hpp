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
/// ends at the end of the file are passed over.
/// \param offset  where a row begins
PiecesEnd read_row_pieces(const ByteSource& bytes, std::size_t offset, const RowReader& reader,
                          const UseRows& use);

/// The same for a text in memory. The last rows before its end may be left to another reader.
/// \returns  the first row that is another, or is left; or the end
const char* read_row_pieces(const char* begin, const char* end, const RowReader& reader,
                            const UseRows& use);

/// How many rows there are if all were as long as those of a piece.
/// \param num_bytes  of the text of all rows
/// \param piece      with a row at the least
std::size_t likely_rows(std::size_t num_bytes, const RowPiece& piece);

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

/// Reads as much of a file's beginning as has an end that is looked for: whole lines, up to 16 MB.
/// Empty if there is none.
/// \param end_of  the number of bytes that are wanted of some lines; 0 if more are needed. The
/// lines
///                stay where they are if it finds an end
Array<char> read_head_to(const ByteSource& bytes,
                         const std::function<std::size_t(std::string_view lines)>& end_of);

}  // namespace kinefile::text
