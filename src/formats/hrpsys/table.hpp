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

/// One file of a set: one row per frame, with its time and numbers.
struct Table {
  TableRows rows;
  Timeline timeline;

  std::size_t num_frames() const { return rows.starts.size(); }
  /// The number of values in a row after its time, which comes first.
  std::size_t num_values() const { return rows.num_columns - 1; }
  double time(std::size_t frame) const { return rows.times[frame]; }
  /// All values, row after row.
  const Array<double>& values() const { return rows.parts[0].values; }
  const double* row(std::size_t frame) const { return values().data() + frame * num_values(); }
};

/// Reads one file. Lines that start with # are skipped. Empty after an error, which is then in
/// `diagnostics`; a file without rows is an error.
std::optional<Table> parse_table(const text::Source& source, std::optional<double> fps,
                                 Diagnostics& diagnostics);

}  // namespace kinefile::hrpsys
