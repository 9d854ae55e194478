// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/body/values.hpp"
#include "kinefile/format.hpp"
#include "text/decode.hpp"

namespace kinefile::body {

/// A YAML file in memory.
struct File {
  std::string name;    ///< relative to the folder of the file that is read
  std::string folder;  ///< of `name`: empty, or with a slash at its end
  std::shared_ptr<const void> owner;
  text::DecodedText decoded;
  std::unique_ptr<text::Source> source;
  std::unique_ptr<text::yaml::Tree> tree;

  const text::yaml::Node& root() const { return tree->root(); }
};

/// The file that is read, and those that it names. Each is read once.
class Files {
 public:
  Files(const ReadOptions& options, Diagnostics& diagnostics)
      : options_(options), diagnostics_(diagnostics) {}

  /// Reads the first file. Null after an error.
  const File* read_first(std::string_view bytes);

  /// The name of a file that another file names, relative to the folder of the first one.
  static std::string name_beside(const File& file, std::string_view uri);

  /// Reads a file that another file names. Null after an error.
  /// \param spot  where it is named
  const File* open(const std::string& name, const robot_file::Spot& spot);

  /// Finds a file that another file names; empty after an error.
  std::optional<CompanionFile> find(const std::string& name, const robot_file::Spot& spot);

  /// The format of a file that another file names, or null; by its name alone if there is none.
  const Format* format_of(const std::string& name) const;

  /// The robot of a file; null after an error.
  /// \param spot  where the file is named
  const robot_file::Robot* robot(const File& file, const robot_file::Spot& spot);

  const ReadOptions& options() const { return options_; }
  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  std::optional<CompanionFile> look_for(const std::string& name) const;
  std::string words_of_missing(const std::string& name) const;
  const File* read(std::string name, std::string_view bytes, const std::string& encoding,
                   std::shared_ptr<const void> owner, const std::string& source_name);

  const ReadOptions& options_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::unique_ptr<File>> files_;
  std::map<const File*, std::optional<robot_file::Robot>> robots_;
  std::vector<const File*> open_;  ///< those whose links are being read, outermost first
};

/// The model file that wrappers lead to.
struct Wrapped {
  const File* file = nullptr;            ///< a file with links; null after an error, or if:
  const Format* other_format = nullptr;  ///< the format is not .body
  std::string other_name;
  robot_file::Spot spot;  ///< the place of `other_name`
};

/// Follows `modelFile` from file to file.
Wrapped follow_wrappers(const File* file, Files& files);

/// Reads the links of a file. Empty after an error.
std::optional<robot_file::Robot> read_robot(const File& file, Files& files);

}  // namespace kinefile::body
