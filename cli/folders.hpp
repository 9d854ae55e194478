// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kinefile/batch.hpp"
#include "kinefile/format.hpp"
#include "kinefile/result.hpp"

namespace kinefile::cli {

/// A file that was given to a command, or that is in a folder that was given.
struct InputFile {
  std::string path;
  bool is_known = true;            ///< false: the format is unknown (only for files in folders)
  std::string folder = {};         ///< the folder that was given; empty: the file was
  const Format* format = nullptr;  ///< of a file in a folder, if it is known
};

/// What of a folder is walked.
struct Walk {
  bool is_recursive = false;  ///< the folders in it, too, at any depth
  bool has_hidden = true;     ///< files and folders whose names begin with a dot, too
  std::string left_out = {};  ///< a folder that is passed over where it is met; empty: none
};

/// The files of a folder.
struct FolderFiles {
  std::vector<InputFile> files;  ///< in the order of their paths
  std::size_t num_folders = 0;   ///< that are in it and were passed over
};

/// The file of a path, or the files of a folder. Links to folders are not followed.
/// \errors IO001 if a folder cannot be listed
Result<FolderFiles> files_at(const std::string& path, const Walk& walk);

/// The format of a file by its first bytes, then by its name; null: unknown, or the file cannot be
/// read.
const Format* format_of_file(const std::string& path);

/// Whether a folder was given and none of its files has a format that is read.
bool is_without_files(const std::string& path, const FolderFiles& found);

/// The note about a file in a folder whose format is unknown (FMT005).
Diagnostic unknown_format(const std::string& path);

/// The note about folders in a folder (FMT009).
Diagnostic folders_passed_over(const std::string& path, std::size_t num_folders);

/// The message about a folder `is_without_files`.
std::string no_files_in(const std::string& path);

/// The files of paths that a command reads one after the other.
struct GivenFiles {
  std::vector<Result<FolderFiles>> paths;  ///< what is at each path that was given
  /// All files, in order: which path, and which of its files.
  std::vector<std::pair<std::size_t, std::size_t>> files;

  const InputFile& file(std::size_t i) const {
    return paths[files[i].first]->files[files[i].second];
  }
};

/// Lists what is at each of these paths.
GivenFiles files_at_all(const std::vector<std::string>& paths, const Walk& walk);

/// How files are worked on that are read and printed, not written: several at a time, but standard
/// input and large files alone. The files must outlive it.
Batch batch_of(const GivenFiles& given);

/// The size of a file; 0 if it has none.
std::uint64_t size_of_file(const std::string& path);

}  // namespace kinefile::cli
