// SPDX-License-Identifier: MIT
#include "folders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

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

/// The format of a file that is read, or null.
/// \param is_readable  out: whether the file could be opened
const Format* format_by_head(const std::string& path, const std::string& name, bool& is_readable) {
  constexpr std::size_t kHeadBytes = std::size_t{1} << 16;
  std::ifstream file(path, std::ios::binary);
  std::string head(kHeadBytes, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  is_readable = !file.bad() && (file || file.eof());
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  const Format* format = detect_format(head, name);
  return format != nullptr && format->read != nullptr ? format : nullptr;
}

/// A file in a folder that was given.
InputFile file_in(const std::string& given, const fs::path& path) {
  bool is_readable = false;
  const std::string name = has_common_extension(path) ? "" : path.string();
  const Format* format = format_by_head(path.string(), name, is_readable);
  // Reading it later reports why it cannot be read.
  return {path.string(), format != nullptr || !is_readable, given, format};
}

bool is_left_out(const fs::path& folder, const Walk& walk) {
  std::error_code ignored;
  return !walk.left_out.empty() && fs::equivalent(folder, walk.left_out, ignored);
}

/// Whether a walk passes over an entry without a word: what is ours, or hidden.
bool is_passed_over(const fs::path& path, const Walk& walk) {
  const std::string name = path.filename().string();
  return name.starts_with(".kinefile-") || (!walk.has_hidden && name.starts_with('.'));
}

/// Adds the files of a folder, and of the folders in it.
std::error_code add_files(const std::string& given, const fs::path& folder, const Walk& walk,
                          FolderFiles& found) {
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault)) {
    std::error_code ignored;
    if (is_passed_over(entry->path(), walk)) continue;
    if (entry->is_regular_file(ignored)) {
      found.files.push_back(file_in(given, entry->path()));
    } else if (!entry->is_directory(ignored) || is_left_out(entry->path(), walk)) {
      continue;
    } else if (!walk.is_recursive) {
      ++found.num_folders;
    } else if (!entry->is_symlink(ignored)) {
      fault = add_files(given, entry->path(), walk, found);
      if (fault) break;
    }
  }
  return fault;
}

}  // namespace

Result<FolderFiles> files_at(const std::string& path, const Walk& walk) {
  FolderFiles found;
  std::error_code ignored;
  if (path == "-" || !fs::is_directory(path, ignored)) {
    found.files.push_back({path});
    return found;
  }
  if (const std::error_code fault = add_files(path, path, walk, found)) {
    return fail(make_error(ErrorKind::Io, "IO001",
                           fmt::format("cannot list the folder: {}", fault.message()), {path}));
  }
  std::sort(found.files.begin(), found.files.end(),
            [](const InputFile& a, const InputFile& b) { return a.path < b.path; });
  return found;
}

const Format* format_of_file(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return format_of_name(path);  // a pipe is read once
  bool is_readable = false;
  return format_by_head(path, path, is_readable);
}

bool is_without_files(const std::string& path, const FolderFiles& found) {
  std::error_code ignored;
  return path != "-" && fs::is_directory(path, ignored) &&
         std::none_of(found.files.begin(), found.files.end(),
                      [](const InputFile& file) { return file.is_known; });
}

Diagnostic unknown_format(const std::string& path) {
  Diagnostic note;
  note.severity = Severity::Note;
  note.code = "FMT005";
  note.message = "neither the content nor the name shows a format; passed over";
  note.place.source = path;
  return note;
}

Diagnostic folders_passed_over(const std::string& path, std::size_t num_folders) {
  Diagnostic note;
  note.severity = Severity::Note;
  note.code = "FMT009";
  note.message =
      num_folders == 1
          ? "a folder in it is passed over; --recursive reads it"
          : fmt::format("{} folders in it are passed over; --recursive reads them", num_folders);
  note.place.source = path;
  return note;
}

std::string no_files_in(const std::string& path) {
  return fmt::format("the folder '{}' holds no file of a format that can be read", path);
}

GivenFiles files_at_all(const std::vector<std::string>& paths, const Walk& walk) {
  GivenFiles given;
  for (const std::string& path : paths) {
    given.paths.push_back(files_at(path, walk));
    const auto& found = given.paths.back();
    const std::size_t num_files = found ? found->files.size() : 0;
    for (std::size_t i = 0; i < num_files; ++i) {
      given.files.emplace_back(given.paths.size() - 1, i);
    }
  }
  return given;
}

Batch batch_of(const GivenFiles& given) {
  return {given.files.size(), [&given](std::size_t i) {
            const std::string& path = given.file(i).path;
            return path == "-" || size_of_file(path) >= kLargeInputBytes;
          }};
}

std::uint64_t size_of_file(const std::string& path) {
  std::error_code fault;
  const std::uintmax_t size = fs::file_size(path, fault);
  return fault ? 0 : size;
}

}  // namespace kinefile::cli
