// SPDX-License-Identifier: MIT
#include "text/yaml/scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace kinefile::text::yaml {
namespace {

/// How long a key of one line may be, in characters (YAML 1.1, 7.3.1).
constexpr std::size_t kLongestKey = 1024;

/// Whether a plain scalar can start with this character, whatever follows it.
bool starts_plain(char c) { return std::strchr("-?:,[]{}#&*!|>'\"%@`", c) == nullptr; }

}  // namespace

Scanner::Scanner(std::string_view text, NumberRows* rows)
    : cursor_(text), rows_(rows), checked_(text.data()) {}

/// Checks the unchecked text up to a place for characters that YAML forbids.
void Scanner::check_characters(const char* end) {
  const char* const begin = std::exchange(checked_, cursor_.position());
  if (end <= begin) return;
  const char* const found =
      find_forbidden_character({begin, static_cast<std::size_t>(end - begin)}, cursor_.end());
  if (found == nullptr) return;
  fault_ = Fault{"YML002",
                 fmt::format("expected characters that YAML allows, found the control character "
                             "\\x{:02x}",
                             static_cast<unsigned char>(*found)),
                 found};
}

const Token* Scanner::peek() {
  while (!fault_ && needs_more()) {
    const bool is_good = fetch();
    // A forbidden character may be the real fault. Rows of numbers contain none.
    const bool is_row = is_good && last_ == TokenKind::Row;
    const char* const next = cursor_.position();
    check_characters(is_row ? tokens_.back().at
                            : next + (is_good || next == cursor_.end() ? 0 : 1));
  }
  return fault_ ? nullptr : &tokens_.front();
}

void Scanner::pop() {
  tokens_.pop_front();
  ++num_taken_;
}

/// Whether another token may still be inserted before the first waiting one.
bool Scanner::needs_more() const {
  if (is_ended_) return false;
  if (tokens_.empty()) return true;
  return std::any_of(candidates_.begin(), candidates_.end(), [this](const KeyCandidate& candidate) {
    if (!candidate.is_possible || candidate.token != num_taken_) return false;
    return candidate.is_required || !is_stale(candidate);
  });
}

/// Whether it can no longer become a key.
bool Scanner::is_stale(const KeyCandidate& candidate) const {
  return candidate.line < cursor_.line() || candidate.index + kLongestKey < cursor_.index();
}

bool Scanner::fail(const char* at, std::string message) {
  if (!fault_) fault_ = Fault{"YML001", std::move(message), at};
  return false;
}

/// Adds a token without a value and skips its text.
void Scanner::push(TokenKind kind, std::size_t bytes) {
  tokens_.push_back({kind, cursor_.position(), {}, {}});
  last_ = kind;
  cursor_.skip(bytes);
}

void Scanner::insert(std::size_t number, Token token) {
  tokens_.insert(tokens_.begin() + static_cast<std::ptrdiff_t>(number - num_taken_), token);
}

void Scanner::skip_comment() {
  has_comments_ = true;
  while (!cursor_.is_at_end() && !cursor_.is_break()) cursor_.skip();
}

void Scanner::skip_to_token() {
  const bool is_in_flow = candidates_.size() > 1;
  while (true) {
    if (cursor_.is_byte_order_mark() && cursor_.column() == 0) cursor_.skip(3);
    // A tab is not indentation, but it is a blank where nothing indented can start.
    while (cursor_.peek() == ' ' || (cursor_.peek() == '\t' && (is_in_flow || !allows_key_))) {
      cursor_.skip();
    }
    if (cursor_.peek() == '#') skip_comment();
    if (!cursor_.is_break()) return;
    cursor_.skip_break();
    if (!is_in_flow) allows_key_ = true;
  }
}

bool Scanner::fetch() {
  skip_to_token();
  if (!drop_stale_candidates()) return false;
  const std::size_t column = cursor_.column();
  unindent_to(static_cast<std::ptrdiff_t>(column));
  if (cursor_.is_at_end()) return fetch_stream_end();
  if (column == 0) {
    if (cursor_.peek() == '%') return fetch_directive();
    if (cursor_.is_document_mark('-')) return fetch_document_mark(TokenKind::DocumentStart);
    if (cursor_.is_document_mark('.')) return fetch_document_mark(TokenKind::DocumentEnd);
  }
  bool is_found = true;
  const bool is_good = fetch_indicator(is_found);
  if (is_found) return is_good;
  const bool is_in_flow = candidates_.size() > 1;
  const char c = cursor_.peek();
  const bool is_word = (c == '-' && !cursor_.is_blank(1)) ||
                       (!is_in_flow && (c == '?' || c == ':') && !cursor_.ends_word(1));
  if (!cursor_.ends_word() && (starts_plain(c) || is_word)) return fetch_plain();
  return fail(cursor_.position(),
              fmt::format("expected a value, found {}, which no value starts with",
                          c == '\t' ? "a tab" : fmt::format("'{}'", c)));
}

bool Scanner::fetch_indicator(bool& is_found) {
  const bool is_in_flow = candidates_.size() > 1;
  switch (cursor_.peek()) {
    case '[':
      return fetch_row() || (!fault_ && fetch_flow_start(TokenKind::FlowSequenceStart));
    case '{':
      return fetch_flow_start(TokenKind::FlowMappingStart);
    case ']':
      return fetch_flow_end(TokenKind::FlowSequenceEnd);
    case '}':
      return fetch_flow_end(TokenKind::FlowMappingEnd);
    case ',':
      return fetch_flow_entry();
    case '-':
      if (cursor_.ends_word(1)) return fetch_block_entry();
      break;
    case '?':
      if (is_in_flow || cursor_.ends_word(1)) return fetch_key();
      break;
    case ':':
      if (is_in_flow || cursor_.ends_word(1)) return fetch_value();
      break;
    case '*':
    case '&':
      return fetch_property(&Scanner::scan_anchor);
    case '!':
      return fetch_property(&Scanner::scan_tag);
    case '|':
      if (!is_in_flow) return fetch_block_scalar(ScalarStyle::Literal);
      break;
    case '>':
      if (!is_in_flow) return fetch_block_scalar(ScalarStyle::Folded);
      break;
    case '\'':
      return fetch_flow_scalar(ScalarStyle::SingleQuoted);
    case '"':
      return fetch_flow_scalar(ScalarStyle::DoubleQuoted);
    default:
      break;
  }
  is_found = false;
  return false;
}

// Keys of one line. A token that may be a key is remembered; its colon inserts a Key before it, and
// the start of a mapping if it is further right than the block around it.

bool Scanner::drop_stale_candidates() {
  for (KeyCandidate& candidate : candidates_) {
    if (!candidate.is_possible || !is_stale(candidate)) continue;
    if (candidate.is_required) {
      return fail(candidate.at, "expected ':' behind this key, on its line");
    }
    candidate.is_possible = false;
  }
  return true;
}

bool Scanner::save_candidate() {
  if (!allows_key_) return true;
  if (!remove_candidate()) return false;
  const std::size_t column = cursor_.column();
  const bool is_in_flow = candidates_.size() > 1;
  candidates_.back() = {true,
                        !is_in_flow && indent_ == static_cast<std::ptrdiff_t>(column),
                        num_taken_ + tokens_.size(),
                        cursor_.line(),
                        column,
                        cursor_.index(),
                        cursor_.position()};
  return true;
}

bool Scanner::remove_candidate() {
  KeyCandidate& candidate = candidates_.back();
  if (candidate.is_possible && candidate.is_required) {
    return fail(candidate.at, "expected ':' behind this key, on its line");
  }
  candidate.is_possible = false;
  return true;
}

/// Starts a block if the column is further right than that of the current block.
void Scanner::indent_to(std::size_t column, std::optional<std::size_t> number, TokenKind kind,
                        const char* at) {
  const auto wanted = static_cast<std::ptrdiff_t>(column);
  if (candidates_.size() > 1 || indent_ >= wanted) return;
  indents_.push_back(indent_);
  indent_ = wanted;
  const Token token{kind, at, {}, {}};
  if (number) {
    insert(*number, token);
  } else {
    tokens_.push_back(token);
  }
}

/// Ends the blocks that are further right than a column.
void Scanner::unindent_to(std::ptrdiff_t column) {
  if (candidates_.size() > 1) return;
  while (indent_ > column) {
    push(TokenKind::BlockEnd, 0);
    indent_ = indents_.back();
    indents_.pop_back();
  }
}

// One function per kind of token.

bool Scanner::fetch_stream_end() {
  candidates_.resize(1);
  unindent_to(-1);
  if (!remove_candidate()) return false;
  allows_key_ = false;
  push(TokenKind::StreamEnd, 0);
  is_ended_ = true;
  return true;
}

bool Scanner::fetch_directive() {
  unindent_to(-1);
  if (!remove_candidate()) return false;
  allows_key_ = false;
  return scan_directive();
}

bool Scanner::fetch_document_mark(TokenKind kind) {
  unindent_to(-1);
  if (!remove_candidate()) return false;
  allows_key_ = false;
  push(kind, 3);
  return true;
}

bool Scanner::fetch_flow_start(TokenKind kind) {
  if (!save_candidate()) return false;
  candidates_.push_back({});
  flow_is_sequence_.push_back(kind == TokenKind::FlowSequenceStart);
  allows_key_ = true;
  push(kind, 1);
  return true;
}

bool Scanner::fetch_flow_end(TokenKind kind) {
  if (!remove_candidate()) return false;
  if (candidates_.size() > 1) {
    candidates_.pop_back();
    flow_is_sequence_.pop_back();
  }
  allows_key_ = false;
  push(kind, 1);
  return true;
}

bool Scanner::fetch_flow_entry() {
  if (!remove_candidate()) return false;
  allows_key_ = true;
  push(TokenKind::FlowEntry, 1);
  return true;
}

bool Scanner::fetch_block_entry() {
  // In a flow collection the parser reports the fault, because it knows the collection.
  if (candidates_.size() == 1) {
    if (!allows_key_) {
      return fail(cursor_.position(), "expected no '-' here: an entry of a list starts a line");
    }
    indent_to(cursor_.column(), std::nullopt, TokenKind::BlockSequenceStart, cursor_.position());
  }
  if (!remove_candidate()) return false;
  allows_key_ = true;
  push(TokenKind::BlockEntry, 1);
  return true;
}

bool Scanner::fetch_key() {
  const bool is_in_flow = candidates_.size() > 1;
  if (!is_in_flow) {
    if (!allows_key_) {
      return fail(cursor_.position(), "expected no '?' here: a key starts a line");
    }
    indent_to(cursor_.column(), std::nullopt, TokenKind::BlockMappingStart, cursor_.position());
  }
  if (!remove_candidate()) return false;
  allows_key_ = !is_in_flow;
  push(TokenKind::Key, 1);
  return true;
}

bool Scanner::fetch_value() {
  const bool is_in_flow = candidates_.size() > 1;
  KeyCandidate& candidate = candidates_.back();
  if (candidate.is_possible) {
    insert(candidate.token, {TokenKind::Key, candidate.at, {}, {}});
    indent_to(candidate.column, candidate.token, TokenKind::BlockMappingStart, candidate.at);
    candidate.is_possible = false;
    allows_key_ = false;
  } else {
    if (!is_in_flow) {
      if (!allows_key_) {
        return fail(cursor_.position(),
                    "expected no ':' here: there is no key of this line that it could follow");
      }
      indent_to(cursor_.column(), std::nullopt, TokenKind::BlockMappingStart, cursor_.position());
    }
    allows_key_ = !is_in_flow;
  }
  push(TokenKind::Value, 1);
  return true;
}

/// Consumes rows of numbers as a whole where an entry of a sequence may be one.
bool Scanner::fetch_row() {
  const bool is_in_flow = candidates_.size() > 1;
  const bool starts_entry =
      is_in_flow ? flow_is_sequence_.back() &&
                       (last_ == TokenKind::FlowEntry || last_ == TokenKind::FlowSequenceStart)
                 : last_ == TokenKind::BlockEntry &&
                       indent_ < static_cast<std::ptrdiff_t>(cursor_.column());
  if (rows_ == nullptr || !starts_entry) return false;
  Token token{TokenKind::Row, cursor_.position(), {}, {}};
  if (!rows_->take(cursor_, is_in_flow, token.row, token.num_rows)) return false;
  token.value = {token.at, static_cast<std::size_t>(cursor_.position() - token.at)};
  allows_key_ = false;
  tokens_.push_back(token);
  last_ = token.kind;
  return true;
}

bool Scanner::fetch_property(bool (Scanner::*scan)()) {
  if (!save_candidate()) return false;
  allows_key_ = false;
  return (this->*scan)();
}

bool Scanner::fetch_flow_scalar(ScalarStyle style) {
  if (!save_candidate()) return false;
  allows_key_ = false;
  Token token{TokenKind::Scalar, cursor_.position(), {}, {}, style};
  if (!scan_quoted(token)) return false;
  tokens_.push_back(token);
  last_ = token.kind;
  return true;
}

bool Scanner::fetch_plain() {
  if (!save_candidate()) return false;
  allows_key_ = false;
  Token token{TokenKind::Scalar, cursor_.position(), {}, {}};
  if (!scan_plain(token)) return false;
  tokens_.push_back(token);
  last_ = token.kind;
  return true;
}

bool Scanner::fetch_block_scalar(ScalarStyle style) {
  if (!remove_candidate()) return false;
  allows_key_ = true;
  Token token{TokenKind::Scalar, cursor_.position(), {}, {}, style};
  if (!scan_block(token)) return false;
  tokens_.push_back(token);
  last_ = token.kind;
  return true;
}

}  // namespace kinefile::text::yaml
