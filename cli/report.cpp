// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <utility>

namespace kinefile::cli {
namespace {

constexpr std::size_t kMostOfOneCode = 20;

/// What stdout still gets: small pieces are written together.
struct Data {
  OutputFile stream = OutputFile::of_stream(STDOUT_FILENO, "<stdout>");
  std::string waiting;
};

Data& data() {
  static Data own;
  return own;
}

/// The line that `show_status_line` shows.
std::string& status_line() {
  static std::string line;
  return line;
}

OutputFile& messages() {
  static OutputFile stream = OutputFile::of_stream(STDERR_FILENO, "<stderr>");
  return stream;
}

void remove_status_line() {
  constexpr std::string_view kErase = "\r\x1b[K";
  if (!status_line().empty()) messages().write(kErase);
  status_line().clear();
}

void flush_data() {
  Data& own = data();
  if (!own.waiting.empty()) remove_status_line();
  own.stream.write(own.waiting);
  own.waiting.clear();
}

void write_message(std::string_view text) {
  flush_data();  // what was printed before stays before it
  remove_status_line();
  messages().write(text);
}

/// What of a text for people is printable, line by line.
std::string printable_lines(std::string_view text) {
  std::string lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines += printable(text.substr(0, end));
    if (end < text.size()) lines += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

void print_to(int stream, std::string_view text) {
  if (stream == STDOUT_FILENO) {
    print_data(text);
  } else {
    write_message(text);
  }
}

bool wants_color(int stream, const Globals& globals) {
  if (globals.color != "auto") return globals.color == "always";
  const char* no_color = std::getenv("NO_COLOR");
  return (no_color == nullptr || *no_color == '\0') && isatty(stream) == 1;
}

std::string_view color_of(Severity severity) {
  switch (severity) {
    case Severity::Note:
      return "\x1b[36m";
    case Severity::Warning:
      return "\x1b[33m";
    case Severity::Error:
      return "\x1b[31m";
  }
  return "";
}

void print_one(int stream, const Diagnostic& diagnostic, bool has_color) {
  std::string text = to_string(diagnostic);
  if (has_color) {
    const std::string label =
        fmt::format("{}[{}]", severity_name(diagnostic.severity), diagnostic.code);
    const std::size_t at = text.find(label);
    if (at != std::string::npos) {
      text.insert(at + label.size(), "\x1b[0m");
      text.insert(at, color_of(diagnostic.severity));
    }
  }
  text += '\n';
  print_to(stream, text);
}

}  // namespace

void print_diagnostics(int stream, const Diagnostics& diagnostics, const Globals& globals) {
  const bool has_color = wants_color(stream, globals);
  std::map<std::pair<std::string, Severity>, std::size_t> printed;
  for (const Diagnostic* item : diagnostics.by_place()) {
    if (globals.is_quiet && item->severity != Severity::Error) continue;
    const std::size_t count = ++printed[{item->code, item->severity}];
    if (count <= kMostOfOneCode) print_one(stream, *item, has_color);
    if (count != kMostOfOneCode + 1) continue;
    const std::string more =
        fmt::format("{}: {} of {} [{}] are shown\n", item->place.source, kMostOfOneCode,
                    diagnostics.count_of(item->code, item->severity), item->code);
    print_to(stream, more);
  }
}

void print_error(const Error& error, const Globals& globals) {
  // The reader of our output stopped early, as `head` does: the exit code is enough, no message is
  // needed.
  const std::string pipe_closed = fmt::format("cannot write: {}", std::strerror(EPIPE));
  if (error.place.source == "<stdout>" && error.message == pipe_closed) return;
  print_one(STDERR_FILENO, error, wants_color(STDERR_FILENO, globals));
}

int print_failure(Error error, const Diagnostics& diagnostics, const std::string& file,
                  const Globals& globals) {
  if (error.place.source.empty()) error.place.source = file;
  if (!diagnostics.has_errors()) print_error(error, globals);
  return exit_code_of(error);
}

void show_status_line(const std::string& text) {
  remove_status_line();
  messages().write(text);
  status_line() = text;
}

void print_message(std::string_view text) { write_message(printable_lines(text)); }

void print_lines(std::string_view text) { print_data(printable_lines(text)); }

void print_data(std::string_view text) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  data().waiting += text;
  if (data().waiting.size() >= kBlock) flush_data();
}

int finish_output(int exit_code, const Globals& globals) {
  flush_data();
  const auto written = data().stream.fault();
  if (written) return exit_code;
  print_error(written.error(), globals);
  return kIo;
}

ExitCode exit_code_of(const Error& error) {
  switch (error.kind) {
    case ErrorKind::InvalidInput:
      return kInvalid;
    case ErrorKind::Io:
      return kIo;
    case ErrorKind::DataLoss:
      return kDataLoss;
    case ErrorKind::Usage:
      return kUsage;
  }
  return kInvalid;
}

int worse(int a, int b) {
  const auto rank = [](int code) { return code == kIo ? 100 : code; };
  return rank(a) >= rank(b) ? a : b;
}

}  // namespace kinefile::cli
