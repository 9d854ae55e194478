// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinefile/result.hpp"

namespace kinefile::cli {

/// A file that was given to a command, or that is in a folder that was given.
struct InputFile {
  std::string path;
  bool is_known = true;  ///< false: the format is unknown (only for files in folders)
};

/// The files of a folder.
struct FolderFiles {
  std::vector<InputFile> files;  ///< in the order of their paths
  std::size_t num_folders = 0;   ///< that are in it and were passed over
};

/// The file of a path, or the files of a folder; with `is_recursive` also those of the folders in
/// it, at any depth. Links to folders are not followed.
/// \errors IO001 if a folder cannot be listed
Result<FolderFiles> files_at(const std::string& path, bool is_recursive);

}  // namespace kinefile::cli
