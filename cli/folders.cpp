// SPDX-License-Identifier: MIT
#include "folders.hpp"

#include <fmt/format.h>

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

/// Adds the files of a folder, and of the folders in it.
std::error_code add_files(const fs::path& folder, bool is_recursive, FolderFiles& found) {
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) {
      const std::string path = entry->path().string();
      found.files.push_back({path, has_known_format(path)});
    } else if (entry->is_directory(ignored) && !is_recursive) {
      ++found.num_folders;
    } else if (entry->is_directory(ignored) && !entry->is_symlink(ignored)) {
      fault = add_files(entry->path(), is_recursive, found);
      if (fault) break;
    }
  }
  return fault;
}

}  // namespace

Result<FolderFiles> files_at(const std::string& path, bool is_recursive) {
  FolderFiles found;
  std::error_code ignored;
  if (path == "-" || !fs::is_directory(path, ignored)) {
    found.files.push_back({path});
    return found;
  }
  if (const std::error_code fault = add_files(path, is_recursive, found)) {
    return fail(make_error(ErrorKind::Io, "IO001",
                           fmt::format("cannot list the folder: {}", fault.message()), {path}));
  }
  std::sort(found.files.begin(), found.files.end(),
            [](const InputFile& a, const InputFile& b) { return a.path < b.path; });
  return found;
}

}  // namespace kinefile::cli
