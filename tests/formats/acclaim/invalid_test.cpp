// SPDX-License-Identifier: MIT
// tests/formats/acclaim/invalid holds a file for every code that reading can give, and beside it
// the exact diagnostics; their skeleton is arm.asf.

#include "formats/acclaim/arm.hpp"

namespace kinefile::test {
namespace {

std::vector<std::string> all_invalid() {
  std::vector<std::string> names = fixtures("acclaim/invalid", ".asf");
  for (const std::string& name : fixtures("acclaim/invalid", ".amc")) names.push_back(name);
  return names;
}

ReadText read_acclaim_fixture(const std::string& name, bool is_strict = false) {
  ReadOptions options;
  options.source_name = base_name(name);
  options.companions = beside({{"arm.asf", fixture("acclaim/invalid/arm.asf")}});
  options.companions.list = {};
  ReadText read;
  read.diagnostics.warnings_are_errors = is_strict;
  auto document =
      find_format(name.substr(name.size() - 3))->read(fixture(name), options, read.diagnostics);
  if (document) read.document = std::move(*document);
  return read;
}

TEST(AcclaimInvalid, EveryFileHasItsExactDiagnostics) {
  const auto names = all_invalid();
  ASSERT_GT(names.size(), 40u);
  for (const std::string& name : names) {
    if (base_name(name) == "arm.asf") continue;
    const std::string expected = fixture(name.substr(0, name.size() - 3) + "txt");
    EXPECT_EQ(text_of(read_acclaim_fixture(name).diagnostics), expected) << name;
  }
}

TEST(AcclaimInvalid, EveryDiagnosticHasAPlace) {
  for (const std::string& name : all_invalid()) {
    const ReadText read = read_acclaim_fixture(name);
    EXPECT_EQ(read.document.has_value(), !read.diagnostics.has_errors()) << name;
    for (const Diagnostic& item : read.diagnostics.items()) {
      EXPECT_GT(item.place.line, 0u) << name;
      EXPECT_GT(item.place.column, 0u) << name;
    }
  }
}

TEST(AcclaimInvalid, StrictRefusesWhatIsOnlyWarnedOf) {
  for (const std::string& name : all_invalid()) {
    const bool has_warnings = read_acclaim_fixture(name).diagnostics.count(Severity::Warning) > 0;
    EXPECT_TRUE(!has_warnings || !read_acclaim_fixture(name, true).document) << name;
  }
}

TEST(AcclaimInvalid, EveryTruncationIsReadOrRefusedWithAPlace) {
  const std::string skeleton = fixture("acclaim/valid/arm.asf");
  for (std::size_t length = 0; length < skeleton.size(); ++length) {
    const ReadText read = read_acclaim("asf", skeleton.substr(0, length));
    EXPECT_TRUE(length + 2 > skeleton.size() || read.diagnostics.has_errors()) << length;
    for (const Diagnostic& item : read.diagnostics.items()) EXPECT_GT(item.place.line, 0u);
  }
  const std::string motion = fixture("acclaim/valid/arm.amc");
  for (std::size_t length = 0; length < motion.size(); ++length) {
    const ReadText read = read_acclaim("amc", motion.substr(0, length), skeleton);
    for (const Diagnostic& item : read.diagnostics.items()) EXPECT_GT(item.place.line, 0u);
  }
}

TEST(AcclaimInvalid, LenientRepairsWhatTheListOfErrorsNames) {
  const ReadOptions lenient = {.lenient = true};
  const std::string arm = fixture("acclaim/valid/arm.asf");
  const auto repaired = [&](const std::string& name) {
    ReadOptions options = lenient;
    options.companions = beside({{"arm.asf", arm}});
    return read_acclaim(name.substr(name.size() - 3), fixture("acclaim/invalid/" + name), arm,
                        options);
  };
  EXPECT_TRUE(repaired("ASF007_no_length.asf").document);
  EXPECT_TRUE(repaired("ASF014_unknown_child.asf").document);
  EXPECT_TRUE(repaired("ASF016_not_in_hierarchy.asf").document);
  EXPECT_TRUE(repaired("ASF016_in_a_circle.asf").document);
  EXPECT_TRUE(repaired("AMC005_no_such_bone.amc").document);
  EXPECT_TRUE(repaired("AMC013_bad_rate.amc").document);
  const ReadText twice = repaired("AMC010_bone_twice.amc");
  ASSERT_TRUE(twice.document);
  EXPECT_EQ(twice.motion().clip.row(0)[9], 7);
}

}  // namespace
}  // namespace kinefile::test
