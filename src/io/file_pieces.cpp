// SPDX-License-Identifier: MIT
#include "io/file_pieces.hpp"

#include <fcntl.h>

#include <algorithm>
#include <utility>

namespace kinefile {
namespace {

bool read_exactly(int descriptor, std::size_t offset, std::span<char> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = uninterrupted([&] {
      return ::pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    });
    if (count <= 0) return false;  // a file that was cut off, too
    offset += static_cast<std::size_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

bool has_changed(const struct stat& before, const struct stat& after) {
  return before.st_size != after.st_size || before.st_mtim.tv_sec != after.st_mtim.tv_sec ||
         before.st_mtim.tv_nsec != after.st_mtim.tv_nsec;
}

std::optional<FilePieces> FilePieces::open(const std::string& path, std::size_t least_size) {
  const auto is_large = [least_size](const struct stat& state) {
    return S_ISREG(state.st_mode) && static_cast<std::size_t>(state.st_size) >= least_size;
  };
  FilePieces pieces;
  struct stat& opened = pieces.opened_;
  // Only regular files are opened here: who writes to a pipe would lose what it writes when it is
  // closed again.
  if (::stat(path.c_str(), &opened) != 0 || !is_large(opened)) return std::nullopt;
  pieces.file_ = Descriptor(
      uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); }));
  const bool is_open = pieces.file_ && ::fstat(pieces.file_.number(), &opened) == 0;
  if (!is_open || !is_large(opened)) return std::nullopt;
  return pieces;
}

ByteSource FilePieces::source() const {
  ByteSource bytes;
  bytes.size = static_cast<std::size_t>(opened_.st_size);
  bytes.read = [descriptor = file_.number()](std::size_t offset, std::span<char> out) {
    return read_exactly(descriptor, offset, out);
  };
  return bytes;
}

std::string FilePieces::head(std::size_t count) const {
  std::string bytes(std::min(count, static_cast<std::size_t>(opened_.st_size)), '\0');
  return read_exactly(file_.number(), 0, bytes) ? bytes : std::string();
}

bool FilePieces::is_unchanged() const {
  struct stat now {};
  return ::fstat(file_.number(), &now) == 0 && !has_changed(opened_, now);
}

}  // namespace kinefile
