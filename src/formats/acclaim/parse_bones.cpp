// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "base/words.hpp"
#include "formats/acclaim/codes.hpp"
#include "formats/acclaim/parser.hpp"
#include "text/numbers.hpp"
#include "text/scanner.hpp"

namespace kinefile::acclaim {
namespace {

using text::equals_ignoring_case;
using text::quoted;

constexpr double kUnitTolerance = 1e-3;  // six printed digits have an error of 1e-6

/// The parts of the current bone that were read, and their places.
struct BoneParts {
  const char* begin = nullptr;
  const char* name_at = nullptr;
  const char* direction_at = nullptr;
  const char* length_at = nullptr;
  const char* limits_at = nullptr;
  bool has_axis = false;
  bool is_broken = false;  ///< a fault has been reported already
  std::vector<std::string> seen = {};
};

struct Bones {
  Parser& parser;
  AsfFile& file;
  std::unordered_map<std::string, std::size_t> index_of_name = {};  ///< in lower case
  std::unordered_map<std::string, std::size_t> index_of_id = {};
};

void parse_limits(Parser& parser, Bone& bone) {
  std::vector<double> numbers;
  while (true) {
    const std::string_view token = parser.lexer.peek();
    const text::Number number = text::parse_number(token);
    if (number.fault != text::NumberFault::None || std::isnan(number.value)) break;
    parser.lexer.take();
    numbers.push_back(number.value);
  }
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    bone.limits.push_back({numbers[i], numbers[i + 1]});
  }
  if (numbers.size() % 2 == 0) return;
  const std::string_view token = parser.lexer.peek();
  parser.error(code::kNotANumber,
               fmt::format("expected a limit's second number, found {}", quoted(token)),
               token.data());
}

/// Whether a line of a bone can start with this word.
bool is_bone_word(std::string_view word) {
  constexpr std::array<std::string_view, 9> kWords = {
      "id", "name", "direction", "length", "axis", "dof", "limits", "bodymass", "cofmass"};
  return text::is_one_of(word, kWords);
}

/// Reads one line of a bone. Returns false at `end`, or if the bone cannot continue.
bool parse_bone_word(Parser& parser, Bone& bone, BoneParts& parts) {
  const std::string_view word = parser.lexer.peek();
  if (word.empty() || word.starts_with(':') || equals_ignoring_case(word, "begin")) {
    parser.error(word.empty() ? code::kUnexpectedEnd : code::kUnexpectedWord,
                 fmt::format("expected end after the bone's last line, found {}", quoted(word)),
                 word.data());
    parts.is_broken = true;
    return false;
  }
  parser.lexer.take();
  bool is_good = true;
  if (equals_ignoring_case(word, "end")) return false;
  if (is_bone_word(word)) check_once(parser, parts.seen, word);
  if (equals_ignoring_case(word, "id")) {
    bone.id = parser.lexer.take_in_line();
  } else if (equals_ignoring_case(word, "name")) {
    const std::string_view name = parser.lexer.take_in_line();
    bone.name = name;
    parts.name_at = name.data();
  } else if (equals_ignoring_case(word, "direction")) {
    parts.direction_at = word.data();
    is_good = parse_numbers(parser, "3 numbers after direction", bone.direction.data(), 3);
  } else if (equals_ignoring_case(word, "length")) {
    parts.length_at = word.data();
    is_good = parse_numbers(parser, "a number after length", &bone.length, 1);
  } else if (equals_ignoring_case(word, "axis")) {
    parts.has_axis = true;
    is_good = parse_orientation(parser, bone.axis, true);
  } else if (equals_ignoring_case(word, "dof")) {
    bone.dofs = parse_dofs(parser);
  } else if (equals_ignoring_case(word, "limits")) {
    parts.limits_at = word.data();
    parse_limits(parser, bone);
  } else if (equals_ignoring_case(word, "bodymass")) {
    bone.body_mass = parser.lexer.take_in_line();
  } else if (equals_ignoring_case(word, "cofmass")) {
    bone.cof_mass = parser.lexer.take_in_line();
  } else {
    parser.warn(
        code::kUnknownWord,
        fmt::format("expected a line of a bone, found {}; it is kept as it stands", quoted(word)),
        word.data());
    parser.lexer.move_to(word.data());
    bone.other_lines.emplace_back(parser.lexer.take_line());
  }
  if (!is_good) {
    parts.is_broken = true;
    parser.lexer.take_line();
  }
  return true;
}

void check_direction(Parser& parser, const Bone& bone, const BoneParts& parts) {
  const auto& d = bone.direction;
  const double norm = std::hypot(d[0], d[1], d[2]);
  if (std::abs(norm - 1) <= kUnitTolerance || (norm == 0 && bone.length == 0)) return;
  parser.warn(
      code::kNotUnitLength,
      fmt::format("expected a direction of length 1 for bone '{}', found one of {}; {}", bone.name,
                  norm, norm > 0 ? "it is normalised" : "the bone has no length"),
      parts.direction_at);
}

/// Warns of limits whose first number is above the second.
void check_limits(Parser& parser, const Bone& bone, const BoneParts& parts) {
  const auto swapped = std::find_if(bone.limits.begin(), bone.limits.end(),
                                    [](const Limit& limit) { return limit.low > limit.high; });
  if (swapped == bone.limits.end()) return;
  parser.warn(code::kSwappedLimits,
              fmt::format("expected limits of bone '{}' with the lower one first, found ({} {})",
                          bone.name, swapped->low, swapped->high),
              parts.limits_at);
}

/// Notes or warns of what no error needs.
void check_values(Parser& parser, const Bone& bone, const BoneParts& parts) {
  if (bone.length < 0) {
    parser.warn(code::kNegativeLength,
                fmt::format("expected a length from 0 up for bone '{}', found {}; the bone points "
                            "against its direction",
                            bone.name, bone.length),
                parts.length_at);
  }
  if (!parts.has_axis && std::any_of(bone.dofs.begin(), bone.dofs.end(), is_rotation)) {
    parser.note_not_said(
        fmt::format("bone '{}' turns and has no axis; it is taken to be 0 0 0 XYZ", bone.name),
        parts.begin);
  }
  check_limits(parser, bone, parts);
}

/// Reports missing parts of the bone. Returns whether it can be used.
bool check_bone(Bones& bones, Bone& bone, BoneParts& parts) {
  Parser& parser = bones.parser;
  if (parts.is_broken) return false;
  if (bone.name.empty()) {
    parser.error(code::kIncompleteBone, "expected a name for this bone, found none", parts.begin);
    return false;
  }
  if (!is_bone_name(bone.name) && !equals_ignoring_case(bone.name, "root")) {
    parser.error(code::kBadName,
                 fmt::format("expected a name that is no number and none of begin and end, found "
                             "'{}'",
                             bone.name),
                 parts.name_at);
    return false;
  }
  const bool has_end = parts.direction_at != nullptr && parts.length_at != nullptr;
  if (!has_end &&
      !parser.repair(code::kIncompleteBone,
                     fmt::format("expected direction and length for bone '{}', found {}", bone.name,
                                 parts.length_at != nullptr      ? "no direction"
                                 : parts.direction_at != nullptr ? "no length"
                                                                 : "neither"),
                     "the bone has no length", parts.begin)) {
    return false;
  }
  if (!has_end) {
    bone.direction = {};
    bone.length = 0;
  } else {
    check_direction(parser, bone, parts);
  }
  if (parts.limits_at != nullptr && bone.limits.size() != bone.dofs.size()) {
    parser.warn(code::kLimitsDiffer,
                fmt::format("expected a pair of limits for each of the {} degrees of freedom of "
                            "'{}', found {}",
                            bone.dofs.size(), bone.name, bone.limits.size()),
                parts.limits_at);
  }
  check_values(parser, bone, parts);
  return true;
}

void keep_bone(Bones& bones, Bone bone, const BoneParts& parts) {
  Parser& parser = bones.parser;
  bone.at = parts.name_at;
  const std::string name = lowered(bone.name);
  const bool is_known = name == "root" || bones.index_of_name.contains(name);
  if (is_known) {
    parser.error(code::kRepeatedName,
                 fmt::format("expected a name that no other bone has, found '{}' again", bone.name),
                 parts.name_at);
    return;
  }
  if (!bone.id.empty() && !bones.index_of_id.try_emplace(bone.id, bones.file.bones.size()).second) {
    parser.warn(code::kRepeatedId,
                fmt::format("expected an id that no other bone has, found {} again, for '{}'",
                            bone.id, bone.name),
                parts.begin);
  }
  bones.index_of_name[name] = bones.file.bones.size();
  bones.file.bones.push_back(std::move(bone));
}

}  // namespace

void parse_bones(Parser& parser, AsfFile& file) {
  Bones bones{parser, file};
  while (true) {
    const std::string_view word = parser.lexer.peek();
    if (word.empty() || word.starts_with(':')) return;
    parser.lexer.take();
    if (!equals_ignoring_case(word, "begin")) {
      parser.error(code::kUnexpectedWord,
                   fmt::format("expected begin before a bone, found {}", quoted(word)),
                   word.data());
      parser.lexer.take_line();
      continue;
    }
    Bone bone;
    BoneParts parts;
    parts.begin = word.data();
    while (parse_bone_word(parser, bone, parts)) continue;
    if (!check_bone(bones, bone, parts)) continue;
    if (file.bones.size() == kMaxBones) {
      parser.error(code::kUnexpectedWord, fmt::format("expected {} bones at the most", kMaxBones),
                   word.data());
      return;
    }
    keep_bone(bones, std::move(bone), parts);
  }
}

namespace {

/// The index of a bone, kNoParent for the root; empty if no bone has the name.
std::optional<std::size_t> find_bone(
    const std::unordered_map<std::string, std::size_t>& index_of_name, std::string_view token) {
  if (equals_ignoring_case(token, "root")) return kNoParent;
  const auto found = index_of_name.find(lowered(token));
  return found == index_of_name.end() ? std::nullopt : std::optional(found->second);
}

void report_unknown(Parser& parser, std::string_view token) {
  // Names of bones that were themselves faulty are not reported a second time.
  if (parser.diagnostics.has_errors() && !parser.lenient) return;
  parser.repair(code::kUnknownBone,
                fmt::format("expected a bone of :bonedata, found {}", quoted(token)),
                "it is left out", token.data());
}

void add_children(Parser& parser, AsfFile& file, std::size_t parent,
                  const std::unordered_map<std::string, std::size_t>& index_of_name,
                  std::vector<bool>& has_parent) {
  while (true) {
    const std::string_view token = parser.lexer.take_in_line();
    if (token.empty()) return;
    const auto child = find_bone(index_of_name, token);
    if (!child) {
      report_unknown(parser, token);
    } else if (*child == kNoParent || has_parent[*child]) {
      parser.error(code::kTwoParents,
                   fmt::format("expected a bone that has no parent yet, found {}", quoted(token)),
                   token.data());
    } else {
      has_parent[*child] = true;
      file.bones[*child].parent = parent;
    }
  }
}

}  // namespace

std::vector<bool> parse_hierarchy(Parser& parser, AsfFile& file) {
  std::vector<bool> has_parent(file.bones.size(), false);
  std::unordered_map<std::string, std::size_t> index_of_name;
  for (std::size_t b = 0; b < file.bones.size(); ++b) {
    index_of_name[lowered(file.bones[b].name)] = b;
  }
  const std::string_view begin = parser.lexer.peek();
  if (!equals_ignoring_case(begin, "begin")) {
    parser.error(begin.empty() ? code::kUnexpectedEnd : code::kUnexpectedWord,
                 fmt::format("expected begin after :hierarchy, found {}", quoted(begin)),
                 begin.data());
    parser.lexer.take_lines_to_keyword();
    return has_parent;
  }
  parser.lexer.take();
  while (true) {
    const std::string_view word = parser.lexer.peek();
    if (word.empty() || word.starts_with(':')) {
      parser.error(
          word.empty() ? code::kUnexpectedEnd : code::kUnexpectedWord,
          fmt::format("expected end after the hierarchy's last line, found {}", quoted(word)),
          word.data());
      return has_parent;
    }
    parser.lexer.take();
    if (equals_ignoring_case(word, "end")) return has_parent;
    const auto parent = find_bone(index_of_name, word);
    if (parent) {
      add_children(parser, file, *parent, index_of_name, has_parent);
    } else {
      report_unknown(parser, word);
      parser.lexer.take_line();
    }
  }
}

}  // namespace kinefile::acclaim
