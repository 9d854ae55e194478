// SPDX-License-Identifier: MIT
// .seq files as JSON, read by another reader of JSON.

#include <nlohmann/json.hpp>

#include "kinefile/choreonoid.hpp"
#include "support/seq.hpp"

namespace kinefile::test {
namespace {

std::string as_json(const std::string& text) {
  const ReadText read = read_seq(text);
  EXPECT_TRUE(read.document) << text_of(read.diagnostics);
  return write_to_string(
      *read.document, "choreonoid",
      {.of_formats = choreonoid::WriteOptions{.style = choreonoid::YamlStyle::Json}});
}

std::string json_again(const std::string& text) {
  return write_to_string(*read_seq(text).document, "choreonoid");
}

TEST(SeqJson, JsonIsJson) {
  const std::string blocks =
      seq_of({poses({"[ [ 1, 2, 3, 1, 0, 0, 0 ] ]", "[ [ 1, 2, 4, 0.5, 0.5, 0.5, 0.5 ] ]"}),
              joints({"[ 0.1, 0.2 ]"}), zmp({"[ 0, 0.1, 0 ]"}, "    isRootRelative: true\n")});
  const std::string text = as_json(blocks);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["type"], "CompositeSeq");
  EXPECT_EQ(json["formatVersion"], 2);
  EXPECT_EQ(json["components"].size(), 3u);
  EXPECT_EQ(json["components"][0]["frames"][1][0][3], 0.5);
  EXPECT_EQ(json["components"][1]["frames"][0][1], 0.2);
  EXPECT_EQ(json["components"][2]["isRootRelative"], true);
  const ReadText read = read_seq(text);
  EXPECT_EQ(text_of(read.diagnostics), "");
  expect_same_components(components_of(read), components_of(read_seq(blocks)));
  EXPECT_EQ(json_again(text), text);
  EXPECT_EQ(write_to_string(
                *read.document, "choreonoid",
                {.of_formats = choreonoid::WriteOptions{.style = choreonoid::YamlStyle::Block}}),
            json_again(blocks));
}

TEST(SeqJson, JsonHoldsWhatIsUnknown) {
  const std::string text = seq_of(
      {zmp({"[ nan, -inf, 1 ]"}, "    mark: 'it''s'\n    more: { a: [ 1, ~, yes ], b: }\n"),
       "  -\n    type: Other\n    rows:\n      - [ 1, 2.50, .5 ]\n      - [ [ 0x10 ], +7 ]\n"},
      "note: \"two\\nlines\"\nlist:\n  - [ 1, 2 ]\n  - word\n");
  const std::string written = as_json(text);
  const auto json = nlohmann::json::parse(written);
  EXPECT_EQ(json["note"], "two\nlines");
  EXPECT_EQ(json["list"][0][1], 2);
  EXPECT_EQ(json["components"][0]["mark"], "it's");
  EXPECT_EQ(json["components"][0]["more"]["a"][0], 1);
  EXPECT_EQ(json["components"][1]["rows"][0][1], 2.5);
  EXPECT_EQ(json["components"][1]["rows"][0][2], 0.5);
  EXPECT_EQ(json_again(written), written);
}

TEST(SeqJson, KeysThatAreNoWordsBecomeWords) {
  const std::string text = seq_of({"  -\n    type: Other\n    ? [ 1, 2 ]\n    : 3\n"},
                                  "? { a: b }\n: c\n? [ d ]\n: e\n");
  const auto json = nlohmann::json::parse(as_json(text));
  EXPECT_EQ(json["{ a : b }"], "c");
  EXPECT_EQ(json["[ d ]"], "e");
  EXPECT_EQ(json["components"][0]["[ 1, 2 ]"], 3);
}

}  // namespace
}  // namespace kinefile::test
