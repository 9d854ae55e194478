// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace kinefile::cli {

/// A file that a command was given, or that it found in a folder that it was given.
struct InputFile {
  std::string path;
  bool is_known = true;  ///< else its format is not known: of files in folders alone
};

/// Puts the files of folders in the place of the folders, each in the order of names; what is in
/// folders within them is left alone.
std::vector<InputFile> with_files_of_folders(const std::vector<std::string>& paths);

}  // namespace kinefile::cli
