// SPDX-License-Identifier: MIT
#include "kinefile/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "document/sources.hpp"
#include "kinefile/robot.hpp"

namespace kinefile {
namespace {

/// The length of a tick: 1/60 s, or the value of the servo map, the project or the caller.
double tick_seconds_of(const RunSettings& settings) {
  constexpr double kSixtieth = 16667;  // in microseconds, rounded
  if (settings.tick_us) return *settings.tick_us == kSixtieth ? 1.0 / 60 : *settings.tick_us * 1e-6;
  if (settings.project != nullptr) return settings.project->tick_seconds;
  return settings.servo_map ? settings.servo_map->tick_seconds : 1.0 / 60;
}

/// The number of ticks that begin within a time.
std::uint64_t ticks_within(double seconds, double tick_seconds) {
  const double ticks = std::ceil(seconds / tick_seconds - 1e-9);
  return static_cast<std::uint64_t>(std::min(std::max(ticks, 0.0), 1e15));
}

flow::RunOptions options_of(const RunSettings& settings, double tick_seconds) {
  flow::RunOptions options = settings.options;
  if (settings.project != nullptr) {
    flow::RunOptions said = flow::run_options_of(*settings.project);
    if (options.base_pose.empty()) options.base_pose = std::move(said.base_pose);
    if (options.jumps.empty()) options.jumps = std::move(said.jumps);
  } else if (settings.servo_map && options.base_pose.empty()) {
    options.base_pose = settings.servo_map->base_pose;
  }
  if (settings.hold_seconds) {
    options.hold_ticks = ticks_within(*settings.hold_seconds, tick_seconds);
  }
  if (settings.max_seconds) {
    options.max_ticks = std::min(ticks_within(*settings.max_seconds, tick_seconds), kMostRunTicks);
  }
  return options;
}

/// The same map for a robot whose links and joints have different names: entries that name a joint
/// get the name of its link.
ServoMap with_link_names(ServoMap map, const Document& robot) {
  const std::vector<Joint>& joints = skeleton_of(robot).joints;
  for (ServoMapEntry& entry : map.entries) {
    const bool is_link = std::any_of(joints.begin(), joints.end(),
                                     [&](const Joint& joint) { return joint.name == entry.joint; });
    if (is_link) continue;
    const auto moved = std::find_if(joints.begin(), joints.end(), [&](const Joint& joint) {
      return !joint.joint_name.empty() && joint.joint_name == entry.joint;
    });
    if (moved != joints.end()) entry.joint = moved->name;
  }
  return map;
}

/// A document with the result, if there is one.
template <class Made>
Result<Document> document_with(Result<Made> made) {
  if (!made) return fail(std::move(made.error()));
  Document document;
  document.content = std::move(*made);
  return document;
}

/// The joints of the map, from a motion, or from a body motion and its robot.
/// \param map  with the names of links
Result<servo::JointTrajectory> trajectory_in(const Document& document, const ServoMap& map,
                                             const Document* robot, Diagnostics& diagnostics) {
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    return servo::trajectory_of(*motion, map, diagnostics);
  }
  if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    return servo::trajectory_of(*body, map, robot == nullptr ? nullptr : &skeleton_of(*robot),
                                diagnostics);
  }
  return fail(ErrorKind::Usage, "CLI001",
              fmt::format("expected a motion to make poses of, found {}",
                          has_skeleton(document) ? "a skeleton alone" : "a flow of poses"));
}

}  // namespace

Result<TimedRun> run(const PoseFlow& flow, const RunSettings& settings, Diagnostics& diagnostics) {
  TimedRun timed;
  timed.tick_seconds = tick_seconds_of(settings);
  timed.options = options_of(settings, timed.tick_seconds);
  auto done = flow::run(flow, timed.options, diagnostics);
  if (!done) return fail(std::move(done.error()));
  timed.run = std::move(*done);
  return timed;
}

Result<Document> document_of_run(const TimedRun& run, const ServoMap& map,
                                 const DocumentSource& model, Diagnostics& diagnostics) {
  ServoMap own = map;
  own.tick_seconds = run.tick_seconds;
  const auto skeleton = model_of(model, diagnostics);
  if (!skeleton) return fail(skeleton.error());
  if (*skeleton == nullptr) {
    return document_with(servo::unroll(run.run, own, nullptr, diagnostics));
  }
  own = with_link_names(std::move(own), **skeleton);
  const Skeleton& joints = skeleton_of(**skeleton);
  if (robot::is_robot(joints)) {
    return document_with(servo::unroll(run.run, own, &joints, diagnostics));
  }
  return document_with(servo::motion_of_run(run.run, own, joints, diagnostics));
}

Result<servo::Keyframes> keyframe(const Document& document, const ServoMap& map,
                                  const DocumentSource& robot,
                                  const servo::KeyframeOptions& options, Diagnostics& diagnostics) {
  std::shared_ptr<const Document> model;
  if (std::holds_alternative<BodyMotion>(document.content)) {
    auto found = model_of(robot, diagnostics);
    if (!found) return fail(std::move(found.error()));
    model = std::move(*found);
  }
  const Document& named = model != nullptr ? *model : document;
  const ServoMap own = with_link_names(map, named);
  const auto trajectory = trajectory_in(document, own, model.get(), diagnostics);
  if (!trajectory) return fail(trajectory.error());
  return servo::keyframe(*trajectory, own, options, diagnostics);
}

}  // namespace kinefile
