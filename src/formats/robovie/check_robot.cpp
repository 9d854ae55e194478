// SPDX-License-Identifier: MIT
// Checks the demands of a motion against the robot's project.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "base/words.hpp"
#include "formats/robovie/codes.hpp"
#include "formats/robovie/reader.hpp"
#include "kinefile/robot_project.hpp"

namespace kinefile::robovie {
namespace {

/// The largest number of blocks searched between two poses, to limit the time for odd flows.
constexpr std::size_t kMostBetween = 100;

const PoseBlock* pose_of(const FlowFile& file, std::size_t block) {
  const bool is_read = file.places[block].settings[0] != nullptr;
  return is_read ? std::get_if<PoseBlock>(&file.flow.blocks[block].body) : nullptr;
}

/// A sound's path in the form for comparison: '\' between folders, lower case.
std::string sound_key(std::string_view path) {
  std::string key = lowered(path);
  std::replace(key.begin(), key.end(), '/', '\\');
  return key;
}

/// Checks of the words and sounds of single poses.
class ProjectCheck {
 public:
  ProjectCheck(const Reader& reader, const RobotProject& project)
      : reader_(reader), project_(project) {
    for (const std::string& sound : project.sounds) sounds_.insert(sound_key(sound));
  }

  void check(const PoseBlock& pose, FlowFormat format, const BlockPlaces& places) const {
    const char* const sound = places.settings[format == FlowFormat::WordN ? 4 : 2];
    const bool knows_sounds = !sounds_.empty();  // the list may be missing
    if (knows_sounds && !pose.sound.empty() && !sounds_.contains(sound_key(pose.sound))) {
      reader_.warn(
          code::kUnknownSound,
          fmt::format("expected a sound of the project's list, found {}", text::quoted(pose.sound)),
          sound);
    }
    for (std::size_t slider = 0; slider < pose.words.size(); ++slider) {
      if (pose.words[slider].is_enabled) check_word(slider, pose.words[slider].value, places);
    }
  }

 private:
  void check_word(std::size_t number, int value, const BlockPlaces& places) const {
    if (number >= project_.sliders.size()) return;
    const Slider& slider = project_.sliders[number];
    const bool is_beyond = value < slider.minimum || value > slider.maximum;
    const bool is_off = slider.step > 1 && (value - slider.minimum) % slider.step != 0;
    if (!slider.is_disabled && !is_beyond && !is_off) return;
    const char* const at = place_of_word(places.settings[1], number);
    const std::string name = slider.name.empty()
                                 ? fmt::format("{}", number)
                                 : fmt::format("{} ({})", number, text::quoted(slider.name));
    if (slider.is_disabled) {
      reader_.warn(code::kDisabledSlider,
                   fmt::format("slider {} is enabled here and disabled in the project", name), at);
    }
    if (is_beyond) {
      reader_.warn(code::kBeyondLimits,
                   fmt::format("expected {} to {} for slider {}, found {}", slider.minimum,
                               slider.maximum, name, value),
                   at);
    } else if (is_off) {
      reader_.warn(code::kOffStep,
                   fmt::format("expected {} plus a multiple of {} for slider {}, found {}",
                               slider.minimum, slider.step, name, value),
                   at);
    }
  }

  const Reader& reader_;
  const RobotProject& project_;
  std::set<std::string> sounds_;
};

/// Finds how fast sliders move from pose to pose.
class SpeedCheck {
 public:
  SpeedCheck(const Reader& reader, const FlowFile& file, double limit)
      : reader_(reader), file_(file), limit_(limit), seen_at_(file.flow.blocks.size()) {
    const RobotProject* const project = reader.options.project.get();
    if (project == nullptr) return;
    base_ = base_values(*project);
    for (const Slider& slider : project->sliders) jumps_.push_back(slider.jumps);
  }

  void check_from(std::size_t block) {
    for (const std::size_t next : poses_after(block)) compare(block, next);
  }

 private:
  /// The following poses, through blocks that take no time.
  std::vector<std::size_t> poses_after(std::size_t block) {
    std::vector<std::size_t> poses;
    std::vector<std::size_t> waiting = {block};
    ++stamp_;
    for (std::size_t i = 0; i < waiting.size() && i <= kMostBetween; ++i) {
      for (const int way : successors(file_.flow, waiting[i])) {
        const auto next = static_cast<std::size_t>(way);
        if (seen_at_[next] == stamp_) continue;
        seen_at_[next] = stamp_;
        const bool is_pose = std::holds_alternative<PoseBlock>(file_.flow.blocks[next].body);
        (is_pose ? poses : waiting).push_back(next);
      }
    }
    return poses;
  }

  /// The position of a slider at the end of a pose; empty if it is unknown.
  std::optional<int> value_of(const PoseBlock& pose, std::size_t slider) const {
    if (slider >= pose.words.size()) return std::nullopt;
    if (pose.words[slider].is_enabled) return pose.words[slider].value;
    return slider < base_.size() ? std::optional<int>(base_[slider]) : std::nullopt;
  }

  bool jumps(std::size_t slider) const { return slider < jumps_.size() && jumps_[slider]; }

  void compare(std::size_t from_block, std::size_t to_block) const {
    const PoseBlock* const from = pose_of(file_, from_block);
    const PoseBlock* const to = pose_of(file_, to_block);
    if (from == nullptr || to == nullptr) return;
    std::size_t fastest = 0;
    int largest = 0;
    for (std::size_t slider = 0; slider < to->words.size(); ++slider) {
      const auto a = value_of(*from, slider);
      const auto b = value_of(*to, slider);
      if (!a || !b || jumps(slider) || !to->words[slider].is_enabled) continue;
      const int change = std::abs(*b - *a);
      if (change > largest) fastest = slider;
      largest = std::max(largest, change);
    }
    const double speed = static_cast<double>(largest) / to->ticks;
    if (!(speed > limit_)) return;
    reader_.warn(
        code::kTooFast,
        fmt::format("slider {} goes from {} to {} in {} ticks, {:.6g} a tick, coming from "
                    "{} {}; the limit is {:.6g}",
                    fastest, *value_of(*from, fastest), *value_of(*to, fastest), to->ticks, speed,
                    file_.flow.format == FlowFormat::WordN ? "pose" : "block", from_block, limit_),
        place_of_word(file_.places[to_block].settings[1], fastest));
  }

  const Reader& reader_;
  const FlowFile& file_;
  double limit_;
  std::vector<std::int16_t> base_;
  std::vector<bool> jumps_;
  std::vector<std::size_t> seen_at_;  ///< by block: the pose from which it was last reached
  std::size_t stamp_ = 0;
};

}  // namespace

void check_on_robot(const Reader& reader, const FlowFile& file) {
  const PoseFlow& flow = file.flow;
  if (reader.options.project != nullptr) {
    const ProjectCheck check(reader, *reader.options.project);
    for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
      if (const PoseBlock* pose = pose_of(file, b)) check.check(*pose, flow.format, file.places[b]);
    }
  }
  const auto& max_speed = reader.options.of_formats.get<robovie::ReadOptions>().max_speed;
  if (!max_speed || !file.is_whole) return;
  SpeedCheck check(reader, file, *max_speed);
  for (std::size_t b = 0; b < flow.blocks.size(); ++b) {
    if (pose_of(file, b) != nullptr) check.check_from(b);
  }
}

}  // namespace kinefile::robovie
