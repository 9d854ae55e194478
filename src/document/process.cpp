// SPDX-License-Identifier: MIT
#include "kinefile/process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "document/sources.hpp"

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

}  // namespace

Result<Document> adapt(Document document, const Format& format, const AdaptOptions& adapting,
                       WriteOptions& options, Diagnostics& diagnostics) {
  shape::ChannelOptions channels = adapting.channels;
  const Format* const from = find_format(document.format);
  const bool knows_positions = from != nullptr && from->adds_positions != nullptr;
  channels.adds_positions = knows_positions && from->adds_positions(document);
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
    return fail(ErrorKind::DataLoss, "CNV011",
                "a number becomes larger than a double holds, by another unit or another skeleton");
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

bool needs_no_adapting(const Document& motion, const Format& format, const AdaptOptions& adapting) {
  WriteOptions options;
  Diagnostics changes;
  const auto adapted = adapt(motion, format, adapting, options, changes);
  const bool is_motion = adapted && std::holds_alternative<Motion>(adapted->content);
  return is_motion && changes.items().empty() &&
         skeleton_of(*adapted).angle_unit == skeleton_of(motion).angle_unit &&
         are_written_alike(format, motion, *adapted);
}

Report process(const Job& job, const OutputFiles& files) {
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
  const Format* format =
      job.to != nullptr ? job.to
                        : format_of_output(job.target, job.source, find_format(document->format));
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
  OutputFiles told = files;
  std::vector<std::string> names;
  told.open = [&files, &names](const std::string& name) {
    names.push_back(name);
    return files.open(name);
  };
  auto written = write(job.target, *adapted, *format, options, told, report.diagnostics);
  if (written) written = files.commit();
  if (!written) return ended(written.error());
  if (const Motion* motion = std::get_if<Motion>(&adapted->content)) {
    report.num_frames = motion->clip.num_frames;
  }
  report.files = std::move(names);
  return report;
}

}  // namespace kinefile
