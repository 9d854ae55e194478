// SPDX-License-Identifier: MIT
#include <memory>
#include <utility>

#include "many.hpp"

namespace kinefile::cli {
namespace {

/// The job that makes the output of a file, as the command does for one file.
/// \param reading  must outlive it
Result<Job> job_of(const ManyFile& file, const Reading& reading, const Writing& writing,
                   const ManyChange& change, const ChangeLong& change_in_blocks,
                   Diagnostics& diagnostics) {
  auto adapting = adapting_options(writing, reading, diagnostics);
  if (!adapting) return fail(std::move(adapting.error()));
  Job job;
  job.source = file.path;
  job.from = find_format(reading.from);
  job.reading = read_options(reading);
  job.strict = reading.is_strict;
  if (change) {
    job.change = [&file, &reading, &change](Document& document, Diagnostics& of_change) {
      return change(file, document, reading, of_change);
    };
  }
  job.change_in_blocks = change_in_blocks;
  job.most_bytes_in_memory = most_bytes_in_memory(change != nullptr);
  job.target = file.target;
  job.to = file.to;
  job.adapting = std::move(*adapting);
  job.writing = writing.format;
  job.writing.project = reading.loaded_project;
  return job;
}

}  // namespace

int run_many_documents(const Many& many, const Reading& reading, const Writing& writing,
                       const ManyChange& change, const ChangeLong& change_in_blocks,
                       const std::vector<std::string>& words, const Globals& globals) {
  ManyWork work;
  work.reading = &reading;
  work.may_replace = writing.may_replace;
  work.to = find_format(writing.to);
  work.words = words;
  work.files = {writing.joint_map, writing.robot};
  work.make = [&](const ManyFile& file, const Reading& own, const OutputFiles& files,
                  Diagnostics& diagnostics) -> Result<std::vector<std::string>> {
    const auto job = job_of(file, own, writing, change, change_in_blocks, diagnostics);
    if (!job) return fail(job.error());
    Report report = process(*job, files);
    diagnostics.append(std::move(report.diagnostics));
    if (report.error) return fail(std::move(*report.error));
    return std::move(report.files);
  };
  return run_many(many, work, globals);
}

}  // namespace kinefile::cli
