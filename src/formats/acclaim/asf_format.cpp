// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>

#include "formats/acclaim/bind.hpp"
#include "formats/acclaim/codes.hpp"
#include "formats/acclaim/format.hpp"
#include "formats/acclaim/parser.hpp"
#include "formats/acclaim/print.hpp"
#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "text/decode.hpp"
#include "text/scanner.hpp"

namespace kinefile::acclaim {
namespace {

constexpr Kinds kAsfWrites = {.motions = true, .skeletons = true};
constexpr std::array<std::string_view, 2> kAsfExtensions = {".asf", ".ast"};
constexpr std::array<ReadOption, 3> kAsfReadOptions = {options::kEncoding, options::kUnitIn,
                                                       options::kUpIn};
constexpr std::array<WriteOption, 1> kAsfWriteOptions = {options::kDecimals};

bool probe_asf(std::string_view head) {
  constexpr std::array<std::string_view, 5> kSections = {":version", ":name", ":units", ":root",
                                                         ":bonedata"};
  return text::is_one_of(Lexer(head).take(), kSections);
}

/// Reports the assumed unit of length, because no file specifies it.
void note_unit(double length, const text::Source& source, Diagnostics& diagnostics) {
  text::report(source, diagnostics, Severity::Note, code::kUnitAssumed,
               fmt::format("lengths divided by {} are taken as inches, which makes a unit {} m; "
                           "--unit-in says otherwise",
                           length, kMetresPerInch / length),
               source.text().data());
}

Result<Document> read_asf_alone(std::string_view bytes, const ReadOptions& options,
                                Diagnostics& diagnostics) {
  auto skeleton = read_skeleton(bytes, options, diagnostics);
  if (!skeleton) return fail(std::move(skeleton.error()));
  Document document;
  document.format = "asf";
  document.content = bind(skeleton->file, {false, skeleton->metres_per_quotient, options.up});
  document.kept = Kept(KeptFile{skeleton->text, kept_of(std::move(skeleton->file)), {}});
  return document;
}

Result<Document> read_asf(std::string_view bytes, const ReadOptions& options,
                          Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_asf_alone, bytes, options, diagnostics);
}

Result<void> write_asf(const Document& document, const WriteOptions& options, const Sink& sink,
                       Diagnostics& diagnostics) {
  if (auto taken = expect_kind(document, kAsfWrites, "a motion or a skeleton to write as ASF");
      !taken) {
    return taken;
  }
  if (std::holds_alternative<Motion>(document.content)) {
    diagnostics.add(Severity::Warning, code::kMotionLeftOut,
                    "ASF holds the skeleton alone; the motion is left out, which AMC holds");
  }
  const KeptFile kept = kept_file_of(document);
  auto unbound = unbind(skeleton_of(document), kept);
  if (!unbound) return fail(std::move(unbound.error()));
  text::Printer printer(sink, {.decimals = options.decimals});
  print_asf(printer, unbound->file, line_end_of(kept.text));
  return finish(printer);
}

Result<void> write_asf_of_frames(const LongMotion& motion, const WriteOptions& options,
                                 const Sink& sink, Diagnostics& diagnostics) {
  return write_asf(motion.document, options, sink, diagnostics);
}

}  // namespace

Result<ReadSkeleton> read_skeleton(std::string_view bytes, const ReadOptions& options,
                                   Diagnostics& diagnostics) {
  auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded) return fail(std::move(decoded.error()));
  const text::Source source(options.source_name, decoded->view());
  ReadSkeleton skeleton;
  skeleton.file = parse_asf(source, options.lenient, diagnostics);
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  skeleton.text = layout_of(*decoded);
  // Without a unit in the file no unit can be assumed.
  const auto& length = skeleton.file.length;
  skeleton.metres_per_quotient = options.metres_per_unit.value_or(length ? kMetresPerInch : 0.0);
  if (length && !options.metres_per_unit) note_unit(*length, source, diagnostics);
  return skeleton;
}

Format asf_format() {
  Format format;
  format.name = "asf";
  format.description = "Acclaim skeleton";
  format.extensions = kAsfExtensions;
  format.probe = probe_asf;
  format.read = read_asf;
  format.write = write_asf;
  if (kReadsInBlocks) format.write_frames = write_asf_of_frames;
  format.facts = facts;
  format.conventions.writes = kAsfWrites;
  format.conventions.has_one_end = true;
  format.conventions.keeps_times = true;  // an ASF file has no frames
  format.read_options = kAsfReadOptions;
  format.write_options = kAsfWriteOptions;
  return format;
}

}  // namespace kinefile::acclaim
