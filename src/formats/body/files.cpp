// SPDX-License-Identifier: MIT
#include "formats/body/files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formats/body/codes.hpp"

namespace kinefile::body {
namespace {

using text::yaml::Node;

/// The largest number of files that are open at once, each named by the one before. Every level
/// needs stack.
constexpr std::size_t kMostOpenFiles = 16;

/// The largest number of files of a robot.
constexpr std::size_t kMostFiles = 1000;

/// How much of a file that a wrapper names is looked at for its format.
constexpr std::size_t kHeadBytes = std::size_t{1} << 16;

/// The part of a path up to its last slash.
std::string folder_of(const std::string& name) {
  return name.substr(0, name.find_last_of('/') + 1);  // npos + 1 is 0
}

std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

/// A path without "." and, after a folder, without "..".
std::string normalised(std::string_view path) {
  std::vector<std::string_view> parts;
  while (!path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, slash);
    path.remove_prefix(std::min(slash + 1, path.size()));
    if (part == "." || (part.empty() && !parts.empty())) continue;
    if (part == ".." && !parts.empty() && parts.back() != "..") {
      parts.pop_back();
    } else {
      parts.push_back(part);
    }
  }
  std::string name;
  for (std::size_t i = 0; i < parts.size(); ++i) name.append(i > 0 ? "/" : "").append(parts[i]);
  return name;
}

/// The value of the key that names the wrapped model file; null if this file is not a wrapper.
const Node* wrapped_file(const File& file) {
  if (text::yaml::find(file.root(), "format") != nullptr) return nullptr;
  return find_any(file.root(), {"modelFile", "model_file"});
}

}  // namespace

const File* Files::read_first(std::string_view bytes) {
  const std::string path = with_slashes(options_.source_name);
  return read(path.substr(folder_of(path).size()), bytes, options_.encoding, nullptr,
              options_.source_name);
}

std::string Files::name_beside(const File& file, std::string_view uri) {
  constexpr std::string_view kScheme = "file://";
  if (uri.starts_with(kScheme)) uri.remove_prefix(kScheme.size());
  const std::string name = with_slashes(std::string(uri));
  return name.starts_with('/') ? name : normalised(file.folder + name);
}

std::optional<CompanionFile> Files::look_for(const std::string& name) const {
  return options_.companions.open ? options_.companions.open(name) : std::nullopt;
}

const Format* Files::format_of(const std::string& name) const {
  const auto found = look_for(name);
  return found ? detect_format(found->bytes.substr(0, kHeadBytes), name) : format_of_name(name);
}

std::optional<CompanionFile> Files::find(const std::string& name, const robot_file::Spot& spot) {
  auto found = look_for(name);
  if (!found)
    spot.report(diagnostics_, Severity::Error, code::kFileNotFound, words_of_missing(name));
  return found;
}

std::string Files::words_of_missing(const std::string& name) const {
  const std::string& root = options_.model_root;
  std::string words = fmt::format("expected the file {} in the folder {} or below it, found none",
                                  text::quoted(name),
                                  root.empty() ? "of the file that is read" : text::quoted(root));
  const bool leads_out = name.starts_with("../") || name.starts_with('/');
  if (leads_out && root.empty()) {
    words += "; --model-root names a folder above it that parts may lie in";
  }
  return words;
}

const File* Files::open(const std::string& name, const robot_file::Spot& spot) {
  const auto known = files_.find(name);
  if (known != files_.end()) return known->second->tree ? known->second.get() : nullptr;
  if (files_.size() == kMostFiles) {
    spot.report(diagnostics_, Severity::Error, code::kNestedFiles,
                fmt::format("expected at most {} files, found another", kMostFiles));
    return nullptr;
  }
  const auto found = find(name, spot);
  return found ? read(name, found->bytes, {}, found->owner, found->name) : nullptr;
}

const File* Files::read(std::string name, std::string_view bytes, const std::string& encoding,
                        std::shared_ptr<const void> owner, const std::string& source_name) {
  auto& file = files_[name];
  file = std::make_unique<File>();
  file->folder = folder_of(name);
  file->name = std::move(name);
  file->owner = std::move(owner);
  auto decoded = text::decode(bytes, encoding, source_name, diagnostics_);
  if (!decoded) {
    diagnostics_.add(static_cast<const Diagnostic&>(decoded.error()));
    return nullptr;
  }
  file->decoded = std::move(*decoded);
  file->source = std::make_unique<text::Source>(source_name, file->decoded.view());
  file->tree = text::yaml::read_tree(*file->source, diagnostics_);
  return file->tree ? file.get() : nullptr;
}

const robot_file::Robot* Files::robot(const File& file, const robot_file::Spot& spot) {
  const auto known = robots_.find(&file);
  if (known != robots_.end()) return known->second ? &*known->second : nullptr;
  const bool is_open = std::find(open_.begin(), open_.end(), &file) != open_.end();
  if (is_open || open_.size() == kMostOpenFiles) {
    spot.report(
        diagnostics_, Severity::Error, code::kNestedFiles,
        is_open ? "expected files that do not name each other in a circle, found one that does"
                : fmt::format("expected at most {} files, each named by the one before, found more",
                              kMostOpenFiles));
    return nullptr;
  }
  open_.push_back(&file);
  auto robot = read_robot(file, *this);
  open_.pop_back();
  auto& kept = robots_[&file];
  kept = std::move(robot);
  return kept ? &*kept : nullptr;
}

Wrapped follow_wrappers(const File* file, Files& files) {
  Wrapped wrapped;
  for (std::size_t count = 0; file != nullptr; ++count) {
    const Node* node = wrapped_file(*file);
    if (node == nullptr) {
      wrapped.file = file;
      return wrapped;
    }
    Values values{*file->source, *file->tree, files.diagnostics()};
    wrapped.spot = values.spot(*node);
    if (count == kMostOpenFiles) {
      values.error(
          *node, code::kNestedFiles,
          fmt::format("expected a robot behind at most {} wrappers, found more", kMostOpenFiles));
      return wrapped;
    }
    const auto uri = values.word(*node, "the name of a model file");
    if (!uri) return wrapped;
    const std::string name = Files::name_beside(*file, *uri);
    const Format* format = files.format_of(name);
    if (format != nullptr && format->read != nullptr && format->name != "body") {
      wrapped.other_format = format;
      wrapped.other_name = name;
      return wrapped;
    }
    file = files.open(name, wrapped.spot);
  }
  return wrapped;
}

}  // namespace kinefile::body
