// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/skeleton.hpp"

namespace kinefile {

/// Finds the joints of a skeleton by name. A name means the joints that are spelled like it, else
/// those that are whatever the case, where no other joint differs from them by case alone.
class JointNames {
 public:
  explicit JointNames(const Skeleton& skeleton);

  /// The joints of a name, in skeleton order; none if there is no such joint.
  const std::vector<std::size_t>& find(std::string_view name) const;

  /// The joints of a name in which `*` stands for any characters, in skeleton order.
  std::vector<std::size_t> matching(std::string_view pattern) const;

  /// Whether no two joints have this name in different cases.
  bool has_one_spelling(std::string_view name) const;

 private:
  std::vector<std::string> names_;                         ///< shape (joints)
  std::map<std::string, std::vector<std::size_t>> exact_;  ///< by name
  std::map<std::string, std::vector<std::size_t>> lower_;  ///< by name in lower case
};

/// A joint of one skeleton and that of another by the same name.
struct JointPair {
  std::size_t first = 0;
  std::size_t second = 0;
};

/// The joints of two skeletons that have the same name (see `JointNames`), repeated names in their
/// order; each joint once at most, in order of the first skeleton.
std::vector<JointPair> match_joints(const Skeleton& first, const Skeleton& second);

}  // namespace kinefile
