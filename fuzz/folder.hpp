// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/words.hpp"
#include "kinefile/io.hpp"

namespace kinefile::fuzz {

/// Files in memory: the first one is read, and finds the others beside it.
using Folder = std::vector<MemoryFile>;

/// What stands between two files of an input. No text that we read has these bytes in a row.
constexpr std::string_view kBorder = "\xfe\xfe\xfe\xfe";

/// The files of an input: each is a line with its name, and its bytes. Never empty.
inline Folder folder_of(std::string_view bytes) {
  Folder folder;
  for (bool has_more = true; has_more;) {
    const std::size_t end = bytes.find(kBorder);
    const std::string_view file = bytes.substr(0, end);
    const std::size_t line = std::min(file.find('\n'), file.size());
    folder.push_back({std::string(file.substr(0, line)),
                      std::string(file.substr(std::min(line + 1, file.size())))});
    has_more = end != std::string_view::npos;
    if (has_more) bytes.remove_prefix(end + kBorder.size());
  }
  return folder;
}

/// The first file with one of these extensions behind the one that is read; null: there is none.
inline const MemoryFile* companion_of(const Folder& folder,
                                      std::initializer_list<std::string_view> extensions) {
  for (std::size_t i = 1; i < folder.size(); ++i) {
    for (const std::string_view extension : extensions) {
      if (lowered(folder[i].name).ends_with(extension)) return &folder[i];
    }
  }
  return nullptr;
}

/// Finds the files of a folder, which must outlive what is read.
inline Resolver resolver_of(const Folder& folder) {
  Resolver resolver;
  resolver.open = [&folder](const std::string& name) -> std::optional<CompanionFile> {
    for (const MemoryFile& file : folder) {
      if (lowered(file.name) == lowered(name)) return CompanionFile{file.name, file.bytes, nullptr};
    }
    return std::nullopt;
  };
  resolver.list = [&folder](std::string_view extension) {
    std::vector<std::string> names;
    for (const MemoryFile& file : folder) {
      if (lowered(file.name).ends_with(extension)) names.push_back(file.name);
    }
    std::sort(names.begin(), names.end());
    return names;
  };
  return resolver;
}

}  // namespace kinefile::fuzz
