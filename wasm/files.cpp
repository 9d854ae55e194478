// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace kinefile::page {
namespace {

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

FileSet::const_iterator find(const FileSet& files, const std::string& path) {
  const auto exact = files.find(path);
  if (exact != files.end() || path.empty()) return exact;
  return std::find_if(files.begin(), files.end(), [wanted = lowered(path)](const auto& file) {
    return lowered(file.first) == wanted;
  });
}

}  // namespace

std::string lowered(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return lower;
}

std::string normalised(std::string_view path) {
  std::vector<std::string_view> parts;
  while (!path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, slash);
    path.remove_prefix(std::min(slash + 1, path.size()));
    if (part.empty() || part == ".") continue;
    if (part != "..") {
      parts.push_back(part);
    } else if (parts.empty()) {
      return {};
    } else {
      parts.pop_back();
    }
  }
  std::string text;
  for (const std::string_view part : parts) text.append(text.empty() ? "" : "/").append(part);
  return text;
}

Resolver files_beside(const FileSet& files, const std::string& path,
                      std::set<std::string>& opened) {
  const std::string folder = folder_of(path);
  Resolver resolver;
  resolver.open = [&files, &opened, folder](const std::string& name) {
    const auto found = find(files, normalised(folder + name));
    if (found == files.end()) return std::optional<CompanionFile>();
    opened.insert(found->first);
    return std::optional(CompanionFile{found->first, view(*found->second), found->second});
  };
  resolver.list = [&files, folder](std::string_view extension) {
    std::vector<std::string> names;
    for (const auto& [other, bytes] : files) {
      const bool is_beside = folder_of(other) == folder;
      if (is_beside && lowered(other).ends_with(lowered(extension))) {
        names.push_back(other.substr(folder.size()));
      }
    }
    return names;
  };
  return resolver;
}

}  // namespace kinefile::page
