// SPDX-License-Identifier: MIT
// Real files: the robots that come with Choreonoid, counted and placed as Choreonoid 2.5 did.

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <sstream>

#include "formats/robots/robots.hpp"
#include "kinefile/io.hpp"
#include "support/motion_checks.hpp"
#include "text/yaml/tree.hpp"

namespace kinefile::test {
namespace {

std::string models() { return data_folder() + "/choreonoid/model/"; }

Document read_model(const std::string& path) {
  Diagnostics diagnostics;
  auto document = read_file(path, nullptr, {}, diagnostics);
  EXPECT_TRUE(document) << path;
  EXPECT_EQ(text_of(diagnostics), "");
  EXPECT_TRUE(!document || validate(skeleton_of(*document))) << path;
  return document ? std::move(*document) : Document{};
}

TEST(RobotRealFiles, HaveTheLinksAndJointsThatChoreonoidCounts) {
  SKIP_WITHOUT_DATA();
  struct Counts {
    std::size_t links, joints, virtual_joints;
  };
  const std::map<std::string, Counts> kExpected = {
      {"SR1.body", {30, 29, 0}},
      {"SR1.urdf", {30, 29, 0}},
      {"PA10/PA10.body", {10, 9, 0}},
      {"misc/crawler.body", {3, 2, 0}},
      {"misc/ragdoll.body", {23, 0, 22}},
      {"misc/ContinuousTrackVehicle.body", {89, 8, 80}},
      {"misc/FourWheelCar.body", {7, 2, 4}},
      {"misc/ClosedLinkSample.body", {4, 3, 0}},
      {"misc/box1.body", {1, 0, 0}},
  };
  for (const auto& [name, counts] : kExpected) {
    const Document document = read_model(models() + name);
    const Skeleton& skeleton = skeleton_of(document);
    EXPECT_EQ(skeleton.joints.size(), counts.links) << name;
    EXPECT_EQ(num_joint_ids(document), counts.joints) << name;
    EXPECT_EQ(skeleton.coordinates.size(), 7 + counts.joints + counts.virtual_joints) << name;
  }
}

TEST(RobotRealFiles, HaveTheShapesThatTheirTextsCount) {
  SKIP_WITHOUT_DATA();
  // Counted by a script that parses YAML and XML.
  const std::map<std::string, std::size_t> kExpected = {
      {"choreonoid/model/SR1.body", 49},
      {"choreonoid/model/SR1.urdf", 47},
      {"choreonoid/model/PA10/PA10.body", 0},
      {"choreonoid/model/misc/ClosedLinkSample.body", 10},
      {"choreonoid/model/misc/ContinuousTrackVehicle.body", 89},
      {"choreonoid/model/misc/FourWheelCar.body", 10},
      {"choreonoid/model/misc/PxCrawler.body", 7},
      {"choreonoid/model/misc/Torus.body", 0},
      {"choreonoid/model/misc/ellipsoid1.body", 1},
      {"choreonoid/model/misc/fencedfloor.body", 5},
      {"choreonoid/model/misc/longtable.body", 5},
      {"choreonoid/model/misc/pendulum.body", 2},
      {"choreonoid/model/misc/ragdoll.body", 16},
      {"choreonoid/model/misc/submersible.body", 6},
      {"robots/booster_t1/t1_23dof.urdf", 12},
      {"robots/unitree_h1/h1.urdf", 3},
      {"robots/unitree_g1/g1_29dof_rev_1_0.urdf", 0},
  };
  for (const auto& [name, count] : kExpected) {
    Diagnostics diagnostics;
    const auto document = read_file(data_folder() + "/" + name, nullptr, {}, diagnostics);
    ASSERT_TRUE(document) << name;
    EXPECT_EQ(num_shapes(skeleton_of(*document)), count) << name;
    EXPECT_EQ(count_code(diagnostics, "BDY018") + count_code(diagnostics, "URD016"), 0u) << name;
  }
}

/// Whether two shapes look the same but for their colour.
bool look_alike(const VisualShape& a, const VisualShape& b) {
  const Vec3 axis_a = a.rotation * Vec3::UnitZ();
  const Vec3 axis_b = b.rotation * Vec3::UnitZ();
  return a.kind == b.kind && (a.size - b.size).norm() < 1e-6 &&
         (a.position - b.position).norm() < 1e-6 &&
         (a.kind == ShapeKind::Sphere || std::abs(axis_a.dot(axis_b)) > 1 - 1e-6);
}

TEST(RobotRealFiles, ARobotLooksTheSameInBothFormats) {
  SKIP_WITHOUT_DATA();
  const Document body = read_model(models() + "SR1.body");
  const Document urdf = read_model(models() + "SR1.urdf");
  for (const Joint& joint : skeleton_of(urdf).joints) {
    const auto& others =
        skeleton_of(body).joints.at(joint_of_name(skeleton_of(body), joint.name)).visuals;
    for (const VisualShape& shape : joint.visuals) {
      EXPECT_TRUE(std::any_of(others.begin(), others.end(), [&shape](const VisualShape& other) {
        return look_alike(shape, other);
      })) << joint.name;
    }
  }
}

TEST(RobotRealFiles, TheFingersOfNaoFollowItsHands) {
  SKIP_WITHOUT_DATA();
  Diagnostics diagnostics;
  const auto document =
      read_file(data_folder() + "/robots/nao_v50/nao.urdf", nullptr, {}, diagnostics);
  ASSERT_TRUE(document);
  const Skeleton& skeleton = skeleton_of(*document);
  const auto following = following_columns(skeleton);
  EXPECT_EQ(following.size(), 17u);
  const auto columns = value_columns(skeleton);
  const auto by_joint_name = [&](const std::string& name) {
    const auto found =
        std::find_if(skeleton.joints.begin(), skeleton.joints.end(),
                     [&name](const Joint& joint) { return joint.joint_name == name; });
    return static_cast<std::size_t>(found - skeleton.joints.begin());
  };
  const std::size_t hand = by_joint_name("RHand");
  Motion motion{skeleton, rest_clip(skeleton)};
  motion.clip.timeline = {FrameRate{10}, 0};
  motion.clip.mutate()[0][*columns[hand]] = 0.5;
  const auto body = robot::project(motion, robot::BodyForm::Joints, nullptr, diagnostics);
  ASSERT_TRUE(body);
  const std::size_t finger = by_joint_name("RFinger12");
  EXPECT_DOUBLE_EQ(body->components[1].row(0)[*columns[finger] - kRootColumns], 0.5 * 0.999899);
  const auto back = robot::pose(*body, skeleton, false, diagnostics);
  ASSERT_TRUE(back);
  const LocalPoses poses = local_poses(skeleton, back->clip, {.rotations = true});
  const double* q = &poses.rotations[4 * finger];
  EXPECT_NEAR(angle_between(Quat(q[0], q[1], q[2], q[3]), skeleton.joints[finger].rest_rotation),
              0.5 * 0.999899, 1e-9);
}

TEST(RobotRealFiles, AllRead) {
  SKIP_WITHOUT_DATA();
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(models())) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".body" && extension != ".urdf") continue;
    EXPECT_FALSE(skeleton_of(read_model(entry.path().string())).joints.empty());
    ++count;
  }
  EXPECT_GT(count, 45u);
}

/// A link's pose in one frame, as Choreonoid printed it.
struct GoldenLink {
  Vec3 position;
  Quat quaternion;
  Mat3 rotation;
};

/// Frame number to link name to pose.
std::map<std::size_t, std::map<std::string, GoldenLink>> read_golden(const std::string& path) {
  std::map<std::size_t, std::map<std::string, GoldenLink>> frames;
  std::istringstream lines(bytes_of(path));
  std::size_t frame = 0;
  for (std::string word; lines >> word;) {
    if (word == "FRAME") lines >> frame >> word;
    if (word != "L") continue;
    std::string index, name;
    GoldenLink link;
    lines >> index >> name >> link.position.x() >> link.position.y() >> link.position.z() >> word;
    lines >> link.quaternion.w() >> link.quaternion.x() >> link.quaternion.y() >>
        link.quaternion.z() >> word;
    for (int i = 0; i < 9; ++i) lines >> link.rotation(i / 3, i % 3);
    EXPECT_TRUE(lines) << path;
    frames[frame][name] = link;
  }
  return frames;
}

/// The rows of a component's frames.
std::vector<std::vector<double>> rows_of(const text::yaml::Tree& tree, std::size_t component) {
  const auto* frames = text::yaml::find(
      *text::yaml::find(tree.root(), "components")->children.at(component), "frames");
  const auto& rows = *frames->rows;
  const std::size_t width = rows.values.size() / rows.entries.size();
  std::vector<std::vector<double>> result;
  for (std::size_t r = 0; r < rows.entries.size(); ++r) {
    const auto begin = rows.values.begin() + static_cast<std::ptrdiff_t>(r * width);
    result.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(width));
  }
  return result;
}

/// The rows of a form 2 motion of SR1: the root's pose (x y z qw qx qy qz) and 29 joint values.
std::vector<double> read_form2() {
  const std::string text = bytes_of(data_folder() + "/choreonoid/made/SR1_form2_v4.seq");
  const text::Source source("SR1_form2_v4.seq", text);
  Diagnostics diagnostics;
  const auto tree = text::yaml::read_tree(source, diagnostics);
  EXPECT_NE(tree, nullptr);
  std::vector<double> values;
  const auto roots = rows_of(*tree, 0);
  const auto joints = rows_of(*tree, 1);
  for (std::size_t f = 0; f < roots.size(); ++f) {
    values.insert(values.end(), roots[f].begin(), roots[f].end());
    values.insert(values.end(), joints.at(f).begin(), joints.at(f).end());
  }
  return values;
}

/// How far links are from where Choreonoid placed them, at most.
struct Farthest {
  double position = 0;
  double rotation = 0;  ///< in any element of the matrices
};

/// \param has_golden_root  whether the root is where Choreonoid placed it, and not where the file
///                         says
Farthest farthest_from_golden(const std::string& model, const std::string& golden,
                              bool has_golden_root) {
  const Document document = read_model(models() + model);
  const Skeleton& skeleton = skeleton_of(document);
  const auto frames = read_golden(data_folder() + "/choreonoid/golden/" + golden);
  EXPECT_EQ(frames.size(), 15u);
  std::vector<double> values = read_form2();
  for (const auto& [frame, links] : frames) {
    if (!has_golden_root) break;
    const GoldenLink& root = links.at(skeleton.joints[0].name);
    double* row = values.data() + frame * skeleton.coordinates.size();
    const Quat& q = root.quaternion;
    const double pose[] = {
        root.position.x(), root.position.y(), root.position.z(), q.w(), q.x(), q.y(), q.z()};
    std::copy(std::begin(pose), std::end(pose), row);
  }
  const WorldPoses poses = poses_of(skeleton, values);
  Farthest farthest;
  for (const auto& [frame, links] : frames) {
    EXPECT_EQ(links.size(), skeleton.joints.size());
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      const GoldenLink& link = links.at(skeleton.joints[j].name);
      const Mat3 turn = rotation_in(poses, j, frame).toRotationMatrix() - link.rotation;
      farthest.position =
          std::max(farthest.position, (position_in(poses, j, frame) - link.position).norm());
      farthest.rotation = std::max(farthest.rotation, turn.cwiseAbs().maxCoeff());
    }
  }
  return farthest;
}

void expect_golden(const std::string& model, const std::string& golden) {
  const Farthest by_links = farthest_from_golden(model, golden, true);
  EXPECT_LE(by_links.position, 1e-12);
  EXPECT_LE(by_links.rotation, 1e-12);
  // The file has nine digits of the root's quaternion, whose length is off by up to 5e-10 then; it
  // is taken as it is.
  const Farthest by_file = farthest_from_golden(model, golden, false);
  EXPECT_LE(by_file.position, 1e-12);
  EXPECT_LE(by_file.rotation, 1e-12);
}

TEST(RobotRealFiles, Sr1IsWhereChoreonoidPlacesIt) {
  SKIP_WITHOUT_DATA();
  expect_golden("SR1.body", "SR1_form2_fk_every10.txt");
}

TEST(RobotRealFiles, Sr1OfUrdfIsWhereChoreonoidPlacesIt) {
  SKIP_WITHOUT_DATA();
  expect_golden("SR1.urdf", "SR1_urdf_form2_fk_every10.txt");
}

TEST(RobotRealFiles, LinkOrderIsChoreonoids) {
  SKIP_WITHOUT_DATA();
  const auto second_link = [](const std::string& name) {
    return skeleton_of(read_model(models() + name)).joints.at(1).name;
  };
  EXPECT_EQ(second_link("SR1.body"), "WAIST_P");
  EXPECT_EQ(second_link("SR1.urdf"), "RLEG_HIP_R");
}

}  // namespace
}  // namespace kinefile::test
