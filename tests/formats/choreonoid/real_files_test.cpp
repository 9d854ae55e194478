// SPDX-License-Identifier: MIT
// Real motions: what Choreonoid ships and writes.

#include <algorithm>
#include <filesystem>

#include "kinefile/choreonoid.hpp"
#include "support/seq.hpp"

namespace kinefile::test {
namespace {

std::string folder() { return data_folder() + "/choreonoid"; }

std::vector<std::string> files_of(const std::vector<std::string>& folders) {
  std::vector<std::string> paths;
  for (const std::string& name : folders) {
    for (const auto& entry : std::filesystem::directory_iterator(folder() + "/" + name)) {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(SeqRealFiles, WhatChoreonoidWritesAsVersion4IsWrittenByteForByte) {
  SKIP_WITHOUT_DATA();
  const std::string text = bytes_of(folder() + "/writer/cnoid2.5_v4.seq");
  const ReadText read = read_seq(text);
  EXPECT_EQ(text_of(read.diagnostics), "");
  ASSERT_TRUE(read.document);
  const WriteOptions options = {
      .of_formats = choreonoid::WriteOptions{.version = 4, .choreonoid_digits = true}};
  EXPECT_EQ(write_to_string(*read.document, "choreonoid", options), text);
}

TEST(SeqRealFiles, EveryVersionOfItsWriterBecomesTheSameVersion4) {
  SKIP_WITHOUT_DATA();
  const WriteOptions options = {
      .of_formats = choreonoid::WriteOptions{.version = 4, .choreonoid_digits = true}};
  for (const char* version : {"2.5_v1", "2.5_v2", "2.5_v3", "1.7_v1", "1.7_v2", "1.7_v3"}) {
    const ReadText read = read_seq(bytes_of(folder() + "/writer/cnoid" + version + ".seq"));
    ASSERT_TRUE(read.document) << version;
    EXPECT_EQ(write_to_string(*read.document, "choreonoid", options),
              bytes_of(folder() + "/writer/cnoid2.5_v4.seq"))
        << version;
  }
}

TEST(SeqRealFiles, MotionsAreReadWrittenAndReadAgainBitForBitAsJsonToo) {
  SKIP_WITHOUT_DATA();
  const auto paths = files_of({"motion", "motion_v1", "made"});
  ASSERT_GE(paths.size(), 10u);
  for (const std::string& path : paths) {
    const ReadText read = read_seq(bytes_of(path));
    EXPECT_FALSE(read.diagnostics.has_errors()) << path;
    const auto& components = components_of(read);
    ASSERT_FALSE(components.empty()) << path;
    for (const choreonoid::YamlStyle style :
         {choreonoid::YamlStyle::Kept, choreonoid::YamlStyle::Json}) {
      const std::string text = write_to_string(
          *read.document, "choreonoid", {.of_formats = choreonoid::WriteOptions{.style = style}});
      const ReadText again = read_seq(text);
      expect_same_components(components_of(again), components, path);
      for (const char* key : {"version", "keys", "unknown_keys"}) {
        EXPECT_EQ(fact_of(*again.document, key), fact_of(*read.document, key)) << path << key;
      }
      EXPECT_EQ(write_to_string(*again.document, "choreonoid"), text) << path;
    }
  }
}

}  // namespace
}  // namespace kinefile::test
