// SPDX-License-Identifier: MIT
#include "text/yaml/number_rows.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel.hpp"
#include "text/numbers.hpp"
#include "text/row_template.hpp"

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

/// The bracket of the row in a line, if a hyphen and blanks are all that stands before it.
const char* row_in_line(const char* line, const char* end) {
  const char* const hyphen = std::find_if_not(line, end, is_blank);
  if (hyphen == end || *hyphen != '-') return nullptr;
  const char* const bracket = std::find_if_not(hyphen + 1, end, is_blank);
  return bracket != end && *bracket == '[' ? bracket : nullptr;
}

/// The bracket of the row in the next line, if no more than a line end stands before that.
const char* next_row(const char* p, const char* end) {
  p += p != end && *p == '\r';
  return p != end && *p == '\n' ? row_in_line(p + 1, end) : nullptr;
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

bool NumberRows::take(Cursor& cursor, bool is_in_flow, std::size_t& shape, std::size_t& num_rows) {
  if (num_popped_ == values_.size()) {
    values_.clear();
    num_popped_ = 0;
  }
  const char* const begin = cursor.position();
  if (simd::kReadsTemplateRows && !is_in_flow && like_.next == begin &&
      take_like_rows(cursor, shape, num_rows)) {
    return true;
  }
  num_rows = 1;
  const std::size_t num_before = values_.size();
  const char* const end = read_groups(begin, cursor.end());
  if (end != nullptr && is_alone(end, cursor.end(), is_in_flow)) {
    const MoreLines lines = has_break_ ? more_lines(cursor.position(), end) : MoreLines{};
    shape = index_of_shape();
    if (shape < kMostShapes && !lines.may_be_indented_by_tabs) {
      cursor.jump(end, lines.count, lines.last);
      if (simd::kReadsTemplateRows && !is_in_flow && !has_break_)
        learn_row(begin, end, cursor.end(), shape);
      return true;
    }
  }
  values_.resize(num_before);
  return false;
}

/// Learns from a row what the next ones may be like.
void NumberRows::learn_row(const char* begin, const char* row_end, const char* end,
                           std::size_t shape) {
  if (!attempts_.is_due()) return;
  attempts_.made(false);
  const char* const next = next_row(row_end, end);
  if (next == nullptr) return;
  auto row = template_of_row({begin, static_cast<std::size_t>(next - begin)}, num_values_[shape]);
  if (!row || row->num_columns() == 0) return;
  const auto tail = static_cast<std::size_t>(next - row_end);
  like_ = {template_row_reader(*row), tail, tail - (*row_end == '\r' ? 2 : 1), shape, next};
  like_.reader.row_in_line = row_in_line;
}

/// Takes rows that are like one before them, many at once; whether there are any.
bool NumberRows::take_like_rows(Cursor& cursor, std::size_t& shape, std::size_t& num_rows) {
  constexpr std::size_t kSomeNumbers = std::size_t{1} << 14;
  const std::size_t num_columns = like_.reader.num_columns;
  const std::size_t most = kSomeNumbers / num_columns + 1;
  const std::size_t num_before = values_.size();
  begins_.resize(most);
  double* const out = values_.grow(most * num_columns).data();
  const simd::NumberRows read =
      like_.reader.read(cursor.position(), cursor.end(), most, out, begins_.data());
  values_.resize(num_before + read.num_rows * num_columns);
  begins_.resize(read.num_rows);
  like_.next = nullptr;
  if (read.num_rows == 0) return false;
  attempts_.made(true);
  const char* next = read.next;
  if (read.num_rows == most) next = like_.next = take_more_rows(next, cursor.end());
  num_rows = begins_.size();
  cursor.jump(next - like_.tail, num_rows - 1, begins_.back() - like_.indent);
  begins_.push_back(next);
  shape = last_shape_ = like_.shape;
  return true;
}

/// Takes more of such rows, on all cores; returns the place behind them.
const char* NumberRows::take_more_rows(const char* begin, const char* end) {
  constexpr std::ptrdiff_t kMostBytes = std::ptrdiff_t{1} << 23;  // they are held once more
  if (free_threads() == 1) return begin;
  return read_row_pieces(begin, begin + std::min(end - begin, kMostBytes), like_.reader,
                         [this](const RowPiece& piece) {
                           values_.append(piece.values);
                           begins_.insert(begins_.end(), piece.starts.begin(), piece.starts.end());
                           return true;
                         });
}

std::span<const double> NumberRows::pop(std::size_t shape, std::size_t num_rows) {
  const std::span<const double> rows(values_.data() + num_popped_, num_rows * num_values_[shape]);
  num_popped_ += rows.size();
  return rows;
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
