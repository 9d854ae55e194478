// SPDX-License-Identifier: MIT
#include "model/joint_names.hpp"

#include <algorithm>

#include "base/words.hpp"

namespace kinefile {
namespace {

/// Whether a text has a pattern's form, in which `*` stands for any characters.
bool has_form(std::string_view text, std::string_view pattern) {
  std::size_t t = 0;
  std::size_t p = 0;
  std::size_t star = std::string_view::npos;  // the last one met, and where its text began
  std::size_t start = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      start = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++start;
    } else {
      return false;
    }
  }
  return pattern.substr(p).find_first_not_of('*') == std::string_view::npos;
}

}  // namespace

JointNames::JointNames(const Skeleton& skeleton) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    names_.push_back(skeleton.joints[j].name);
    exact_[names_[j]].push_back(j);
    lower_[lowered(names_[j])].push_back(j);
  }
}

bool JointNames::has_one_spelling(std::string_view name) const {
  const auto found = lower_.find(lowered(name));
  return found == lower_.end() ||
         std::all_of(found->second.begin(), found->second.end(), [&](std::size_t joint) {
           return names_[joint] == names_[found->second.front()];
         });
}

const std::vector<std::size_t>& JointNames::find(std::string_view name) const {
  static const std::vector<std::size_t> kNone;
  if (const auto exact = exact_.find(std::string(name)); exact != exact_.end()) {
    return exact->second;
  }
  const auto lower = lower_.find(lowered(name));
  return lower != lower_.end() && has_one_spelling(name) ? lower->second : kNone;
}

std::vector<std::size_t> JointNames::matching(std::string_view pattern) const {
  if (pattern.find('*') == std::string_view::npos) return find(pattern);
  const std::string lower = lowered(pattern);
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < names_.size(); ++j) {
    const bool is_match = has_form(names_[j], pattern) ||
                          (has_form(lowered(names_[j]), lower) && has_one_spelling(names_[j]));
    if (is_match) joints.push_back(j);
  }
  return joints;
}

std::vector<JointPair> match_joints(const Skeleton& first, const Skeleton& second) {
  const JointNames first_names(first);
  const JointNames second_names(second);
  std::vector<std::size_t> num_taken(second.joints.size(), 0);  // of a name, by its first joint
  std::vector<JointPair> pairs;
  for (std::size_t j = 0; j < first.joints.size(); ++j) {
    const std::string& name = first.joints[j].name;
    const std::vector<std::size_t>& others = second_names.find(name);
    if (others.empty()) continue;
    const bool is_spelled_alike = second.joints[others.front()].name == name;
    if (!is_spelled_alike && !first_names.has_one_spelling(name)) continue;
    std::size_t& taken = num_taken[others.front()];
    if (taken < others.size()) pairs.push_back({j, others[taken++]});
  }
  return pairs;
}

}  // namespace kinefile
