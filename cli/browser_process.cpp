// SPDX-License-Identifier: MIT
#include "browser_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/select.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>
#include <utility>

#include "signals.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): not every system declares it

namespace kinefile::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// The descriptors at which a browser reads and writes messages.
constexpr int kBrowserReads = 3;
constexpr int kBrowserWrites = 4;

Error browser_failed(std::string message) {
  return make_error(ErrorKind::Io, "PAG003", std::move(message));
}

Error ended_early() {
  return browser_failed(
      "expected a picture from the browser, found that it ended; it may lack a library or the "
      "right to make its sandbox");
}

/// Both ends of a pipe, the one to read from first.
struct Pipe {
  std::array<int, 2> ends = {-1, -1};

  /// Opens the pipe with descriptors above those that a browser gets.
  bool open() {
    std::array<int, 2> low = {-1, -1};
    if (::pipe(low.data()) != 0) return false;
    for (std::size_t i = 0; i < 2; ++i) {
      ends[i] = ::fcntl(low[i], F_DUPFD_CLOEXEC, kBrowserWrites + 1);
      ::close(low[i]);
    }
    return ends[0] >= 0 && ends[1] >= 0;
  }
  /// Gives up ownership of an end.
  int take(std::size_t end) { return std::exchange(ends[end], -1); }

  Pipe() = default;
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  Pipe(Pipe&&) = delete;
  Pipe& operator=(Pipe&&) = delete;
  ~Pipe() {
    for (const int end : ends) {
      if (end >= 0) ::close(end);
    }
  }
};

/// The environment, with another folder for temporary files.
std::vector<std::string> environment_with(const std::string& temporary) {
  constexpr std::string_view kVariable = "TMPDIR=";
  std::vector<std::string> variables = {std::string(kVariable) + temporary};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!std::string_view(*variable).starts_with(kVariable)) variables.emplace_back(*variable);
  }
  return variables;
}

/// Words as a program takes them: valid as long as these are, with a null pointer at the end.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// What is done in the new process before the program starts: a process group of its own, the
/// pipes, no other streams, and signals as they are by default.
class SpawnPlan {
 public:
  SpawnPlan(const Pipe& to_browser, const Pipe& from_browser) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, to_browser.ends[0], kBrowserReads);
    posix_spawn_file_actions_adddup2(&actions_, from_browser.ends[1], kBrowserWrites);
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigset_t ignored;
    sigemptyset(&none);
    sigemptyset(&ignored);
    sigaddset(&ignored, SIGPIPE);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &ignored);
    posix_spawnattr_setpgroup(&attributes_, 0);
    constexpr int kFlags = POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF;
    posix_spawnattr_setflags(&attributes_, static_cast<short>(kFlags));
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  SpawnPlan(SpawnPlan&&) = delete;
  SpawnPlan& operator=(SpawnPlan&&) = delete;
  ~SpawnPlan() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }

  /// Starts the program that the first word names.
  /// \returns 0, or the number of a fault as in errno
  int spawn(std::vector<std::string> words, std::vector<std::string> environment,
            pid_t& process) const {
    return posix_spawn(&process, words.front().c_str(), &actions_, &attributes_,
                       pointers_to(words).data(), pointers_to(environment).data());
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

/// Kills a group of processes and waits for its leader, and at most a second for the others, which
/// the system waits for.
void kill_group(pid_t leader) {
  constexpr auto kStep = std::chrono::milliseconds(10);
  ::kill(-leader, SIGKILL);
  while (::waitpid(leader, nullptr, 0) < 0 && errno == EINTR) {
  }
  for (int i = 0; i < 100 && ::kill(-leader, SIGKILL) == 0; ++i) {
    std::this_thread::sleep_for(kStep);
  }
}

timespec time_until(Deadline deadline) {
  const auto left = std::max(deadline - Clock::now(), Clock::duration::zero());
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(left - seconds);
  timespec time{};
  time.tv_sec = static_cast<time_t>(seconds.count());
  time.tv_nsec = static_cast<long>(rest.count());
  return time;
}

}  // namespace

TemporaryFolder::TemporaryFolder(std::string path) : path_(std::move(path)) {}
TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})) {}
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

Result<TemporaryFolder> TemporaryFolder::create() {
  std::error_code fault;
  const std::filesystem::path above = std::filesystem::temp_directory_path(fault);
  std::string name = std::filesystem::absolute(fault ? "/tmp" : above, fault) / "kinefile.XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) {
    return fail(make_error(ErrorKind::Io, "IO003",
                           fmt::format("cannot write: {}", std::strerror(errno)), name));
  }
  return TemporaryFolder(std::move(name));
}

HeldSignals::HeldSignals() {
  sigset_t held;
  sigemptyset(&held);
  for (const int number : kSignals) sigaddset(&held, number);
  sigprocmask(SIG_BLOCK, &held, &old_mask_);
  struct sigaction action {};
  action.sa_handler = note_signal;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &old_actions_[i]);
    // One that is ignored, as nohup does with SIGHUP, stays so.
    if (old_actions_[i].sa_handler == SIG_IGN) continue;
    sigaction(kSignals[i], &action, nullptr);
  }
}

HeldSignals::~HeldSignals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], &old_actions_[i], nullptr);
  }
  sigprocmask(SIG_SETMASK, &old_mask_, nullptr);
}

int HeldSignals::wait_for_bytes(int descriptor, Deadline deadline) {
  fd_set readable;
  FD_ZERO(&readable);
  FD_SET(descriptor, &readable);
  sigset_t open;
  sigprocmask(SIG_SETMASK, nullptr, &open);
  for (const int number : kSignals) sigdelset(&open, number);
  const timespec time = time_until(deadline);
  return ::pselect(descriptor + 1, &readable, nullptr, nullptr, &time, &open);
}

BrowserProcess::BrowserProcess(pid_t process, int to_browser, int from_browser)
    : process_(process), to_browser_(to_browser), from_browser_(from_browser) {}

BrowserProcess::BrowserProcess(BrowserProcess&& other) noexcept
    : process_(std::exchange(other.process_, 0)),
      to_browser_(std::exchange(other.to_browser_, -1)),
      from_browser_(std::exchange(other.from_browser_, -1)),
      received_(std::move(other.received_)) {}

BrowserProcess::~BrowserProcess() {
  if (process_ == 0) return;
  kill_group(process_);
  ::close(to_browser_);
  ::close(from_browser_);
}

Result<BrowserProcess> BrowserProcess::start(const std::string& program,
                                             const std::vector<std::string>& arguments,
                                             const std::string& temporary) {
  Pipe to_browser;
  Pipe from_browser;
  if (!to_browser.open() || !from_browser.open()) {
    return fail(browser_failed(fmt::format("cannot make a pipe: {}", std::strerror(errno))));
  }
  pid_t process = 0;
  const SpawnPlan plan(to_browser, from_browser);
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int fault = plan.spawn(std::move(words), environment_with(temporary), process);
  if (fault != 0) {
    return fail(browser_failed(fmt::format("cannot start {}: {}", program, std::strerror(fault))));
  }
  return BrowserProcess(process, to_browser.take(1), from_browser.take(0));
}

Result<void> BrowserProcess::send(std::string_view message) {
  std::string bytes(message);
  bytes += '\0';
  std::string_view left = bytes;
  while (!left.empty()) {
    const ssize_t count = ::write(to_browser_, left.data(), left.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return fail(ended_early());
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

Result<void> BrowserProcess::read_more(Deadline deadline) {
  const int num_ready = HeldSignals::wait_for_bytes(from_browser_, deadline);
  if (num_ready == 0) {
    return fail(browser_failed("expected a picture from the browser in time, found none"));
  }
  if (noted_signal() != 0) return fail(browser_failed("stopped by a signal"));
  if (num_ready < 0) return {};  // another signal
  std::array<char, std::size_t{1} << 16> block;
  const ssize_t count = ::read(from_browser_, block.data(), block.size());
  if (count < 0 && errno == EINTR) return {};
  if (count <= 0) return fail(ended_early());
  received_.append(block.data(), static_cast<std::size_t>(count));
  return {};
}

Result<std::string> BrowserProcess::receive(Deadline deadline) {
  std::size_t searched = 0;
  while (true) {
    const std::size_t end = received_.find('\0', searched);
    if (end != std::string::npos) {
      std::string message = received_.substr(0, end);
      received_.erase(0, end + 1);
      return message;
    }
    searched = received_.size();
    if (auto read = read_more(deadline); !read) return fail(std::move(read.error()));
  }
}

}  // namespace kinefile::cli
