// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/csv/columns.hpp"
#include "kinefile/csv.hpp"
#include "kinefile/format.hpp"
#include "text/csv_fields.hpp"

// A flow of servo poses as a table: `time,next,break,sound,s0,...`, one row per pose.
namespace kinefile::csv {

/// Whether a header is that of a flow.
/// \param project  sliders may have its names; may be null
bool is_flow_header(const std::vector<text::CsvField>& header, const RobotProject* project);

/// Reads the rows of a flow after its header. Words are 0x2b01 or 0X0000. With
/// `csv::ReadOptions::in_degrees`, numbers of sliders that `options.project` shows in degrees are
/// degrees. Empty after an error.
std::optional<PoseFlow> read_flow(const TableReader& reader, text::CsvFields& fields,
                                  const std::vector<text::CsvField>& header);

/// Writes a flow that has only poses.
/// \errors CSV001 (Usage) if it has other blocks
Result<void> write_flow(const PoseFlow& flow, const kinefile::WriteOptions& options,
                        const Sink& sink);

}  // namespace kinefile::csv
