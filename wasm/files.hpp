// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "kinefile/array.hpp"
#include "kinefile/format.hpp"

// Files in memory: those that a person gave to the page, as if they were in one folder.
namespace kinefile::page {

/// Files by their paths: "walk.bvh", "robot/arm.wrl".
using FileSet = std::map<std::string, std::shared_ptr<const Array<char>>>;

/// The bytes of a file.
inline std::string_view view(const Array<char>& bytes) { return {bytes.data(), bytes.size()}; }

/// ASCII letters in lower case.
std::string lowered(std::string_view text);

/// A path without "." and ".." parts; empty if it leads out of the set.
std::string normalised(std::string_view path);

/// Finds the companions of a file in its folder of the set, or anywhere else in the set.
/// Names match in any case, as on the disk.
/// \param opened  receives the paths of the files that were opened; must outlive the resolver
Resolver files_beside(const FileSet& files, const std::string& path, std::set<std::string>& opened);

}  // namespace kinefile::page
