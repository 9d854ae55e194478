// SPDX-License-Identifier: MIT
#include "describe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "clock.hpp"
#include "kinefile/evidence.hpp"
#include "kinefile/info.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/limits.hpp"
#include "kinefile/retime_documents.hpp"
#include "kinefile/timeline.hpp"

namespace kinefile::page {
namespace {

Json vector(const Vec3& value) { return {number(value.x()), number(value.y()), number(value.z())}; }

Json box(const Box& box) {
  if (box.min.x() > box.max.x()) return nullptr;
  return {{"min", vector(box.min)}, {"max", vector(box.max)}};
}

const char* name_of(Certainty certainty) {
  constexpr const char* kNames[] = {"known", "clear", "doubtful"};
  return kNames[static_cast<std::size_t>(certainty)];
}

/// A limit in the unit in which people are told it; null: there is none.
Json limit_of(double limit, const ToldUnit& unit) {
  return std::isfinite(limit) ? Json(limit * unit.factor) : Json();
}

/// How a joint of a robot can move.
/// \param id  the joint id by which files of joint values move it; absent: they do not
Json dofs_of(const Skeleton& skeleton, const Joint& joint, std::optional<std::size_t> id) {
  Json json = Json::array();
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (num_coordinates(dof) != 1) continue;
    const ToldUnit unit = told_unit(dof, skeleton);
    json.push_back({{"kind", dof.kind == DofKind::Rotation ? "rotation" : "translation"},
                    {"axis", vector(dof.axis)},
                    {"unit", unit.name},
                    {"lower", limit_of(dof.lower, unit)},
                    {"upper", limit_of(dof.upper, unit)},
                    {"max_speed", limit_of(dof.max_speed, unit)},
                    {"id", id ? Json(*id) : Json()}});
  }
  return json;
}

/// The joint ids of a robot's joints: their columns, counted after those of the root.
std::vector<std::optional<std::size_t>> ids_of(const Skeleton& skeleton) {
  const auto is_of_root = [](const Coordinate& coordinate) { return coordinate.joint == 0; };
  const auto num_root = static_cast<std::size_t>(
      std::count_if(skeleton.coordinates.begin(), skeleton.coordinates.end(), is_of_root));
  auto ids = value_columns(skeleton);
  for (std::size_t j = 0; j < ids.size(); ++j) {
    const bool is_own = ids[j] && *ids[j] >= num_root && skeleton.coordinates[*ids[j]].joint == j;
    ids[j] = is_own ? std::optional(*ids[j] - num_root) : std::nullopt;
  }
  return ids;
}

Json json_of(const Joint& joint) {
  Json tips = Json::array(), visuals = Json::array();
  for (const Tip& tip : joint.tips) tips.push_back(tip.name);
  for (const VisualShape& shape : joint.visuals) {
    constexpr const char* kKinds[] = {"box", "cylinder", "sphere", "capsule", "cone"};
    const Quat& turn = shape.rotation;
    Json json = {{"kind", kKinds[static_cast<std::size_t>(shape.kind)]},
                 {"size", vector(shape.size)},
                 {"position", vector(shape.position)},
                 {"rotation", {turn.w(), turn.x(), turn.y(), turn.z()}}};
    json["colour"] = shape.colour ? vector(*shape.colour) : Json();
    visuals.push_back(std::move(json));
  }
  Json json = {{"name", joint.name}, {"joint_name", joint.joint_name}};
  json["parent"] = joint.parent == kNoParent ? Json(-1) : Json(joint.parent);
  json["tips"] = std::move(tips);
  json["visuals"] = std::move(visuals);
  return json;
}

/// What each column measures: "length", "angle", or nothing for parts of a quaternion, scales, and
/// columns that move nothing.
std::vector<const char*> measures_of(const Skeleton& skeleton) {
  std::vector<const char*> measures(skeleton.coordinates.size(), "");
  const auto set = [&](std::size_t first, std::size_t count, const char* measure) {
    std::fill_n(measures.begin() + static_cast<std::ptrdiff_t>(first), count, measure);
  };
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      switch (dof.kind) {
        case DofKind::Rotation:
          set(dof.coordinate, 1, "angle");
          break;
        case DofKind::RotationVector:
          set(dof.coordinate, 3, "angle");
          break;
        case DofKind::Translation:
        case DofKind::TailTranslation:
          set(dof.coordinate, 1, "length");
          break;
        case DofKind::Free:
          set(dof.coordinate, 3, "length");
          break;
        case DofKind::Ball:
        case DofKind::TailScale:
          break;
      }
    }
  }
  return measures;
}

/// Adds the limits of a column, in its own unit, where it has some.
void put_limits(Json& channel, const Skeleton& skeleton, std::size_t column) {
  const Joint& joint = skeleton.joints[skeleton.coordinates[column].joint];
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.coordinate != column || num_coordinates(dof) != 1) continue;
    const auto put = [&](const char* name, double limit) {
      if (std::isfinite(limit)) channel[name] = column_of(dof, limit);
    };
    put(dof.gain < 0 ? "upper" : "lower", dof.lower);
    put(dof.gain < 0 ? "lower" : "upper", dof.upper);
  }
}

Json joints_of(const Skeleton& skeleton, bool is_robot) {
  Json joints = Json::array();
  for (const Joint& joint : skeleton.joints) joints.push_back(json_of(joint));
  if (is_robot) {
    const auto ids = ids_of(skeleton);
    for (std::size_t j = 1; j < ids.size(); ++j) {
      joints[j]["dofs"] = dofs_of(skeleton, skeleton.joints[j], ids[j]);
    }
  }
  const std::vector<const char*> measures = measures_of(skeleton);
  for (std::size_t c = 0; c < skeleton.coordinates.size(); ++c) {
    const Coordinate& coordinate = skeleton.coordinates[c];
    Json channel = {{"name", coordinate.channel}, {"column", c}, {"measure", measures[c]}};
    put_limits(channel, skeleton, c);
    joints[coordinate.joint]["channels"].push_back(std::move(channel));
  }
  return joints;
}

Json evidence_of(const Motion& motion) {
  const UpAxis up = find_up_axis(motion);
  const Facing facing = find_facing(motion, up.axis);
  const LengthUnit unit = find_length_unit(motion);
  Json json;
  json["up"] = {{"axis", up.axis}, {"certainty", name_of(up.certainty)}, {"reason", up.reason}};
  json["facing"] = {{"direction", facing.direction ? vector(*facing.direction) : Json()},
                    {"reason", facing.reason}};
  json["unit"] = {{"metres", number(unit.metres)},
                  {"certainty", name_of(unit.certainty)},
                  {"reason", unit.reason}};
  json["height"] = number(standing_height(motion, up.axis));
  return json;
}

Json time_of(const Motion& motion, bool is_still) {
  const Timeline& timeline = motion.clip.timeline;
  const std::size_t num_frames = motion.clip.num_frames;
  Json json = {
      {"num_frames", num_frames},
      {"is_still", is_still},
      {"first_frame_number", timeline.first_frame_number},
      {"duration", is_still ? Json(0) : number(duration(timeline, num_frames))},
      {"frame_time", number(own_times(timeline).empty() ? time_of_frame(timeline, 1)
                                                        : median_step(own_times(timeline)))}};
  Json times;
  for (const double seconds : own_times(timeline)) times.push_back(number(seconds));
  json["own_times"] = std::move(times);
  return json;
}

Json json_of(const OptionInfo& info) {
  constexpr const char* kTypes[] = {"flag", "number", "count", "choice", "text", "file"};
  Json json = {{"name", info.name},
               {"type", kTypes[static_cast<std::size_t>(info.type)]},
               {"value_name", info.value_name},
               {"help", info.help},
               {"default", info.default_word},
               {"is_required", info.is_required},
               {"separator", info.separator == 0 ? "" : std::string(1, info.separator)}};
  json["choices"] = Json::array();
  for (const std::string_view choice : info.choices) json["choices"].push_back(choice);
  const bool has_least = info.least > std::numeric_limits<double>::lowest();
  json["least"] = has_least ? Json(info.least) : Json();
  json["most"] = info.most < std::numeric_limits<double>::max() ? Json(info.most) : Json();
  return json;
}

template <class Table>
Json options_of(const Table& table) {
  Json json = Json::array();
  for (const auto& option : table) json.push_back(json_of(option.info));
  return json;
}

Json json_of(const OperationInfo& info, const OperationForm& form) {
  if (form.apply == nullptr) return nullptr;
  return {{"usage", usage_of(info, form)}, {"parameters", options_of(form.parameters)}};
}

Json json_of(const Format& format) {
  Json json = {{"name", format.name}, {"description", format.description}};
  json["extensions"] = Json::array();
  for (const std::string_view extension : format.extensions) {
    json["extensions"].push_back(extension);
  }
  json["is_read"] = format.read != nullptr;
  json["is_written"] = is_written(format);
  json["writes_poses"] = format.write_poses != nullptr;
  json["takes_skeleton"] = format.takes_skeleton;
  json["read_options"] = options_of(format.read_options);
  json["write_options"] = options_of(format.write_options);
  json["adapt_options"] = Json::array();
  for (const AdaptOption& adapting : adapt_options()) {
    const bool is_word = adapting.option.set != nullptr;  // others name files for the command
    if (is_word && adapting.is_for(format) && is_written(format)) {
      json["adapt_options"].push_back(json_of(adapting.option.info));
    }
  }
  return json;
}

}  // namespace

Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

Json json_of(const Diagnostic& diagnostic) {
  return {{"file", diagnostic.place.source},   {"line", diagnostic.place.line},
          {"column", diagnostic.place.column}, {"severity", severity_name(diagnostic.severity)},
          {"code", diagnostic.code},           {"message", diagnostic.message},
          {"excerpt", diagnostic.excerpt},     {"caret", diagnostic.caret}};
}

Json json_of(const Diagnostics& diagnostics) {
  constexpr std::size_t kMost = 1000;  // a person reads no more
  Json json = Json::array();
  for (const Diagnostic* item : diagnostics.by_place()) {
    if (json.size() < kMost) json.push_back(json_of(*item));
  }
  return json;
}

namespace {

/// Whether it is known where the figure is: the joint values alone of a robot do not say it.
bool has_place(const Slot& slot) {
  const std::optional<BodyMotion>& recorded = slot.table.placed.recorded;
  return !recorded || find_component(*recorded, ComponentKind::Poses, kLinkPosition) != nullptr;
}

}  // namespace

Json describe(const Slot& slot) {
  const Motion& motion = motion_of(slot);
  const Skeleton& skeleton = motion.skeleton;
  Json json = {{"path", slot.opening.path},
               {"format", slot.source.format},
               {"kind", kind_name(slot.source)},
               {"skeleton", slot.opening.skeleton},
               {"servo_map", slot.opening.servo_map},
               {"project", slot.opening.project},
               {"companions", slot.opened},
               {"options", slot.opening.options},
               {"has_frames", retime::has_frames(slot.current)},
               {"is_robot", is_of_robot(slot)},
               {"has_place", has_place(slot)},
               {"lacks", slot.lacks},
               {"angle_unit", skeleton.angle_unit == AngleUnit::Degrees ? "degrees" : "radians"},
               {"metres_per_unit", number(skeleton.metres_per_unit)}};
  json["facts"] = Json::array();
  for (const Fact& fact : facts_of(slot.source)) {
    if (!fact.words.empty()) json["facts"].push_back(fact.words);
  }
  json["joints"] = joints_of(skeleton, is_of_robot(slot));
  json["num_coordinates"] = skeleton.coordinates.size();
  json["time"] = time_of(motion, slot.table.options.rest);
  json["extent"] = box(world_extent(skeleton, motion.clip));
  json.update(evidence_of(motion));
  json["source_frames"] = Json::array();
  for (const double frame : slot.source_frames) json["source_frames"].push_back(frame);
  json["source_start"] = number(start_of(slot.clock));
  json["blocks"] = Json::array();
  for (const PlayedBlock& block : slot.blocks) {
    json["blocks"].push_back(
        {{"frame", block.tick}, {"number", block.number}, {"name", block.name}});
  }
  return json;
}

Json tables() {
  Json json;
  for (const Format& format : formats()) json["formats"].push_back(json_of(format));
  for (const OperationInfo& info : operations()) {
    json["operations"].push_back({{"name", info.name},
                                  {"help", info.help},
                                  {"needs_motion", info.needs_motion},
                                  {"works_on_components", info.works_on_components},
                                  {"form", json_of(info, info.form)},
                                  {"flow_form", json_of(info, info.flow_form)}});
  }
  Json warp = options_of(retime::warp_options());
  for (const Json& option : options_of(retime::retime_options())) warp.push_back(option);
  json["warp_options"] = std::move(warp);
  return json;
}

}  // namespace kinefile::page
