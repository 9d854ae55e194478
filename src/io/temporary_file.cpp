// SPDX-License-Identifier: MIT
#include "io/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <functional>
#include <utility>

namespace kinefile {
namespace {

/// How many temporary names a final name has. The names of killed processes are looked for below
/// `kNumSearched`; more of them are in use only if as many processes write the same file now.
constexpr int kNumSlots = 1000;
constexpr int kNumSearched = 8;

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

/// The temporary name of a number that belongs to a final name.
std::string slot_name(const std::string& path, int slot) {
  const std::size_t slash = path.find_last_of('/');
  const std::size_t start = slash == std::string::npos ? 0 : slash + 1;
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a: the same name for every process
  for (const char c : path.substr(start)) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return fmt::format("{}.kinefile-{:016x}-{}.part", path.substr(0, start), hash, slot);
}

bool lock(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0; }

/// Whether a name is the one of an open file.
bool is_name_of(const std::string& name, int descriptor) {
  struct stat named {};
  struct stat open {};
  return ::lstat(name.c_str(), &named) == 0 && ::fstat(descriptor, &open) == 0 &&
         is_same_file(named, open);
}

bool has_no_name(int descriptor) {
  struct stat state {};
  return ::fstat(descriptor, &state) == 0 && state.st_nlink == 0;
}

/// Removes the file of a process that was killed. A file of a process that lives has a lock, or
/// gets one as soon as it was created: then its maker sees that the name is gone, and takes
/// another.
void remove_abandoned(const std::string& name) {
  const Descriptor file(uninterrupted(
      [&] { return ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK); }));
  if (file && lock(file.number()) && is_name_of(name, file.number())) ::unlink(name.c_str());
}

/// A file without a name; none where the system or the file system has no such files.
Descriptor open_nameless(const std::string& folder) {
#ifdef O_TMPFILE
  // Its name is given to it by way of its descriptor's name.
  if (::access("/proc/self/fd", X_OK) == 0) {
    return Descriptor(uninterrupted(
        [&] { return ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666); }));
  }
#endif
  return Descriptor();
}

/// Whether a fault of `link` says that the file system has no such names.
bool has_no_links(int fault) {
  return fault == EPERM || fault == EOPNOTSUPP || fault == ENOSYS || fault == EMLINK;
}

/// Renames a file to a name that must not exist, where there are no links: the name is first taken
/// by an empty file, which nobody else takes for free.
/// \returns 0, or errno of the fault: EEXIST if the name exists
int rename_to_free(const std::string& from, const std::string& to) {
  const Descriptor reserved(uninterrupted(
      [&] { return ::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); }));
  if (!reserved) return errno;
  if (std::rename(from.c_str(), to.c_str()) == 0) return 0;
  const int fault = errno;
  ::unlink(to.c_str());
  return fault;
}

/// Gives a file another name, beside the old one where that is possible, else instead of it.
/// \returns 0, or errno of the fault: EEXIST if the name exists
int link_or_rename(const std::string& from, const std::string& to) {
  if (::link(from.c_str(), to.c_str()) == 0) return 0;
  return has_no_links(errno) ? rename_to_free(from, to) : errno;
}

}  // namespace

TemporaryFile TemporaryFile::create(const std::string& path, Cancellation* cancellation) {
  TemporaryFile file;
  file.cancellation_ = cancellation;
  for (int slot = 0; slot < kNumSearched; ++slot) remove_abandoned(slot_name(path, slot));
  file.descriptor_ = open_nameless(folder_of(path));
  if (file.descriptor_) {
    lock(file.descriptor());  // where there are no locks, nobody removes what has none
    return file;
  }
  const int fault = file.take_name(path, [&file](const std::string& name) {
    file.descriptor_ = Descriptor(uninterrupted(
        [&] { return ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); }));
    if (!file.descriptor_) return errno;
    // Another process that takes it for abandoned has the lock, or had it and removed the name.
    const bool is_taken = !lock(file.descriptor()) && errno == EWOULDBLOCK;
    return is_taken || has_no_name(file.descriptor()) ? EEXIST : 0;
  });
  if (fault != 0) file.descriptor_ = Descriptor();
  errno = fault;
  return file;
}

TemporaryFile TemporaryFile::second_name(const std::string& path, Cancellation* cancellation) {
  TemporaryFile file;
  file.cancellation_ = cancellation;
  file.descriptor_ =
      Descriptor(uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); }));
  if (file.descriptor_) lock(file.descriptor());
  errno =
      file.take_name(path, [&path](const std::string& name) { return link_or_rename(path, name); });
  return file;
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : descriptor_(std::move(other.descriptor_)),
      name_(std::exchange(other.name_, {})),
      cancellation_(other.cancellation_) {}

TemporaryFile::~TemporaryFile() {
  if (name_.empty()) return;
  ::unlink(name_.c_str());
  forget_name();
}

int TemporaryFile::take_name(const std::string& path,
                             const std::function<int(const std::string&)>& take) {
  // Counted first: a signal that comes between the two must find it counted.
  if (cancellation_ != nullptr) ++cancellation_->num_temporary_files;
  // A signal that came before, on another thread, did not find it counted and ends the process.
  if (cancellation_ != nullptr && cancellation_->is_requested) {
    forget_name();
    return ECANCELED;
  }
  int fault = EEXIST;
  for (int slot = 0; slot < kNumSlots && fault == EEXIST; ++slot) {
    name_ = slot_name(path, slot);
    fault = take(name_);
  }
  if (fault != 0) forget_name();
  return fault;
}

void TemporaryFile::forget_name() {
  name_.clear();
  if (cancellation_ != nullptr) --cancellation_->num_temporary_files;
}

int TemporaryFile::give_name(const std::string& path) {
  if (has_name()) return 0;
  return take_name(path, [this](const std::string& name) { return link_descriptor(name); });
}

int TemporaryFile::link_descriptor(const std::string& name) const {
  const std::string source = fmt::format("/proc/self/fd/{}", descriptor());
  const int made = ::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
  return made == 0 ? 0 : errno;
}

int TemporaryFile::become_new(const std::string& path) {
  if (!has_name()) return link_descriptor(path);
  const int fault = link_or_rename(name_, path);
  if (fault != 0) return fault;
  ::unlink(name_.c_str());
  forget_name();
  return 0;
}

int TemporaryFile::replace(const std::string& path) {
  // Where a lock could not be had, another process may have removed the file.
  if (descriptor_ && !is_name_of(name_, descriptor())) return ENOENT;
  if (std::rename(name_.c_str(), path.c_str()) != 0) return errno;
  forget_name();
  return 0;
}

}  // namespace kinefile
