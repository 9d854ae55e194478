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
  Row,  ///< a sequence of numbers, and of sequences of numbers, as a whole; or several
  StreamEnd,
};

/// An event in a YAML text.
struct Event {
  EventKind kind = EventKind::StreamEnd;
  const char* at = nullptr;
  std::string_view anchor;  ///< without its sign; for an alias, the anchor that it names
  std::string_view tag;     ///< resolved; empty if there is none
  std::string_view value;   ///< of a scalar; of rows, their text
  ScalarStyle style = ScalarStyle::Plain;
  bool is_flow = false;      ///< of a sequence or mapping
  bool is_implicit = false;  ///< of a document's start or end; of a scalar: it is omitted
  std::size_t row = 0;       ///< of a row: its shape
  std::size_t num_rows = 1;  ///< of that shape, consecutive entries of a sequence
};

/// The largest depth of nested sequences and mappings. Every level needs stack in readers.
inline constexpr std::size_t kMostLevels = 200;

/// Converts a YAML text to events.
/// Source: YAML 1.1; events as in libyaml, except rows of numbers.
class Parser {
 public:
  /// \param text  UTF-8, must outlive this
  /// \param rows  reads rows of numbers as a whole; null if that is not wanted
  explicit Parser(std::string_view text, NumberRows* rows = nullptr);

  /// Moves to the next event. False after a fault.
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
