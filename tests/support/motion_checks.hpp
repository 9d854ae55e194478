// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "kinefile/diagnostics.hpp"
#include "kinefile/motion.hpp"

namespace kinefile::test {

/// How far two motions are apart in the world, frame by frame; joints by their names.
struct WorldDifference {
  double position = 0;  ///< of joints; of the size of the first motion
  double tip = 0;       ///< of tips of joints that have as many; of its size, too
  double rotation = 0;  ///< radians
  double shape = 0;     ///< of points of shapes that have the same red in both; of its size, too
  std::size_t num_shapes = 0;
  std::size_t num_joints = 0;
};

/// \param rest  compares the rest poses instead
WorldDifference world_difference(const Motion& a, const Motion& b, bool rest = false);

/// Where shapes are in the world: of each its middle, and the middles of three of its sides; shape
/// (frames, shapes, 4).
/// \param rest  in the rest pose instead
std::vector<Vec3> places_of_shapes(const Motion& motion, bool rest = false);

/// The number of shapes of all joints.
std::size_t num_shapes(const Skeleton& skeleton);

/// The largest coordinate of a motion in the world, and 1 at least.
double world_size(const Motion& motion);

bool same_bits(std::span<const double> a, std::span<const double> b);

/// Whether two skeletons agree in every number and name, bit for bit.
bool same_skeleton(const Skeleton& a, const Skeleton& b);

/// Expects at its end that a motion is what it was at its beginning.
class ExpectUnchanged {
 public:
  explicit ExpectUnchanged(const Motion& motion);
  ~ExpectUnchanged();
  ExpectUnchanged(const ExpectUnchanged&) = delete;
  ExpectUnchanged& operator=(const ExpectUnchanged&) = delete;

 private:
  const Motion& motion_;
  Skeleton skeleton_;
  std::vector<double> values_;
  Timeline timeline_;
};

/// How many diagnostics have a code.
std::size_t count_code(const Diagnostics& diagnostics, std::string_view code);

}  // namespace kinefile::test
