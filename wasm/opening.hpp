// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "session.hpp"

namespace kinefile::page {

/// What became of one file that was given to the page.
struct Opened {
  enum class What {
    Document,   ///< it is open: see `handle`
    Companion,  ///< another file was read with it, or it is the robot, servo map or project of one
    Waiting,    ///< it can be opened, but enough documents were
    Fault,      ///< it cannot be read: see `diagnostics`
    Unknown,    ///< it is of no format that kinefile reads
  };
  std::string path;
  What what = What::Unknown;
  int handle = 0;
  std::string format;       ///< its name, if it was detected
  Diagnostics diagnostics;  ///< of reading
};

/// Opens files of the set as a person who gives several at once expects: skeletons, parts of models
/// and sets that others of the files are read with are not opened by themselves; a robot carries
/// the body motions and flows among them, a servo map or a project makes flows move. Body motions
/// that were open without a robot get it, too.
/// \param most  how many documents to open at most
std::vector<Opened> open_all(Session& session, std::vector<std::string> paths, std::size_t most);

}  // namespace kinefile::page
