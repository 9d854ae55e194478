// SPDX-License-Identifier: MIT
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "kinefile/io.hpp"

namespace kinefile {
namespace {

/// Files stay where they are: sinks point to them.
using DiskFiles = std::vector<std::unique_ptr<OutputFile>>;

Result<void> commit_all(const DiskFiles& files) {
  std::vector<OutputFile*> all;
  for (const auto& file : files) all.push_back(file.get());
  return OutputFile::commit_all(all);
}

}  // namespace

OutputFiles files_on_disk(const OutputOptions& options) {
  auto files = std::make_shared<DiskFiles>();
  OutputFiles disk;
  disk.open = [files, options](const std::string& name) -> Result<Sink> {
    auto file = OutputFile::create(name, options);
    if (!file) return fail(std::move(file.error()));
    files->push_back(std::make_unique<OutputFile>(std::move(*file)));
    return Sink([own = files->back().get()](std::string_view piece) { return own->write(piece); });
  };
  disk.fault = [files]() -> Result<void> {
    for (const auto& own : *files) {
      if (auto fault = own->fault(); !fault) return fault;
    }
    return {};
  };
  disk.exists = [](const std::string& name) {
    std::error_code ignored;
    return std::filesystem::exists(name, ignored);
  };
  disk.commit = [files] { return commit_all(*files); };
  return disk;
}

OutputFiles files_in_memory(const std::shared_ptr<std::vector<MemoryFile>>& files) {
  auto started = std::make_shared<std::vector<std::unique_ptr<MemoryFile>>>();
  OutputFiles memory;
  memory.open = [started](const std::string& name) -> Result<Sink> {
    started->push_back(std::make_unique<MemoryFile>(MemoryFile{name, {}}));
    return Sink([own = started->back().get()](std::string_view piece) {
      own->bytes += piece;
      return true;
    });
  };
  memory.fault = []() -> Result<void> { return {}; };
  memory.exists = [](const std::string&) { return false; };
  memory.commit = [started, files]() -> Result<void> {
    for (auto& own : *started) files->push_back(std::move(*own));
    started->clear();
    return {};
  };
  return memory;
}

}  // namespace kinefile
