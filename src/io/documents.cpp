// SPDX-License-Identifier: MIT
#include <fmt/format.h>

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

}  // namespace

Result<Document> read_file(const std::string& path, const Format* format, ReadOptions options,
                           Diagnostics& diagnostics) {
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
  if (!options.skeleton_name.empty() && options.skeleton == nullptr) {
    auto skeleton = read_skeleton(options.skeleton_name, options, diagnostics);
    if (!skeleton) return fail(std::move(skeleton.error()));
  }
  if (path != "-" && !options.companions.open) options.companions = files_beside(path);
  return format->read(bytes->view(), options, diagnostics);
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
  auto file = OutputFile::create(path, replace);
  if (!file) return fail(file.error());
  const Sink sink = [&file](std::string_view piece) { return file->write(piece); };
  const auto written = format.write(document, options, sink, diagnostics);
  // A fault of the file says more than that the writer was stopped.
  if (!written && written.error().kind != ErrorKind::Io) return fail(written.error());
  // Under --strict a warning of the writer is an error, and the file does not come into being.
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  return file->commit();
}

}  // namespace kinefile
