// SPDX-License-Identifier: MIT
// A robot's real motion and project, and motions that were made like them.

#include <filesystem>

#include "formats/robovie/robovie.hpp"
#include "kinefile/io.hpp"

namespace kinefile::test {
namespace {

std::string robovie_folder() { return data_folder() + "/robovie"; }

std::vector<std::string> motions() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(robovie_folder())) {
    if (entry.path().extension() == ".txt") paths.push_back(entry.path().string());
  }
  return paths;
}

TEST(RobovieRealFiles, ComeBackByteForByte) {
  SKIP_WITHOUT_DATA();
  ASSERT_GE(motions().size(), 4u);
  for (const std::string& path : motions()) {
    Diagnostics diagnostics;
    const auto document = read_file(path, nullptr, {}, diagnostics);
    ASSERT_TRUE(document) << text_of(diagnostics);
    EXPECT_EQ(text_of(diagnostics), "");
    EXPECT_EQ(document->format, "robovie");
    EXPECT_EQ(write_to_string(*document, "robovie"), bytes_of(path)) << path;
  }
}

TEST(RobovieRealFiles, TheProjectAndItsMotionFitEachOther) {
  SKIP_WITHOUT_DATA();
  const std::string folder = robovie_folder() + "/vsrc2premaidai";
  Diagnostics diagnostics;
  const auto project = read_project_file(folder + "/ai.rpj", {}, diagnostics);
  ASSERT_TRUE(project) << text_of(diagnostics);
  EXPECT_EQ(text_of(diagnostics), "");
  EXPECT_EQ(project->name, "ai");
  EXPECT_EQ(project->tick_seconds, 1.0 / 60);
  ASSERT_EQ(project->sliders.size(), 62u);
  EXPECT_EQ(project->sliders[0].name, "l_shy_joint");
  EXPECT_EQ(project->sliders[0].units_per_degree, 182.0417);
  EXPECT_EQ(project->sliders[0].partner, 5);
  EXPECT_TRUE(project->sliders[25].is_disabled);
  EXPECT_TRUE(project->sliders[30].jumps);
  EXPECT_FALSE(project->sliders[31].jumps);
  EXPECT_EQ(project->servos.size(), 30u);
  EXPECT_EQ(project->sounds.size(), 256u);
  EXPECT_EQ(base_values(*project), std::vector<std::int16_t>(62));

  ReadOptions options;
  options.project = std::make_shared<const RobotProject>(*project);
  for (const std::string& path : motions()) {
    if (path.find("vsrc2premaidai") == std::string::npos) continue;
    Diagnostics own;
    EXPECT_TRUE(read_file(path, nullptr, options, own));
    EXPECT_EQ(text_of(own), "");
  }
}

}  // namespace
}  // namespace kinefile::test
