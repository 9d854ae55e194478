// SPDX-License-Identifier: MIT
#include "formats/csv/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/words.hpp"
#include "text/numbers.hpp"

namespace kinefile::csv {
namespace {

constexpr std::array<std::string_view, 7> kPoseChannels = {"x", "y", "z", "qw", "qx", "qy", "qz"};
/// The columns of a robot's root, before those of its joints.

/// The name and the channel of a column, "HEAD.q" or "HEAD".
std::pair<std::string, std::string> split_name(const std::string& header) {
  const std::size_t dot = header.rfind('.');
  const std::string channel = dot == std::string::npos ? "" : lowered(header.substr(dot + 1));
  const bool is_known = channel == "q" || std::find(kPoseChannels.begin(), kPoseChannels.end(),
                                                    channel) != kPoseChannels.end();
  if (!is_known) return {header, "q"};
  return {header.substr(0, dot), channel};
}

/// The content of a column's values: JointEffort3 belongs to JointEffort, any other name is a joint
/// value.
std::string content_of(const std::string& name) {
  constexpr std::array<std::string_view, 6> kContents = {"JointVelocity", "JointAcceleration",
                                                         "JointEffort",   "JointTorque",
                                                         "JointForce",    "JointTemperature"};
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  const std::string content = name.substr(0, digits);
  const bool is_content = digits < name.size() &&
                          std::find(kContents.begin(), kContents.end(), content) != kContents.end();
  return is_content ? content : std::string(kJointDisplacement);
}

bool is_of_a_figure(const std::string& header) {
  const std::string lower = lowered(header);
  return lower.ends_with("position") || lower.ends_with("rotation") || lower.ends_with("scale");
}

Group& group_of(std::vector<Group>& groups, ComponentKind kind, const std::string& content) {
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
    return group.kind == kind && group.content == content;
  });
  if (found != groups.end()) return *found;
  groups.push_back({kind, content, {}, {}});
  return groups.back();
}

/// The number of consecutive columns that are x, y, z, qw, ... of the same name.
std::size_t count_of_pose_channels(const std::vector<text::CsvField>& header, std::size_t first) {
  const std::string name = split_name(header[first].text).first;
  std::size_t count = 0;
  while (count < kPoseChannels.size() && first + count < header.size() &&
         split_name(header[first + count].text) ==
             std::pair(name, std::string(kPoseChannels[count]))) {
    ++count;
  }
  return count;
}

/// Adds the component that begins at a column to its group.
/// \returns its number of columns; 0 after an error
std::size_t take_columns(const TableReader& reader, const std::vector<text::CsvField>& header,
                         std::size_t first, std::vector<Group>& groups) {
  const auto split = split_name(header[first].text);
  const std::string& name = split.first;
  if (is_of_a_figure(header[first].text)) {
    reader.error("CSV003",
                 fmt::format("expected columns of a robot's joints (NAME.q) or links (NAME.x to "
                             "NAME.qz), found {}: a figure's channels need its skeleton",
                             text::quoted(header[first].text)),
                 header[first].at);
    return 0;
  }
  if (split.second == "q") {
    Group& group = group_of(groups, ComponentKind::Values, content_of(name));
    group.columns.push_back(first);
    group.names.push_back(name);
    return 1;
  }
  const std::size_t count = count_of_pose_channels(header, first);
  const bool is_pose = count == kPoseChannels.size();
  if (!is_pose && count != 3) {
    reader.error("CSV003",
                 fmt::format("expected {0}.x, {0}.y, {0}.z, and of a link {0}.qw to {0}.qz, in "
                             "this order, found {1} of them",
                             name, count),
                 header[first].at);
    return 0;
  }
  const bool is_second = std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
    return group.kind == ComponentKind::Vectors && group.content == name;
  });
  if (!is_pose && is_second) {
    reader.error("CSV003", fmt::format("expected each point once, found {} again", name),
                 header[first].at);
    return 0;
  }
  Group& group = is_pose ? group_of(groups, ComponentKind::Poses, std::string(kLinkPosition))
                         : group_of(groups, ComponentKind::Vectors, name);
  for (std::size_t k = 0; k < count; ++k) group.columns.push_back(first + k);
  if (is_pose) group.names.push_back(name);
  return count;
}

/// Groups columns by component. Empty after an error.
std::vector<Group> grouped(const TableReader& reader, const std::vector<text::CsvField>& header) {
  if (lowered(header[0].text) != "time" || header.size() < 2) {
    reader.error("CSV002",
                 fmt::format("expected a header of 'time' and names of columns, found {}{}",
                             text::quoted(header[0].text),
                             header[0].text.find(';') != std::string::npos
                                 ? "; commas separate fields, and decimals have points"
                                 : ""),
                 header[0].at);
    return {};
  }
  std::vector<Group> groups;
  for (std::size_t column = 1; column < header.size();) {
    const std::size_t count = take_columns(reader, header, column, groups);
    if (count == 0) return {};
    column += count;
  }
  return groups;
}

/// The ids of a robot's joints by the names of their columns, of all links that have them, and of
/// their joints. A robot's motion, as opposed to a body motion, calls the column of an id without a
/// joint by its root and the id: "WAIST.q3".
std::map<std::string, std::size_t> ids_of(const Skeleton& skeleton) {
  std::map<std::string, std::size_t> ids;
  const std::vector<std::string> names = names_of_value_columns(skeleton);
  for (std::size_t id = 0; id < names.size(); ++id) ids.emplace(names[id], id);
  const std::vector<std::string> of_motions = column_names(skeleton);
  for (std::size_t id = 0; id < names.size(); ++id) {
    ids.emplace(of_motions[kRootColumns + id], id);
  }
  const auto columns = value_columns(skeleton);
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (columns[j] && *columns[j] >= kRootColumns) {
      ids.emplace(skeleton.joints[j].name, *columns[j] - kRootColumns);
    }
  }
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const std::string& name = skeleton.joints[j].joint_name;
    if (columns[j] && *columns[j] >= kRootColumns && !name.empty()) {
      ids.emplace(name, *columns[j] - kRootColumns);
    }
  }
  return ids;
}

/// Puts columns of joints in the order of the robot's joint ids.
void put_in_order(const TableReader& reader, const std::vector<text::CsvField>& header,
                  Group& group) {
  const Skeleton& robot = skeleton_of(*reader.options.skeleton);
  const std::map<std::string, std::size_t> ids = ids_of(robot);
  std::vector<std::size_t> ordered(robot.coordinates.size() - kRootColumns, kNoColumn);
  for (const std::size_t column : group.columns) {
    const text::CsvField& field = header[column];
    const auto id = ids.find(split_name(field.text).first);
    const bool is_known = id != ids.end() && id->second < ordered.size();
    if (!is_known || ordered[id->second] != kNoColumn) {
      const std::string found = text::quoted(field.text);
      reader.error("CSV008",
                   is_known
                       ? fmt::format("expected each joint of the robot once, found {} again", found)
                       : fmt::format("expected the name of a joint of the robot, found {}", found),
                   field.at);
      return;
    }
    ordered[id->second] = column;
  }
  for (const FollowingColumn& one : following_columns(robot)) {
    const DegreeOfFreedom& dof = robot.joints[one.joint].dofs[0];
    const std::size_t part = one.column - kRootColumns;
    if (ordered[part] != kNoColumn || dof.coordinate < kRootColumns) continue;
    group.following.push_back({part, dof.coordinate - kRootColumns, dof});
  }
  const auto num_missing = std::count(ordered.begin(), ordered.end(), kNoColumn) -
                           static_cast<std::ptrdiff_t>(group.following.size());
  if (num_missing > 0) {
    text::report(reader.source, reader.diagnostics, Severity::Warning, "CSV009",
                 fmt::format("the table has no column for {} of the robot's {} joints; they stay "
                             "at 0",
                             num_missing, ordered.size()),
                 header[0].at);
  }
  group.columns = std::move(ordered);
  group.names.clear();  // the robot has the names
}

/// The fields without the blanks around their texts.
std::vector<text::CsvField> without_blanks(std::vector<text::CsvField> fields) {
  for (text::CsvField& field : fields) {
    while (!field.text.empty() && text::is_blank(field.text.back())) field.text.pop_back();
    const auto first = std::find_if_not(field.text.begin(), field.text.end(), text::is_blank);
    field.text.erase(field.text.begin(), first);
  }
  return fields;
}

/// Whether the skeleton is that of a robot whose joints have ids.
bool has_joint_ids(const kinefile::ReadOptions& options) {
  if (options.skeleton == nullptr || !has_skeleton(*options.skeleton)) return false;
  const Skeleton& skeleton = skeleton_of(*options.skeleton);
  return !skeleton.joints.empty() && moves_freely(skeleton.joints[0]) &&
         skeleton.coordinates.size() >= kRootColumns;
}

}  // namespace

std::vector<Group> parse_header(const TableReader& reader,
                                const std::vector<text::CsvField>& fields) {
  const std::vector<text::CsvField> header = without_blanks(fields);
  std::vector<Group> groups = grouped(reader, header);
  for (Group& group : groups) {
    const bool is_of_joints = group.kind == ComponentKind::Values &&
                              group.content == kJointDisplacement && has_joint_ids(reader.options);
    if (is_of_joints) put_in_order(reader, header, group);
  }
  return groups;
}

}  // namespace kinefile::csv
