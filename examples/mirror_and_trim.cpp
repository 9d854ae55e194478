// SPDX-License-Identifier: MIT
// What `kinefile edit IN mirror trim=:60 -o OUT` does, in memory: reads a motion and what lies
// beside it, changes it, and shows what was written and what was noticed on the way.
#include <cstdio>

#include "kinefile/kinefile.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: mirror_and_trim IN OUT\n");
    return 2;
  }
  const std::vector<std::string> words = {"mirror", "trim=:60"};
  const auto operations = kinefile::parse_operations(words);
  if (!operations) return 2;

  kinefile::Job job;
  job.source = argv[1];
  job.operations = *operations;
  job.target = argv[2];
  auto files = std::make_shared<std::vector<kinefile::MemoryFile>>();
  const kinefile::Report report = kinefile::process(job, kinefile::files_in_memory(files));

  for (const kinefile::Diagnostic& item : report.diagnostics.items()) {
    std::printf("%s\n", kinefile::to_string(item).c_str());
  }
  if (report.error) {
    std::printf("%s\n", kinefile::to_string(*report.error).c_str());
    return 1;
  }
  for (const kinefile::MemoryFile& file : *files) {
    std::printf("%s: %zu bytes, %zu frames\n", file.name.c_str(), file.bytes.size(),
                report.num_frames);
  }
  return 0;
}
