// SPDX-License-Identifier: MIT
// What the position channels of a file mean, joint by joint.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "formats/bvh/syntax.hpp"
#include "kinefile/bvh.hpp"
#include "kinefile/skeleton.hpp"

namespace kinefile::bvh {

/// The probable meaning of one node's position channels.
struct PositionGuess {
  std::size_t node = 0;
  PositionMode mode = PositionMode::Replace;
  bool is_clear = false;  ///< the other meaning is clearly wrong
  std::string reason;     ///< for a message: "the lowest point would be at ..."
};

/// Guesses are made from every so many frames of a motion, 64 at the most.
std::size_t sample_step(std::size_t num_frames);

/// Guesses for the nodes with an OFFSET and position channels that allow one. For bones: the
/// meaning that keeps the bone's length. For the joints that carry the figure: the meaning that
/// brings its lowest point to the ground, which is at 0.
/// \param up  the axis that points up, if known
std::vector<PositionGuess> guess_positions(const File& file, std::optional<std::size_t> up);

/// The meaning of every node's position channels, `Replace` or `Add`; shape (nodes).
using PositionModes = std::vector<PositionMode>;

/// What was asked for, with `Auto` replaced by the guesses.
PositionModes settled_positions(const File& file, const Positions& asked,
                                const std::vector<PositionGuess>& guesses);

/// The value of --positions that reads the nodes in this way; "auto" if only that does.
std::string option_of(const File& file, const PositionModes& modes);

/// The value of --positions that reads a file of this skeleton so that it is the same again.
std::string option_of(const Skeleton& skeleton);

/// Reads `replace`, `add`, `auto` or `root=MODE,others=MODE`; empty for another text.
std::optional<Positions> parse_positions(std::string_view text);

}  // namespace kinefile::bvh
