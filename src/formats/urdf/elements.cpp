// SPDX-License-Identifier: MIT
#include "formats/urdf/elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/urdf/codes.hpp"
#include "text/numbers.hpp"

namespace kinefile::urdf {
namespace {

using tinyxml2::XMLAttribute;
using tinyxml2::XMLElement;

/// How far into a line columns are searched, because a line may be the whole file.
constexpr std::ptrdiff_t kFarthestColumn = 1000;

/// The fault that tinyxml2 found, as text.
std::string_view fault_name(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "no element";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element that is not closed, or the end of another one";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute that is none";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements in too many others";
    default:
      return "something else";
  }
}

/// The words of a text, separated by blanks and line ends.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  constexpr std::string_view kSpace = " \t\n\r\v\f";
  for (std::size_t begin = text.find_first_not_of(kSpace); begin != std::string_view::npos;
       begin = text.find_first_not_of(kSpace)) {
    text.remove_prefix(begin);
    const std::size_t length = std::min(text.find_first_of(kSpace), text.size());
    words.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return words;
}

std::optional<double> number_or_infinity(std::string_view word) {
  const text::Number number = text::parse_number(word);
  const bool is_good = number.fault == text::NumberFault::None && !std::isnan(number.value);
  return is_good ? std::optional(number.value) : std::nullopt;
}

std::optional<double> finite_number(std::string_view word) {
  const auto number = number_or_infinity(word);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

}  // namespace

Elements::Elements(const text::Source& source, Diagnostics& diagnostics)
    : source_(source), diagnostics_(diagnostics), line_starts_{0} {
  const std::string_view text = source.text();
  for (std::size_t at = text.find('\n'); at != std::string_view::npos;
       at = text.find('\n', at + 1)) {
    line_starts_.push_back(at + 1);
  }
}

const XMLElement* Elements::read_root(const char* name) {
  // A zero ends the text for tinyxml2, which would silently ignore the rest.
  const std::size_t zero = source_.text().find('\0');
  if (zero != std::string_view::npos) {
    report(Severity::Error, {&source_, source_.text().data() + zero}, code::kNotUrdf,
           "expected XML, found a zero byte");
    return nullptr;
  }
  if (document_.Parse(source_.text().data(), source_.text().size()) != tinyxml2::XML_SUCCESS) {
    tell_fault();
    return nullptr;
  }
  const XMLElement* root = document_.RootElement();
  if (root != nullptr && root->Name() == std::string_view(name)) return root;
  const robot_file::Spot start{&source_, source_.text().data()};
  report(Severity::Error, root == nullptr ? start : spot(*root), code::kNotUrdf,
         fmt::format("expected the element <{}>, found {}", name,
                     root == nullptr ? "none" : fmt::format("<{}>", root->Name())));
  return nullptr;
}

void Elements::tell_fault() {
  report(Severity::Error, {&source_, start_of_line(document_.ErrorLineNum())}, code::kNotUrdf,
         fmt::format("expected XML, found {}", fault_name(document_.ErrorID())));
}

const char* Elements::start_of_line(int line) const {
  const auto index = static_cast<std::size_t>(std::max(line, 1)) - 1;
  return source_.text().data() + line_starts_[std::min(index, line_starts_.size() - 1)];
}

robot_file::Spot Elements::find_in_line(int line, const std::string& word) const {
  const char* begin = start_of_line(line);
  const auto rest = std::min(source_.end() - begin, kFarthestColumn);
  const char* end = std::find(begin, begin + rest, '\n');
  const char* found = std::search(begin, end, word.begin(), word.end());
  return {&source_, found == end ? begin : found};
}

robot_file::Spot Elements::spot(const XMLElement& element) const {
  return find_in_line(element.GetLineNum(), std::string("<") + element.Name());
}

robot_file::Spot Elements::spot(const XMLElement& element, const XMLAttribute& attribute) const {
  const robot_file::Spot in_line = find_in_line(attribute.GetLineNum(), attribute.Name());
  const robot_file::Spot start = spot(element);
  if (attribute.GetLineNum() != element.GetLineNum()) return in_line;
  // After the element's own start, which may look the same.
  const std::string_view rest(
      start.at, static_cast<std::size_t>(std::min(source_.end() - start.at, kFarthestColumn)));
  const std::size_t at = rest.substr(0, rest.find('\n')).find(std::string(" ") + attribute.Name());
  return at == std::string_view::npos ? in_line : robot_file::Spot{&source_, start.at + at + 1};
}

std::optional<std::string> Elements::word(const XMLElement& element, const char* attribute) {
  const char* value = element.Attribute(attribute);
  if (value != nullptr && *value != '\0') return value;
  report(Severity::Error, spot(element), code::kMissing,
         fmt::format("expected the attribute {} of <{}>, found none", attribute, element.Name()));
  return std::nullopt;
}

std::optional<double> Elements::limit(const XMLElement& element, const char* attribute,
                                      double fallback) {
  return read_number(element, attribute, fallback, number_or_infinity, "a number");
}

std::optional<double> Elements::number(const XMLElement& element, const char* attribute,
                                       double fallback) {
  return read_number(element, attribute, fallback, finite_number, "a finite number");
}

std::optional<double> Elements::read_number(const XMLElement& element, const char* attribute,
                                            double fallback,
                                            std::optional<double> (*read)(std::string_view),
                                            std::string_view expected) {
  const XMLAttribute* found = element.FindAttribute(attribute);
  if (found == nullptr) return fallback;
  const auto words = words_of(found->Value());
  const auto number = words.size() == 1 ? read(words[0]) : std::nullopt;
  if (!number) {
    report(Severity::Error, spot(element, *found), code::kBadValue,
           fmt::format("expected {} as {}, found {}", expected, attribute,
                       text::quoted(found->Value())));
  }
  return number;
}

std::vector<double> Elements::finite_numbers(const XMLAttribute& attribute) const {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(attribute.Value())) {
    const auto number = finite_number(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<Vec3> Elements::vector(const XMLElement& element, const char* attribute,
                                     const Vec3& fallback) {
  const XMLAttribute* found = element.FindAttribute(attribute);
  if (found == nullptr) return fallback;
  const auto numbers = finite_numbers(*found);
  if (numbers.size() == 3) return Vec3(numbers.data());
  report(Severity::Error, spot(element, *found), code::kBadValue,
         fmt::format("expected three finite numbers as {}, found {}", attribute,
                     text::quoted(found->Value())));
  return std::nullopt;
}

std::optional<Quat> Elements::quaternion(const XMLElement& element, const char* attribute) {
  const XMLAttribute* found = element.FindAttribute(attribute);
  if (found == nullptr) return Quat::Identity();
  const auto q = finite_numbers(*found);
  const bool is_zero = std::all_of(q.begin(), q.end(), [](double number) { return number == 0; });
  if (q.size() == 4 && !is_zero) return unit_quaternion({q[3], q[0], q[1], q[2]});
  report(Severity::Error, spot(element, *found), code::kBadValue,
         fmt::format("expected four finite numbers, not all 0, as {}, found {}", attribute,
                     text::quoted(found->Value())));
  return std::nullopt;
}

}  // namespace kinefile::urdf
