// SPDX-License-Identifier: MIT
#include "subject.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "walk.hpp"

namespace kinefile::bench {
namespace {

constexpr std::size_t kFrames = 78'000;

Subject& instance() {
  static Subject made;
  return made;
}

void write_or_exit(const std::string& path, const Document& document, const char* format,
                   const WriteOptions& options = {}) {
  Diagnostics diagnostics;
  const auto written =
      write_file(path, document, *find_format(format), options, {.may_replace = true}, diagnostics);
  if (written) return;
  fmt::print(stderr, "{}\n", to_string(written.error()));
  std::exit(1);
}

/// A root and 30 joints, some 50 MB as text.
BodyMotion make_robot_motion() {
  constexpr std::size_t kSeqFrames = 70'000;
  BodyMotion motion;
  const auto add = [&motion](ComponentKind kind, std::string_view content, std::size_t parts) {
    Component& component = motion.components.emplace_back();
    component.kind = kind;
    component.content = content;
    component.num_parts = parts;
    component.num_frames = kSeqFrames;
    component.timeline.given = FrameRate{500};
    for (std::size_t i = 0; i < kSeqFrames * component.row_size(); ++i) {
      component.values.push_back(std::sin(0.37 * static_cast<double>(i)));
    }
    if (kind != ComponentKind::Poses) return;
    // A unit quaternion, rounded or not.
    const Rows rows = component.mutate();
    for (std::size_t f = 0; f < component.num_frames; ++f) {
      const double quaternion[4] = {0.6, 0, -0.8, 0};
      std::copy_n(quaternion, 4, rows[f].begin() + 3);
    }
  };
  add(ComponentKind::Poses, kLinkPosition, 1);
  add(ComponentKind::Values, kJointDisplacement, 30);
  return motion;
}

}  // namespace

const Subject& subject() { return instance(); }

Document read_or_exit(const std::string& path) {
  Diagnostics diagnostics;
  auto document = read_file(path, nullptr, {}, diagnostics);
  if (!document) {
    fmt::print(stderr, "{}\n", to_string(document.error()));
    std::exit(1);
  }
  return std::move(*document);
}

void make_subject() {
  std::string folder = std::filesystem::temp_directory_path() / "kinefile-bench.XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) {
    fmt::print(stderr, "{} cannot be made\n", folder);
    std::exit(1);
  }
  instance().folder = folder;
  instance().path = folder + "/walk.bvh";
  instance().short_path = folder + "/short.bvh";
  instance().amc_path = folder + "/walk.amc";
  instance().csv_path = folder + "/robot.csv";
  instance().seq_path = folder + "/robot.seq";
  instance().rounded_seq_path = folder + "/rounded.seq";
  Document document;
  document.content = examples::make_walk({.num_frames = kFrames});
  const WriteOptions six_decimals{.decimals = 6};
  write_or_exit(instance().path, document, "bvh", six_decimals);
  write_or_exit(instance().short_path, document, "bvh");
  Diagnostics diagnostics;
  const auto bones = adapted_to(*find_format("amc"), std::move(document), {}, diagnostics);
  write_or_exit(instance().amc_path, bones.value(), "amc", six_decimals);
  Document robot;
  robot.content = make_robot_motion();
  write_or_exit(instance().seq_path, robot, "choreonoid");
  for (Component& component : std::get<BodyMotion>(robot.content).components) {
    for (double& value : component.values.mutate()) value = std::round(value * 1e6) / 1e6;
  }
  write_or_exit(instance().rounded_seq_path, robot, "choreonoid");
  WriteOptions options;
  const auto table = adapt(std::move(robot), *find_format("csv"), {}, options, diagnostics);
  write_or_exit(instance().csv_path, table.value(), "csv");
}

void load_subject() { instance().motion = std::get<Motion>(read_or_exit(subject().path).content); }

void remove_subject() { std::filesystem::remove_all(subject().folder); }

}  // namespace kinefile::bench
