// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>

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
  std::error_code fault;
  if (!fs::is_regular_file(path, fault)) return std::nullopt;
  auto bytes = FileBytes::open(path.string());
  if (!bytes) return std::nullopt;
  return CompanionFile{path.string(), bytes->view(), bytes->owner()};
}

/// Whether a path leads into a folder, wherever links on the way lead.
bool is_within(const fs::path& path, const fs::path& folder) {
  std::error_code fault;
  const fs::path root = fs::canonical(folder, fault);
  if (fault) return false;
  const fs::path place = fs::weakly_canonical(path, fault);
  if (fault) return false;
  return std::mismatch(root.begin(), root.end(), place.begin(), place.end()).first == root.end();
}

std::optional<CompanionFile> open_beside(const fs::path& folder, const fs::path& root,
                                         const std::string& text) {
  const fs::path name(text);
  if (text.find('\0') != std::string::npos) return std::nullopt;
  const bool is_allowed =
      stays_inside(name) || (!root.empty() && !name.empty() && is_within(folder / name, root));
  if (!is_allowed) return std::nullopt;
  if (auto found = open_regular(folder / name)) return found;
  const fs::path parent = (folder / name).parent_path();
  for (const std::string& other : names_in(parent)) {
    if (lowered(other) == lowered(name.filename().string())) return open_regular(parent / other);
  }
  return std::nullopt;
}

}  // namespace

Resolver files_beside(const std::string& path, const std::string& root) {
  const fs::path folder = fs::path(path).parent_path();
  Resolver resolver;
  resolver.open = [folder, root](const std::string& name) {
    return open_beside(folder, root, name);
  };
  resolver.list = [folder](std::string_view extension) {
    std::vector<std::string> names;
    for (std::string& name : names_in(folder)) {
      if (lowered(name).ends_with(lowered(extension))) names.push_back(name);
    }
    return names;
  };
  return resolver;
}

}  // namespace kinefile
