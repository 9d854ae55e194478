// SPDX-License-Identifier: MIT
#include "many_summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "json_output.hpp"
#include "report.hpp"

namespace kinefile::cli {
namespace {

std::size_t count_of(const Summary& summary, FileResult result) {
  return static_cast<std::size_t>(
      std::count_if(summary.lines.begin(), summary.lines.end(),
                    [result](const SummaryLine& line) { return line.result == result; }));
}

std::string_view name_of(FileResult result) {
  constexpr std::string_view kNames[] = {"written", "up_to_date", "failed"};
  return kNames[static_cast<std::size_t>(result)];
}

Json json_of(const SummaryLine& line) {
  Json json = {{"file", line.input}, {"result", name_of(line.result)}, {"outputs", line.outputs}};
  if (line.result == FileResult::Failed) {
    json["code"] = line.code;
    json["message"] = line.message;
  }
  return json;
}

}  // namespace

void print_summary(const Summary& summary) {
  const std::size_t num_failed = count_of(summary, FileResult::Failed);
  const std::size_t num_files = summary.lines.size();
  std::string text = fmt::format(
      "{} {}: {} written, {} up to date, {} failed\n", num_files, num_files == 1 ? "file" : "files",
      count_of(summary, FileResult::Written), count_of(summary, FileResult::UpToDate), num_failed);
  std::size_t width = 0;
  for (const SummaryLine& line : summary.lines) {
    if (line.result == FileResult::Failed) width = std::max(width, line.input.size());
  }
  for (const SummaryLine& line : summary.lines) {
    if (line.result != FileResult::Failed) continue;
    text += fmt::format("  {:<{}}  {}  {}\n", line.input, width, line.code, line.message);
  }
  print_message(text);
}

void print_json_summary(const Summary& summary) {
  Json files = Json::array();
  for (const SummaryLine& line : summary.lines) files.push_back(json_of(line));
  print_json({{"files", std::move(files)},
              {"written", count_of(summary, FileResult::Written)},
              {"up_to_date", count_of(summary, FileResult::UpToDate)},
              {"failed", count_of(summary, FileResult::Failed)}});
}

int exit_code_of(const Summary& summary) {
  const bool has_succeeded = count_of(summary, FileResult::Failed) < summary.lines.size();
  return summary.worst != kDone && has_succeeded ? kPartOfBatch : summary.worst;
}

}  // namespace kinefile::cli
