// SPDX-License-Identifier: MIT
// Whatever is written is read back as the same thing, or refused: every format that is written and
// read against every kind of motion, with numbers at the ends of what a double holds.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "kinefile/io.hpp"
#include "kinefile/process.hpp"
#include "kinefile/robot.hpp"
#include "support/robots.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

using Random = std::mt19937_64;

/// The numbers that a document is filled with.
enum class Numbers { Usual, Odd, NotFinite };

double number(Random& random, Numbers kind) {
  constexpr double kOdd[] = {0.0,  -0.0,   1e200,   -1e200,  1e-300,
                             1e15, 5e-324, -1e-310, 1.0 / 3, 1.7976931348623157e308};
  constexpr double kNotFinite[] = {std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::quiet_NaN()};
  if (kind == Numbers::NotFinite && random() % 4 == 0) return kNotFinite[random() % 3];
  if (kind == Numbers::Odd) return kOdd[random() % std::size(kOdd)];
  return std::uniform_real_distribution<double>(-3, 3)(random);
}

struct Named {
  std::string name;
  Document document;
};

Component component_of(ComponentKind kind, std::string_view content, std::size_t num_parts,
                       PoseForm form = PoseForm::Quaternion) {
  Component component;
  component.kind = kind;
  component.content = content;
  component.num_parts = num_parts;
  component.pose_form = form;
  component.timeline = {FrameRate{50}, 0};
  return component;
}

/// Gives components frames of numbers; quaternions stay rotations.
BodyMotion filled(BodyMotion body, std::size_t num_frames, Numbers kind, Random& random) {
  for (Component& component : body.components) {
    component.num_frames = num_frames;
    component.values.resize(num_frames * component.row_size());
    for (double& value : component.values.mutate()) value = number(random, kind);
    const bool has_quaternions =
        component.kind == ComponentKind::Poses && component.pose_form == PoseForm::Quaternion;
    if (!has_quaternions || kind != Numbers::Usual) continue;
    for (std::size_t f = 0; f < num_frames; ++f) {
      const auto row = component.mutate()[f];
      for (std::size_t q = 3; q < row.size(); q += 7) {
        const Quat unit = Quat(row[q], row[q + 1], row[q + 2], row[q + 3]).normalized();
        row[q] = unit.w();
        row[q + 1] = unit.x();
        row[q + 2] = unit.y();
        row[q + 3] = unit.z();
      }
    }
  }
  return body;
}

/// A chain of joints in degrees; the root has positions and the last joint a tip.
Motion figure(std::size_t num_frames, Numbers kind, Random& random) {
  constexpr std::size_t kJoints = 3;
  constexpr const char* kChannels[] = {"Xposition", "Yposition", "Zposition",
                                       "Zrotation", "Xrotation", "Yrotation"};
  constexpr int kAxes[] = {0, 1, 2, 2, 0, 1};
  const Numbers of_offsets = kind == Numbers::NotFinite ? Numbers::Usual : kind;
  Motion motion;
  Skeleton& skeleton = motion.skeleton;
  for (std::size_t j = 0; j < kJoints; ++j) {
    Joint& joint = skeleton.joints.emplace_back();
    joint.name = fmt::format("j{}", j);
    joint.parent = j == 0 ? kNoParent : j - 1;
    for (double& part : joint.offset) part = j == 0 ? 0 : number(random, of_offsets);
    for (std::size_t k = j == 0 ? 0 : 3; k < 6; ++k) {
      joint.dofs.push_back({k < 3 ? DofKind::Translation : DofKind::Rotation, Vec3::Unit(kAxes[k]),
                            skeleton.coordinates.size(), 0});
      skeleton.coordinates.push_back({j, kChannels[k]});
    }
  }
  skeleton.joints.back().tips.push_back({"", {0, number(random, of_offsets), 0}});
  Clip& clip = motion.clip;
  clip.num_frames = num_frames;
  clip.num_coordinates = skeleton.coordinates.size();
  clip.timeline = {FrameRate{50}, 0};
  clip.values.resize(num_frames * clip.num_coordinates);
  for (double& value : clip.values.mutate()) value = number(random, kind);
  return motion;
}

/// Every kind of motion.
std::vector<Named> motions(std::size_t num_frames, Numbers kind, Random& random) {
  const Component joints = component_of(ComponentKind::Values, kJointDisplacement, 3);
  const Component links = component_of(ComponentKind::Poses, kLinkPosition, 2);
  const Component angles =
      component_of(ComponentKind::Poses, kLinkPosition, 2, PoseForm::RollPitchYaw);
  Component zmp = component_of(ComponentKind::Vectors, kZmp, 1);
  zmp.is_root_relative = true;
  const Component effort = component_of(ComponentKind::Values, "JointEffort", 2);
  const Component grip = component_of(ComponentKind::Values, "Grip", 2);
  const Component tips = component_of(ComponentKind::Poses, "Tip", 1);
  const Component force = component_of(ComponentKind::Vectors, "Force", 1);
  const auto body = [&](std::vector<Component> components) {
    return Document{filled({std::move(components)}, num_frames, kind, random), "", {}};
  };
  std::vector<Named> all;
  all.push_back({"a figure", {figure(num_frames, kind, random), "", {}}});
  all.push_back({"joints", body({joints})});
  all.push_back({"links", body({links})});
  all.push_back({"links with angles", body({angles})});
  all.push_back({"joints, links and a ZMP", body({joints, links, zmp})});
  all.push_back({"links with angles and joints", body({angles, joints})});
  all.push_back({"a ZMP alone", body({zmp})});
  all.push_back({"components of any content", body({links, joints, effort, grip, tips, force})});
  const Document on_robot = body({component_of(ComponentKind::Poses, kLinkPosition, 1),
                                  component_of(ComponentKind::Values, kJointDisplacement, 1)});
  Diagnostics diagnostics;
  auto robot =
      robot::pose(std::get<BodyMotion>(on_robot.content), hinge_robot(), false, diagnostics);
  EXPECT_TRUE(robot);
  if (robot) all.push_back({"a robot", {std::move(*robot), "", {}}});
  return all;
}

/// The columns of a motion, sorted by their joints and what they move: ASF has another order.
std::vector<std::size_t> sorted_columns(const Skeleton& skeleton) {
  std::vector<std::pair<std::string, std::size_t>> named;
  for (const Joint& joint : skeleton.joints) {
    for (const DegreeOfFreedom& dof : joint.dofs) {
      for (std::size_t k = 0; k < num_coordinates(dof); ++k) {
        Eigen::Index axis = 0;
        dof.axis.cwiseAbs().maxCoeff(&axis);
        named.emplace_back(fmt::format("{} {} {}", joint.name, static_cast<int>(dof.kind), axis),
                           dof.coordinate + k);
      }
    }
  }
  std::stable_sort(named.begin(), named.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::size_t> columns;
  for (const auto& [name, column] : named) columns.push_back(column);
  return columns;
}

std::vector<double> sorted_numbers_of(const Motion& motion) {
  const auto columns = sorted_columns(motion.skeleton);
  std::vector<double> numbers;
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    for (const std::size_t column : columns) numbers.push_back(motion.clip.row(f)[column]);
  }
  return numbers;
}

/// Every number of the frames, frame by frame.
std::vector<double> numbers_of(const Document& document) {
  if (const Motion* motion = std::get_if<Motion>(&document.content)) {
    return {motion->clip.values.begin(), motion->clip.values.end()};
  }
  std::vector<double> numbers;
  const BodyMotion* body = std::get_if<BodyMotion>(&document.content);
  const Component* main = body != nullptr ? main_component(*body) : nullptr;
  for (std::size_t f = 0; main != nullptr && f < main->num_frames; ++f) {
    for (const Component& component : body->components) {
      const auto row = component.row(f);
      numbers.insert(numbers.end(), row.begin(), row.end());
    }
  }
  return numbers;
}

bool is_same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0;
}

void expect_same_numbers(const Document& written, const Document& read) {
  const Motion* first = std::get_if<Motion>(&written.content);
  const Motion* second = std::get_if<Motion>(&read.content);
  const bool are_motions = first != nullptr && second != nullptr;
  const std::vector<double> a = are_motions ? sorted_numbers_of(*first) : numbers_of(written);
  const std::vector<double> b = are_motions ? sorted_numbers_of(*second) : numbers_of(read);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_TRUE(is_same(a[i], b[i])) << "number " << i << ": " << a[i] << " " << b[i];
  }
}

/// The components as "kind content parts width", which a reader must find again.
std::vector<std::string> shapes_of(const BodyMotion& body) {
  std::vector<std::string> shapes;
  for (const Component& one : body.components) {
    shapes.push_back(fmt::format("{} {} {} {} {}", static_cast<int>(one.kind), one.content,
                                 one.num_parts, one.width(), one.is_root_relative));
  }
  return shapes;
}

/// Whether a text has a number that is not finite. No name here has these letters.
bool has_not_finite(std::string_view text) {
  return text.find("inf") != std::string_view::npos || text.find("nan") != std::string_view::npos;
}

using Files = std::vector<MemoryFile>;

ReadOptions options_beside(const std::shared_ptr<const Files>& files) {
  ReadOptions options;
  options.companions.open = [files](const std::string& name) -> std::optional<CompanionFile> {
    for (const MemoryFile& file : *files) {
      if (file.name == name) return CompanionFile{name, file.bytes, files};
    }
    return std::nullopt;
  };
  options.companions.list = [](std::string_view) { return std::vector<std::string>(); };
  return options;
}

/// What became of a document in a format.
struct Outcome {
  std::optional<Document> written;  ///< in the form that the format takes; empty: refused
  std::optional<Document> read;     ///< empty: refused
  std::shared_ptr<Files> files = std::make_shared<Files>();
};

Outcome through(const Format& format, const Document& document) {
  Outcome outcome;
  Diagnostics diagnostics;
  WriteOptions options;
  auto adapted = adapt(document, format, {}, options, diagnostics);
  if (!adapted) return outcome;
  const bool is_set = format.write_set != nullptr;
  const std::string name = is_set ? "t" : fmt::format("t{}", format.extensions[0]);
  const OutputFiles files = files_in_memory(outcome.files);
  if (!write(name, *adapted, format, options, files, diagnostics) || !files.commit()) {
    return outcome;
  }
  outcome.written = std::move(*adapted);
  if (format.read == nullptr || outcome.files->empty()) return outcome;
  const MemoryFile& main = is_set ? outcome.files->front() : outcome.files->back();
  auto read =
      read_bytes(main.bytes, main.name, &format, options_beside(outcome.files), diagnostics);
  if (read) outcome.read = std::move(*read);
  return outcome;
}

/// Whether numbers pass through a format bit by bit: not the angles of an hrpsys root.
bool keeps_bits(const Format& format, const Document& written) {
  const BodyMotion* body = std::get_if<BodyMotion>(&written.content);
  return !format.conventions.is_root_and_joints || body == nullptr ||
         find_component(*body, ComponentKind::Poses, kLinkPosition) == nullptr;
}

void expect_all_given_back_or_refused(Numbers kind) {
  Random random(5);
  std::size_t num_compared = 0;
  for (int round = 0; round < 20; ++round) {
    for (const std::size_t num_frames : {0u, 1u, 2u, 5u}) {
      for (const Named& named : motions(num_frames, kind, random)) {
        for (const Format& format : formats()) {
          const bool holds_frames = format.name != "asf" && format.name != "robovie";
          if (!is_written(format) || !holds_frames) continue;
          SCOPED_TRACE(fmt::format("{} in {}, {} frames, round {}", named.name, format.name,
                                   num_frames, round));
          const Outcome outcome = through(format, named.document);
          for (const MemoryFile& file : *outcome.files) {
            const bool is_finite = kind != Numbers::NotFinite;
            ASSERT_TRUE(!is_finite || !has_not_finite(file.bytes)) << file.bytes;
          }
          if (!outcome.read || !keeps_bits(format, *outcome.written)) continue;
          expect_same_numbers(*outcome.written, *outcome.read);
          if (testing::Test::HasFatalFailure()) return;
          ++num_compared;
          const BodyMotion* source = std::get_if<BodyMotion>(&named.document.content);
          const BodyMotion* read = std::get_if<BodyMotion>(&outcome.read->content);
          if (source == nullptr || read == nullptr || format.write_set != nullptr) continue;
          ASSERT_EQ(shapes_of(*source), shapes_of(*read));
          expect_same_numbers(named.document, *outcome.read);
        }
      }
    }
  }
  EXPECT_GT(num_compared, 500u);
}

TEST(FormatProperties, UsualNumbersAreGivenBackOrRefused) {
  expect_all_given_back_or_refused(Numbers::Usual);
}

TEST(FormatProperties, NumbersAtTheEndsOfTheirRangeAreGivenBackOrRefused) {
  expect_all_given_back_or_refused(Numbers::Odd);
}

TEST(FormatProperties, NumbersThatAreNotFiniteAreGivenBackOrRefused) {
  expect_all_given_back_or_refused(Numbers::NotFinite);
}

}  // namespace
}  // namespace kinefile::test
