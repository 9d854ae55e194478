// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "text/yaml/characters.hpp"
#include "text/yaml/number_rows.hpp"
#include "text/yaml/token.hpp"

namespace kinefile::text::yaml {

/// Why a text is not YAML.
struct Fault {
  const char* code = nullptr;  ///< of docs/errors.md
  std::string message;
  const char* at = nullptr;
};

/// Splits a YAML text into tokens. These include tokens that follow from the indentation: the
/// starts and ends of blocks, and the mark before a key, which is recognised only at its colon.
/// Source: YAML 1.1, and the behaviour of libyaml where YAML leaves a choice.
class Scanner {
 public:
  /// \param text  UTF-8, must outlive this
  /// \param rows  reads rows of numbers as a whole; null if that is not wanted
  Scanner(std::string_view text, NumberRows* rows);

  /// The next token, without consuming it; null after a fault.
  const Token* peek();
  /// Consumes the token that `peek` returned.
  void pop();

  const std::optional<Fault>& fault() const { return fault_; }
  /// Whether there were comments so far.
  bool has_comments() const { return has_comments_; }
  /// Keeps a text as long as this lives.
  std::string_view keep(std::string text) { return kept_.emplace_back(std::move(text)); }

 private:
  /// A token that becomes a key if its colon follows.
  struct KeyCandidate {
    bool is_possible = false;
    bool is_required = false;  ///< it is where a block mapping's key must be
    std::size_t token = 0;     ///< its number among all tokens
    std::size_t line = 0;
    std::size_t column = 0;
    std::size_t index = 0;
    const char* at = nullptr;
  };

  bool fail(const char* at, std::string message);
  void push(TokenKind kind, std::size_t bytes);
  void insert(std::size_t number, Token token);
  bool needs_more() const;
  void check_characters(const char* end);
  bool is_stale(const KeyCandidate& candidate) const;

  bool fetch();
  bool fetch_indicator(bool& is_found);
  void skip_to_token();
  void skip_comment();

  bool drop_stale_candidates();
  bool save_candidate();
  bool remove_candidate();
  void indent_to(std::size_t column, std::optional<std::size_t> number, TokenKind kind,
                 const char* at);
  void unindent_to(std::ptrdiff_t column);

  bool fetch_stream_end();
  bool fetch_directive();
  bool fetch_document_mark(TokenKind kind);
  bool fetch_flow_start(TokenKind kind);
  bool fetch_flow_end(TokenKind kind);
  bool fetch_flow_entry();
  bool fetch_block_entry();
  bool fetch_key();
  bool fetch_value();
  bool fetch_row();
  bool fetch_property(bool (Scanner::*scan)());
  bool fetch_flow_scalar(ScalarStyle style);
  bool fetch_plain();
  bool fetch_block_scalar(ScalarStyle style);

  // scan_properties.cpp
  bool scan_anchor();
  bool scan_tag();
  bool scan_handle(bool is_directive, std::string& handle);
  bool scan_uri(bool is_verbatim, std::string& uri);
  bool scan_escaped_character(std::string& uri);
  bool scan_directive();
  bool scan_version(const char* at);
  bool scan_version_number(int& number);
  bool scan_tag_directive(const char* at);

  // scan_scalars.cpp
  bool scan_plain(Token& token);
  bool scan_quoted(Token& token);
  bool scan_escape(std::string& value);
  bool scan_block(Token& token);
  bool scan_block_header(int& chomping, std::size_t& increment);
  bool scan_block_breaks(std::size_t& indent, std::string& breaks);
  void take_break(std::string& out);
  void take_line_rest(std::string& out);

  Cursor cursor_;
  NumberRows* rows_;
  std::deque<Token> tokens_;
  std::size_t num_taken_ = 0;
  std::optional<TokenKind> last_;  ///< the kind of the token that was fetched last
  bool is_ended_ = false;
  bool has_comments_ = false;
  bool allows_key_ = true;  ///< whether a key of one line may start here
  std::ptrdiff_t indent_ = -1;
  std::vector<std::ptrdiff_t> indents_;
  std::vector<KeyCandidate> candidates_ = {
      KeyCandidate{}};  ///< one per flow level, and one for the block
  std::vector<bool> flow_is_sequence_;
  std::deque<std::string> kept_;
  const char* checked_;  ///< up to here, the text has only characters that YAML allows
  std::optional<Fault> fault_;
};

}  // namespace kinefile::text::yaml
