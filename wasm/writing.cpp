// SPDX-License-Identifier: MIT
#include "writing.hpp"

#include <memory>
#include <utility>

#include "kinefile/process.hpp"

namespace kinefile::page {
namespace {

/// Sets what an output's format and the conversion to it have options for, by their words.
Result<void> set_writing(const Format& format, const Json& words, WriteOptions& writing,
                         AdaptOptions& adapting) {
  Json of_format = Json::object(), of_conversion = Json::object();
  for (const auto& [name, word] : words.items()) {
    const bool is_of_format = find_option(format.write_options, name) != nullptr;
    (is_of_format ? of_format : of_conversion)[name] = word;
  }
  std::vector<std::span<const Option<AdaptOptions>>> conversions;
  for (const AdaptOption& one : adapt_options()) {
    if (one.is_for(format)) conversions.emplace_back(&one.option, 1);
  }
  const std::span<const WriteOption> table[] = {format.write_options};
  auto set = set_options<WriteOptions>(writing, of_format, table);
  if (set) set = set_options<AdaptOptions>(adapting, of_conversion, conversions);
  return set;
}

/// A document with its first two frames alone, which have a rate.
Document first_frames(const Document& document) {
  Document few = document;
  Diagnostics ignored;
  const auto trim = parse_operation("trim=0:2");
  const bool is_short = trim && apply(std::span(&*trim, 1), few, {}, ignored).has_value();
  return is_short ? few : document;
}

/// Writes a document, in place of the one of its slot.
Result<std::vector<MemoryFile>> files_of_document(const Session& session, const Slot& slot,
                                                  const Document& document, const Writing& writing,
                                                  Diagnostics& diagnostics) {
  const auto& [name, format, words] = writing;
  AdaptOptions adapting;
  if (format.name != slot.source.format) {
    adapting.skeleton = source_of_model(slot);
    adapting.skeleton_name = slot.opening.skeleton;
  }
  WriteOptions options;
  if (auto set = set_writing(format, words, options, adapting); !set) {
    return fail(std::move(set.error()));
  }
  Slot own;
  own.opening = slot.opening;
  auto project = project_of(session, own, diagnostics);
  if (!project) return fail(std::move(project.error()));
  options.project = std::move(*project);
  auto adapted = adapt(document, format, adapting, options, diagnostics);
  if (!adapted) return fail(std::move(adapted.error()));
  const auto files = std::make_shared<std::vector<MemoryFile>>();
  const OutputFiles output = files_in_memory(files);
  auto written = write(name, *adapted, format, options, output, diagnostics);
  if (written) written = output.commit();
  if (!written) return fail(std::move(written.error()));
  return std::move(*files);
}

/// What is written of a slot in a format: a flow stays a flow where the format has one, otherwise
/// it is what its robot does.
/// \errors CLI001 (Usage) if a flow shows no robot
Result<const Document*> document_for(const Slot& slot, const Format& format) {
  if (contains(format.conventions.writes, slot.current)) return &slot.current;
  if (!slot.lacks.empty()) return fail(ErrorKind::Usage, "CLI001", slot.lacks);
  return &slot.played;
}

}  // namespace

Result<std::vector<MemoryFile>> written_files(const Session& session, const Slot& slot,
                                              const Writing& writing, Diagnostics& diagnostics) {
  const auto document = document_for(slot, writing.format);
  if (!document) return fail(document.error());
  return files_of_document(session, slot, **document, writing, diagnostics);
}

std::string hindrance_of_writing(const Session& session, const Slot& slot, const Format& format) {
  const auto document = document_for(slot, format);
  if (!document) return document.error().message;
  Diagnostics ignored;
  const std::string name = "a" + std::string(format.extensions[0]);
  const auto files =
      files_of_document(session, slot, first_frames(**document), {name, format}, ignored);
  // What is lost of the values is told when they are written.
  return files || files.error().kind != ErrorKind::Usage ? std::string() : files.error().message;
}

}  // namespace kinefile::page
