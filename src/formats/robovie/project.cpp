// SPDX-License-Identifier: MIT
#include "formats/robovie/project.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/words.hpp"
#include "formats/robovie/codes.hpp"
#include "formats/robovie/decode.hpp"
#include "text/numbers.hpp"

namespace kinefile {

std::vector<std::int16_t> base_values(const RobotProject& project) {
  if (project.base_pose < project.base_poses.size()) {
    return project.base_poses[project.base_pose].values;
  }
  return std::vector<std::int16_t>(project.sliders.size());
}

namespace robovie {
namespace {

/// The files that a project names.
struct ProjectFiles {
  std::string sliders, rom, base_poses, map;
};

/// Opens a file of a project; reports a missing one.
std::optional<CompanionFile> open_file(const Reader& project, const std::string& name,
                                       std::string_view setting, Severity severity) {
  const char* const code = severity == Severity::Error ? code::kNoSliders : code::kMissingFile;
  const char* const at = project.source.text().data();
  if (name.empty()) {
    project.tell(severity, code, fmt::format("expected {}:, found none", setting), at);
    return std::nullopt;
  }
  auto file =
      project.options.companions.open ? project.options.companions.open(name) : std::nullopt;
  if (!file) {
    project.tell(severity, code,
                 fmt::format("the file {} ({}) is not there", text::quoted(name), setting), at);
  }
  return file;
}

/// Reads a file of a project with one of the functions above.
void read_part(const Reader& project, const std::string& name, std::string_view setting,
               Severity severity, void (*read)(const Reader&, RobotProject&), RobotProject& out) {
  const auto file = open_file(project, name, setting, severity);
  if (!file) return;
  kinefile::ReadOptions options = project.options;
  options.source_name = file->name;
  options.encoding.clear();
  const auto decoded = decode_motion(file->bytes, options, project.diagnostics);
  if (!decoded) return;
  const text::Source source(file->name, decoded->view());
  read(Reader{source, options, project.diagnostics}, out);
}

ProjectFiles read_names(const Reader& reader, RobotProject& project) {
  ProjectFiles files;
  bool is_project = false;
  for_each_line(reader, [&](const ProjectLine& line) {
    const std::string text(line.text(0));
    is_project = is_project || line.key() == "MODELNAME" || line.key() == "SLDINI";
    if (line.key() == "MODELNAME") project.name = text;
    if (line.key() == "SLDINI") files.sliders = text;
    if (line.key() == "ROMINI") files.rom = text;
    if (line.key() == "DEFPOSINI") files.base_poses = text;
    if (line.key() == "MAPINI") files.map = text;
  });
  if (!is_project) {
    reader.error(code::kNotAProject, "expected a robot project (MODELNAME:, SLDINI:), found none",
                 reader.source.text().data());
  }
  return files;
}

Result<RobotProject> read_project_alone(std::string_view bytes,
                                        const kinefile::ReadOptions& options,
                                        Diagnostics& diagnostics) {
  const auto decoded = decode_motion(bytes, options, diagnostics);
  if (!decoded) return fail(decoded.error());
  const text::Source source(options.source_name, decoded->view());
  const Reader reader{source, options, diagnostics};
  RobotProject project;
  const ProjectFiles files = read_names(reader, project);
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  // Sliders first, because the other files add data to them.
  read_part(reader, files.sliders, "SLDINI", Severity::Error, read_sliders, project);
  read_part(reader, files.rom, "ROMINI", Severity::Warning, read_rom, project);
  read_part(reader, files.base_poses, "DEFPOSINI", Severity::Warning, read_base_poses, project);
  read_part(reader, files.map, "MAPINI", Severity::Warning, read_map, project);
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  return project;
}

}  // namespace

std::string_view ProjectLine::text(std::size_t i) const {
  return i < setting_.fields.size() ? setting_.fields[i].text : std::string_view();
}

bool ProjectLine::has(std::size_t num_fields) const {
  if (setting_.fields.size() >= num_fields) return true;
  reader_.warn(
      code::kBadSetting,
      fmt::format("expected {} setting{} after {}:, found {}; the line is passed over", num_fields,
                  num_fields == 1 ? "" : "s", setting_.key, setting_.fields.size()),
      setting_.at);
  return false;
}

void ProjectLine::tell_bad_number(std::size_t i, std::string_view expected) const {
  const std::string_view found = text(i);
  reader_.warn(code::kBadNumber,
               fmt::format("expected {}, found {}; it is passed over", expected,
                           found.empty() ? "nothing" : shown(found)),
               found.data() != nullptr ? found.data() : setting_.at);
}

std::optional<int> ProjectLine::integer(std::size_t i, int minimum, int maximum) const {
  const auto value = parse_integer(text(i));
  if (value && *value >= minimum && *value <= maximum) return value;
  tell_bad_number(i, fmt::format("a whole number from {} to {}", minimum, maximum));
  return std::nullopt;
}

std::optional<double> ProjectLine::decimal(std::size_t i) const {
  const text::Number number = text::parse_number(trimmed(text(i)));
  if (number.fault == text::NumberFault::None && std::isfinite(number.value)) return number.value;
  tell_bad_number(i, "a number");
  return std::nullopt;
}

void for_each_line(const Reader& reader, const std::function<void(const ProjectLine&)>& take) {
  Lines lines(reader.source.text());
  Setting setting;
  for (std::string_view line; lines.next(line);) {
    if (trimmed(line).starts_with('#')) continue;
    split_setting(line, setting);
    if (!setting.key.empty()) take(ProjectLine(reader, setting));
  }
}

}  // namespace robovie

Result<RobotProject> read_project(std::string_view bytes, const kinefile::ReadOptions& options,
                                  Diagnostics& diagnostics) {
  Diagnostics own;
  own.warnings_are_errors = diagnostics.warnings_are_errors;
  auto project = robovie::read_project_alone(bytes, options, own);
  if (!project && !own.has_errors()) own.add(project.error());
  if (project && own.has_errors()) project = fail(own.first_error());
  diagnostics.append(std::move(own));
  return project;
}

}  // namespace kinefile
