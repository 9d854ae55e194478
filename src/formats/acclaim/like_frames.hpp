// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "formats/column_runs.hpp"
#include "kinefile/array.hpp"
#include "text/row_pieces.hpp"

namespace kinefile::acclaim {

/// Frames of an AMC file whose text is that of its first frame but for the numbers.
struct LikeFrames {
  text::RowReader reader;
  std::vector<ColumnRun> columns;  ///< of its values, in the order of the file
  std::size_t num_columns = 0;
};

/// \param first_frame  the text from its number up to the number of the next frame
/// \param columns      of its values, in the order of the file
/// \returns            empty if the text has other numbers beside these
std::optional<LikeFrames> like_frames(std::string_view first_frame,
                                      std::span<const std::size_t> columns);

struct ReadFrames {
  std::size_t num_frames = 0;
  const char* last = nullptr;  ///< the number of the last frame that was read
};

/// Reads frames of a text in memory that are like the first one and are numbered without a gap, as
/// far as they go. The last ones before the end of the text may be left to another reader.
/// \param begin   the number of a frame
/// \param number  what this number has to be
/// \param values  in: whole rows; out: with the frames that were read
ReadFrames read_like_frames(const LikeFrames& like, const char* begin, const char* end,
                            std::int64_t number, Array<double>& values);

/// Reads the frames of a file from a place to its end; empty if any of them is another.
/// \param offset  as `begin` of the other
std::optional<std::size_t> read_like_frames(const LikeFrames& like, const ByteSource& bytes,
                                            std::size_t offset, std::int64_t number,
                                            Array<double>& values);

/// Where in a text the third frame seems to begin; 0 if there are fewer.
std::size_t third_frame_in(std::string_view text);

}  // namespace kinefile::acclaim
