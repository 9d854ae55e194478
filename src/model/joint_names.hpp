// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/skeleton.hpp"

namespace kinefile {

/// Finds the joints of a skeleton by name. A name matches the joints with exactly this name;
/// otherwise those that differ only in case, if no two joints differ by case alone; otherwise the
/// same search is done with `Joint::joint_name`.
class JointNames {
 public:
  explicit JointNames(const Skeleton& skeleton);

  /// The joints that match a name, in skeleton order; empty if there are none.
  const std::vector<std::size_t>& find(std::string_view name) const;

  /// The joints that match a pattern in which `*` stands for any characters, in skeleton order.
  std::vector<std::size_t> matching(std::string_view pattern) const;

  /// The same, without `joint_name`.
  const std::vector<std::size_t>& find_name(std::string_view name) const;

  /// Whether no two joints have this name with different case.
  bool has_one_spelling(std::string_view name) const;

 private:
  /// An index of joints by one kind of name.
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
