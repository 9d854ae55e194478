// SPDX-License-Identifier: MIT
#include "formats/hrpsys/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "formats/hrpsys/codes.hpp"
#include "formats/hrpsys/read.hpp"
#include "formats/table_rate.hpp"
#include "text/printer.hpp"

namespace kinefile::hrpsys {
namespace {

constexpr std::array<ReadOption, 2> kReadOptions = {options::kFps, options::kEncoding};
constexpr std::array<WriteOption, 1> kWriteOptions = {options::kDecimals};

/// The component that a file of the set is written from, or null.
const Component* component_of(const BodyMotion& motion, std::string_view part) {
  if (part == ".pos") return find_component(motion, ComponentKind::Values, kJointDisplacement);
  if (part == ".zmp") return find_component(motion, ComponentKind::Vectors, kZmp);
  return find_component(motion, ComponentKind::Poses, kLinkPosition);
}

/// Only the first link of poses, as x y z roll pitch yaw.
Component root_angles(const Component& links) {
  Component root = links;
  root.num_parts = std::min<std::size_t>(links.num_parts, 1);
  root.values.clear();
  for (std::size_t f = 0; f < links.num_frames && root.num_parts > 0; ++f) {
    const auto pose = links.row(f).first(links.width());
    root.values.append(pose);
  }
  if (links.pose_form == PoseForm::Quaternion) root.values = poses_as_roll_pitch_yaw(root);
  root.pose_form = PoseForm::RollPitchYaw;
  return root;
}

void print_rows(text::Printer& printer, const Component& component, std::size_t first,
                std::size_t count) {
  const auto print = [&](text::Printer& part, std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      part.print_exact(time_of_frame(component.timeline, f));
      part.continue_row(component.row(f).subspan(first, count), " ");
      part.print('\n');
    }
  };
  printer.print_rows(component.num_frames, count + 1, print);
}

/// Writes one file of the set.
Result<void> write_part(const Component& component, std::string_view part,
                        const WriteOptions& options, const Sink& sink) {
  text::Printer printer(sink, {.decimals = options.decimals});
  if (part == ".waist" || part == ".hip") {
    const Component root = root_angles(component);
    const bool is_hip = part == ".hip";
    print_rows(printer, root, is_hip ? 3 : 0, root.num_parts == 0 ? 0 : (is_hip ? 3 : 6));
  } else {
    print_rows(printer, component, 0, component.row_size());
  }
  return finish(printer);
}

/// \errors HRP008 (Usage) without frames: nobody reads an empty file; HRP017 (DataLoss) if the
/// times would not be read as a rate
Result<void> expect_readable(const Component& component) {
  if (component.num_frames == 0) {
    return fail(
        make_error(ErrorKind::Usage, code::kNothingToWrite,
                   fmt::format("expected frames of '{}' to write, found none", component.content)));
  }
  const double rate = frame_rate(component.timeline);
  const bool has_rate = rate >= kLeastTableRate && rate <= kMostTableRate;
  const bool has_times = component.num_frames == 1 || has_own_times(component.timeline);
  if (has_rate || has_times) return {};
  return fail(make_error(ErrorKind::DataLoss, code::kOddRate,
                         fmt::format("hrpsys has {} to {} frames a second, not {} as '{}'",
                                     kLeastTableRate, kMostTableRate, rate, component.content)));
}

Result<void> write_set(const Document& document, const WriteOptions& options, const OpenPart& open,
                       Diagnostics&) {
  if (auto valid = validate(document); !valid) return valid;
  const BodyMotion* const motion = std::get_if<BodyMotion>(&document.content);
  bool has_any = false;
  for (const std::string_view part : kParts) {
    const Component* const component = motion == nullptr ? nullptr : component_of(*motion, part);
    if (component == nullptr) continue;
    if (auto readable = expect_readable(*component); !readable) return readable;
    const auto sink = open(part);
    if (!sink) return fail(sink.error());
    if (auto written = write_part(*component, part, options, *sink); !written) return written;
    has_any = true;
  }
  if (has_any) return {};
  return fail(make_error(ErrorKind::Usage, code::kNothingToWrite,
                         "expected joint displacements, link poses or a ZMP to write, found none"));
}

}  // namespace

Format format() {
  Format format;
  format.name = "hrpsys";
  format.description = "hrpsys: a set of text files, joints, root and ZMP (a stem)";
  format.extensions = kParts;
  format.probe = nullptr;
  format.read = read;
  format.facts = facts_of_layout;
  format.write_set = write_set;
  format.read_options = kReadOptions;
  format.write_options = kWriteOptions;
  format.conventions.writes = {.body_motions = true};
  format.conventions.up = 2;
  format.conventions.angle_unit = AngleUnit::Radians;
  format.conventions.is_root_and_joints = true;
  return format;
}

}  // namespace kinefile::hrpsys
