// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "kinefile/io.hpp"

namespace kinefile {
namespace {

Error cannot_read(const std::string& path, int reason) {
  return make_error(ErrorKind::Io, "IO001", fmt::format("cannot read: {}", std::strerror(reason)),
                    path == "-" ? "<stdin>" : path);
}

/// A file descriptor that closes itself.
struct Descriptor {
  int number;
  explicit Descriptor(int opened) : number(opened) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (number > STDERR_FILENO) ::close(number);
  }
};

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
    const ssize_t count = ::read(descriptor, bytes.grow(wanted).data(), wanted);
    bytes.resize(old_size + (count > 0 ? static_cast<std::size_t>(count) : 0));
    if (count == 0) return bytes;
    if (count < 0 && errno != EINTR) return std::nullopt;
  }
}

}  // namespace

Result<FileBytes> FileBytes::open(const std::string& path) {
  const Descriptor file(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) return fail(cannot_read(path, errno));
  if (S_ISDIR(status.st_mode)) return fail(cannot_read(path, EISDIR));
  const bool has_size = S_ISREG(status.st_mode) && path != "-";
  const std::size_t size = has_size ? static_cast<std::size_t>(status.st_size) : 0;
  auto read = read_all(file.number, size);
  if (!read) return fail(cannot_read(path, errno));
  // If the file became shorter during reading, the bytes are neither the old nor the new content.
  if (read->size() < size) return fail(changed(path));
  FileBytes bytes;
  bytes.bytes_ = std::make_shared<const Array<char>>(std::move(*read));
  return bytes;
}

}  // namespace kinefile
