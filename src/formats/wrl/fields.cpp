// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/words.hpp"
#include "formats/wrl/codes.hpp"
#include "formats/wrl/parser.hpp"
#include "text/numbers.hpp"

namespace kinefile::wrl {
namespace {

using robot_file::JointType;
using robot_file::Link;

constexpr double kLargestId = 4e9;  // far beyond the limit, and fits a size_t on every machine

bool is_number(const Token& token) {
  return token.kind == TokenKind::Word &&
         text::parse_number(token.text).fault != text::NumberFault::NotANumber;
}

bool read_number(Parser& parser, std::string_view field, double& out) {
  return read_numbers(parser, field, &out, 1);
}

bool read_string(Parser& parser, std::string_view field, std::string& out) {
  if (parser.lexer.peek().kind != TokenKind::String) {
    return parser.unexpected(fmt::format("a string as {}", field));
  }
  const Token token = parser.lexer.take();
  out = content_of(token);
  const bool is_closed = token.text.size() > 1 && token.text.ends_with('"');
  return is_closed || parser.fail(token, code::kUnexpectedEnd,
                                  "expected a quote at the end of a string, found the end of the "
                                  "file");
}

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Reads a limit.
/// \param none  what an infinite one becomes, whatever its sign
bool read_one_limit(Parser& parser, std::string_view field, double none, double& out) {
  const text::Number number = text::parse_number(parser.lexer.peek().text);
  const bool is_infinite = number.fault == text::NumberFault::OutOfRange ||
                           (number.fault == text::NumberFault::None && std::isinf(number.value));
  if (!is_infinite) return read_number(parser, field, out);
  parser.lexer.take();
  out = none;
  return true;
}

/// Reads the first limit of a list, or one without brackets; an empty list changes nothing.
bool read_limit(Parser& parser, std::string_view field, double none, double& out) {
  if (!parser.lexer.peek().is("[")) return read_one_limit(parser, field, none, out);
  parser.lexer.take();
  if (!parser.lexer.peek().is("]") && !read_one_limit(parser, field, none, out)) return false;
  return skip_to_closing(parser);
}

bool read_vector(Parser& parser, std::string_view field, Vec3& out) {
  return read_numbers(parser, field, out.data(), 3);
}

bool read_rotation(Parser& parser, Quat& out) {
  double numbers[4];
  if (!read_numbers(parser, "rotation", numbers, 4)) return false;
  out = robot_file::rotation_about({numbers[0], numbers[1], numbers[2]}, numbers[3]);
  return true;
}

bool read_type(Parser& parser, JointFields& joint) {
  const Token token = parser.lexer.peek();
  std::string type;
  if (!read_string(parser, "jointType", type)) return false;
  joint.has_type = !type.empty();
  if (type.empty() || type == "fixed") {
    joint.link.type = JointType::Fixed;
  } else if (type == "free") {
    joint.link.type = JointType::Free;
  } else if (type == "rotate") {
    joint.link.type = JointType::Revolute;
  } else if (type == "slide") {
    joint.link.type = JointType::Prismatic;
  } else if (type == "pseudoContinuousTrack") {
    joint.link.type = JointType::ContinuousTrack;
  } else {
    return parser.fail(token, code::kUnknownType,
                       fmt::format("expected fixed, free, rotate, slide or pseudoContinuousTrack "
                                   "as jointType, found {}",
                                   text::quoted(token.text)));
  }
  return true;
}

bool read_axis(Parser& parser, Link& link) {
  const Token token = parser.lexer.peek();
  link.axis_spot = parser.spot(token);
  if (token.kind != TokenKind::String) return read_vector(parser, "jointAxis", link.axis);
  std::string word;
  if (!read_string(parser, "jointAxis", word)) return false;
  word = lowered(word);
  const bool is_axis = word.size() == 1 && word[0] >= 'x' && word[0] <= 'z';
  if (is_axis) link.axis = Vec3::Unit(word[0] - 'x');
  return is_axis || parser.fail(token, code::kUnknownType,
                                fmt::format("expected X, Y, Z or three numbers as jointAxis, found "
                                            "{}",
                                            text::quoted(token.text)));
}

/// Ids below zero mean no id.
bool read_id(Parser& parser, Link& link) {
  const Token token = parser.lexer.peek();
  double id = 0;
  if (!read_number(parser, "jointId", id)) return false;
  if (id != std::floor(id)) {
    return parser.fail(
        token, code::kBadValue,
        fmt::format("expected a whole number as jointId, found {}", text::quoted(token.text)));
  }
  link.joint_id.reset();
  if (id >= 0) link.joint_id = static_cast<std::size_t>(std::min(id, kLargestId));
  link.id_spot = parser.spot(token);
  return true;
}

/// Reads one of two limits of speed; the larger one is used.
bool read_speed(Parser& parser, std::string_view field, Link& link) {
  double speed = std::numeric_limits<double>::quiet_NaN();
  if (!read_limit(parser, field, kUnlimited, speed)) return false;
  if (std::isnan(speed)) return true;  // an empty list
  const double known = std::isinf(link.max_speed) ? 0 : link.max_speed;
  link.max_speed = std::max(known, std::abs(speed));
  return true;
}

}  // namespace

bool Parser::fail(const Token& token, const char* code, std::string message) {
  spot(token).report(diagnostics, Severity::Error, code, std::move(message));
  return false;
}

bool Parser::unexpected(std::string_view expected) {
  const Token& token = lexer.peek();
  const bool is_end = token.kind == TokenKind::End;
  return fail(token, is_end ? code::kUnexpectedEnd : code::kUnexpectedWord,
              fmt::format("expected {}, found {}", expected, text::quoted(token.text)));
}

bool Parser::expect(std::string_view word) {
  if (!lexer.peek().is(word)) return unexpected(fmt::format("'{}'", word));
  lexer.take();
  return true;
}

bool read_numbers(Parser& parser, std::string_view field, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Token token = parser.lexer.peek();
    if (!is_number(token)) return parser.unexpected(fmt::format("a number of {}", field));
    const text::Number number = text::parse_number(token.text);
    if (number.fault != text::NumberFault::None || !std::isfinite(number.value)) {
      return parser.fail(
          token, code::kBadValue,
          fmt::format("expected a finite number of {}, found {}", field, text::quoted(token.text)));
    }
    out[i] = number.value;
    parser.lexer.take();
  }
  return true;
}

bool read_joint_field(Parser& parser, const Token& field, JointFields& joint, bool& is_known) {
  Link& link = joint.link;
  is_known = true;
  if (field.is("name")) return read_string(parser, "name", joint.name);
  if (field.is("translation")) return read_vector(parser, "translation", link.translation);
  if (field.is("rotation")) return read_rotation(parser, link.rotation);
  if (field.is("jointType")) return read_type(parser, joint);
  if (field.is("jointAxis")) return read_axis(parser, link);
  if (field.is("jointId")) return read_id(parser, link);
  if (field.is("jointValue")) return read_number(parser, "jointValue", link.rest);
  if (field.is("llimit")) return read_limit(parser, "llimit", -kUnlimited, link.lower);
  if (field.is("ulimit")) return read_limit(parser, "ulimit", kUnlimited, link.upper);
  if (field.is("lvlimit")) return read_speed(parser, "lvlimit", link);
  if (field.is("uvlimit")) return read_speed(parser, "uvlimit", link);
  is_known = false;
  return true;
}

bool skip_value(Parser& parser, bool allows_joints) {
  Lexer& lexer = parser.lexer;
  if (lexer.peek().kind == TokenKind::String) {
    lexer.take();
    return true;
  }
  if (lexer.peek().is("[")) {
    lexer.take();
    return skip_to_closing(parser, allows_joints);
  }
  if (is_number(lexer.peek())) {
    while (is_number(lexer.peek())) lexer.take();
    return true;
  }
  if (lexer.peek().kind != TokenKind::Word) return parser.unexpected("a value");
  Token word = lexer.take();
  if (word.is("TRUE") || word.is("FALSE") || word.is("NULL")) return true;
  if (word.is("USE") || word.is("IS")) {
    if (lexer.peek().kind != TokenKind::Word) return parser.unexpected("a name");
    lexer.take();
    return true;
  }
  if (word.is("DEF")) {
    if (lexer.peek().kind != TokenKind::Word) return parser.unexpected("a name");
    lexer.take();
    if (lexer.peek().kind != TokenKind::Word) return parser.unexpected("a node");
    word = lexer.take();
  }
  if (word.is("Joint") && !allows_joints) {
    return parser.fail(word, code::kMisplacedJoint,
                       "expected a Joint in the children of another or in a humanoidBody, found "
                       "it elsewhere");
  }
  return parser.expect("{") && skip_to_closing(parser, allows_joints);
}

bool skip_to_closing(Parser& parser, bool allows_joints) {
  // Counts levels instead of recursion, because files may have any number of levels.
  for (std::size_t depth = 1; depth > 0;) {
    const Token token = parser.lexer.peek();
    if (token.kind == TokenKind::End) return parser.unexpected("'}' or ']'");
    parser.lexer.take();
    if (token.kind == TokenKind::Word && token.is("Joint") && parser.lexer.peek().is("{") &&
        !allows_joints) {
      return parser.fail(token, code::kMisplacedJoint,
                         "expected a Joint in the children of another or in a humanoidBody, found "
                         "it elsewhere");
    }
    if (token.is("{") || token.is("[")) ++depth;
    if (token.is("}") || token.is("]")) --depth;
  }
  return true;
}

}  // namespace kinefile::wrl
