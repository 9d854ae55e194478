// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/frame_source.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile::retime {

/// Which frame of an old motion each frame of a new one shows, including fractions.
struct TimeMap {
  std::vector<double> old_frames;                   ///< one per new frame, each within the old
                                                    ///< motion
  std::optional<Timeline> timeline = std::nullopt;  ///< of the new motion; absent: that of the old
                                                    ///< one
};

/// The new motion shows at `new_frame` what the old motion shows at `old_frame`.
struct WarpKey {
  double old_frame = 0;
  double new_frame = 0;
};

/// What happens after the last key.
enum class Tail {
  Keep,     ///< the motion keeps its length: its last frame is a key at its old time
  Extend,   ///< the remaining frames keep their old rate, so that the length changes
  Uniform,  ///< the remaining frames are played at the average rate of the last interval between
            ///< keys; if that runs backwards, down to the first frame
};

/// The curve through the keys, monotone where they are. A tail that does not keep the length is
/// straight; a smooth curve joins it as smoothly as possible without reversing.
enum class WarpCurve {
  Linear,   ///< straight pieces: the rate steps at the keys
  Pchip,    ///< Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984): smooth, monotone
  Steffen,  ///< Steffen, Astron. Astrophys. 239 (1990): smooth, monotone
  Hermite,  ///< as Pchip, but with rate 1 at both ends (at most three times that of the interval),
            ///< to join unwarped playback
};

/// How time runs within an interval between two keys: u in [0, 1] becomes ease(u).
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

/// The name of an ease, from which `parse_ease` makes the same ease: "in:3". Numbers are in their
/// shortest exact form; the power 2 is omitted.
std::string word_of(const Ease& ease);

/// The value of an ease at u in [0, 1].
double ease_at(const Ease& ease, double u);

struct WarpOptions {
  std::vector<WarpKey> keys = {};  ///< in any order; 0:0 is implied if no key has new frame 0
  Tail tail = Tail::Keep;
  WarpCurve curve = WarpCurve::Linear;
  Ease ease = {};              ///< within every interval between keys, including implied ones, not
                               ///< in a tail; with WarpCurve::Linear only
  bool allow_hold = false;     ///< keys may repeat an old frame
  bool allow_reverse = false;  ///< keys, and eases that overshoot, may go back in the old motion
  /// How much time may stretch at each old frame: 0 keeps its rate, 1 changes it most (see
  /// `contact_weights`), none below 0; shape (old frames); empty: equal everywhere. Only with
  /// WarpCurve::Linear and no ease, because weights determine how time runs between keys.
  std::vector<double> weights = {};
};

/// Finds the map through keys, for a motion of `num_frames` frames.
/// Sources: the format document "forward kinematics and time warping" (piecewise linear);
/// dn/ds = 1 + c(s) k for the weights c, with k such that the keys are met; between two old frames,
/// c is their mean weight.
/// If the exact old frame is a whole number, the result is exact. The last new frame is the last
/// whole one: with a tail that does not keep the length it may not show the motion's end.
/// \errors RTM001 (Usage) if the keys do not give a map: outside the motion, out of order, a hold
///         or a reversal that is not allowed, not enough frames for them; or more than 2^27 frames
Result<TimeMap> warp_map(std::size_t num_frames, const WarpOptions& options);

/// As above, but keys may be in seconds. Frames with their own times are shown at a steady rate
/// (see `rate_for`), reported in a note (RTM009): between keys, time runs evenly in seconds, not in
/// frames. Old frames of keys are frames of the motion; new frames are counted at the new rate.
/// \errors RTM001 (Usage) as above; RTM002 (Usage) if the frames' own times are not increasing
Result<TimeMap> warp_map(const Timeline& timeline, std::size_t num_frames, WarpOptions options,
                         bool keys_in_seconds, Diagnostics& diagnostics);

/// The map to another frame rate, with the same duration including the end. If the duration is not
/// a whole number of new frames, a last frame that shows the end is added. A frame time that was
/// truncated from a whole rate (0.0083333) stands for that rate, see `nominal_frame_rate`. Frames
/// with their own times are located by these times.
/// \errors RTM002 (Usage) if the rate is not above 0, if there would be more than 2^27 frames, or
///         if the frames' own times decrease
Result<TimeMap> resample_map(const Clip& clip, double frame_rate);

/// The map that plays a motion `speed` times as fast, including the end as in `resample_map`.
/// Frames with their own times get their `frame_rate`.
/// \errors RTM002 (Usage) as in `resample_map`
Result<TimeMap> speed_map(const Clip& clip, double speed);

/// The map that brings frames with their own times to a steady rate, from the time `start` on,
/// including the end as in `resample_map`. If all times coincide with frames of the rate, counted
/// from 0 s (see `frame_that_holds`), these frames keep every bit. Before the first time, the first
/// frame is shown.
/// \errors RTM002 (Usage) as in `resample_map`
Result<TimeMap> steady_map(const Clip& clip, double frame_rate, double start);

/// The steady rate for frames with their own times: the import rate that their file specifies,
/// otherwise `steady_rate`. For other frames their own rate.
/// \errors RTM002 (Usage) if the times are not increasing
Result<SteadyRate> rate_for(const Timeline& timeline);

/// Frames, one after another, in which a point of a foot is on the ground.
struct GroundContact {
  std::size_t joint = 0;  ///< the joint of the foot
  bool is_tip = false;    ///< the point is a tip of the joint, not its origin
  std::size_t tip = 0;    ///< of a tip: its index among the tips of all joints (`PoseArrays::tips`)
  std::size_t first_frame = 0;
  std::size_t num_frames = 0;
};

/// Finds where feet are on the ground. Feet are found by joint names (foot, toe, ankle, ball): of
/// each foot, the joints with such a name that are furthest from the root, and their tips.
/// A point of a foot is on the ground while it moves slower than 0.2 m/s and is less than 4 cm
/// above its 2nd percentile of height, for 0.1 s or longer.
/// Up is as in `settle_up_axis`. If the motion has no unit of length, the figure is assumed to
/// stand 1.7 m high (RTM006).
/// \returns the contacts, sorted by point (joint, then its origin before its tips), then frame
/// \errors RTM003 (Usage) if no foot is found
Result<std::vector<GroundContact>> ground_contacts(const Motion& motion, Diagnostics& diagnostics);

/// Weights for where time may stretch without being noticed: 1 where a foot is on the ground (see
/// `ground_contacts`), 0 where none is, so that flight phases keep natural gravity.
/// \returns the weights; shape (frames)
/// \errors those of `ground_contacts`
Result<std::vector<double>> contact_weights(const Motion& motion, Diagnostics& diagnostics);

/// How two frames are compared when two motions are aligned.
struct AlignOptions {
  enum class By {
    Angles,  ///< by the joints' rotations in their parents' frames
    Points,  ///< by the joints' positions, after the best translation and rotation on the ground; y
             ///< is up
  };
  By by = By::Angles;
};

/// Finds the map that aligns `motion` with `reference`, by dynamic time warping. It has the number
/// of frames and the timeline of the reference. The first frames and the last frames coincide; in
/// between the map is strictly increasing and smooth. Joints are matched by name.
/// Long motions are compared at 1500 evenly spaced frames each, at fewer if there are very many
/// joints. One motion may stand still for at most three of these frames while the other advances;
/// if one has over three times as many frames as the other, for at most twice that ratio.
/// A motion of one frame shows that frame throughout.
/// Sources: Sakoe and Chiba, IEEE Trans. ASSP 26 (1978); Kovar, Gleicher and Pighin, SIGGRAPH 2002
/// (the distance of point clouds).
/// \errors RTM004 (Usage) if no joint is in both, or a motion has no frames
Result<TimeMap> align_map(const Motion& motion, const Motion& reference,
                          const AlignOptions& options, Diagnostics& diagnostics);

/// How the rotation of a joint with three rotations is interpolated, in its parent's frame.
enum class RotationInterpolation {
  Slerp,  ///< at a constant rate along the shortest path; Shoemake, SIGGRAPH 1985
  Nlerp,  ///< along the chord, normalised: faster; the same path at a slightly varying rate
  /// SQUAD: smooth at the frames; Shoemake 1987. Other values by Catmull and Rom. At both ends of
  /// the motion the curve starts along the shortest path. Why SQUAD: on captured motion it predicts
  /// left-out frames as well as other cubics that need four rotations (cumulative Bezier curves:
  /// the same to four digits), and better than slerp: a third of its error on a quick motion at 60
  /// frames per second.
  Cubic,
  Euler,  ///< angle by angle, as numbers, the short way round; the quaternion of a free joint by
          ///< slerp
};

struct RetimeOptions {
  RotationInterpolation rotation = RotationInterpolation::Slerp;
  bool antialias = false;  ///< average over the skipped frames where the map is fast
  /// Numbers interpolated from values that are not finite become NaN, for a rotation all of its
  /// angles; one warning per joint.
  bool lenient = false;
};

/// Applies a time map to a motion. A whole number in the map returns the old frame bit for bit
/// (except with `antialias` where the map is fast). Joints that turn about one or two axes, or
/// about axes that cannot represent every rotation, or that share columns with others, are
/// interpolated angle by angle (RTM007): the short way round, except for columns that are not
/// angles alone; a step of at most half a turn goes as its numbers say. Angles stay continuous:
/// recomputed angles are the nearest to the straight line between the old ones. The quaternion of a
/// free joint is normalised, with the sign nearer to the previous old frame. Values of the map
/// outside the motion are clamped to its ends; they must not be NaN. The new timeline is that of
/// the map, otherwise the old one; if frames had their own times, at its `frame_rate`. With
/// `antialias`, if a new frame spans n > 1 old frames, old frames are averaged with a Gaussian of
/// sigma n / 2, truncated at three sigma. \errors RTM005 (InvalidInput) if a joint needs
/// interpolation between numbers that are not
///         finite, and not `lenient`; RTM008 (Usage) for more than 2^30 values
Result<Motion> apply(const Motion& motion, const TimeMap& map, const RetimeOptions& options,
                     Diagnostics& diagnostics);

/// A motion at another frame rate, of which each frame is made when it is asked for: as `apply`
/// with `resample_map` makes it. Frames must be at equal intervals, and angles in degrees. \errors
/// RTM002 (Usage) as in `resample_map`
Result<LongMotion> resample(LongMotion motion, double frame_rate, const RetimeOptions& options,
                            Diagnostics& diagnostics);

/// Interpolates a motion whose frames have their own times to a steady rate (see `steady_map`); any
/// other motion stays unchanged.
/// \errors those of `steady_map` and of `apply`
Result<Motion> with_steady_rate(const Motion& motion, double frame_rate, double start,
                                const RetimeOptions& options, Diagnostics& diagnostics);

}  // namespace kinefile::retime

#pragma GCC visibility pop
