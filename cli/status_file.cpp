// SPDX-License-Identifier: MIT
#include "status_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>

#include "content_hash.hpp"
#include "signals.hpp"

namespace kinefile::cli {
namespace {

using Records = std::map<std::string, OutputRecord>;

constexpr std::string_view kWordBegun = "begun";
constexpr std::string_view kWordDone = "done";
constexpr std::string_view kWordFailed = "failed";

/// A name in a line: names may have any bytes but NUL.
std::string escaped(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c == '\t') text += "\\t";
    if (c == '\n') text += "\\n";
    if (c == '\\') text += "\\\\";
    if (c != '\t' && c != '\n' && c != '\\') text += c;
  }
  return text;
}

std::string unescaped(std::string_view text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) {
      ++i;
      name += text[i] == 't' ? '\t' : text[i] == 'n' ? '\n' : text[i];
    } else {
      name += text[i];
    }
  }
  return name;
}

/// The fields of a line that are still to be read. After a fault every field is empty.
struct Fields {
  std::string_view rest;
  bool is_good = true;

  std::string_view next() {
    if (rest.data() == nullptr) is_good = false;
    if (!is_good) return {};
    const std::size_t tab = rest.find('\t');
    const std::string_view field = rest.substr(0, tab);
    rest = tab == std::string_view::npos ? std::string_view() : rest.substr(tab + 1);
    return field;
  }
  template <class Number>
  Number number() {
    Number value = 0;
    const std::string_view field = next();
    const auto [end, fault] = std::from_chars(field.data(), field.data() + field.size(), value);
    is_good = is_good && fault == std::errc() && end == field.data() + field.size();
    return value;
  }
};

/// Reads what follows `done` and the name; nothing if the line is not whole.
std::optional<OutputRecord> parse_done(Fields fields) {
  constexpr std::size_t kMost = 100'000;  // of a line that is no status
  OutputRecord record;
  record.is_done = true;
  record.version = fields.next();
  record.options = fields.number<std::uint64_t>();
  const auto num_inputs = fields.number<std::size_t>();
  for (std::size_t i = 0; i < num_inputs && i < kMost && fields.is_good; ++i) {
    InputState& input = record.inputs.emplace_back();
    input.path = unescaped(fields.next());
    input.num_bytes = fields.number<std::uint64_t>();
    input.time = fields.number<std::int64_t>();
    input.hash = fields.number<std::uint64_t>();
  }
  const auto num_outputs = fields.number<std::size_t>();
  for (std::size_t i = 0; i < num_outputs && i < kMost && fields.is_good; ++i) {
    OutputState& output = record.outputs.emplace_back();
    output.name = unescaped(fields.next());
    output.num_bytes = fields.number<std::uint64_t>();
  }
  if (!fields.is_good || fields.rest.data() != nullptr || record.inputs.empty()) return {};
  return record;
}

void parse_line(std::string_view line, Records& records) {
  Fields fields{line};
  const std::string_view word = fields.next();
  const std::string name = unescaped(fields.next());
  if (!fields.is_good) return;
  if (word == kWordBegun) records[name].is_begun = true;
  if (word == kWordFailed) records[name].is_begun = false;
  if (word != kWordDone) return;
  if (auto record = parse_done(fields)) records[name] = std::move(*record);
}

/// Lines that are not whole say nothing.
Records parse(std::string_view text) {
  Records records;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    parse_line(text.substr(0, end), records);
    text.remove_prefix(end + 1);
  }
  return records;
}

std::string line_of(const std::string& name, const OutputRecord& record) {
  std::string line = fmt::format("{}\t{}\t{}\t{}\t{}", kWordDone, escaped(name), record.version,
                                 record.options, record.inputs.size());
  for (const InputState& input : record.inputs) {
    line += fmt::format("\t{}\t{}\t{}\t{}", escaped(input.path), input.num_bytes, input.time,
                        input.hash);
  }
  line += fmt::format("\t{}", record.outputs.size());
  for (const OutputState& output : record.outputs) {
    line += fmt::format("\t{}\t{}", escaped(output.name), output.num_bytes);
  }
  return line + "\n";
}

/// The size and the time of the last change of a file; absent if there is none.
std::optional<std::pair<std::uint64_t, std::int64_t>> size_and_time(const std::string& path) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  struct stat state {};
  if (::stat(path.c_str(), &state) != 0) return {};
  return {{static_cast<std::uint64_t>(state.st_size),
           std::int64_t{state.st_mtim.tv_sec} * kNanoseconds + state.st_mtim.tv_nsec}};
}

bool has_size(const OutputState& output, const std::string& out_dir) {
  const auto now = size_and_time(out_dir + "/" + output.name);
  return now && now->first == output.num_bytes;
}

std::string path_of_status(const std::string& out_dir) {
  return fmt::format("{}/{}", out_dir, kStatusName);
}

Result<Records> read_records(const std::string& path, bool& ends_in_line) {
  std::error_code ignored;
  ends_in_line = true;
  if (!std::filesystem::exists(path, ignored)) return Records();
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  ends_in_line = bytes->view().empty() || bytes->view().ends_with('\n');
  return parse(bytes->view());
}

}  // namespace

struct StatusFile::State {
  std::string out_dir;
  Records records;  ///< as they were at first
  int folder = -1;  ///< has a lock that all who write into the folder share
  std::mutex mutex;
  std::optional<OutputFile> log;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (folder >= 0) ::close(folder);
  }

  void append(const std::string& line) {
    const std::lock_guard lock(mutex);
    log->write(line);
  }
};

InputState state_of(const CompanionFile& file) {
  std::error_code ignored;
  const auto now = size_and_time(file.name);
  InputState state{std::filesystem::absolute(file.name, ignored).lexically_normal().string(),
                   file.pieces ? file.pieces->size : file.bytes.size(), now ? now->second : 0};
  const auto hash =
      file.pieces ? content_hash(*file.pieces) : std::optional(content_hash(file.bytes));
  state.hash = hash.value_or(0);
  if (!hash) state.time = 0;
  return state;
}

bool is_up_to_date(const OutputRecord& record, const std::string& path, std::uint64_t options,
                   const std::string& out_dir) {
  if (!record.is_done || record.is_begun || record.options != options ||
      record.version != kVersion) {
    return false;
  }
  std::error_code ignored;
  const bool is_file = std::filesystem::is_regular_file(path, ignored);  // no stem of a set
  const auto path_now = [&](const InputState& input) {
    return is_file && &input == record.inputs.data() ? path : input.path;
  };
  const auto& outputs = record.outputs;
  const bool stand = std::all_of(outputs.begin(), outputs.end(), [&](const OutputState& output) {
    return has_size(output, out_dir);
  });
  const auto& inputs = record.inputs;
  const auto is_same_by_time = [&](const InputState& input) {
    return size_and_time(path_now(input)) == std::pair(input.num_bytes, input.time);
  };
  const auto is_same_by_content = [&](const InputState& input) {
    const auto bytes = open_pieces(path_now(input));
    return bytes && content_hash(*bytes) == input.hash;
  };
  return stand && std::all_of(inputs.begin(), inputs.end(), is_same_by_time) &&
         std::all_of(inputs.begin(), inputs.end(), is_same_by_content);
}

bool is_own(const OutputRecord& record, const std::string& out_dir) {
  if (record.is_begun) return true;
  return record.is_done &&
         std::all_of(record.outputs.begin(), record.outputs.end(), [&](const OutputState& output) {
           return has_size(output, out_dir) || !size_and_time(out_dir + "/" + output.name);
         });
}

StatusFile::StatusFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
StatusFile::StatusFile(StatusFile&&) noexcept = default;
StatusFile& StatusFile::operator=(StatusFile&&) noexcept = default;
StatusFile::~StatusFile() = default;

Result<StatusFile> StatusFile::open(const std::string& out_dir) {
  auto state = std::make_unique<State>();
  const std::string path = path_of_status(out_dir);
  state->out_dir = out_dir;
  state->folder = ::open(out_dir.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (state->folder >= 0) ::flock(state->folder, LOCK_SH);
  bool ends_in_line = true;
  auto records = read_records(path, ends_in_line);
  if (!records) return fail(std::move(records.error()));
  state->records = std::move(*records);
  const int log = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (log < 0) {
    return fail(make_error(ErrorKind::Io, "IO003",
                           fmt::format("cannot write: {}", std::strerror(errno)), path));
  }
  state->log = OutputFile::of_stream(log, path);
  if (!ends_in_line) state->append("\n");
  return StatusFile(std::move(state));
}

const OutputRecord* StatusFile::find(const std::string& name) const {
  const auto found = state_->records.find(name);
  return found == state_->records.end() ? nullptr : &found->second;
}

void StatusFile::begin(const std::string& name) {
  state_->append(fmt::format("{}\t{}\n", kWordBegun, escaped(name)));
}

void StatusFile::finish(const std::string& name, const OutputRecord& record) {
  state_->append(line_of(name, record));
}

void StatusFile::give_up(const std::string& name) {
  state_->append(fmt::format("{}\t{}\n", kWordFailed, escaped(name)));
}

Result<void> StatusFile::close() {
  if (auto written = state_->log->fault(); !written) return written;
  state_->log.reset();
  if (state_->folder < 0 || ::flock(state_->folder, LOCK_EX | LOCK_NB) != 0) return {};
  const std::string path = path_of_status(state_->out_dir);
  bool ends_in_line = true;
  const auto records = read_records(path, ends_in_line);
  if (!records) return fail(records.error());
  auto file = OutputFile::create(path, output_options(/*may_replace=*/true));
  if (!file) return fail(std::move(file.error()));
  for (const auto& [name, record] : *records) {
    if (record.is_done) file->write(line_of(name, record));
  }
  return file->commit();
}

}  // namespace kinefile::cli
