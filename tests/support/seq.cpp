// SPDX-License-Identifier: MIT
#include "support/seq.hpp"

#include <cstring>

#include "formats/choreonoid/bind.hpp"

namespace kinefile::test {
namespace {

/// A component: its first keys, lines of more, and its frames.
std::string component(const std::string& head, const std::string& keys,
                      const std::vector<std::string>& rows) {
  std::string text = "  -\n" + head + keys + "    frames:\n";
  for (const std::string& row : rows) text += "      - " + row + "\n";
  return text;
}

choreonoid::KeptComponent kept_of(const Component& component) {
  const auto* const kept = component.kept.get<choreonoid::KeptComponent>();
  return kept == nullptr ? choreonoid::KeptComponent{} : *kept;
}

}  // namespace

ReadText read_seq(std::string_view bytes, ReadOptions options, bool is_strict) {
  if (options.source_name == "<memory>") options.source_name = "t.seq";
  ReadText result;
  result.diagnostics.warnings_are_errors = is_strict;
  auto document = find_format("choreonoid")->read(bytes, options, result.diagnostics);
  if (document) result.document = std::move(*document);
  EXPECT_EQ(result.document.has_value(), !result.diagnostics.has_errors());
  return result;
}

const std::vector<Component>& components_of(const ReadText& read) {
  static const std::vector<Component> kNone;
  const BodyMotion* motion =
      read.document ? std::get_if<BodyMotion>(&read.document->content) : nullptr;
  EXPECT_NE(motion, nullptr) << text_of(read.diagnostics);
  return motion != nullptr ? motion->components : kNone;
}

std::string joints(const std::vector<std::string>& rows, const std::string& keys) {
  return component("    type: MultiValueSeq\n    content: JointDisplacement\n    numParts: 2\n",
                   keys, rows);
}

std::string poses(const std::vector<std::string>& rows, const std::string& keys,
                  const std::string& se3_format) {
  return component(
      "    type: MultiSE3Seq\n    content: LinkPosition\n    numParts: 1\n    SE3Format: " +
          se3_format + "\n",
      keys, rows);
}

std::string zmp(const std::vector<std::string>& rows, const std::string& keys) {
  return component("    type: Vector3Seq\n    content: ZMP\n", keys, rows);
}

std::string seq_of(const std::vector<std::string>& components, const std::string& keys) {
  std::string text = "type: CompositeSeq\ncontent: BodyMotion\nformatVersion: 2\nframeRate: 10\n";
  text += keys + (components.empty() ? "components: []\n" : "components:\n");
  for (const std::string& component : components) text += component;
  return text;
}

void expect_same_bits(std::span<const double> found, std::span<const double> expected,
                      const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool are_nan = found[i] != found[i] && expected[i] != expected[i];
    const bool is_same = are_nan || std::memcmp(&found[i], &expected[i], sizeof found[i]) == 0;
    ASSERT_TRUE(is_same) << what << ": number " << i << ": " << found[i] << ", not " << expected[i];
  }
}

void expect_same_components(const std::vector<Component>& found,
                            const std::vector<Component>& expected, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Component& a = found[i];
    const Component& b = expected[i];
    EXPECT_EQ(a.kind, b.kind) << what;
    EXPECT_EQ(a.content, b.content) << what;
    EXPECT_EQ(a.num_parts, b.num_parts) << what;
    EXPECT_EQ(a.num_frames, b.num_frames) << what;
    EXPECT_EQ(a.pose_form, b.pose_form) << what;
    EXPECT_EQ(a.is_root_relative, b.is_root_relative) << what;
    EXPECT_EQ(frame_rate(a.timeline), frame_rate(b.timeline)) << what;
    EXPECT_EQ(kept_of(a).unknown_keys, kept_of(b).unknown_keys) << what;
    EXPECT_EQ(kept_of(a).text, kept_of(b).text) << what;
    expect_same_bits(a.values, b.values, what);
    expect_same_bits(own_times(a.timeline), own_times(b.timeline), what);
  }
}

}  // namespace kinefile::test
