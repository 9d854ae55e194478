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
/// those that are whatever the case, where no other joint differs from them by case alone; where
/// there is none, the joints of which this is so of `Joint::joint_name`.
class JointNames {
 public:
  explicit JointNames(const Skeleton& skeleton);

  /// The joints of a name, in skeleton order; none if there is no such joint.
  const std::vector<std::size_t>& find(std::string_view name) const;

  /// The joints of a name in which `*` stands for any characters, in skeleton order.
  std::vector<std::size_t> matching(std::string_view pattern) const;

  /// The same, whatever `joint_name` says.
  const std::vector<std::size_t>& find_name(std::string_view name) const;

  /// Whether no two joints have this name in different cases.
  bool has_one_spelling(std::string_view name) const;

 private:
  /// The joints by one of their names.
  struct Index {
    std::vector<std::string> names = {};                         ///< by joint; empty for none
    std::map<std::string, std::vector<std::size_t>> exact = {};  ///< by name
    std::map<std::string, std::vector<std::size_t>> lower = {};  ///< by name in lower case

    void add(std::size_t joint, const std::string& name);
    bool has_one_spelling(std::string_view name) const;
    const std::vector<std::size_t>& find(std::string_view name) const;
    std::vector<std::size_t> matching(std::string_view pattern) const;
  };

  Index names_;
  Index joint_names_;
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
