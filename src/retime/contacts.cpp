// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinefile/evidence.hpp"
#include "kinefile/retime.hpp"
#include "kinematics/rates.hpp"
#include "retime/feet.hpp"

namespace kinefile::retime {
namespace {

constexpr double kMostSpeed = 0.2;     // metres per second
constexpr double kMostHeight = 0.04;   // metres above the ground
constexpr double kLeastTime = 0.1;     // seconds
constexpr double kPersonHeight = 1.7;  // metres
constexpr double kGroundShare = 0.02;  // the fraction of frames in which a foot point is at or
                                       // below ground level

/// The length of a unit in metres: that of the skeleton, or one with which the figure stands as
/// high as a person.
double metres_per_unit(const Motion& motion, std::size_t up, Diagnostics& diagnostics) {
  if (motion.skeleton.metres_per_unit > 0) return motion.skeleton.metres_per_unit;
  const double height = standing_height(motion, up);
  if (!(height > 0)) {
    diagnostics.add(Severity::Note, "RTM006",
                    "the motion has no unit of length, and the figure no height; its unit is "
                    "taken to be the metre (--unit-in says otherwise)");
    return 1;
  }
  diagnostics.add(Severity::Note, "RTM006",
                  fmt::format("the motion has no unit of length; the figure, which stands {:.6g} "
                              "units high, is taken to be {} m tall (--unit-in says otherwise)",
                              height, kPersonHeight));
  return kPersonHeight / height;
}

/// The 2nd percentile of heights. The minimum would be wrong where a foot was captured or animated
/// below the ground.
double ground_height(const std::vector<Vec3>& track, Eigen::Index up) {
  std::vector<double> heights;
  for (const Vec3& position : track) {
    if (position.allFinite()) heights.push_back(position[up]);
  }
  if (heights.empty()) return 0;
  const auto rank =
      static_cast<std::ptrdiff_t>(kGroundShare * static_cast<double>(heights.size() - 1));
  std::nth_element(heights.begin(), heights.begin() + rank, heights.end());
  return heights[static_cast<std::size_t>(rank)];
}

/// The speed at a frame in units per second.
double speed_at(const std::vector<Vec3>& track, const Timeline& timeline, std::size_t frame) {
  const Neighbours around = neighbours_of(timeline, frame, track.size());
  return per_second((track[around.after] - track[around.before]).norm(), around.seconds);
}

/// Adds the contacts of a point, which rests on the ground for long enough.
void add_contacts(const FootPoint& point, const std::vector<Vec3>& track, const Timeline& timeline,
                  Eigen::Index up, double metres, std::vector<GroundContact>& contacts) {
  const double highest = ground_height(track, up) + kMostHeight / metres;
  const auto rests = [&](std::size_t frame) {
    return track[frame][up] < highest && speed_at(track, timeline, frame) < kMostSpeed / metres;
  };
  constexpr double kRounding = 1e-9;
  for (std::size_t frame = 0; frame < track.size();) {
    std::size_t end = frame;
    while (end < track.size() && rests(end)) ++end;
    if (end == frame) {
      ++frame;
      continue;
    }
    const double time = time_of_frame(timeline, end - 1) - time_of_frame(timeline, frame);
    if (time >= kLeastTime - kRounding) {
      contacts.push_back({point.joint, point.is_tip, point.tip, frame, end - frame});
    }
    frame = end;
  }
}

}  // namespace

Result<std::vector<GroundContact>> ground_contacts(const Motion& motion, Diagnostics& diagnostics) {
  const auto points = find_foot_points(motion.skeleton);
  if (points.empty()) {
    return fail(make_error(ErrorKind::Usage, "RTM003",
                           "expected a joint whose name says that it is a foot (foot, toe, ankle, "
                           "ball), found none"));
  }
  const FootTracks tracks = track_feet(motion, points);
  const std::size_t up = settle_up_axis(motion, diagnostics).axis;
  const double metres = metres_per_unit(motion, up, diagnostics);
  std::vector<GroundContact> contacts;
  for (std::size_t p = 0; p < points.size(); ++p) {
    add_contacts(points[p], tracks.positions[p], motion.clip.timeline,
                 static_cast<Eigen::Index>(up), metres, contacts);
  }
  return contacts;
}

Result<std::vector<double>> contact_weights(const Motion& motion, Diagnostics& diagnostics) {
  const auto contacts = ground_contacts(motion, diagnostics);
  if (!contacts) return fail(contacts.error());
  std::vector<double> weights(motion.clip.num_frames, 0.0);
  for (const GroundContact& contact : *contacts) {
    std::fill_n(weights.begin() + static_cast<std::ptrdiff_t>(contact.first_frame),
                contact.num_frames, 1.0);
  }
  return weights;
}

}  // namespace kinefile::retime
