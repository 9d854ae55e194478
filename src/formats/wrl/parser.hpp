// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/robot_file.hpp"
#include "formats/wrl/lexer.hpp"

namespace kinefile::wrl {

/// The state that the parts of the parser share. Its functions report a fault once and then return
/// false.
struct Parser {
  const text::Source& source;
  Diagnostics& diagnostics;
  Lexer lexer;

  robot_file::Spot spot(const Token& token) const { return {&source, token.at()}; }
  bool fail(const Token& token, const char* code, std::string message);
  /// Reports that the next token is not the expected one.
  bool unexpected(std::string_view expected);
  /// Consumes a sign or keyword.
  bool expect(std::string_view word);
};

/// A joint that is being read: fields may be in any order.
struct JointFields {
  robot_file::Link link;
  std::string name;  ///< of its field `name`, not of DEF
  bool has_type = false;
};

/// Reads `count` finite numbers.
bool read_numbers(Parser& parser, std::string_view field, double* out, std::size_t count);

/// Reads the value of a field of a Joint that describes its motion.
/// \param is_known  out: whether it is such a field; otherwise nothing was read
bool read_joint_field(Parser& parser, const Token& field, JointFields& joint, bool& is_known);

/// Skips the value of a field of any type.
/// \param allows_joints  whether Joints in it may be skipped, too, because they do not move
bool skip_value(Parser& parser, bool allows_joints = false);

/// Skips to after the sign that closes the sign that was consumed last.
bool skip_to_closing(Parser& parser, bool allows_joints = false);

}  // namespace kinefile::wrl
