// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "formats/robovie/reader.hpp"

namespace kinefile::robovie {

/// Reads a motion file line by line and continues after faults, so that all are reported. A line
/// that cannot be read still counts as a block, so that the numbers of others do not change.
class Parser {
 public:
  explicit Parser(const Reader& reader) : reader_(reader), lines_(reader.source.text()) {}

  FlowFile parse();

 private:
  /// Splits the next line that is not blank; false at the end of the file.
  bool next_line();
  /// The keyword of the line; empty, with an error, if it is not one.
  std::optional<Keyword> keyword();
  bool parse_format();
  void parse_axis();
  void parse_line();
  void parse_info();
  void parse_body(Keyword keyword);
  void parse_word_n_pose();
  void add_unread();
  /// Reports a block that has no body.
  void end_block();

  Block& add_block();
  /// Keeps the places of the line's settings, for further checks, unless it had faults.
  void keep_places(std::size_t num_errors);
  BlockBody body(Keyword keyword, const Settings& settings);
  PoseBlock pose(const Settings& settings);
  void parse_words_of(const Settings& settings, PoseBlock& pose);
  void parse_mask(const Settings& settings, PoseBlock& pose);
  static ArithmeticBlock arithmetic(const Settings& settings, bool has_variable);
  static BranchBlock branch(const Settings& settings);
  /// An arrow as a number, which is checked against the number of blocks later.
  int arrow(const Settings& settings, std::size_t i);

  const Reader& reader_;
  Lines lines_;
  Setting setting_;
  FlowFile file_;
  std::size_t line_number_ = 0;
  bool has_blank_before_ = false;  ///< before the line
  bool knows_axis_ = false;        ///< whether the number of words per pose is known
  const char* axis_at_ = nullptr;
  bool has_info_ = false;  ///< the last block has no body yet
  const char* info_at_ = nullptr;
  bool told_few_words_ = false;
};

}  // namespace kinefile::robovie
