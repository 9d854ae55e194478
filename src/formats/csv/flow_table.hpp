// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/csv/columns.hpp"
#include "kinefile/csv.hpp"
#include "kinefile/format.hpp"
#include "text/csv_fields.hpp"

// A flow of servo poses as a table: `time,next,break,sound,s0,...`, a row a pose.
namespace kinefile::csv {

/// Whether a header is that of a flow. \param project  whose names sliders may have; may be null
bool is_flow_header(const std::vector<text::CsvField>& header, const RobotProject* project);

/// Reads the rows of a flow behind its header. Words are 0x2b01 or 0X0000; with
/// `csv::ReadOptions::in_degrees` a number is degrees of a slider that `options.project` shows so.
/// Empty after an error.
std::optional<PoseFlow> read_flow(const TableReader& reader, text::CsvFields& fields,
                                  const std::vector<text::CsvField>& header);

/// Writes a flow of poses alone. \errors CSV001 (Usage) if it has other blocks
Result<void> write_flow(const PoseFlow& flow, const kinefile::WriteOptions& options,
                        const Sink& sink);

}  // namespace kinefile::csv
