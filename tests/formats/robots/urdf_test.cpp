// SPDX-License-Identifier: MIT
#include <random>

#include "formats/robots/robots.hpp"

namespace kinefile::test {
namespace {

std::string urdf_with(const std::string& elements) {
  return "<?xml version=\"1.0\"?>\n<robot name=\"t\">\n" + elements + "</robot>\n";
}

std::string joint(const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& inner = "<limit velocity=\"1\" effort=\"1\"/>") {
  return "<joint name=\"to_" + child + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + inner + "</joint>\n";
}

TEST(Urdf, JointsAreInTheOrderOfTheFileAndThoseThatMoveHaveIds) {
  const Document document = robot_of(
      "urdf", urdf_with(joint("revolute", "A", "C") + joint("fixed", "A", "B") +
                        joint("continuous", "B", "D", "") + joint("prismatic", "C", "E") +
                        "<link name=\"D\"/><link name=\"C\"/><link name=\"A\"/><link name=\"B\"/>"
                        "<link name=\"E\"/>"));
  const Skeleton& skeleton = skeleton_of(document);
  EXPECT_EQ(names_of(skeleton), "A C E B D");
  EXPECT_EQ(joint_columns_of(skeleton), "C.q D.q E.q");
  EXPECT_EQ(skeleton.joints[joint_of_name(skeleton, "D")].joint_name, "to_D");
  EXPECT_EQ(skeleton.joints[joint_of_name(skeleton, "E")].dofs.at(0).coordinate, kRootColumns + 2);
  EXPECT_EQ(skeleton.joints[joint_of_name(skeleton, "A")].joint_name, "");
}

TEST(Urdf, RollPitchAndYawTurnAboutFixedAxes) {
  const Document document = robot_of(
      "urdf", urdf_with("<link name=\"A\"/><link name=\"B\"/>" +
                        joint("fixed", "A", "B", "<origin xyz=\"1 2 3\" rpy=\"0.1 0.2 0.3\"/>")));
  const Joint& b = skeleton_of(document).joints.at(1);
  EXPECT_EQ(b.offset, Vec3(1, 2, 3));
  const Mat3 expected =
      (Eigen::AngleAxisd(0.3, Vec3::UnitZ()) * Eigen::AngleAxisd(0.2, Vec3::UnitY()) *
       Eigen::AngleAxisd(0.1, Vec3::UnitX()))
          .toRotationMatrix();
  EXPECT_LE((b.rest_rotation.toRotationMatrix() - expected).cwiseAbs().maxCoeff(), 1e-15);
}

/// A file of a version with a joint whose <origin> has these attributes.
std::string urdf_of_version(const std::string& version, const std::string& origin) {
  return "<robot name='t' " + version + "><link name='A'/><link name='B'/>" +
         joint("fixed", "A", "B", "<origin xyz='1 2 3' " + origin + "/>") + "</robot>";
}

TEST(Urdf, FromVersion11OnAnOriginMayHaveAQuaternion) {
  const double half = std::sqrt(0.5);
  const std::string quaternion = "quat_xyzw='0 0 0.70710678 0.70710678'";
  for (const char* version :
       {"version='1.1'", "version='1.2'", "version='1.10'", "version='2.0'", "version='2'"}) {
    const Document document = robot_of("urdf", urdf_of_version(version, quaternion));
    const Joint& b = skeleton_of(document).joints.at(1);
    EXPECT_EQ(b.offset, Vec3(1, 2, 3)) << version;
    EXPECT_LE((b.rest_rotation.coeffs() - Quat(half, 0, 0, half).coeffs()).norm(), 1e-15)
        << version;
  }
  for (const char* version :
       {"", "version='1.0'", "version='1'", "version='0.9'", "version='new'"}) {
    const ReadText read = read_robot("urdf", urdf_of_version(version, quaternion + " rpy='0 0 1'"));
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"URD015"}) << version;
    ASSERT_TRUE(read.document) << version;
    EXPECT_NEAR(skeleton_of(*read.document).joints.at(1).rest_rotation.z(), std::sin(0.5), 1e-15);
  }
  // Without the attribute, the version does not matter.
  EXPECT_EQ(
      text_of(read_robot("urdf", urdf_of_version("version='new'", "rpy='0 0 1'")).diagnostics), "");
  for (const char* bad : {"0 0 1", "0 0 0 1 0", "0 0 0 x", "0 0 0 nan", "", "0 0 -0 0"}) {
    const ReadText read = read_robot(
        "urdf", urdf_of_version("version='1.1'", "quat_xyzw='" + std::string(bad) + "'"));
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"URD003"}) << bad;
  }
}

TEST(Urdf, SdformatIsToldByContentAndByName) {
  for (const std::string text :
       {"<?xml version='1.0'?>\n<!-- a world -->\n<sdf version='1.6'>\n", "<sdf>"}) {
    for (const char* name : {"model.sdf", "model.urdf", "world"}) {
      Diagnostics diagnostics;
      const auto read = read_bytes(text, name, nullptr, {}, diagnostics);
      ASSERT_FALSE(read) << name;
      EXPECT_EQ(read.error().code, "FMT008") << name;
      EXPECT_EQ(read.error().kind, ErrorKind::InvalidInput);
    }
  }
  EXPECT_EQ(find_foreign("<other/>", "a.SDF", nullptr)->extension, ".sdf");
  EXPECT_EQ(find_foreign("<robot>", "a.sdf", detect_format("<robot>", "a.sdf")), nullptr);
}

TEST(Urdf, WhatXacroMustExpandIsTold) {
  const auto code_of = [](const std::string& text) {
    const auto codes = codes_of(read_robot("urdf", text).diagnostics);
    return codes.size() == 1 ? codes[0] : std::to_string(codes.size());
  };
  const std::string links = "<link name='A'/><link name='B'/>";
  EXPECT_EQ(code_of("<robot name='${name}'>" + links + joint("fixed", "A", "B") + "</robot>"),
            "URD014");
  EXPECT_EQ(code_of("<robot><link name='${prefix}A'/></robot>"), "URD014");
  EXPECT_EQ(code_of("<robot>" + links + joint("fixed", "A", "B", "<axis xyz='0 0 ${reflect}'/>") +
                    "</robot>"),
            "URD014");
  EXPECT_EQ(code_of("<robot><xacro:property name='a' value='1'/>" + links + "</robot>"), "URD014");
  EXPECT_EQ(code_of("<robot><link name='A'><xacro:box/></link></robot>"), "URD014");
  // What xacro leaves behind: the name space; and what is not ours to understand.
  EXPECT_EQ(
      text_of(read_robot("urdf",
                         "<robot xmlns:xacro='http://ros.org/wiki/xacro'><link name='A'><visual>"
                         "<geometry><mesh filename='${HOME}/a.stl'/></geometry></visual></link>"
                         "<gazebo reference='${a}'/></robot>")
                  .diagnostics),
      "");
}

TEST(Urdf, LimitsAreThoseOfTheTypeAndTheAxisIsXByDefault) {
  const std::string limit = "<limit lower=\"-1\" upper=\"2\" velocity=\"3\" effort=\"4\"/>";
  const Document document =
      robot_of("urdf", urdf_with("<link name=\"A\"/><link name=\"B\"/><link name=\"C\"/>" +
                                 joint("revolute", "A", "B", limit) +
                                 joint("continuous", "B", "C", limit + "<axis xyz='0 0 -1'/>")));
  const DegreeOfFreedom& b = skeleton_of(document).joints.at(1).dofs.at(0);
  EXPECT_EQ(b.axis, Vec3::UnitX());
  EXPECT_EQ(b.lower, -1);
  EXPECT_EQ(b.upper, 2);
  EXPECT_EQ(b.max_speed, 3);
  const DegreeOfFreedom& c = skeleton_of(document).joints.at(2).dofs.at(0);
  EXPECT_EQ(c.axis, -Vec3::UnitZ());
  EXPECT_EQ(c.lower, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(c.max_speed, 3);
}

std::string mimicking(const std::string& joint, const std::string& numbers) {
  return "<limit velocity=\"1\" effort=\"1\"/><mimic joint=\"to_" + joint + "\" " + numbers + "/>";
}

TEST(Urdf, AMimicJointFollowsTheOneThatItsChainEndsIn) {
  const std::string names =
      "<link name=\"A\"/><link name=\"B\"/><link name=\"C\"/><link name=\"D\"/>";
  const Document document = robot_of(
      "urdf",
      urdf_with(names + joint("revolute", "A", "B", mimicking("C", "multiplier='2' offset='0.5'")) +
                joint("revolute", "A", "C", mimicking("D", "multiplier='-3' offset='1'")) +
                joint("prismatic", "A", "D")));
  const Skeleton& skeleton = skeleton_of(document);
  EXPECT_EQ(names_of(skeleton), "A B C D");
  EXPECT_EQ(joint_columns_of(skeleton), "B.q C.q D.q");
  const DegreeOfFreedom& b = skeleton.joints[1].dofs.at(0);
  const DegreeOfFreedom& c = skeleton.joints[2].dofs.at(0);
  const DegreeOfFreedom& d = skeleton.joints[3].dofs.at(0);
  EXPECT_EQ(d.coordinate, 9u);
  EXPECT_EQ(c.coordinate, 9u);
  EXPECT_EQ(b.coordinate, 9u);
  EXPECT_TRUE(is_plain(d));
  EXPECT_EQ(c.gain, -3);
  EXPECT_EQ(c.shift, 1);
  EXPECT_EQ(b.gain, -6);
  EXPECT_EQ(b.shift, 2.5);
  EXPECT_EQ(skeleton.joints[1].joint_name, "to_B");
  const auto following = following_columns(skeleton);
  ASSERT_EQ(following.size(), 2u);
  EXPECT_EQ(following[0].column, 7u);
  EXPECT_EQ(following[0].joint, 1u);
  EXPECT_EQ(following[1].column, 8u);
  const auto columns = value_columns(skeleton);
  EXPECT_EQ(columns[1], std::optional<std::size_t>(7));
  EXPECT_EQ(columns[3], std::optional<std::size_t>(9));
  EXPECT_EQ(columns[0], std::nullopt);
  EXPECT_EQ(rest_coordinates(skeleton), (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 2.5, 1, 0}));
}

TEST(Urdf, AMimicOfAJointThatDoesNotMoveIsIgnored) {
  const ReadText read =
      read_robot("urdf", urdf_with("<link name=\"A\"/><link name=\"B\"/><link name=\"C\"/>" +
                                   joint("fixed", "A", "B", "") +
                                   joint("revolute", "A", "C", mimicking("B", ""))));
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"URD011"});
  EXPECT_EQ(skeleton_of(*read.document).joints[2].dofs.at(0).coordinate, 7u);
}

TEST(Urdf, MimicsInACircleAreRefused) {
  const ReadText read =
      read_robot("urdf", urdf_with("<link name=\"A\"/><link name=\"B\"/><link name=\"C\"/>" +
                                   joint("revolute", "A", "B", mimicking("C", "")) +
                                   joint("revolute", "A", "C", mimicking("B", ""))));
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"URD013"});
}

TEST(Urdf, AZeroByteIsNoEnd) {
  using namespace std::string_literals;
  const ReadText read = read_robot("urdf", "<robot><link name=\"A\"/></robot>\n\0<robot/>"s);
  ASSERT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"URD001"});
  EXPECT_EQ(read.diagnostics.items()[0].place.line, 2u);
}

TEST(Urdf, TooManyLinksAreRefused) {
  std::string elements = "<link name=\"J0\"/>\n";
  for (int i = 1; i <= 10'000; ++i) {
    const std::string name = "J" + std::to_string(i);
    elements += "<link name=\"" + name + "\"/>\n" + joint("fixed", "J0", name, "");
  }
  const ReadText read = read_robot("urdf", urdf_with(elements));
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"URD010"});
}

TEST(Urdf, IsKnownByItsFirstElement) {
  EXPECT_EQ(detect_format("<?xml version='1.0'?>\n<!-- <x> -->\n<robot name='a'>", "x")->name,
            "urdf");
  EXPECT_EQ(detect_format("<robots>", "x"), nullptr);
  EXPECT_EQ(format_of_name("a.urdf")->name, "urdf");
}

TEST(ExampleRobot, IsTheSameInBothFormats) {
  const Document body = robot_of("body", fixture("../../examples/robot.body"));
  const Document urdf = robot_of("urdf", fixture("../../examples/robot.urdf"));
  const Skeleton& a = skeleton_of(body);
  const Skeleton& b = skeleton_of(urdf);
  EXPECT_EQ(a.joints.size(), 19u);
  EXPECT_EQ(a.coordinates.size(), 25u);
  ASSERT_EQ(names_of(a), names_of(b));
  ASSERT_EQ(column_names(a), column_names(b));
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    for (std::size_t d = 0; d < a.joints[j].dofs.size() && j > 0; ++d) {
      EXPECT_NEAR(a.joints[j].dofs[d].lower, b.joints[j].dofs[d].lower, 1e-15);
      EXPECT_NEAR(a.joints[j].dofs[d].upper, b.joints[j].dofs[d].upper, 1e-15);
      EXPECT_NEAR(a.joints[j].dofs[d].max_speed, b.joints[j].dofs[d].max_speed, 1e-14);
    }
  }
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  std::vector<double> values;
  for (int frame = 0; frame < 20; ++frame) {
    for (std::size_t c = 0; c < a.coordinates.size(); ++c) values.push_back(angle(random));
  }
  const WorldPoses pa = poses_of(a, values);
  const WorldPoses pb = poses_of(b, values);
  for (std::size_t i = 0; i < pa.positions.size(); ++i) {
    EXPECT_NEAR(pa.positions[i], pb.positions[i], 1e-14);
  }
  for (std::size_t f = 0; f < pa.num_frames; ++f) {
    for (std::size_t j = 0; j < pa.num_joints; ++j) {
      EXPECT_LE(angle_between(rotation_in(pa, j, f), rotation_in(pb, j, f)), 1e-14);
    }
  }
}

}  // namespace
}  // namespace kinefile::test
