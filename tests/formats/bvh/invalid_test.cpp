// SPDX-License-Identifier: MIT
// tests/formats/bvh/invalid holds a file for every code that reading can give, and beside it the
// exact diagnostics; tests/formats/bvh/valid holds files that read without any.

#include <gtest/gtest.h>

#include "support/support.hpp"

namespace kinefile::test {
namespace {

TEST(BvhInvalid, EveryFileHasItsExactDiagnostics) {
  const auto names = fixtures("bvh/invalid", ".bvh");
  ASSERT_GT(names.size(), 20u);
  for (const std::string& name : names) {
    ReadOptions options;
    options.source_name = base_name(name);
    const ReadText read = read_bvh(fixture(name), options);
    const std::string expected = fixture(name.substr(0, name.size() - 3) + "txt");
    EXPECT_EQ(text_of(read.diagnostics), expected) << name;
  }
}

TEST(BvhInvalid, EveryErrorHasAPlace) {
  for (const std::string& name : fixtures("bvh/invalid", ".bvh")) {
    const ReadText read = read_bvh(fixture(name));
    EXPECT_EQ(read.document.has_value(), !read.diagnostics.has_errors()) << name;
    for (const Diagnostic& item : read.diagnostics.items()) {
      EXPECT_GT(item.place.line, 0u) << name;
      EXPECT_GT(item.place.column, 0u) << name;
      EXPECT_FALSE(item.message.empty()) << name;
    }
  }
}

TEST(BvhInvalid, StrictRefusesWhatIsOnlyWarnedOf) {
  for (const std::string& name : fixtures("bvh/invalid", ".bvh")) {
    Diagnostics diagnostics;
    diagnostics.warnings_are_errors = true;
    const bool has_warnings = read_bvh(fixture(name)).diagnostics.count(Severity::Warning) > 0;
    const auto strict = find_format("bvh")->read(fixture(name), {}, diagnostics);
    EXPECT_TRUE(!has_warnings || !strict) << name;
  }
}

TEST(BvhInvalid, EveryTruncationOfAGoodFileIsReadOrRefusedWithAPlace) {
  const std::string whole = fixture("bvh/valid/spec_example.bvh");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const ReadText read = read_bvh(whole.substr(0, length));
    // Where only digits of the very last number are gone, no reader can tell.
    const bool is_hidden = length + 8 > whole.size();
    EXPECT_TRUE(is_hidden || !read.diagnostics.items().empty()) << "cut at " << length;
    for (const Diagnostic& item : read.diagnostics.items()) EXPECT_GT(item.place.line, 0u);
  }
}

TEST(BvhValid, FilesReadWithoutAWord) {
  for (const std::string& name : fixtures("bvh/valid", ".bvh")) {
    EXPECT_EQ(text_of(read_bvh(fixture(name)).diagnostics), "") << name;
  }
}

}  // namespace
}  // namespace kinefile::test
