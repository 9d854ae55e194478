// SPDX-License-Identifier: MIT
#include "io/documents.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "base/words.hpp"
#include "io/large_files.hpp"
#include "kinefile/io.hpp"

namespace kinefile {
namespace {

std::string names_of_formats(bool (*is_wanted)(const Format&)) {
  std::string names;
  for (const Format& format : formats()) {
    if (!is_wanted(format)) continue;
    if (!names.empty()) names += ", ";
    names += format.name;
  }
  return names;
}

/// Opens a file, and adds it to those that were opened.
Result<FileBytes> open_recorded(const std::string& path, const std::string& source_name,
                                const OpenedFiles& opened) {
  auto bytes = FileBytes::open(path);
  if (bytes && opened) opened->push_back({source_name, bytes->view(), bytes->owner()});
  return bytes;
}

/// OUT.asf for OUT.amc.
std::string companion_path(const std::string& path, const Format& format) {
  const std::size_t slash = path.find_last_of('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  const std::size_t dot = path.find_last_of('.');
  const bool has_extension = dot != std::string::npos && dot > name;
  return (has_extension ? path.substr(0, dot) : path) + std::string(format.extensions.front());
}

/// If the name is the stem of a set of files, the first existing file of the set; otherwise the
/// name itself.
std::string path_in_set(const std::string& name, const Format& format) {
  std::error_code fault;
  if (format.write_set == nullptr || std::filesystem::is_regular_file(name, fault)) return name;
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

/// The result of a writer, or the fault of a file, which is more informative than the fact that the
/// writer was stopped.
Result<void> with_fault(Result<void> written, const OutputFiles& files) {
  if (written || written.error().kind != ErrorKind::Io) return written;
  auto fault = files.fault();
  return fault ? written : fault;
}

}  // namespace

Result<void> write_content(const std::string& name, const OutputFiles& files,
                           FunctionRef<Result<void>(const Sink& sink)> print) {
  const auto sink = files.open(name);
  if (!sink) return fail(sink.error());
  return with_fault(print(*sink), files);
}

Resolver recording(Resolver inner, const OpenedFiles& opened) {
  if (!opened || !inner.open) return inner;
  Resolver recorder = inner;
  recorder.open = [open = std::move(inner.open), opened](const std::string& name) {
    auto found = open(name);
    if (found) opened->push_back(*found);
    return found;
  };
  return recorder;
}

Result<void> read_named_skeleton(const Format* format, ReadOptions& options,
                                 Diagnostics& diagnostics) {
  const bool takes_skeleton = format != nullptr && format->takes_skeleton;
  if (!takes_skeleton || options.skeleton_name.empty() || options.skeleton != nullptr) return {};
  ReadOptions skeleton_options;
  skeleton_options.lenient = options.lenient;
  skeleton_options.of_formats = options.of_formats;
  skeleton_options.metres_per_unit = options.metres_per_unit;
  skeleton_options.up = options.up;
  skeleton_options.model_root = options.model_root;
  skeleton_options.opened = options.opened;
  auto skeleton = read_file(options.skeleton_name, nullptr, skeleton_options, diagnostics);
  if (!skeleton) return fail(std::move(skeleton.error()));
  options.skeleton = std::make_shared<const Document>(std::move(*skeleton));
  return {};
}

Result<Document> read_bytes(std::string_view bytes, const std::string& name, const Format* format,
                            ReadOptions options, Diagnostics& diagnostics) {
  options.source_name = name;
  if (format == nullptr) {
    const std::string_view head = bytes.substr(0, kHeadBytes);
    format = detect_format(head, name);
    if (const ForeignFormat* foreign = find_foreign(head, name, format)) {
      return fail(make_error(
          ErrorKind::InvalidInput, "FMT008",
          fmt::format("expected a file that can be read, found {}", foreign->advice), name));
    }
  }
  if (format == nullptr || format->read == nullptr) {
    const std::string readable =
        names_of_formats([](const Format& known) { return known.read != nullptr; });
    return fail(make_error(
        ErrorKind::InvalidInput, "FMT001",
        format == nullptr
            ? fmt::format("neither the content nor the name shows a format; --from names it ({})",
                          readable)
            : fmt::format("{} is only written, not read; what is read: {}", format->name, readable),
        name));
  }
  return format->read(bytes, options, diagnostics);
}

Result<Document> read_file(const std::string& name, const Format* asked, ReadOptions options,
                           Diagnostics& diagnostics) {
  const std::string path = asked != nullptr ? path_in_set(name, *asked) : name;
  if (auto document = read_large_file(path, asked, options, diagnostics))
    return *std::move(document);
  const std::string source_name = path == "-" ? "<stdin>" : path;
  const auto bytes = open_recorded(path, source_name, options.opened);
  if (!bytes) return fail(bytes.error());
  std::error_code fault;
  if (!options.model_root.empty() && !std::filesystem::is_directory(options.model_root, fault)) {
    return fail(make_error(ErrorKind::Usage, "IO004", "expected a folder as the model root",
                           options.model_root));
  }
  if (path != "-" && !options.companions.open) {
    options.companions = files_beside(path, options.model_root, &diagnostics);
  }
  options.companions = recording(std::move(options.companions), options.opened);
  const Format* format = asked;
  if (format == nullptr) format = detect_format(bytes->view().substr(0, kHeadBytes), source_name);
  if (auto skeleton = read_named_skeleton(format, options, diagnostics); !skeleton) {
    return fail(std::move(skeleton.error()));
  }
  return read_bytes(bytes->view(), source_name, asked, std::move(options), diagnostics);
}

namespace {

/// Writes a set of files.
Result<void> write_set(const std::string& path, const Document& document, const Format& format,
                       const WriteOptions& options, const OutputFiles& files,
                       Diagnostics& diagnostics) {
  if (path == "-") {
    return fail(
        ErrorKind::Usage, "FMT006",
        fmt::format("{} is a set of files, which standard output cannot take", format.name));
  }
  const std::string stem = stem_of_set(path, format);
  std::set<std::string> names;
  const OpenPart open = [&](std::string_view part) {
    const std::string name = stem + std::string(part);
    names.insert(name);
    return files.open(name);
  };
  auto written = with_fault(format.write_set(document, options, open, diagnostics), files);
  if (!written) return written;
  for (const std::string_view part : format.extensions) {
    const std::string name = stem + std::string(part);
    if (names.contains(name) || !files.exists(name)) continue;
    // It would be read as part of the set, and we must not delete it.
    return fail(make_error(ErrorKind::Io, "FMT007",
                           "the file is there and would be read as part of the set, which has "
                           "none such; move it away, or name another stem",
                           name));
  }
  return {};
}

/// Writes the file that belongs to another one, such as the skeleton of an AMC file, and reports
/// its name. It holds only the skeleton, as a separate document.
Result<void> write_companion(const std::string& path, const Document& document,
                             const Format& format, WriteOptions& options, const OutputFiles& files,
                             Diagnostics& diagnostics) {
  if (path == "-") {
    diagnostics.add(Severity::Note, "FMT003",
                    fmt::format("the {} file that belongs to it is not written to standard output",
                                format.companion));
    return {};
  }
  const Format& other = *find_format(format.companion);
  const std::string name = companion_path(path, other);
  if (name == path) {
    return fail(ErrorKind::Usage, "FMT004",
                fmt::format("{} is written as two files, and '{}' is the name of the other one",
                            format.name, path));
  }
  Document companion = document;
  if (has_skeleton(document)) companion.content = skeleton_of(document);
  auto written = write_content(name, files, [&](const Sink& sink) {
    return other.write(companion, options, sink, diagnostics);
  });
  options.companion = name.substr(name.find_last_of('/') + 1);
  return written;
}

/// Writes a document that is one file, and its companion.
/// \param print  writes the file's content, by options that name the companion
Result<void> write_with_companion(
    const std::string& name, const Document& document, const Format& format,
    const WriteOptions& options, const OutputFiles& files, Diagnostics& diagnostics,
    FunctionRef<Result<void>(const WriteOptions& options, const Sink& sink)> print) {
  WriteOptions with_companion = options;
  if (!format.companion.empty() && options.writes_companion) {
    auto written = write_companion(name, document, format, with_companion, files, diagnostics);
    if (!written) return written;
  }
  return write_content(name, files, [&](const Sink& sink) { return print(with_companion, sink); });
}

/// With --strict a warning of a writer is an error, and the file is not created.
Result<void> unless_strict(Result<void> written, const Diagnostics& diagnostics) {
  if (written && diagnostics.has_errors()) return fail(diagnostics.first_error());
  return written;
}

}  // namespace

Result<RobotProject> read_project_file(const std::string& path, ReadOptions options,
                                       Diagnostics& diagnostics) {
  options.source_name = path == "-" ? "<stdin>" : path;
  options.companions = recording(files_beside(path, {}, &diagnostics), options.opened);
  const auto bytes = open_recorded(path, options.source_name, options.opened);
  if (!bytes) return fail(bytes.error());
  return read_project(bytes->view(), options, diagnostics);
}

Result<void> write(const std::string& name, const Document& document, const Format& format,
                   const WriteOptions& options, const OutputFiles& files,
                   Diagnostics& diagnostics) {
  if (!is_written(format)) {
    const std::string writable = names_of_formats(is_written);
    const std::string reason = format.write_poses != nullptr ? " is for poses, which fk writes"
                                                             : " is only read, not written";
    return fail(ErrorKind::Usage, "FMT002",
                std::string(format.name) + reason + "; what is written: " + writable);
  }
  if (format.write_set != nullptr) {
    return unless_strict(write_set(name, document, format, options, files, diagnostics),
                         diagnostics);
  }
  const auto print = [&](const WriteOptions& with_companion, const Sink& sink) {
    return format.write(document, with_companion, sink, diagnostics);
  };
  return unless_strict(
      write_with_companion(name, document, format, options, files, diagnostics, print),
      diagnostics);
}

Result<void> write_in_blocks(const std::string& name, const LongMotion& motion,
                             const Format& format, const WriteOptions& options,
                             const OutputFiles& files, Diagnostics& diagnostics) {
  const auto print = [&](const WriteOptions& with_companion, const Sink& sink) {
    return format.write_frames(motion, with_companion, sink, diagnostics);
  };
  return unless_strict(
      write_with_companion(name, motion.document, format, options, files, diagnostics, print),
      diagnostics);
}

Result<void> write_file(const std::string& path, const Document& document, const Format& format,
                        const WriteOptions& options, const OutputOptions& output,
                        Diagnostics& diagnostics) {
  const OutputFiles files = files_on_disk(output);
  auto written = write(path, document, format, options, files, diagnostics);
  return written ? files.commit() : written;
}

}  // namespace kinefile
