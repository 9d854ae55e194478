// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "kinefile/skeleton.hpp"
#include "kinefile/world_poses.hpp"

namespace kinefile::edit {

/// The places of a skeleton's joints in one pose, relative to their roots.
struct JointPlaces {
  std::vector<Vec3> joints;  ///< [joint]
  std::vector<Vec3> ends;    ///< [joint]: the mean of its tips and children; itself without any
  double size = 0;           ///< of the skeleton (see `rest_size`)
};

/// The places in a row of poses, which have tips.
/// \param size  of the skeleton
JointPlaces places_of(const Skeleton& skeleton, double size, const PoseArrays& poses,
                      std::size_t row);

/// The places in the rest pose.
JointPlaces rest_places(const Skeleton& skeleton);

/// How far apart two places may be, of the skeleton's size.
struct PairTolerance {
  double strict = 1e-3;  ///< nearer to the plane, a joint is its own half before others are tried
  double near = 0.01;    ///< from the place of the mirror image
};

/// Completes the pairs of halves by places: a joint in the plane through its root is its own half
/// unless its name says a side; a joint whose image lies near another joint is paired with it.
/// Joints pair only if they have the same depth. \param pairs   the partner of every joint,
/// kNoParent if it has none yet \param normal  of the plane of the mirror
void pair_by_place(const Skeleton& skeleton, const JointPlaces& places, const Vec3& normal,
                   const PairTolerance& tolerance, std::vector<std::size_t>& pairs);

/// Makes joints that have nobody on the other side their own halves, if others are paired: those
/// whose names say no side, below a joint that is its own half.
void pair_with_themselves(const Skeleton& skeleton, std::vector<std::size_t>& pairs);

/// How far the pairs are from being each other's mirror images: the largest distance, of the
/// skeleton's size. NaN if a place is not finite.
double asymmetry(const JointPlaces& places, const Vec3& normal,
                 const std::vector<std::size_t>& pairs);

/// The sum of the distances between partners along each axis.
Vec3 distances_of_pairs(const JointPlaces& places, const std::vector<std::size_t>& pairs);

}  // namespace kinefile::edit
