// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "formats/table_rows.hpp"
#include "kinefile/format.hpp"
#include "kinefile/timeline.hpp"
#include "text/decode.hpp"
#include "text/source.hpp"

namespace kinefile::hrpsys {

/// One file of a set: a row a frame, its time and numbers.
struct Table {
  TableRows rows;
  Timeline timeline;

  std::size_t num_frames() const { return rows.starts.size(); }
  /// The numbers of a row behind its time, which stands before the first of them.
  std::size_t num_values() const { return rows.num_columns - 1; }
  const double* row(std::size_t frame) const {
    return rows.values.data() + frame * rows.num_columns + 1;
  }
};

/// Reads one file. Lines that start with # are left out. Empty after an error, which is then in
/// `diagnostics`; a file without rows is one.
std::optional<Table> parse_table(const text::Source& source, std::optional<double> fps,
                                 Diagnostics& diagnostics);

}  // namespace kinefile::hrpsys
