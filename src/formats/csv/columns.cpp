// SPDX-License-Identifier: MIT
#include "formats/csv/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>

#include "base/words.hpp"
#include "model/part_names.hpp"
#include "text/numbers.hpp"

namespace kinefile::csv {
namespace {

constexpr std::array<std::string_view, 7> kPoseChannels = {"x", "y", "z", "qw", "qx", "qy", "qz"};
constexpr std::array<std::string_view, 6> kRpyChannels = {"x", "y", "z", "roll", "pitch", "yaw"};
constexpr std::size_t kPointChannels = 3;

/// A column's header at its last dot.
struct SplitHeader {
  std::string name;     ///< all of it if there is no dot
  std::string channel;  ///< in lower case
};

SplitHeader split_at_dot(const std::string& header) {
  const std::size_t dot = header.rfind('.');
  if (dot == std::string::npos) return {header, ""};
  return {header.substr(0, dot), lowered(header.substr(dot + 1))};
}

/// The name of a column of values, "NAME.q" or "NAME".
std::string name_of_values(const std::string& header) {
  SplitHeader split = split_at_dot(header);
  return split.channel == "q" ? std::move(split.name) : header;
}

/// Whether a channel is q, with or without a joint id, "q3".
bool is_of_joint_id(std::string_view channel) {
  return channel.starts_with('q') &&
         channel.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Whether a column is a figure's: a channel of BVH or a degree of freedom of ASF, but for "l",
/// which names of left joints end in.
bool is_of_a_figure(const std::string& header) {
  constexpr std::array<std::string_view, 6> kDofWords = {"tx", "ty", "tz", "rx", "ry", "rz"};
  const std::string lower = lowered(header);
  return lower.ends_with("position") || lower.ends_with("rotation") || lower.ends_with("scale") ||
         is_one_of(split_at_dot(header).channel, kDofWords);
}

/// Whether the skeleton is that of a robot whose joints have ids.
bool has_joint_ids(const kinefile::ReadOptions& options) {
  if (options.skeleton == nullptr || !has_skeleton(*options.skeleton)) return false;
  const Skeleton& skeleton = skeleton_of(*options.skeleton);
  return !skeleton.joints.empty() && moves_freely(skeleton.joints[0]) &&
         skeleton.coordinates.size() >= kRootColumns;
}

/// Sorts the columns of a table into components.
class ColumnSorter {
 public:
  ColumnSorter(const TableReader& reader, const std::vector<text::CsvField>& header)
      : reader_(reader), header_(header) {}

  /// Empty after an error.
  std::vector<Group> sort() {
    for (std::size_t column = 1; column < header_.size();) {
      const std::size_t count = take_columns(column);
      if (count == 0) return {};
      column += count;
    }
    if (!are_channels_known()) return {};
    return std::move(groups_);
  }

 private:
  std::size_t error(std::string message, std::size_t column) const {
    reader_.error("CSV003", std::move(message), header_[column].at);
    return 0;
  }

  Group& group_of(ComponentKind kind, const std::string& content) {
    const auto [at, is_new] = index_.try_emplace({kind, content}, groups_.size());
    if (is_new) groups_.push_back({kind, content, {}, {}});
    return groups_[at->second];
  }

  /// Whether the table has no such part yet.
  bool is_first(ComponentKind kind, const std::string& name) {
    return known_.insert({kind, name}).second;
  }

  /// The number of consecutive columns that are these channels of one name.
  std::size_t count_channels(std::size_t first, std::span<const std::string_view> channels) const {
    const std::string name = split_at_dot(header_[first].text).name;
    std::size_t count = 0;
    for (; count < channels.size() && first + count < header_.size(); ++count) {
      const SplitHeader split = split_at_dot(header_[first + count].text);
      if (split.name != name || split.channel != channels[count]) break;
    }
    return count;
  }

  /// Adds the part of a component that begins at a column.
  /// \returns its number of columns; 0 after an error
  std::size_t take_columns(std::size_t first) {
    const std::string& header = header_[first].text;
    const SplitHeader split = split_at_dot(header);
    if (split.name.empty()) {
      return error(fmt::format("expected the name of a column, found {}",
                               header.empty() ? "nothing" : text::quoted(header)),
                   first);
    }
    if (is_of_a_figure(header)) {
      return error(fmt::format("expected columns of a robot's joints (NAME.q) or links (NAME.x to "
                               "NAME.qz), found {}: a figure's channels need its skeleton",
                               text::quoted(header)),
                   first);
    }
    return is_one_of(split.channel, kPoseChannels) ? take_place(first) : take_values(first);
  }

  std::size_t take_values(std::size_t column) {
    const std::string name = name_of_values(header_[column].text);
    // With a robot, joints are matched by their names, which tells of one that comes again.
    if (!is_first(ComponentKind::Values, name) && !has_joint_ids(reader_.options)) {
      return error(fmt::format("expected each column once, found {} again",
                               text::quoted(header_[column].text)),
                   column);
    }
    const auto content = content_of_numbered_part(name);
    Group& group =
        group_of(ComponentKind::Values, content.value_or(std::string(kJointDisplacement)));
    group.columns.push_back(column);
    group.names.push_back(name);
    return 1;
  }

  /// Adds a pose or a point.
  std::size_t take_place(std::size_t first) {
    const std::string name = split_at_dot(header_[first].text).name;
    const std::size_t count = count_channels(first, kPoseChannels);
    if (count_channels(first, kRpyChannels) == kRpyChannels.size()) {
      return take_pose(first, name, PoseForm::RollPitchYaw);
    }
    if (count == kPoseChannels.size()) return take_pose(first, name, PoseForm::Quaternion);
    if (count != kPointChannels) {
      return error(fmt::format("expected {0}.x, {0}.y, {0}.z, and of a link {0}.qw to {0}.qz, in "
                               "this order, found {1} of them",
                               name, count),
                   first);
    }
    if (!is_first(ComponentKind::Vectors, name)) {
      return error(fmt::format("expected each point once, found {} again", name), first);
    }
    add_columns(group_of(ComponentKind::Vectors, name), first, count);
    return count;
  }

  std::size_t take_pose(std::size_t first, const std::string& name, PoseForm form) {
    if (!is_first(ComponentKind::Poses, name)) {
      return error(fmt::format("expected each link once, found {} again", name), first);
    }
    const auto content = content_of_numbered_part(name);
    Group& group = group_of(ComponentKind::Poses, content.value_or(std::string(kLinkPosition)));
    if (group.names.empty()) group.pose_form = form;
    if (group.pose_form != form) {
      return error(fmt::format("expected all links with a quaternion, or all with roll, pitch and "
                               "yaw, found '{}' with the other",
                               name),
                   first);
    }
    const std::size_t count =
        form == PoseForm::Quaternion ? kPoseChannels.size() : kRpyChannels.size();
    add_columns(group, first, count);
    group.names.push_back(name);
    return count;
  }

  static void add_columns(Group& group, std::size_t first, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) group.columns.push_back(first + k);
  }

  /// Looks at columns of values whose names end in something like a channel, but for q and a
  /// joint id: that of a link or point is an error, and beside columns NAME.q it is worth a note.
  bool are_channels_known() const {
    const bool has_channels = std::any_of(
        header_.begin() + 1, header_.end(),
        [](const text::CsvField& field) { return split_at_dot(field.text).channel == "q"; });
    for (std::size_t column = 1; column < header_.size(); ++column) {
      const SplitHeader split = split_at_dot(header_[column].text);
      const bool is_value = known_.contains({ComponentKind::Values, header_[column].text});
      if (!is_value || split.channel.empty() || is_of_joint_id(split.channel)) continue;
      const bool is_of_place = known_.contains({ComponentKind::Poses, split.name}) ||
                               known_.contains({ComponentKind::Vectors, split.name});
      if (is_of_place) {
        error(fmt::format("expected another column, found {}: the columns of {} are complete",
                          text::quoted(header_[column].text), text::quoted(split.name)),
              column);
        return false;
      }
      if (has_channels) {
        text::report(reader_.source, reader_.diagnostics, Severity::Note, "CSV020",
                     fmt::format("{} is read as the name of a joint, beside columns NAME.q",
                                 text::quoted(header_[column].text)),
                     header_[column].at);
      }
    }
    return true;
  }

  const TableReader& reader_;
  const std::vector<text::CsvField>& header_;
  std::vector<Group> groups_;
  std::map<std::pair<ComponentKind, std::string>, std::size_t> index_;  ///< of groups
  std::set<std::pair<ComponentKind, std::string>> known_;               ///< the parts
};

/// What a table lacks that begins with this field and not with a header; may be empty.
std::string_view advice_for(std::string_view field) {
  if (field.find(';') != std::string_view::npos) {
    return "; commas separate fields, and decimals have points";
  }
  const bool is_number = text::parse_number(field).fault == text::NumberFault::None;
  return is_number ? "; numbers alone do not say what their columns are" : "";
}

/// Groups columns by component. Empty after an error.
std::vector<Group> grouped(const TableReader& reader, const std::vector<text::CsvField>& header) {
  if (lowered(header[0].text) != "time" || header.size() < 2) {
    reader.error("CSV002",
                 fmt::format("expected a header of 'time' and names of columns, found {}{}",
                             text::quoted(header[0].text), advice_for(header[0].text)),
                 header[0].at);
    return {};
  }
  return ColumnSorter(reader, header).sort();
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
    const auto id = ids.find(name_of_values(field.text));
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
