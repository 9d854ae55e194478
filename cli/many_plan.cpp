// SPDX-License-Identifier: MIT
#include "many_plan.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "folders.hpp"

namespace kinefile::cli {
namespace {

namespace fs = std::filesystem;

/// A file on the disk, whatever its names.
using Identity = std::pair<dev_t, ino_t>;

std::optional<Identity> identity_of(const std::string& path) {
  struct stat state {};
  if (::stat(path.c_str(), &state) != 0) return {};
  return Identity{state.st_dev, state.st_ino};
}

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool has_extension(const Format& format, const fs::path& path) {
  const auto& all = format.extensions;
  return std::find(all.begin(), all.end(), lower_extension(path)) != all.end();
}

/// Whether files of a format are read with motions of another that a folder holds.
bool is_companion_in(const std::set<const Format*>& formats_in_folder, const Format* format) {
  return format != nullptr &&
         std::any_of(formats_in_folder.begin(), formats_in_folder.end(),
                     [format](const Format* other) { return other->companion == format->name; });
}

/// The files of a folder that are inputs: one of each set of files, and no skeleton that is read
/// with the motions beside it.
std::vector<InputFile> inputs_among(std::vector<InputFile> found) {
  std::map<fs::path, std::set<const Format*>> formats;  // by folder
  for (const InputFile& file : found) {
    if (file.format != nullptr) formats[fs::path(file.path).parent_path()].insert(file.format);
  }
  std::set<std::pair<const Format*, std::string>> sets;
  std::erase_if(found, [&](const InputFile& file) {
    const fs::path path = file.path;
    if (is_companion_in(formats[path.parent_path()], file.format)) return true;
    const bool is_of_set = file.format != nullptr && file.format->write_set != nullptr;
    return is_of_set &&
           !sets.emplace(file.format, fs::path(path).replace_extension().string()).second;
  });
  return found;
}

/// The name of the output in the output folder.
std::string output_name(const InputFile& file, const Format* to) {
  const fs::path path = file.path;
  fs::path name = file.folder.empty() ? path.filename() : path.lexically_relative(file.folder);
  if (to != nullptr && !has_extension(*to, name)) {
    name.replace_extension(std::string(to->extensions.front()));
  }
  return name.lexically_normal().string();
}

/// All names that an output may take.
std::vector<std::string> claimed_names(const ManyFile& file, bool writes_poses) {
  std::vector<std::string> names = {file.target};
  if (file.to == nullptr || writes_poses) return names;
  const auto add = [&](const Format& format) {
    for (const std::string_view extension : format.extensions) {
      names.push_back(fs::path(file.target).replace_extension(std::string(extension)).string());
    }
  };
  if (file.to->write_set != nullptr) add(*file.to);
  if (const Format* companion = find_format(file.to->companion)) {
    names.push_back(fs::path(file.target)
                        .replace_extension(std::string(companion->extensions.front()))
                        .string());
  }
  return names;
}

Result<void> refused(std::string message) {
  return fail(ErrorKind::Usage, "CLI001", std::move(message));
}

/// Refuses outputs that two files would write.
Result<void> expect_apart(const std::vector<ManyFile>& files, bool writes_poses) {
  std::unordered_map<std::string, std::size_t> owners;
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (const std::string& name : claimed_names(files[i], writes_poses)) {
      const auto [owner, is_new] = owners.try_emplace(name, i);
      if (is_new || owner->second == i) continue;
      return refused(fmt::format("'{}' and '{}' would both write '{}'; nothing is written",
                                 files[owner->second].path, files[i].path, name));
    }
  }
  return {};
}

/// Refuses outputs that would replace a file that is read.
Result<void> expect_inputs_kept(const std::vector<ManyFile>& files, const ManyWork& work) {
  std::map<Identity, std::string> inputs;
  const auto add = [&inputs](const std::string& path) {
    if (path.empty()) return;
    if (const auto identity = identity_of(path)) inputs.emplace(*identity, path);
  };
  for (const ManyFile& file : files) add(file.path);
  for (const std::string& path : work.files) add(path);
  for (const std::string& path : {work.reading->skeleton, work.reading->project}) add(path);
  for (const ManyFile& file : files) {
    for (const std::string& name : claimed_names(file, work.writes_poses)) {
      const auto identity = identity_of(name);
      if (!identity || !inputs.contains(*identity)) continue;
      return refused(
          fmt::format("the output of '{}' would replace '{}', which is read; nothing is "
                      "written",
                      file.path, inputs[*identity]));
    }
  }
  return {};
}

/// Adds a file, or the files of a folder, to a plan.
Result<void> add_path(const std::string& path, const Many& many, const ManyWork& work, Plan& plan) {
  if (path == "-") return refused("standard input has no name for its output in --out-dir");
  auto found = files_at(path, {many.is_recursive, /*has_hidden=*/false, many.out_dir});
  if (!found) return fail(std::move(found.error()));
  if (is_without_files(path, *found)) return refused(no_files_in(path));
  for (InputFile& file : inputs_among(std::move(found->files))) {
    if (!file.is_known) {
      plan.notes.add(unknown_format(file.path));
      continue;
    }
    const Reading& reading = *work.reading;
    if (!reading.from.empty()) file.format = find_format(reading.from);
    if (file.format == nullptr) file.format = format_of_file(file.path);
    const Format* to = work.to != nullptr ? work.to : file.format;
    if (to != nullptr && !work.writes_poses && !is_written(*to)) to = nullptr;
    const std::string name = output_name(file, to);
    plan.files.push_back(
        {file.path, name, (fs::path(many.out_dir) / name).string(), file.format, to});
  }
  if (found->num_folders > 0) plan.notes.add(folders_passed_over(path, found->num_folders));
  return {};
}

}  // namespace

Result<Plan> plan_of(const Many& many, const ManyWork& work) {
  Plan plan;
  for (const std::string& path : many.inputs) {
    if (auto added = add_path(path, many, work, plan); !added) return fail(added.error());
  }
  if (auto apart = expect_apart(plan.files, work.writes_poses); !apart) return fail(apart.error());
  if (auto kept = expect_inputs_kept(plan.files, work); !kept) return fail(kept.error());
  return plan;
}

}  // namespace kinefile::cli
