// SPDX-License-Identifier: MIT
#include "kinefile/fk.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "document/sources.hpp"
#include "kinefile/kinematics.hpp"

namespace kinefile {
namespace {

tl::unexpected<Error> refuse_table(std::string message) {
  return fail(ErrorKind::Usage, "CLI001", std::move(message));
}

/// The joints with these names, in skeleton order; all joints if there are no names.
Result<std::vector<std::size_t>> joints_named(const Skeleton& skeleton, const FkOptions& options) {
  std::vector<bool> is_selected(skeleton.joints.size(), options.joints.empty());
  for (const std::string& name : options.joints) {
    bool is_known = false;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      if (skeleton.joints[j].name != name) continue;
      is_selected[j] = true;
      is_known = true;
    }
    if (!is_known) {
      return refuse_table(fmt::format("there is no joint '{}' in '{}'", name, options.name));
    }
  }
  std::vector<std::size_t> selected;
  for (std::size_t j = 0; j < is_selected.size(); ++j) {
    if (is_selected[j]) selected.push_back(j);
  }
  return selected;
}

}  // namespace

PoseTable FkTable::view() const {
  return {&placed.motion.skeleton, &placed.motion.clip.timeline, frames,       joints,
          options.rotations,       options.directions,           options.tips, length_scale};
}

Result<FkTable> fk(Placed placed, const FkOptions& options) {
  if (placed.is_still && !options.rest) {
    return refuse_table(
        fmt::format("'{}' holds a skeleton alone; --rest shows its rest pose", options.name));
  }
  Motion& motion = placed.motion;
  if (options.rest) {
    motion.clip = rest_clip(motion.skeleton);
    placed.recorded.reset();
  }
  const std::size_t num_frames = motion.clip.num_frames;
  const auto frames = parse_range(options.frames, num_frames);
  if (!frames) {
    return refuse_table(fmt::format("expected --frames N, A:B or A:B:STEP within 0:{}, found '{}'",
                                    num_frames, options.frames));
  }
  auto joints = joints_named(motion.skeleton, options);
  if (!joints) return fail(std::move(joints.error()));
  const double scale = options.metres ? motion.skeleton.metres_per_unit : 1;
  if (scale == 0) {
    return refuse_table(
        "the file does not say its unit of length, so --unit m needs --unit-in "
        "m|cm|mm|inch|FACTOR");
  }
  return FkTable{std::move(placed), options, *frames, std::move(*joints), scale};
}

PoseArrays poses_of(const FkTable& table, const FrameRange& frames) {
  KinematicsOptions options;
  options.first_frame = frames.begin;
  options.frame_step = frames.step;
  options.num_frames = frames.num_frames();
  options.rotations = table.options.rotations;
  options.directions = table.options.directions;
  options.tips = table.options.tips;
  const Motion& motion = table.placed.motion;
  if (table.options.local) return local_poses(motion.skeleton, motion.clip, options);
  PoseArrays poses = forward_kinematics(motion.skeleton, motion.clip, options);
  if (table.placed.recorded) {
    robot::put_recorded_links(*table.placed.recorded, motion.skeleton, poses);
  }
  return poses;
}

bool write_table(const FkTable& table, const Format& format, const WriteOptions& options,
                 const Sink& sink) {
  const auto blocks = [&table](UsePoses use) {
    const FrameRange& all = table.frames;
    const std::size_t num_frames = all.num_frames();
    const std::size_t block = frames_per_block(table.placed.motion.skeleton);
    for (std::size_t done = 0; done < num_frames; done += block) {
      FrameRange part = all;
      part.begin = all.begin + done * all.step;
      part.end = part.begin + (std::min(block, num_frames - done) - 1) * all.step + 1;
      if (!use(poses_of(table, part))) return false;
    }
    return true;
  };
  return format.write_poses(table.view(), blocks, options, sink);
}

Result<std::vector<robot::LinkDeviation>> compare_links(const Document& document,
                                                        const DocumentSource& robot, bool lenient,
                                                        Diagnostics& diagnostics) {
  const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
  if (body == nullptr) return fail(wrong_kind(document, "a body motion with poses of links"));
  const auto model = model_of(robot, diagnostics);
  if (!model) return fail(model.error());
  if (*model == nullptr) {
    return fail(ErrorKind::Usage, "CNV002", "expected a robot to place the links of, found none");
  }
  return robot::compare_recorded_links(*body, skeleton_of(**model), lenient, diagnostics);
}

}  // namespace kinefile
