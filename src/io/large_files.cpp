// SPDX-License-Identifier: MIT
#include "io/large_files.hpp"

#include <memory>
#include <utility>

#include "io/documents.hpp"
#include "io/file_pieces.hpp"
#include "kinefile/io.hpp"

namespace kinefile {
namespace {

/// A file that is read piece by piece, and its format.
struct LargeFile {
  FilePieces pieces;
  const Format* format = nullptr;
};

/// Opens a large file; null if it is small, or nothing that can be read piece by piece.
/// \param format  null: found from the content, then from the name
std::shared_ptr<const LargeFile> open_large_file(const std::string& path, const Format* format,
                                                 const ReadOptions& options) {
  constexpr std::size_t kLarge = std::size_t{1} << 20;
  const bool is_held = options.opened != nullptr && options.holds_opened;
  if (path == "-" || is_held || !options.model_root.empty()) return nullptr;
  auto pieces = FilePieces::open(path, kLarge);
  if (!pieces) return nullptr;
  if (format == nullptr) format = detect_format(pieces->head(kHeadBytes), path);
  if (format == nullptr) return nullptr;
  return std::make_shared<const LargeFile>(LargeFile{*std::move(pieces), format});
}

/// The bytes of a file as long as it is what it was, and the file with them.
ByteSource bytes_of(std::shared_ptr<const FilePieces> file) {
  ByteSource bytes = file->source();
  bytes.read = [read = std::move(bytes.read), file = std::move(file)](std::size_t offset,
                                                                      std::span<char> out) {
    return read(offset, out) && file->is_unchanged();
  };
  return bytes;
}

/// Adds a file to those that were opened.
void record(const std::string& path, const std::shared_ptr<const LargeFile>& file,
            const OpenedFiles& opened) {
  if (opened == nullptr) return;
  const std::shared_ptr<const FilePieces> pieces(file, &file->pieces);
  opened->push_back({path, {}, nullptr, bytes_of(pieces)});
}

/// The same frames, as long as the file is what it was.
FrameSource while_unchanged(FrameSource frames, std::shared_ptr<const LargeFile> file,
                            const std::string& path) {
  frames.rows = [rows = std::move(frames.rows), file = std::move(file), path](
                    std::size_t first, std::size_t count) -> Result<std::span<const double>> {
    auto read = rows(first, count);
    if (read && !file->pieces.is_unchanged()) {
      return fail(make_error(ErrorKind::Io, "IO001",
                             "cannot read: the file changed while it was read", path));
    }
    return read;
  };
  return frames;
}

}  // namespace

std::optional<ByteSource> open_pieces(const std::string& path) {
  auto pieces = FilePieces::open(path, 0);
  if (!pieces) return std::nullopt;
  return bytes_of(std::make_shared<const FilePieces>(*std::move(pieces)));
}

std::optional<Result<Document>> read_large_file(const std::string& path, const Format* format,
                                                ReadOptions options, Diagnostics& diagnostics) {
  const auto file = open_large_file(path, format, options);
  if (file == nullptr || file->format->read_pieces == nullptr) return std::nullopt;
  options.source_name = path;
  Diagnostics own;
  own.warnings_are_errors = diagnostics.warnings_are_errors;
  const OpenedFiles opened = options.opened;
  // The others count only if the file is read here.
  if (opened) options.opened = std::make_shared<std::vector<CompanionFile>>();
  options.companions = recording(files_beside(path, {}, &own), options.opened);
  if (!read_named_skeleton(file->format, options, own)) return std::nullopt;
  auto document = file->format->read_pieces(file->pieces.source(), options, own);
  if (!document || !file->pieces.is_unchanged()) return std::nullopt;
  diagnostics.append(std::move(own));
  record(path, file, opened);
  if (opened) opened->insert(opened->end(), options.opened->begin(), options.opened->end());
  return document;
}

std::optional<LongMotion> open_long_motion(const std::string& path, const Format* format,
                                           double most_bytes_in_memory, ReadOptions options,
                                           Diagnostics& diagnostics) {
  const auto file = open_large_file(path, format, options);
  if (file == nullptr || file->format->open_frames == nullptr) return std::nullopt;
  options.source_name = path;
  Diagnostics own;
  own.warnings_are_errors = diagnostics.warnings_are_errors;
  auto motion =
      file->format->open_frames(file->pieces.source(), most_bytes_in_memory, options, own);
  if (!motion || !file->pieces.is_unchanged()) return std::nullopt;
  diagnostics.append(std::move(own));
  record(path, file, options.opened);
  motion->frames = while_unchanged(std::move(motion->frames), file, path);
  return motion;
}

}  // namespace kinefile
