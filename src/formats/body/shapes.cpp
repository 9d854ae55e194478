// SPDX-License-Identifier: MIT
#include "formats/body/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "formats/body/codes.hpp"
#include "formats/body/link.hpp"

namespace kinefile::body {
namespace {

using robot_file::Placement;
using robot_file::Primitive;
using text::yaml::Node;
using text::yaml::NodeKind;

/// The largest depth of elements in each other. Every level needs stack.
constexpr std::size_t kMostElementLevels = 100;

/// Elements in which nothing is shown, or only what another file describes.
constexpr std::array<std::string_view, 8> kWithoutShapes = {
    "Skip",       "Collision",         "Resource",           "DirectionalLight",
    "PointLight", "PerspectiveCamera", "OrthographicCamera", "Fog"};

/// Reads the elements of one link.
struct ElementReader {
  Values& values;
  robot_file::ShapeCollector& collector;
  std::vector<VisualShape> shapes = {};

  /// The elements in a list, in a mapping from their types, or one alone.
  void read_elements(const Node& elements, const Placement& placement, std::size_t level) {
    const bool is_mapping = elements.kind == NodeKind::Mapping;
    const bool is_single = is_mapping && find_any(elements, {"type"}) != nullptr;
    if (is_single) {
      read_element(elements, {}, placement, level);
    } else if (is_mapping) {
      for (std::size_t i = 0; i + 1 < elements.children.size(); i += 2) {
        read_element(*elements.children[i + 1], elements.children[i]->text, placement, level);
      }
    } else {
      for (const Node* element : elements.children) read_element(*element, {}, placement, level);
    }
  }

  /// \param type  the key of the element, if it has one
  void read_element(const Node& element, std::string_view type, const Placement& outer,
                    std::size_t level) {
    if (element.kind != NodeKind::Mapping) return;
    if (const Node* own_type = find_any(element, {"type"})) type = own_type->text;
    if (std::find(kWithoutShapes.begin(), kWithoutShapes.end(), type) != kWithoutShapes.end()) {
      return;
    }
    if (level == kMostElementLevels) {
      collector.report_left_out(
          values.spot(element),
          fmt::format("expected at most {} elements in each other, found more",
                      kMostElementLevels));
      return;
    }
    // A Group has no place of its own; all others have, devices too.
    const auto placement = type == "Group" ? std::optional(outer) : placed(element, outer);
    if (!placement) return;
    if (type == "Shape") read_shape(element, *placement);
    const Node* shape = type == "Visual" ? find_any(element, {"shape"}) : nullptr;
    if (shape != nullptr) read_element(*shape, "Shape", *placement, level + 1);
    const Node* elements = find_any(element, {"elements"});
    if (elements != nullptr) read_elements(*elements, *placement, level + 1);
  }

  /// The placement of an element in its link; empty after a fault.
  std::optional<Placement> placed(const Node& element, const Placement& outer) {
    Vec3 translation = Vec3::Zero();
    Quat rotation = Quat::Identity();
    bool is_good = read_translation(values, element, translation);
    is_good &= read_rotation(values, element, rotation);
    const auto scale = vector_or(element, "scale", Vec3::Ones());
    if (!is_good || !scale) return std::nullopt;
    return outer * robot_file::placement_of(translation, rotation, *scale);
  }

  std::optional<Vec3> vector_or(const Node& node, std::string_view key, const Vec3& fallback) {
    const Node* value = find_any(node, {key});
    return value == nullptr ? std::optional(fallback) : values.vector(*value, key);
  }

  void read_shape(const Node& shape, const Placement& placement) {
    const Node* geometry = find_any(shape, {"geometry"});
    const auto primitive = geometry == nullptr ? std::nullopt : read_primitive(*geometry);
    if (!primitive) return;
    collector.add(*primitive, robot_file::along_y(placement, primitive->kind), colour_of(shape),
                  values.spot(*geometry), shapes);
  }

  /// A geometry; empty if it is a mesh or another one that is no primitive, and after a fault.
  std::optional<Primitive> read_primitive(const Node& geometry) {
    const Node* type_node = find_any(geometry, {"type"});
    const std::string_view type = type_node == nullptr ? std::string_view() : type_node->text;
    if (type == "Box") {
      const auto size = required(geometry, "size", &Values::vector);
      return size ? std::optional(Primitive{ShapeKind::Box, *size}) : std::nullopt;
    }
    const bool is_round =
        type == "Sphere" || type == "Cylinder" || type == "Cone" || type == "Capsule";
    const auto radius = is_round ? required(geometry, "radius", &Values::number) : std::nullopt;
    if (!radius) return std::nullopt;
    if (type == "Sphere") {
      return Primitive{ShapeKind::Sphere, robot_file::size_of_round(*radius, 2 * *radius)};
    }
    const auto height = required(geometry, "height", &Values::number);
    if (!height) return std::nullopt;
    if (type == "Capsule") {
      return Primitive{ShapeKind::Capsule, robot_file::size_of_capsule(*radius, *height)};
    }
    return Primitive{type == "Cone" ? ShapeKind::Cone : ShapeKind::Cylinder,
                     robot_file::size_of_round(*radius, *height)};
  }

  /// A value that a geometry must have.
  template <class T>
  std::optional<T> required(const Node& geometry, std::string_view key,
                            std::optional<T> (Values::*read)(const Node&, std::string_view)) {
    const Node* value = find_any(geometry, {key});
    if (value != nullptr) return (values.*read)(*value, key);
    values.error(geometry, code::kMissingKey,
                 fmt::format("expected the {} of a geometry, found none", key));
    return std::nullopt;
  }

  /// The colour of a shape; empty if the file has none, and if that is none.
  std::optional<Vec3> colour_of(const Node& shape) {
    const Node* appearance = find_any(shape, {"appearance"});
    const Node* material = appearance == nullptr ? nullptr : find_any(*appearance, {"material"});
    const Node* diffuse =
        material == nullptr ? nullptr : find_any(*material, {"diffuse", "diffuseColor"});
    if (diffuse == nullptr) return std::nullopt;
    Diagnostics ignored;
    const auto rgb = Values{values.source, values.tree, ignored}.vector(*diffuse, "diffuse");
    if (rgb && robot_file::is_colour(*rgb)) return rgb;
    collector.report_no_colour(values.spot(*diffuse));
    return std::nullopt;
  }
};

}  // namespace

robot_file::SharedShapes read_shapes(Values values, const Node& link,
                                     robot_file::ShapeCollector& collector) {
  values.is_of_shape = true;
  const Node* elements = find_any(link, {"elements"});
  ElementReader reader{values, collector};
  if (elements != nullptr) reader.read_elements(*elements, {}, 0);
  return robot_file::shared(std::move(reader.shapes));
}

}  // namespace kinefile::body
