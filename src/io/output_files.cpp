// SPDX-License-Identifier: MIT
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "kinefile/io.hpp"

namespace kinefile {
namespace {

struct DiskFile {
  std::string name;
  OutputFile file;
};

/// Gives files their final names. If one fails, those before it are removed, unless they replaced
/// others.
Result<void> commit_all(std::vector<std::unique_ptr<DiskFile>>& files, bool replace) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    auto committed = files[i]->file.commit();
    if (committed) continue;
    std::error_code ignored;
    for (std::size_t k = 0; k < i && !replace; ++k) {
      std::filesystem::remove(files[k]->name, ignored);
    }
    return committed;
  }
  return {};
}

}  // namespace

OutputFiles files_on_disk(bool replace) {
  auto files = std::make_shared<std::vector<std::unique_ptr<DiskFile>>>();
  OutputFiles disk;
  disk.open = [files, replace](const std::string& name) -> Result<Sink> {
    auto file = OutputFile::create(name, replace);
    if (!file) return fail(std::move(file.error()));
    files->push_back(std::make_unique<DiskFile>(DiskFile{name, std::move(*file)}));
    return Sink(
        [own = files->back().get()](std::string_view piece) { return own->file.write(piece); });
  };
  disk.fault = [files]() -> Result<void> {
    for (const auto& own : *files) {
      if (auto fault = own->file.fault(); !fault) return fault;
    }
    return {};
  };
  disk.exists = [](const std::string& name) {
    std::error_code ignored;
    return std::filesystem::exists(name, ignored);
  };
  disk.commit = [files, replace] { return commit_all(*files, replace); };
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
