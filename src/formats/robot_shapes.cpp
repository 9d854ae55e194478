// SPDX-License-Identifier: MIT
#include "formats/robot_shapes.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace kinefile::robot_file {
namespace {

/// The largest size of a shape, its largest distance, in metres, and its largest scale. Nothing
/// larger can be shown.
constexpr double kLargestShape = 1e6;

/// How far axes of a shape may be from right angles.
constexpr double kRightAngle = 1e-6;

/// A map with right angles between its columns and the same image of the unit sphere.
Mat3 with_right_angles(const Mat3& linear) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(linear.transpose() * linear);
  return linear * axes.eigenvectors();
}

bool has_right_angles(const Mat3& axes) {
  return std::abs(axes.col(0).dot(axes.col(1))) < kRightAngle &&
         std::abs(axes.col(1).dot(axes.col(2))) < kRightAngle &&
         std::abs(axes.col(2).dot(axes.col(0))) < kRightAngle;
}

/// A map as a rotation after a scale along the axes, which may mirror x; empty if it shears.
std::optional<std::pair<Quat, Vec3>> rotation_and_scale(Mat3 linear) {
  const Vec3 scale = linear.colwise().norm();
  if (!(scale.minCoeff() > 0)) return std::nullopt;
  for (Eigen::Index k = 0; k < 3; ++k) linear.col(k) /= scale[k];
  if (!has_right_angles(linear)) return std::nullopt;
  // Every primitive is its own mirror image along x.
  if (linear.determinant() < 0) linear.col(0) = -linear.col(0);
  return std::pair(Quat(linear).normalized(), scale);
}

bool is_reasonable(const Vec3& size) {
  return size.allFinite() && size.minCoeff() >= 0 && size.maxCoeff() <= kLargestShape;
}

bool is_near(const Placement& placement) {
  return placement.linear.allFinite() && placement.origin.allFinite() &&
         placement.linear.cwiseAbs().maxCoeff() <= kLargestShape &&
         placement.origin.cwiseAbs().maxCoeff() <= kLargestShape;
}

}  // namespace

Placement operator*(const Placement& outer, const Placement& inner) {
  return {outer.linear * inner.linear, outer.origin + outer.linear * inner.origin};
}

Placement placement_of(const Vec3& translation, const Quat& rotation, const Vec3& scale) {
  return {rotation.toRotationMatrix() * scale.asDiagonal(), translation};
}

Vec3 size_of_round(double radius, double height) { return {2 * radius, 2 * radius, height}; }

Vec3 size_of_capsule(double radius, double height) {
  // A negative height must not be hidden by the caps.
  return size_of_round(radius, height < 0 ? height : height + 2 * radius);
}

Placement along_y(const Placement& placement, ShapeKind kind) {
  if (kind == ShapeKind::Box || kind == ShapeKind::Sphere) return placement;
  Placement turned = placement;
  turned.linear.col(1) = -placement.linear.col(2);
  turned.linear.col(2) = placement.linear.col(1);
  return turned;
}

bool is_colour(const Vec3& rgb) {
  return rgb.allFinite() && rgb.minCoeff() >= 0 && rgb.maxCoeff() <= 1;
}

void ShapeCollector::add(const Primitive& primitive, const Placement& placement,
                         const std::optional<Vec3>& colour, const Spot& spot,
                         std::vector<VisualShape>& shapes) {
  if (!is_reasonable(primitive.size) || !is_near(placement)) return report_size(spot);
  auto found = rotation_and_scale(placement.linear);
  if (!found && primitive.kind == ShapeKind::Sphere) {
    found = rotation_and_scale(with_right_angles(placement.linear));
  }
  if (!found) return;
  const Vec3 size = primitive.size.cwiseProduct(found->second);
  if (!is_reasonable(size)) return report_size(spot);
  if (take_one(spot)) {
    shapes.push_back({primitive.kind, size, placement.origin, found->first, colour});
  }
}

void ShapeCollector::report_size(const Spot& spot) {
  report_left_out(spot, fmt::format("expected a size from 0 to {0:.0f} m and a place up to {0:.0f} "
                                    "m away, found another",
                                    kLargestShape));
}

void ShapeCollector::report_left_out(const Spot& spot, std::string_view fault) {
  spot.report(diagnostics_, Severity::Warning, code_,
              fmt::format("{}; the shape is left out", fault));
}

void ShapeCollector::report_no_colour(const Spot& spot) {
  spot.report(diagnostics_, Severity::Warning, code_,
              "expected red, green and blue from 0 to 1, found another color; the shape has none");
}

bool ShapeCollector::take_one(const Spot& spot) {
  if (num_taken_ == kMostShapes) {
    report_left_out(spot, fmt::format("expected at most {} shapes, found more", kMostShapes));
  }
  return num_taken_++ < kMostShapes;
}

SharedShapes shared(std::vector<VisualShape> shapes) {
  if (shapes.empty()) return nullptr;
  return std::make_shared<const std::vector<VisualShape>>(std::move(shapes));
}

}  // namespace kinefile::robot_file
