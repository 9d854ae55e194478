// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "base/words.hpp"
#include "formats/acclaim/codes.hpp"
#include "formats/acclaim/like_frames.hpp"
#include "formats/acclaim/parser.hpp"
#include "text/attempts.hpp"
#include "text/numbers.hpp"
#include "text/scanner.hpp"

namespace kinefile::acclaim {
namespace {

using text::equals_ignoring_case;
using text::quoted;

/// A frame number: a line with one word, which is a whole number.
std::optional<std::int64_t> frame_number(std::string_view token) {
  const bool is_negative = token.starts_with('-');
  const auto count = text::parse_count(token.substr(is_negative ? 1 : 0));
  constexpr std::size_t kMost = std::size_t{1}
                                << 30;  // frames; a larger number is not a frame number
  if (!count || *count > kMost) return std::nullopt;
  const auto number = static_cast<std::int64_t>(*count);
  return is_negative ? -number : number;
}

struct Body {
  Parser& parser;
  const std::vector<BoneColumns>& bones;
  const std::string& skeleton_name;
  AmcBody out = {};
  std::unordered_map<std::string, std::size_t> index_of_name = {};  ///< in lower case
  std::size_t num_columns = 0;
  std::span<double> row = {};             ///< the row of the current frame: the last of `values`
  std::vector<std::size_t> seen_in = {};  ///< the last frame, from 1, that contained each bone
  std::vector<std::string_view> spelled = {};  ///< the names as the first frame spells them
  std::size_t num_seen = 0;                    ///< bones of the current frame
  std::size_t next = 0;  ///< the position in the order of the next expected bone
  bool is_in_frame = false;
  bool is_full = false;                         ///< there is no room for more frames
  std::vector<std::size_t> place_of_bone = {};  ///< in the order of the first frame
  std::int64_t number = 0;                      ///< of the current frame
  const char* number_at = nullptr;
  const char* first_number_at = nullptr;  ///< of the first frame, null if it has none
  std::optional<LikeFrames> like = {};    ///< found from the first frame
  text::Attempts attempts = {};           ///< to read frames like it

  const char* end() const { return parser.source.end(); }
  std::size_t frame() const { return out.num_frames; }
  /// Makes a row for the current frame; it is reused unless the frame is kept.
  void open_row() { row = out.values.grow(num_columns); }
  /// Truncates the values to the frames that were kept.
  void close_rows() { out.values.resize(out.num_frames * num_columns); }
};

/// Gives the bones that are missing in the current frame their previous values, or 0.
void fill_missing(Body& body) {
  for (std::size_t b = 0; b < body.bones.size(); ++b) {
    if (body.seen_in[b] == body.frame() + 1) continue;
    const BoneColumns& bone = body.bones[b];
    const std::span<double> values = body.row.subspan(bone.first_column, bone.num_columns);
    if (body.frame() == 0) {
      std::fill(values.begin(), values.end(), 0.0);
    } else {
      std::copy_n(values.data() - body.num_columns, bone.num_columns, values.data());
    }
  }
}

void report_missing(Body& body) {
  std::vector<std::string> names;
  std::size_t count = 0;
  for (std::size_t b = 0; b < body.bones.size(); ++b) {
    if (body.seen_in[b] == body.frame() + 1) continue;
    if (++count <= kMostListed) names.push_back(body.bones[b].name);
  }
  body.parser.warn(code::kMissingBone,
                   fmt::format("expected all bones in frame {}, found none of {}; {}", body.number,
                               listed(names, count),
                               body.frame() == 0 ? "they rest at 0" : "they hold their values"),
                   body.number_at);
}

/// Whether there is room for another frame. Bones that keep their values need no bytes in the file,
/// so a small file could require any amount of memory.
bool has_room(Body& body) {
  constexpr std::size_t kManyNumbers = std::size_t{1} << 27;  // 1 GiB
  const std::size_t most = std::max(kManyNumbers, body.parser.source.text().size() / 2);
  if (body.out.values.size() <= most) return true;
  if (!std::exchange(body.is_full, true)) {
    body.parser.error(code::kMissingBone,
                      fmt::format("expected {} values at the most in a file of this size, most "
                                  "bones are missing in most frames",
                                  most),
                      body.number_at);
  }
  return false;
}

void finish_frame(Body& body) {
  if (!body.is_in_frame) return;
  body.is_in_frame = false;
  if (body.num_seen == 0 && !body.bones.empty()) {
    body.parser.repair(code::kMissingBone,
                       fmt::format("expected the bones of frame {}, found none", body.number),
                       "the frame is left out", body.number_at);
    return;
  }
  if (!has_room(body)) return;
  if (body.num_seen < body.bones.size()) {
    report_missing(body);
    fill_missing(body);
  }
  ++body.out.num_frames;
  body.open_row();
}

/// Reserves memory for the number of frames if all were as long as the first.
void reserve_frames(Body& body, const char* begin, const char* next) {
  const auto frame_bytes = static_cast<std::size_t>(next - begin) + 1;
  const auto num_bytes = static_cast<std::size_t>(body.end() - begin);
  const std::size_t num_frames = num_bytes / frame_bytes + num_bytes / frame_bytes / 16 + 1;
  // A number needs at least two bytes, so hostile files cannot request more than four times their
  // size. While the file is read, one extra row is open.
  body.out.values.reserve(std::min(num_frames * body.num_columns, num_bytes / 2 + 1) +
                          body.num_columns);
  body.row = body.out.values.mutate().last(body.num_columns);
}

void start_frame(Body& body, std::int64_t number, const char* at) {
  const bool is_first = !body.is_in_frame && body.frame() == 0;
  const char* begin = body.number_at;
  finish_frame(body);
  if (body.frame() == 1) reserve_frames(body, begin, at);
  if (is_first) {
    body.out.first_frame_number = number;
    body.first_number_at = at;
  } else if (number != body.number + 1) {
    body.parser.warn(code::kFrameNumbers,
                     fmt::format("expected frame number {}, found {}; frames are counted in the "
                                 "order in which they stand",
                                 body.number + 1, number),
                     at);
  }
  body.number = number;
  body.number_at = at;
  body.is_in_frame = true;
  body.num_seen = 0;
  body.next = 0;
}

constexpr std::size_t kNoPlace = static_cast<std::size_t>(-1);

/// The bone with a name: usually the next in the order of the first frame.
std::optional<std::size_t> find_bone(Body& body, std::string_view name) {
  if (body.next < body.out.bone_order.size() && body.spelled[body.next] == name) {
    return body.out.bone_order[body.next++];
  }
  const auto found = body.index_of_name.find(lowered(name));
  if (found == body.index_of_name.end()) return std::nullopt;
  std::size_t& place = body.place_of_bone[found->second];
  if (place == kNoPlace && body.frame() == 0) {
    place = body.out.bone_order.size();
    body.out.bone_order.push_back(found->second);
    body.spelled.push_back(name);
  }
  body.next = place == kNoPlace ? body.out.bone_order.size() : place + 1;
  return found->second;
}

/// Reads a value that the row reader rejected, with a diagnostic if it is not a number.
std::optional<double> parse_value(Parser& parser, std::string_view token) {
  const text::Number number = text::parse_number(token);
  if (number.fault == text::NumberFault::None && !std::isfinite(number.value)) {
    parser.warn(code::kNotFinite,
                fmt::format("expected a finite number, found {}; it is kept", quoted(token)),
                token.data());
    return number.value;
  }
  if (number.fault == text::NumberFault::None) return number.value;
  const bool is_huge = number.fault == text::NumberFault::OutOfRange;
  parser.error(code::kBadValue,
               fmt::format("expected a value{}, found {}", is_huge ? " that a double can hold" : "",
                           quoted(token)),
               token.data());
  return std::nullopt;
}

/// Whether the next line continues a bone's values: it starts with a number and is not a frame
/// number.
bool goes_on(Body& body) {
  Lexer& lexer = body.parser.lexer;
  const char* here = lexer.position();
  const std::string_view token = lexer.take();
  const bool is_value =
      !token.empty() && text::parse_number(token).fault != text::NumberFault::NotANumber;
  const bool is_alone = is_value && lexer.peek_in_line().empty() && frame_number(token);
  lexer.move_to(is_value && !is_alone ? token.data() : here);
  return is_value && !is_alone;
}

void report_count(Body& body, const BoneColumns& bone, std::size_t num_found, const char* at) {
  body.parser.error(
      code::kValueCount,
      fmt::format("expected {} value{} for bone '{}' in frame {}, found {}", bone.num_columns,
                  bone.num_columns == 1 ? "" : "s", bone.name, body.number, num_found),
      at);
}

/// Reads values that the row reader rejected: values that are not finite, comments, wrapped lines,
/// too few or too many values.
void read_odd_values(Body& body, const BoneColumns& bone, std::size_t num_read, const char* name) {
  Lexer& lexer = body.parser.lexer;
  double* out = body.row.data() + bone.first_column;
  std::size_t count = num_read;
  while (true) {
    const std::string_view token = lexer.peek_in_line();
    if (token.empty()) {
      if (count >= bone.num_columns || !goes_on(body)) break;
      continue;
    }
    lexer.take_in_line();
    const auto value = parse_value(body.parser, token);
    if (!value) {
      lexer.take_line();
      return;
    }
    if (count < bone.num_columns) out[count] = *value;
    ++count;
  }
  if (count != bone.num_columns) report_count(body, bone, count, name);
}

void read_values(Body& body, const BoneColumns& bone, const char* name) {
  Lexer& lexer = body.parser.lexer;
  const text::NumberRow read = text::read_number_row(
      lexer.position(), body.end(), body.row.data() + bone.first_column, bone.num_columns);
  const bool is_whole = read.count == bone.num_columns && read.end == text::RowEnd::EndOfLine;
  if (is_whole) {
    lexer.move_to(read.next);
    return;
  }
  // The row reader may have moved past the line's end.
  if (read.end == text::RowEnd::EndOfLine) {
    lexer.move_to(read.next);
    if (goes_on(body)) return read_odd_values(body, bone, read.count, name);
    report_count(body, bone, read.count, name);
    return;
  }
  lexer.move_to(read.next);
  read_odd_values(body, bone, read.count, name);
}

void read_bone_line(Body& body, std::string_view name) {
  Parser& parser = body.parser;
  const auto index = find_bone(body, name);
  if (!index) {
    const bool is_number = text::parse_number(name).fault != text::NumberFault::NotANumber;
    if (is_number) {
      parser.error(code::kUnexpectedLine,
                   fmt::format("expected a frame number or a bone's name, found {} at the start "
                               "of a line of values",
                               quoted(name)),
                   name.data());
    } else {
      parser.repair(code::kNoSuchBone,
                    fmt::format("expected a bone of '{}' that can move, found {}",
                                body.skeleton_name, quoted(name)),
                    "the line is left out", name.data());
    }
    parser.lexer.take_line();
    return;
  }
  if (!body.is_in_frame) {
    parser.error(
        code::kUnexpectedLine,
        fmt::format("expected a frame number before the first bone, found {}", quoted(name)),
        name.data());
    body.is_in_frame = true;  // reported once
    body.number_at = name.data();
  }
  if (std::exchange(body.seen_in[*index], body.frame() + 1) == body.frame() + 1) {
    parser.repair(
        code::kBoneTwice,
        fmt::format("expected bone {} once in frame {}, found it again", quoted(name), body.number),
        "the later values stand", name.data());
  } else {
    ++body.num_seen;
  }
  read_values(body, body.bones[*index], name.data());
}

/// Reads the next line if it is that of the expected bone (in the order of the first frame). This
/// is the fast path for nearly every line.
bool read_expected_line(Body& body) {
  if (!body.is_in_frame || body.next >= body.spelled.size()) return false;
  const std::string_view name = body.spelled[body.next];
  const char* line = body.parser.lexer.position();
  const bool is_next = static_cast<std::size_t>(body.end() - line) > name.size() &&
                       std::memcmp(line, name.data(), name.size()) == 0 &&
                       text::is_blank(line[name.size()]);
  const std::size_t bone = body.out.bone_order[body.next];
  if (!is_next || body.seen_in[bone] == body.frame() + 1) return false;
  ++body.next;
  body.seen_in[bone] = body.frame() + 1;
  ++body.num_seen;
  body.parser.lexer.move_to(line + name.size());
  read_values(body, body.bones[bone], line);
  return true;
}

/// Learns from the first frame, which has been read, what the others look like.
void learn_frames(Body& body) {
  if (body.first_number_at == nullptr) return;
  if (body.out.bone_order.size() != body.bones.size()) return;
  std::vector<std::size_t> columns;
  for (const std::size_t b : body.out.bone_order) {
    const BoneColumns& bone = body.bones[b];
    for (std::size_t k = 0; k < bone.num_columns; ++k) columns.push_back(bone.first_column + k);
  }
  if (columns.size() != body.num_columns) return;
  const auto size = static_cast<std::size_t>(body.number_at - body.first_number_at);
  body.like = like_frames({body.first_number_at, size}, columns);
}

/// Reads frames that are like the first one, many at once, from the number of the current one on.
/// The last of them is left, since more may belong to it.
void read_many_frames(Body& body) {
  if (!simd::kReadsTemplateRows) return;
  if (body.frame() == 1 && !body.like) learn_frames(body);
  if (!body.like || !body.attempts.is_due()) return;
  body.close_rows();
  const ReadFrames read =
      read_like_frames(*body.like, body.number_at, body.end(), body.number, body.out.values);
  const std::size_t num_frames = read.num_frames > 0 ? read.num_frames - 1 : 0;
  body.out.num_frames += num_frames;
  body.close_rows();
  body.open_row();
  body.attempts.made(num_frames > 0);
  if (num_frames == 0) return;
  body.is_in_frame = false;
  body.number += static_cast<std::int64_t>(num_frames) - 1;
  body.parser.lexer.move_to(read.last);
}

}  // namespace

AmcBody parse_amc_body(Parser& parser, const std::vector<BoneColumns>& bones,
                       const std::string& skeleton_name) {
  Body body{parser, bones, skeleton_name};
  for (std::size_t b = 0; b < bones.size(); ++b) {
    body.index_of_name[lowered(bones[b].name)] = b;
    body.num_columns = std::max(body.num_columns, bones[b].first_column + bones[b].num_columns);
  }
  body.open_row();
  body.seen_in.assign(bones.size(), 0);
  body.place_of_bone.assign(bones.size(), kNoPlace);
  while (true) {
    if (read_expected_line(body)) continue;
    const std::string_view word = parser.lexer.take();
    if (word.empty()) break;
    if (word.starts_with(':')) {
      parser.error(code::kUnexpectedLine,
                   fmt::format("expected a frame, found {} behind the first one", quoted(word)),
                   word.data());
      parser.lexer.take_line();
      continue;
    }
    const auto number = word[0] <= '9' ? frame_number(word) : std::nullopt;
    if (number && parser.lexer.peek_in_line().empty()) {
      start_frame(body, *number, word.data());
      read_many_frames(body);
    } else {
      read_bone_line(body, word);
    }
  }
  finish_frame(body);
  body.close_rows();
  body.out.last_frame_number = body.number;
  body.out.like = std::move(body.like);
  const bool is_blank =
      parser.source.text().find_first_not_of(" \t\v\f\r\n") == std::string_view::npos;
  if (is_blank) {
    parser.error(code::kNoFrames, "expected a motion, found an empty file", parser.source.end());
  } else if (body.out.num_frames == 0 && !parser.diagnostics.has_errors()) {
    parser.warn(code::kNoFrames,
                "expected a frame number, found the end of the file; the motion "
                "has no frames",
                parser.source.end());
  }
  return std::move(body.out);
}

}  // namespace kinefile::acclaim
