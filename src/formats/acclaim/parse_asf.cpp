// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/words.hpp"
#include "formats/acclaim/codes.hpp"
#include "formats/acclaim/parser.hpp"
#include "text/numbers.hpp"
#include "text/scanner.hpp"

namespace kinefile::acclaim {

using text::equals_ignoring_case;
using text::quoted;

namespace {
constexpr double kTurn = 2 * std::numbers::pi;  // radians
}

bool parse_numbers(Parser& parser, const std::string& what, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view token = parser.lexer.peek();
    const text::Number number = text::parse_number(token);
    if (number.fault != text::NumberFault::None || !std::isfinite(number.value)) {
      parser.error(token.empty() ? code::kUnexpectedEnd : code::kNotANumber,
                   fmt::format("expected {}, found {}", what, quoted(token)), token.data());
      return false;
    }
    parser.lexer.take();
    out[i] = number.value;
  }
  return true;
}

bool parse_axis_order(Parser& parser, AxisOrder& order) {
  const std::string_view token = parser.lexer.peek_in_line();
  std::array<bool, 3> is_there{};
  AxisOrder found{};
  for (std::size_t i = 0; i < token.size() && i < 3; ++i) {
    const std::size_t at = std::string_view("XYZxyz").find(token[i]);
    if (at == std::string_view::npos) break;
    found[i] = at % 3;
    is_there[at % 3] = true;
  }
  const bool is_order = token.size() == 3 && is_there[0] && is_there[1] && is_there[2];
  if (!is_order) {
    parser.error(code::kBadAxisOrder,
                 fmt::format("expected an order of the axes such as XYZ, found {}",
                             token.empty() ? "the end of the line" : quoted(token)),
                 token.data());
    return false;
  }
  parser.lexer.take_in_line();
  order = found;
  return true;
}

bool parse_orientation(Parser& parser, Orientation& orientation, bool has_order) {
  if (!parse_numbers(parser, "3 angles", orientation.angles.data(), 3)) return false;
  if (!has_order) return true;
  const std::string_view token = parser.lexer.peek_in_line();
  if (!token.empty()) return parse_axis_order(parser, orientation.order);
  parser.warn(code::kBadAxisOrder,
              "expected an order of the axes such as XYZ, found the end of the line; read as XYZ",
              token.data());
  return true;
}

std::vector<DofWord> parse_dofs(Parser& parser) {
  std::vector<DofWord> dofs;
  while (true) {
    const std::string_view token = parser.lexer.peek();
    const auto word = std::find_if(kDofWords.begin(), kDofWords.end(), [token](auto known) {
      return equals_ignoring_case(known, token);
    });
    if (word == kDofWords.end()) return dofs;
    parser.lexer.take();
    const auto dof = static_cast<DofWord>(word - kDofWords.begin());
    if (std::find(dofs.begin(), dofs.end(), dof) != dofs.end()) {
      parser.error(
          code::kBadDof,
          fmt::format("expected each degree of freedom once, found {} again", quoted(token)),
          token.data());
      continue;
    }
    dofs.push_back(dof);
  }
}

void check_once(Parser& parser, std::vector<std::string>& seen, std::string_view word) {
  std::string lower = lowered(word);
  if (std::find(seen.begin(), seen.end(), lower) == seen.end()) {
    seen.push_back(std::move(lower));
    return;
  }
  parser.repair(code::kGivenTwice, fmt::format("expected {} once, found it again", quoted(word)),
                "the later one stands", word.data());
}

namespace {

/// The lines of a section that is kept unchanged, without the blank rest of the keyword's line.
std::string take_section_text(Parser& parser) {
  std::string text(parser.lexer.take_lines_to_keyword());
  const std::size_t line_end = text.find_first_of("\r\n");
  const bool starts_blank =
      line_end != std::string::npos && text.find_first_not_of(" \t\v\f") == line_end;
  if (starts_blank) text.erase(0, text.find_first_not_of("\r\n", line_end));
  if (text.find_first_not_of(" \t\v\f\r\n") == std::string::npos) text.clear();
  return text;
}

bool is_keyword(std::string_view token) { return token.starts_with(':'); }

void parse_units(Parser& parser, AsfFile& file) {
  std::vector<std::string> seen;
  while (true) {
    const std::string_view word = parser.lexer.peek();
    if (word.empty() || is_keyword(word)) return;
    parser.lexer.take();
    check_once(parser, seen, word);
    double number = 0;
    if (equals_ignoring_case(word, "mass")) {
      if (parse_numbers(parser, "a number after mass", &number, 1)) file.mass = number;
    } else if (equals_ignoring_case(word, "length")) {
      const char* at = parser.lexer.peek().data();
      if (!parse_numbers(parser, "a number after length", &number, 1)) continue;
      file.length = number;
      if (number > 0) continue;
      parser.error(code::kBadUnit,
                   fmt::format("expected a unit of length above 0, found {}", number), at);
    } else if (equals_ignoring_case(word, "angle")) {
      const std::string_view unit = parser.lexer.peek_in_line();
      const bool is_degrees =
          equals_ignoring_case(unit, "deg") || equals_ignoring_case(unit, "degrees");
      if (is_degrees || text::starts_with_ignoring_case(unit, "rad")) {
        file.angle = is_degrees ? AngleUnit::Degrees : AngleUnit::Radians;
      } else {
        parser.error(code::kBadUnit, fmt::format("expected deg or rad, found {}", quoted(unit)),
                     unit.data());
      }
      parser.lexer.take_in_line();
    } else {
      parser.warn(code::kUnknownWord,
                  fmt::format("expected mass, length or angle, found {}; the line is left out",
                              quoted(word)),
                  word.data());
      parser.lexer.take_line();
    }
  }
}

bool has_word(const std::vector<std::string>& seen, const char* word) {
  return std::find(seen.begin(), seen.end(), word) != seen.end();
}

/// Notes what the root does not say.
/// \param seen  its words, in lower case
void note_missing_words(Parser& parser, const Root& root, const std::vector<std::string>& seen,
                        const char* at) {
  if (!has_word(seen, "order")) {
    parser.note_not_said("the root has no order of its values; it does not move", at);
  }
  const bool turns = std::any_of(root.order.begin(), root.order.end(), is_rotation) ||
                     root.orientation.angles != std::array<double, 3>{};
  if (turns && !has_word(seen, "axis")) {
    parser.note_not_said("the root has no axis, the order of its angles; it is taken to be XYZ",
                         at);
  }
}

void parse_root(Parser& parser, AsfFile& file, const char* at) {
  std::vector<std::string> seen;
  while (true) {
    const std::string_view word = parser.lexer.peek();
    if (word.empty() || is_keyword(word)) break;
    parser.lexer.take();
    check_once(parser, seen, word);
    bool is_good = true;
    if (equals_ignoring_case(word, "axis")) {
      is_good = parse_axis_order(parser, file.root.orientation.order);
    } else if (equals_ignoring_case(word, "order")) {
      file.root.order = parse_dofs(parser);
    } else if (equals_ignoring_case(word, "position")) {
      is_good = parse_numbers(parser, "3 numbers after position", file.root.position.data(), 3);
    } else if (equals_ignoring_case(word, "orientation")) {
      is_good = parse_orientation(parser, file.root.orientation, false);
    } else {
      parser.warn(code::kUnknownWord,
                  fmt::format("expected axis, order, position or orientation, found {}; the line "
                              "is left out",
                              quoted(word)),
                  word.data());
      is_good = false;
    }
    if (!is_good) parser.lexer.take_line();
  }
  const auto length = std::find(file.root.order.begin(), file.root.order.end(), DofWord::Length);
  if (length != file.root.order.end()) file.root.order.erase(length);  // the root has no length
  if (!parser.diagnostics.has_errors()) note_missing_words(parser, file.root, seen, at);
}

/// The sections that were read so far.
struct Sections {
  bool root = false;
  bool bones = false;
  const char* units_at = nullptr;      ///< the keyword
  const char* hierarchy_at = nullptr;  ///< after the keyword
  std::vector<std::string> seen;
  std::vector<bool> has_parent;
};

bool is_known(std::string_view section) {
  constexpr std::array<std::string_view, 8> kSections = {
      "version", "name", "units", "documentation", "root", "bonedata", "hierarchy", "skin"};
  return text::is_one_of(section, kSections);
}

void parse_section(Parser& parser, AsfFile& file, Sections& sections) {
  const std::string_view keyword = parser.lexer.take();
  const std::string_view word = keyword.substr(1);
  if (is_known(word)) check_once(parser, sections.seen, keyword);
  if (equals_ignoring_case(word, "version")) {
    file.version = parser.lexer.take_in_line();
  } else if (equals_ignoring_case(word, "name")) {
    file.name = parser.lexer.take_line();
  } else if (equals_ignoring_case(word, "units")) {
    parse_units(parser, file);
    sections.units_at = keyword.data();
  } else if (equals_ignoring_case(word, "documentation")) {
    file.documentation = take_section_text(parser);
  } else if (equals_ignoring_case(word, "root")) {
    sections.root = true;
    parse_root(parser, file, keyword.data());
  } else if (equals_ignoring_case(word, "bonedata")) {
    sections.bones = true;
    file.bones.clear();  // of an earlier section: the later one is used
    parse_bones(parser, file);
  } else if (equals_ignoring_case(word, "hierarchy")) {
    // It is read when all bones are known, whatever their place.
    sections.hierarchy_at = parser.lexer.position();
    parser.lexer.take_lines_to_keyword();
  } else if (equals_ignoring_case(word, "skin")) {
    file.skin = take_section_text(parser);
  } else {
    parser.warn(code::kUnknownSection,
                fmt::format("expected a section of ASF, found {}; it is kept as it stands",
                            quoted(keyword)),
                keyword.data());
    const std::string_view lines = parser.lexer.take_lines_to_keyword();
    const auto size = static_cast<std::size_t>(lines.data() + lines.size() - keyword.data());
    if (!file.other_sections.empty()) file.other_sections += '\n';
    file.other_sections.append(keyword.data(), size);
  }
}

/// Reads the hierarchy, and checks that nothing follows its end.
void finish_hierarchy(Parser& parser, AsfFile& file, Sections& sections) {
  if (sections.hierarchy_at == nullptr) return;
  parser.lexer.move_to(sections.hierarchy_at);
  sections.has_parent = parse_hierarchy(parser, file);
  const std::string_view word = parser.lexer.peek();
  if (word.empty() || is_keyword(word)) return;
  parser.error(code::kUnexpectedWord,
               fmt::format("expected a section such as :bonedata, found {}", quoted(word)),
               word.data());
}

void check_sections(Parser& parser, const Sections& sections) {
  const char* end = parser.source.end();
  if (!sections.root) parser.error(code::kNoSection, "expected a :root section, found none", end);
  if (!sections.bones) {
    parser.repair(code::kNoSection, "expected a :bonedata section, found none",
                  "the skeleton is the root alone", end);
  } else if (sections.hierarchy_at == nullptr) {
    parser.error(code::kNoSection, "expected a :hierarchy section, found none", end);
  }
}

/// Reports bones that have no parent or are their own ancestor.
void check_reachable(Parser& parser, AsfFile& file, const Sections& sections) {
  if (sections.hierarchy_at == nullptr || parser.diagnostics.has_errors()) return;
  std::vector<std::vector<std::size_t>> children(file.bones.size());
  std::vector<std::size_t> waiting;
  std::vector<bool> is_reached(file.bones.size(), false);
  for (std::size_t b = 0; b < file.bones.size(); ++b) {
    if (!sections.has_parent[b]) continue;
    if (file.bones[b].parent == kNoParent) {
      waiting.push_back(b);
    } else {
      children[file.bones[b].parent].push_back(b);
    }
  }
  while (!waiting.empty()) {
    const std::size_t bone = waiting.back();
    waiting.pop_back();
    is_reached[bone] = true;
    waiting.insert(waiting.end(), children[bone].begin(), children[bone].end());
  }
  for (std::size_t b = 0; b < file.bones.size(); ++b) {
    if (is_reached[b]) continue;
    const bool is_repaired =
        parser.repair(code::kNotInHierarchy,
                      fmt::format("expected bone '{}' in :hierarchy, below root, found it nowhere",
                                  file.bones[b].name),
                      "it hangs on the root", file.bones[b].at);
    if (is_repaired) file.bones[b].parent = kNoParent;
  }
}

/// An angle of the skeleton beyond a full turn of radians; nothing if there is none.
std::optional<double> angle_beyond_a_turn(const Bone& bone) {
  const auto is_beyond = [](double angle) {
    return std::isfinite(angle) && std::abs(angle) > kTurn;
  };
  for (const double angle : bone.axis.angles) {
    if (is_beyond(angle)) return angle;
  }
  for (std::size_t i = 0; i < std::min(bone.limits.size(), bone.dofs.size()); ++i) {
    if (!is_rotation(bone.dofs[i])) continue;
    for (const double limit : {bone.limits[i].low, bone.limits[i].high}) {
      if (is_beyond(limit)) return limit;
    }
  }
  return std::nullopt;
}

/// Notes units that the file does not say, and warns of radians that look like degrees.
void check_units(Parser& parser, const AsfFile& file, const Sections& sections) {
  const char* const at =
      sections.units_at != nullptr ? sections.units_at : parser.source.text().data();
  if (!file.length) {
    parser.note_not_said("the file does not say its unit of length; it is taken to be 1", at);
  }
  if (!file.angle) {
    parser.note_not_said("the file does not say its unit of angles; degrees are assumed", at);
  }
  if (file.angle != AngleUnit::Radians) return;
  for (const Bone& bone : file.bones) {
    const auto angle = angle_beyond_a_turn(bone);
    if (!angle) continue;
    parser.warn(code::kLikeDegrees,
                fmt::format("expected radians, as the file says, found {} for bone '{}', which "
                            "looks like degrees",
                            *angle, bone.name),
                bone.at);
    return;
  }
}

/// The lines before the first section: comments, unchanged.
std::string leading_comments(std::string_view text) {
  std::string comments;
  while (true) {
    const std::size_t begin = text.find_first_not_of(" \t\v\f\r\n");
    if (begin == std::string_view::npos || text[begin] != '#') return comments;
    text.remove_prefix(begin);
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    if (!comments.empty()) comments += '\n';
    comments += line;
    text.remove_prefix(line.size());
  }
}

}  // namespace

AsfFile parse_asf(const text::Source& source, bool lenient, Diagnostics& diagnostics) {
  Parser parser{source, lenient, diagnostics, Lexer(source.text())};
  AsfFile file;
  Sections sections;
  file.comments = leading_comments(source.text());
  const std::string_view first = parser.lexer.peek();
  if (!is_keyword(first)) {
    parser.error(
        first.empty() ? code::kUnexpectedEnd : code::kNotAsf,
        fmt::format("expected a section such as :version or :root, found {}", quoted(first)),
        first.data());
    return file;
  }
  while (true) {
    const std::string_view word = parser.lexer.peek();
    if (word.empty()) break;
    if (is_keyword(word)) {
      parse_section(parser, file, sections);
      continue;
    }
    parser.error(code::kUnexpectedWord,
                 fmt::format("expected a section such as :bonedata, found {}", quoted(word)),
                 word.data());
    parser.lexer.take_lines_to_keyword();
  }
  finish_hierarchy(parser, file, sections);
  check_sections(parser, sections);
  check_reachable(parser, file, sections);
  if (!diagnostics.has_errors()) check_units(parser, file, sections);
  return file;
}

}  // namespace kinefile::acclaim
