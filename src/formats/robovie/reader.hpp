// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/robovie/settings.hpp"
#include "formats/robovie/syntax.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/format.hpp"
#include "kinefile/robovie.hpp"
#include "text/source.hpp"

namespace kinefile::robovie {

/// What all parts of the readers work with.
struct Reader {
  const text::Source& source;
  const kinefile::ReadOptions& options;
  Diagnostics& diagnostics;

  void tell(Severity severity, const char* code, std::string message, const char* at) const {
    text::report(source, diagnostics, severity, code, std::move(message), at);
  }
  void error(const char* code, std::string message, const char* at) const {
    tell(Severity::Error, code, std::move(message), at);
  }
  void warn(const char* code, std::string message, const char* at) const {
    tell(Severity::Warning, code, std::move(message), at);
  }
  /// An error, or with --lenient a warning that says what is done instead.
  void repair(const char* code, std::string message, std::string_view done, const char* at) const;
};

/// The numbers that a setting may have, and the code of those that it may not.
struct Range {
  const char* code = nullptr;
  int minimum = 0;
  int maximum = 0;
};

/// The settings of a line of a motion file, one by one; tells of those that do not fit.
class Settings {
 public:
  Settings(const Reader& reader, const Setting& line, const KeywordRow& row)
      : reader_(reader), line_(line), row_(row) {}

  /// Whether the line is laid out well and has as many settings as its keyword asks for.
  bool are_complete() const;

  /// A whole number, whatever it is. Nothing after an error.
  std::optional<int> integer(std::size_t i) const;
  /// A number of a range. After an error the nearest one that it allows.
  int number(std::size_t i, const Range& range) const;
  /// As `number` from 1 to `kMaxTicks`; --lenient takes the nearest one.
  int ticks(std::size_t i) const;
  /// A text in doubled brackets. Single ones are an error; --lenient takes no text, as the editor.
  std::string text(std::size_t i) const;
  /// A text in single brackets.
  std::string_view single(std::size_t i) const;

  const Field& field(std::size_t i) const { return line_.fields[i]; }
  const Setting& line() const { return line_; }
  const Reader& reader() const { return reader_; }

 private:
  const Reader& reader_;
  const Setting& line_;
  KeywordRow row_;
};

/// Tells that a text is not what it should be: RBV004 where full-width characters are why.
void tell_wrong(const Reader& reader, const char* code, std::string message, std::string_view text);

/// Tells of a way of writing that the editor does not have and may not read.
void tell_spelling(const Reader& reader, std::string_view what, const char* at);

/// Reads the words of a pose. \returns how many there are; of too many the first are kept
std::size_t parse_words(const Reader& reader, const Field& field, std::size_t num_kept,
                        std::vector<SliderWord>& words);

/// Where a word of a pose stands. \param words  the opening bracket before the first one
/// Precondition: the line has that many words.
const char* place_of_word(const char* words, std::size_t slider);

/// Reads a motion file; what is wrong is in the reader's diagnostics.
FlowFile parse(const Reader& reader);

/// Tells of what does not fit together in a file that was read: arrows, starts, the way of the
/// flow, variables, sounds.
void check(const Reader& reader, FlowFile& file);

/// Holds a flow against the robot's project and the largest speed, as far as the options have them.
void check_on_robot(const Reader& reader, const FlowFile& file);

}  // namespace kinefile::robovie
