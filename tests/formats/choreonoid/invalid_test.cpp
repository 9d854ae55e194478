// SPDX-License-Identifier: MIT
// tests/formats/choreonoid/invalid holds a file for every code that reading can give, and beside it
// the exact diagnostics.

#include "support/seq.hpp"

namespace kinefile::test {
namespace {

ReadText read_seq_fixture(const std::string& name, bool is_strict = false) {
  ReadOptions options;
  options.source_name = base_name(name);
  return read_seq(fixture(name), options, is_strict);
}

TEST(SeqInvalid, EveryFileHasItsExactDiagnostics) {
  const auto names = fixtures("choreonoid/invalid", ".seq");
  ASSERT_GT(names.size(), 60u);
  for (const std::string& name : names) {
    const std::string expected = fixture(name.substr(0, name.size() - 3) + "txt");
    EXPECT_EQ(text_of(read_seq_fixture(name).diagnostics), expected) << name;
  }
}

TEST(SeqInvalid, EveryDiagnosticHasAPlace) {
  for (const std::string& name : fixtures("choreonoid/invalid", ".seq")) {
    const ReadText read = read_seq_fixture(name);
    EXPECT_EQ(read.document.has_value(), !read.diagnostics.has_errors()) << name;
    for (const Diagnostic& item : read.diagnostics.items()) {
      EXPECT_GT(item.place.line, 0u) << name;
      EXPECT_GT(item.place.column, 0u) << name;
    }
  }
}

TEST(SeqInvalid, StrictRefusesWhatIsOnlyWarnedOf) {
  for (const std::string& name : fixtures("choreonoid/invalid", ".seq")) {
    const bool has_warnings = read_seq_fixture(name).diagnostics.count(Severity::Warning) > 0;
    EXPECT_TRUE(!has_warnings || !read_seq_fixture(name, true).document) << name;
  }
}

TEST(SeqInvalid, EveryTruncationOfAGoodFileIsReadOrRefusedWithAPlace) {
  const std::string whole = seq_of({joints({"[ 0.25, 1 ]", "[ 0.5, 2 ]"}),
                                    poses({"[ [ 1, 2, 3, 1, 0, 0, 0 ] ]"}), zmp({"[ 0, 0, 1 ]"})});
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const ReadText read = read_seq(whole.substr(0, length));
    EXPECT_EQ(read.document.has_value(), !read.diagnostics.has_errors()) << length;
    for (const Diagnostic& item : read.diagnostics.items()) {
      EXPECT_GT(item.place.line, 0u) << "cut at " << length;
    }
  }
  // A frame that is cut off is never taken for a whole one.
  const std::size_t last_row = whole.rfind("[ 0, 0, 1 ]");
  for (std::size_t length = last_row; length + 2 < whole.size(); ++length) {
    EXPECT_FALSE(read_seq(whole.substr(0, length)).document) << "cut at " << length;
  }
}

}  // namespace
}  // namespace kinefile::test
