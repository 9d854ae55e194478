// SPDX-License-Identifier: MIT
#include "support/yaml_events.hpp"

#include <fmt/format.h>

#include <cmath>

#include "text/numbers.hpp"
#include "text/yaml/parser.hpp"

namespace kinefile::test {
namespace {

using text::yaml::Event;
using text::yaml::EventKind;
using text::yaml::ScalarStyle;

/// Lists the events of one text.
class Lister {
 public:
  Lister(std::string_view text, YamlEventOptions options)
      : text_(text), cursor_(text), options_(options) {}

  void add(const Event& event) {
    switch (event.kind) {
      case EventKind::DocumentStart:
        lines_ += event.is_implicit ? "+DOC\n" : "+DOC ---\n";
        break;
      case EventKind::DocumentEnd:
        lines_ += event.is_implicit ? "-DOC\n" : "-DOC ...\n";
        break;
      case EventKind::SequenceStart:
        add_node("+SEQ", event, event.is_flow ? " []" : "");
        break;
      case EventKind::SequenceEnd:
        lines_ += "-SEQ\n";
        break;
      case EventKind::MappingStart:
        add_node("+MAP", event, event.is_flow ? " {}" : "");
        break;
      case EventKind::MappingEnd:
        lines_ += "-MAP\n";
        break;
      case EventKind::Alias:
        add_node("=ALI", event, fmt::format(" *{}", event.anchor));
        break;
      case EventKind::Scalar:
        add_scalar(event);
        break;
      default:
        break;
    }
  }

  void add_row(const text::yaml::RowShape& shape, std::span<const double> values) {
    lines_ += "+SEQ ? []\n";
    const auto take = [&](std::int32_t count) {
      for (; count > 0; --count, values = values.subspan(1)) add_number(values[0]);
    };
    for (const std::int32_t group : shape) {
      if (group > 0) {
        take(group);
        continue;
      }
      lines_ += "+SEQ ? []\n";
      if (group != text::yaml::kEmptyGroup) take(-group);
      lines_ += "-SEQ\n";
    }
    lines_ += "-SEQ\n";
  }

  const std::string& lines() const { return lines_; }

 private:
  void add_number(double value) { lines_ += fmt::format("=NUM {:a}\n", value); }

  void add_scalar(const Event& event) {
    if (options_.has_numbers && event.style == ScalarStyle::Plain && event.tag.empty() &&
        event.anchor.empty()) {
      const auto number = text::parse_number(event.value);
      if (number.fault == text::NumberFault::None && std::isfinite(number.value)) {
        add_number(number.value);
        return;
      }
    }
    constexpr std::string_view kSigns = ":'\"|>";
    std::string shown = fmt::format(" {}", kSigns[static_cast<std::size_t>(event.style)]);
    for (const char c : event.value) shown += c == '\n' ? std::string("\\n") : std::string(1, c);
    add_node("=VAL", event, shown);
  }

  void add_node(std::string_view word, const Event& event, std::string_view rest) {
    lines_ += fmt::format("{} {}", word, event.is_implicit ? "empty" : place(event.at));
    if (!event.anchor.empty() && event.kind != EventKind::Alias) {
      lines_ += fmt::format(" &{}", event.anchor);
    }
    // libyaml's tags end at a zero, which a tag can only have as "%00".
    if (!event.tag.empty())
      lines_ += fmt::format(" <{}>", event.tag.substr(0, event.tag.find('\0')));
    lines_ += fmt::format("{}\n", rest);
  }

  /// Line and column; places come nearly in order, so that the way to one starts at the last.
  std::string place(const char* at) {
    // Inner sequences of rows keep no places.
    if (options_.has_numbers) return "?";
    if (at < cursor_.position()) cursor_ = text::yaml::Cursor(text_);
    while (cursor_.position() < at) {
      if (cursor_.is_break()) {
        cursor_.skip_break();
      } else {
        cursor_.skip();
      }
    }
    return fmt::format("{}:{}", cursor_.line(), cursor_.column());
  }

  std::string_view text_;
  text::yaml::Cursor cursor_;
  YamlEventOptions options_;
  std::string lines_;
};

}  // namespace

std::optional<std::string> yaml_events(std::string_view text, YamlEventOptions options,
                                       bool* is_refused) {
  text::yaml::NumberRows rows;
  text::yaml::Parser parser(text, options.takes_rows ? &rows : nullptr);
  Lister lister(text, options);
  Event event;
  while (parser.next(event)) {
    if (event.kind == EventKind::StreamEnd) return lister.lines();
    if (event.kind == EventKind::Row) {
      for (std::size_t i = 0; i < event.num_rows; ++i) {
        lister.add_row(rows.shape(event.row), rows.pop(event.row));
      }
    } else {
      lister.add(event);
    }
  }
  const std::string_view code = parser.fault()->code;
  if (is_refused != nullptr) *is_refused = code == "YML003" || code == "YML004";
  return std::nullopt;
}

}  // namespace kinefile::test
