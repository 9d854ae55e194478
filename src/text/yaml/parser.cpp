// SPDX-License-Identifier: MIT
#include "text/yaml/parser.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kinefile::text::yaml {

Parser::Parser(std::string_view text, NumberRows* rows) : scanner_(text, rows) {}

bool Parser::next(Event& event) {
  event = Event{};
  switch (state_) {
    case State::FirstDocumentStart:
      return parse_document_start(event, true);
    case State::DocumentStart:
      return parse_document_start(event, false);
    case State::DocumentContent:
      return parse_document_content(event);
    case State::DocumentEnd:
      return parse_document_end(event);
    case State::BlockNode:
      return parse_node(event, true);
    case State::FirstBlockEntry:
    case State::BlockEntry:
      return parse_block_entry(event, state_ == State::FirstBlockEntry);
    case State::IndentlessEntry:
      return parse_indentless_entry(event);
    case State::FirstBlockKey:
    case State::BlockKey:
      return parse_block_key(event, state_ == State::FirstBlockKey);
    case State::BlockValue:
      return parse_block_value(event);
    case State::FirstFlowEntry:
    case State::FlowEntry:
      return parse_flow_entry(event, state_ == State::FirstFlowEntry);
    case State::PairKey:
      return parse_pair_key(event);
    case State::PairValue:
      return parse_pair_value(event);
    case State::PairEnd:
      event.kind = EventKind::MappingEnd;
      if (const Token* token = peek()) event.at = token->at;
      state_ = State::FlowEntry;
      return !fault_;
    case State::FirstFlowKey:
    case State::FlowKey:
      return parse_flow_key(event, state_ == State::FirstFlowKey);
    case State::FlowValue:
    case State::EmptyFlowValue:
      return parse_flow_value(event, state_ == State::EmptyFlowValue);
    case State::End:
      event.kind = EventKind::StreamEnd;
      return !fault_;
  }
  return false;
}

const Token* Parser::peek() {
  const Token* token = fault_ ? nullptr : scanner_.peek();
  if (token == nullptr && !fault_) fault_ = scanner_.fault();
  return token;
}

/// Whether the next token is one of the given kinds.
bool Parser::is_next(std::initializer_list<TokenKind> kinds) {
  const Token* token = peek();
  return token != nullptr && std::find(kinds.begin(), kinds.end(), token->kind) != kinds.end();
}

bool Parser::fail(const char* code, const char* at, std::string message) {
  if (!fault_) fault_ = Fault{code, std::move(message), at};
  return false;
}

/// Stores the state that follows after the next node.
bool Parser::push(State state) {
  if (states_.size() >= kMostLevels) {
    const Token* token = peek();
    return fail("YML003", token == nullptr ? nullptr : token->at,
                fmt::format("expected at most {} levels of sequences and mappings, found more",
                            kMostLevels));
  }
  states_.push_back(state);
  return true;
}

void Parser::pop() {
  state_ = states_.back();
  states_.pop_back();
}

/// The event of an omitted value.
bool Parser::empty_scalar(Event& event, const char* at) {
  event.kind = EventKind::Scalar;
  event.at = at;
  event.is_implicit = true;
  return !fault_;
}

bool Parser::parse_document_start(Event& event, bool may_be_implicit) {
  if (!may_be_implicit) {
    while (is_next({TokenKind::DocumentEnd})) scanner_.pop();
  }
  const Token* token = peek();
  if (token == nullptr) return false;
  event.at = token->at;
  if (token->kind == TokenKind::StreamEnd) {
    state_ = State::End;
    event.kind = EventKind::StreamEnd;
    return true;
  }
  event.kind = EventKind::DocumentStart;
  const bool is_explicit =
      is_next({TokenKind::VersionDirective, TokenKind::TagDirective, TokenKind::DocumentStart});
  event.is_implicit = may_be_implicit && !is_explicit;
  if (!parse_directives() || !push(State::DocumentEnd)) return false;
  if (event.is_implicit) {
    state_ = State::BlockNode;
    return true;
  }
  token = peek();
  if (token == nullptr) return false;
  if (token->kind != TokenKind::DocumentStart) {
    return fail("YML001", token->at, "expected '---' before another document");
  }
  scanner_.pop();
  state_ = State::DocumentContent;
  return true;
}

bool Parser::parse_directives() {
  handles_.clear();
  bool has_version = false;
  while (is_next({TokenKind::VersionDirective, TokenKind::TagDirective})) {
    const Token token = *peek();
    if (token.kind == TokenKind::VersionDirective) {
      if (has_version) return fail("YML001", token.at, "expected one %YAML directive");
      if (token.value != "1.1" && token.value != "1.2") {
        return fail("YML001", token.at, "expected YAML 1.1 or 1.2");
      }
      has_version = true;
    } else {
      const bool is_known = std::any_of(handles_.begin(), handles_.end(), [&](const auto& handle) {
        return handle.first == token.value;
      });
      if (is_known) return fail("YML001", token.at, "expected one %TAG directive a handle");
      handles_.emplace_back(token.value, token.suffix);
    }
    scanner_.pop();
  }
  handles_.emplace_back("!", "!");
  handles_.emplace_back("!!", "tag:yaml.org,2002:");
  return !fault_;
}

bool Parser::parse_document_content(Event& event) {
  const Token* token = peek();
  if (token == nullptr) return false;
  if (is_next({TokenKind::VersionDirective, TokenKind::TagDirective, TokenKind::DocumentStart,
               TokenKind::DocumentEnd, TokenKind::StreamEnd})) {
    pop();
    return empty_scalar(event, token->at);
  }
  return parse_node(event, true);
}

bool Parser::parse_document_end(Event& event) {
  const Token* token = peek();
  if (token == nullptr) return false;
  event.kind = EventKind::DocumentEnd;
  event.at = token->at;
  event.is_implicit = token->kind != TokenKind::DocumentEnd;
  if (!event.is_implicit) scanner_.pop();
  state_ = State::DocumentStart;
  return true;
}

bool Parser::parse_node(Event& event, bool is_block, bool may_be_indentless) {
  const Token* token = peek();
  if (token == nullptr) return false;
  event.at = token->at;
  if (token->kind == TokenKind::Alias) {
    event.kind = EventKind::Alias;
    event.anchor = token->value;
    scanner_.pop();
    pop();
    return true;
  }
  bool has_properties = false;
  if (!parse_properties(event, has_properties)) return false;
  if (may_be_indentless && is_next({TokenKind::BlockEntry})) {
    event.kind = EventKind::SequenceStart;
    state_ = State::IndentlessEntry;
    return true;
  }
  return parse_content(event, is_block, has_properties);
}

/// Reads an anchor and a tag, in any order.
bool Parser::parse_properties(Event& event, bool& has_any) {
  bool has_anchor = false;
  bool has_tag = false;
  while (true) {
    const Token* token = peek();
    if (token == nullptr) return false;
    if (token->kind == TokenKind::Anchor && !has_anchor) {
      event.anchor = token->value;
      has_anchor = true;
    } else if (token->kind == TokenKind::Tag && !has_tag) {
      if (!resolve_tag(*token, event.tag)) return false;
      has_tag = true;
    } else {
      has_any = has_anchor || has_tag;
      return true;
    }
    scanner_.pop();
  }
}

bool Parser::resolve_tag(const Token& token, std::string_view& tag) {
  if (token.value.empty()) {
    tag = token.suffix;
    return true;
  }
  for (const auto& [handle, prefix] : handles_) {
    if (handle != token.value) continue;
    tag = scanner_.keep(prefix + std::string(token.suffix));
    return true;
  }
  return fail(
      "YML001", token.at,
      fmt::format("expected a tag whose handle '{}' a %TAG directive defines", token.value));
}

bool Parser::parse_content(Event& event, bool is_block, bool has_properties) {
  const Token* token = peek();
  if (token == nullptr) return false;
  switch (token->kind) {
    case TokenKind::Scalar:
      event.kind = EventKind::Scalar;
      event.value = token->value;
      event.style = token->style;
      scanner_.pop();
      pop();
      return true;
    case TokenKind::Row:
      event.kind = EventKind::Row;
      event.is_flow = true;
      event.row = token->row;
      event.num_rows = token->num_rows;
      event.value = token->value;
      scanner_.pop();
      pop();
      return true;
    case TokenKind::FlowSequenceStart:
    case TokenKind::FlowMappingStart: {
      const bool is_sequence = token->kind == TokenKind::FlowSequenceStart;
      event.kind = is_sequence ? EventKind::SequenceStart : EventKind::MappingStart;
      event.is_flow = true;
      state_ = is_sequence ? State::FirstFlowEntry : State::FirstFlowKey;
      return true;
    }
    case TokenKind::BlockSequenceStart:
    case TokenKind::BlockMappingStart: {
      if (!is_block) break;
      const bool is_sequence = token->kind == TokenKind::BlockSequenceStart;
      event.kind = is_sequence ? EventKind::SequenceStart : EventKind::MappingStart;
      state_ = is_sequence ? State::FirstBlockEntry : State::FirstBlockKey;
      return true;
    }
    default:
      break;
  }
  if (has_properties) {
    pop();
    return empty_scalar(event, event.at);
  }
  return fail("YML001", token->at, "expected a value");
}

bool Parser::parse_block_entry(Event& event, bool is_first) {
  if (is_first) scanner_.pop();
  const Token* token = peek();
  if (token == nullptr) return false;
  event.at = token->at;
  if (token->kind == TokenKind::BlockEntry) {
    const char* const at = token->at;
    scanner_.pop();
    if (is_next({TokenKind::BlockEntry, TokenKind::BlockEnd})) {
      state_ = State::BlockEntry;
      return empty_scalar(event, at + 1);
    }
    return !fault_ && push(State::BlockEntry) && parse_node(event, true);
  }
  if (token->kind == TokenKind::BlockEnd) {
    event.kind = EventKind::SequenceEnd;
    scanner_.pop();
    pop();
    return true;
  }
  return fail("YML001", token->at, "expected another entry of the list, '-', or its end");
}

bool Parser::parse_indentless_entry(Event& event) {
  const Token* token = peek();
  if (token == nullptr) return false;
  event.at = token->at;
  if (token->kind != TokenKind::BlockEntry) {
    event.kind = EventKind::SequenceEnd;
    pop();
    return true;
  }
  const char* const at = token->at;
  scanner_.pop();
  if (is_next({TokenKind::BlockEntry, TokenKind::Key, TokenKind::Value, TokenKind::BlockEnd})) {
    state_ = State::IndentlessEntry;
    return empty_scalar(event, at + 1);
  }
  return !fault_ && push(State::IndentlessEntry) && parse_node(event, true);
}

bool Parser::parse_block_key(Event& event, bool is_first) {
  if (is_first) scanner_.pop();
  const Token* token = peek();
  if (token == nullptr) return false;
  event.at = token->at;
  if (token->kind == TokenKind::Key) {
    const char* const at = token->at;
    scanner_.pop();
    if (is_next({TokenKind::Key, TokenKind::Value, TokenKind::BlockEnd})) {
      state_ = State::BlockValue;
      return empty_scalar(event, at);
    }
    return !fault_ && push(State::BlockValue) && parse_node(event, true, true);
  }
  if (token->kind == TokenKind::BlockEnd) {
    event.kind = EventKind::MappingEnd;
    scanner_.pop();
    pop();
    return true;
  }
  return fail("YML001", token->at, "expected another key of the mapping, or its end");
}

bool Parser::parse_block_value(Event& event) {
  const Token* token = peek();
  if (token == nullptr) return false;
  const char* const at = token->at;
  if (token->kind != TokenKind::Value) {
    state_ = State::BlockKey;
    return empty_scalar(event, at);
  }
  scanner_.pop();
  if (is_next({TokenKind::Key, TokenKind::Value, TokenKind::BlockEnd})) {
    state_ = State::BlockKey;
    return empty_scalar(event, at + 1);
  }
  return !fault_ && push(State::BlockKey) && parse_node(event, true, true);
}

bool Parser::parse_flow_entry(Event& event, bool is_first) {
  if (is_first) scanner_.pop();
  const Token* token = peek();
  if (token == nullptr) return false;
  if (!is_first && token->kind != TokenKind::FlowSequenceEnd) {
    if (token->kind != TokenKind::FlowEntry) {
      return fail("YML001", token->at, "expected ',' or ']' behind an entry");
    }
    scanner_.pop();
    token = peek();
    if (token == nullptr) return false;
  }
  event.at = token->at;
  if (token->kind == TokenKind::Key) {
    event.kind = EventKind::MappingStart;
    event.is_flow = true;
    scanner_.pop();
    state_ = State::PairKey;
    return true;
  }
  if (token->kind != TokenKind::FlowSequenceEnd) {
    return push(State::FlowEntry) && parse_node(event, false);
  }
  event.kind = EventKind::SequenceEnd;
  scanner_.pop();
  pop();
  return true;
}

/// The key of a mapping of one pair that is an entry of a flow sequence: `[a: b]`.
bool Parser::parse_pair_key(Event& event) {
  if (is_next({TokenKind::Value, TokenKind::FlowEntry, TokenKind::FlowSequenceEnd})) {
    // Programs disagree: libyaml loses the next character.
    return fail("YML004", peek()->at, "expected a key behind '?' in a list");
  }
  return !fault_ && push(State::PairValue) && parse_node(event, false);
}

bool Parser::parse_pair_value(Event& event) {
  const Token* token = peek();
  if (token == nullptr) return false;
  const char* const at = token->at;
  if (token->kind == TokenKind::Value) {
    scanner_.pop();
    if (!is_next({TokenKind::FlowEntry, TokenKind::FlowSequenceEnd})) {
      return !fault_ && push(State::PairEnd) && parse_node(event, false);
    }
  }
  state_ = State::PairEnd;
  return empty_scalar(event, at);
}

bool Parser::parse_flow_key(Event& event, bool is_first) {
  if (is_first) scanner_.pop();
  const Token* token = peek();
  if (token == nullptr) return false;
  if (!is_first && token->kind != TokenKind::FlowMappingEnd) {
    if (token->kind != TokenKind::FlowEntry) {
      return fail("YML001", token->at, "expected ',' or '}' behind a value");
    }
    scanner_.pop();
    token = peek();
    if (token == nullptr) return false;
  }
  event.at = token->at;
  if (token->kind == TokenKind::Key) {
    scanner_.pop();
    if (!is_next({TokenKind::Value, TokenKind::FlowEntry, TokenKind::FlowMappingEnd})) {
      return !fault_ && push(State::FlowValue) && parse_node(event, false);
    }
    state_ = State::FlowValue;
    return empty_scalar(event, peek()->at);
  }
  if (token->kind != TokenKind::FlowMappingEnd) {
    return push(State::EmptyFlowValue) && parse_node(event, false);
  }
  event.kind = EventKind::MappingEnd;
  scanner_.pop();
  pop();
  return true;
}

bool Parser::parse_flow_value(Event& event, bool is_empty) {
  const Token* token = peek();
  if (token == nullptr) return false;
  const char* const at = token->at;
  if (!is_empty && token->kind == TokenKind::Value) {
    scanner_.pop();
    if (!is_next({TokenKind::FlowEntry, TokenKind::FlowMappingEnd})) {
      return !fault_ && push(State::FlowKey) && parse_node(event, false);
    }
  }
  state_ = State::FlowKey;
  return empty_scalar(event, at);
}

}  // namespace kinefile::text::yaml
