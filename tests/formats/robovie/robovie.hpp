// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "kinefile/robot_project.hpp"
#include "support/support.hpp"

namespace kinefile::test {

/// Reads a text as a motion of RobovieMaker; diagnostics call it "t.txt" unless the options say
/// otherwise.
inline ReadText read_robovie(std::string_view bytes, ReadOptions options = {}) {
  if (options.source_name == "<memory>") options.source_name = "t.txt";
  ReadText result;
  auto document = find_format("robovie")->read(bytes, options, result.diagnostics);
  if (document) result.document = std::move(*document);
  EXPECT_EQ(result.document.has_value(), !result.diagnostics.has_errors());
  return result;
}

/// The flow of a document that was read; fails the test if there is none.
inline PoseFlow flow_of(const ReadText& read) {
  const PoseFlow* flow = read.document ? std::get_if<PoseFlow>(&read.document->content) : nullptr;
  EXPECT_NE(flow, nullptr) << text_of(read.diagnostics);
  return flow != nullptr ? *flow : PoseFlow{};
}

/// A text of ASCII as the editor encodes it: UTF-16LE with a byte order mark and CRLF.
inline std::string as_editor(std::string_view text) {
  std::string bytes = "\xFF\xFE";
  for (const char c : text) {
    if (c == '\n') bytes += std::string("\r\0", 2);
    bytes += c;
    bytes += '\0';
  }
  return bytes;
}

/// Files by their names, as a project finds them.
using Files = std::map<std::string, std::string>;

inline Resolver resolver_of(const Files& files) {
  auto shared = std::make_shared<const Files>(files);
  Resolver resolver;
  resolver.open = [shared](const std::string& name) -> std::optional<CompanionFile> {
    const auto found = shared->find(name);
    if (found == shared->end()) return std::nullopt;
    return CompanionFile{name, found->second, shared};
  };
  return resolver;
}

}  // namespace kinefile::test
