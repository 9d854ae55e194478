// SPDX-License-Identifier: MIT
#pragma once

// Biovision Hierarchy. There is no standard; the sources are
// - Meredith and Maddock, "Motion Capture File Formats Explained", University of Sheffield, 2001,
// - a survey of 708 real files from 61 origins, in docs/formats/bvh.md.

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/array.hpp"
namespace kinefile::bvh {

enum class ChannelKind { Position, Rotation, Scale, Unknown };

/// A word of a CHANNELS list.
struct Channel {
  ChannelKind kind = ChannelKind::Unknown;
  std::size_t axis = 0;   ///< 0 x, 1 y, 2 z; unused for an unknown channel
  std::string_view word;  ///< as spelled in the file
};

/// `End Site NAME { OFFSET x y z }`
struct EndSite {
  std::string_view name;  ///< usually empty
  std::array<double, 3> offset{};
};

/// `ROOT NAME { ... }` or `JOINT NAME { ... }`
struct Node {
  std::string_view name;
  std::size_t parent = 0;  ///< index of an earlier node, or kNoParent for a ROOT
  std::array<double, 3> offset{};
  std::vector<Channel> channels;
  std::vector<EndSite> end_sites;
};

/// The content of a BVH file. Views point into the text that was parsed, or into the skeleton that
/// was unbound.
struct File {
  std::vector<Node> nodes;             ///< depth first, as in the file
  std::deque<std::string> made_names;  ///< of nodes without a name, which are views of these
  bool has_motion = false;
  double frame_time = 0;
  std::size_t num_frames = 0;  ///< the rows that exist; the count in the file is not trusted
  std::size_t num_columns = 0;
  Array<double> values;  ///< [frame][column]
};

/// The channel that a word names, whatever its case: "Xposition", "ZROTATION", "yscale".
Channel channel_of_word(std::string_view word);

/// The usual spelling of a known channel; an unknown one as spelled in the file.
std::string spelling(const Channel& channel);

/// Whether a word is special in a hierarchy and therefore ends a list of channels: a keyword, a
/// brace, a comment, the end of the text.
bool is_keyword(std::string_view word);

/// Nodes may be nested this deep.
inline constexpr std::size_t kMaxDepth = 1000;

/// A node may have this many channels.
inline constexpr std::size_t kMaxChannels = 1000;

}  // namespace kinefile::bvh
