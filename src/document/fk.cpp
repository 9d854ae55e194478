// SPDX-License-Identifier: MIT
#include "kinefile/fk.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "document/sources.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/threads.hpp"

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

namespace {

/// \param num_frames  of the motion, which may be elsewhere
Result<FkTable> make_table(Placed placed, std::size_t num_frames, const FkOptions& options) {
  if (placed.is_still && !options.rest) {
    return refuse_table(
        fmt::format("'{}' holds a skeleton alone; --rest shows its rest pose", options.name));
  }
  Motion& motion = placed.motion;
  if (options.rest) {
    motion.clip = rest_clip(motion.skeleton);
    placed.recorded.reset();
    num_frames = 1;
  }
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

KinematicsOptions kinematics_of(const FkTable& table, const FrameRange& frames) {
  KinematicsOptions options;
  options.first_frame = frames.begin;
  options.frame_step = frames.step;
  options.num_frames = frames.num_frames();
  options.rotations = table.options.rotations;
  options.directions = table.options.directions;
  options.tips = table.options.tips;
  return options;
}

/// Poses over frames of a table, which are there as a clip of their own.
PoseArrays poses_of_rows(const FkTable& table, const FrameRange& frames,
                         std::span<const double> rows) {
  const Skeleton& skeleton = table.placed.motion.skeleton;
  Clip clip;
  clip.num_frames = frames.end - frames.begin;
  clip.num_coordinates = skeleton.coordinates.size();
  clip.values = Array<double>::adopt(rows, nullptr);
  KinematicsOptions options = kinematics_of(table, frames);
  options.first_frame = 0;
  PoseArrays poses;
  if (table.options.local) {
    poses = local_poses(skeleton, clip, options);
  } else {
    poses = forward_kinematics(skeleton, clip, options);
  }
  poses.first_frame = frames.begin;
  return poses;
}

}  // namespace

Result<FkTable> fk(Placed placed, const FkOptions& options) {
  const std::size_t num_frames = placed.motion.clip.num_frames;
  return make_table(std::move(placed), num_frames, options);
}

Result<FkTable> fk(const LongMotion& motion, const FkOptions& options) {
  auto table = make_table(Placed{std::get<Motion>(motion.document.content)},
                          motion.frames.num_frames, options);
  if (table) table->source = motion.frames;
  return table;
}

PoseArrays poses_of(const FkTable& table, const FrameRange& frames) {
  const KinematicsOptions options = kinematics_of(table, frames);
  const Motion& motion = table.placed.motion;
  if (table.options.local) return local_poses(motion.skeleton, motion.clip, options);
  PoseArrays poses = forward_kinematics(motion.skeleton, motion.clip, options);
  if (table.placed.recorded) {
    robot::put_recorded_links(*table.placed.recorded, motion.skeleton, poses);
  }
  return poses;
}

namespace {

/// How many frames of a table to place at a time: of several threads each gets some, and a source
/// gives no more.
std::size_t frames_at_a_time(const FkTable& table) {
  constexpr std::size_t kBlocksPerThread = 4;
  const std::size_t num_threads = max_threads();
  const std::size_t block = frames_per_block(table.placed.motion.skeleton);
  const std::size_t most = num_threads < 2 ? block : kBlocksPerThread * num_threads * block;
  if (!table.source) return most;
  const std::size_t per_read = frames_per_read(*table.source) / table.frames.step;
  return std::max<std::size_t>(std::min(most, per_read), 1);
}

/// The poses of some frames, wherever these are.
Result<PoseArrays> poses_of_part(const FkTable& table, const FrameRange& part) {
  if (!table.source) return poses_of(table, part);
  const auto rows = table.source->rows(part.begin, part.end - part.begin);
  if (!rows) return fail(rows.error());
  return poses_of_rows(table, part, *rows);
}

/// Calls `use` with parts of a table's frames, until it returns false.
bool for_each_part(const FkTable& table, FunctionRef<bool(const FrameRange&)> use) {
  const std::size_t most_frames = frames_at_a_time(table);
  const FrameRange& all = table.frames;
  const std::size_t num_frames = all.num_frames();
  for (std::size_t done = 0; done < num_frames; done += most_frames) {
    FrameRange part = all;
    part.begin = all.begin + done * all.step;
    part.end = part.begin + (std::min(most_frames, num_frames - done) - 1) * all.step + 1;
    if (!use(part)) return false;
  }
  return true;
}

}  // namespace

Result<void> write_table(const FkTable& table, const Format& format, const WriteOptions& options,
                         const Sink& sink) {
  Result<void> read;
  const auto blocks = [&](UsePoses use) {
    return for_each_part(table, [&](const FrameRange& part) {
      const auto poses = poses_of_part(table, part);
      if (!poses) read = fail(poses.error());
      return poses && use(*poses);
    });
  };
  const bool is_written = format.write_poses(table.view(), blocks, options, sink);
  if (!read || is_written) return read;
  return fail(ErrorKind::Io, "IO003", "the output was cut off");
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
