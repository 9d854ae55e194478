// SPDX-License-Identifier: MIT
#include "text/yaml/number_rows.hpp"

#include <algorithm>

#include "text/numbers.hpp"

namespace kinefile::text::yaml {
namespace {

/// The largest number of different shapes; a text with more is read like any other.
constexpr std::size_t kMostShapes = 64;

// A form feed is not a space here: YAML does not allow it.
bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_space(char c) { return is_blank(c) || is_line_end(c); }

const char* skip_space(const char* p, const char* end) {
  while (p != end && is_space(*p)) ++p;
  return p;
}

/// As the other; also reports whether it passed a line end.
const char* skip_space(const char* p, const char* end, bool& has_break) {
  for (; p != end && is_space(*p); ++p) has_break |= is_line_end(*p);
  return p;
}

/// Whether the row is alone: the next entry or the end follows.
bool is_alone(const char* p, const char* end, bool is_in_flow) {
  if (is_in_flow) {
    p = skip_space(p, end);
    return p != end && (*p == ',' || *p == ']');
  }
  const char* const behind = p;
  while (p != end && is_blank(*p)) ++p;
  return p == end || is_line_end(*p) || (*p == '#' && p != behind);
}

/// The lines of a row after its first.
struct MoreLines {
  std::size_t count = 0;
  const char* last = nullptr;
  bool may_be_indented_by_tabs = false;
};

MoreLines more_lines(const char* begin, const char* end) {
  MoreLines lines;
  for (const char* p = begin; p != end; ++p) {
    lines.may_be_indented_by_tabs |= *p == '\t';
    if (!is_line_end(*p) || (*p == '\r' && p[1] == '\n')) continue;
    ++lines.count;
    lines.last = p + 1;
  }
  return lines;
}

}  // namespace

bool NumberRows::take(Cursor& cursor, bool is_in_flow, std::size_t& shape) {
  if (num_popped_ == values_.size()) {
    values_.clear();
    num_popped_ = 0;
  }
  const std::size_t num_before = values_.size();
  const char* const end = read_groups(cursor.position(), cursor.end());
  if (end != nullptr && is_alone(end, cursor.end(), is_in_flow)) {
    const MoreLines lines = has_break_ ? more_lines(cursor.position(), end) : MoreLines{};
    shape = index_of_shape();
    if (shape < kMostShapes && !lines.may_be_indented_by_tabs) {
      cursor.jump(end, lines.count, lines.last);
      return true;
    }
  }
  values_.resize(num_before);
  return false;
}

std::span<const double> NumberRows::pop(std::size_t shape) {
  const std::span<const double> row(values_.data() + num_popped_, num_values_[shape]);
  num_popped_ += row.size();
  return row;
}

/// Reads a row from its bracket on, and its shape; returns the place after its end, or null.
const char* NumberRows::read_groups(const char* p, const char* end) {
  current_.clear();
  has_break_ = false;
  bool has_comma = true;
  for (p = skip_space(p + 1, end, has_break_); p != end && *p != ']';
       p = skip_space(p, end, has_break_)) {
    if (!has_comma) return nullptr;
    const NumberList list =
        read_number_list(*p == '[' ? skip_space(p + 1, end, has_break_) : p, end, values_);
    has_break_ |= list.has_break;
    if (list.next == end || list.count > 0x7FFFFFFF) return nullptr;
    const auto count = static_cast<std::int32_t>(list.count);
    if (*p == '[') {
      if (*list.next != ']') return nullptr;
      current_.push_back(count == 0 ? kEmptyGroup : -count);
      p = skip_space(list.next + 1, end, has_break_);
      has_comma = p != end && *p == ',';
      if (has_comma) ++p;
    } else {
      if (count == 0) return nullptr;
      current_.push_back(count);
      p = list.next;
      has_comma = list.ends_with_comma;
    }
  }
  return p == end ? nullptr : p + 1;
}

/// The index of the shape that was read last, or `kMostShapes` if there are too many.
std::size_t NumberRows::index_of_shape() {
  if (last_shape_ < shapes_.size() && shapes_[last_shape_] == current_) return last_shape_;
  last_shape_ = static_cast<std::size_t>(std::find(shapes_.begin(), shapes_.end(), current_) -
                                         shapes_.begin());
  if (last_shape_ < shapes_.size() || last_shape_ == kMostShapes) return last_shape_;
  shapes_.push_back(current_);
  std::size_t num_values = 0;
  for (const std::int32_t group : current_) {
    if (group != kEmptyGroup) num_values += static_cast<std::size_t>(group < 0 ? -group : group);
  }
  num_values_.push_back(num_values);
  return last_shape_;
}

}  // namespace kinefile::text::yaml
