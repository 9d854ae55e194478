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

/// The data that all parts of the readers use.
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
  /// Reports an error, or with --lenient a warning that describes the repair.
  void repair(const char* code, std::string message, std::string_view done, const char* at) const;
};

/// The allowed numbers of a setting, and the code for other numbers.
struct Range {
  const char* code = nullptr;
  int minimum = 0;
  int maximum = 0;
};

/// The settings of a line of a motion file, one by one; reports those that are not valid.
class Settings {
 public:
  Settings(const Reader& reader, const Setting& line, const KeywordRow& row)
      : reader_(reader), line_(line), row_(row) {}

  /// Whether the line has the correct form and as many settings as its keyword needs.
  bool are_complete() const;

  /// Any whole number. Empty after an error.
  std::optional<int> integer(std::size_t i) const;
  /// A number within a range. After an error the nearest allowed one.
  int number(std::size_t i, const Range& range) const;
  /// As `number` from 1 to `kMaxTicks`; --lenient uses the nearest one.
  int ticks(std::size_t i) const;
  /// A text in doubled brackets. Single brackets are an error; with --lenient the text is empty, as
  /// in the editor.
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

/// Reports that a text is not valid: with RBV004 if full-width characters are the reason.
void tell_wrong(const Reader& reader, const char* code, std::string message, std::string_view text);

/// Reports a spelling that the editor does not write and may not read.
void tell_spelling(const Reader& reader, std::string_view what, const char* at);

/// Reads the words of a pose.
/// \returns how many there are; if there are too many, the first are kept
std::size_t parse_words(const Reader& reader, const Field& field, std::size_t num_kept,
                        std::vector<SliderWord>& words);

/// The place of a word of a pose.
/// \param words  the opening bracket before the first word
/// Precondition: the line has that many words.
const char* place_of_word(const char* words, std::size_t slider);

/// Reads a motion file; its faults are in the reader's diagnostics.
FlowFile parse(const Reader& reader);

/// Reports inconsistencies in a file that was read: arrows, starts, the paths of the flow,
/// variables, sounds.
void check(const Reader& reader, FlowFile& file);

/// Checks a flow against the robot's project and the largest speed, if the options have them.
void check_on_robot(const Reader& reader, const FlowFile& file);

}  // namespace kinefile::robovie
