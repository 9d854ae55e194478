// SPDX-License-Identifier: MIT
// tests/formats/{body,urdf,wrl}/invalid hold a file for every code that reading can give, and
// beside it the exact diagnostics.

#include "formats/robots/robots.hpp"

namespace kinefile::test {
namespace {

constexpr const char* kFormats[] = {"body", "urdf", "wrl"};

std::vector<std::pair<std::string, std::string>> invalid_robots() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const std::string format : kFormats) {
    for (const std::string& name : fixtures(format + "/invalid", "." + format)) {
      all.emplace_back(format, name);
    }
  }
  return all;
}

ReadText read_robot_fixture(const std::string& format, const std::string& name,
                            bool is_strict = false) {
  ReadOptions options;
  options.source_name = base_name(name);
  const std::string own = fixture(name);
  options.companions = files_of(
      {{base_name(name), own},
       {"part.body", "format: ChoreonoidBody\nformat_version: 2\nlinks: [ { name: P } ]\n"},
       {"wraps_urdf.body", "modelFile: part.wrl\n"},
       {"walk.bvh", bvh_with_rows({"1 2 3 4 5 6 7 8 9"})}});
  ReadText read;
  read.diagnostics.warnings_are_errors = is_strict;
  auto document = find_format(format)->read(own, options, read.diagnostics);
  if (document) read.document = std::move(*document);
  return read;
}

TEST(RobotInvalid, EveryFileHasItsExactDiagnostics) {
  ASSERT_GT(invalid_robots().size(), 60u);
  for (const auto& [format, name] : invalid_robots()) {
    const std::string expected = fixture(name.substr(0, name.size() - format.size()) + "txt");
    EXPECT_EQ(text_of(read_robot_fixture(format, name).diagnostics), expected) << name;
  }
}

TEST(RobotInvalid, EveryDiagnosticHasAPlaceAndWhatReadsIsValid) {
  for (const auto& [format, name] : invalid_robots()) {
    const ReadText read = read_robot_fixture(format, name);
    EXPECT_EQ(read.document.has_value(), !read.diagnostics.has_errors()) << name;
    EXPECT_FALSE(read.diagnostics.items().empty()) << name;
    for (const Diagnostic& item : read.diagnostics.items()) {
      EXPECT_GT(item.place.line, 0u) << name;
      EXPECT_GT(item.place.column, 0u) << name;
    }
    EXPECT_TRUE(!read.document || validate(skeleton_of(*read.document))) << name;
  }
}

TEST(RobotInvalid, StrictRefusesWhatIsOnlyWarnedOf) {
  for (const auto& [format, name] : invalid_robots()) {
    const bool has_warnings =
        read_robot_fixture(format, name).diagnostics.count(Severity::Warning) > 0;
    EXPECT_TRUE(!has_warnings || !read_robot_fixture(format, name, true).document) << name;
  }
}

TEST(RobotInvalid, EveryTruncationIsReadOrRefusedWithAPlace) {
  for (const std::string format : kFormats) {
    const std::string text =
        format == "wrl" ? fixture("wrl/valid/arm.wrl") : fixture("../../examples/robot." + format);
    for (std::size_t length = 0; length < text.size(); length += format == "wrl" ? 1 : 7) {
      const ReadText read = read_robot(format, text.substr(0, length));
      EXPECT_EQ(read.document.has_value(), !read.diagnostics.has_errors()) << format << length;
      for (const Diagnostic& item : read.diagnostics.items()) EXPECT_GT(item.place.line, 0u);
    }
  }
}

}  // namespace
}  // namespace kinefile::test
