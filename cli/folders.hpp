// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace kinefile::cli {

/// A file that was given to a command, or that is in a folder that was given.
struct InputFile {
  std::string path;
  bool is_known = true;  ///< false: the format is unknown (only for files in folders)
};

/// Replaces folders by their files, in the order of names. Nested folders are not searched.
std::vector<InputFile> with_files_of_folders(const std::vector<std::string>& paths);

}  // namespace kinefile::cli
