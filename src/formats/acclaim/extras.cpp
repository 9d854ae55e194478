// SPDX-License-Identifier: MIT
#include "formats/acclaim/extras.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "formats/acclaim/lexer.hpp"
#include "text/numbers.hpp"

namespace kinefile::acclaim {
namespace {

using Words = std::map<std::string, std::string>;

void put(Words& words, const char* key, std::string value) {
  if (!value.empty()) words[key] = std::move(value);
}

std::string get(const Words& words, const char* key) {
  const auto found = words.find(key);
  return found == words.end() ? std::string() : found->second;
}

std::string text_of(const std::vector<DofWord>& dofs) {
  std::string text;
  for (const DofWord word : dofs) {
    if (!text.empty()) text += ' ';
    text += spelling(word);
  }
  return text;
}

std::string text_of(const std::array<double, 3>& numbers) {
  return fmt::format("{} {} {}", numbers[0], numbers[1], numbers[2]);
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  Lexer lexer(text);
  for (std::string_view word = lexer.take(); !word.empty(); word = lexer.take()) {
    const text::Number number = text::parse_number(word);
    if (number.fault != text::NumberFault::None) return numbers;
    numbers.push_back(number.value);
  }
  return numbers;
}

std::array<double, 3> vector_of(const std::string& text) {
  const std::vector<double> numbers = numbers_of(text);
  std::array<double, 3> vector{};
  std::copy_n(numbers.begin(), std::min<std::size_t>(numbers.size(), 3), vector.begin());
  return vector;
}

AxisOrder order_of(const std::string& text) {
  AxisOrder order = {0, 1, 2};
  for (std::size_t k = 0; k < 3 && k < text.size(); ++k) {
    order[k] = std::min<std::size_t>(std::string_view("XYZ").find(text[k]), 2);
  }
  return order;
}

std::vector<DofWord> dofs_of(const std::string& text) {
  std::vector<DofWord> dofs;
  Lexer lexer(text);
  for (std::string_view word = lexer.take(); !word.empty(); word = lexer.take()) {
    const auto found = std::find(kDofWords.begin(), kDofWords.end(), word);
    if (found != kDofWords.end()) dofs.push_back(static_cast<DofWord>(found - kDofWords.begin()));
  }
  return dofs;
}

Words words_of(const Bone& bone) {
  Words words;
  put(words, "id", bone.id);
  put(words, "direction", text_of(bone.direction));
  put(words, "length", fmt::format("{}", bone.length));
  put(words, "axis", text_of(bone.axis.angles));
  put(words, "axis_order", spelling(bone.axis.order));
  put(words, "dof", text_of(bone.dofs));
  std::string limits;
  for (const Limit& limit : bone.limits) {
    limits += fmt::format("{}{} {}", limits.empty() ? "" : " ", limit.low, limit.high);
  }
  put(words, "limits", limits);
  put(words, "bodymass", bone.body_mass);
  put(words, "cofmass", bone.cof_mass);
  put(words, "other", fmt::format("{}", fmt::join(bone.other_lines, "\n")));
  return words;
}

}  // namespace

Extras extras_of(const AsfFile& file) {
  Extras extras;
  Words& words = extras.file;
  put(words, "asf_comments", file.comments);
  put(words, "asf_version", file.version);
  if (file.mass) put(words, "unit_mass", fmt::format("{}", *file.mass));
  if (file.length) put(words, "unit_length", fmt::format("{}", *file.length));
  put(words, "unit_angle", file.angle == AngleUnit::Radians ? "rad" : "deg");
  put(words, "documentation", file.documentation);
  put(words, "skin", file.skin);
  put(words, "other_sections", file.other_sections);
  Words& root = extras.joints["root"];
  put(root, "order", text_of(file.root.order));
  put(root, "axis", spelling(file.root.orientation.order));
  put(root, "orientation", text_of(file.root.orientation.angles));
  for (const Bone& bone : file.bones) extras.joints[bone.name] = words_of(bone);
  return extras;
}

Bone bone_of_extras(const std::string& name, const Words& words) {
  Bone bone;
  bone.name = name;
  bone.id = get(words, "id");
  bone.direction = vector_of(get(words, "direction"));
  const std::vector<double> length = numbers_of(get(words, "length"));
  if (!length.empty()) bone.length = length[0];
  bone.axis = {vector_of(get(words, "axis")), order_of(get(words, "axis_order"))};
  bone.dofs = dofs_of(get(words, "dof"));
  const std::vector<double> limits = numbers_of(get(words, "limits"));
  for (std::size_t i = 0; i + 1 < limits.size(); i += 2) {
    bone.limits.push_back({limits[i], limits[i + 1]});
  }
  bone.body_mass = get(words, "bodymass");
  bone.cof_mass = get(words, "cofmass");
  const std::string other = get(words, "other");
  for (std::size_t begin = 0; !other.empty() && begin <= other.size();) {
    const std::size_t end = std::min(other.find('\n', begin), other.size());
    bone.other_lines.push_back(other.substr(begin, end - begin));
    begin = end + 1;
  }
  return bone;
}

AsfFile asf_of_extras(const Extras& extras) {
  AsfFile file;
  file.comments = get(extras.file, "asf_comments");
  file.version = get(extras.file, "asf_version");
  const std::vector<double> mass = numbers_of(get(extras.file, "unit_mass"));
  if (!mass.empty()) file.mass = mass[0];
  const std::vector<double> length = numbers_of(get(extras.file, "unit_length"));
  if (!length.empty()) file.length = length[0];
  const std::string angle = get(extras.file, "unit_angle");
  if (!angle.empty()) file.angle = angle == "rad" ? AngleUnit::Radians : AngleUnit::Degrees;
  file.documentation = get(extras.file, "documentation");
  file.skin = get(extras.file, "skin");
  file.other_sections = get(extras.file, "other_sections");
  const auto root = extras.joints.find("root");
  if (root == extras.joints.end()) return file;
  file.root.order = dofs_of(get(root->second, "order"));
  file.root.orientation = {vector_of(get(root->second, "orientation")),
                           order_of(get(root->second, "axis"))};
  return file;
}

}  // namespace kinefile::acclaim
