// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile::retime {

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
  Keep,     ///< the motion keeps its length: its last frame stays where it is, as a key
  Extend,   ///< the rest is played as fast as it was, so that the length changes
  Uniform,  ///< the rest is played at the average rate of the last interval between keys; after
            ///< one that runs backwards, to the first frame
};

/// The curve through the keys, as monotone as they are. A tail that does not keep the length is
/// straight; a smooth curve goes over into it as smoothly as it may without turning back.
enum class WarpCurve {
  Linear,   ///< straight pieces: the rate steps at the keys
  Pchip,    ///< Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984): smooth, monotone
  Steffen,  ///< Steffen, Astron. Astrophys. 239 (1990): smooth, monotone
  Hermite,  ///< as Pchip, but with rate 1 at both ends (at most three times that of the interval),
            ///< to join unwarped playback
};

/// How an interval between two keys is run through: u in [0, 1] becomes ease(u).
struct Ease {
  enum class Kind {
    None,      ///< u
    Smooth,    ///< 3u^2 - 2u^3
    Smoother,  ///< 6u^5 - 15u^4 + 10u^3
    In,        ///< u^power; power > 0
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
  Ease ease = {};              ///< within every interval between keys, the implied ones included,
                               ///< not in a tail; with WarpCurve::Linear only
  bool allow_hold = false;     ///< keys may repeat an old frame
  bool allow_reverse = false;  ///< keys, and eases that overshoot, may go back in the old motion
  /// How readily time stretches at each old frame: 0 keeps its rate, 1 changes it most (see
  /// `contact_weights`), none below 0; shape (old frames); empty: everywhere alike. With
  /// WarpCurve::Linear and no ease only: weights say by themselves how time runs between keys.
  std::vector<double> weights = {};
};

/// Finds the map through keys, for a motion of so many frames.
/// Sources: the format document "forward kinematics and time warping" (piecewise linear);
/// dn/ds = 1 + c(s) k for the weights c, with k such that the keys are met; between two old frames
/// their mean weight counts.
/// Where the exact old frame is a whole one, that is what is found. The last new frame is the last
/// whole one: with a tail that does not keep the length it need not show the motion's end.
/// \errors RTM001 (Usage) if the keys do not give a map: out of the motion, out of order, a hold
///         or a reversal that is not allowed, no room for them; or more frames than 2^27
Result<TimeMap> warp_map(std::size_t num_frames, const WarpOptions& options);

/// As `warp_map` of so many frames; keys may be in seconds. Frames with times of their own are
/// shown at a steady rate (see `rate_for`), told in a note (RTM009): time runs between the keys
/// evenly in seconds, not in frames. Old frames of keys are the motion's own, new ones are counted
/// at the new rate.
/// \errors RTM001 (Usage) as there; RTM002 (Usage) if the frames' own times do not rise
Result<TimeMap> warp_map(const Timeline& timeline, std::size_t num_frames, WarpOptions options,
                         bool keys_in_seconds, Diagnostics& diagnostics);

/// The map to another frame rate: the same duration, the end included. Where the duration is no
/// whole number of new frames, a last frame that shows the end is added.
/// Frame times that were cut off from a whole rate (0.0083333) stand for that rate, see
/// `nominal_frame_rate`; frames with times of their own are found by these.
/// \errors RTM002 (Usage) if the rate is not above 0, if there would be more frames than 2^27, or
///         if the frames' own times go back
Result<TimeMap> resample_map(const Clip& clip, double frame_rate);

/// The map that plays a motion so many times as fast, the end included as in `resample_map`; frames
/// with times of their own go to their `frame_rate`.
/// \errors RTM002 (Usage) as in `resample_map`
Result<TimeMap> speed_map(const Clip& clip, double speed);

/// The map that brings frames with times of their own to a steady rate, from a time on; the end is
/// included as in `resample_map`. Where frames of a whole rate, counted from 0 s, hold all times
/// (see `frame_that_holds`), these show them bit for bit. Before the first time its frame is shown.
/// \errors RTM002 (Usage) as in `resample_map`
Result<TimeMap> steady_map(const Clip& clip, double frame_rate, double start);

/// The rate for frames with times of their own where these have no place: the one at which their
/// file wants them imported, else `steady_rate`; of other frames their own.
/// \errors RTM002 (Usage) if the times do not rise
Result<SteadyRate> rate_for(const Timeline& timeline);

/// Tells where time may stretch without being noticed: 1 where a foot is on the ground, 0 where
/// none is, so that flight keeps its gravity. Feet are found by their joints' names (foot, toe,
/// ankle, ball), each by the joints furthest from the root that are called so, and their tips.
/// A foot is on the ground while one of these moves slower than 0.2 m/s and lies less than 4 cm
/// above where it is lowest in two frames of a hundred, for 0.1 s or longer.
/// Up is y, or z where the body is further along z from the feet than along the other axes.
/// Where the motion has no unit of length, the rest pose is taken to be 1.7 m high (RTM006).
/// \returns the weights; shape (frames)
/// \errors RTM003 (Usage) if no foot is found
Result<std::vector<double>> contact_weights(const Motion& motion, Diagnostics& diagnostics);

/// What two frames are compared by when two motions are aligned.
struct AlignOptions {
  enum class By {
    Angles,  ///< how the joints are turned in their parents' frames
    Points,  ///< where the joints are, after the best move on the ground; y is up
  };
  By by = By::Angles;
};

/// Finds the map that brings `motion` onto `reference`, by dynamic time warping: as many frames as
/// the reference has and its timeline. The first frames and the last ones meet; in between the map
/// rises everywhere and is smooth. Joints are matched by name.
/// Long motions are compared at 1500 evenly spread frames each, at fewer where there are very many
/// joints. No more than three of these stand still in one motion while the other moves on; where
/// one has over three times as many as the other, twice that ratio is allowed.
/// A motion of one frame shows that frame throughout.
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
/// The new timeline is the map's or else the old one, at its `frame_rate` where frames had times of
/// their own.
/// With `antialias`, where more than one old frame goes by in a new one, frames are averaged by a
/// Gaussian curve with a sigma of half as many frames, cut at three sigma.
/// \errors RTM005 (InvalidInput) if a joint would have to be interpolated between numbers that are
///         not finite, and not `lenient`; RTM008 (Usage) for more than 2^30 values
Result<Motion> apply(const Motion& motion, const TimeMap& map, const RetimeOptions& options,
                     Diagnostics& diagnostics);

/// Interpolates a motion whose frames have times of their own to a steady rate (see `steady_map`);
/// any other stays as it is. \errors those of `steady_map` and of `apply`
Result<Motion> with_steady_rate(const Motion& motion, double frame_rate, double start,
                                const RetimeOptions& options, Diagnostics& diagnostics);

}  // namespace kinefile::retime

#pragma GCC visibility pop
