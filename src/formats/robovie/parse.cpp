// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/words.hpp"
#include "formats/robovie/codes.hpp"
#include "formats/robovie/parser.hpp"

namespace kinefile::robovie {
namespace {

/// The intended keyword: full-width characters become half-width, letters upper case.
std::string meant(std::string_view key) {
  std::string word;
  for (std::size_t i = 0; i < key.size();) {
    std::size_t length = 1;
    const char narrow = narrow_form(key.substr(i), length);
    const char c = narrow != 0 ? narrow : key[i];
    word += c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
    i += narrow != 0 ? length : 1;
  }
  return word;
}

std::optional<Keyword> keyword_of(std::string_view word) {
  for (const Keyword keyword : kKeywords) {
    if (row_of(keyword, FlowFormat::V1R4).word == word) return keyword;
  }
  return std::nullopt;
}

bool is_header(Keyword keyword) {
  return keyword == Keyword::MotionFormat || keyword == Keyword::EnableAxis;
}

bool is_of_format(Keyword keyword, FlowFormat format) {
  return format == FlowFormat::V1R4 || is_header(keyword) || keyword == Keyword::Pose;
}

}  // namespace

bool Parser::next_line() {
  has_blank_before_ = false;
  std::string_view line;
  while (lines_.next(line)) {
    ++line_number_;
    if (trimmed(line).empty()) {
      has_blank_before_ = true;
      continue;
    }
    split_setting(line, setting_);
    return true;
  }
  return false;
}

std::optional<Keyword> Parser::keyword() {
  if (const auto keyword = keyword_of(setting_.key)) return keyword;
  const auto keyword = keyword_of(meant(setting_.key));
  const std::string found = shown(setting_.key);
  const FlowFormat format = file_.flow.format;
  if (keyword) {
    tell_wrong(reader_, code::kUnknownKeyword,
               fmt::format("expected {}:, found {}; capitals matter", row_of(*keyword, format).word,
                           found),
               setting_.key);
  } else {
    reader_.error(code::kUnknownKeyword,
                  fmt::format("expected a keyword of {}, found {}", header_word(format), found),
                  setting_.at);
  }
  return keyword;
}

bool Parser::parse_format() {
  if (!next_line() || setting_.key != "_MOTION_FORMAT") {
    const std::string_view text = reader_.source.text();
    const bool is_empty = setting_.at == nullptr;
    reader_.error(code::kNotAMotion,
                  fmt::format("expected _MOTION_FORMAT: in the first line, found {}",
                              is_empty ? "no text" : shown(setting_.key)),
                  is_empty ? text.data() + text.size() : setting_.at);
    return false;
  }
  const char* const start = setting_.at;
  const KeywordRow row = row_of(Keyword::MotionFormat, FlowFormat::V1R4);
  const Settings settings(reader_, setting_, row);
  if (!settings.are_complete()) return false;
  const std::string_view text = settings.single(0);
  for (const FlowFormat format : {FlowFormat::WordN, FlowFormat::V1R4}) {
    if (trimmed(text) != header_word(format)) continue;
    file_.start = start;
    file_.flow.format = format;
    if (text != fmt::format(" {} ", header_word(format))) {
      tell_spelling(reader_, "a format without one blank on each side", settings.field(0).at);
    }
    return true;
  }
  tell_wrong(reader_, code::kUnknownFormat,
             fmt::format("expected the format POSEDEF_WORD_N or POSEDEF_V1R4, found {}",
                         shown(trimmed(text))),
             text);
  return false;
}

void Parser::parse_axis() {
  const auto most = static_cast<int>(max_sliders(file_.flow.format));
  const KeywordRow row = row_of(Keyword::EnableAxis, file_.flow.format);
  const Settings settings(reader_, setting_, row);
  knows_axis_ = settings.are_complete();
  if (!knows_axis_) return;
  axis_at_ = settings.field(0).at;
  file_.flow.num_sliders = static_cast<std::size_t>(settings.number(0, {code::kBadAxis, 1, most}));
}

void Parser::parse_line() {
  const auto keyword = this->keyword();
  if (!keyword) return add_unread();
  if (is_header(*keyword)) {
    reader_.error(code::kHeaderAgain,
                  fmt::format("expected {}: once, at the top, found another one",
                              row_of(*keyword, file_.flow.format).word),
                  setting_.at);
    return;
  }
  if (!is_of_format(*keyword, file_.flow.format)) {
    reader_.error(
        code::kOtherFormat,
        fmt::format("expected _POSE:, found {}:, which {} does not have",
                    row_of(*keyword, file_.flow.format).word, header_word(file_.flow.format)),
        setting_.at);
    file_.is_whole = false;
    return;
  }
  if (file_.flow.format == FlowFormat::WordN) return parse_word_n_pose();
  if (*keyword == Keyword::MotionInfo) return parse_info();
  parse_body(*keyword);
}

void Parser::end_block() {
  if (!has_info_) return;
  has_info_ = false;
  file_.is_whole = false;
  reader_.error(code::kNoBody,
                fmt::format("expected a line such as _POSE: after _MOTION_INFO: of block {}, found "
                            "none",
                            file_.flow.blocks.size() - 1),
                info_at_);
}

void Parser::add_unread() {
  file_.is_whole = false;
  // The unreadable line is the body of the block before it.
  has_info_ = false;
}

FlowFile Parser::parse() {
  if (!parse_format()) {
    file_.is_whole = false;
    return std::move(file_);
  }
  bool has_line = next_line();
  if (has_line && keyword_of(meant(setting_.key)) == Keyword::EnableAxis) {
    keyword();
    parse_axis();
    has_line = next_line();
  } else {
    reader_.error(code::kNoAxis,
                  "expected _ENABLE_AXIS: after _MOTION_FORMAT:, found " +
                      (has_line ? shown(setting_.key) : "the end of the file"),
                  has_line ? setting_.at : reader_.source.end());
  }
  file_.has_blank_lines = has_line && has_blank_before_;
  for (; has_line; has_line = next_line()) parse_line();
  end_block();
  return std::move(file_);
}

FlowFile parse(const Reader& reader) { return Parser(reader).parse(); }

}  // namespace kinefile::robovie
