// SPDX-License-Identifier: MIT
#include "formats/choreonoid/unbind.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "formats/choreonoid/bind.hpp"
#include "formats/choreonoid/codes.hpp"
#include "kinefile/math.hpp"
#include "text/numbers.hpp"

namespace kinefile::choreonoid {
namespace {

/// The type of a component of known kind.
std::string_view usual_type(ComponentKind kind) {
  constexpr std::array<std::string_view, 4> kTypes = {"MultiValueSeq", "MultiSE3Seq", "Vector3Seq",
                                                      ""};
  return kTypes[static_cast<std::size_t>(kind)];
}

/// The name of a content in a format version.
std::string usual_word(const Component& component, int version) {
  const std::string& content = component.content;
  if (component.kind == ComponentKind::Values && content == kJointDisplacement) {
    if (version == 1) return "JointPosition";
    if (version == 3) return "MultiJointDisplacementSeq";
  } else if (component.kind == ComponentKind::Poses && content == kLinkPosition) {
    if (version == 3) return "MultiLinkPositionSeq";
  } else if (component.kind == ComponentKind::Vectors && content == kZmp) {
    if (version == 1 && component.is_root_relative) return "RelativeZMP";
    if (version == 3) return "ZMPSeq";
  }
  return content;
}

/// Whether the word from the file still describes the component.
bool is_still_true(const std::string& word, const Component& component, int version) {
  if (component.kind != ComponentKind::Vectors || component.content != kZmp) return true;
  const bool is_called_relative = word == "RelativeZMP" || word == "RelativeZmp";
  if (is_called_relative) return component.is_root_relative;
  return version > 1 || !component.is_root_relative;
}

std::optional<PoseOrder> order_of(std::string_view word) {
  for (const PoseOrder order :
       {PoseOrder::QuaternionWFirst, PoseOrder::QuaternionWLast, PoseOrder::RollPitchYaw}) {
    if (word == word_of(order)) return order;
  }
  return std::nullopt;
}

Array<double> as_quaternions(const Component& component) {
  Array<double> values;
  values.reserve(component.num_frames * component.num_parts * 7);
  for (std::size_t i = 0; i < component.num_frames * component.num_parts; ++i) {
    const std::span<const double> pose(component.values.data() + i * 6, 6);
    values.append(pose.first(3));
    const auto q = quaternion_of_pose(PoseForm::RollPitchYaw, pose);
    values.append(q);
  }
  return values;
}

/// Chooses how poses are written, and converts them to that form.
void settle_poses(PrintedComponent& printed, int version, const WriteOptions& options,
                  Diagnostics& diagnostics) {
  const Component& component = *printed.component;
  const auto asked = order_of(options.se3_format);
  const KeptComponent* const own = component.kept.get<KeptComponent>();
  const bool is_rpy = component.pose_form == PoseForm::RollPitchYaw;
  printed.pose_order = asked ? *asked
                       : own ? own->pose_order
                             : (is_rpy ? PoseOrder::RollPitchYaw : PoseOrder::QuaternionWFirst);
  printed.pose_format = word_of(printed.pose_order);
  const bool wants_rpy = printed.pose_order == PoseOrder::RollPitchYaw;
  if (wants_rpy && !is_rpy) printed.converted = poses_as_roll_pitch_yaw(component);
  if (!wants_rpy && is_rpy) printed.converted = as_quaternions(component);
  if (printed.pose_order == PoseOrder::QuaternionWLast && version >= 2) {
    diagnostics.add(Severity::Warning, code::kChoreonoidRejects,
                    fmt::format("Choreonoid 2.x will reject this: it reads {} in format version 1 "
                                "alone; --se3-format XYZQWQXQYQZ is what it writes",
                                printed.pose_format));
  }
}

/// The rate that is written for frames with times of their own but no rate.
Result<double> rate_beside_times(const Component& component, Diagnostics& diagnostics) {
  const auto steady = steady_rate(own_times(component.timeline));
  if (!steady) {
    return fail(
        make_error(ErrorKind::DataLoss, code::kCannotWrite,
                   "expected a frame rate, or frames whose times rise, found neither; --fps "
                   "says a rate"));
  }
  diagnostics.add(
      steady->holds_times ? Severity::Note : Severity::Warning, code::kRateFound,
      fmt::format(
          "'{}' has frames at times of their own; {} frames a second are written beside them, "
          "{}",
          component.content, steady->per_second,
          steady->holds_times ? "the lowest usual rate that holds them all"
                              : "by their median step: no usual rate holds them all"));
  return steady->per_second;
}

/// \errors SEQ027 (DataLoss) if a frame has a time that no reader takes
Result<void> expect_times(const Component& component) {
  for (const double time : own_times(component.timeline)) {
    if (std::isfinite(time) && time >= 0) continue;
    return fail(make_error(
        ErrorKind::DataLoss, code::kCannotWrite,
        fmt::format("expected times from 0 s up in '{}', found {} s", component.content, time)));
  }
  return {};
}

Result<double> settle_rate(const Component& component, Diagnostics& diagnostics) {
  const double rate = nominal_frame_rate(component.timeline);
  if (const FrameTimes* own = std::get_if<FrameTimes>(&component.timeline.given)) {
    if (!own->per_second) return rate_beside_times(component, diagnostics);
  }
  if (!(rate > 0) || !std::isfinite(rate) || !std::isfinite(1 / rate)) {
    return fail(make_error(ErrorKind::DataLoss, code::kCannotWrite,
                           fmt::format("expected frames a second above 0, found {}", rate)));
  }
  if (rate != frame_rate(component.timeline) &&
      diagnostics.count_of(code::kRateSnapped, Severity::Note) == 0) {
    diagnostics.add(Severity::Note, code::kRateSnapped,
                    fmt::format("the frame time {} s is written as {} frames a second, from which "
                                "it was cut off",
                                frame_time(component.timeline), rate));
  }
  return rate;
}

Result<PrintedComponent> unbind_component(const Component& component, int version,
                                          bool is_same_version, const WriteOptions& options,
                                          Diagnostics& diagnostics) {
  PrintedComponent printed;
  printed.component = &component;
  const KeptComponent* const own = component.kept.get<KeptComponent>();
  const KeptComponent kept = own != nullptr ? *own : KeptComponent{};
  if (component.kind == ComponentKind::Other) {
    printed.unknown_keys = kept.text;
    return printed;
  }
  printed.type = is_same_version && !kept.type.empty() ? kept.type : usual_type(component.kind);
  const bool keeps_word =
      is_same_version && !kept.content.empty() && is_still_true(kept.content, component, version);
  printed.content = keeps_word ? kept.content : usual_word(component, version);
  const bool is_told_by_name = printed.content == "RelativeZMP" || printed.content == "RelativeZmp";
  printed.says_relative = component.is_root_relative && !(is_told_by_name && version == 1);
  printed.unknown_keys = kept.unknown_keys;
  if (auto times = expect_times(component); !times) return fail(std::move(times.error()));
  const auto rate = settle_rate(component, diagnostics);
  if (!rate) return fail(rate.error());
  printed.frame_rate = *rate;
  if (component.kind == ComponentKind::Poses) settle_poses(printed, version, options, diagnostics);
  return printed;
}

int major_of(const std::string& version) {
  const double number = text::parse_number(version).value;
  return number >= 1 && number < 5 ? static_cast<int>(number) : 1;
}

}  // namespace

Result<PrintedFile> unbind(const Document& document, const WriteOptions& options,
                           Diagnostics& diagnostics) {
  const BodyMotion* motion = std::get_if<BodyMotion>(&document.content);
  if (motion == nullptr) {
    return fail(make_error(
        ErrorKind::Usage, code::kCannotWrite,
        fmt::format("expected a body motion to write as .seq, found a {}", kind_name(document))));
  }
  const KeptFile* const own = document.kept.get<KeptFile>();
  PrintedFile file;
  const std::string own_version = own != nullptr ? own->version : "2";
  const bool is_same =
      own != nullptr && (options.version == 0 || options.version == major_of(own_version));
  file.version = options.version > 0 ? options.version : major_of(own_version);
  file.version_word = is_same ? own_version : fmt::format("{}", file.version);
  file.is_snake_case = is_same ? own->is_snake_case : file.version == 4;
  file.is_json = options.style == YamlStyle::Json ||
                 (options.style == YamlStyle::Kept && own != nullptr && own->is_json);
  file.choreonoid_digits = options.choreonoid_digits;
  if (own != nullptr) file.unknown_keys = own->unknown_keys;
  if (own != nullptr && own->has_comments) {
    diagnostics.add(Severity::Note, code::kCommentsDropped, "the file's comments are not written");
  }
  for (const Component& component : motion->components) {
    auto printed = unbind_component(component, file.version, is_same, options, diagnostics);
    if (!printed) return fail(std::move(printed.error()));
    file.components.push_back(std::move(*printed));
  }
  return file;
}

}  // namespace kinefile::choreonoid
