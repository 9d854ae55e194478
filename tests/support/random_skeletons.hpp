// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "kinefile/motion.hpp"
#include "support/motion_checks.hpp"

namespace kinefile::test {

/// Random motions of every kind of skeleton that the model allows, the same for the same seed.
using RandomSource = std::mt19937_64;

/// What a random skeleton may have.
struct RandomTraits {
  bool rest_rotations = true;
  bool oblique_axes = true;
  bool rest_values = true;
  bool free_joints = false;
  bool tail_translations = true;
  bool tail_scales = true;
  bool shared_columns = true;
  bool unread_columns = true;
  bool several_roots = true;
  bool without_frames = false;
  bool whole_rotations = true;  ///< balls and rotation vectors
  bool gains = true;            ///< values that are not their columns' numbers
};

/// A tree of one to nine joints with 14 frames, smooth but for its size. Names are j0, j1, ...
/// A joint has tail translations or tail scales, not both.
Motion random_motion(RandomSource& random, const RandomTraits& traits);

/// As ASF and AMC have it: one root with a rest rotation, which moves along the world's axes; each
/// other joint turns about some of three axes at right angles and has one tip, where all of its
/// children sit; no rest rotations but the root's.
Motion random_bones(RandomSource& random);

/// A free root and joints of one degree of freedom, with rest rotations; radians and metres. Some
/// joints follow others (mimic joints) and have a column beside, which repeats their values.
Motion random_robot(RandomSource& random);

/// A figure whose halves are each other's image in the plane x = 0, called Left and Right.
/// \param rest_rotations  whether joints rest turned, each as its other half in the mirror
Motion random_symmetric_motion(RandomSource& random, bool rest_rotations);

/// The same motion by the same values of a skeleton whose joints' frames are turned at random; the
/// parent frames of roots, which are the world, are not.
Motion with_turned_frames(const Motion& motion, RandomSource& random);

Vec3 random_vector(RandomSource& random, double size);
Quat random_rotation(RandomSource& random);
double random_number(RandomSource& random, double low, double high);
bool random_chance(RandomSource& random, double probability);
std::size_t random_below(RandomSource& random, std::size_t bound);

}  // namespace kinefile::test
