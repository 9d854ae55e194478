// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#pragma GCC visibility push(default)

namespace kinefile {

enum class Severity {
  Note,     ///< worth knowing; nothing is wrong
  Warning,  ///< the file deviates from its format; the message says how it was read
  Error,    ///< the file cannot be read without losing or guessing something
};

/// Returns "note", "warning" or "error".
std::string_view severity_name(Severity severity);

/// A place in an input. Lines and columns count from 1; columns count UTF-8 bytes of the decoded
/// line. Line 0 means the source as a whole.
struct Place {
  std::string source;
  std::size_t line = 0;
  std::size_t column = 0;
};

/// The kind of an error, for callers that handle kinds differently.
enum class ErrorKind {
  InvalidInput,  ///< the input breaks its format's rules
  Io,            ///< a file could not be read or written
  DataLoss,      ///< refused, because something in the input would be lost
  Usage,         ///< the request does not fit the input
};

/// One finding about an input.
struct Diagnostic {
  Severity severity = Severity::Error;
  ErrorKind kind = ErrorKind::InvalidInput;  ///< of errors
  std::string code;                          ///< as listed in docs/errors.md, "BVH006"
  std::string message;                       ///< one sentence: what was expected, what was found
  Place place;
  std::string excerpt;    ///< the source line, or the part of a long one around the place
  std::size_t caret = 0;  ///< byte offset in `excerpt` that the place points at
};

/// A diagnostic that ended an operation.
struct Error : Diagnostic {};

/// Makes an error that has no place in a text.
Error make_error(ErrorKind kind, std::string code, std::string message, std::string source = {});

/// Collects diagnostics. It is a parameter of every reader and writer, so that no caller overlooks
/// it. Keeps at most `kMaxPerCode` diagnostics of one code and severity and only counts further
/// ones, so that a hostile file cannot fill the memory with them.
class Diagnostics {
 public:
  static constexpr std::size_t kMaxPerCode = 100'000;

  /// Adds a diagnostic; a warning becomes an error if `warnings_are_errors`.
  void add(Diagnostic diagnostic);
  /// Adds a diagnostic without a place in a text.
  void add(Severity severity, std::string code, std::string message);

  /// In the order in which they were added.
  const std::vector<Diagnostic>& items() const { return items_; }
  /// The items in the order of their places, those without a place first.
  std::vector<const Diagnostic*> by_place() const;
  /// How many were added with this severity, including those beyond `kMaxPerCode`.
  std::size_t count(Severity severity) const;
  bool has_errors() const { return count(Severity::Error) > 0; }
  /// How many of this code and severity were added, including those beyond `kMaxPerCode`.
  std::size_t count_of(const std::string& code, Severity severity) const;
  /// Whether diagnostics of this code and severity are only counted from now on, so that callers
  /// need not build their texts.
  bool is_full(const std::string& code, Severity severity) const;
  /// Adds all diagnostics of another collection, as if they had been added here.
  void append(Diagnostics&& other);
  /// The error that came first. Precondition: `has_errors()`.
  Error first_error() const;

  bool warnings_are_errors = false;  ///< `--strict`

 private:
  std::vector<Diagnostic> items_;
  std::map<std::pair<std::string, Severity>, std::size_t> counts_;
};

/// The same diagnostics; those without a source get one.
/// \param are_strict  whether warnings become errors (`Diagnostics::warnings_are_errors`)
Diagnostics named(const Diagnostics& diagnostics, const std::string& source, bool are_strict);

/// A text as a terminal may show it: control characters (C0, C1), marks that change the direction
/// of text, line separators and bytes that are no UTF-8 are escaped, as \x1b or \u202e. Names
/// come from files, and must not control the terminal or hide what follows.
std::string printable(std::string_view text);

/// Formats a diagnostic as `source:line:column: severity[CODE]: message`, and below it, if there is
/// an excerpt, the source line and a caret. No final newline.
std::string to_string(const Diagnostic& diagnostic);

}  // namespace kinefile

#pragma GCC visibility pop
