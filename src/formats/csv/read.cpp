// SPDX-License-Identifier: MIT
#include "formats/csv/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/words.hpp"
#include "formats/files.hpp"
#include "text/decode.hpp"
#include "text/numbers.hpp"
#include "text/source.hpp"

namespace kinefile::csv {
namespace {

constexpr std::array<std::string_view, 7> kPoseChannels = {"x", "y", "z", "qw", "qx", "qy", "qz"};

/// A field of a table: its text without quotes, and where it starts.
struct Field {
  std::string text;
  const char* at = nullptr;
};

/// Goes over a table, field by field, as RFC 4180 has it.
class Fields {
 public:
  explicit Fields(std::string_view text) : next_(text.data()), end_(next_ + text.size()) {}

  bool is_at_end() const { return next_ == end_; }
  const char* position() const { return next_; }

  /// Takes the fields of one record, which may hold line ends in quotes.
  std::vector<Field> take_record() {
    std::vector<Field> fields;
    while (true) {
      fields.push_back(take_field());
      if (next_ == end_) return fields;
      const char separator = *next_++;
      if (separator == '\r' && next_ != end_ && *next_ == '\n') ++next_;
      if (separator != ',') return fields;
    }
  }

  /// Takes one field and leaves what separates it.
  Field take_field() {
    Field field{{}, next_};
    if (next_ != end_ && *next_ == '"') {
      ++next_;
      while (next_ != end_) {
        const char c = *next_++;
        if (c != '"') {
          field.text += c;
        } else if (next_ != end_ && *next_ == '"') {
          field.text += *next_++;
        } else {
          break;
        }
      }
    }
    const char* const first = next_;
    while (next_ != end_ && *next_ != ',' && !text::is_line_end(*next_)) ++next_;
    field.text.append(first, next_);
    return field;
  }

  /// The text of a field without quotes, without a copy; null where there are some.
  std::optional<std::string_view> take_plain() {
    if (next_ != end_ && *next_ == '"') return std::nullopt;
    const char* first = next_;
    while (next_ != end_ && *next_ != ',' && !text::is_line_end(*next_)) ++next_;
    const char* last = next_;
    while (first != last && text::is_blank(*first)) ++first;
    while (last != first && text::is_blank(last[-1])) --last;
    return std::string_view(first, static_cast<std::size_t>(last - first));
  }

  bool take(char c) {
    const bool is_next = next_ != end_ && *next_ == c;
    next_ += is_next;
    return is_next;
  }
  bool take_line_end() {
    const bool had_return = take('\r');
    return take('\n') || had_return || next_ == end_;
  }

 private:
  const char* next_;
  const char* end_;
};

/// Some columns that belong to one component.
struct Group {
  ComponentKind kind = ComponentKind::Values;
  std::string content;
  std::vector<std::size_t> columns;
};

struct TableReader {
  const text::Source& source;
  const ReadOptions& options;
  Diagnostics& diagnostics;

  void error(const char* code, std::string message, const char* at) const {
    text::report(source, diagnostics, Severity::Error, code, std::move(message), at);
  }
};

/// The name and the channel of a column, "HEAD.q" or "HEAD".
std::pair<std::string, std::string> split_name(const std::string& header) {
  const std::size_t dot = header.rfind('.');
  const std::string channel = dot == std::string::npos ? "" : lowered(header.substr(dot + 1));
  const bool is_known = channel == "q" || std::find(kPoseChannels.begin(), kPoseChannels.end(),
                                                    channel) != kPoseChannels.end();
  if (!is_known) return {header, "q"};
  return {header.substr(0, dot), channel};
}

/// What the values of a column are: JointEffort3 is one of JointEffort, all else a joint's own.
std::string content_of(const std::string& name) {
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const bool is_content = digits < name.size() && digits > 5 && name.starts_with("Joint");
  return is_content ? name.substr(0, digits) : std::string(kJointDisplacement);
}

bool is_of_a_figure(const std::string& header) {
  const std::string lower = lowered(header);
  return lower.ends_with("position") || lower.ends_with("rotation") || lower.ends_with("scale");
}

Group& group_of(std::vector<Group>& groups, ComponentKind kind, const std::string& content) {
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
    return group.kind == kind && group.content == content;
  });
  if (found != groups.end()) return *found;
  groups.push_back({kind, content, {}});
  return groups.back();
}

/// Finds out what the columns are by the header. Empty after an error.
std::vector<Group> parse_header(const TableReader& reader, const std::vector<Field>& header) {
  std::vector<Group> groups;
  if (lowered(header[0].text) != "time" || header.size() < 2) {
    reader.error("CSV002",
                 fmt::format("expected a header of 'time' and names of columns, found {}",
                             text::quoted(header[0].text)),
                 header[0].at);
    return {};
  }
  for (std::size_t c = 1; c < header.size();) {
    const auto [name, channel] = split_name(header[c].text);
    if (is_of_a_figure(header[c].text)) {
      reader.error("CSV003",
                   fmt::format("expected columns of a robot's joints (NAME.q) or links (NAME.x to "
                               "NAME.qz), found {}: a figure's channels need its skeleton",
                               text::quoted(header[c].text)),
                   header[c].at);
      return {};
    }
    if (channel == "q") {
      group_of(groups, ComponentKind::Values, content_of(name)).columns.push_back(c);
      ++c;
      continue;
    }
    std::size_t count = 0;
    while (count < kPoseChannels.size() && c + count < header.size() &&
           split_name(header[c + count].text) ==
               std::pair(name, std::string(kPoseChannels[count]))) {
      ++count;
    }
    if (count != 3 && count != kPoseChannels.size()) {
      reader.error("CSV003",
                   fmt::format("expected {0}.x, {0}.y, {0}.z, and of a link {0}.qw to {0}.qz, in "
                               "this order, found {1} of them",
                               name, count),
                   header[c].at);
      return {};
    }
    const bool is_pose = count == kPoseChannels.size();
    Group& group = group_of(groups, is_pose ? ComponentKind::Poses : ComponentKind::Vectors,
                            is_pose ? std::string(kLinkPosition) : name);
    for (std::size_t k = 0; k < count; ++k) group.columns.push_back(c + k);
    c += count;
  }
  return groups;
}

/// Reads the rows; all numbers of a row side by side. False after an error.
bool parse_rows(const TableReader& reader, Fields& fields, std::size_t num_columns,
                std::vector<double>& values) {
  while (!fields.is_at_end()) {
    const char* const row = fields.position();
    if (fields.take_line_end()) continue;  // an empty line
    std::size_t count = 0;
    do {
      const char* const at = fields.position();
      const auto plain = fields.take_plain();
      const Field quoted_field = plain ? Field{} : fields.take_field();
      const std::string_view token = plain ? *plain : std::string_view(quoted_field.text);
      const auto number = text::parse_number(token);
      if (number.fault != text::NumberFault::None) {
        reader.error("CSV004",
                     fmt::format("expected a number, found {}",
                                 token.empty() ? "nothing" : text::quoted(token)),
                     at);
        return false;
      }
      values.push_back(number.value);
      ++count;
    } while (fields.take(','));
    if (count != num_columns) {
      reader.error("CSV005", fmt::format("expected {} fields, found {}", num_columns, count), row);
      return false;
    }
    fields.take_line_end();
  }
  return true;
}

/// The rate that times tell, or the times themselves where they are at no steady one.
std::optional<Timeline> timeline_of(const TableReader& reader, const std::vector<double>& times) {
  constexpr double kLoose = 1e-3;  // of a period: what a few digits leave of a time
  constexpr double kWhole = 1e-4;
  Timeline timeline;
  timeline.given = Timeline::Given::FrameRate;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::isfinite(times[i]) && (i == 0 || times[i] > times[i - 1])) continue;
    reader.error("CSV006",
                 fmt::format("expected times that go up, found {} s in row {}", times[i], i),
                 reader.source.text().data());
    return std::nullopt;
  }
  if (reader.options.fps || times.size() < 2) {
    timeline.value = reader.options.fps.value_or(30);
    if (!reader.options.fps) {
      text::report(reader.source, reader.diagnostics, Severity::Note, "CSV007",
                   "the table does not tell its rate; 30 frames a second are assumed (--fps says "
                   "otherwise)",
                   reader.source.text().data());
    }
    return timeline;
  }
  const double period = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  bool is_steady = true;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double expected = times.front() + static_cast<double>(i) * period;
    is_steady &= std::abs(times[i] - expected) <= kLoose * period;
  }
  if (!is_steady) {
    timeline.value = 0;
    timeline.times = times;
    return timeline;
  }
  const double rate = 1 / period;
  const double whole = std::round(rate);
  timeline.value = whole >= 1 && std::abs(rate - whole) <= kWhole * whole ? whole : rate;
  return timeline;
}

Component component_of(const Group& group, const Timeline& timeline, std::size_t num_columns,
                       const std::vector<double>& table) {
  Component component;
  component.kind = group.kind;
  component.content = group.content;
  component.num_parts = group.columns.size() / component.width();
  component.num_frames = table.size() / num_columns;
  component.timeline = timeline;
  component.values.reserve(component.num_frames * component.row_size());
  for (std::size_t f = 0; f < component.num_frames; ++f) {
    for (const std::size_t column : group.columns) {
      component.values.push_back(table[f * num_columns + column]);
    }
  }
  return component;
}

Result<Document> read_alone(std::string_view bytes, const ReadOptions& options,
                            Diagnostics& diagnostics) {
  auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded) return fail(std::move(decoded.error()));
  const text::Source source(options.source_name, decoded->view());
  const TableReader reader{source, options, diagnostics};
  Fields fields(source.text());
  const std::vector<Field> header = fields.take_record();
  const std::vector<Group> groups = parse_header(reader, header);
  std::vector<double> table;
  if (diagnostics.has_errors() || !parse_rows(reader, fields, header.size(), table)) {
    return fail(diagnostics.first_error());
  }
  std::vector<double> times;
  for (std::size_t i = 0; i < table.size(); i += header.size()) times.push_back(table[i]);
  const auto timeline = timeline_of(reader, times);
  if (!timeline) return fail(diagnostics.first_error());
  BodyMotion motion;
  for (const Group& group : groups) {
    motion.components.push_back(component_of(group, *timeline, header.size(), table));
  }
  Document document;
  document.format = "csv";
  document.extras.file["encoding"] = decoded->description();
  document.extras.file["line_end"] = text::line_end_of(source.text());
  document.content = std::move(motion);
  return document;
}

}  // namespace

Result<Document> read(std::string_view bytes, const ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

}  // namespace kinefile::csv
