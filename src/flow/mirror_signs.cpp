// SPDX-License-Identifier: MIT
// What the words of a flow show about the signs of pairs of sliders.

#include <algorithm>
#include <cstdlib>

#include "kinefile/flow.hpp"

namespace kinefile::flow {
namespace {

/// A side is displaced if it is this part of its slider's range away from the base pose.
constexpr int kDisplacedPart = 64;
/// Two sides are of one size if they differ by this part of the larger one, or by one step.
constexpr int kSizePart = 16;

/// A robot and its base pose.
struct Home {
  const RobotProject& project;
  std::vector<std::int16_t> words;

  /// How far a pose moves a slider from the base pose, which disabled sliders take.
  int displacement(const PoseBlock& pose, std::size_t slider) const {
    const SliderWord word = pose.words[slider];
    return word.is_enabled ? word.value - words[slider] : 0;
  }

  bool is_displaced(std::size_t slider, int displacement) const {
    const Slider& of = project.sliders[slider];
    return std::abs(displacement) > std::max(of.maximum - of.minimum, 0) / kDisplacedPart;
  }
};

bool are_of_one_size(int a, int b, int step) {
  return std::abs(a - b) <= std::max(step, std::max(a, b) / kSizePart);
}

/// How a pose moves the two sides of a pair.
struct Sides {
  bool are_displaced = false;  ///< at least one is
  bool are_of_one_size = false;
  bool are_opposite = false;
  int size = 0;  ///< the larger displacement
};

Sides sides_of(const Home& home, const PoseBlock& pose, const MirrorPair& pair) {
  const int a = home.displacement(pose, pair.slider);
  const int b = home.displacement(pose, pair.partner);
  const int step = home.project.sliders[pair.slider].step;
  Sides sides;
  sides.size = std::max(std::abs(a), std::abs(b));
  sides.are_displaced = home.is_displaced(pair.slider, a) || home.is_displaced(pair.partner, b);
  sides.are_of_one_size = are_of_one_size(std::abs(a), std::abs(b), step);
  sides.are_opposite = (a < 0) != (b < 0);
  return sides;
}

/// Whether a pose looks like its mirror image, whatever the signs of the pairs are: the sides of
/// each pair are displaced by as much, and no slider of the centre line is displaced.
bool is_symmetric(const Home& home, const PoseBlock& pose, const std::vector<MirrorPair>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [&](const MirrorPair& pair) {
    const Sides sides = sides_of(home, pose, pair);
    const bool is_centre = pair.slider == pair.partner;
    return !sides.are_displaced || (sides.are_of_one_size && !is_centre);
  });
}

}  // namespace

std::vector<SignEvidence> sign_evidence(const PoseFlow& flow, const RobotProject& project,
                                        const std::vector<MirrorPair>& pairs) {
  const Home home{project, base_values(project)};
  std::vector<SignEvidence> all(pairs.size());
  std::vector<int> first_sizes(pairs.size());  // of the first pose that shows a pair's sign
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    const auto* pose = std::get_if<PoseBlock>(&flow.blocks[b].body);
    if (pose == nullptr) continue;
    const bool has_symmetry = is_symmetric(home, *pose, pairs);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const Sides sides = sides_of(home, *pose, pairs[p]);
      const bool is_of_two = pairs[p].slider != pairs[p].partner;
      if (!is_of_two || !sides.are_displaced) continue;
      SignEvidence& evidence = all[p];
      evidence.moves = true;
      if (!sides.are_of_one_size) continue;
      auto& block = sides.are_opposite ? evidence.opposite_block : evidence.alike_block;
      if (!block) block = b;
      if (first_sizes[p] == 0) first_sizes[p] = sides.size;
      const bool is_other_size = !are_of_one_size(first_sizes[p], sides.size, 0);
      evidence.is_clear = evidence.is_clear || has_symmetry || is_other_size;
    }
  }
  return all;
}

}  // namespace kinefile::flow
