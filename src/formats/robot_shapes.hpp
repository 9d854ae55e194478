// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/robot_file.hpp"
#include "kinefile/visual_shape.hpp"

// The common part of reading the shapes that show the links of robots.
namespace kinefile::robot_file {

/// An affine map from a nested frame of a file to an outer one: p -> linear p + origin.
struct Placement {
  Mat3 linear = Mat3::Identity();
  Vec3 origin = Vec3::Zero();
};

/// outer_from_inner for the frames of two nested placements.
Placement operator*(const Placement& outer, const Placement& inner);

/// A translation after a rotation after a scale along the axes.
Placement placement_of(const Vec3& translation, const Quat& rotation,
                       const Vec3& scale = Vec3::Ones());

/// A primitive in its own frame, as files describe it.
struct Primitive {
  ShapeKind kind = ShapeKind::Box;
  Vec3 size = Vec3::Ones();  ///< as of a `VisualShape`: cylinders, capsules and cones along z
};

/// The size of a cylinder or a cone.
Vec3 size_of_round(double radius, double height);
/// The size of a capsule.
/// \param height  between the middles of its caps
Vec3 size_of_capsule(double radius, double height);

/// The placement of a primitive in a frame in which cylinders, capsules and cones are along y, as
/// in VRML and in Choreonoid.
Placement along_y(const Placement& placement, ShapeKind kind);

/// Whether three numbers are red, green and blue from 0 to 1.
bool is_colour(const Vec3& rgb);

/// Collects the shapes of a file's links, and reports those that are left out.
class ShapeCollector {
 public:
  /// \param code  of the warnings
  ShapeCollector(Diagnostics& diagnostics, const char* code)
      : diagnostics_(diagnostics), code_(code) {}

  /// Adds a primitive to the shapes of a link. It is left out with a warning if its size is
  /// negative or too large, and without one if a scale makes it a shape of another kind.
  /// \param placement  link_from_shape
  void add(const Primitive& primitive, const Placement& placement,
           const std::optional<Vec3>& colour, const Spot& spot, std::vector<VisualShape>& shapes);

  /// Reports that a shape is left out.
  /// \param fault  "expected ..., found ..."
  void report_left_out(const Spot& spot, std::string_view fault);

  /// Reports that a shape has no colour, because that in the file is none.
  void report_no_colour(const Spot& spot);

  /// Whether another shape may be read or copied; otherwise it is reported once.
  bool take_one(const Spot& spot);

 private:
  void report_size(const Spot& spot);

  Diagnostics& diagnostics_;
  const char* code_;
  std::size_t num_taken_ = 0;
};

/// The largest number of shapes of a robot. A short file can describe very many.
inline constexpr std::size_t kMostShapes = 100'000;

/// The shapes of a link; null if there are none.
SharedShapes shared(std::vector<VisualShape> shapes);

}  // namespace kinefile::robot_file
