// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "formats/robovie/codes.hpp"
#include "formats/robovie/parser.hpp"

namespace kinefile::robovie {
namespace {

constexpr Range kVariable = {code::kBadVariable, 0, static_cast<int>(kNumVariables) - 1};
constexpr Range kConstant = {code::kBadConstant, -32768, 32767};

/// The number of words that some programs write with _ENABLE_AXIS:[62], one per servo.
constexpr std::size_t kWordsOfServos = 30;

/// The block body for a line of which only the keyword can be read.
BlockBody empty_body(Keyword keyword) {
  switch (keyword) {
    case Keyword::StartMot:
      return StartBlock{};
    case Keyword::Pose:
      return PoseBlock{};
    case Keyword::OldLoop:
      return LoopBlock{};
    case Keyword::VarCon:
    case Keyword::VarVar:
      return ArithmeticBlock{};
    case Keyword::Mif:
      return BranchBlock{};
    default:
      return EndBlock{};
  }
}

}  // namespace

Block& Parser::add_block() {
  file_.places.emplace_back();
  return file_.flow.blocks.emplace_back();
}

void Parser::keep_places(std::size_t num_errors) {
  if (reader_.diagnostics.count(Severity::Error) > num_errors) return;
  BlockPlaces& places = file_.places.back();
  const std::size_t count = std::min(setting_.fields.size(), places.settings.size());
  for (std::size_t i = 0; i < count; ++i) places.settings[i] = setting_.fields[i].at;
}

int Parser::arrow(const Settings& settings, std::size_t i) {
  const auto number = settings.integer(i);
  if (!number) file_.is_whole = false;
  return number.value_or(kNoBlock);
}

void Parser::parse_info() {
  end_block();
  Block& block = add_block();
  block.body = EndBlock{};
  has_info_ = true;
  info_at_ = setting_.at;
  const KeywordRow row = row_of(Keyword::MotionInfo, FlowFormat::V1R4);
  const Settings settings(reader_, setting_, row);
  if (!settings.are_complete()) {
    file_.is_whole = false;
    return;
  }
  block.name = settings.text(0);
  block.x = settings.number(1, {code::kBadPosition, 0, kLargestNumber});
  block.y = settings.number(2, {code::kBadPosition, 0, kLargestNumber});
  block.normal_turn = settings.integer(3).value_or(0);
  block.branch_turn = settings.integer(4).value_or(0);
  block.normal = arrow(settings, 5);
  block.branch = arrow(settings, 6);
  file_.places.back().normal = settings.field(5).text.data();
  file_.places.back().branch = settings.field(6).text.data();
}

void Parser::parse_body(Keyword keyword) {
  if (!has_info_) {
    file_.is_whole = false;
    reader_.error(code::kNoInfo,
                  fmt::format("expected _MOTION_INFO: before {}:, found none",
                              row_of(keyword, FlowFormat::V1R4).word),
                  setting_.at);
    add_block();
  }
  has_info_ = false;
  file_.places.back().body = setting_.at;
  Block& block = file_.flow.blocks.back();
  block.line = line_number_;
  const std::size_t num_errors = reader_.diagnostics.count(Severity::Error);
  const KeywordRow row = row_of(keyword, FlowFormat::V1R4);
  const Settings settings(reader_, setting_, row);
  const bool is_complete = settings.are_complete();
  file_.is_whole = file_.is_whole && is_complete;
  block.body = is_complete ? body(keyword, settings) : empty_body(keyword);
  keep_places(num_errors);
}

BlockBody Parser::body(Keyword keyword, const Settings& settings) {
  if (keyword == Keyword::Pose) {
    PoseBlock block = pose(settings);
    block.sound = settings.text(2);
    parse_mask(settings, block);
    return block;
  }
  if (keyword == Keyword::VarCon) return arithmetic(settings, false);
  if (keyword == Keyword::VarVar) return arithmetic(settings, true);
  return keyword == Keyword::Mif ? branch(settings) : empty_body(keyword);
}

void Parser::parse_word_n_pose() {
  Block& block = add_block();
  file_.places.back().body = setting_.at;
  block.line = line_number_;
  block.body = PoseBlock{};
  const std::size_t num_errors = reader_.diagnostics.count(Severity::Error);
  const KeywordRow row = row_of(Keyword::Pose, FlowFormat::WordN);
  const Settings settings(reader_, setting_, row);
  if (!settings.are_complete()) {
    file_.is_whole = false;
    return;
  }
  PoseBlock body = pose(settings);
  block.normal = arrow(settings, 2);
  block.branch = arrow(settings, 3);
  file_.places.back().normal = settings.field(2).text.data();
  file_.places.back().branch = settings.field(3).text.data();
  body.sound = settings.text(4);
  block.body = std::move(body);
  keep_places(num_errors);
}

PoseBlock Parser::pose(const Settings& settings) {
  PoseBlock pose;
  pose.ticks = settings.ticks(0);
  parse_words_of(settings, pose);
  return pose;
}

void Parser::parse_words_of(const Settings& settings, PoseBlock& pose) {
  settings.single(1);
  PoseFlow& flow = file_.flow;
  const std::size_t most = knows_axis_ ? flow.num_sliders : max_sliders(flow.format);
  const Field& field = settings.field(1);
  const auto num_wide = [this] {
    return reader_.diagnostics.count_of(code::kFullWidth, Severity::Error);
  };
  const std::size_t num_wide_before = num_wide();
  const std::size_t count = parse_words(reader_, field, most, pose.words);
  const bool has_wide_commas = num_wide() > num_wide_before;  // they make the number wrong
  if (!knows_axis_) {  // it is taken from the first pose, if possible
    knows_axis_ = true;
    flow.num_sliders = pose.words.size();
  }
  const bool is_of_servos = count == kWordsOfServos && flow.num_sliders == 62;
  if (is_of_servos && !told_few_words_) {
    told_few_words_ = true;
    reader_.warn(code::kFewWords,
                 "expected 62 words, as _ENABLE_AXIS: says, found 30; the other sliders are taken "
                 "for disabled, here and in poses like this",
                 field.at);
  } else if (!is_of_servos && !has_wide_commas && count != flow.num_sliders) {
    reader_.error(
        code::kNumWords,
        fmt::format("expected {} words, as _ENABLE_AXIS: says, found {}", flow.num_sliders, count),
        field.at);
  }
  pose.words.resize(flow.num_sliders);
}

void Parser::parse_mask(const Settings& settings, PoseBlock& pose) {
  const std::string_view text = settings.single(3);
  const std::string_view digits = trimmed(text);
  const bool is_mask =
      digits.size() == kNumServos && digits.find_first_not_of("01") == std::string_view::npos;
  if (!is_mask) {
    tell_wrong(reader_, code::kBadMask,
               fmt::format("expected 30 digits 0 or 1, found {} in {}", digits.size(),
                           digits.empty() ? "nothing" : shown(digits)),
               text);
    return;
  }
  if (digits.size() != text.size()) tell_spelling(reader_, "a blank", text.data());
  for (std::size_t channel = 0; channel < kNumServos; ++channel) {
    pose.servo_off[channel] = digits[channel] == '1';
  }
}

ArithmeticBlock Parser::arithmetic(const Settings& settings, bool has_variable) {
  ArithmeticBlock block;
  block.variable = settings.number(0, kVariable);
  block.operation =
      static_cast<Arithmetic>(settings.number(1, {code::kBadOperation, 0, kNumOperations - 1}));
  block.has_variable_operand = has_variable;
  block.operand = settings.number(2, has_variable ? kVariable : kConstant);
  return block;
}

BranchBlock Parser::branch(const Settings& settings) {
  BranchBlock block;
  block.variable = settings.number(0, kVariable);
  block.condition =
      static_cast<Condition>(settings.number(1, {code::kBadCondition, 0, kNumConditions - 1}));
  block.detail = settings.number(2, kConstant);
  return block;
}

}  // namespace kinefile::robovie
