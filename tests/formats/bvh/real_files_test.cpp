// SPDX-License-Identifier: MIT
// Real files: each is read, placed as a float64 reference placed it, and written bit for bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "kinefile/kinematics.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> real_files() {
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(data_folder() + "/bvh/real")) {
    const bool is_bad = entry.path().filename() == "bad.bvh";  // two words long; tested below
    if (entry.path().extension() == ".bvh" && !is_bad) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool equal_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

std::vector<double> numbers_of(const Skeleton& skeleton) {
  std::vector<double> numbers;
  const auto add = [&numbers](const Vec3& v) { numbers.insert(numbers.end(), v.begin(), v.end()); };
  for (const Joint& joint : skeleton.joints) {
    add(joint.offset);
    for (const DegreeOfFreedom& dof : joint.dofs) {
      numbers.push_back(dof.rest);
      add(dof.axis);
    }
    for (const Tip& tip : joint.tips) add(tip.offset);
  }
  return numbers;
}

std::vector<std::string> words_of(const Skeleton& skeleton) {
  std::vector<std::string> words = column_names(skeleton);
  for (const Joint& joint : skeleton.joints) {
    words.push_back(joint.name + " on " + std::to_string(joint.parent));
    for (const Tip& tip : joint.tips) words.push_back("tip " + tip.name);
  }
  return words;
}

TEST(BvhRealFiles, RoundTripBitForBit) {
  SKIP_WITHOUT_DATA();
  const auto paths = real_files();
  EXPECT_GE(paths.size(), 35u);
  for (const std::string& path : paths) {
    const ReadText first = read_bvh(bytes_of(path));
    ASSERT_TRUE(first.document) << path << "\n" << text_of(first.diagnostics);
    const std::string written = write_to_string(*first.document);
    const ReadText second = read_bvh(written);
    EXPECT_EQ(second.diagnostics.count(Severity::Warning), 0u) << path;
    const Motion& a = first.motion();
    const Motion& b = second.motion();
    EXPECT_TRUE(equal_bits(a.clip.values, b.clip.values)) << path;
    EXPECT_TRUE(equal_bits(numbers_of(a.skeleton), numbers_of(b.skeleton))) << path;
    EXPECT_EQ(words_of(a.skeleton), words_of(b.skeleton)) << path;
    EXPECT_EQ(a.clip.timeline, b.clip.timeline) << path;
    EXPECT_EQ(write_to_string(*second.document), written) << path;
  }
}

TEST(BvhRealFiles, TheFileOfTwoWordsIsALocatedError) {
  SKIP_WITHOUT_DATA();
  const ReadText read = read_bvh(bytes_of(data_folder() + "/bvh/real/gophics+ravenporter/bad.bvh"));
  EXPECT_EQ(text_of(read.diagnostics),
            "t.bvh:2:5: error[BVH002]: expected a name after ROOT, found the end of the file\n"
            "  ROOT\n"
            "      ^\n");
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

/// The place of a column's joint among the positions: joints, and End Sites as EndSite_PARENT.
struct Point {
  std::size_t index = 0;
  bool is_tip = false;
};

std::map<std::string, Point> points_of(const Skeleton& skeleton) {
  std::map<std::string, Point> points;
  std::size_t tip = 0;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    points[skeleton.joints[j].name] = {j, false};
    for (std::size_t t = 0; t < skeleton.joints[j].tips.size(); ++t) {
      points["EndSite_" + skeleton.joints[j].name] = {tip++, true};
    }
  }
  return points;
}

/// Compares world positions with a table `frame,JOINT.x,JOINT.y,JOINT.z,...`; returns how many
/// numbers were compared.
std::size_t compare_with_table(const Motion& motion, const std::string& table) {
  std::istringstream text(bytes_of(table));
  std::string line;
  std::getline(text, line);
  const auto header = fields_of(line);
  const auto points = points_of(motion.skeleton);
  const WorldPoses poses = forward_kinematics(motion.skeleton, motion.clip, {.tips = true});
  std::size_t num_compared = 0;
  while (std::getline(text, line)) {
    const auto fields = fields_of(line);
    const std::size_t frame = std::stoul(fields[0]);
    for (std::size_t c = 1; c < fields.size(); ++c) {
      const std::string joint = header[c].substr(0, header[c].size() - 2);
      const std::size_t axis = static_cast<std::size_t>(header[c].back() - 'x');
      const auto found = points.find(joint);
      EXPECT_NE(found, points.end()) << joint;
      if (found == points.end()) continue;
      const Point& point = found->second;
      // Relative to how far the point is from the origin; its components may be next to zero.
      const std::size_t first = 1 + (c - 1) / 3 * 3;
      const double size = std::hypot(std::stod(fields[first]), std::stod(fields[first + 1]),
                                     std::stod(fields[first + 2]));
      const double ours =
          point.is_tip ? poses.tips[(frame * poses.num_tips + point.index) * 3 + axis]
                       : poses.positions[(frame * poses.num_joints + point.index) * 3 + axis];
      EXPECT_NEAR(ours, std::stod(fields[c]), 1e-9 * size) << table << " " << line.substr(0, 9);
      ++num_compared;
    }
  }
  return num_compared;
}

TEST(BvhRealFiles, PositionsAgreeWithTheReference) {
  SKIP_WITHOUT_DATA();
  const std::string folder = data_folder() + "/bvh/";
  std::size_t num_tables = 0;
  for (const auto& entry : fs::directory_iterator(folder + "golden/real")) {
    // OWNER+REPOSITORY.FILE.csv
    std::string name = entry.path().stem();
    const std::size_t dot = name.find('.');
    const std::string path =
        folder + "real/" + name.substr(0, dot) + "/" + name.substr(dot + 1) + ".bvh";
    const ReadText read = read_bvh(bytes_of(path));
    EXPECT_GT(compare_with_table(read.motion(), entry.path()), 0u) << path;
    ++num_tables;
  }
  EXPECT_EQ(num_tables, 35u);
  const ReadText example = read_bvh(bytes_of(folder + "real/Wasserwecken+bvhio/example.bvh"));
  EXPECT_GT(compare_with_table(example.motion(), folder + "golden/example_ref_f64.csv"), 0u);
}

}  // namespace
}  // namespace kinefile::test
