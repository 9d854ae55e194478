// SPDX-License-Identifier: MIT
#include "formats/wrl/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "formats/wrl/codes.hpp"
#include "text/numbers.hpp"

namespace kinefile::wrl {
namespace {

using robot_file::Placement;
using robot_file::Primitive;

/// The largest depth of nodes in each other. Every level needs stack.
constexpr std::size_t kMostShapeLevels = 250;

constexpr std::array<std::string_view, 4> kGroups = {"Group", "Anchor", "Billboard", "Collision"};

/// Nodes with children at a place of their own: VRML's, and the prototypes of OpenHRP.
constexpr std::array<std::string_view, 10> kPlacedGroups = {
    "Transform",        "Segment",        "AccelerationSensor", "ForceSensor",  "Gyro",
    "PhotoInterrupter", "PressureSensor", "RangeSensor",        "TorqueSensor", "VisionSensor"};

template <std::size_t size>
bool is_among(const Token& type, const std::array<std::string_view, size>& types) {
  return std::find(types.begin(), types.end(), type.text) != types.end();
}

/// The fields of a node that say where its children are.
struct PlaceFields {
  Vec3 center = Vec3::Zero();
  Vec3 translation = Vec3::Zero();
  Vec3 scale = Vec3::Ones();
  std::array<double, 4> rotation = {0, 0, 1, 0};
  std::array<double, 4> scale_orientation = {0, 0, 1, 0};

  /// Where the numbers of a field are to be; null for other fields.
  std::pair<double*, std::size_t> numbers_of(const Token& field) {
    if (field.is("center")) return {center.data(), 3};
    if (field.is("translation")) return {translation.data(), 3};
    if (field.is("scale")) return {scale.data(), 3};
    if (field.is("rotation")) return {rotation.data(), 4};
    if (field.is("scaleOrientation")) return {scale_orientation.data(), 4};
    return {nullptr, 0};
  }

  /// Source: ISO/IEC 14772-1, 6.52 (Transform).
  Placement placement() const {
    const auto turn = [](const std::array<double, 4>& r) {
      return robot_file::rotation_about({r[0], r[1], r[2]}, r[3]);
    };
    const Quat scaled_axes = turn(scale_orientation);
    return robot_file::placement_of(translation + center, turn(rotation)) *
           robot_file::placement_of(Vec3::Zero(), scaled_axes, scale) *
           robot_file::placement_of(Vec3::Zero(), scaled_axes.conjugate()) *
           robot_file::placement_of(-center, Quat::Identity());
  }
};

}  // namespace

ShapeReader::ShapeReader(const text::Source& source, Diagnostics& diagnostics)
    : parser_{source, ignored_, Lexer({source.end(), 0})},
      stored_(diagnostics, code::kLeftOutShape),
      placed_(diagnostics, code::kLeftOutShape) {}

void ShapeReader::read(const Token& start, std::vector<PlacedPrimitive>& shapes) {
  const auto length = static_cast<std::size_t>(parser_.source.end() - start.at());
  parser_.lexer = Lexer({start.at(), length});
  Content content;
  if (!read_node(0, content)) {
    const Token& found = parser_.lexer.peek();
    stored_.report_left_out(parser_.spot(found), fmt::format("expected a node of VRML, found {}",
                                                             text::quoted(found.text)));
    return;
  }
  shapes.insert(shapes.end(), content.shapes.begin(), content.shapes.end());
}

void ShapeReader::define(const std::string& name, const std::vector<PlacedPrimitive>& shapes) {
  if (shapes.empty()) return;
  Content copy;
  append({shapes, {}, {}}, shapes.front().spot, copy);
  definitions_.insert_or_assign(name, std::move(copy));
}

robot_file::SharedShapes ShapeReader::placed(const std::vector<PlacedPrimitive>& shapes) {
  std::vector<VisualShape> all;
  for (const PlacedPrimitive& shape : shapes) {
    placed_.add(shape.primitive, shape.placement, shape.colour, shape.spot, all);
  }
  return robot_file::shared(std::move(all));
}

/// Adds a copy of another node's content.
void ShapeReader::append(const Content& from, const robot_file::Spot& spot, Content& to) {
  if (from.primitive) to.primitive = from.primitive;
  if (from.colour) to.colour = from.colour;
  for (const PlacedPrimitive& shape : from.shapes) {
    if (!stored_.take_one(spot)) return;
    to.shapes.push_back(shape);
  }
}

bool ShapeReader::read_node(std::size_t level, Content& content) {
  Lexer& lexer = parser_.lexer;
  const Token start = lexer.peek();
  if (start.kind != TokenKind::Word) return false;
  lexer.take();
  if (start.is("NULL")) return true;
  if (!start.is("USE") && !start.is("DEF")) return read_node_of_type(start, level, content);
  if (lexer.peek().kind != TokenKind::Word) return false;
  const std::string name(lexer.take().text);
  if (start.is("USE")) {
    const auto known = definitions_.find(name);
    if (known != definitions_.end()) append(known->second, parser_.spot(start), content);
    return true;
  }
  if (lexer.peek().kind != TokenKind::Word) return false;
  Content own;
  if (!read_node_of_type(lexer.take(), level, own)) return false;
  append(own, parser_.spot(start), content);
  definitions_.insert_or_assign(name, std::move(own));
  return true;
}

/// Reads a node from after its type.
bool ShapeReader::read_node_of_type(const Token& type, std::size_t level, Content& content) {
  if (!parser_.expect("{")) return false;
  if (level < kMostShapeLevels) return read_fields(type, level, content);
  stored_.report_left_out(
      parser_.spot(type),
      fmt::format("expected at most {} nodes in each other, found more", kMostShapeLevels));
  return skip_to_closing(parser_);
}

/// Reads a node from after its brace to after the closing one.
bool ShapeReader::read_fields(const Token& type, std::size_t level, Content& content) {
  if (type.is("Shape")) return read_shape(type, level, content);
  if (type.is("Appearance")) return read_appearance(level, content);
  if (type.is("Material")) return read_material(content);
  if (type.is("Box")) return read_geometry(type, ShapeKind::Box, content);
  if (type.is("Sphere")) return read_geometry(type, ShapeKind::Sphere, content);
  if (type.is("Cylinder")) return read_geometry(type, ShapeKind::Cylinder, content);
  if (type.is("Cone")) return read_geometry(type, ShapeKind::Cone, content);
  const bool is_placed = is_among(type, kPlacedGroups);
  if (is_placed || is_among(type, kGroups)) return read_group(type, is_placed, level, content);
  return skip_to_closing(parser_);
}

/// Calls a function for every field of a node, which reads the field's value, up to after the
/// closing brace.
template <class Function>
bool ShapeReader::for_each_field(const Function& read_field) {
  while (!parser_.lexer.peek().is("}")) {
    if (parser_.lexer.peek().kind != TokenKind::Word) return false;
    const Token field = parser_.lexer.take();
    if (!read_field(field)) return false;
  }
  parser_.lexer.take();
  return true;
}

bool ShapeReader::read_shape(const Token& type, std::size_t level, Content& content) {
  Content parts;
  const bool is_good = for_each_field([&](const Token& field) {
    const bool is_part = field.is("appearance") || field.is("geometry");
    return is_part ? read_node(level + 1, parts) : skip_value(parser_);
  });
  if (!is_good) return false;
  const robot_file::Spot spot = parser_.spot(type);
  if (parts.primitive && stored_.take_one(spot)) {
    const Placement turned = robot_file::along_y({}, parts.primitive->kind);
    content.shapes.push_back({*parts.primitive, turned, parts.colour, spot});
  }
  return true;
}

bool ShapeReader::read_appearance(std::size_t level, Content& content) {
  return for_each_field([&](const Token& field) {
    return field.is("material") ? read_node(level + 1, content) : skip_value(parser_);
  });
}

bool ShapeReader::read_material(Content& content) {
  return for_each_field([&](const Token& field) {
    if (!field.is("diffuseColor")) return skip_value(parser_);
    Vec3 rgb;
    bool is_good = true;
    if (!read_numbers_or_skip(field, rgb.data(), 3, is_good)) return false;
    if (is_good && robot_file::is_colour(rgb)) {
      content.colour = rgb;
    } else {
      stored_.report_no_colour(parser_.spot(field));
    }
    return true;
  });
}

/// The defaults of the fields are VRML's.
bool ShapeReader::read_geometry(const Token& type, ShapeKind kind, Content& content) {
  Vec3 size = Vec3::Constant(2);
  double radius = 1;
  double height = 2;
  bool is_good = true;
  const std::string_view radius_name = kind == ShapeKind::Cone ? "bottomRadius" : "radius";
  const bool is_read = for_each_field([&](const Token& field) {
    if (kind == ShapeKind::Box && field.is("size")) {
      return read_numbers_or_skip(field, size.data(), 3, is_good);
    }
    if (field.is(radius_name)) return read_numbers_or_skip(field, &radius, 1, is_good);
    if (field.is("height")) return read_numbers_or_skip(field, &height, 1, is_good);
    return skip_value(parser_);
  });
  if (!is_read) return false;
  if (!is_good) {
    stored_.report_left_out(parser_.spot(type),
                            fmt::format("expected finite numbers in {}, found others", type.text));
    return true;
  }
  if (kind == ShapeKind::Sphere) height = 2 * radius;
  if (kind != ShapeKind::Box) size = robot_file::size_of_round(radius, height);
  content.primitive = Primitive{kind, size};
  return true;
}

/// \param is_placed  whether the node has a place of its own
bool ShapeReader::read_group(const Token& type, bool is_placed, std::size_t level,
                             Content& content) {
  PlaceFields fields;
  Content children;
  bool is_good = true;
  const bool is_read = for_each_field([&](const Token& field) {
    if (field.is("children")) return read_children(level, children);
    const auto [numbers, count] = fields.numbers_of(field);
    const bool is_of_place = is_placed && numbers != nullptr;
    return is_of_place ? read_numbers_or_skip(field, numbers, count, is_good) : skip_value(parser_);
  });
  if (!is_read) return false;
  if (!is_good) {
    stored_.report_left_out(parser_.spot(type),
                            fmt::format("expected finite numbers in {}, found others", type.text));
    return true;
  }
  const Placement placement = fields.placement();
  for (PlacedPrimitive& shape : children.shapes) {
    shape.placement = placement * shape.placement;
    content.shapes.push_back(std::move(shape));
  }
  return true;
}

/// Reads one node, or several in brackets.
bool ShapeReader::read_children(std::size_t level, Content& content) {
  Lexer& lexer = parser_.lexer;
  if (!lexer.peek().is("[")) return read_node(level + 1, content);
  lexer.take();
  while (!lexer.peek().is("]")) {
    if (!read_node(level + 1, content)) return false;
  }
  lexer.take();
  return true;
}

/// Reads the numbers of a field, or skips its value if it is something else.
/// \param is_good  out: false if it is something else
bool ShapeReader::read_numbers_or_skip(const Token& field, double* out, std::size_t count,
                                       bool& is_good) {
  if (read_numbers(parser_, field.text, out, count)) return true;
  is_good = false;
  const Token& next = parser_.lexer.peek();
  const bool is_word = next.kind == TokenKind::Word && !next.is("IS") &&
                       text::parse_number(next.text).fault == text::NumberFault::NotANumber;
  const bool is_missing = is_word || next.is("}") || next.is("]");
  return is_missing || skip_value(parser_);
}

}  // namespace kinefile::wrl
