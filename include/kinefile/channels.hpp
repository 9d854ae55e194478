// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

namespace kinefile {

/// The axes of three rotations, outermost first: 0 x, 1 y, 2 z. "ZXY" is {2, 0, 1}.
using RotationOrder = std::array<std::size_t, 3>;

/// Reads an order of rotations, in any case: three of x, y and z of which no neighbours are equal.
std::optional<RotationOrder> parse_rotation_order(std::string_view text);

/// Which joints have channels of their own for position.
enum class PositionChannels {
  AsIs,  ///< those that have them
  Root,  ///< roots alone; every joint turns about three axes
  All,   ///< every joint; every joint turns about three axes
};

struct ChannelOptions {
  std::optional<RotationOrder> order =
      std::nullopt;  ///< absent: each joint's own, or `usual_order` where it has none
  RotationOrder usual_order = {2, 0, 1};
  PositionChannels positions = PositionChannels::AsIs;
  bool adds_positions = false;  ///< new position channels are added to offsets, not in their place;
                                ///< as the motion's own are, if it has any that tell
  bool replaces_offsets = false;  ///< positions are to stand in the place of offsets, whatever the
                                  ///< motion's own do
  bool distinct_axes = false;     ///< joints that turn twice about one axis get `usual_order`
  bool lenient = false;           ///< drop positions that change, with a warning
};

/// Whether a joint turns twice about one axis, as in the order ZXZ.
bool repeats_an_axis(const Joint& joint);

/// Gives a motion other channels for the same movement: the world stays as it is.
/// Joints whose rotations have the order already keep every bit; the others' angles are found
/// anew, each nearest to the frame before, so that curves stay continuous. With `AsIs`, a joint
/// with one rotation, or with some in the order's sequence, keeps them. Joints that turn about or
/// move along other axes than x, y and z, or share columns, get rotations and positions of their
/// own about and along these.
/// A joint that loses its position channels gets them into its offset where they do not change.
/// \errors EDT001 (DataLoss) if they do change, and not `lenient`;
///         EDT002 (Usage) for a joint that moves freely
Result<Motion> with_channels(const Motion& motion, const ChannelOptions& options,
                             Diagnostics& diagnostics);

}  // namespace kinefile
