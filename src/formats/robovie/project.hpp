// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/robovie/reader.hpp"
#include "kinefile/robot_project.hpp"

namespace kinefile::robovie {

/// A line of a project file, with the context for reading it. Other words are ignored: a project
/// contains much that only the editor needs.
class ProjectLine {
 public:
  ProjectLine(const Reader& reader, const Setting& setting) : reader_(reader), setting_(setting) {}

  std::string_view key() const { return setting_.key; }
  const char* at() const { return setting_.at; }
  std::size_t num_fields() const { return setting_.fields.size(); }
  /// The text of a field; empty if there is no such field.
  std::string_view text(std::size_t i) const;
  /// Whether there are this many settings; otherwise a warning RPJ004.
  bool has(std::size_t num_fields) const;
  /// A number within a range; otherwise empty, with a warning RPJ005.
  std::optional<int> integer(std::size_t i, int minimum, int maximum) const;
  std::optional<double> decimal(std::size_t i) const;
  const Reader& reader() const { return reader_; }

 private:
  void tell_bad_number(std::size_t i, std::string_view expected) const;

  const Reader& reader_;
  const Setting& setting_;
};

/// Calls a function for each line `KEY:[...]` of a text.
void for_each_line(const Reader& reader, const std::function<void(const ProjectLine&)>& take);

/// medit_sld.ini: the sliders.
/// \errors RPJ002
void read_sliders(const Reader& reader, RobotProject& project);
/// medit_rom.ini: servos, clock, which sliders jump.
void read_rom(const Reader& reader, RobotProject& project);
/// medit_defpos.ini: base poses.
void read_base_poses(const Reader& reader, RobotProject& project);
/// medit_map.ini: sounds.
void read_map(const Reader& reader, RobotProject& project);

}  // namespace kinefile::robovie
