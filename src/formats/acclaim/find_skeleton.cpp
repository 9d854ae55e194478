// SPDX-License-Identifier: MIT
#include <algorithm>

#include "formats/acclaim/format.hpp"

namespace kinefile::acclaim {
namespace {

/// A path of any operating system, with forward slashes.
std::string with_slashes(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

std::string base_name(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);  // npos + 1 is 0
}

/// The file names beside the motion that a header may mean.
std::vector<std::string> hinted_names(const AmcHeader& header) {
  if (header.skeleton_hint.empty()) return {};
  const std::string hint = with_slashes(header.skeleton_hint);
  std::vector<std::string> names;
  if (!header.skeleton_path.empty()) {
    names.push_back(with_slashes(header.skeleton_path) + "/" + hint);
  }
  names.push_back(hint);
  names.push_back(base_name(hint));
  return names;
}

/// NAME.asf for NAME.amc, then with NAME cut at its last underscore, and so on.
std::vector<std::string> names_of_subject(const std::string& motion_name) {
  std::string stem = base_name(with_slashes(motion_name));
  stem = stem.substr(0, stem.find_last_of('.'));
  std::vector<std::string> names;
  while (!stem.empty()) {
    names.push_back(stem + ".asf");
    const std::size_t cut = stem.find_last_of('_');
    stem = cut == std::string::npos ? std::string() : stem.substr(0, cut);
  }
  return names;
}

}  // namespace

std::optional<CompanionFile> find_skeleton(const AmcHeader& header, const ReadOptions& options,
                                           std::string& how) {
  const Resolver& beside = options.companions;
  if (!beside.open) return std::nullopt;
  for (const std::string& name : hinted_names(header)) {
    how = "which the file's header names";
    if (auto found = beside.open(name)) return found;
  }
  for (const std::string& name : names_of_subject(options.source_name)) {
    how = "by the file's own name";
    if (auto found = beside.open(name)) return found;
  }
  if (!beside.list) return std::nullopt;
  const std::vector<std::string> names = beside.list(".asf");
  how = "the only one beside the file";
  return names.size() == 1 ? beside.open(names.front()) : std::nullopt;
}

}  // namespace kinefile::acclaim
