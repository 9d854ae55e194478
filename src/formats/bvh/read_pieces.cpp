// SPDX-License-Identifier: MIT
#include "formats/bvh/read_pieces.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "formats/bvh/parser.hpp"
#include "formats/bvh/positions.hpp"
#include "text/decode.hpp"
#include "text/row_pieces.hpp"

namespace kinefile::bvh {
namespace {

/// What is known before the rows are read.
struct Head {
  text::DecodedText decoded;
  text::Source source;
  Diagnostics diagnostics;
  File file;
  Body body;
};

/// Parses the beginning of a file. Empty if it is not plain, or if the rows begin behind it.
std::unique_ptr<Head> parse_head(std::string_view bytes, const kinefile::ReadOptions& options,
                                 bool are_strict) {
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = are_strict;
  auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded || !decoded->storage.empty()) return nullptr;
  const text::Source source(options.source_name, decoded->view());
  const ParseOptions parse_options{options.lenient, options.fps.has_value()};
  Parser parser{source, parse_options, diagnostics, text::Scanner(source.text()), {}};
  if (!parse_hierarchy(parser)) return nullptr;
  const auto body = parse_counts(parser);
  count_columns(parser.file);
  const bool is_plain = body && parser.is_structure_sound && !diagnostics.has_errors() &&
                        parser.file.num_columns > 0 && !parser.scanner.peek().empty();
  if (!is_plain) return nullptr;
  return std::make_unique<Head>(
      Head{std::move(*decoded), source, std::move(diagnostics), std::move(parser.file), *body});
}

/// Parses as much of the beginning as is needed.
/// \param bytes  in: the file; out: its beginning is in `text`, which the result points into
std::unique_ptr<Head> find_head(const ByteSource& bytes, const kinefile::ReadOptions& options,
                                bool are_strict, Array<char>& text) {
  std::unique_ptr<Head> head;
  text = text::read_head_to(bytes, [&](std::string_view lines) {
    head = parse_head(lines, options, are_strict);
    return head == nullptr ? 0 : lines.size();
  });
  return head;
}

/// A file with plain text before its rows.
struct PlainFile {
  Array<char> text;  ///< its beginning
  std::unique_ptr<Head> head;
  std::size_t offset = 0;     ///< where the rows begin
  std::size_t num_bytes = 0;  ///< of the rows
};

std::optional<PlainFile> find_plain_file(const ByteSource& bytes,
                                         const kinefile::ReadOptions& options, bool are_strict) {
  PlainFile plain;
  plain.head = find_head(bytes, options, are_strict, plain.text);
  if (plain.head == nullptr) return std::nullopt;
  const Body& body = plain.head->body;
  plain.offset = static_cast<std::size_t>(body.begin - plain.text.data());
  plain.num_bytes = bytes.size - plain.offset;
  const bool claims_more = body.claim && *body.claim > most_rows(plain.head->file, plain.num_bytes);
  if (claims_more) return std::nullopt;
  return plain;
}

/// Reads the rows behind the head; false if the file is not plain.
/// \param offset  where they begin
bool read_all_rows(const ByteSource& bytes, std::size_t offset, File& file) {
  const auto use = [&](const text::RowPiece& piece) {
    if (file.num_frames == 0 && !piece.starts.empty()) {
      file.values.reserve(text::likely_rows(bytes.size - offset, piece) * file.num_columns);
    }
    file.values.append(piece.values);
    file.num_frames += piece.starts.size();
    return true;
  };
  const text::RowReader reader = text::number_line_reader(file.num_columns);
  return text::read_row_pieces(bytes, offset, reader, use) == text::PiecesEnd::AllRead;
}

/// The frames that guesses are made from.
bool read_sample(const text::IndexedRows& rows, File& file) {
  const std::size_t step = sample_step(rows.num_rows());
  for (std::size_t row = 0; row < rows.num_rows(); row += step) {
    if (!text::read_rows(rows, row, 1, file.values.grow(file.num_columns).data())) return false;
    ++file.num_frames;
  }
  return true;
}

/// Empty if a diagnostic is an error, as a warning is with --strict: whoever reads the whole file
/// reports it.
std::optional<Document> plain_document(PlainFile& plain, std::size_t num_frames,
                                       const kinefile::ReadOptions& options,
                                       Diagnostics& diagnostics) {
  Head& head = *plain.head;
  diagnostics.append(std::move(head.diagnostics));
  compare_with_claim(head.source, head.body, num_frames, diagnostics);
  Document document =
      document_of(std::move(head.file), head.source, layout_of(head.decoded), options, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return document;
}

/// The bytes that the values of a file need, if all rows are as long as the first line.
double estimated_bytes(const PlainFile& plain) {
  const char* const begin = plain.head->body.begin;
  const char* const first = std::find_if(begin, plain.text.end(), [](char c) { return c > ' '; });
  const auto row_bytes = static_cast<double>(std::find(first, plain.text.end(), '\n') - first + 1);
  const auto bytes_of_values = static_cast<double>(plain.head->file.num_columns * sizeof(double));
  return static_cast<double>(plain.num_bytes) / row_bytes * bytes_of_values;
}

/// The rows of a file, some at a time.
FrameSource frames_of(text::IndexedRows&& rows, const std::string& name) {
  struct Reader {
    text::IndexedRows rows;
    std::string name;
    Array<double> values = {};
  };
  FrameSource frames{rows.num_rows(), rows.reader.num_columns};
  const auto reader = std::make_shared<Reader>(Reader{std::move(rows), name});
  frames.rows = [reader](std::size_t first, std::size_t count) -> Result<std::span<const double>> {
    reader->values.resize(count * reader->rows.reader.num_columns);
    if (!text::read_rows(reader->rows, first, count, reader->values.mutate().data())) {
      return fail(make_error(ErrorKind::Io, "IO001",
                             "cannot read: the file changed while it was read", reader->name));
    }
    return std::span<const double>(reader->values);
  };
  return frames;
}

}  // namespace

std::optional<Result<Document>> read_pieces(const ByteSource& bytes,
                                            const kinefile::ReadOptions& options,
                                            Diagnostics& diagnostics) {
  auto plain = find_plain_file(bytes, options, diagnostics.warnings_are_errors);
  if (!plain) return std::nullopt;
  File& file = plain->head->file;
  if (!read_all_rows(bytes, plain->offset, file)) return std::nullopt;
  auto document = plain_document(*plain, file.num_frames, options, diagnostics);
  if (!document) return std::nullopt;
  return *std::move(document);
}

std::optional<LongMotion> open_frames(const ByteSource& bytes, double most_bytes_in_memory,
                                      const kinefile::ReadOptions& options,
                                      Diagnostics& diagnostics) {
  auto plain = find_plain_file(bytes, options, diagnostics.warnings_are_errors);
  if (!plain || estimated_bytes(*plain) <= most_bytes_in_memory) return std::nullopt;
  File& file = plain->head->file;
  auto rows = text::index_rows(bytes, plain->offset, text::number_line_reader(file.num_columns));
  if (!rows || !read_sample(*rows, file)) return std::nullopt;
  auto document = plain_document(*plain, rows->num_rows(), options, diagnostics);
  if (!document) return std::nullopt;
  Clip& clip = std::get<Motion>(document->content).clip;
  clip.num_frames = 0;
  clip.values.clear();
  return LongMotion{*std::move(document), frames_of(std::move(*rows), options.source_name)};
}

}  // namespace kinefile::bvh
