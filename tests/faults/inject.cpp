// SPDX-License-Identifier: MIT
// Makes one call of the system fail, in a program that is started with LD_PRELOAD:
//   KINEFILE_FAULT=CALL:N:FAULT  the N-th call of CALL (-N: this and all later ones) fails with
//   FAULT,
//                                the number of an error, `short`: half of the bytes are taken,
//                                or `slow`: it takes 20 ms
//   KINEFILE_NO_TMPFILE=1        there are no files without names, as on many file systems
//   KINEFILE_FAULT_LOG=FILE      gets a line when the fault has happened
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Plan {
  char call[16] = {};
  long number = 0;  ///< 0: none fails
  int fault = 0;
  bool is_short = false;
  bool is_slow = false;
};

const Plan& plan() {
  static const Plan own = [] {
    Plan read;
    char fault[16] = {};
    const char* text = std::getenv("KINEFILE_FAULT");
    if (text != nullptr) std::sscanf(text, "%15[^:]:%ld:%15s", read.call, &read.number, fault);
    read.is_short = std::strcmp(fault, "short") == 0;
    read.is_slow = std::strcmp(fault, "slow") == 0;
    read.fault = std::atoi(fault);
    return read;
  }();
  return own;
}

void note_fault() {
  const char* path = std::getenv("KINEFILE_FAULT_LOG");
  std::FILE* log = path == nullptr ? nullptr : std::fopen(path, "a");
  if (log == nullptr) return;
  std::fputs("failed\n", log);
  std::fclose(log);
}

/// Whether this call is the one that fails.
bool is_due(const char* call) {
  static long num_calls = 0;
  static bool is_noting = false;
  const Plan& own = plan();
  if (is_noting || own.number == 0 || std::strcmp(own.call, call) != 0) return false;
  ++num_calls;
  if (own.number > 0 ? num_calls != own.number : num_calls < -own.number) return false;
  is_noting = true;
  note_fault();
  is_noting = false;
  return true;
}

bool fails(const char* call) {
  if (!is_due(call)) return false;
  errno = plan().fault;
  return true;
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

mode_t mode_of(int flags, std::va_list& more) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  if ((flags & O_TMPFILE) == O_TMPFILE && std::getenv("KINEFILE_NO_TMPFILE") != nullptr) {
    errno = EOPNOTSUPP;
    return -1;
  }
  if (fails("open")) return -1;
  return real<int(const char*, int, ...)>("open")(path, flags, mode);
}

ssize_t read(int descriptor, void* bytes, std::size_t size) {
  static const auto call = real<ssize_t(int, void*, std::size_t)>("read");
  if (!is_due("read")) return call(descriptor, bytes, size);
  if (plan().is_slow) {
    usleep(20'000);
    return call(descriptor, bytes, size);
  }
  if (plan().is_short) return call(descriptor, bytes, (size + 1) / 2);
  errno = plan().fault;
  return -1;
}

ssize_t pread(int descriptor, void* bytes, std::size_t size, off_t offset) {
  static const auto call = real<ssize_t(int, void*, std::size_t, off_t)>("pread");
  if (!is_due("pread")) return call(descriptor, bytes, size, offset);
  if (plan().is_short) return call(descriptor, bytes, (size + 1) / 2, offset);
  errno = plan().fault;
  return -1;
}

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  static const auto call = real<ssize_t(int, const void*, std::size_t)>("write");
  if (!is_due("write")) return call(descriptor, bytes, size);
  if (plan().is_short) return call(descriptor, bytes, (size + 1) / 2);
  errno = plan().fault;
  return -1;
}

int fsync(int descriptor) { return fails("fsync") ? -1 : real<int(int)>("fsync")(descriptor); }

int close(int descriptor) {
  const int closed = real<int(int)>("close")(descriptor);
  return fails("close") ? -1 : closed;  // as Linux does: closed, whatever it says
}

int rename(const char* from, const char* to) {
  return fails("rename") ? -1 : real<int(const char*, const char*)>("rename")(from, to);
}

int link(const char* from, const char* to) {
  return fails("link") ? -1 : real<int(const char*, const char*)>("link")(from, to);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  if (fails("linkat")) return -1;
  return real<int(int, const char*, int, const char*, int)>("linkat")(from_folder, from, to_folder,
                                                                      to, flags);
}

int flock(int descriptor, int operation) {
  return fails("flock") ? -1 : real<int(int, int)>("flock")(descriptor, operation);
}

int fchmod(int descriptor, mode_t mode) {
  return fails("fchmod") ? -1 : real<int(int, mode_t)>("fchmod")(descriptor, mode);
}

int fchown(int descriptor, uid_t owner, gid_t group) {
  return fails("fchown") ? -1 : real<int(int, uid_t, gid_t)>("fchown")(descriptor, owner, group);
}

int fstat(int descriptor, struct stat* state) {
  return fails("fstat") ? -1 : real<int(int, struct stat*)>("fstat")(descriptor, state);
}

int stat(const char* path, struct stat* state) {
  return fails("stat") ? -1 : real<int(const char*, struct stat*)>("stat")(path, state);
}

int lstat(const char* path, struct stat* state) {
  return fails("lstat") ? -1 : real<int(const char*, struct stat*)>("lstat")(path, state);
}

}  // extern "C"
