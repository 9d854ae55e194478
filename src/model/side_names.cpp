// SPDX-License-Identifier: MIT
#include "model/side_names.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

namespace kinefile {
namespace {

struct SidePair {
  std::string_view left;
  std::string_view right;
};

constexpr std::array<SidePair, 4> kWords = {
    {{"Left", "Right"}, {"left", "right"}, {"LEFT", "RIGHT"}, {"左", "右"}}};

/// A name in which every word of one side is replaced by that of the other side.
std::string with_words_swapped(std::string_view name) {
  std::string swapped;
  while (!name.empty()) {
    std::size_t length = 1;
    std::string_view word = name.substr(0, 1);
    for (const SidePair& pair : kWords) {
      const bool is_left = name.starts_with(pair.left);
      if (!is_left && !name.starts_with(pair.right)) continue;
      length = is_left ? pair.left.size() : pair.right.size();
      word = is_left ? pair.right : pair.left;
      break;
    }
    swapped += word;
    name.remove_prefix(length);
  }
  return swapped;
}

/// The letter of the other side, or 0 if the letter stands for no side.
char other_side(char letter) {
  constexpr std::string_view kSides = "lrLR";
  const std::size_t side = kSides.find(letter);
  return side == std::string_view::npos ? '\0' : kSides[side ^ 1];
}

bool is_word_letter(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
}

/// Candidate names of a joint's partner, the most certain first.
std::vector<std::string> names_of_other_half(const std::string& name) {
  std::vector<std::string> names;
  if (std::string swapped = with_words_swapped(name); swapped != name) names.push_back(swapped);
  constexpr std::size_t kLongest = 256;  // every letter of a longer one would make a candidate
  if (name.size() > kLongest) return names;
  std::vector<std::string> ends;  // a letter that is not a separate word is less certain
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char other = other_side(name[i]);
    const bool is_start = i == 0 || !is_word_letter(name[i - 1]);
    const bool is_end = i + 1 == name.size() || !is_word_letter(name[i + 1]);
    if (other == '\0' || (!is_start && !is_end)) continue;
    std::string swapped = name;
    swapped[i] = other;
    (is_start && is_end ? names : ends).push_back(std::move(swapped));
  }
  names.insert(names.end(), ends.begin(), ends.end());
  return names;
}

}  // namespace

std::vector<std::size_t> depths_of(const Skeleton& skeleton) {
  std::vector<std::size_t> depths;
  for (const Joint& joint : skeleton.joints) {
    depths.push_back(joint.parent == kNoParent ? 0 : depths[joint.parent] + 1);
  }
  return depths;
}

std::vector<std::size_t> pairs_by_name(const Skeleton& skeleton) {
  const auto depths = depths_of(skeleton);
  std::map<std::string, std::vector<std::size_t>> joints_of_name;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    joints_of_name[skeleton.joints[j].name].push_back(j);
  }
  std::vector<std::size_t> pairs(skeleton.joints.size(), kNoParent);
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    if (pairs[j] != kNoParent) continue;
    for (const std::string& name : names_of_other_half(skeleton.joints[j].name)) {
      const auto others = joints_of_name.find(name);
      if (others == joints_of_name.end()) continue;
      for (const std::size_t other : others->second) {
        if (pairs[j] != kNoParent || pairs[other] != kNoParent || depths[other] != depths[j]) {
          continue;
        }
        pairs[j] = other;
        pairs[other] = j;
      }
    }
  }
  return pairs;
}

bool is_left_of(const std::string& name, const std::string& partner) {
  constexpr std::array<std::string_view, 3> kLefts = {"l", "L", "左"};
  const auto apart = std::mismatch(name.begin(), name.end(), partner.begin(), partner.end());
  std::string_view rest(name);
  rest.remove_prefix(static_cast<std::size_t>(apart.first - name.begin()));
  // The bytes of the two characters may begin alike.
  while (!rest.empty() && (static_cast<unsigned char>(rest.front()) & 0xC0) == 0x80) {
    rest = std::string_view(rest.data() - 1, rest.size() + 1);
  }
  return std::any_of(kLefts.begin(), kLefts.end(),
                     [rest](std::string_view left) { return rest.starts_with(left); });
}

bool has_side(const std::string& name) { return with_words_swapped(name) != name; }

}  // namespace kinefile
