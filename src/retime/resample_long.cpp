// SPDX-License-Identifier: MIT
// The new frames of a block need some old ones around their places only, so that a part of the old
// motion is retimed as if it were all of it.

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "kinefile/retime.hpp"
#include "retime/interpolate_plan.hpp"
#include "retime/steady_frames.hpp"

namespace kinefile::retime {
namespace {

struct Resampling {
  Skeleton skeleton;
  FrameSource old_frames;
  SteadyFrames map;
  RetimeOptions options;
  Array<double> rows = {};  ///< the block that was asked for last
};

/// Some frames, from one up to another that is not included.
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The old frames that new ones need: those of cubic interpolation, and for averages three sigma on
/// each side (see `apply`).
Span needed_frames(const Resampling& work, const Span& made) {
  const double rate = work.map.numerator / work.map.denominator;
  const double aside = work.options.antialias ? std::ceil(1.5 * rate) : 0;
  const std::size_t margin = static_cast<std::size_t>(aside) + 3;
  const auto first = static_cast<std::size_t>(work.map.old_frame(made.begin));
  const auto last = static_cast<std::size_t>(work.map.old_frame(made.end - 1));
  return {first - std::min(first, margin), std::min(last + margin + 1, work.map.num_old_frames)};
}

/// Makes some new frames.
/// \param old   the old frames that are there
/// \param rows  their values
/// \param out   shape (new frames, coordinates)
Result<void> make_frames(const Resampling& work, const Span& made, const Span& old,
                         std::span<const double> rows, double* out) {
  // An average depends on how fast the map is, by the frames beside the new one.
  const std::size_t first = made.begin - std::min<std::size_t>(made.begin, 1);
  const std::size_t end = std::min(made.end + 1, work.map.num_frames);
  TimeMap map;
  for (std::size_t n = first; n < end; ++n) {
    map.old_frames.push_back(work.map.old_frame(n) - static_cast<double>(old.begin));
  }
  const std::size_t width = work.old_frames.num_coordinates;
  Motion part{work.skeleton, {old.end - old.begin, width, Array<double>::adopt(rows, nullptr), {}}};
  Diagnostics told_before;
  const auto result = apply(part, map, work.options, told_before);
  if (!result) return fail(result.error());
  const double* const values = result->clip.row(made.begin - first).data();
  std::copy_n(values, (made.end - made.begin) * width, out);
  return {};
}

/// Makes the frames that are asked for. Where they need more old frames than a source gives at a
/// time, fewer new ones are made at a time.
Result<std::span<const double>> rows_of(Resampling& work, std::size_t first, std::size_t count) {
  const std::size_t width = work.old_frames.num_coordinates;
  work.rows.resize(count * width);
  double* out = work.rows.mutate().data();
  const double rate = work.map.numerator / work.map.denominator;
  const double most = static_cast<double>(frames_per_read(work.old_frames)) / std::max(rate, 1.0);
  const std::size_t step = std::max<std::size_t>(static_cast<std::size_t>(most), 1);
  for (std::size_t done = 0; done < count; done += step) {
    const Span made{first + done, first + std::min(done + step, count)};
    const Span old = needed_frames(work, made);
    const auto rows = work.old_frames.rows(old.begin, old.end - old.begin);
    if (!rows) return fail(rows.error());
    auto is_made = make_frames(work, made, old, *rows, out + done * width);
    if (!is_made) return fail(std::move(is_made.error()));
  }
  return std::span<const double>(work.rows);
}

}  // namespace

Result<LongMotion> resample(LongMotion motion, double frame_rate, const RetimeOptions& options,
                            Diagnostics& diagnostics) {
  Motion& head = std::get<Motion>(motion.document.content);
  // Without frames, the map has the checks and the new timeline alone.
  auto map = resample_map(head.clip, frame_rate);
  if (!map) return fail(std::move(map.error()));
  const std::size_t num_old_frames = motion.frames.num_frames;
  if (num_old_frames == 0 || motion.frames.num_coordinates == 0) return motion;
  auto steady = steady_frames(num_old_frames, nominal_frame_rate(head.clip.timeline), frame_rate);
  if (!steady) return fail(std::move(steady.error()));
  plan_interpolation(head.skeleton, options.rotation, diagnostics);  // says what it must
  head.clip.timeline = *map->timeline;
  FrameSource frames{steady->num_frames, motion.frames.num_coordinates};
  const auto work = std::make_shared<Resampling>(
      Resampling{head.skeleton, std::move(motion.frames), *steady, options});
  frames.rows = [work](std::size_t first, std::size_t count) {
    return rows_of(*work, first, count);
  };
  return LongMotion{std::move(motion.document), std::move(frames)};
}

}  // namespace kinefile::retime
