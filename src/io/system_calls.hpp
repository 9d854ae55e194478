// SPDX-License-Identifier: MIT
#pragma once

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>

namespace kinefile {

/// A file descriptor that closes itself; -1 is none. Standard streams stay open.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    if (this != &other) {
      close();
      number_ = other.release();
    }
    return *this;
  }
  ~Descriptor() { close(); }

  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int release() {
    const int number = number_;
    number_ = -1;
    return number;
  }
  void close() const {
    if (number_ > STDERR_FILENO) ::close(number_);
  }

  int number_;
};

/// Calls a function of the system again as long as a signal interrupts it.
template <typename Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// Waits until a stream that does not block can be read (POLLIN) or written (POLLOUT).
/// \returns false after a fault, which is in errno
inline bool wait_for(int descriptor, short event) {
  struct pollfd waiting {};
  waiting.fd = descriptor;
  waiting.events = event;
  return uninterrupted([&] { return ::poll(&waiting, 1, -1); }) > 0;
}

/// Writes all bytes, however many the system takes at once.
/// \returns 0, or errno of the fault
inline int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count =
        uninterrupted([&] { return ::write(descriptor, bytes.data(), bytes.size()); });
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (count == 0) {
      return EIO;  // no progress, and no reason
    } else if ((errno != EAGAIN && errno != EWOULDBLOCK) || !wait_for(descriptor, POLLOUT)) {
      return errno;
    }
  }
  return 0;
}

/// Whether two states are of the same file.
inline bool is_same_file(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

}  // namespace kinefile
