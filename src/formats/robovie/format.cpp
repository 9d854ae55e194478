// SPDX-License-Identifier: MIT
#include "formats/robovie/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "formats/robovie/codes.hpp"
#include "formats/robovie/decode.hpp"
#include "formats/robovie/print.hpp"
#include "formats/robovie/reader.hpp"
#include "text/encode.hpp"
#include "text/printer.hpp"

namespace kinefile::robovie {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".txt"};
constexpr std::array<ReadOption, 3> kReadOptions = {
    options::kProject,
    words::format_option<kinefile::ReadOptions, &robovie::ReadOptions::max_speed>({
        .name = "max-speed",
        .type = OptionType::Number,
        .value_name = "UNITS",
        .help = "Warn of sliders of a flow that go further than so many units in a tick",
        .wanted = "units a tick above 0",
        .least = std::numeric_limits<double>::min(),
        .most = 1e9,
    }),
    options::kEncoding,
};
constexpr std::array<WriteOption, 1> kWriteOptions = {
    words::format_option<kinefile::WriteOptions, &robovie::WriteOptions::encoding>({
        .name = "encoding",
        .type = OptionType::Choice,
        .value_name = "ENCODING",
        .help = "Encoding of a flow that is written; else that of the input, or utf-16le",
        .choices = options::kEncodings,
    })};

constexpr Kinds kWrites = {.flows = true};

/// The data that a document keeps from its file.
struct KeptFile {
  FlowFormat format = FlowFormat::V1R4;
  TextLayout text;
  std::string encoding;
  bool has_bom = false;
  std::optional<bool> has_blank_lines;  ///< before every block; absent: the format's default
  bool ends_with_line = true;           ///< whether the last line has a line end, too
};

/// Looks for the first line, which is the same in all files.
bool probe(std::string_view head) {
  constexpr std::size_t kEnough = 1024;
  Diagnostics ignored;
  const auto decoded = decode_motion(head.substr(0, kEnough), {}, ignored);
  if (!decoded) return false;
  const std::size_t first = decoded->view().find_first_not_of(" \t\r\n");
  return first != std::string_view::npos &&
         decoded->view().substr(first).starts_with("_MOTION_FORMAT:");
}

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return (c & 0x80) == 0; });
}

/// Reports once that a file is not encoded or laid out as the editor writes it.
void check_encoding(const Reader& reader, const text::DecodedText& decoded, FlowFormat format) {
  const std::string_view line_end = text::line_end_of(decoded.view());
  const bool is_utf16 = decoded.encoding == "utf-16le" && decoded.has_bom;
  // The encoding of the older editor is not known; that of Windows is likely.
  const bool is_old = format == FlowFormat::WordN && !decoded.has_bom &&
                      (decoded.encoding == "cp932" || is_ascii(decoded.view()));
  if (line_end == "crlf" && (is_utf16 || is_old)) return;
  reader.warn(code::kOtherEncoding,
              fmt::format("expected utf-16le with BOM and line ends crlf, as the editor writes, "
                          "found {} and {}; it may not read that",
                          decoded.description(), line_end),
              reader.source.text().data());
}

KeptFile kept_of(const text::DecodedText& decoded, const FlowFile& file) {
  KeptFile kept;
  kept.format = file.flow.format;
  kept.text = kinefile::layout_of(decoded);
  kept.encoding = decoded.encoding;
  kept.has_bom = decoded.has_bom;
  const bool is_usual = file.has_blank_lines == (file.flow.format == FlowFormat::V1R4);
  if (!is_usual) kept.has_blank_lines = file.has_blank_lines;
  kept.ends_with_line = decoded.view().ends_with('\n') || decoded.view().ends_with('\r');
  return kept;
}

std::vector<Fact> facts(const Document& document) {
  const KeptFile* const kept = document.kept.get<KeptFile>();
  if (kept == nullptr) return {};
  std::vector<Fact> all = facts_of(kept->text);
  if (kept->has_blank_lines) {
    all.push_back({"blank_lines", *kept->has_blank_lines ? "blocks" : "none", {}});
  }
  if (!kept->ends_with_line) all.push_back({"last_line_end", "none", {}});
  return all;
}

Result<Document> read_alone(std::string_view bytes, const kinefile::ReadOptions& options,
                            Diagnostics& diagnostics) {
  const auto decoded = decode_motion(bytes, options, diagnostics);
  if (!decoded) return fail(decoded.error());
  const text::Source source(options.source_name, decoded->view());
  const Reader reader{source, options, diagnostics};
  FlowFile file = parse(reader);
  if (file.start != nullptr) check_encoding(reader, *decoded, file.flow.format);
  check(reader, file);
  check_on_robot(reader, file);
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  Document document;
  document.format = "robovie";
  document.kept = Kept(kept_of(*decoded, file));
  document.content = std::move(file.flow);
  return document;
}

Result<Document> read(std::string_view bytes, const kinefile::ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

/// The layout for a document: that of its file, changed by the options. A flow that has become
/// POSEDEF_V1R4 has the layout of that format: only the newer editor reads it, and reads no other.
Layout layout_of(const Document& document, FlowFormat format,
                 const kinefile::WriteOptions& options) {
  Layout layout;
  layout.has_blank_lines = format == FlowFormat::V1R4;
  const KeptFile* const kept = document.kept.get<KeptFile>();
  if (kept != nullptr && (kept->format == format || format == FlowFormat::WordN)) {
    layout.encoding = kept->encoding;
    layout.has_bom = kept->has_bom;
    layout.line_end = line_end_of(kept->text);
    layout.ends_with_line = kept->ends_with_line;
    layout.has_blank_lines = kept->has_blank_lines.value_or(layout.has_blank_lines);
  }
  const std::string& encoding = options.of_formats.get<robovie::WriteOptions>().encoding;
  if (!encoding.empty() && encoding != layout.encoding) {
    layout.encoding = encoding;
    layout.has_bom = encoding.starts_with("utf-16");
  }
  // This option is meant for the editor.
  if (encoding == "utf-16le") layout.line_end = "\r\n";
  return layout;
}

/// Prints lines in an encoding.
class EncodedPrinter {
 public:
  EncodedPrinter(const Layout& layout, const Sink& sink) : layout_(layout), printer_(sink) {
    if (layout.has_bom) printer_.print(text::byte_order_mark(layout.encoding));
  }

  /// Prints lines that end with "
  /// ".
  /// \returns a character that the encoding does not have
  std::string_view print(std::string_view lines) {
    while (!lines.empty()) {
      const std::size_t end = lines.find('\n');
      bytes_.clear();
      if (has_line_) text::append_encoded(bytes_, layout_.line_end, layout_.encoding);
      const std::string_view other =
          text::append_encoded(bytes_, lines.substr(0, end), layout_.encoding);
      if (!other.empty()) return other;
      printer_.print(bytes_);
      has_line_ = true;
      lines.remove_prefix(end + 1);
    }
    return {};
  }

  bool finish() {
    bytes_.clear();
    if (layout_.ends_with_line) text::append_encoded(bytes_, layout_.line_end, layout_.encoding);
    printer_.print(bytes_);
    return printer_.finish();
  }

 private:
  const Layout& layout_;
  text::Printer printer_;
  std::string bytes_;
  bool has_line_ = false;
};

Error cannot_write(std::string why) {
  return make_error(ErrorKind::DataLoss, code::kCannotWrite, std::move(why));
}

Result<void> write(const Document& document, const kinefile::WriteOptions& options,
                   const Sink& sink, Diagnostics&) {
  const PoseFlow* const flow = std::get_if<PoseFlow>(&document.content);
  if (flow == nullptr) {
    return fail(ErrorKind::Usage, code::kCannotWrite, "expected a flow of servo poses to write");
  }
  if (const std::string why = why_not_written(*flow); !why.empty()) {
    return fail(cannot_write("the flow cannot be written: " + why));
  }
  const Layout layout = layout_of(document, flow->format, options);
  if (!text::is_encoding(layout.encoding)) {
    return fail(cannot_write(fmt::format("expected an encoding, found '{}'", layout.encoding)));
  }
  EncodedPrinter printer(layout, sink);
  printer.print(header_text(*flow));
  for (std::size_t b = 0; b < flow->blocks.size(); ++b) {
    if (layout.has_blank_lines) printer.print("\n");
    const std::string text = block_text(*flow, flow->blocks[b]);
    if (const std::string_view other = printer.print(text); !other.empty()) {
      return fail(make_error(
          ErrorKind::DataLoss, code::kCannotEncode,
          fmt::format("the texts of block {} have the character '{}', which {} does not have", b,
                      other, layout.encoding)));
    }
  }
  if (!printer.finish()) return fail(make_error(ErrorKind::Io, "IO003", "the output was cut off"));
  return {};
}

}  // namespace

Format format() {
  Format format;
  format.name = "robovie";
  format.description = "Motions of RobovieMaker and RobovieMaker2: flows of servo poses";
  format.extensions = kExtensions;
  format.probe = probe;
  format.read = read;
  format.write = write;
  format.facts = facts;
  format.conventions.writes = kWrites;
  format.read_options = kReadOptions;
  format.write_options = kWriteOptions;
  return format;
}

}  // namespace kinefile::robovie
