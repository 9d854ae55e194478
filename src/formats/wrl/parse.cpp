// SPDX-License-Identifier: MIT
#include "formats/wrl/parse.hpp"

#include <fmt/format.h>

#include <deque>
#include <utility>

#include "formats/wrl/codes.hpp"
#include "formats/wrl/parser.hpp"
#include "formats/wrl/shapes.hpp"

namespace kinefile::wrl {
namespace {

/// The largest depth of nested joints. Every level needs stack.
constexpr std::size_t kMostLevels = 250;

class ModelReader {
 public:
  ModelReader(const text::Source& source, Diagnostics& diagnostics)
      : parser_{source, diagnostics, Lexer(source.text())},
        lexer_(parser_.lexer),
        shapes_(source, diagnostics) {}

  std::optional<robot_file::Robot> read() {
    const Token start = {TokenKind::Word, parser_.source.text().substr(0, 0)};
    if (!check_header()) return std::nullopt;
    while (lexer_.peek().kind != TokenKind::End) {
      if (!read_statement()) return std::nullopt;
    }
    if (robot_.links.empty()) {
      parser_.fail(start, code::kNotAModel, "expected a Humanoid with a Joint in it, found none");
      return std::nullopt;
    }
    for (std::size_t l = 0; l < parents_.size(); ++l) {
      if (parents_[l] != kNoParent) robot_.links[l].parent = robot_.links[parents_[l]].name;
    }
    return std::move(robot_);
  }

 private:
  /// Choreonoid skips what is before the header, and reads a file without one, since it is a
  /// comment.
  bool check_header() {
    const std::string_view text = parser_.source.text();
    const std::string_view header = find_header(text);
    if (header.starts_with("#VRML V2.0")) {
      if (header.data() != text.data()) {
        warn_of_header(header.data(), "found it behind other lines or blanks");
      }
      return true;
    }
    const Token& first = lexer_.peek();
    if (header.empty() && starts_as_vrml()) {
      warn_of_header(first.at(), "found none; the file is read as VRML 2.0, as Choreonoid does");
      return true;
    }
    const Token found = header.empty() ? first : Token{TokenKind::Word, header};
    return parser_.fail(
        found, code::kNotAModel,
        fmt::format("expected '#VRML V2.0 utf8', found {}", text::quoted(found.text)));
  }

  void warn_of_header(const char* at, std::string_view what) {
    robot_file::Spot{&parser_.source, at}.report(
        parser_.diagnostics, Severity::Warning, code::kHeader,
        fmt::format("expected '#VRML V2.0 utf8' at the start of the file, {}", what));
  }

  /// Whether the first words can be those of VRML: a prototype, a named node, or a node.
  bool starts_as_vrml() const {
    Lexer ahead = lexer_;
    const Token first = ahead.take();
    if (first.kind != TokenKind::Word) return false;
    const bool is_named = first.is("PROTO") || first.is("EXTERNPROTO") || first.is("DEF");
    return is_named ? ahead.peek().kind == TokenKind::Word : ahead.peek().is("{");
  }

  /// A node, a prototype or a route.
  bool read_statement() {
    if (lexer_.peek().is("PROTO") || lexer_.peek().is("EXTERNPROTO")) return read_prototype();
    if (lexer_.peek().is("ROUTE")) {
      for (int i = 0; i < 4 && lexer_.peek().kind == TokenKind::Word; ++i) lexer_.take();
      return true;
    }
    const Token start = lexer_.peek();
    std::string name;
    Token type;
    if (!read_node_start(name, type)) return false;
    if (!type.is("Humanoid")) return skip_shapes(start, type, not_shown_);
    if (!robot_.links.empty()) {
      return parser_.fail(type, code::kNotAModel, "expected one Humanoid, found another");
    }
    robot_.name = name;
    return read_humanoid();
  }

  /// The defaults of a Joint are in its prototype; other prototypes are skipped.
  bool read_prototype() {
    const bool is_extern = lexer_.take().is("EXTERNPROTO");
    if (lexer_.peek().kind != TokenKind::Word) return parser_.unexpected("a name");
    const bool is_joint = lexer_.take().is("Joint") && !is_extern;
    if (!parser_.expect("[")) return false;
    if (!(is_joint ? read_interface() : skip_to_closing(parser_, true))) return false;
    if (is_extern) return skip_value(parser_, true);
    return parser_.expect("{") && skip_to_closing(parser_, true);
  }

  bool read_interface() {
    while (!lexer_.peek().is("]")) {
      const Token access = lexer_.peek();
      const bool has_value = access.is("field") || access.is("exposedField");
      if (!has_value && !access.is("eventIn") && !access.is("eventOut")) {
        return parser_.unexpected("a field of the prototype");
      }
      lexer_.take();
      for (const char* what : {"a type", "a name"}) {
        if (lexer_.peek().kind != TokenKind::Word) return parser_.unexpected(what);
        field_ = lexer_.take();
      }
      if (has_value && !read_field(defaults_)) return false;
    }
    lexer_.take();
    return true;
  }

  /// Reads the value of the field `field_`, which may be of any kind.
  bool read_field(JointFields& joint) {
    bool is_known = false;
    if (!read_joint_field(parser_, field_, joint, is_known)) return false;
    return is_known || skip_value(parser_);
  }

  /// Reads a node up to the brace after its type, or the name after USE.
  bool read_node_start(std::string& name, Token& type) {
    name.clear();
    if (lexer_.peek().is("DEF")) {
      lexer_.take();
      if (lexer_.peek().kind != TokenKind::Word) return parser_.unexpected("a name");
      name = lexer_.take().text;
    }
    if (lexer_.peek().kind != TokenKind::Word) return parser_.unexpected("a node");
    type = lexer_.take();
    if (!type.is("USE")) return parser_.expect("{");
    if (lexer_.peek().kind != TokenKind::Word) return parser_.unexpected("a name");
    lexer_.take();
    return true;
  }

  bool read_humanoid() {
    while (!lexer_.peek().is("}")) {
      if (lexer_.peek().kind != TokenKind::Word) return parser_.unexpected("a field or '}'");
      const Token field = lexer_.take();
      if (field.is("humanoidBody")) {
        if (!read_children(kNoParent, 0)) return false;
      } else if (field.is("name") && lexer_.peek().kind == TokenKind::String) {
        const std::string name = content_of(lexer_.take());
        if (robot_.name.empty()) robot_.name = name;
      } else if (field.is("segments") || field.is("joints") || field.is("sites") ||
                 field.is("viewpoints")) {
        // The H-Anim lists there repeat nodes of the body.
        if (!skip_value(parser_, true)) return false;
      } else if (!skip_value(parser_)) {
        return false;
      }
    }
    lexer_.take();
    return true;
  }

  /// Reads one node, or several in brackets. Joints are links; Groups may contain Joints.
  bool read_children(std::size_t parent, std::size_t level) {
    if (!lexer_.peek().is("["))
      return lexer_.peek().is("NULL") ? skip_value(parser_) : read_child(parent, level);
    lexer_.take();
    while (!lexer_.peek().is("]")) {
      if (!read_child(parent, level)) return false;
    }
    lexer_.take();
    return true;
  }

  bool read_child(std::size_t parent, std::size_t level) {
    const Token start = lexer_.peek();
    std::string name;
    Token type;
    if (!read_node_start(name, type)) return false;
    if (level == kMostLevels) {
      return parser_.fail(
          start, code::kTooDeep,
          fmt::format("expected at most {} nodes in each other, found more", kMostLevels));
    }
    if (type.is("Joint")) return read_joint(parent, level, name, start);
    if (type.is("Group")) return read_group(parent, level, name);
    return skip_shapes(start, type, shapes_of(parent));
  }

  /// Skips a node without Joints, and reads the shapes in it.
  bool skip_shapes(const Token& start, const Token& type, std::vector<PlacedPrimitive>& shapes) {
    if (!type.is("USE") && !skip_to_closing(parser_)) return false;
    shapes_.read(start, shapes);
    return true;
  }

  /// The shapes of a link; without one, those that nothing shows.
  std::vector<PlacedPrimitive>& shapes_of(std::size_t link) {
    return link == kNoParent ? not_shown_ : shapes_of_links_[link];
  }

  bool read_group(std::size_t parent, std::size_t level, const std::string& name) {
    const std::size_t num_before = shapes_of(parent).size();
    while (!lexer_.peek().is("}")) {
      if (lexer_.peek().kind != TokenKind::Word) return parser_.unexpected("a field or '}'");
      const bool has_children = lexer_.take().is("children");
      if (!(has_children ? read_children(parent, level + 1) : skip_value(parser_))) return false;
    }
    lexer_.take();
    const auto& shapes = shapes_of(parent);
    if (!name.empty()) {
      shapes_.define(name,
                     {shapes.begin() + static_cast<std::ptrdiff_t>(num_before), shapes.end()});
    }
    return true;
  }

  bool read_joint(std::size_t parent, std::size_t level, const std::string& name,
                  const Token& start) {
    const std::size_t index = robot_.links.size();
    if (index == robot_file::kMostLinks) {
      return parser_.fail(
          start, code::kTooManyLinks,
          fmt::format("expected at most {} links, found more", robot_file::kMostLinks));
    }
    robot_.links.emplace_back();
    parents_.push_back(parent);
    shapes_of_links_.emplace_back();
    JointFields joint = defaults_;
    joint.link.spot = parser_.spot(start);
    joint.link.parent_spot = joint.link.spot;
    if (joint.link.axis_spot.source == nullptr) joint.link.axis_spot = joint.link.spot;
    while (!lexer_.peek().is("}")) {
      if (lexer_.peek().kind != TokenKind::Word) return parser_.unexpected("a field or '}'");
      field_ = lexer_.take();
      const bool is_good =
          field_.is("children") ? read_children(index, level + 1) : read_field(joint);
      if (!is_good) return false;
    }
    lexer_.take();
    joint.link.name = name.empty() ? joint.name : name;
    if (joint.link.name.empty()) {
      return parser_.fail(start, code::kMissing, "expected 'DEF NAME' of a Joint, found none");
    }
    if (!joint.has_type) {
      return parser_.fail(start, code::kMissing,
                          fmt::format("expected a jointType of the Joint {}, found none",
                                      text::quoted(joint.link.name)));
    }
    if (!name.empty() && joint.name != name) joint.link.joint_name = joint.name;
    joint.link.shapes = shapes_.placed(shapes_of_links_[index]);
    robot_.links[index] = std::move(joint.link);
    return true;
  }

  Parser parser_;
  Lexer& lexer_;
  Token field_;
  JointFields defaults_;
  robot_file::Robot robot_;
  ShapeReader shapes_;
  std::vector<std::size_t> parents_;  ///< of every link
  std::deque<std::vector<PlacedPrimitive>> shapes_of_links_;
  std::vector<PlacedPrimitive> not_shown_;  ///< shapes outside of all links
};

}  // namespace

std::optional<robot_file::Robot> parse(const text::Source& source, Diagnostics& diagnostics) {
  return ModelReader(source, diagnostics).read();
}

}  // namespace kinefile::wrl
