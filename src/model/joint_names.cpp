// SPDX-License-Identifier: MIT
#include "model/joint_names.hpp"

#include <algorithm>

#include "base/words.hpp"

namespace kinefile {
namespace {

/// Whether a text matches a pattern, in which `*` stands for any characters.
bool has_form(std::string_view text, std::string_view pattern) {
  std::size_t t = 0;
  std::size_t p = 0;
  std::size_t star = std::string_view::npos;  // the last `*`, and where its text begins
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
    names_.add(j, skeleton.joints[j].name);
    const std::string& joint_name = skeleton.joints[j].joint_name;
    if (!joint_name.empty()) joint_names_.add(j, joint_name);
  }
}

void JointNames::Index::add(std::size_t joint, const std::string& name) {
  names.resize(joint + 1);
  names[joint] = name;
  exact[name].push_back(joint);
  lower[lowered(name)].push_back(joint);
}

bool JointNames::Index::has_one_spelling(std::string_view name) const {
  const auto found = lower.find(lowered(name));
  return found == lower.end() ||
         std::all_of(found->second.begin(), found->second.end(), [&](std::size_t joint) {
           return names[joint] == names[found->second.front()];
         });
}

const std::vector<std::size_t>& JointNames::Index::find(std::string_view name) const {
  static const std::vector<std::size_t> kNone;
  if (const auto same = exact.find(std::string(name)); same != exact.end()) return same->second;
  const auto alike = lower.find(lowered(name));
  return alike != lower.end() && has_one_spelling(name) ? alike->second : kNone;
}

std::vector<std::size_t> JointNames::Index::matching(std::string_view pattern) const {
  if (pattern.find('*') == std::string_view::npos) return find(pattern);
  const std::string lower_pattern = lowered(pattern);
  std::vector<std::size_t> joints;
  for (const auto& [name, own] : exact) {
    const bool is_match = has_form(name, pattern) ||
                          (has_form(lowered(name), lower_pattern) && has_one_spelling(name));
    if (is_match) joints.insert(joints.end(), own.begin(), own.end());
  }
  std::sort(joints.begin(), joints.end());
  return joints;
}

bool JointNames::has_one_spelling(std::string_view name) const {
  return names_.has_one_spelling(name);
}

const std::vector<std::size_t>& JointNames::find_name(std::string_view name) const {
  return names_.find(name);
}

const std::vector<std::size_t>& JointNames::find(std::string_view name) const {
  const std::vector<std::size_t>& found = names_.find(name);
  return found.empty() ? joint_names_.find(name) : found;
}

std::vector<std::size_t> JointNames::matching(std::string_view pattern) const {
  std::vector<std::size_t> joints = names_.matching(pattern);
  return joints.empty() ? joint_names_.matching(pattern) : joints;
}

std::vector<JointPair> match_joints(const Skeleton& first, const Skeleton& second) {
  const JointNames first_names(first);
  const JointNames second_names(second);
  std::vector<std::size_t> num_taken(second.joints.size(), 0);  // per name, at the index of its
                                                                // first joint
  std::vector<JointPair> pairs;
  for (std::size_t j = 0; j < first.joints.size(); ++j) {
    const std::string& name = first.joints[j].name;
    const std::vector<std::size_t>& others = second_names.find_name(name);
    if (others.empty()) continue;
    const bool is_spelled_alike = second.joints[others.front()].name == name;
    if (!is_spelled_alike && !first_names.has_one_spelling(name)) continue;
    std::size_t& taken = num_taken[others.front()];
    if (taken < others.size()) pairs.push_back({j, others[taken++]});
  }
  return pairs;
}

}  // namespace kinefile
