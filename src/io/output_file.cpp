// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "io/temporary_file.hpp"
#include "kinefile/io.hpp"

namespace kinefile {

struct OutputFile::State {
  std::string name;  ///< as the caller says it, for messages
  std::string path;  ///< the file, where links lead
  OutputOptions options;
  Descriptor stream;                       ///< what is written at once
  std::optional<TemporaryFile> temporary;  ///< or what becomes the file
  std::optional<TemporaryFile> old;        ///< the file that was replaced, as long as it may return
  bool is_placed = false;
  int fault = 0;  ///< errno of the first fault
};

namespace {

Error cannot_write(const std::string& path, int reason) {
  return make_error(ErrorKind::Io, "IO003", fmt::format("cannot write: {}", std::strerror(reason)),
                    path);
}

Error exists(const std::string& path) {
  return make_error(ErrorKind::Io, "IO002", "the file exists; --force replaces it", path);
}

/// Where links lead, so that the rename replaces the file and not the link; also when no file is
/// there yet.
std::string resolved(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;  // as the system follows
  fs::path target = path;
  std::error_code fault;
  for (int i = 0; i < kMostLinks && fs::is_symlink(target, fault); ++i) {
    const fs::path next = fs::read_symlink(target, fault);
    if (fault) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target.string();
}

/// Gives a file the owner and the access rights of the one that it replaces, where it can: an owner
/// gives files away only as root.
void keep_rights(int descriptor, const struct stat& old) {
  if (::fchown(descriptor, old.st_uid, old.st_gid) != 0 &&
      ::fchown(descriptor, static_cast<uid_t>(-1), old.st_gid) != 0) {
    errno = 0;  // the file is then ours
  }
  ::fchmod(descriptor, old.st_mode & 0777);
}

/// Makes a rename permanent: also syncs the folder that contains the name.
void sync_folder(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const Descriptor open(
      uninterrupted([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }));
  if (open) ::fsync(open.number());
}

/// \returns 0, or errno of the fault; a file system that cannot sync is none
int synced(int descriptor) {
  if (uninterrupted([&] { return ::fsync(descriptor); }) == 0) return 0;
  return errno == EINVAL || errno == ENOSYS ? 0 : errno;
}

bool is_requested(const Cancellation* cancellation) {
  return cancellation != nullptr && cancellation->is_requested;
}

}  // namespace

OutputFile::OutputFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile& OutputFile::operator=(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

OutputFile OutputFile::of_stream(int descriptor, const std::string& name) {
  auto state = std::make_unique<State>();
  state->name = name;
  state->stream = Descriptor(descriptor);
  return OutputFile(std::move(state));
}

Result<OutputFile> OutputFile::create(const std::string& path, const OutputOptions& options) {
  if (path == "-") return of_stream(STDOUT_FILENO, "<stdout>");
  auto state = std::make_unique<State>();
  state->name = path;
  state->options = options;
  struct stat old {};
  const bool is_there = ::stat(path.c_str(), &old) == 0;
  if (is_there && !S_ISREG(old.st_mode)) {  // a device or a pipe is written directly
    state->stream =
        Descriptor(uninterrupted([&] { return ::open(path.c_str(), O_WRONLY | O_CLOEXEC); }));
    if (!state->stream) return fail(cannot_write(path, errno));
    return OutputFile(std::move(state));
  }
  if (is_there && !options.may_replace) return fail(exists(path));
  state->path = resolved(path);
  state->temporary.emplace(TemporaryFile::create(state->path, options.cancellation));
  if (!state->temporary->is_open()) return fail(cannot_write(path, errno));
  if (is_there) keep_rights(state->temporary->descriptor(), old);
  return OutputFile(std::move(state));
}

bool OutputFile::write(std::string_view bytes) {
  State& state = *state_;
  if (state.fault == 0 && is_requested(state.options.cancellation)) state.fault = ECANCELED;
  const Descriptor& stream = state.stream;
  const int descriptor = stream ? stream.number() : state.temporary->descriptor();
  if (state.fault == 0) state.fault = write_all(descriptor, bytes);
  return state.fault == 0;
}

Result<void> OutputFile::fault() const {
  if (state_->fault != 0) return fail(cannot_write(state_->name, state_->fault));
  return {};
}

/// Everything that can fail before the first file is changed.
Result<void> OutputFile::prepare() {
  State& state = *state_;
  if (state.fault == 0 && state.temporary) {
    state.fault = synced(state.temporary->descriptor());
    if (state.fault == 0 && state.options.may_replace) {
      state.fault = state.temporary->give_name(state.path);
    }
  }
  return fault();
}

/// Gives the file its final name.
/// \param keeps_old  whether `put_back` may follow
Result<void> OutputFile::place(bool keeps_old) {
  State& state = *state_;
  if (!state.temporary) return {};
  if (!state.options.may_replace) {
    // A link fails if the name exists by now; a rename would replace the file.
    state.fault = state.temporary->become_new(state.path);
    if (state.fault == EEXIST) return fail(exists(state.name));
  } else {
    struct stat old {};
    if (keeps_old && ::lstat(state.path.c_str(), &old) == 0) {
      state.old.emplace(TemporaryFile::second_name(state.path, state.options.cancellation));
      if (!state.old->has_name()) state.fault = errno;
    }
    if (state.fault == 0) state.fault = state.temporary->replace(state.path);
  }
  state.is_placed = state.fault == 0;
  return fault();
}

/// Makes the final name what it was before `place`.
/// \returns false if the new file stays
bool OutputFile::put_back() {
  State& state = *state_;
  struct stat now {};
  const bool is_gone = ::lstat(state.path.c_str(), &now) != 0;
  if (state.old && state.old->has_name()) {
    if ((state.is_placed || is_gone) && state.old->replace(state.path) != 0) return false;
  } else if (state.is_placed && ::unlink(state.path.c_str()) != 0) {
    return false;
  }
  state.is_placed = false;
  return true;
}

Result<void> OutputFile::commit() {
  OutputFile* const own[] = {this};
  return commit_all(own);
}

Result<void> OutputFile::commit_all(std::span<OutputFile* const> files) {
  for (OutputFile* file : files) {
    if (auto prepared = file->prepare(); !prepared) return prepared;
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    auto placed = files[i]->place(/*keeps_old=*/files.size() > 1);
    if (!placed) return undone(files.subspan(0, i + 1), std::move(placed.error()));
  }
  for (OutputFile* file : files) {
    if (file->state_->is_placed) sync_folder(file->state_->path);
  }
  return {};
}

/// Puts back what the first files replaced, after the last of them failed.
/// \returns the failure; it says what stands, if something cannot be put back
Result<void> OutputFile::undone(std::span<OutputFile* const> files, Error&& error) {
  std::string standing;
  for (std::size_t i = files.size(); i > 0; --i) {
    if (!files[i - 1]->put_back()) standing += fmt::format(" '{}'", files[i - 1]->state_->name);
  }
  if (!standing.empty()) {
    error.message +=
        fmt::format("; new, and could not be put back:{}; all others are as before", standing);
  }
  return fail(std::move(error));
}

}  // namespace kinefile
