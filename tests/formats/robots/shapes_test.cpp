// SPDX-License-Identifier: MIT
// The shapes that links show: what kind, how large, where and in which colour.

#include <algorithm>
#include <cmath>

#include "formats/robots/robots.hpp"

namespace kinefile::test {
namespace {

std::string link_of_body(const std::string& elements) {
  return "format: ChoreonoidBody\nformat_version: 2.0\nlinks:\n  -\n    name: A\n    elements:\n" +
         elements;
}

std::string link_of_urdf(const std::string& visuals, const std::string& materials = "") {
  return "<robot name='t' version='1.1'>" + materials + "<link name='A'>" + visuals +
         "</link></robot>";
}

std::string joint_of_wrl(const std::string& children, const std::string& before = "") {
  return "#VRML V2.0 utf8\n" + before +
         "DEF T Humanoid { humanoidBody DEF A Joint { jointType \"free\" children [ " + children +
         " ] } }";
}

/// The shapes of the root of a robot that must read without a word.
std::vector<VisualShape> shapes_in(const std::string& format, const std::string& text) {
  const Document document = robot_of(format, text);
  return skeleton_of(document).joints.at(0).visuals;
}

/// The only shape of the root.
VisualShape shape_in(const std::string& format, const std::string& text) {
  const auto shapes = shapes_in(format, text);
  EXPECT_EQ(shapes.size(), 1u) << text;
  return shapes.empty() ? VisualShape{} : shapes[0];
}

/// The codes of a text that must read, and the number of shapes of its root.
std::string warned(const std::string& format, const std::string& text) {
  const ReadText read = read_robot(format, text);
  EXPECT_TRUE(read.document) << text_of(read.diagnostics);
  if (!read.document) return {};
  std::string told =
      std::to_string(skeleton_of(*read.document).joints.at(0).visuals.size()) + " shapes";
  for (const std::string& code : codes_of(read.diagnostics)) told += " " + code;
  return told;
}

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LE((a - b).norm(), 1e-14) << a << b; }

TEST(RobotShapes, OfEveryKindHaveTheirFullExtents) {
  const auto shapes = shapes_in(
      "body",
      link_of_body("      - { type: Shape, geometry: { type: Box, size: [ 1, 2, 3 ] } }\n"
                   "      - { type: Shape, geometry: { type: Sphere, radius: 2 } }\n"
                   "      - { type: Shape, geometry: { type: Cylinder, radius: 2, height: 5 } }\n"
                   "      - { type: Shape, geometry: { type: Cone, radius: 2, height: 5 } }\n"
                   "      - { type: Shape, geometry: { type: Capsule, radius: 2, height: 5 } }\n"));
  ASSERT_EQ(shapes.size(), 5u);
  constexpr ShapeKind kKinds[] = {ShapeKind::Box, ShapeKind::Sphere, ShapeKind::Cylinder,
                                  ShapeKind::Cone, ShapeKind::Capsule};
  const Vec3 sizes[] = {{1, 2, 3}, {4, 4, 4}, {4, 4, 5}, {4, 4, 5}, {4, 4, 9}};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(shapes[i].kind, kKinds[i]);
    EXPECT_EQ(shapes[i].size, sizes[i]);
    EXPECT_EQ(shapes[i].position, Vec3(Vec3::Zero()));
    EXPECT_EQ(shapes[i].colour, std::nullopt);
    // Choreonoid's shapes are along y; boxes and spheres are not turned.
    expect_near(shapes[i].rotation * Vec3::UnitZ(), i < 2 ? Vec3::UnitZ() : Vec3::UnitY());
    expect_near(shapes[i].rotation * Vec3::UnitX(), Vec3::UnitX());
  }
}

TEST(RobotShapes, OfABodyAreNestedInTransforms) {
  const VisualShape shape = shape_in(
      "body",
      link_of_body("      Transform:\n"
                   "        translation: [ 1, 2, 3 ]\n"
                   "        rotation: [ 0, 0, 1, 90 ]\n"
                   "        elements:\n"
                   "          - type: Group\n"
                   "            translation: [ 9, 9, 9 ]\n"
                   "            elements:\n"
                   "              Shape:\n"
                   "                translation: [ 1, 0, 0 ]\n"
                   "                scale: [ 2, 1, 1 ]\n"
                   "                appearance: { material: { diffuse: [ 0.1, 0.2, 1 ] } }\n"
                   "                geometry: { type: Box, size: [ 1, 2, 3 ] }\n"));
  expect_near(shape.position, {1, 3, 3});
  EXPECT_LE((shape.size - Vec3(2, 2, 3)).norm(), 1e-14);
  expect_near(shape.rotation * Vec3::UnitX(), Vec3::UnitY());
  EXPECT_EQ(shape.colour, std::optional(Vec3(0.1, 0.2, 1)));
}

TEST(RobotShapes, OfABodyAreThoseOutsideOfCollisions) {
  const std::string box = "{ geometry: { type: Box, size: [ 1, 1, 1 ] } }";
  const std::string ball = "{ geometry: { type: Sphere, radius: 1 } }";
  EXPECT_EQ(shape_in("body", link_of_body("      Visual: { translation: [ 0, 0, 1 ], shape: " +
                                          box + " }\n      Collision: { shape: " + ball + " }\n"))
                .position,
            Vec3(0, 0, 1));
  EXPECT_EQ(shape_in("body", link_of_body("      - { type: Collision, elements: { Shape: " + ball +
                                          " } }\n      - { type: Visual, elements: { Shape: " +
                                          box + " } }\n"))
                .kind,
            ShapeKind::Box);
  EXPECT_EQ(shapes_in("body", link_of_body("      Collision: { shape: " + ball + " }\n")).size(),
            0u);
  // A device has a place and elements, too; a file of its own, lights and meshes show nothing here.
  EXPECT_EQ(shape_in("body", link_of_body("      Camera: { translation: [ 0, 1, 0 ], elements: { "
                                          "Shape: " +
                                          box + " } }\n"))
                .position,
            Vec3(0, 1, 0));
  EXPECT_EQ(warned("body", link_of_body("      - { type: Resource, uri: x.wrl }\n"
                                        "      - { type: Skip, elements: { Shape: " +
                                        box +
                                        " } }\n      - { type: Shape, geometry: { type: "
                                        "IndexedFaceSet } }\n      - { type: Shape }\n")),
            "0 shapes");
}

TEST(RobotShapes, UnderAScaleThatShearsAreLeftOutExceptSpheres) {
  const auto sheared = [](const std::string& geometry) {
    return link_of_body(
        "      Transform: { scale: [ 1, 3, 1 ], elements: { Transform: { rotation: "
        "[ 0, 0, 1, 30 ], elements: { Shape: { geometry: " +
        geometry + " } } } } }\n");
  };
  EXPECT_EQ(warned("body", sheared("{ type: Box, size: [ 1, 1, 1 ] }")), "0 shapes");
  const VisualShape ball = shape_in("body", sheared("{ type: Sphere, radius: 1 }"));
  Vec3 size = ball.size;
  std::sort(size.begin(), size.end());
  expect_near(size, {2, 2, 6});
  Eigen::Index longest = 0;
  ball.size.maxCoeff(&longest);
  EXPECT_NEAR(std::abs((ball.rotation * Vec3(Vec3::Unit(longest))).y()), 1, 1e-12);
  // A scale in the mirror is the same shape.
  const VisualShape cone = shape_in(
      "body", link_of_body("      Shape: { scale: [ 1, -1, 1 ], geometry: { type: Cone, radius: 1, "
                           "height: 2 } }\n"));
  expect_near(cone.rotation * Vec3::UnitZ(), -Vec3::UnitY());
  expect_near(cone.size, {2, 2, 2});
}

TEST(RobotShapes, OfEveryShoeOfATrackAndOfPartsAreTheSame) {
  const std::string track =
      "format: ChoreonoidBody\nformat_version: 2.0\nlinks:\n  - { name: A }\n"
      "  - { type: ContinuousTrack, name: T, parent: A, num_joints: 3, joint_offset: [ 1, 0, 0 ], "
      "elements: { Shape: { geometry: { type: Sphere, radius: 1 } } } }\n";
  const Document document = robot_of("body", track);
  for (std::size_t j = 1; j < 4; ++j) {
    EXPECT_EQ(skeleton_of(document).joints.at(j).visuals.size(), 1u) << j;
  }
  ReadOptions options;
  options.companions = files_of({{"part.body", link_of_body("      Shape: { geometry: { type: "
                                                            "Sphere, radius: 1 } }\n")}});
  const Document whole =
      robot_of("body",
               "format: ChoreonoidBody\nformat_version: 2.0\nlinks:\n"
               "  - { name: R }\n  - { type: SubBody, uri: part.body, parent: R, "
               "translation: [ 0, 0, 1 ] }\n",
               options);
  ASSERT_EQ(skeleton_of(whole).joints.size(), 2u);
  ASSERT_EQ(skeleton_of(whole).joints[1].visuals.size(), 1u);
  EXPECT_EQ(skeleton_of(whole).joints[1].visuals[0].position, Vec3(Vec3::Zero()));
}

TEST(RobotShapes, OfUrdfAreAlongZAtTheirOrigins) {
  const std::string origin = "<origin xyz='1 2 3' rpy='1.5707963267948966 0 0'/>";
  const auto shapes = shapes_in(
      "urdf", link_of_urdf("<visual>" + origin +
                           "<geometry><box size='1 2 3'/></geometry></visual>"
                           "<visual><geometry><cylinder radius='2' length='5'/></geometry></visual>"
                           "<visual><geometry><sphere radius='2'/></geometry></visual>"
                           "<visual><origin quat_xyzw='1 0 0 0'/><geometry><capsule radius='2' "
                           "length='5'/></geometry></visual>"
                           "<visual><geometry><mesh filename='a.stl'/></geometry></visual>"
                           "<collision><geometry><sphere radius='9'/></geometry></collision>"));
  ASSERT_EQ(shapes.size(), 4u);
  EXPECT_EQ(shapes[0].kind, ShapeKind::Box);
  EXPECT_EQ(shapes[0].position, Vec3(1, 2, 3));
  EXPECT_LE((shapes[0].size - Vec3(1, 2, 3)).norm(), 1e-14);
  expect_near(shapes[0].rotation * Vec3::UnitY(), Vec3::UnitZ());
  EXPECT_EQ(shapes[1].size, Vec3(4, 4, 5));
  EXPECT_EQ(shapes[1].rotation.coeffs(), Quat::Identity().coeffs());
  EXPECT_EQ(shapes[2].size, Vec3(4, 4, 4));
  EXPECT_EQ(shapes[3].kind, ShapeKind::Capsule);
  EXPECT_EQ(shapes[3].size, Vec3(4, 4, 9));
  expect_near(shapes[3].rotation * Vec3::UnitZ(), -Vec3::UnitZ());
  EXPECT_EQ(shapes_in("urdf", link_of_urdf("<collision><geometry><sphere radius='9'/></geometry>"
                                           "</collision>"))
                .size(),
            0u);
}

TEST(RobotShapes, OfUrdfHaveTheColoursOfTheirMaterials) {
  const auto ball = [](const std::string& material) {
    return "<visual><geometry><sphere radius='2'/></geometry>" + material + "</visual>";
  };
  const auto shapes = shapes_in(
      "urdf", link_of_urdf(ball("<material name='red'/>") +
                               ball("<material name=''><color rgba='0 1 0 0.5'/></material>") +
                               ball("<material name='blue'><color rgba='0 0 1 1'/></material>") +
                               ball("<material name='blue'/>") + ball("<material name='none'/>") +
                               ball("<material name='red'><color rgba='1 1 1 1'/></material>"),
                           "<material name='red'><color rgba='1 0 0 1'/></material>"));
  ASSERT_EQ(shapes.size(), 6u);
  EXPECT_EQ(shapes[0].colour, std::optional(Vec3(1, 0, 0)));
  EXPECT_EQ(shapes[1].colour, std::optional(Vec3(0, 1, 0)));
  EXPECT_EQ(shapes[2].colour, std::optional(Vec3(0, 0, 1)));
  EXPECT_EQ(shapes[3].colour, std::optional(Vec3(0, 0, 1)));
  EXPECT_EQ(shapes[4].colour, std::nullopt);
  EXPECT_EQ(shapes[5].colour, std::optional(Vec3(1, 0, 0)));
}

TEST(RobotShapes, OfWrlHaveTheDefaultsOfVrmlAndAreAlongY) {
  const auto shapes = shapes_in(
      "wrl", joint_of_wrl("Segment { children [ Shape { geometry Box { } } Shape { geometry Sphere "
                          "{ } } Shape { geometry Cylinder { } } Shape { geometry Cone { "
                          "bottomRadius 3 height 4 side FALSE } } Shape { geometry IndexedFaceSet "
                          "{ coord Coordinate { point [ 0 0 0 ] } } } ] }"));
  ASSERT_EQ(shapes.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(shapes[i].size, Vec3(2, 2, 2));
  EXPECT_EQ(shapes[3].kind, ShapeKind::Cone);
  EXPECT_EQ(shapes[3].size, Vec3(6, 6, 4));
  expect_near(shapes[3].rotation * Vec3::UnitZ(), Vec3::UnitY());
  EXPECT_EQ(shapes[0].colour, std::nullopt);
}

TEST(RobotShapes, OfWrlAreNestedInTransforms) {
  const VisualShape shape = shape_in(
      "wrl", joint_of_wrl(
                 "Segment { children Transform { children [ Transform { translation 1 0 0 scale 2 "
                 "2 2 children Shape { appearance Appearance { material Material { diffuseColor "
                 "0.1 0.2 1 transparency 0.5 } } geometry Box { size 1 2 3 } } } ] "
                 "rotation 0 0 1 1.5707963267948966 center 1 0 0 translation 0 0 5 } }"));
  // (1 0 0) is the center of the quarter turn, so it stays.
  expect_near(shape.position, {1, 0, 5});
  expect_near(shape.size, {2, 4, 6});
  expect_near(shape.rotation * Vec3::UnitX(), Vec3::UnitY());
  EXPECT_EQ(shape.colour, std::optional(Vec3(0.1, 0.2, 1)));
}

TEST(RobotShapes, OfWrlMayHaveNamesAndBeUsedAgain) {
  const auto shapes = shapes_in(
      "wrl", joint_of_wrl(
                 "DEF S Segment { children [ DEF B Shape { appearance DEF LOOK Appearance { "
                 "material DEF M Material { diffuseColor 1 0 0 } } geometry DEF G Box { } } ] } "
                 "USE S Transform { translation 0 0 1 children [ USE B Shape { appearance USE LOOK "
                 "geometry USE G } Shape { appearance Appearance { material USE M } geometry "
                 "Sphere { } } Shape { geometry USE NOTHING } ] } DEF H Group { children USE B } "
                 "Transform { translation 0 0 2 children USE H } USE NOTHING"));
  ASSERT_EQ(shapes.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(shapes[i].colour, std::optional(Vec3(1, 0, 0))) << i;
    EXPECT_EQ(shapes[i].kind, i == 4 ? ShapeKind::Sphere : ShapeKind::Box) << i;
    EXPECT_EQ(shapes[i].position.z(), i == 6 ? 2 : i >= 2 && i <= 4 ? 1 : 0) << i;
  }
}

TEST(RobotShapes, OfASegmentBelongToTheJointAboveIt) {
  const Document document = robot_of(
      "wrl",
      joint_of_wrl("Shape { geometry Box { } } DEF B Joint { jointType \"fixed\" translation "
                   "0 0 1 children [ Group { children [ Segment { children Shape { geometry "
                   "Cone { } } } VisionSensor { translation 1 0 0 children Shape { geometry "
                   "Sphere { } } } ] } ] }"));
  const Skeleton& skeleton = skeleton_of(document);
  ASSERT_EQ(skeleton.joints.size(), 2u);
  ASSERT_EQ(skeleton.joints[0].visuals.size(), 1u);
  EXPECT_EQ(skeleton.joints[0].visuals[0].kind, ShapeKind::Box);
  ASSERT_EQ(skeleton.joints[1].visuals.size(), 2u);
  EXPECT_EQ(skeleton.joints[1].visuals[0].kind, ShapeKind::Cone);
  EXPECT_EQ(skeleton.joints[1].visuals[1].position, Vec3(1, 0, 0));
}

TEST(RobotShapes, InNodesThatCannotBeReadAreLeftOutAndTheRobotIsRead) {
  EXPECT_EQ(warned("wrl", joint_of_wrl("Segment { children [ Shape { geometry Box { } } 5 ] }")),
            "0 shapes WRL016");
  EXPECT_EQ(warned("wrl", joint_of_wrl("Segment { children [ Shape { geometry Box { size 1 2 } } "
                                       "Shape { geometry Box { } } ] }")),
            "1 shapes WRL016");
  std::string deep;
  for (int i = 0; i < 300; ++i) deep += "Group { children ";
  deep += "Shape { geometry Box { } }" + std::string(300, '}');
  EXPECT_EQ(warned("wrl", joint_of_wrl("Segment { children " + deep + " }")), "0 shapes WRL016");
  std::string elements = "{ type: Shape, geometry: { type: Sphere, radius: 1 } }";
  for (int i = 0; i < 120; ++i) elements = "{ type: Group, elements: " + elements + " }";
  EXPECT_EQ(warned("body", link_of_body("      " + elements + "\n")), "0 shapes BDY018");
}

TEST(RobotShapes, AreAHundredThousandAtMost) {
  // Each name has twice the shapes of the one before.
  std::string doubled = "DEF N0 Segment { children Shape { geometry Box { } } }";
  for (int i = 1; i <= 40; ++i) {
    const std::string before = "USE N" + std::to_string(i - 1);
    doubled +=
        " DEF N" + std::to_string(i) + " Segment { children [ " + before + " " + before + " ] }";
  }
  const ReadText read = read_robot("wrl", joint_of_wrl(doubled));
  ASSERT_TRUE(read.document);
  EXPECT_LE(skeleton_of(*read.document).joints[0].visuals.size(), 100'000u);
  EXPECT_EQ(codes_of(read.diagnostics).at(0), "WRL016");
  // Many links with the shapes that one file describes.
  std::string part = "      - { type: Shape, geometry: { type: Sphere, radius: 1 } }\n";
  for (int i = 0; i < 9; ++i) part += part;
  std::string whole = "format: ChoreonoidBody\nformat_version: 2.0\nlinks:\n  - { name: R }\n";
  for (int i = 0; i < 300; ++i) {
    whole +=
        "  - { type: SubBody, uri: part.body, parent: R, prefix: P" + std::to_string(i) + " }\n";
  }
  ReadOptions options;
  options.companions = files_of({{"part.body", link_of_body(part)}});
  const ReadText many = read_robot("body", whole, options);
  ASSERT_TRUE(many.document);
  std::size_t count = 0;
  for (const Joint& joint : skeleton_of(*many.document).joints) count += joint.visuals.size();
  EXPECT_EQ(count, 100'000u);
  EXPECT_EQ(codes_of(many.diagnostics), std::vector<std::string>{"BDY018"});
}

}  // namespace
}  // namespace kinefile::test
