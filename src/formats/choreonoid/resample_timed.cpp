// SPDX-License-Identifier: MIT
// Frames with times become frames at a steady rate. Source: the format document, "timed frames": a
// frame is moved to the first one at or after its time and holds until the next.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "formats/choreonoid/codes.hpp"
#include "formats/choreonoid/reader.hpp"
#include "kinefile/math.hpp"

namespace kinefile::choreonoid {
namespace {

/// The largest delay of a time after a frame, in periods, at which it still belongs to this frame.
constexpr double kTolerance = 1e-9;

/// The largest number of values of a converted component, so that one absurd time cannot exhaust
/// memory.
constexpr double kMostValues = 1 << 26;

struct Steady {
  std::vector<double> values;
  std::size_t num_frames = 0;
};

std::string order_fault(double time, double before) {
  return fmt::format("expected a time above that of the frame before, {} s, found {} s", before,
                     time);
}

class Resampler {
 public:
  Resampler(const Reader& reader, SeqComponent& component, double rate)
      : reader_(reader),
        component_(component),
        rate_(rate),
        row_size_(component.num_parts * width_of(component)) {}

  void run() {
    if (!check_times()) return;
    Steady steady =
        reader_.options.timed_rounding == TimedRounding::Slerp ? interpolated() : held();
    component_.values = steady.values;
    component_.num_frames = steady.num_frames;
    component_.times.clear();
    component_.time_places.clear();
  }

 private:
  bool is_floor() const { return reader_.options.timed_rounding == TimedRounding::Floor; }

  /// The steady frame that a time goes to.
  double frame_of(double time) const {
    const double frame = time * rate_;
    // Choreonoid's own arithmetic: no tolerance, towards zero.
    return is_floor() ? std::trunc(frame) : std::max(0.0, std::ceil(frame - kTolerance));
  }

  bool check_times() {
    bool is_good = true;
    double before = -1;
    for (std::size_t i = 0; i < component_.times.size(); ++i) {
      const double time = component_.times[i];
      const char* at = component_.time_places[i];
      const double last = frame_of(time);
      if (!std::isfinite(time) || (is_floor() ? !(last >= 0) : time < 0) ||
          !((last + 1) * static_cast<double>(row_size_) < kMostValues)) {
        reader_.error(
            code::kBadTime,
            fmt::format("expected a time from 0 s up that a motion can last, found {} s", time),
            at);
        is_good = false;
      } else if (i > 0 && !(time > before)) {
        is_good &= report_order(time, before, at);
      }
      before = time;
    }
    return is_good;
  }

  bool report_order(double time, double before, const char* at) const {
    const std::string message = order_fault(time, before);
    if (is_floor()) {
      reader_.warn(code::kTimeNotAbove, message + "; it is read as Choreonoid does", at);
      return true;
    }
    return reader_.repair(code::kTimeNotAbove, message, "it is read as Choreonoid does", at);
  }

  Steady held() const {
    Steady steady;
    const std::size_t num_sources = component_.times.size();
    std::vector<bool> is_taken;
    for (std::size_t i = 0; i < num_sources; ++i) {
      const auto frame = static_cast<std::size_t>(frame_of(component_.times[i]));
      const double* row = component_.values.data() + i * row_size_;
      if (i == 0 && frame > 0) start(steady, frame, row);
      while (steady.num_frames <= frame) hold(steady, row);
      if (is_taken.size() < steady.num_frames) is_taken.resize(steady.num_frames, false);
      if (is_taken[frame]) {
        reader_.warn(code::kSameFrame,
                     fmt::format("two frames of the file go to frame {} at {} frames a second; the "
                                 "later one stands",
                                 frame, rate_),
                     component_.time_places[i]);
      }
      is_taken[frame] = true;
      std::copy(row, row + row_size_,
                steady.values.begin() + static_cast<std::ptrdiff_t>(frame * row_size_));
    }
    return steady;
  }

  /// Adds a frame that repeats the last, or is the first row.
  void hold(Steady& steady, const double* first) const {
    const std::size_t old = steady.values.size();
    steady.values.resize(old + row_size_);
    const double* from = old == 0 ? first : steady.values.data() + old - row_size_;
    std::copy(from, from + row_size_, steady.values.begin() + static_cast<std::ptrdiff_t>(old));
    ++steady.num_frames;
  }

  /// Frames before the first time: its values, or as in Choreonoid zeros and no rotation.
  void start(Steady& steady, std::size_t num_frames, const double* first) const {
    if (!is_floor()) {
      reader_.tell(Severity::Note, code::kBeforeFirst,
                   fmt::format("the first time is {} s; the {} frames before it hold its values",
                               component_.times[0], num_frames),
                   component_.time_places[0]);
      while (steady.num_frames < num_frames) hold(steady, first);
      return;
    }
    steady.values.assign(num_frames * row_size_, 0.0);
    steady.num_frames = num_frames;
    if (component_.kind != ComponentKind::Poses) return;
    const std::size_t width = width_of(component_);
    if (component_.pose_order == PoseOrder::RollPitchYaw) return;
    const std::size_t w = component_.pose_order == PoseOrder::QuaternionWFirst ? 3 : 6;
    for (std::size_t i = w; i < steady.values.size(); i += width) steady.values[i] = 1;
  }

  Steady interpolated() const {
    Steady steady;
    const auto& times = component_.times;
    if (times.empty()) return steady;
    const double last = times.back() * rate_;
    steady.num_frames = static_cast<std::size_t>(std::max(0.0, std::floor(last + kTolerance))) + 1;
    steady.values.resize(steady.num_frames * row_size_);
    for (std::size_t f = 0; f < steady.num_frames; ++f) {
      const auto [before, share] = position_in_time(times, static_cast<double>(f) / rate_);
      const std::size_t after = std::min(before + 1, times.size() - 1);
      interpolate(before, after, share, steady.values.data() + f * row_size_);
    }
    return steady;
  }

  void interpolate(std::size_t before, std::size_t after, double t, double* out) const {
    const double* a = component_.values.data() + before * row_size_;
    const double* b = component_.values.data() + after * row_size_;
    for (std::size_t i = 0; i < row_size_; ++i) {
      out[i] = t == 0 ? a[i] : a[i] + t * (b[i] - a[i]);
    }
    if (component_.kind != ComponentKind::Poses || t == 0) return;
    const std::size_t width = width_of(component_);
    for (std::size_t p = 0; p < row_size_; p += width) {
      turn(component_.pose_order, {a + p, width}, {b + p, width}, t, {out + p, width});
    }
  }

  /// Sets the rotation of a pose between two others; its other numbers are already interpolated.
  static void turn(PoseOrder order, std::span<const double> a, std::span<const double> b, double t,
                   std::span<double> out) {
    const auto rotation = [order](std::span<const double> pose) {
      if (order == PoseOrder::QuaternionWLast) return Quat(pose[6], pose[3], pose[4], pose[5]);
      const PoseForm form =
          order == PoseOrder::RollPitchYaw ? PoseForm::RollPitchYaw : PoseForm::Quaternion;
      const auto q = quaternion_of_pose(form, pose);
      return Quat(q[0], q[1], q[2], q[3]);
    };
    const Quat q = slerp(unit_quaternion(rotation(a)), unit_quaternion(rotation(b)), t);
    if (order == PoseOrder::RollPitchYaw) {
      const EulerAxes axes = {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()};
      const Vec3 angles = euler_angles(q.toRotationMatrix(), axes, Vec3(out[5], out[4], out[3]));
      for (std::size_t k = 0; k < 3; ++k) out[5 - k] = angles[static_cast<Eigen::Index>(k)];
      return;
    }
    const std::size_t w = order == PoseOrder::QuaternionWFirst ? 3 : 6;
    const std::size_t x = order == PoseOrder::QuaternionWFirst ? 4 : 3;
    out[w] = q.w();
    out[x] = q.x();
    out[x + 1] = q.y();
    out[x + 2] = q.z();
  }

  const Reader& reader_;
  SeqComponent& component_;
  double rate_;
  std::size_t row_size_;
};

}  // namespace

void resample_timed(const Reader& reader, SeqComponent& component) {
  const auto rate = reader.options.fps ? reader.options.fps : component.frame_rate;
  if (!rate) {
    reader.error(code::kNoTimedRate,
                 "expected frameRate, to which the frames with times are to go, found none; --fps "
                 "says it, --keep-times needs none",
                 component.at);
    return;
  }
  Resampler(reader, component, *rate).run();
}

void check_kept_times(const Reader& reader, const SeqComponent& component) {
  for (std::size_t i = 0; i < component.times.size(); ++i) {
    const double time = component.times[i];
    const char* at = component.time_places[i];
    if (!std::isfinite(time) || time < 0) {
      reader.error(code::kBadTime, fmt::format("expected a time from 0 s up, found {} s", time),
                   at);
    } else if (i > 0 && !(time > component.times[i - 1])) {
      reader.repair(code::kTimeNotAbove, order_fault(time, component.times[i - 1]), "it is kept",
                    at);
    }
  }
}

}  // namespace kinefile::choreonoid
