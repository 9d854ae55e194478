// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>

#include "command.hpp"
#include "info_flow.hpp"
#include "json_output.hpp"
#include "options.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

struct Info {
  std::vector<std::string> files;
  bool is_tree = false;
  bool is_json = false;
  bool has_poses = false;
  Reading reading;
};

void print_subtree(const Skeleton& skeleton, const std::vector<std::vector<std::size_t>>& children,
                   std::string& out) {
  struct Line {
    std::size_t joint;
    std::string indent;
    bool is_root;
    bool is_last;
  };
  std::vector<Line> waiting;
  for (std::size_t j = skeleton.joints.size(); j-- > 0;) {
    if (skeleton.joints[j].parent == kNoParent) waiting.push_back({j, "", true, true});
  }
  while (!waiting.empty()) {
    const Line line = std::move(waiting.back());
    waiting.pop_back();
    out += fmt::format("{}{}{}\n", line.indent, line.is_root ? "" : "+- ",
                       skeleton.joints[line.joint].name);
    const std::string indent = line.is_root ? "" : line.indent + (line.is_last ? "   " : "|  ");
    const auto& below = children[line.joint];
    for (std::size_t c = below.size(); c-- > 0;) {
      waiting.push_back({below[c], indent, false, c + 1 == below.size()});
    }
  }
}

std::string tree_of(const Skeleton& skeleton) {
  std::string tree;
  print_subtree(skeleton, children_of_joints(skeleton), tree);
  return tree;
}

/// The orders in which joints turn and how many have each: "ZXY 20, Z 2".
std::string rotation_orders(const Skeleton& skeleton) {
  std::map<std::string, std::size_t> counts;
  for (const Joint& joint : skeleton.joints) {
    std::string order;
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::Rotation) continue;
      Eigen::Index axis = 0;
      const bool is_coordinate_axis = dof.axis.cwiseAbs().maxCoeff(&axis) == 1;
      order += is_coordinate_axis ? "XYZ"[axis] : '?';
    }
    if (!order.empty()) ++counts[order];
  }
  std::string text;
  for (const auto& [order, count] : counts) {
    text += fmt::format("{}{} on {} {}", text.empty() ? "" : ", ", order, count,
                        count == 1 ? "joint" : "joints");
  }
  return text.empty() ? "none" : text;
}

std::size_t joints_with(const Skeleton& skeleton, DofKind kind) {
  return static_cast<std::size_t>(
      std::count_if(skeleton.joints.begin(), skeleton.joints.end(), [kind](const Joint& joint) {
        return std::any_of(joint.dofs.begin(), joint.dofs.end(),
                           [kind](const DegreeOfFreedom& dof) { return dof.kind == kind; });
      }));
}

/// How the file is written, in the words of its format.
std::string dialect_of(const Document& document) {
  std::string text;
  for (const Fact& fact : facts_of(document)) {
    if (!fact.words.empty()) text += (text.empty() ? "" : ", ") + fact.words;
  }
  return text;
}

std::string box_text(const Box& box) {
  if (box.min.x() > box.max.x()) return "nothing finite";
  return fmt::format("x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g}", box.min.x(),
                     box.max.x(), box.min.y(), box.max.y(), box.min.z(), box.max.z());
}

/// What the components of a body motion are called in the file format, and their sizes.
std::string component_text(const Document& document, const Component& component) {
  if (component.kind == ComponentKind::Other) {
    const std::string type = component_type(document, component);
    return fmt::format("{}, kept as it stands", type.empty() ? "of unknown type" : type);
  }
  constexpr std::string_view kParts[] = {"value", "pose", "vector"};
  const std::string_view part = kParts[static_cast<std::size_t>(component.kind)];
  const double rate = frame_rate(component.timeline);
  const bool has_times = has_own_times(component.timeline);
  return fmt::format("{}: {} frames of {} {}{}{}{}{}", component.content, component.num_frames,
                     component.num_parts, part, component.num_parts == 1 ? "" : "s",
                     has_times ? ", at times of their own" : "",
                     rate > 0 ? fmt::format(", {:.6g} fps, duration {} s", rate,
                                            duration(component.timeline, component.num_frames))
                              : "",
                     component.is_root_relative ? ", relative to the root link" : "");
}

std::string text_of(const std::string& path, const BodyMotion& motion, const Document& document) {
  std::string text = fmt::format("{}: {} {}\n", path, document.format, kind_name(document));
  text += fmt::format("  {:<12}{}\n", "dialect", dialect_of(document));
  for (const Component& component : motion.components) {
    text += fmt::format("  {:<12}{}\n", "component", component_text(document, component));
  }
  return text;
}

std::string text_of(const std::string& path, const Document& document) {
  if (const BodyMotion* motion = std::get_if<BodyMotion>(&document.content)) {
    return text_of(path, *motion, document);
  }
  const Skeleton& skeleton = skeleton_of(document);
  const Motion* motion = std::get_if<Motion>(&document.content);
  std::string text = fmt::format("{}: {} {}\n", path, document.format, kind_name(document));
  const auto line = [&text](std::string_view key, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", key, value);
  };
  line("dialect", dialect_of(document));
  const std::size_t num_roots = static_cast<std::size_t>(
      std::count_if(skeleton.joints.begin(), skeleton.joints.end(),
                    [](const Joint& joint) { return joint.parent == kNoParent; }));
  line("joints", fmt::format("{} ({} {}, {} {})", skeleton.joints.size(), num_roots,
                             num_roots == 1 ? "root" : "roots", num_tips(skeleton),
                             num_tips(skeleton) == 1 ? "tip" : "tips"));
  line("dofs", fmt::format("{} in {} columns", num_dofs(skeleton), skeleton.coordinates.size()));
  line("rotations", rotation_orders(skeleton));
  line("positions", fmt::format("on {} of {} joints", joints_with(skeleton, DofKind::Translation),
                                skeleton.joints.size()));
  if (motion != nullptr) {
    const Timeline& timeline = motion->clip.timeline;
    const auto first = timeline.first_frame_number;
    line("frames",
         fmt::format("{}{}", motion->clip.num_frames,
                     first == 0 ? "" : fmt::format(", the first is {} in the file", first)));
    line("rate",
         fmt::format("{:.6g} fps, frame time {} s{}", frame_rate(timeline), frame_time(timeline),
                     has_own_times(timeline) ? ", frames at times of their own" : ""));
    line("duration", fmt::format("{} s", duration(timeline, motion->clip.num_frames)));
  }
  line("units",
       fmt::format("{}, length unit {}",
                   skeleton.angle_unit == AngleUnit::Degrees ? "degrees" : "radians",
                   skeleton.metres_per_unit > 0 ? fmt::format("{} m", skeleton.metres_per_unit)
                                                : "not in the file"));
  line("rest extent", box_text(world_extent(skeleton, rest_clip(skeleton))));
  if (motion != nullptr) line("extent", box_text(world_extent(skeleton, motion->clip)));
  return text;
}

Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

Json box_json(const Box& box) {
  if (box.min.x() > box.max.x()) return nullptr;
  return {{"min", {box.min.x(), box.min.y(), box.min.z()}},
          {"max", {box.max.x(), box.max.y(), box.max.z()}}};
}

std::string type_of(const Document& document, const Component& component) {
  constexpr const char* kTypes[] = {"MultiValueSeq", "MultiSE3Seq", "Vector3Seq"};
  if (component.kind != ComponentKind::Other) {
    return kTypes[static_cast<std::size_t>(component.kind)];
  }
  return component_type(document, component);
}

Json json_of_component(const Document& document, const Component& component) {
  Json json = {{"type", type_of(document, component)},
               {"content", component.content},
               {"num_parts", component.num_parts},
               {"num_frames", component.num_frames},
               {"frame_rate", number(nominal_frame_rate(component.timeline))}};
  if (component.kind == ComponentKind::Vectors)
    json["is_root_relative"] = component.is_root_relative;
  return json;
}

/// What a body motion has of length and rate: those of its main component.
void add_body(Json& json, const Document& document, const BodyMotion& motion) {
  if (const Component* main = main_component(motion)) {
    json["num_frames"] = main->num_frames;
    json["frame_time"] = number(frame_time(main->timeline));
    json["frame_rate"] = number(nominal_frame_rate(main->timeline));
    json["duration"] = number(duration(main->timeline, main->num_frames));
  }
  json["angle_unit"] = "radians";
  json["metres_per_unit"] = 1;
  json["components"] = Json::array();
  for (const Component& component : motion.components) {
    json["components"].push_back(json_of_component(document, component));
  }
}

Json json_of_document(const std::string& path, const Document& document) {
  Json json = {{"file", path}, {"format", document.format}, {"kind", kind_name(document)}};
  add_facts(json, document);
  if (const BodyMotion* motion = std::get_if<BodyMotion>(&document.content)) {
    add_body(json, document, *motion);
    return json;
  }
  const Skeleton& skeleton = skeleton_of(document);
  json["num_joints"] = skeleton.joints.size();
  json["num_dofs"] = num_dofs(skeleton);
  json["num_columns"] = skeleton.coordinates.size();
  json["num_tips"] = num_tips(skeleton);
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    const Timeline& timeline = motion->clip.timeline;
    json["num_frames"] = motion->clip.num_frames;
    json["first_frame_number"] = timeline.first_frame_number;
    json["frame_time"] = number(frame_time(timeline));
    json["frame_rate"] = number(frame_rate(timeline));
    json["duration"] = number(duration(timeline, motion->clip.num_frames));
    json["extent"] = box_json(world_extent(skeleton, motion->clip));
  }
  json["angle_unit"] = skeleton.angle_unit == AngleUnit::Degrees ? "degrees" : "radians";
  json["metres_per_unit"] = skeleton.metres_per_unit > 0 ? Json(skeleton.metres_per_unit) : Json();
  json["rest_extent"] = box_json(world_extent(skeleton, rest_clip(skeleton)));
  json["joints"] = Json::array();
  for (const Joint& joint : skeleton.joints) {
    const Json parent =
        joint.parent == kNoParent ? Json() : Json(skeleton.joints[joint.parent].name);
    json["joints"].push_back({{"name", joint.name}, {"parent", parent}});
  }
  return json;
}

/// Prints what a flow holds, or adds it to the array for JSON.
void tell_flow(const std::string& name, const Document& document, const Info& info, Json& all) {
  const RobotProject* const project = info.reading.loaded_project.get();
  if (info.is_json) {
    all.push_back(flow_json(name, document, info.has_poses, project));
    return;
  }
  print_data(flow_text(name, document));
  if (info.has_poses) print_data(poses_text(*std::get_if<PoseFlow>(&document.content), project));
}

int run(const Info& info, const Globals& globals) {
  int exit_code = kDone;
  Json all = Json::array();
  for (const std::string& path : info.files) {
    const auto document = load(path, info.reading, globals, exit_code);
    if (!document) continue;
    const std::string name = path == "-" ? "<stdin>" : path;
    const bool is_flow = std::holds_alternative<PoseFlow>(document->content);
    if (info.has_poses && !is_flow) {
      return usage_error(globals, fmt::format("'{}' holds no flow of poses", name));
    }
    if (is_flow && (info.is_json || !info.is_tree)) {
      tell_flow(name, *document, info, all);
    } else if (info.is_json) {
      all.push_back(json_of_document(name, *document));
    } else if (info.is_tree) {
      if (info.files.size() > 1) print_data(fmt::format("{}:\n", name));
      if (!has_skeleton(*document)) {
        return usage_error(globals, fmt::format("'{}' holds no skeleton to draw", name));
      }
      print_data(tree_of(skeleton_of(*document)));
    } else {
      print_data(text_of(name, *document));
    }
  }
  if (info.is_json) print_json(all);
  return finish_reading(info.reading, globals, exit_code);
}

}  // namespace

void add_info(CLI::App& app, Globals& globals) {
  auto info = std::make_shared<Info>();
  CLI::App* command = app.add_subcommand("info", "Tell what files hold");
  command->add_option("FILE", info->files, "Files to read; - is standard input")->required();
  command->add_flag("--tree", info->is_tree, "Draw the hierarchy of joints, and no more");
  command->add_flag("--poses", info->has_poses,
                    "Of a flow of servo poses: also print its poses, with --project in degrees");
  command->add_flag("--json", info->is_json, "Print an array with an object a file");
  add_reading_options(*command, info->reading);
  command->callback(
      [info, &globals] { globals.run = [info, &globals] { return run(*info, globals); }; });
}

}  // namespace kinefile::cli
