// SPDX-License-Identifier: MIT
#include "folders.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "kinefile/kinefile.hpp"

namespace kinefile::cli {
namespace {

namespace fs = std::filesystem;

/// Whether many kinds of files have this extension, so that only the content shows the format.
bool has_common_extension(const fs::path& path) {
  constexpr std::string_view kCommon[] = {".txt", ".csv", ".yaml", ".yml"};
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(std::begin(kCommon), std::end(kCommon), extension) != std::end(kCommon);
}

bool has_known_format(const std::string& path) {
  constexpr std::size_t kHeadBytes = std::size_t{1} << 16;
  const auto bytes = FileBytes::open(path);
  if (!bytes) return true;  // reading it later reports the reason
  const std::string name = has_common_extension(path) ? "" : path;
  const Format* format = detect_format(bytes->view().substr(0, kHeadBytes), name);
  return format != nullptr && format->read != nullptr;
}

std::vector<InputFile> files_of(const fs::path& folder) {
  std::vector<InputFile> files;
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault)) {
    std::error_code ignored;
    if (!entry->is_regular_file(ignored)) continue;
    const std::string path = entry->path().string();
    files.push_back({path, has_known_format(path)});
  }
  std::sort(files.begin(), files.end(),
            [](const InputFile& a, const InputFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace

std::vector<InputFile> with_files_of_folders(const std::vector<std::string>& paths) {
  std::vector<InputFile> files;
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (path == "-" || !fs::is_directory(path, ignored)) {
      files.push_back({path});
      continue;
    }
    const std::vector<InputFile> inside = files_of(path);
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

}  // namespace kinefile::cli
