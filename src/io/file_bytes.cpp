// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

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
  ~Descriptor() {
    if (number > STDERR_FILENO) ::close(number);
  }
};

/// Maps a regular file; null for what cannot be mapped, such as a pipe or an empty file.
std::shared_ptr<const void> map_file(int descriptor, std::size_t size) {
  if (size == 0) return nullptr;
  void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  if (address == MAP_FAILED) return nullptr;
  ::madvise(address, size, MADV_SEQUENTIAL);
  return {address, [size](const void* mapped) { ::munmap(const_cast<void*>(mapped), size); }};
}

/// Reads to the end of what cannot be mapped. Null after a fault, which is in errno.
std::shared_ptr<std::string> read_all(int descriptor) {
  constexpr std::size_t kPiece = std::size_t{1} << 18;
  auto bytes = std::make_shared<std::string>();
  while (true) {
    const std::size_t old_size = bytes->size();
    bytes->resize(old_size + kPiece);
    const ssize_t count = ::read(descriptor, bytes->data() + old_size, kPiece);
    bytes->resize(old_size + (count > 0 ? static_cast<std::size_t>(count) : 0));
    if (count == 0) return bytes;
    if (count < 0 && errno != EINTR) return nullptr;
  }
}

}  // namespace

Result<FileBytes> FileBytes::open(const std::string& path) {
  const Descriptor file(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) return fail(cannot_read(path, errno));
  if (S_ISDIR(status.st_mode)) return fail(cannot_read(path, EISDIR));

  FileBytes bytes;
  if (S_ISREG(status.st_mode) && path != "-") {
    const auto size = static_cast<std::size_t>(status.st_size);
    bytes.owner_ = map_file(file.number, size);
    bytes.view_ = {static_cast<const char*>(bytes.owner_.get()), bytes.owner_ ? size : 0};
  }
  if (bytes.owner_ == nullptr) {
    const auto all = read_all(file.number);
    if (all == nullptr) return fail(cannot_read(path, errno));
    bytes.owner_ = all;
    bytes.view_ = *all;
  }
  return bytes;
}

}  // namespace kinefile
