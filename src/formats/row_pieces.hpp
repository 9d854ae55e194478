// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "kinefile/format.hpp"

namespace kinefile {

/// How reading rows by pieces ended.
enum class PiecesEnd {
  AllRead,
  Odd,      ///< some line is neither a row nor empty
  Fault,    ///< some bytes could not be read
  Stopped,  ///< by the user of the rows
};

/// Receives whole rows, in order, on the calling thread; returns false to stop.
/// \param num_bytes  of the file, for these rows
using UseRows = std::function<bool(std::span<const double> rows, std::size_t num_bytes)>;

/// Reads rows of numbers that are separated by blanks, one a line, from a place in a file to its
/// end, on several threads if there is much to read. Empty lines are passed over. No more than some
/// pieces are in memory.
/// \param offset  where a line begins, or the rest of the line before the first row
PiecesEnd read_row_pieces(const ByteSource& bytes, std::size_t offset, std::size_t num_columns,
                          const UseRows& use);

/// Rows that are read again by their numbers.
struct IndexedRows {
  ByteSource bytes;
  std::size_t offset = 0;  ///< as in `read_row_pieces`
  std::size_t num_columns = 0;
  std::vector<std::size_t> first_rows = {0};  ///< of each piece; then the number of all rows

  std::size_t num_rows() const { return first_rows.back(); }
};

/// Reads all rows once, and notes where they are; empty if `read_row_pieces` does not read all.
std::optional<IndexedRows> index_rows(const ByteSource& bytes, std::size_t offset,
                                      std::size_t num_columns);

/// Reads rows [first, first + count), all of which exist, on several threads if they are many.
/// \param out  shape (count, num_columns)
/// \returns    false after a fault, and if the file has other rows now
bool read_rows(const IndexedRows& rows, std::size_t first, std::size_t count, double* out);

}  // namespace kinefile
