// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

namespace kinefile {

/// Which frame of an old motion each frame of a new one shows, fractions included.
struct TimeMap {
  std::vector<double> old_frames;                   ///< one a new frame, each within the old motion
  std::optional<Timeline> timeline = std::nullopt;  ///< the new motion's; absent: the old one's
};

/// Says that what the old motion shows at `old_frame` is to be shown at `new_frame`.
struct WarpKey {
  double old_frame = 0;
  double new_frame = 0;
};

/// What happens after the last key.
enum class Tail {
  Keep,     ///< the motion keeps its length: its last frame stays where it is
  Extend,   ///< the rest is played as fast as it was, so that the length changes
  Uniform,  ///< the rest is played at the average rate of the last interval between keys
};

/// The curve through the keys.
enum class WarpCurve {
  Linear,   ///< straight pieces: the rate steps at the keys
  Pchip,    ///< Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984): smooth, monotone
  Steffen,  ///< Steffen, Astron. Astrophys. 239 (1990): smooth, monotone
  Hermite,  ///< as Pchip, but with rate 1 at both ends, to join unwarped playback
};

/// How an interval between two keys is run through: u in [0, 1] becomes ease(u).
struct Ease {
  enum class Kind {
    None,      ///< u
    Smooth,    ///< 3u^2 - 2u^3
    Smoother,  ///< 6u^5 - 15u^4 + 10u^3
    In,        ///< u^power
    Out,       ///< 1 - (1 - u)^power
    InOut,     ///< u^power up to the middle, mirrored after it
    Bezier,    ///< the CSS curve cubic-bezier(x1, y1, x2, y2)
  };
  Kind kind = Kind::None;
  double power = 2;
  double x1 = 0, y1 = 0, x2 = 1, y2 = 1;  ///< x1 and x2 in [0, 1]
};

/// Reads the name of an ease: none, smooth, smoother, in, out, in-out (with a power: in:3),
/// bezier:X1,Y1,X2,Y2.
std::optional<Ease> parse_ease(std::string_view text);

/// The value of an ease at u in [0, 1].
double ease_at(const Ease& ease, double u);

struct WarpOptions {
  std::vector<WarpKey> keys = {};  ///< in any order; 0:0 is implied where no key has new frame 0
  Tail tail = Tail::Keep;
  WarpCurve curve = WarpCurve::Linear;
  Ease ease = {};              ///< within every interval between keys; with WarpCurve::Linear only
  bool allow_hold = false;     ///< keys may repeat an old frame
  bool allow_reverse = false;  ///< keys may go back in the old motion
  /// How readily time stretches at each old frame: 0 keeps its rate, 1 changes it most (see
  /// `contact_weights`); shape (old frames); empty: everywhere alike.
  std::vector<double> weights = {};
};

/// Finds the map through keys, for a motion of so many frames.
/// Sources: the format document "forward kinematics and time warping" (piecewise linear);
/// dn/ds = 1 + c(s) k for the weights c, with k such that the keys are met.
/// \errors RTM001 (Usage) if the keys do not give a map: out of the motion, out of order, a hold
///         or a reversal that is not allowed, no room for them
Result<TimeMap> warp_map(std::size_t num_frames, const WarpOptions& options);

/// The map to another frame rate: the same duration, the end included. Where the duration is no
/// whole number of new frames, a last frame that shows the end is added.
/// Frame times that were cut off from a whole rate (0.0083333) stand for that rate.
/// \errors RTM002 (Usage) if there would be more frames than 2^31
Result<TimeMap> resample_map(const Clip& clip, double frame_rate);

/// The map that plays a motion so many times as fast, the end included as in `resample_map`.
/// \errors RTM002 (Usage) if there would be more frames than 2^31
Result<TimeMap> speed_map(const Clip& clip, double speed);

/// Tells where time may stretch without being noticed: 1 where a foot is on the ground, 0 where
/// none is, so that flight keeps its gravity. A foot is on the ground while its lowest part moves
/// slower than 0.2 m/s and lies less than 4 cm above the ground, for 0.1 s or longer.
/// Where the motion has no unit of length, the rest pose is taken to be 1.7 m high.
/// \errors RTM003 if no foot is found
Result<std::vector<double>> contact_weights(const Motion& motion, Diagnostics& diagnostics);

/// What two frames are compared by when two motions are aligned.
struct AlignOptions {
  enum class By {
    Angles,  ///< how the joints are turned in their parents' frames
    Points,  ///< where the joints are, after the best move on the ground
  };
  By by = By::Angles;
};

/// Finds the map that brings `motion` onto `reference`, by dynamic time warping: as many frames as
/// the reference has and its timeline. The map never goes back, and is smooth.
/// Joints are matched by name.
/// Sources: Sakoe and Chiba, IEEE Trans. ASSP 26 (1978); Kovar, Gleicher and Pighin, SIGGRAPH 2002
/// (the distance of point clouds).
/// \errors RTM004 (Usage) if no joint is in both, or a motion has no frames
Result<TimeMap> align_map(const Motion& motion, const Motion& reference,
                          const AlignOptions& options = {});

/// How the rotation of a joint with three rotations is interpolated, in its parent's frame.
enum class RotationInterpolation {
  Slerp,  ///< at a constant rate along the shortest way; Shoemake, SIGGRAPH 1985
  Nlerp,  ///< the chord, normalised: faster, the same way at a rate that varies a little
  /// SQUAD: smooth at the frames; Shoemake 1987. Numbers by Catmull and Rom. At both ends of the
  /// motion the curve leaves along the shortest way. SQUAD, since on captured motion it comes as
  /// near to frames that were left out as the other cubics do that need four rotations (cumulative
  /// Bezier curves: the same to four digits), and nearer than slerp: a third of its error on a
  /// quick motion at 60 frames a second.
  Cubic,
  Euler,  ///< angle by angle, as numbers; the quaternion of a free joint by slerp
};

struct RetimeOptions {
  RotationInterpolation rotation = RotationInterpolation::Slerp;
  bool antialias = false;  ///< average over the frames that are passed over where the map is fast
  /// Numbers that would be made of ones that are not finite become NaN, all angles of a rotation
  /// together; one warning a joint.
  bool lenient = false;
};

/// Shows an old motion by a time map. A frame of the map that is whole returns the old frame bit
/// for bit (not with `antialias` where the map is fast). Joints that turn about one or two axes,
/// or about axes that no rotation can be brought back to, or that share columns with others, are
/// interpolated angle by angle (RTM007). Angles stay continuous: those found anew are the nearest
/// to the straight line between the old ones. The quaternion of a free joint comes out normalised,
/// on the side of the old frame before it.
/// Values of the map beyond the motion stand for its ends; they must be numbers.
/// The new timeline is the map's or else the old one, without times of single frames.
/// With `antialias`, where more than one old frame goes by in a new one, frames are averaged by a
/// Gaussian curve with a sigma of half as many frames, cut at three sigma.
/// \errors RTM005 (InvalidInput) if a joint would have to be interpolated between numbers that are
///         not finite, and not `lenient`
Result<Motion> retime(const Motion& motion, const TimeMap& map, const RetimeOptions& options,
                      Diagnostics& diagnostics);

}  // namespace kinefile
