// SPDX-License-Identifier: MIT
#include "kinefile/process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "document/sources.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/evidence.hpp"
#include "kinematics/limbs.hpp"

namespace kinefile {
namespace {

/// Whether a document was read with its own skeleton, which is not a robot to put it on.
bool has_own_skeleton(const Document& document) {
  const Format* from = find_format(document.format);
  return from != nullptr && !from->companion.empty();
}

Result<Document> in_wanted_kind(Document document, const Format& format,
                                const AdaptOptions& adapting, Diagnostics& diagnostics) {
  KindOptions kinds = adapting.kinds;
  std::shared_ptr<const Document> model;
  const bool has_use = uses_model(format, document, kinds);
  if (adapting.robot && !has_use) {
    return fail(ErrorKind::Usage, "CNV007",
                "a robot has no effect here: it is for a motion that goes onto its joints (--form "
                "joints or both)");
  }
  if (has_use && (adapting.robot || !has_own_skeleton(document))) {
    auto found = document_of(adapting.robot ? adapting.robot : adapting.skeleton, diagnostics);
    if (!found) return fail(std::move(found.error()));
    model = std::move(*found);
    kinds.model = model.get();
  }
  return in_kind_of(format, std::move(document), kinds, diagnostics);
}

/// The motion on the skeleton that was given for it, if its format stores the skeleton in a
/// separate file.
/// \param skeleton  out: that skeleton
Result<Document> on_named_skeleton(Document document, const Format& format,
                                   const AdaptOptions& adapting,
                                   std::shared_ptr<const Document>& skeleton,
                                   Diagnostics& diagnostics) {
  Diagnostics ignored;  // if the motion needs it, this was reported already
  const bool is_new = document.format != format.name;
  auto found = document_of(adapting.skeleton, is_new ? diagnostics : ignored);
  if (!found) return fail(std::move(found.error()));
  skeleton = std::move(*found);
  if (!is_new || skeleton == nullptr) return document;
  return on_skeleton_of(*skeleton, std::move(document), diagnostics);
}

bool is_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double one) { return std::isfinite(one); });
}

bool is_finite(const Skeleton& skeleton) {
  return std::all_of(skeleton.joints.begin(), skeleton.joints.end(), [](const Joint& joint) {
    return joint.offset.allFinite() && joint.rest_rotation.coeffs().allFinite() &&
           std::all_of(joint.tips.begin(), joint.tips.end(),
                       [](const Tip& tip) { return tip.offset.allFinite(); });
  });
}

/// Whether all numbers of a motion and its skeleton are finite.
bool is_finite(const Document& document) {
  if (const BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    return std::all_of(body->components.begin(), body->components.end(),
                       [](const Component& component) { return is_finite(component.values); });
  }
  const Motion* motion = std::get_if<Motion>(&document.content);
  return (!has_skeleton(document) || is_finite(skeleton_of(document))) &&
         (motion == nullptr || is_finite(motion->clip.values));
}

Error number_too_large() {
  return make_error(
      ErrorKind::DataLoss, "CNV011",
      "a number becomes larger than a double holds, by another unit or another skeleton");
}

/// The channels that are asked for, with what the document's file does with positions.
shape::ChannelOptions channels_for(const Document& document, const AdaptOptions& adapting) {
  shape::ChannelOptions channels = adapting.channels;
  const Format* const from = find_format(document.format);
  const bool knows_positions = from != nullptr && from->adds_positions != nullptr;
  channels.adds_positions = knows_positions && from->adds_positions(document);
  return channels;
}

}  // namespace

Result<Document> adapt(Document document, const Format& format, const AdaptOptions& adapting,
                       WriteOptions& options, Diagnostics& diagnostics) {
  const shape::ChannelOptions channels = channels_for(document, adapting);
  const Format* const from = find_format(document.format);
  const bool was_body = std::holds_alternative<BodyMotion>(document.content);
  const bool was_finite = from != &format && is_finite(document);
  auto made = in_wanted_kind(std::move(document), format, adapting, diagnostics);
  std::shared_ptr<const Document> skeleton;
  if (made && !format.companion.empty() && !was_body) {
    made = on_named_skeleton(std::move(*made), format, adapting, skeleton, diagnostics);
  }
  if (made) made = adapted_to(format, std::move(*made), channels, diagnostics);
  if (!made) return made;
  if (was_finite && !is_finite(*made)) {
    return fail(number_too_large());
  }
  // The given skeleton is also used for the output if the motion still fits it.
  if (skeleton != nullptr && skeleton->format == format.companion &&
      are_written_alike(*find_format(format.companion), *skeleton, *made)) {
    options.writes_companion = false;
    const std::string& name = adapting.skeleton_name;
    options.companion = name.substr(name.find_last_of('/') + 1);
  }
  return made;
}

namespace {

/// The frames that evidence is found in, without the others.
Result<Document> sampled(const LongMotion& motion) {
  Document document = motion.document;
  Clip& clip = std::get<Motion>(document.content).clip;
  const std::size_t step = step_of_samples(motion.frames.num_frames);
  for (std::size_t f = 0; f < motion.frames.num_frames; f += step) {
    const auto row = motion.frames.rows(f, 1);
    if (!row) return fail(row.error());
    clip.values.append(*row);
    ++clip.num_frames;
  }
  return document;
}

/// Whether a motion gets another form than a format's conventions say, which needs all frames.
bool asks_for_another_kind(const AdaptOptions& adapting) {
  return adapting.kinds.form || !adapting.skeleton_name.empty() || adapting.robot;
}

/// As `in_wanted_kind`, by what that makes of the frames that evidence is found in; empty if it
/// fails or makes no motion.
std::optional<LongMotion> of_wanted_kind(LongMotion motion, const Format& format,
                                         const AdaptOptions& adapting, Diagnostics& diagnostics) {
  if (asks_for_another_kind(adapting)) return std::nullopt;
  auto sample = sampled(motion);
  if (!sample) return std::nullopt;
  const std::size_t up = find_up_axis(std::get<Motion>(sample->content)).axis;
  const auto found = in_wanted_kind(*std::move(sample), format, adapting, diagnostics);
  if (!found || !std::holds_alternative<Motion>(found->content)) return std::nullopt;
  const std::optional<std::size_t> new_up = skeleton_of(*found).up;
  Skeleton& skeleton = std::get<Motion>(motion.document.content).skeleton;
  if (new_up) skeleton.up = up;
  return !new_up || new_up == up ? motion : edit::up(motion, *new_up);
}

Result<bool> is_finite(const FrameSource& frames) {
  bool are_finite = true;
  const auto read = for_each_block(frames, [&](const FrameBlock& block) {
    are_finite = is_finite(block.rows);
    return are_finite;
  });
  if (!read && are_finite) return fail(read.error());
  return are_finite;
}

/// The same frames, unless a number of theirs is not finite though all of the old ones are.
FrameSource while_finite(FrameSource frames, const LongMotion& old) {
  frames.rows = [rows = std::move(frames.rows), old](
                    std::size_t first, std::size_t count) -> Result<std::span<const double>> {
    auto made = rows(first, count);
    if (!made || is_finite(*made)) return made;
    const auto was_finite = is_finite(old.frames);
    if (!was_finite) return fail(was_finite.error());
    if (*was_finite) return fail(number_too_large());
    return rows(first, count);
  };
  return frames;
}

}  // namespace

std::optional<Result<LongMotion>> adapt_in_blocks(const LongMotion& motion, const Format& format,
                                                  const AdaptOptions& adapting,
                                                  Diagnostics& diagnostics) {
  const Format* const from = find_format(motion.document.format);
  const shape::ChannelOptions channels = channels_for(motion.document, adapting);
  Diagnostics own;
  own.warnings_are_errors = diagnostics.warnings_are_errors;
  const auto of_kind = of_wanted_kind(motion, format, adapting, own);
  if (!of_kind) return std::nullopt;
  auto made = adapted_in_blocks(format, *of_kind, channels, own);
  if (!made) return std::nullopt;
  if (*made && from != &format && is_finite(skeleton_of(motion.document))) {
    LongMotion& adapted = **made;
    if (!is_finite(skeleton_of(adapted.document))) return std::nullopt;
    adapted.frames = while_finite(std::move(adapted.frames), motion);
  }
  diagnostics.append(std::move(own));
  return made;
}

namespace {

/// Writes the outputs of a job, and commits them.
/// \param print  writes them to the files that it is given
void write_outputs(const OutputFiles& files,
                   FunctionRef<Result<void>(const OutputFiles& files)> print, Report& report) {
  OutputFiles told = files;
  std::vector<std::string> names;
  told.open = [&files, &names](const std::string& name) {
    names.push_back(name);
    return files.open(name);
  };
  auto written = print(told);
  if (written) written = files.commit();
  if (written) {
    report.files = std::move(names);
  } else {
    report.error = std::move(written.error());
  }
}

const Format* output_format(const Job& job, const Document& document) {
  if (job.to != nullptr) return job.to;
  return format_of_output(job.target, job.source, find_format(document.format));
}

bool may_be_in_blocks(const Job& job) {
  return job.most_bytes_in_memory && !job.bytes && job.operations.empty() &&
         (!job.change || job.change_in_blocks);
}

/// The motion of a job as it is written; empty if some step needs all frames at once.
std::optional<Result<LongMotion>> made_in_blocks(const Job& job, LongMotion motion,
                                                 const Format& format, Diagnostics& diagnostics) {
  if (job.change_in_blocks) {
    auto changed = job.change_in_blocks(std::move(motion), diagnostics);
    if (!changed) return changed;
    motion = *std::move(changed);
  }
  return adapt_in_blocks(motion, format, job.adapting, diagnostics);
}

/// Runs a job block by block; empty if that is not possible, and nothing is done.
std::optional<Report> process_in_blocks(const Job& job, const OutputFiles& files) {
  if (!may_be_in_blocks(job)) return std::nullopt;
  Report report;
  report.diagnostics.warnings_are_errors = job.strict;
  ReadOptions reading = job.reading;
  if (reading.opened) reading.opened = std::make_shared<std::vector<CompanionFile>>();
  auto motion = open_long_motion(job.source, job.from, *job.most_bytes_in_memory, reading,
                                 report.diagnostics);
  if (!motion) return std::nullopt;
  const Format* const format = output_format(job, motion->document);
  if (format == nullptr || format->write_frames == nullptr) return std::nullopt;
  const auto made = made_in_blocks(job, *std::move(motion), *format, report.diagnostics);
  if (!made) return std::nullopt;
  if (reading.opened) {
    job.reading.opened->insert(job.reading.opened->end(), reading.opened->begin(),
                               reading.opened->end());
  }
  if (!*made) {
    report.error = made->error();
    return report;
  }
  const LongMotion& adapted = **made;
  report.kind = kind_name(adapted.document);
  write_outputs(
      files,
      [&](const OutputFiles& told) {
        return write_in_blocks(job.target, adapted, *format, job.writing, told, report.diagnostics);
      },
      report);
  if (!report.error) report.num_frames = adapted.frames.num_frames;
  return report;
}

}  // namespace

Report process(const Job& job, const OutputFiles& files) {
  if (auto report = process_in_blocks(job, files)) return *std::move(report);
  Report report;
  report.diagnostics.warnings_are_errors = job.strict;
  const auto ended = [&report](const Error& error) {
    report.error = error;
    return std::move(report);
  };
  auto document =
      job.bytes ? read_bytes(*job.bytes, job.source, job.from, job.reading, report.diagnostics)
                : read_file(job.source, job.from, job.reading, report.diagnostics);
  if (!document) return ended(document.error());
  report.kind = kind_name(*document);
  const Format* const format = output_format(job, *document);
  if (format == nullptr) {
    return ended(make_error(ErrorKind::Usage, "CLI001",
                            fmt::format("'{}' shows no format by its name", job.target)));
  }
  auto applied = job.change ? job.change(*document, report.diagnostics) : Result<void>();
  if (applied) applied = apply(job.operations, *document, job.context, report.diagnostics);
  if (!applied) return ended(applied.error());
  WriteOptions options = job.writing;
  auto adapted = adapt(std::move(*document), *format, job.adapting, options, report.diagnostics);
  if (!adapted) return ended(adapted.error());
  write_outputs(
      files,
      [&](const OutputFiles& told) {
        return write(job.target, *adapted, *format, options, told, report.diagnostics);
      },
      report);
  const Motion* const motion = std::get_if<Motion>(&adapted->content);
  if (!report.error && motion != nullptr) report.num_frames = motion->clip.num_frames;
  return report;
}

}  // namespace kinefile
