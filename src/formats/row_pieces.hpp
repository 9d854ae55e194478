// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>

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

}  // namespace kinefile
