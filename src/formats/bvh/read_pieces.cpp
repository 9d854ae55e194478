// SPDX-License-Identifier: MIT
#include "formats/bvh/read_pieces.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "formats/bvh/parser.hpp"
#include "formats/row_pieces.hpp"
#include "text/decode.hpp"

namespace kinefile::bvh {
namespace {

/// How much of a file is looked at for the beginning of its rows, at first and at the most.
constexpr std::size_t kFirstHead = std::size_t{1} << 16;
constexpr std::size_t kMostHead = std::size_t{1} << 24;

/// Reads bytes up to the last line end among the first ones.
bool read_head(const ByteSource& bytes, std::size_t size, Array<char>& head) {
  head.resize(std::min(size, bytes.size));
  if (!bytes.read(0, head.mutate())) return false;
  while (!head.empty() && head.back() != '\n') head.resize(head.size() - 1);
  return !head.empty();
}

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
  for (std::size_t size = kFirstHead; size <= kMostHead; size *= 16) {
    if (!read_head(bytes, size, text)) return nullptr;
    auto head = parse_head({text.data(), text.size()}, options, are_strict);
    if (head != nullptr || size >= bytes.size) return head;
  }
  return nullptr;
}

/// Reads the rows behind the head; false if the file is not plain.
/// \param offset  where they begin
bool read_rows(const ByteSource& bytes, std::size_t offset, File& file) {
  std::size_t num_bytes = 0;
  const auto use = [&](std::span<const double> rows, std::size_t piece_bytes) {
    num_bytes += piece_bytes;
    if (file.num_frames == 0 && !rows.empty()) {
      // As many rows as if all were as long as the first ones.
      const std::size_t num_pieces = (bytes.size - offset) / num_bytes + 1;
      file.values.reserve(rows.size() * (num_pieces + 1));
    }
    file.values.append(rows);
    file.num_frames += rows.size() / file.num_columns;
    return true;
  };
  return read_row_pieces(bytes, offset, file.num_columns, use) == PiecesEnd::AllRead;
}

}  // namespace

std::optional<Result<Document>> read_pieces(const ByteSource& bytes,
                                            const kinefile::ReadOptions& options,
                                            Diagnostics& diagnostics) {
  Array<char> text;
  const auto head = find_head(bytes, options, diagnostics.warnings_are_errors, text);
  if (head == nullptr) return std::nullopt;
  File& file = head->file;
  const auto offset = static_cast<std::size_t>(head->body.begin - text.data());
  const std::size_t num_bytes = bytes.size - offset;
  if (head->body.claim && *head->body.claim > most_rows(file, num_bytes)) return std::nullopt;
  if (!read_rows(bytes, offset, file)) return std::nullopt;
  diagnostics.append(std::move(head->diagnostics));
  compare_with_claim(head->source, head->body, file.num_frames, diagnostics);
  Document document =
      document_of(std::move(file), head->source, layout_of(head->decoded), options, diagnostics);
  // With --strict a warning is an error, and whoever reads the whole file reports it.
  if (diagnostics.has_errors()) return std::nullopt;
  return document;
}

}  // namespace kinefile::bvh
