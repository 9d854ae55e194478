// SPDX-License-Identifier: MIT
#include "formats/bvh/positions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "formats/bvh/bind.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"

namespace kinefile::bvh {
namespace {

/// A wrong reading is this many times further from what is expected than the right one.
constexpr double kClearly = 4;

/// The position channels of a node, with the columns of its first channel for each axis.
struct PositionColumns {
  std::array<std::optional<std::size_t>, 3> of_axis;

  bool any() const { return of_axis[0] || of_axis[1] || of_axis[2]; }
};

PositionColumns position_columns(const Node& node, std::size_t first_column) {
  PositionColumns columns;
  for (std::size_t c = 0; c < node.channels.size(); ++c) {
    const Channel& channel = node.channels[c];
    if (channel.kind != ChannelKind::Position || columns.of_axis[channel.axis]) continue;
    columns.of_axis[channel.axis] = first_column + c;
  }
  return columns;
}

/// A node with an OFFSET and position channels, and the vectors of these channels' axes.
struct Candidate {
  std::size_t node = 0;
  Vec3 offset = Vec3::Zero();   ///< OFFSET, 0 along axes without a channel
  std::vector<Vec3> positions;  ///< the values, likewise; of sampled frames
};

/// A file with some of its frames.
File sampled(const File& file) {
  File sample;
  sample.nodes = file.nodes;
  sample.has_motion = true;
  sample.frame_time = file.frame_time;
  sample.num_columns = file.num_columns;
  const std::size_t step = sample_step(file.num_frames);
  for (std::size_t f = 0; f < file.num_frames; f += step) {
    sample.values.append(
        std::span<const double>(file.values).subspan(f * file.num_columns, file.num_columns));
    ++sample.num_frames;
  }
  return sample;
}

/// The length of the longest OFFSET.
double longest_offset(const File& file) {
  double longest = 0;
  for (const Node& node : file.nodes) longest = std::max(longest, vector_of(node.offset).norm());
  return longest;
}

std::vector<Candidate> candidates_of(const File& file) {
  constexpr double kNoOffset = 1e-4;  // of the longest one
  const double longest = longest_offset(file);
  std::vector<Candidate> candidates;
  std::size_t column = 0;
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    const Node& node = file.nodes[n];
    const PositionColumns columns = position_columns(node, column);
    column += node.channels.size();
    Candidate candidate;
    candidate.node = n;
    for (std::size_t k = 0; k < 3; ++k) {
      if (columns.of_axis[k]) candidate.offset[static_cast<Eigen::Index>(k)] = node.offset[k];
    }
    if (!columns.any() || candidate.offset.norm() <= kNoOffset * longest) continue;
    for (std::size_t f = 0; f < file.num_frames; ++f) {
      Vec3 position = Vec3::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        if (!columns.of_axis[k]) continue;
        position[static_cast<Eigen::Index>(k)] =
            file.values[f * file.num_columns + *columns.of_axis[k]];
      }
      if (position.allFinite()) candidate.positions.push_back(position);
    }
    if (!candidate.positions.empty()) candidates.push_back(std::move(candidate));
  }
  return candidates;
}

double median(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// The median distance of a node's values from a point.
double median_distance(const Candidate& candidate, const Vec3& from) {
  std::vector<double> distances;
  for (const Vec3& position : candidate.positions) distances.push_back((position - from).norm());
  return median(std::move(distances));
}

/// Whether the values stay as near to each other as those of a bone, which hardly changes.
bool is_bone(const Candidate& candidate) {
  constexpr double kMostChange = 0.25;  // of the OFFSET's length
  Box box;
  for (const Vec3& position : candidate.positions) {
    box.min = box.min.cwiseMin(position);
    box.max = box.max.cwiseMax(position);
  }
  return (box.max - box.min).norm() <= kMostChange * candidate.offset.norm();
}

/// Which nodes have position channels that change.
std::vector<bool> moving_nodes(const File& file) {
  std::vector<bool> is_moving(file.nodes.size(), false);
  std::size_t column = 0;
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    const PositionColumns columns = position_columns(file.nodes[n], column);
    column += file.nodes[n].channels.size();
    for (const auto& of_axis : columns.of_axis) {
      for (std::size_t f = 1; of_axis && f < file.num_frames; ++f) {
        const double change = file.values[f * file.num_columns + *of_axis] - file.values[*of_axis];
        if (change != 0) is_moving[n] = true;
      }
    }
  }
  return is_moving;
}

/// The joints that carry the figure: roots, and joints below still ancestors that are no bones.
std::vector<bool> carriers_of(const File& file, const std::vector<Candidate>& candidates) {
  const std::vector<bool> is_moving = moving_nodes(file);
  std::vector<bool> is_no_bone(file.nodes.size(), false);
  for (const Candidate& candidate : candidates) is_no_bone[candidate.node] = !is_bone(candidate);
  std::vector<bool> is_carried(file.nodes.size(), false);  // an ancestor moves
  std::vector<bool> carries(file.nodes.size(), false);
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    const std::size_t parent = file.nodes[n].parent;
    const bool is_root = parent == kNoParent;
    is_carried[n] = !is_root && (is_carried[parent] || is_moving[parent]);
    carries[n] = is_root || (!is_carried[n] && is_no_bone[n]);
  }
  return carries;
}

PositionGuess guess_of_bone(const Candidate& candidate) {
  const double replaced = median_distance(candidate, candidate.offset);
  const double added = median_distance(candidate, Vec3::Zero());
  PositionGuess guess{candidate.node, PositionMode::Replace, false, {}};
  guess.is_clear = kClearly * std::min(added, replaced) < std::max(added, replaced);
  if (guess.is_clear && added < replaced) guess.mode = PositionMode::Add;
  const double length = candidate.offset.norm();
  guess.reason = guess.mode == PositionMode::Add
                     ? fmt::format("its values lie {:.6g} from zero and {:.6g} from its OFFSET",
                                   added, replaced)
                     : fmt::format("its values lie {:.6g} from its OFFSET, whose length is {:.6g}",
                                   replaced, length);
  return guess;
}

/// The lowest points below a node in every frame, and the height of the figure.
struct Lowest {
  std::vector<double> heights;
  double size = 0;
};

Lowest lowest_below(const Skeleton& skeleton, const WorldPoses& poses, std::size_t node,
                    Eigen::Index up) {
  std::vector<bool> is_below(skeleton.joints.size(), false);
  for (std::size_t j = node; j < is_below.size(); ++j) {
    const std::size_t parent = skeleton.joints[j].parent;
    is_below[j] = j == node || (parent != kNoParent && is_below[parent]);
  }
  Lowest found;
  for (std::size_t f = 0; f < poses.num_frames; ++f) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    std::size_t tip = 0;
    const auto include = [&](const double* position) {
      lowest = std::min(lowest, position[up]);
      highest = std::max(highest, position[up]);
    };
    for (std::size_t j = 0; j < is_below.size(); ++j) {
      const std::size_t num_tips = skeleton.joints[j].tips.size();
      if (is_below[j]) include(&poses.positions[(f * poses.num_joints + j) * 3]);
      for (std::size_t t = 0; is_below[j] && t < num_tips; ++t) {
        include(&poses.tips[(f * poses.num_tips + tip + t) * 3]);
      }
      tip += num_tips;
    }
    if (!std::isfinite(highest - lowest)) continue;
    found.heights.push_back(lowest);
    found.size = std::max(found.size, highest - lowest);
  }
  return found;
}

/// How far from the ground the figure stays: the nearest and the median distance.
struct FromGround {
  double nearest = std::numeric_limits<double>::infinity();
  double middle = 0;
  double height = 0;  ///< the lowest point where it is nearest
};

FromGround from_ground(const Lowest& lowest, double shift) {
  FromGround found;
  std::vector<double> distances;
  for (const double height : lowest.heights) {
    const double distance = std::abs(height + shift);
    distances.push_back(distance);
    if (distance >= found.nearest) continue;
    found.nearest = distance;
    found.height = height + shift;
  }
  found.middle = median(std::move(distances));
  return found;
}

/// \param rise  how much higher the figure is if the OFFSET is added
std::optional<PositionGuess> guess_of_carrier(std::size_t node, const Lowest& lowest, double rise) {
  constexpr double kLeastRise = 0.02;  // of the figure's height: below it, nothing can be told
  constexpr double kOnGround = 0.05;
  if (lowest.heights.empty() || !(std::abs(rise) > kLeastRise * lowest.size)) return std::nullopt;
  const FromGround replaced = from_ground(lowest, 0);
  const FromGround added = from_ground(lowest, rise);
  const double ground = kOnGround * lowest.size;
  // Where both readings touch the ground, a figure that goes up or down, most of the time counts.
  const bool touches = replaced.nearest < ground && added.nearest < ground;
  const double from_replaced = touches ? replaced.middle : replaced.nearest;
  const double from_added = touches ? added.middle : added.nearest;
  PositionGuess guess{node, PositionMode::Replace, false, {}};
  const double wrong = std::max(from_added, from_replaced);
  guess.is_clear = kClearly * std::min(from_added, from_replaced) < wrong && wrong > 2 * ground;
  if (guess.is_clear && from_added < from_replaced) guess.mode = PositionMode::Add;
  const bool is_added = guess.mode == PositionMode::Add;
  const FromGround& right = is_added ? added : replaced;
  guess.reason = fmt::format(
      "the lowest point of the figure comes to {:.6g}, and to {:.6g} if "
      "its OFFSET is {}",
      right.height, (is_added ? replaced : added).height, is_added ? "replaced" : "added");
  return guess;
}

/// The guesses for joints that carry the figure, whose bones are settled.
void add_guesses_of_carriers(const File& sample, const std::vector<Candidate>& candidates,
                             const std::vector<bool>& carries, std::optional<std::size_t> up,
                             std::vector<PositionGuess>& guesses) {
  constexpr std::size_t kMostCarriers = 16;  // each looks at the whole figure
  const auto count = std::count_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
    return static_cast<bool>(carries[c.node]);
  });
  if (count == 0 || static_cast<std::size_t>(count) > kMostCarriers) return;
  PositionModes modes(sample.nodes.size(), PositionMode::Replace);
  for (const PositionGuess& guess : guesses) modes[guess.node] = guess.mode;
  File copy = sample;
  Motion motion = bvh::bind(std::move(copy), modes);
  motion.skeleton.up = up;
  const UpAxis found = find_up_axis(motion);
  if (found.certainty == Certainty::Doubtful) return;  // then nothing says where the ground is
  const auto axis = static_cast<Eigen::Index>(found.axis);
  const WorldPoses poses =
      forward_kinematics(motion.skeleton, motion.clip, {.rotations = true, .tips = true});
  for (const Candidate& candidate : candidates) {
    if (!carries[candidate.node]) continue;
    const std::size_t parent = sample.nodes[candidate.node].parent;
    Vec3 shift = candidate.offset;
    if (parent != kNoParent) {
      const double* q = &poses.rotations[parent * 4];
      shift = Quat(q[0], q[1], q[2], q[3]) * shift;
    }
    const Lowest lowest = lowest_below(motion.skeleton, poses, candidate.node, axis);
    if (auto guess = guess_of_carrier(candidate.node, lowest, shift[axis])) {
      guesses.push_back(std::move(*guess));
    }
  }
}

std::string_view word_of(PositionMode mode) {
  return mode == PositionMode::Add ? "add" : "replace";
}

/// The meanings that occur among the roots and among the other joints.
struct Occurring {
  std::array<bool, 2> in_roots{};  ///< replace, add
  std::array<bool, 2> in_others{};

  void include(bool is_root, PositionMode mode) {
    (is_root ? in_roots : in_others)[mode == PositionMode::Add ? 1 : 0] = true;
  }
};

std::string option_of(const Occurring& occurring) {
  const auto& [roots, others] = occurring;
  const auto has_both = [](const std::array<bool, 2>& modes) { return modes[0] && modes[1]; };
  if (has_both(roots) || has_both(others)) return "auto";
  const auto mode = [](const std::array<bool, 2>& modes) {
    return modes[1] ? PositionMode::Add : PositionMode::Replace;
  };
  const bool has_roots = roots[0] || roots[1];
  const bool has_others = others[0] || others[1];
  if (!has_others || (has_roots && mode(roots) == mode(others))) {
    return std::string(word_of(mode(roots)));
  }
  if (!has_roots) return std::string(word_of(mode(others)));
  return fmt::format("root={},others={}", word_of(mode(roots)), word_of(mode(others)));
}

std::optional<PositionMode> parse_mode(std::string_view word) {
  if (word == "replace") return PositionMode::Replace;
  if (word == "add") return PositionMode::Add;
  if (word == "auto") return PositionMode::Auto;
  return std::nullopt;
}

}  // namespace

std::size_t sample_step(std::size_t num_frames) {
  constexpr std::size_t kMostFrames = 64;
  return std::max<std::size_t>((num_frames + kMostFrames - 1) / kMostFrames, 1);
}

std::vector<PositionGuess> guess_positions(const File& file, std::optional<std::size_t> up) {
  if (file.num_frames == 0) return {};
  const File sample = sampled(file);
  const std::vector<Candidate> candidates = candidates_of(sample);
  if (candidates.empty()) return {};
  const std::vector<bool> carries = carriers_of(sample, candidates);
  std::vector<PositionGuess> guesses;
  for (const Candidate& candidate : candidates) {
    if (!carries[candidate.node]) guesses.push_back(guess_of_bone(candidate));
  }
  add_guesses_of_carriers(sample, candidates, carries, up, guesses);
  std::sort(guesses.begin(), guesses.end(),
            [](const PositionGuess& a, const PositionGuess& b) { return a.node < b.node; });
  return guesses;
}

PositionModes settled_positions(const File& file, const Positions& asked,
                                const std::vector<PositionGuess>& guesses) {
  PositionModes modes;
  for (const Node& node : file.nodes) {
    modes.push_back(node.parent == kNoParent ? asked.root : asked.others);
  }
  for (const PositionGuess& guess : guesses) {
    if (modes[guess.node] == PositionMode::Auto) modes[guess.node] = guess.mode;
  }
  std::replace(modes.begin(), modes.end(), PositionMode::Auto, PositionMode::Replace);
  return modes;
}

std::string option_of(const File& file, const PositionModes& modes) {
  Occurring occurring;
  std::size_t column = 0;
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    const Node& node = file.nodes[n];
    const bool has_positions = position_columns(node, column).any();
    column += node.channels.size();
    if (!has_positions || vector_of(node.offset).isZero(0)) continue;
    occurring.include(node.parent == kNoParent, modes[n]);
  }
  return option_of(occurring);
}

std::string option_of(const Skeleton& skeleton) {
  Occurring occurring;
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::Translation) continue;
      const bool is_added = dof.axis.dot(joint.offset) != 0;
      if (!is_added && dof.rest == 0) continue;  // both give the same
      occurring.include(joint.parent == kNoParent,
                        is_added ? PositionMode::Add : PositionMode::Replace);
    }
  }
  return option_of(occurring);
}

std::optional<Positions> parse_positions(std::string_view text) {
  constexpr std::string_view kRoot = "root=";
  constexpr std::string_view kOthers = ",others=";
  if (const auto mode = parse_mode(text)) return Positions(*mode);
  const std::size_t at = text.find(kOthers);
  if (!text.starts_with(kRoot) || at == std::string_view::npos) return std::nullopt;
  const auto root = parse_mode(text.substr(kRoot.size(), at - kRoot.size()));
  const auto others = parse_mode(text.substr(at + kOthers.size()));
  if (!root || !others) return std::nullopt;
  return Positions(*root, *others);
}

}  // namespace kinefile::bvh
