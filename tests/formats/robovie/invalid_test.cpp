// SPDX-License-Identifier: MIT
// tests/formats/robovie/invalid holds a file for every code that reading can give, and beside it
// the exact diagnostics.

#include "formats/robovie/robovie.hpp"

namespace kinefile::test {
namespace {

ReadText read_robovie_fixture(const std::string& name, ReadOptions options = {}) {
  options.source_name = name.substr(name.find_last_of('/') + 1);
  return read_robovie(fixture(name), options);
}

TEST(RobovieInvalid, EveryFileHasItsExactDiagnostics) {
  const auto names = fixtures("robovie/invalid", ".motion");
  ASSERT_GT(names.size(), 60u);
  for (const std::string& name : names) {
    const std::string expected = fixture(name.substr(0, name.size() - 6) + "txt");
    EXPECT_EQ(text_of(read_robovie_fixture(name).diagnostics), expected) << name;
  }
}

TEST(RobovieInvalid, EveryDiagnosticHasAPlace) {
  for (const std::string& name : fixtures("robovie/invalid", ".motion")) {
    const ReadText read = read_robovie_fixture(name);
    EXPECT_GT(read.diagnostics.items().size(), 0u) << name;
    for (const Diagnostic& item : read.diagnostics.items()) {
      EXPECT_GT(item.place.line, 0u) << name;
      EXPECT_GT(item.place.column, 0u) << name;
    }
  }
}

TEST(RobovieInvalid, AFileThatIsRepairedReadsWithAWarning) {
  const ReadOptions lenient = {.lenient = true};
  for (const auto& [name, ticks] : {std::pair("zero_time", 1), std::pair("long_time", 239)}) {
    const ReadText read =
        read_robovie_fixture(std::string("robovie/invalid/") + name + ".motion", lenient);
    EXPECT_EQ(read.diagnostics.count_of("RBV016", Severity::Warning), 1u);
    EXPECT_EQ(std::get<PoseBlock>(flow_of(read).blocks.at(1).body).ticks, ticks);
  }
  const ReadText sound = read_robovie_fixture("robovie/invalid/single_sound.motion", lenient);
  EXPECT_EQ(sound.diagnostics.count_of("RBV007", Severity::Warning), 1u);
  EXPECT_EQ(std::get<PoseBlock>(flow_of(sound).blocks.at(1).body).sound, "");
  const ReadText name = read_robovie_fixture("robovie/invalid/single_name.motion", lenient);
  EXPECT_EQ(flow_of(name).blocks.at(1).name, "");
}

TEST(RobovieInvalid, BytesThatAreNoCharactersArePutByAMarkWhereThatIsAskedFor) {
  const std::string name = "robovie/invalid/not_cp932.motion";
  EXPECT_FALSE(read_robovie_fixture(name).document);
  const ReadText read = read_robovie_fixture(name, {.lenient = true});
  EXPECT_NE(flow_of(read).blocks.at(1).name.find("\uFFFD"), std::string::npos);
}

TEST(RobovieInvalid, StrictRefusesWhatIsOnlyWarnedOf) {
  for (const std::string& name : fixtures("robovie/invalid", ".motion")) {
    Diagnostics diagnostics;
    diagnostics.warnings_are_errors = true;
    EXPECT_FALSE(find_format("robovie")->read(fixture(name), {}, diagnostics)) << name;
  }
}

}  // namespace
}  // namespace kinefile::test
