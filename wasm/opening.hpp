// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "session.hpp"

namespace kinefile::page {

/// What became of one file that was given to the page.
struct Opened {
  enum class What {
    Document,   ///< it is open: see `handle`
    Companion,  ///< another file was read with it, or it is the robot, servo map or project of one
    Waiting,    ///< it can be opened, but enough motions were
    Fault,      ///< it cannot be read: see `diagnostics`
    Unknown,    ///< it is no motion: of no format that kinefile reads, or a table or a text of
                ///< something else; `diagnostics` tell if reading was tried
  };
  std::string path;
  What what = What::Unknown;
  int handle = 0;
  std::string format;                ///< its name, if it was detected
  Diagnostics diagnostics;           ///< of reading
  std::optional<Opening> leniently;  ///< of a fault: see `lenient_opening`
};

/// What became of several files.
struct OpenedFiles {
  std::vector<Opened> files;
  std::set<int> changed;  ///< the handles of documents that are new, or were read again
};

/// Opens files of the set as a person who gives several at once expects: skeletons, parts of models
/// and sets that others of the files are read with are not opened by themselves; a robot carries
/// the body motions and flows among them, a servo map or a project makes flows move. Body motions
/// that were open without a robot get it, too, and flows what they lack. Of a folder full of
/// motions the first one is opened: many at once could not be told apart. Of several robots the
/// first is opened, and none if a motion among the files carries one.
/// \param few  up to how many motions, and how many robots, are opened; absent: what a person tells
///             apart at first sight
OpenedFiles open_all(Session& session, const std::vector<std::string>& paths,
                     std::optional<std::size_t> few);

}  // namespace kinefile::page
