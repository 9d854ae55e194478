// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/column_runs.hpp"
#include "kinefile/body_motion.hpp"
#include "kinefile/format.hpp"
#include "text/csv_fields.hpp"
#include "text/source.hpp"

namespace kinefile::csv {

/// The context of reading a table.
struct TableReader {
  const text::Source& source;
  const kinefile::ReadOptions& options;
  Diagnostics& diagnostics;

  void error(const char* code, std::string message, const char* at) const {
    text::report(source, diagnostics, Severity::Error, code, std::move(message), at);
  }
  /// Whether all quotes so far are correct; reports a fault.
  bool are_quotes_good(const text::CsvFields& fields) const {
    if (fields.fault() == nullptr) return true;
    const bool is_opening = *fields.fault() == '"';
    error("CSV015",
          is_opening ? "expected a quote that closes this one, found the end of the file"
                     : "expected a comma or the end of the line behind a field in quotes",
          fields.fault());
    return false;
  }
};

/// A part without a column whose joint follows another's (see `following_columns`).
struct FollowingPart {
  std::size_t part = 0;
  std::size_t leader = 0;  ///< the part that it follows
  DegreeOfFreedom dof;
};

/// The columns of one component, in the component's order.
struct Group {
  ComponentKind kind = ComponentKind::Values;
  std::string content;
  std::vector<std::size_t> columns;  ///< `kNoColumn`: the value is at rest, or follows
  std::vector<std::string> names;    ///< of joints and links, one per part
  std::vector<FollowingPart> following = {};
  PoseForm pose_form = PoseForm::Quaternion;
};

/// Determines the columns from the header. If `options.skeleton` is given, joints are matched to
/// ids by name. Empty after an error.
std::vector<Group> parse_header(const TableReader& reader,
                                const std::vector<text::CsvField>& fields);

}  // namespace kinefile::csv
