// SPDX-License-Identifier: MIT
#include "formats/urdf/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/urdf/codes.hpp"
#include "text/numbers.hpp"

namespace kinefile::urdf {
namespace {

using text::xml::Attribute;
using text::xml::Element;

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

/// Reads an attribute that is one number.
/// \param read      reads the number
/// \param expected  what it is, for a message
std::optional<double> read_number(Values& values, const Element& element, std::string_view name,
                                  std::optional<double> fallback,
                                  std::optional<double> (*read)(std::string_view),
                                  std::string_view expected) {
  const Attribute* found = text::xml::find_attribute(element, name);
  if (found == nullptr && fallback) return fallback;
  if (found == nullptr) {
    values.report_fault(
        values.spot(element), code::kMissing,
        fmt::format("expected the attribute {} of <{}>, found none", name, element.name));
    return std::nullopt;
  }
  const auto words = words_of(found->value);
  const auto number = words.size() == 1 ? read(words[0]) : std::nullopt;
  if (!number) {
    values.report_fault(
        values.spot(*found), code::kBadValue,
        fmt::format("expected {} as {}, found {}", expected, name, text::quoted(found->value)));
  }
  return number;
}

/// Roll, pitch and yaw: about the fixed axes x, y and z, in this order.
Quat rotation_of(const Vec3& rpy) {
  const Quat roll = robot_file::rotation_about(Vec3::UnitX(), rpy.x());
  const Quat pitch = robot_file::rotation_about(Vec3::UnitY(), rpy.y());
  const Quat yaw = robot_file::rotation_about(Vec3::UnitZ(), rpy.z());
  return (yaw * pitch * roll).normalized();
}

std::optional<Quat> read_rotation(Values& values, const Element& origin, bool knows_quaternions) {
  constexpr std::string_view kQuaternion = "quat_xyzw";
  const Attribute* quaternion = text::xml::find_attribute(origin, kQuaternion);
  if (quaternion != nullptr && !knows_quaternions) {
    values.warn(values.spot(*quaternion), code::kQuaternion,
                "quat_xyzw is ignored: it needs version=\"1.1\" in <robot> (as in urdfdom)");
  } else if (quaternion != nullptr && text::xml::find_attribute(origin, "rpy") != nullptr) {
    values.report_fault(values.spot(origin), code::kQuaternion,
                        "expected either rpy or quat_xyzw, found both");
    return std::nullopt;
  } else if (quaternion != nullptr) {
    return values.quaternion(origin, kQuaternion);
  }
  const auto rpy = values.vector(origin, "rpy", Vec3(Vec3::Zero()));
  return rpy ? std::optional(rotation_of(*rpy)) : std::nullopt;
}

}  // namespace

std::unique_ptr<text::xml::Tree> read_elements(const text::Source& source, const char* name,
                                               Diagnostics& diagnostics) {
  text::xml::Fault fault;
  auto tree = text::xml::read_tree(source.text(), fault);
  if (!tree) {
    text::report(source, diagnostics, Severity::Error, code::kNotUrdf, std::move(fault.message),
                 fault.at);
    return nullptr;
  }
  if (tree->root().name == name) return tree;
  text::report(source, diagnostics, Severity::Error, code::kNotUrdf,
               fmt::format("expected the element <{}>, found <{}>", name, tree->root().name),
               tree->root().at);
  return nullptr;
}

void Values::report_fault(const robot_file::Spot& place, const char* code, std::string message) {
  if (is_of_shape) {
    warn(place, code::kLeftOutShape, message + "; the shape is left out");
  } else {
    place.report(diagnostics, Severity::Error, code, std::move(message));
  }
}

std::optional<std::string> Values::word(const Element& element, std::string_view name) {
  const Attribute* found = text::xml::find_attribute(element, name);
  if (found != nullptr && !found->value.empty()) return found->value;
  report_fault(spot(element), code::kMissing,
               fmt::format("expected the attribute {} of <{}>, found none", name, element.name));
  return std::nullopt;
}

std::optional<double> Values::limit(const Element& element, std::string_view name,
                                    double fallback) {
  return read_number(*this, element, name, fallback, number_or_infinity, "a number");
}

std::optional<double> Values::number(const Element& element, std::string_view name,
                                     std::optional<double> fallback) {
  return read_number(*this, element, name, fallback, finite_number, "a finite number");
}

std::vector<double> finite_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(text)) {
    const auto number = finite_number(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<Vec3> Values::vector(const Element& element, std::string_view name,
                                   const std::optional<Vec3>& fallback) {
  const Attribute* found = text::xml::find_attribute(element, name);
  if (found == nullptr && fallback) return fallback;
  if (found != nullptr) {
    const auto numbers = finite_numbers(found->value);
    if (numbers.size() == 3) return Vec3(numbers.data());
  }
  report_fault(found == nullptr ? spot(element) : spot(*found), code::kBadValue,
               fmt::format("expected three finite numbers as {}, found {}", name,
                           found == nullptr ? "none" : text::quoted(found->value)));
  return std::nullopt;
}

std::optional<Quat> Values::quaternion(const Element& element, std::string_view name) {
  const Attribute* found = text::xml::find_attribute(element, name);
  if (found == nullptr) return Quat::Identity();
  const auto q = finite_numbers(found->value);
  const bool is_zero = std::all_of(q.begin(), q.end(), [](double number) { return number == 0; });
  if (q.size() == 4 && !is_zero) return unit_quaternion({q[3], q[0], q[1], q[2]});
  report_fault(spot(*found), code::kBadValue,
               fmt::format("expected four finite numbers, not all 0, as {}, found {}", name,
                           text::quoted(found->value)));
  return std::nullopt;
}

std::optional<Origin> read_origin(Values& values, const Element& origin, bool knows_quaternions) {
  const auto translation = values.vector(origin, "xyz", Vec3(Vec3::Zero()));
  const auto rotation = read_rotation(values, origin, knows_quaternions);
  if (!translation || !rotation) return std::nullopt;
  return Origin{*translation, *rotation};
}

}  // namespace kinefile::urdf
