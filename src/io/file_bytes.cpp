// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "io/file_pieces.hpp"
#include "io/system_calls.hpp"
#include "kinefile/io.hpp"

namespace kinefile {
namespace {

Error cannot_read(const std::string& path, int reason) {
  return make_error(ErrorKind::Io, "IO001", fmt::format("cannot read: {}", std::strerror(reason)),
                    path == "-" ? "<stdin>" : path);
}

Error changed(const std::string& path) {
  return make_error(ErrorKind::Io, "IO001", "cannot read: the file changed while it was read",
                    path);
}

/// Reads to the end, in blocks, each directly to its final place. Empty after a fault, which is in
/// errno.
/// \param likely_size  the expected number of bytes
std::optional<Array<char>> read_all(int descriptor, std::size_t likely_size) {
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  Array<char> bytes;
  bytes.reserve(likely_size + 1);  // one more byte detects the end without another block
  while (true) {
    const std::size_t old_size = bytes.size();
    const std::size_t wanted =
        old_size <= likely_size ? std::min(kBlock, likely_size + 1 - old_size) : kBlock;
    char* const place = bytes.grow(wanted).data();
    const ssize_t count = uninterrupted([&] { return ::read(descriptor, place, wanted); });
    bytes.resize(old_size + (count > 0 ? static_cast<std::size_t>(count) : 0));
    if (count == 0) return bytes;
    const bool waits = count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
    if (count < 0 && !(waits && wait_for(descriptor, POLLIN))) return std::nullopt;
  }
}

}  // namespace

Result<FileBytes> FileBytes::open(const std::string& path) {
  const bool is_stdin = path == "-";
  const Descriptor file(is_stdin ? STDIN_FILENO : uninterrupted([&] {
    return ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  }));
  struct stat before {};
  if (!file || ::fstat(file.number(), &before) != 0) return fail(cannot_read(path, errno));
  if (S_ISDIR(before.st_mode)) return fail(cannot_read(path, EISDIR));
  const bool has_size = S_ISREG(before.st_mode) && !is_stdin;
  const std::size_t size = has_size ? static_cast<std::size_t>(before.st_size) : 0;
  auto read = read_all(file.number(), size);
  if (!read) return fail(cannot_read(path, errno));
  struct stat after {};
  if (has_size && (::fstat(file.number(), &after) != 0 || has_changed(before, after))) {
    return fail(changed(path));  // the bytes may be neither the old nor the new content
  }
  FileBytes bytes;
  bytes.bytes_ = std::make_shared<const Array<char>>(std::move(*read));
  return bytes;
}

}  // namespace kinefile
