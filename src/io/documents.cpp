// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "base/words.hpp"
#include "kinefile/io.hpp"

namespace kinefile {
namespace {

/// How much of a file is looked at to tell its format.
constexpr std::size_t kHeadBytes = std::size_t{1} << 16;

std::string names_of_formats(bool (*is_wanted)(const Format&)) {
  std::string names;
  for (const Format& format : formats()) {
    if (!is_wanted(format)) continue;
    if (!names.empty()) names += ", ";
    names += format.name;
  }
  return names;
}

/// Reads the skeleton that the caller named, once its motion asks for one.
Result<void> read_skeleton(const std::string& path, ReadOptions& options,
                           Diagnostics& diagnostics) {
  ReadOptions skeleton_options;
  skeleton_options.lenient = options.lenient;
  skeleton_options.positions = options.positions;
  skeleton_options.metres_per_unit = options.metres_per_unit;
  auto skeleton = read_file(path, nullptr, skeleton_options, diagnostics);
  if (!skeleton) return fail(std::move(skeleton.error()));
  options.skeleton = std::make_shared<const Document>(std::move(*skeleton));
  return {};
}

/// OUT.asf for OUT.amc.
std::string companion_path(const std::string& path, const Format& format) {
  const std::size_t slash = path.find_last_of('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  const std::size_t dot = path.find_last_of('.');
  const bool has_extension = dot != std::string::npos && dot > name;
  return (has_extension ? path.substr(0, dot) : path) + std::string(format.extensions.front());
}

/// Of a set of files that is named by its stem, the first one that there is; else the name itself.
std::string path_in_set(const std::string& name, const Format& format) {
  std::error_code fault;
  if (format.has_part == nullptr || std::filesystem::is_regular_file(name, fault)) return name;
  for (const std::string_view part : format.extensions) {
    const std::string path = name + std::string(part);
    if (std::filesystem::is_regular_file(path, fault)) return path;
  }
  return name;
}

/// The stem of a set of files: a name without the extension of one of them.
std::string stem_of_set(const std::string& path, const Format& format) {
  for (const std::string_view part : format.extensions) {
    if (lowered(path).ends_with(part)) return path.substr(0, path.size() - part.size());
  }
  return path;
}

/// Writes a document to a file that has not come to its name yet.
Result<OutputFile> write_output(const std::string& path, const Document& document,
                                const Format& format, const WriteOptions& options, bool replace,
                                Diagnostics& diagnostics) {
  auto file = OutputFile::create(path, replace);
  if (!file) return file;
  const Sink sink = [&file](std::string_view piece) { return file->write(piece); };
  auto written = format.write(document, options, sink, diagnostics);
  // A fault of the file says more than that the writer was stopped.
  if (!written && written.error().kind == ErrorKind::Io) written = file->commit();
  if (!written) return fail(std::move(written.error()));
  return file;
}

}  // namespace

Result<Document> read_file(const std::string& name, const Format* format, ReadOptions options,
                           Diagnostics& diagnostics) {
  const std::string path = format != nullptr ? path_in_set(name, *format) : name;
  options.source_name = path == "-" ? "<stdin>" : path;
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  if (format == nullptr) format = detect_format(bytes->view().substr(0, kHeadBytes), path);
  if (format == nullptr || format->read == nullptr) {
    const std::string readable =
        names_of_formats([](const Format& known) { return known.read != nullptr; });
    return fail(make_error(
        ErrorKind::InvalidInput, "FMT001",
        format == nullptr
            ? fmt::format("neither the content nor the name shows a format; --from names it ({})",
                          readable)
            : fmt::format("{} is only written, not read; what is read: {}", format->name, readable),
        options.source_name));
  }
  if (format->takes_skeleton && !options.skeleton_name.empty() && options.skeleton == nullptr) {
    auto skeleton = read_skeleton(options.skeleton_name, options, diagnostics);
    if (!skeleton) return fail(std::move(skeleton.error()));
  }
  if (path != "-" && !options.companions.open) options.companions = files_beside(path);
  return format->read(bytes->view(), options, diagnostics);
}

namespace {

/// A file that is no part of the set to be written would be read with it. It is not for us to
/// delete.
Result<void> expect_no_file(const std::string& name) {
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored)) return {};
  return fail(make_error(ErrorKind::Io, "FMT007",
                         "the file is there and would be read as part of the set, which has none "
                         "such; move it away, or name another stem",
                         name));
}

/// Writes a set of files, all or none.
Result<void> write_set(const std::string& path, const Document& document, const Format& format,
                       const WriteOptions& options, bool replace, Diagnostics& diagnostics) {
  if (path == "-") {
    return fail(make_error(
        ErrorKind::Usage, "FMT006",
        fmt::format("{} is a set of files, which standard output cannot take", format.name)));
  }
  std::vector<std::pair<std::string, OutputFile>> files;
  for (const std::string_view part : format.extensions) {
    if (!format.has_part(document, part)) {
      const auto none = expect_no_file(stem_of_set(path, format) + std::string(part));
      if (!none) return none;
      continue;
    }
    WriteOptions for_part = options;
    for_part.part = part;
    const std::string name = stem_of_set(path, format) + std::string(part);
    auto file = write_output(name, document, format, for_part, replace, diagnostics);
    if (!file) return fail(std::move(file.error()));
    files.emplace_back(name, std::move(*file));
  }
  // Nothing at all is for the writer to tell.
  if (files.empty()) return format.write(document, options, nullptr, diagnostics);
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  for (std::size_t i = 0; i < files.size(); ++i) {
    auto committed = files[i].second.commit();
    if (committed) continue;
    for (std::size_t k = 0; k < i && !replace; ++k) std::filesystem::remove(files[k].first);
    return committed;
  }
  return {};
}

}  // namespace

Result<RobotProject> read_project_file(const std::string& path, ReadOptions options,
                                       Diagnostics& diagnostics) {
  options.source_name = path;
  options.companions = files_beside(path);
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  return read_project(bytes->view(), options, diagnostics);
}

Result<void> write_file(const std::string& path, const Document& document, const Format& format,
                        const WriteOptions& options, bool replace, Diagnostics& diagnostics) {
  if (format.write == nullptr) {
    const std::string writable =
        names_of_formats([](const Format& known) { return known.write != nullptr; });
    return fail(make_error(
        ErrorKind::Usage, "FMT002",
        fmt::format("{} is only read, not written; what is written: {}", format.name, writable)));
  }
  if (format.has_part != nullptr) {
    return write_set(path, document, format, options, replace, diagnostics);
  }
  WriteOptions with_companion = options;
  if (!format.companion.empty() && options.writes_companion && path == "-") {
    diagnostics.add(Severity::Note, "FMT003",
                    fmt::format("the {} file that belongs to it is not written to standard output",
                                format.companion));
  }
  std::optional<OutputFile> beside;
  std::string beside_path;
  if (!format.companion.empty() && options.writes_companion && path != "-") {
    const Format& other = *find_format(format.companion);
    const std::string name = companion_path(path, other);
    if (name == path) {
      return fail(make_error(ErrorKind::Usage, "FMT004",
                             fmt::format("{} is written as two files, and '{}' is the name of the "
                                         "other one",
                                         format.name, path)));
    }
    WriteOptions for_companion = options;
    for_companion.is_companion = true;
    auto written = write_output(name, document, other, for_companion, replace, diagnostics);
    if (!written) return fail(std::move(written.error()));
    beside = std::move(*written);
    beside_path = name;
    with_companion.companion = name.substr(name.find_last_of('/') + 1);
  }
  auto file = write_output(path, document, format, with_companion, replace, diagnostics);
  if (!file) return fail(std::move(file.error()));
  // Under --strict a warning of a writer is an error, and the file does not come into being.
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  if (beside) {
    if (auto committed = beside->commit(); !committed) return committed;
  }
  auto committed = file->commit();
  // Half of a pair is not left behind, unless it replaced another one.
  if (!committed && beside && !replace) std::filesystem::remove(beside_path);
  return committed;
}

}  // namespace kinefile
