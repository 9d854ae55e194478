// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "kinefile/io.hpp"

namespace kinefile {

struct OutputFile::State {
  std::string path;
  std::string temporary;  ///< empty for standard output, and after the rename
  int descriptor = -1;
  int fault = 0;  ///< errno of the first fault
  bool may_replace = false;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  State(State&&) = delete;
  State& operator=(State&&) = delete;
  ~State() {
    if (descriptor > STDERR_FILENO) ::close(descriptor);
    if (!temporary.empty()) ::unlink(temporary.c_str());
  }
};

namespace {

Error cannot_write(const std::string& path, int reason) {
  return make_error(ErrorKind::Io, "IO003", fmt::format("cannot write: {}", std::strerror(reason)),
                    path == "-" ? "<stdout>" : path);
}

Error exists(const std::string& path) {
  return make_error(ErrorKind::Io, "IO002", "the file exists; --force replaces it", path);
}

/// The target of a link, so that the rename replaces the file and not the link.
std::string resolved(const std::string& path) {
  char* real = ::realpath(path.c_str(), nullptr);
  if (real == nullptr) return path;
  std::string target(real);
  std::free(real);  // NOLINT(*-no-malloc): realpath allocates with malloc
  return target;
}

/// Creates a file with an unused name, with the system's default rights for new files.
/// \returns its descriptor; -1 after a fault, which is in errno
int create_temporary(const std::string& path, std::string& name) {
  static std::atomic<unsigned> num_made{0};
  constexpr int kMostTries = 1000;
  for (int i = 0; i < kMostTries; ++i) {
    name = fmt::format("{}.part.{}.{}", path, ::getpid(), num_made.fetch_add(1));
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

/// Gives a file the access rights of the one that it replaces.
void keep_rights(int descriptor, const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) ::fchmod(descriptor, status.st_mode & 0777);
}

/// Makes a rename permanent: also syncs the folder that contains the name.
void sync_folder(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

bool is_special_file(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

}  // namespace

OutputFile::OutputFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile& OutputFile::operator=(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

Result<OutputFile> OutputFile::create(const std::string& path, bool replace) {
  auto state = std::make_unique<State>();
  state->path = path;
  state->may_replace = replace;
  if (path == "-") {
    state->descriptor = STDOUT_FILENO;
    return OutputFile(std::move(state));
  }
  if (is_special_file(path)) {  // a device or a pipe is written directly
    state->descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (state->descriptor < 0) return fail(cannot_write(path, errno));
    return OutputFile(std::move(state));
  }
  if (!replace && ::access(path.c_str(), F_OK) == 0) return fail(exists(path));
  state->path = resolved(path);
  std::string name;
  state->descriptor = create_temporary(state->path, name);
  if (state->descriptor < 0) return fail(cannot_write(path, errno));
  state->temporary = name;
  keep_rights(state->descriptor, state->path);
  return OutputFile(std::move(state));
}

bool OutputFile::write(std::string_view bytes) {
  while (state_->fault == 0 && !bytes.empty()) {
    const ssize_t count = ::write(state_->descriptor, bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      state_->fault = errno;
    }
  }
  return state_->fault == 0;
}

Result<void> OutputFile::fault() const {
  if (state_->fault != 0) return fail(cannot_write(state_->path, state_->fault));
  return {};
}

Result<void> OutputFile::commit() {
  State& state = *state_;
  if (state.fault != 0) return fault();
  if (state.temporary.empty()) return {};
  if (::fsync(state.descriptor) != 0) return fail(cannot_write(state.path, errno));
  // Creating a link fails atomically if the name exists by now; a rename would replace the file.
  if (!state.may_replace) {
    if (::link(state.temporary.c_str(), state.path.c_str()) == 0) {
      sync_folder(state.path);
      return {};
    }
    if (errno == EEXIST) return fail(exists(state.path));
  }
  if (std::rename(state.temporary.c_str(), state.path.c_str()) != 0) {
    return fail(cannot_write(state.path, errno));
  }
  state.temporary.clear();
  sync_folder(state.path);
  return {};
}

}  // namespace kinefile
