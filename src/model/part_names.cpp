// SPDX-License-Identifier: MIT
#include "model/part_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace kinefile {
namespace {

constexpr std::array<std::string_view, 6> kUsualContents = {"JointVelocity", "JointAcceleration",
                                                            "JointEffort",   "JointTorque",
                                                            "JointForce",    "JointTemperature"};

bool is_usual(std::string_view content) {
  return std::find(kUsualContents.begin(), kUsualContents.end(), content) != kUsualContents.end();
}

/// The text before the digits at the end.
std::string_view before_digits(std::string_view text) {
  return text.substr(0, text.find_last_not_of("0123456789") + 1);
}

}  // namespace

std::string numbered_part(std::string_view content, std::size_t part) {
  return is_usual(content) ? fmt::format("{}{}", content, part)
                           : fmt::format("{}[{}]", content, part);
}

std::optional<std::string> content_of_numbered_part(std::string_view name) {
  const bool has_bracket = name.ends_with(']');
  if (has_bracket) name.remove_suffix(1);
  std::string_view content = before_digits(name);
  const bool has_digits = content.size() < name.size();
  if (has_bracket && has_digits && content.ends_with('[')) {
    content.remove_suffix(1);
    return std::string(content);
  }
  if (has_bracket || !has_digits || !is_usual(content)) return std::nullopt;
  return std::string(content);
}

}  // namespace kinefile
