// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/words.hpp"
#include "formats/acclaim/codes.hpp"
#include "formats/acclaim/parser.hpp"
#include "text/numbers.hpp"
#include "text/scanner.hpp"

namespace kinefile::acclaim {
namespace {

using text::equals_ignoring_case;
using text::quoted;

constexpr std::string_view kOmlMark = "#!OML:ASF";

std::string_view value_of_hint(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t:");
  return begin == std::string_view::npos ? std::string_view{} : line.substr(begin);
}

/// Keeps a line. A zero character becomes U+FFFD, because at the start of a file it would look like
/// UTF-16.
void append_line(std::string& lines, std::string_view line) {
  if (!lines.empty()) lines += '\n';
  for (const char c : line) {
    if (c == '\0') {
      lines += "\uFFFD";
    } else {
      lines += c;
    }
  }
}

void set_angle(Parser& parser, AmcHeader& header, AngleUnit unit, const char* at) {
  if (header.angle && *header.angle != unit) {
    parser.error(code::kUnitChanges, "expected one of :DEGREES and :RADIANS, found both", at);
  }
  header.angle = unit;
}

void parse_rate(Parser& parser, AmcHeader& header) {
  const std::string_view token = parser.lexer.take_in_line();
  const text::Number number = text::parse_number(token);
  const bool is_rate = number.fault == text::NumberFault::None && number.value >= kLeastRate &&
                       number.value <= kMostRate;
  if (is_rate) {
    header.samples_per_second = number.value;
    return;
  }
  parser.repair(code::kBadHeader,
                fmt::format("expected frames a second above 0 after :SAMPLES-PER-SECOND, found {}",
                            token.empty() ? "the end of the line" : quoted(token)),
                "the line is left out", token.data());
}

/// Reads a line that starts with a colon.
void parse_keyword(Parser& parser, AmcHeader& header) {
  const std::string_view keyword = parser.lexer.take();
  const std::string_view word = keyword.substr(1);
  if (equals_ignoring_case(word, "DEGREES")) {
    set_angle(parser, header, AngleUnit::Degrees, keyword.data());
  } else if (equals_ignoring_case(word, "RADIANS")) {
    set_angle(parser, header, AngleUnit::Radians, keyword.data());
  } else if (equals_ignoring_case(word, "FORCE-ALL-JOINTS-BE-3DOF")) {
    header.forces_3dof = true;
  } else if (equals_ignoring_case(word, "SAMPLES-PER-SECOND")) {
    parse_rate(parser, header);
  } else if (equals_ignoring_case(word, "asf-file")) {
    header.hint_at = keyword.data();
    header.skeleton_hint = value_of_hint(parser.lexer.take_line());
  } else if (equals_ignoring_case(word, "asf-path")) {
    header.skeleton_path = value_of_hint(parser.lexer.take_line());
  } else if (!equals_ignoring_case(word, "FULLY-SPECIFIED") &&
             !equals_ignoring_case(word, "FRAME-RANGE")) {
    parser.lexer.move_to(keyword.data());
    append_line(header.other_lines, parser.lexer.take_line());
    parser.warn(code::kUnknownHeader,
                fmt::format("expected a keyword of AMC, found {}; it is kept as it stands",
                            quoted(keyword)),
                keyword.data());
    return;
  }
  parser.lexer.take_line();
}

void parse_comment(AmcHeader& header, std::string_view line) {
  if (!text::starts_with_ignoring_case(line, kOmlMark)) {
    append_line(header.other_lines, line);
  } else if (header.skeleton_hint.empty()) {
    header.hint_at = line.data();
    header.skeleton_hint = value_of_hint(line.substr(kOmlMark.size()));
  }
}

}  // namespace

AmcHeader parse_amc_header(Parser& parser) {
  AmcHeader header;
  while (true) {
    const char* line = parser.lexer.position();
    while (line != parser.source.end() && (text::is_blank(*line) || text::is_line_end(*line))) {
      ++line;
    }
    parser.lexer.move_to(line);
    if (line == parser.source.end()) return header;
    if (*line == '#') {
      parse_comment(header, parser.lexer.take_line());
    } else if (*line == ':') {
      parse_keyword(parser, header);
    } else {
      return header;
    }
  }
}

}  // namespace kinefile::acclaim
