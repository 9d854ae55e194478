// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "base/words.hpp"
#include "kinefile/io.hpp"

namespace kinefile {
namespace {

namespace fs = std::filesystem;

/// Whether a name stays in the folder that it is relative to.
bool stays_inside(const fs::path& name) {
  const std::string text = name.string();
  if (name.empty() || name.is_absolute() || text.find(':') != std::string::npos) return false;
  return std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

/// The regular files of a folder, in order.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code fault;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, fault), end;
       !fault && entry != end; entry.increment(fault)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<CompanionFile> open_regular(const fs::path& path) {
  auto bytes = FileBytes::open(path.string());
  if (!bytes) return std::nullopt;
  return CompanionFile{path.string(), bytes->view(), bytes->owner()};
}

bool is_regular(const fs::path& path) {
  std::error_code fault;
  return fs::is_regular_file(path, fault);
}

/// Where a folder is, wherever links lead; empty if it is nowhere.
fs::path place_of_folder(const fs::path& folder) {
  std::error_code fault;
  fs::path place = fs::canonical(folder.empty() ? "." : folder, fault);
  return fault ? fs::path() : place;
}

/// Whether a path leads into a folder, wherever links on the way lead.
bool is_within(const fs::path& path, const fs::path& place_of_folder) {
  if (place_of_folder.empty()) return false;
  std::error_code fault;
  const fs::path place = fs::weakly_canonical(path, fault);
  if (fault) return false;
  return std::mismatch(place_of_folder.begin(), place_of_folder.end(), place.begin(), place.end())
             .first == place_of_folder.end();
}

/// The files beside a file. Each folder is listed once.
struct Beside {
  fs::path folder;
  fs::path place;       ///< of the folder
  fs::path root_place;  ///< empty: no root
  Diagnostics* refusals = nullptr;
  /// [folder][name in lower case]: the name
  std::map<fs::path, std::map<std::string, std::string>> names = {};
  std::set<std::string> refused = {};

  const std::map<std::string, std::string>& names_of(const fs::path& of) {
    const auto [known, is_new] = names.try_emplace(of);
    if (is_new) {
      for (const std::string& name : names_in(of)) known->second.emplace(lowered(name), name);
    }
    return known->second;
  }

  /// The file of a name, whatever the case of its letters; empty if there is none.
  fs::path find(const fs::path& name) {
    const fs::path path = folder / name;
    if (is_regular(path)) return path;
    const auto& known = names_of(path.parent_path());
    const auto found = known.find(lowered(name.filename().string()));
    return found == known.end() ? fs::path() : path.parent_path() / found->second;
  }

  bool is_allowed(const fs::path& path) const {
    return is_within(path, place) || is_within(path, root_place);
  }

  std::optional<CompanionFile> open(const std::string& text) {
    const fs::path name(text);
    if (text.empty() || text.find('\0') != std::string::npos) return std::nullopt;
    if (!stays_inside(name) && !is_within(folder / name, root_place)) return std::nullopt;
    const fs::path path = find(name);
    if (path.empty()) return std::nullopt;
    if (is_allowed(path)) return open_regular(path);
    refuse(path.string());
    return std::nullopt;
  }

  void refuse(const std::string& path) {
    if (refusals == nullptr || !refused.insert(path).second) return;
    Diagnostic warning;
    warning.severity = Severity::Warning;
    warning.code = "IO005";
    warning.message =
        "not opened: this link leads out of the folder; --skeleton names a skeleton, --model-root "
        "a folder that a model's parts may lie in";
    warning.place.source = path;
    refusals->add(std::move(warning));
  }
};

}  // namespace

Resolver files_beside(const std::string& path, const std::string& root, Diagnostics* refusals) {
  auto beside = std::make_shared<Beside>();
  beside->folder = fs::path(path).parent_path();
  beside->place = place_of_folder(beside->folder);
  if (!root.empty()) beside->root_place = place_of_folder(root);
  beside->refusals = refusals;
  Resolver resolver;
  resolver.open = [beside](const std::string& name) { return beside->open(name); };
  resolver.list = [beside](std::string_view extension) {
    std::vector<std::string> names;
    for (const auto& [lower, name] : beside->names_of(beside->folder)) {
      if (lower.ends_with(lowered(extension))) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  };
  return resolver;
}

}  // namespace kinefile
