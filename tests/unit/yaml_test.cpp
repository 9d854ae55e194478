// SPDX-License-Identifier: MIT
// YAML: events and trees. Rows of numbers have tests of their own.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/support.hpp"
#include "support/yaml_events.hpp"
#include "text/source.hpp"
#include "text/yaml/emit.hpp"
#include "text/yaml/tree.hpp"

namespace kinefile::test {
namespace {

using text::yaml::find;
using text::yaml::Node;
using text::yaml::NodeKind;
using text::yaml::Tree;

/// The events of a text, a line each, without the document's start and end.
std::string events(std::string_view text) {
  std::string lines = test::yaml_events(text, {}).value_or("no YAML\n");
  const std::string start = "+DOC\n";
  if (lines.starts_with(start) && lines.ends_with("-DOC\n")) {
    lines = lines.substr(start.size(), lines.size() - 2 * start.size());
  }
  return lines;
}

/// The first scalar of a text, as events list it.
std::string scalar(std::string_view text) {
  const std::string lines = events(text);
  const std::size_t sign = lines.find_first_of(":'\"|>", lines.find("=VAL") + 5 + 3);
  return sign == std::string::npos ? lines : lines.substr(sign, lines.find('\n') - sign);
}

/// A tree and what was told on the way.
struct ReadTree {
  explicit ReadTree(std::string text_of_it)
      : text(std::move(text_of_it)),
        source("t.yaml", text),
        tree(text::yaml::read_tree(source, diagnostics)) {}

  /// The scalar at the end of a way of keys.
  std::string at(std::initializer_list<std::string_view> keys) const {
    const Node* node = tree == nullptr ? nullptr : &tree->root();
    for (const std::string_view key : keys) {
      if (node != nullptr) node = find(*node, key);
    }
    return node == nullptr ? "nothing" : std::string(node->text);
  }
  std::string told() const { return text_of(diagnostics); }

  std::string text;
  text::Source source;
  Diagnostics diagnostics;
  std::unique_ptr<Tree> tree;
};

std::string json_of(const ReadTree& read) {
  return read.tree == nullptr ? read.told() : text::yaml::json_text(read.tree->root());
}

std::string json(std::string text) { return json_of(ReadTree(std::move(text))); }

TEST(Yaml, BlocksGiveEventsWithPlaces) {
  EXPECT_EQ(events("a: 1\nb:\n  - x\n  - y: z\n"),
            "+MAP 0:0\n=VAL 0:0 :a\n=VAL 0:3 :1\n=VAL 1:0 :b\n+SEQ 2:2\n=VAL 2:4 :x\n+MAP 3:4\n"
            "=VAL 3:4 :y\n=VAL 3:7 :z\n-MAP\n-SEQ\n-MAP\n");
}

TEST(Yaml, FlowGivesEventsWithPlaces) {
  EXPECT_EQ(events("{a: [b, {c: d}], e: }"),
            "+MAP 0:0 {}\n=VAL 0:1 :a\n+SEQ 0:4 []\n=VAL 0:5 :b\n+MAP 0:8 {}\n=VAL 0:9 :c\n"
            "=VAL 0:12 :d\n-MAP\n-SEQ\n=VAL 0:17 :e\n=VAL empty :\n-MAP\n");
}

TEST(Yaml, AListOfAKeyNeedsNoIndentation) {
  EXPECT_EQ(json("a:\n- x\n- y\nb: z\n"), R"({"a": ["x", "y"], "b": "z"})");
}

TEST(Yaml, AListsEntryMayStartABlockOnItsLine) {
  EXPECT_EQ(json("- a: b\n  c: d\n- - e\n  - f\n-\n  g: h\n"),
            R"([{"a": "b", "c": "d"}, ["e", "f"], {"g": "h"}])");
}

TEST(Yaml, ListsInFlowMayHoldPairs) {
  EXPECT_EQ(json("[a: b, ? c : d, e]"), R"([{"a": "b"}, {"c": "d"}, "e"])");
}

TEST(Yaml, KeysMayBeAnything) {
  EXPECT_EQ(json("? a\n: b\n? [c, d]\n: e\n? f\n"), R"({"a": "b", "[ c, d ]": "e", "f": null})");
}

TEST(Yaml, PlainScalarsOfSeveralLinesAreJoined) {
  EXPECT_EQ(scalar("one\n two\n\n\n three # no more\n"), ":one two\\n\\nthree");
  EXPECT_EQ(scalar("a#b"), ":a#b");
  EXPECT_EQ(scalar("http://x"), ":http://x");
  EXPECT_EQ(scalar("-1"), ":-1");
}

TEST(Yaml, QuotesKeepWhatPlainScalarsCannotHold) {
  EXPECT_EQ(scalar("'it''s: #1'"), "'it's: #1");
  EXPECT_EQ(scalar("'one\n  two\n\n  three'"), "'one two\\nthree");
  EXPECT_EQ(scalar("\"one\\\n  two\""), "\"onetwo");
  EXPECT_EQ(scalar("\"\\x41\\u00e9\\U0001F600\\\"\\\\\\/\""), "\"A\u00e9\U0001F600\"\\/");
  EXPECT_EQ(scalar("\"\\n\""), "\"\\n");
}

TEST(Yaml, EscapesThatAreNoneAreFaults) {
  for (const char* text : {R"("\q")", R"("\x4")", R"("\ud800")", R"("\U00110000")", "\"\\"}) {
    EXPECT_EQ(events(text), "no YAML\n") << text;
  }
}

TEST(Yaml, BlocksOfTextKeepOrFoldTheirLines) {
  EXPECT_EQ(scalar("|\n one\n  two\n\n three\n\n"), "|one\\n two\\n\\nthree\\n");
  EXPECT_EQ(scalar("|-\n one\n"), "|one");
  EXPECT_EQ(scalar("|+\n one\n\n"), "|one\\n\\n");
  EXPECT_EQ(scalar("|2\n   one\n"), "| one\\n");
  EXPECT_EQ(scalar(">\n one\n two\n\n three\n   four\n five\n"),
            ">one two\\nthree\\n  four\\nfive\\n");
  EXPECT_EQ(events("|0\n one\n"), "no YAML\n");
}

TEST(Yaml, CommentsAreNotSeen) {
  EXPECT_EQ(json("# one\na: b # two\n  # three\nc: [d, # four\n e]\n"),
            R"({"a": "b", "c": ["d", "e"]})");
}

TEST(Yaml, EndsOfLinesOfAllSystemsAreAlike) {
  const std::string expected = R"({"a": ["b", "c d"], "e": "f"})";
  EXPECT_EQ(json("a:\n  - b\n  - c\n    d\ne: f\n"), expected);
  EXPECT_EQ(json("a:\r\n  - b\r\n  - c\r\n    d\r\ne: f\r\n"), expected);
  EXPECT_EQ(json("a:\r  - b\r  - c\r    d\re: f\r"), expected);
}

TEST(Yaml, TabsAreBlanksButNoIndentation) {
  EXPECT_EQ(json("a:\tb\t# c\nd: [\te,\n\tf ]\n"), R"({"a": "b", "d": ["e", "f"]})");
  const ReadTree read("a:\n\tb: c\n");
  EXPECT_EQ(read.told(),
            "t.yaml:2:1: error[YML001]: expected a value, found a tab, which no value starts with\n"
            "  \tb: c\n  ^\n");
}

TEST(Yaml, JsonIsYaml) {
  const std::string text =
      R"({"a":[1,-2.5e+3,"x\ty"],"b":{"c":true,"d":null},"e":"\u00e9\/","f":[],"g":{}})";
  EXPECT_EQ(json(text),
            "{\"a\": [1, -2.5e+3, \"x\\u0009y\"], \"b\": {\"c\": true, \"d\": null}, "
            "\"e\": \"\u00e9/\", \"f\": [], \"g\": {}}");
}

TEST(Yaml, DocumentsHaveMarks) {
  EXPECT_EQ(events("%YAML 1.1\n%TAG !e! tag:e.org,2026:\n---\n!e!x a\n...\n---\nb\n"),
            "+DOC ---\n=VAL 3:0 <tag:e.org,2026:x> :a\n-DOC ...\n+DOC ---\n=VAL 6:0 :b\n-DOC\n");
  EXPECT_EQ(events("--- a\n--- \n"), "+DOC ---\n=VAL 0:4 :a\n-DOC\n+DOC ---\n=VAL empty :\n-DOC\n");
}

TEST(Yaml, DirectivesThatAreWrongAreFaults) {
  for (const char* text :
       {"%YAML 2.0\n---\na\n", "%YAML 1.1\n%YAML 1.1\n---\na\n", "%FOO\n---\na\n", "%YAML 1.1\na\n",
        "%TAG ! x\n%TAG ! y\n---\na\n", "!e!x a\n", "%YAML 1.1 x\n---\na\n"}) {
    EXPECT_EQ(events(text), "no YAML\n") << text;
  }
}

TEST(Yaml, TagsAreKept) {
  EXPECT_EQ(events("!local a"), "=VAL 0:0 <!local> :a\n");
  EXPECT_EQ(events("!!str 1"), "=VAL 0:0 <tag:yaml.org,2002:str> :1\n");
  EXPECT_EQ(events("!<x:y> [ ]"), "+SEQ 0:0 <x:y> []\n-SEQ\n");
  EXPECT_EQ(events("&a !b c"), "=VAL 0:0 &a <!b> :c\n");
}

TEST(Yaml, OnlyTheFirstDocumentIsReadAndThatIsTold) {
  const ReadTree read("a: b\n---\nc: d\n");
  EXPECT_EQ(json_of(read), R"({"a": "b"})");
  EXPECT_EQ(read.told(),
            "t.yaml:2:1: warning[YML006]: what follows the first document is not read\n"
            "  ---\n  ^\n");
}

TEST(Yaml, NoDocumentIsAnError) {
  for (const char* text : {"", "\n\n", "# a\n"}) {
    const ReadTree read(text);
    EXPECT_EQ(read.tree, nullptr);
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"YML005"});
  }
}

TEST(Yaml, AliasesBecomeWhatTheyStandFor) {
  EXPECT_EQ(json("a: &x [1, {b: c}]\nd: *x\ne: [*x, &y f, *y]\n"),
            R"({"a": [1, {"b": "c"}], "d": [1, {"b": "c"}], "e": [[1, {"b": "c"}], "f", "f"]})");
}

TEST(Yaml, AnAliasNeedsAnAnchorBeforeIt) {
  const ReadTree read("a: *b\nb: &b c\n");
  EXPECT_EQ(read.told(),
            "t.yaml:1:4: error[YML007]: expected an anchor before its alias '*b', found none\n"
            "  a: *b\n     ^\n");
}

TEST(Yaml, AnAliasWithinWhatItStandsForIsRefused) {
  for (const char* text : {"&a [ *a ]", "&a { b: *a }", "a: &a\n  b:\n    - *a\n"}) {
    const ReadTree read(text);
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"YML007"}) << text;
  }
}

TEST(Yaml, AnAnchorThatStandsTwiceIsTheLaterOneFromThereOn) {
  const ReadTree read("[&a b, *a, &a c, *a]");
  EXPECT_EQ(json_of(read), R"(["b", "b", "c", "c"])");
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"YML011"});
}

TEST(Yaml, ABillionLaughsAreRefused) {
  std::string text = "a0: &a0 [ha, ha, ha, ha, ha, ha, ha, ha, ha, ha]\n";
  for (int i = 1; i < 10; ++i) {
    text += fmt::format("a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", i,
                        i - 1);
  }
  const ReadTree read(text);
  EXPECT_EQ(read.tree, nullptr);
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"YML008"});
}

TEST(Yaml, AliasesOfLongTextsCountAsSuch) {
  std::string text = "- &a " + std::string(80'000, 'x') + "\n";
  for (int i = 0; i < 100; ++i) text += "- *a\n";
  EXPECT_EQ(codes_of(ReadTree(text).diagnostics), std::vector<std::string>{"YML008"});
  EXPECT_NE(ReadTree("- &a " + std::string(80'000, 'x') + "\n- *a\n- *a\n").tree, nullptr);
}

TEST(Yaml, SoAreMergesOfMerges) {
  std::string text = "- &a0 { ";
  for (int i = 0; i < 1000; ++i) text += fmt::format("k{}: v, ", i);
  text += "}\n";
  for (int i = 1; i < 20'000; ++i) text += "- { <<: *a0 }\n";
  EXPECT_EQ(codes_of(ReadTree(text).diagnostics), std::vector<std::string>{"YML008"});
}

TEST(Yaml, OwnKeysComeBeforeThoseOfMergesAndEarlierMergesBeforeLater) {
  const ReadTree read(
      "a: &a { x: 1, y: 1, z: 1 }\nb: &b { y: 2, w: 2 }\n"
      "one: { <<: *a, y: 3 }\nlist: { x: 0, <<: [ *b, *a ] }\ntwo: { <<: *a, <<: *b }\n");
  EXPECT_EQ(read.told(), "");
  EXPECT_EQ(read.at({"one", "x"}) + read.at({"one", "y"}) + read.at({"one", "z"}), "131");
  EXPECT_EQ(read.at({"list", "x"}) + read.at({"list", "y"}) + read.at({"list", "w"}), "022");
  EXPECT_EQ(read.at({"two", "y"}) + read.at({"two", "w"}), "12");
  EXPECT_EQ(text::yaml::json_text(*find(read.tree->root(), "one")), R"({"y": 3, "x": 1, "z": 1})");
}

TEST(Yaml, AMergeOfSomethingElseIsAnErrorUnlessItIsQuoted) {
  for (const char* text : {"<<: a", "<<: [ a ]", "<<: [ [ {} ] ]", "<<: [ 1, 2 ]", "<<:"}) {
    EXPECT_EQ(codes_of(ReadTree(text).diagnostics).front(), "YML010") << text;
  }
  EXPECT_EQ(json("\"<<\": a\n"), R"({"<<": "a"})");
}

TEST(Yaml, OfAKeyThatStandsTwiceTheLaterOneCounts) {
  const ReadTree read("a: 1\nb: 2\n'a': 3\n");
  EXPECT_EQ(json_of(read), R"({"a": 3, "b": 2})");
  EXPECT_EQ(read.told(),
            "t.yaml:3:1: warning[YML009]: expected the key 'a' once, found it again; the later one "
            "counts\n  'a': 3\n  ^\n");
}

TEST(Yaml, LevelsEndAt200) {
  const auto nested = [](std::size_t levels) {
    return std::string(levels, '[') + "a" + std::string(levels, ']');
  };
  EXPECT_EQ(ReadTree(nested(199)).told(), "");
  EXPECT_EQ(codes_of(ReadTree(nested(201)).diagnostics), std::vector<std::string>{"YML003"});
  EXPECT_EQ(codes_of(ReadTree(nested(100'000)).diagnostics), std::vector<std::string>{"YML003"});
  std::string blocks;
  for (std::size_t i = 0; i < 300; ++i) blocks += std::string(i, ' ') + "a:\n";
  EXPECT_EQ(codes_of(ReadTree(blocks).diagnostics), std::vector<std::string>{"YML003"});
}

TEST(Yaml, AKeyOfOneLineHasAtMost1024Characters) {
  EXPECT_EQ(ReadTree(std::string(1024, 'k') + ": v").told(), "");
  EXPECT_EQ(codes_of(ReadTree(std::string(1025, 'k') + ": v").diagnostics),
            std::vector<std::string>{"YML001"});
}

TEST(Yaml, ControlCharactersAreFaultsAtTheirPlace) {
  const ReadTree read("a: b\nc: d\x1B[0m\n");
  EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"YML002"});
  EXPECT_EQ(read.diagnostics.items()[0].place.line, 2u);
  EXPECT_EQ(read.diagnostics.items()[0].place.column, 5u);
  EXPECT_EQ(events("\x7F"), "no YAML\n");
  EXPECT_EQ(events("a: \xC2\x81"), "no YAML\n");
}

TEST(Yaml, FaultsAreFaults) {
  for (const char* text :
       {"[a, b",      "{a: b",   "a: b: c",  "a\nb: c\n", "a: 'b", "- a\nb: c\n",  "a: b\n  c: d\n",
        "]",          "[a]]",    "{a: b]",   "@a",        "`a",    "a: [b\n---\n", "&",
        "*",          "? ? : -", "key: - a", "%",         "[,]",   "a: |x\n b\n",  "[ ? ]",
        "[a:b, c:]d]"}) {
    EXPECT_EQ(events(text), "no YAML\n") << text;
  }
}

TEST(Yaml, WhatIsKeptIsWrittenSoThatItReadsTheSame) {
  const ReadTree read(
      "a: 1\nb: 'x: y'\nc: [1, [2, 3], {d: e}]\nf:\n  - g: h\n    i:\n      - [1, 2]\n      - j\n"
      "k: |\n  l\n  m\n? [n]\n: o\np:\n'q': !t r\n");
  ASSERT_NE(read.tree, nullptr);
  const std::string text = text::yaml::block_text(read.tree->root());
  const ReadTree again(text);
  EXPECT_EQ(json_of(again), json_of(read)) << text;
  ASSERT_NE(again.tree, nullptr) << text;
  EXPECT_EQ(text::yaml::block_text(again.tree->root()), text);
}

TEST(Yaml, WhatCouldBeTakenForSomethingElseIsWrittenInQuotes) {
  for (const char* text :
       {"- :x\n- a:?b\n- ?x\n- a,b\n", "  --- a: b\n  ... c: d\n", "a: \"b\\Nc\\Ld\\x81\\uFFFE\"\n",
        "a: b\xE2\x80\xA8  c\n", "a: !t%20%3e [ !u {}, !<v,w> x ]\nb: ! y\n", "a: !t\n  - b: c\n",
        "'- a': 'b # c'\n\"\": ''\n", "- { ? a : , b: }\n"}) {
    const ReadTree read(text);
    ASSERT_NE(read.tree, nullptr) << text << read.told();
    const std::string written = text::yaml::block_text(read.tree->root());
    const ReadTree again(written);
    EXPECT_EQ(again.told(), "") << written;
    EXPECT_EQ(json_of(again), json_of(read)) << written;
    ASSERT_NE(again.tree, nullptr);
    EXPECT_EQ(text::yaml::block_text(again.tree->root()), written);
  }
}

TEST(Yaml, ALongKeyIsWrittenWithItsSign) {
  const std::string key(2000, 'k');
  for (const std::string& text : {"? " + key + "\n: v\n", "a: { ? " + key + " : v }\n"}) {
    const ReadTree read(text);
    ASSERT_NE(read.tree, nullptr);
    const ReadTree again(text::yaml::block_text(read.tree->root()));
    EXPECT_EQ(json_of(again), json_of(read));
  }
}

TEST(Yaml, TagsAreWrittenAgain) {
  const ReadTree read("a: !t%20 [ !u { b: !v c } ]\nd: !w\n  - e: f\n");
  ASSERT_NE(read.tree, nullptr);
  EXPECT_EQ(text::yaml::block_text(read.tree->root()),
            "a: !<!t%20>\n  - !<!u> { b : !<!v> c }\nd: !<!w>\n  -\n    e: f");
}

}  // namespace
}  // namespace kinefile::test
