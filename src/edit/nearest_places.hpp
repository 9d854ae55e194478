// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "edit/mirror_pairs.hpp"

namespace kinefile::edit {

/// Finds the joint that is nearest to a place, also when many are at one place: a k-d tree
/// (Bentley, Multidimensional binary search trees, 1975) over the places of joints and of their
/// ends.
class NearestPlaces {
 public:
  /// \param members  the joints that can be found; those whose places are not finite cannot
  NearestPlaces(const JointPlaces& places, const std::vector<std::size_t>& members);

  /// The joint with the least distance from a place plus a share of the distance of its end from
  /// another one; of equals the first. kNoParent if none is within `distance`.
  /// \param excluded  a joint that is not found
  std::size_t nearest(const Vec3& place, const Vec3& end, double distance,
                      std::size_t excluded) const;

  /// Finds a joint no more.
  void remove(std::size_t joint);

 private:
  /// Members `first` to `last`, and the box of their places and ends.
  struct Node {
    std::size_t first = 0;
    std::size_t last = 0;
    std::array<Vec3, 2> low;
    std::array<Vec3, 2> high;
    std::size_t left = 0;  ///< 0: a leaf
    std::size_t right = 0;
    std::size_t parent = 0;
    std::size_t first_joint = kNoParent;  ///< the smallest that can be found
  };
  struct Query;

  std::size_t build(std::size_t first, std::size_t last, std::size_t parent);
  void split(std::size_t node);
  void update(std::size_t node);
  void search(std::size_t node, Query& query) const;
  void search_leaf(const Node& node, Query& query) const;

  const JointPlaces& places_;
  std::vector<std::size_t> members_;
  std::vector<std::size_t> leaf_of_joint_;
  std::vector<char> is_removed_;
  std::vector<Node> nodes_;
};

}  // namespace kinefile::edit
