// SPDX-License-Identifier: MIT
#include "formats/urdf/shapes.hpp"

#include "formats/urdf/codes.hpp"

namespace kinefile::urdf {
namespace {

using robot_file::Primitive;
using text::xml::Attribute;
using text::xml::Element;
using text::xml::find_attribute;
using text::xml::find_child;

/// The first child of a <geometry> that is a primitive, or null: a mesh, or nothing.
const Element* primitive_of(const Element& geometry) {
  for (const char* name : {"box", "cylinder", "sphere", "capsule"}) {
    if (const Element* found = find_child(geometry, name)) return found;
  }
  return nullptr;
}

/// Reads a primitive; empty after a fault. In URDF cylinders and capsules are along z, and the
/// length of a capsule is that of its cylinder.
std::optional<Primitive> read_primitive(Values& values, const Element& element) {
  if (element.name == "box") {
    const auto size = values.vector(element, "size", std::nullopt);
    return size ? std::optional(Primitive{ShapeKind::Box, *size}) : std::nullopt;
  }
  const auto radius = values.number(element, "radius", std::nullopt);
  if (!radius) return std::nullopt;
  if (element.name == "sphere") {
    return Primitive{ShapeKind::Sphere, robot_file::size_of_round(*radius, 2 * *radius)};
  }
  const auto length = values.number(element, "length", std::nullopt);
  if (!length) return std::nullopt;
  if (element.name == "capsule") {
    return Primitive{ShapeKind::Capsule, robot_file::size_of_capsule(*radius, *length)};
  }
  return Primitive{ShapeKind::Cylinder, robot_file::size_of_round(*radius, *length)};
}

std::string_view name_of(const Element& material) {
  const Attribute* name = find_attribute(material, "name");
  return name == nullptr ? std::string_view() : std::string_view(name->value);
}

/// The colour that a <material> itself has, without its opacity.
std::optional<Vec3> own_colour(Values& values, robot_file::ShapeCollector& collector,
                               const Element& material) {
  const Element* colour = find_child(material, "color");
  const Attribute* rgba = colour == nullptr ? nullptr : find_attribute(*colour, "rgba");
  if (rgba == nullptr) return std::nullopt;
  const auto numbers = finite_numbers(rgba->value);
  const bool has_count = numbers.size() == 3 || numbers.size() == 4;
  const Vec3 rgb = has_count ? Vec3(numbers.data()) : Vec3(Vec3::Constant(-1));
  if (robot_file::is_colour(rgb)) return rgb;
  collector.report_no_colour(values.spot(*rgba));
  return std::nullopt;
}

}  // namespace

ShapeReader::ShapeReader(const text::Source& source, Diagnostics& diagnostics, const Element& robot,
                         bool knows_quaternions)
    : values_{source, diagnostics, true},
      collector_(diagnostics, code::kLeftOutShape),
      knows_quaternions_(knows_quaternions) {
  for (const Element* child : robot.children) {
    if (child->name == "material") learn(*child);
  }
}

void ShapeReader::learn(const Element& material) {
  const std::string_view name = name_of(material);
  if (name.empty() || colours_.find(name) != colours_.end()) return;
  if (const auto colour = own_colour(values_, collector_, material))
    colours_.emplace(name, *colour);
}

robot_file::SharedShapes ShapeReader::read(const Element& link) {
  std::vector<VisualShape> shapes;
  for (const Element* child : link.children) {
    if (child->name == "visual") read_visual(*child, shapes);
  }
  return robot_file::shared(std::move(shapes));
}

void ShapeReader::read_visual(const Element& visual, std::vector<VisualShape>& shapes) {
  // A material that one link describes may be named by the next ones, whatever it is on.
  const auto colour = colour_of(visual);
  const Element* geometry = find_child(visual, "geometry");
  const Element* element = geometry == nullptr ? nullptr : primitive_of(*geometry);
  if (element == nullptr) return;
  const Element* origin = find_child(visual, "origin");
  const auto place =
      origin == nullptr ? Origin{} : read_origin(values_, *origin, knows_quaternions_);
  const auto primitive = read_primitive(values_, *element);
  if (!place || !primitive) return;
  collector_.add(*primitive, robot_file::placement_of(place->translation, place->rotation), colour,
                 values_.spot(*element), shapes);
}

/// The colour of the material of a <visual>. A known name counts, as in urdfdom.
std::optional<Vec3> ShapeReader::colour_of(const Element& visual) {
  const Element* material = find_child(visual, "material");
  if (material == nullptr) return std::nullopt;
  const std::string_view name = name_of(*material);
  if (name.empty()) return own_colour(values_, collector_, *material);
  learn(*material);
  const auto known = colours_.find(name);
  return known == colours_.end() ? std::nullopt : std::optional(known->second);
}

}  // namespace kinefile::urdf
