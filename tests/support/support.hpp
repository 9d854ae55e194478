// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/format.hpp"

namespace kinefile::test {

/// What reading a text came to.
struct ReadText {
  std::optional<Document> document;
  Diagnostics diagnostics;

  /// The motion; fails the test if there is none.
  const Motion& motion() const;
};

/// Reads a text as BVH; diagnostics call it "t.bvh" unless the options say otherwise.
ReadText read_bvh(std::string_view bytes, ReadOptions options = {});

/// Reads a text as BVH, which must succeed without a warning.
Motion motion_of(std::string_view bytes);

/// Writes a document.
std::string write_to_string(const Document& document, std::string_view format = "bvh",
                            const WriteOptions& options = {});

/// The diagnostics as the command prints them.
std::string text_of(const Diagnostics& diagnostics);

/// What is known of a document's file under a key (see `facts_of`); "none" if nothing is.
std::string fact_of(const Document& document, std::string_view key);

/// The codes of the diagnostics, in order.
std::vector<std::string> codes_of(const Diagnostics& diagnostics);

/// Diagnostics that no test looks at.
Diagnostics& ignored();

/// The bytes of a file; fails the test if there is none.
std::string bytes_of(const std::string& path);

/// A file of tests/formats, and all files of one of its folders with an extension.
std::string fixture(const std::string& name);
std::vector<std::string> fixtures(const std::string& folder, const std::string& extension);

/// These bytes as a file that is read piece by piece. They must outlive the result.
ByteSource source_of(const std::string& bytes);

/// The name of a file without its folders.
std::string base_name(const std::string& path);

/// The text with the first occurrence of `from` replaced; fails the test if there is none.
std::string replaced(std::string text, std::string_view from, std::string_view to);

/// The folder of real files, or empty where it is not there.
std::string data_folder();

/// A short BVH text: a root with six channels, a joint A on it, and its End Site.
/// \param rows  the rows of the motion; "Frames:" says how many there are
std::string bvh_with_rows(const std::vector<std::string>& rows);

}  // namespace kinefile::test

/// Skips a test by name where the real files are not there.
#define SKIP_WITHOUT_DATA()                                                       \
  if (::kinefile::test::data_folder().empty()) {                                  \
    GTEST_SKIP() << "the folder KINEFILE_TEST_DATA with real files is not there"; \
  }
