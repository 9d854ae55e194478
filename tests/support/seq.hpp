// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "support/support.hpp"

namespace kinefile::test {

/// Reads a text as a body motion; diagnostics call it "t.seq" unless the options say otherwise.
ReadText read_seq(std::string_view bytes, ReadOptions options = {}, bool is_strict = false);

/// The components of what was read; fails the test if there are none.
const std::vector<Component>& components_of(const ReadText& read);

/// Components of a file as YAML: two joints, one link, a ZMP; with lines of keys before the frames.
std::string joints(const std::vector<std::string>& rows, const std::string& keys = "");
std::string poses(const std::vector<std::string>& rows, const std::string& keys = "",
                  const std::string& se3_format = "XYZQWQXQYQZ");
std::string zmp(const std::vector<std::string>& rows, const std::string& keys = "");

/// A file of format version 2, 10 frames a second, with components.
/// \param keys  lines of keys at the top
std::string seq_of(const std::vector<std::string>& components, const std::string& keys = "");

/// Fails the test where two numbers differ in a bit. Any nan is like any other.
void expect_same_bits(std::span<const double> found, std::span<const double> expected,
                      const std::string& what = "");

/// Fails the test where components differ: in kind, content, numbers, times, or what is unknown.
void expect_same_components(const std::vector<Component>& found,
                            const std::vector<Component>& expected, const std::string& what = "");

}  // namespace kinefile::test
