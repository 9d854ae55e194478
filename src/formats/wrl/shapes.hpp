// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/robot_shapes.hpp"
#include "formats/wrl/parser.hpp"

namespace kinefile::wrl {

/// A primitive in the frame of a node.
struct PlacedPrimitive {
  robot_file::Primitive primitive;
  robot_file::Placement placement;  ///< node_from_primitive
  std::optional<Vec3> colour;
  robot_file::Spot spot;
};

/// Reads the primitives in the nodes of a VRML text. Faults are warnings, since a robot moves
/// without its shapes.
/// Source: ISO/IEC 14772-1, chapter 6: Shape, Transform, Group and the geometries.
class ShapeReader {
 public:
  ShapeReader(const text::Source& source, Diagnostics& diagnostics);

  /// Reads a node, or USE of one, and adds its shapes.
  /// \param start  the first token of a node of which the brackets are known to match
  void read(const Token& start, std::vector<PlacedPrimitive>& shapes);

  /// Gives a name to some shapes, for USE.
  void define(const std::string& name, const std::vector<PlacedPrimitive>& shapes);

  /// The shapes of a link; null if there are none.
  robot_file::SharedShapes placed(const std::vector<PlacedPrimitive>& shapes);

 private:
  /// What a node is to the one that contains it.
  struct Content {
    std::vector<PlacedPrimitive> shapes;
    std::optional<robot_file::Primitive> primitive;  ///< of a geometry
    std::optional<Vec3> colour;                      ///< of an Appearance or a Material
  };

  bool read_node(std::size_t level, Content& content);
  bool read_node_of_type(const Token& type, std::size_t level, Content& content);
  bool read_fields(const Token& type, std::size_t level, Content& content);
  template <class Function>
  bool for_each_field(const Function& read_field);
  bool read_shape(const Token& type, std::size_t level, Content& content);
  bool read_appearance(std::size_t level, Content& content);
  bool read_material(Content& content);
  bool read_geometry(const Token& type, ShapeKind kind, Content& content);
  bool read_group(const Token& type, bool is_placed, std::size_t level, Content& content);
  bool read_children(std::size_t level, Content& content);
  bool read_numbers_or_skip(const Token& field, double* out, std::size_t count, bool& is_good);
  void append(const Content& from, const robot_file::Spot& spot, Content& to);

  Diagnostics ignored_;
  Parser parser_;
  robot_file::ShapeCollector stored_;  ///< counts the shapes in lists, of which names have copies
  robot_file::ShapeCollector placed_;
  std::map<std::string, Content, std::less<>> definitions_;
};

}  // namespace kinefile::wrl
