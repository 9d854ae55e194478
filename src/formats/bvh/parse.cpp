// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "formats/bvh/codes.hpp"
#include "formats/bvh/parser.hpp"
#include "text/numbers.hpp"

namespace kinefile::bvh {

using text::equals_ignoring_case;
using text::quoted;
using text::starts_with_ignoring_case;

Channel channel_of_word(std::string_view word) {
  Channel channel{ChannelKind::Unknown, 0, word};
  if (word.empty()) return channel;
  const std::size_t axis = std::string_view("XYZxyz").find(word[0]);
  const std::string_view kind = word.substr(1);
  if (axis == std::string_view::npos) return channel;
  channel.axis = axis % 3;
  if (equals_ignoring_case(kind, "position")) channel.kind = ChannelKind::Position;
  if (equals_ignoring_case(kind, "rotation")) channel.kind = ChannelKind::Rotation;
  if (equals_ignoring_case(kind, "scale")) channel.kind = ChannelKind::Scale;
  return channel;
}

std::string spelling(const Channel& channel) {
  static constexpr std::array<std::string_view, 3> kWords = {"position", "rotation", "scale"};
  if (channel.kind == ChannelKind::Unknown) return std::string(channel.word);
  std::string word(1, "XYZ"[channel.axis]);
  return word += kWords[static_cast<std::size_t>(channel.kind)];
}

bool skip_comment(Parser& parser) {
  const std::string_view word = parser.scanner.peek();
  if (!word.starts_with('#')) return false;
  parser.report(Severity::Warning, code::kComment, "BVH has no comments; the line is passed over",
                word.data());
  parser.scanner.take_line();
  return true;
}

std::optional<double> parse_value(Parser& parser, std::string_view token, const char* code,
                                  const std::string& what) {
  const text::Number number = text::parse_number(token);
  if (number.fault == text::NumberFault::None && std::isfinite(number.value)) return number.value;
  if (number.fault == text::NumberFault::DecimalComma) {
    const bool is_repaired =
        parser.repair(code::kDecimalComma,
                      fmt::format("expected a decimal point, found a comma in {}", quoted(token)),
                      "the comma is read as a point", token.data());
    return is_repaired ? std::optional(number.value) : std::nullopt;
  }
  if (number.fault == text::NumberFault::OutOfRange) {
    parser.report(Severity::Error, code::kOutOfRange,
                  fmt::format("expected a number that a double can hold, found {}", quoted(token)),
                  token.data());
    return std::nullopt;
  }
  parser.report(Severity::Error, token.empty() ? code::kUnexpectedEnd : code,
                fmt::format("expected {}, found {}", what, quoted(token)), token.data());
  return std::nullopt;
}

namespace {

struct Counts {
  std::optional<std::size_t> num_frames;
  std::optional<double> frame_time;
  const char* frames_at = nullptr;
  const char* frame_time_at = nullptr;
};

/// A whole number that is not written as one: "3.0".
std::optional<std::size_t> whole_number(std::string_view token) {
  constexpr double kMost = 9007199254740992.0;  // 2^53
  const text::Number number = text::parse_number(token);
  const bool is_whole = number.fault == text::NumberFault::None && number.value >= 0 &&
                        number.value <= kMost && std::floor(number.value) == number.value;
  return is_whole ? std::optional(static_cast<std::size_t>(number.value)) : std::nullopt;
}

/// The value after "Frames" or "Frame Time": a colon, blanks around it, a word in the same line.
std::string_view take_count_token(Parser& parser) {
  parser.scanner.take_character(':');
  return parser.scanner.take_in_line();
}

/// A token of this line as a message shows it; an empty one is the end of the line or the file.
std::string quoted_in_line(const Parser& parser, std::string_view token) {
  const bool is_line_end = token.empty() && token.data() != parser.source.end();
  return is_line_end ? "the end of the line" : quoted(token);
}

void parse_frames(Parser& parser, const char* keyword_at, Counts& counts) {
  if (counts.frames_at != nullptr) {
    parser.report(Severity::Error, code::kGivenTwice, "expected one count of frames, found another",
                  keyword_at);
  }
  counts.frames_at = keyword_at;
  const std::string_view token = take_count_token(parser);
  counts.num_frames = text::parse_count(token);
  if (counts.num_frames) return;
  counts.num_frames = whole_number(token);
  if (counts.num_frames) {
    parser.report(Severity::Warning, code::kFramesNotWhole,
                  fmt::format("expected a whole number of frames, found {}; read as {}",
                              quoted(token), *counts.num_frames),
                  token.data());
    return;
  }
  parser.repair(code::kBadFrames,
                fmt::format("expected a count of frames after Frames:, found {}",
                            quoted_in_line(parser, token)),
                "the rows are counted", token.data());
}

/// Notes times that are hardly meant: a rate, milliseconds or a slip in the place of seconds.
void note_unusual_time(Parser& parser, double seconds, std::string_view token) {
  constexpr double kShortest = 1e-4;
  constexpr double kLongest = 1;
  if (parser.options.has_rate || (seconds >= kShortest && seconds < kLongest)) return;
  parser.report(Severity::Note, code::kUnusualFrameTime,
                fmt::format("expected the seconds of a frame after Frame Time:, found {}, which "
                            "makes {:.6g} frames a second; --fps says another rate",
                            quoted_in_line(parser, token), 1 / seconds),
                token.data());
}

void parse_frame_time(Parser& parser, const char* keyword_at, Counts& counts) {
  if (counts.frame_time_at != nullptr) {
    parser.report(Severity::Error, code::kGivenTwice, "expected one Frame Time, found another",
                  keyword_at);
  }
  counts.frame_time_at = keyword_at;
  const std::string_view token = take_count_token(parser);
  const text::Number number = text::parse_number(token);
  const bool is_comma = number.fault == text::NumberFault::DecimalComma;
  const bool is_time = std::isfinite(number.value) && number.value > 0;
  if (is_time && (is_comma ? !parser.options.has_rate : number.fault == text::NumberFault::None)) {
    counts.frame_time = parse_value(parser, token, code::kBadFrameTime, {});
    note_unusual_time(parser, number.value, token);
    return;
  }
  std::string message = fmt::format("expected seconds above 0 after Frame Time:, found {}",
                                    quoted_in_line(parser, token));
  if (parser.options.has_rate) {
    parser.report(Severity::Warning, code::kBadFrameTime, message + "; --fps stands in its place",
                  token.data());
  } else {
    parser.repair(code::kBadFrameTime, std::move(message), "30 frames a second are assumed",
                  token.data());
  }
}

/// Reads one of "Frames: N" and "Frame Time: T". Returns false if neither is next.
bool parse_count_line(Parser& parser, Counts& counts) {
  const std::string_view word = parser.scanner.peek();
  if (starts_with_ignoring_case(word, "FrameTime")) {
    parser.scanner.move_to(word.data() + 9);
    parse_frame_time(parser, word.data(), counts);
    return true;
  }
  if (starts_with_ignoring_case(word, "Frames")) {
    parser.scanner.move_to(word.data() + 6);
    parse_frames(parser, word.data(), counts);
    return true;
  }
  if (!equals_ignoring_case(word, "Frame")) return false;
  parser.scanner.take();
  const std::string_view time = parser.scanner.peek_in_line();
  if (!starts_with_ignoring_case(time, "Time")) {
    parser.scanner.move_to(word.data());
    return false;
  }
  parser.scanner.move_to(time.data() + 4);
  parse_frame_time(parser, word.data(), counts);
  return true;
}

/// Whether a row may start with this word. A word that is not a number may be a misspelt count.
bool can_start_row(std::string_view word) {
  return text::parse_number(word).fault != text::NumberFault::NotANumber;
}

void check_counts(Parser& parser, const Counts& counts, const char* body) {
  if (counts.frames_at == nullptr) {
    parser.report(Severity::Warning, code::kNoFrames,
                  "expected Frames: before the first row; the rows are counted", body);
  }
  if (counts.frame_time_at == nullptr && !parser.options.has_rate) {
    parser.report(Severity::Warning, code::kNoFrameTime,
                  "expected Frame Time: before the first row; 30 frames a second are assumed "
                  "(--fps says otherwise)",
                  body);
  }
}

}  // namespace

std::optional<Body> parse_counts(Parser& parser) {
  parser.file.has_motion = true;
  Counts counts;
  const char* body = parser.scanner.position();
  while (true) {
    if (skip_comment(parser) || parse_count_line(parser, counts)) {
      body = parser.scanner.position();
      continue;
    }
    const std::string_view word = parser.scanner.peek();
    const bool has_time = counts.frame_time_at != nullptr || parser.options.has_rate;
    const bool has_both = counts.frames_at != nullptr && has_time;
    // After both counts, the next line is a row, valid or not.
    if (has_both || (!word.empty() && can_start_row(word))) break;
    parser.report(
        Severity::Error, word.empty() ? code::kUnexpectedEnd : code::kUnexpectedWord,
        fmt::format("expected Frames:, Frame Time: or a row of numbers, found {}", quoted(word)),
        word.data());
    if (word.empty()) return std::nullopt;
    parser.scanner.take_line();
    body = parser.scanner.position();
  }
  check_counts(parser, counts, parser.scanner.peek().data());
  parser.file.frame_time = counts.frame_time.value_or(1.0 / 30);
  return Body{body, counts.num_frames, counts.frames_at != nullptr ? counts.frames_at : body};
}

File parse(const text::Source& source, const ParseOptions& options, Diagnostics& diagnostics) {
  Parser parser{source, options, diagnostics, text::Scanner(source.text()), {}};
  if (parse_hierarchy(parser)) {
    if (const auto body = parse_counts(parser)) parse_rows(parser, *body);
  }
  return std::move(parser.file);
}

}  // namespace kinefile::bvh
