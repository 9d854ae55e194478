// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/yaml/scanner.hpp"

namespace kinefile::text::yaml {

enum class EventKind {
  DocumentStart,
  DocumentEnd,
  SequenceStart,
  SequenceEnd,
  MappingStart,
  MappingEnd,
  Scalar,
  Alias,
  Row,  ///< a sequence of numbers, and of sequences of numbers, as a whole
  StreamEnd,
};

/// What happens next in a YAML text.
struct Event {
  EventKind kind = EventKind::StreamEnd;
  const char* at = nullptr;
  std::string_view anchor;  ///< without its sign; of an alias, what it stands for
  std::string_view tag;     ///< resolved; empty where there is none
  std::string_view value;   ///< of a scalar; of a row, its text
  ScalarStyle style = ScalarStyle::Plain;
  bool is_flow = false;      ///< of a sequence or mapping
  bool is_implicit = false;  ///< of a document's start or end; of a scalar: an empty one, unwritten
  std::size_t row = 0;       ///< of a row: its shape
};

/// How deep sequences and mappings may lie in each other. Every level costs readers stack.
inline constexpr std::size_t kMostLevels = 200;

/// Turns a YAML text into events.
/// Source: YAML 1.1; events as libyaml has them, rows of numbers apart.
class Parser {
 public:
  /// \param text  UTF-8, must outlive this
  /// \param rows  takes rows of numbers, where they are wanted as a whole; else null
  explicit Parser(std::string_view text, NumberRows* rows = nullptr);

  /// Goes on to the next event. False after a fault.
  bool next(Event& event);
  const std::optional<Fault>& fault() const { return fault_; }
  /// Whether there were comments so far.
  bool has_comments() const { return scanner_.has_comments(); }

 private:
  enum class State {
    FirstDocumentStart,
    DocumentStart,
    DocumentContent,
    DocumentEnd,
    BlockNode,
    FirstBlockEntry,
    BlockEntry,
    IndentlessEntry,
    FirstBlockKey,
    BlockKey,
    BlockValue,
    FirstFlowEntry,
    FlowEntry,
    PairKey,
    PairValue,
    PairEnd,
    FirstFlowKey,
    FlowKey,
    FlowValue,
    EmptyFlowValue,
    End,
  };

  const Token* peek();
  bool is_next(std::initializer_list<TokenKind> kinds);
  bool fail(const char* code, const char* at, std::string message);
  bool push(State state);
  void pop();
  bool empty_scalar(Event& event, const char* at);

  bool parse_document_start(Event& event, bool may_be_implicit);
  bool parse_directives();
  bool parse_document_content(Event& event);
  bool parse_document_end(Event& event);
  bool parse_node(Event& event, bool is_block, bool may_be_indentless = false);
  bool parse_properties(Event& event, bool& has_any);
  bool parse_content(Event& event, bool is_block, bool has_properties);
  bool resolve_tag(const Token& token, std::string_view& tag);
  bool parse_block_entry(Event& event, bool is_first);
  bool parse_indentless_entry(Event& event);
  bool parse_block_key(Event& event, bool is_first);
  bool parse_block_value(Event& event);
  bool parse_flow_entry(Event& event, bool is_first);
  bool parse_pair_key(Event& event);
  bool parse_pair_value(Event& event);
  bool parse_flow_key(Event& event, bool is_first);
  bool parse_flow_value(Event& event, bool is_empty);

  Scanner scanner_;
  State state_ = State::FirstDocumentStart;
  std::vector<State> states_;
  std::vector<std::pair<std::string, std::string>> handles_;  ///< of tags, and their prefixes
  std::optional<Fault> fault_;
};

}  // namespace kinefile::text::yaml
