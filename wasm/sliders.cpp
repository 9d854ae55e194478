// SPDX-License-Identifier: MIT
#include "sliders.hpp"

#include <variant>
#include <vector>

namespace kinefile::page {
namespace {

/// How a slider is shown: its name, and how many words are one of its units.
struct SliderColumn {
  std::size_t slider = 0;
  std::string name;
  double words_per_unit = 1;
};

/// The sliders that poses set: first those that move, then the others, each by number.
std::vector<std::size_t> set_sliders(const PoseFlow& flow, const flow::Run& run) {
  std::vector<bool> are_set(flow.num_sliders), move(flow.num_sliders);
  for (const Block& block : flow.blocks) {
    const PoseBlock* pose = std::get_if<PoseBlock>(&block.body);
    if (pose == nullptr) continue;
    for (std::size_t s = 0; s < pose->words.size(); ++s) {
      if (pose->words[s].is_enabled) are_set[s] = true;
    }
  }
  for (std::size_t i = run.num_sliders; i < run.sliders.size(); ++i) {
    if (run.sliders[i] != run.sliders[i - run.num_sliders]) move[i % run.num_sliders] = true;
  }
  std::vector<std::size_t> sliders;
  for (const bool are_moving : {true, false}) {
    for (std::size_t s = 0; s < are_set.size(); ++s) {
      if (are_set[s] && move[s] == are_moving) sliders.push_back(s);
    }
  }
  return sliders;
}

std::vector<SliderColumn> columns_of(const PoseFlow& flow, const flow::Run& run,
                                     const RobotProject* project) {
  std::vector<SliderColumn> columns;
  for (const std::size_t s : set_sliders(flow, run)) {
    SliderColumn& column = columns.emplace_back();
    column.slider = s;
    column.name = "s" + std::to_string(s);
    if (project == nullptr || s >= project->sliders.size()) continue;
    const Slider& slider = project->sliders[s];
    if (!slider.name.empty()) column.name = slider.name;
    if (!(slider.units_per_degree > 0)) continue;
    column.name += " [\u00b0]";
    column.words_per_unit = slider.units_per_degree;
  }
  return columns;
}

}  // namespace

Motion motion_of_sliders(const TimedRun& timed, const PoseFlow& flow, const RobotProject* project) {
  const flow::Run& run = timed.run;
  const std::vector<SliderColumn> columns = columns_of(flow, run, project);
  Motion motion;
  motion.skeleton.joints.emplace_back();
  for (const SliderColumn& column : columns) {
    motion.skeleton.coordinates.push_back({0, column.name});
  }
  Clip& clip = motion.clip;
  clip.num_frames = run.num_ticks + 1;
  clip.num_coordinates = columns.size();
  clip.timeline.given = FrameTime{timed.tick_seconds};
  clip.values = Array<double>(clip.num_frames * columns.size());
  double* out = clip.values.mutate().data();
  for (std::size_t tick = 0; tick < clip.num_frames; ++tick) {
    for (const SliderColumn& column : columns) {
      *out++ = run.sliders[tick * run.num_sliders + column.slider] / column.words_per_unit;
    }
  }
  return motion;
}

}  // namespace kinefile::page
