// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "kinefile/kinefile.hpp"

namespace kinefile::bench {

/// What the measurements work on: some 50 MB of a walk as BVH, as AMC with its skeleton beside it,
/// and of a robot as .seq and as CSV.
struct Subject {
  std::string folder;
  std::string path;              ///< with six decimals, as most programs write
  std::string short_path;        ///< the same numbers, without zeros at their ends
  std::string amc_path;          ///< with six decimals
  std::string csv_path;          ///< likewise
  std::string seq_path;          ///< with 17 digits
  std::string rounded_seq_path;  ///< with six decimals
  Motion motion;                 ///< of `path`; empty until `load_subject`
};

const Subject& subject();

/// Writes the files of the subject to a new folder, or ends the program.
void make_subject();
void load_subject();
void remove_subject();

/// Reads a file, or ends the program.
Document read_or_exit(const std::string& path);

}  // namespace kinefile::bench
