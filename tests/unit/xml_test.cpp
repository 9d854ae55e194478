// SPDX-License-Identifier: MIT
#include "text/xml.hpp"

#include <gtest/gtest.h>

#include "text/source.hpp"

namespace kinefile::text::xml {
namespace {

/// Reads a text that must be well-formed. Views point into the text, which must therefore live.
std::unique_ptr<Tree> tree_of(std::string_view text) {
  Fault fault;
  auto tree = read_tree(text, fault);
  EXPECT_TRUE(tree) << fault.message;
  return tree;
}

/// The fault of a text as "LINE:COLUMN: MESSAGE".
std::string fault_of(std::string_view text) {
  Fault fault;
  if (read_tree(text, fault)) return "none";
  const Place place = Source("t", text).place_of(fault.at);
  return std::to_string(place.line) + ":" + std::to_string(place.column) + ": " + fault.message;
}

/// The value of the only attribute in a text.
std::string value_of(std::string_view quoted_value) {
  const std::string text = "<a b=" + std::string(quoted_value) + "/>";
  const auto tree = tree_of(text);
  return tree ? tree->root().attributes.at(0).value : "";
}

TEST(Xml, ElementsAreInTheOrderOfTheTextAndKnowTheirPlaces) {
  constexpr std::string_view kText =
      "<?xml version=\"1.0\"?>\n<!-- <z> -->\n<a one='1' b:two=\"2\">\n  <c/><d e = 'x'\n  f='y' >"
      "</d >\n</a>\n";
  const auto tree = tree_of(kText);
  ASSERT_TRUE(tree);
  ASSERT_EQ(tree->elements.size(), 3u);
  const Element& a = tree->root();
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.parent, nullptr);
  ASSERT_EQ(a.attributes.size(), 2u);
  EXPECT_EQ(a.attributes[1].name, "b:two");
  EXPECT_EQ(a.attributes[1].value, "2");
  ASSERT_EQ(a.children.size(), 2u);
  EXPECT_EQ(find_child(a, "d"), a.children[1]);
  EXPECT_EQ(find_child(a, "e"), nullptr);
  const Element& d = *a.children[1];
  EXPECT_EQ(d.parent, &a);
  EXPECT_EQ(find_attribute(d, "f")->value, "y");
  EXPECT_EQ(find_attribute(d, "g"), nullptr);
  const Source source("t", kText);
  const Place of_d = source.place_of(d.at);
  EXPECT_EQ(of_d.line, 4u);
  EXPECT_EQ(of_d.column, 7u);
  const Place of_f = source.place_of(find_attribute(d, "f")->at());
  EXPECT_EQ(of_f.line, 5u);
  EXPECT_EQ(of_f.column, 3u);
}

TEST(Xml, ReferencesAreReplacedAndOtherAmpersandsStay) {
  EXPECT_EQ(value_of("'&lt;&gt;&amp;&quot;&apos;'"), "<>&\"'");
  EXPECT_EQ(value_of("'&#65;&#x42;&#x3042;&#x1F600;'"), "AB\xE3\x81\x82\xF0\x9F\x98\x80");
  EXPECT_EQ(value_of("'a & b &nbsp; &c'"), "a & b &nbsp; &c");
  EXPECT_EQ(value_of("'&&lt;&'"), "&<&");
  EXPECT_EQ(value_of("'&#38;lt;'"), "&lt;");
  for (const char* bad : {"&#0;", "&#xD800;", "&#x110000;", "&#;", "&#x;", "&#1a;", "&#-1;",
                          "&#99999999999;", "&#1;"}) {
    EXPECT_EQ(fault_of("<a b='" + std::string(bad) + "'/>"),
              "1:7: expected a reference to a character, found none of XML")
        << bad;
  }
}

TEST(Xml, LineEndsAreSpacesInAttributesAndLineFeedsElsewhere) {
  EXPECT_EQ(value_of("'1\r\n2\r3\n4\t5'"), "1 2 3 4 5");
  EXPECT_EQ(value_of("'&#10;'"), "\n");
  EXPECT_EQ(tree_of("<a>1\r\n2\r3\n</a>")->root().characters, "1\n2\n3\n");
}

TEST(Xml, CharacterDataIsThatOfTheElementAlone) {
  const auto tree = tree_of("<a>x<b>y</b>&amp;<!-- no --><?no?><![CDATA[<z/>&amp;\r\n]]>w</a>");
  ASSERT_TRUE(tree);
  EXPECT_EQ(tree->root().characters, "x&<z/>&amp;\nw");
  EXPECT_EQ(tree->root().children.at(0)->characters, "y");
  EXPECT_EQ(tree->elements.size(), 2u);
}

TEST(Xml, ADoctypeIsSkippedIfItDeclaresNothing) {
  EXPECT_EQ(tree_of("<!DOCTYPE a><a/>")->root().name, "a");
  EXPECT_EQ(tree_of("<!DOCTYPE a SYSTEM \"a>[.dtd\" ><a/>")->root().name, "a");
  EXPECT_EQ(fault_of("<!DOCTYPE a [ <!ENTITY b 'c'> ]>\n<a/>"),
            "1:13: expected a DOCTYPE without declarations, found '['");
  EXPECT_EQ(fault_of("<!DOCTYPE a 'b"),
            "1:15: expected '>' at the end of the DOCTYPE, found the end of the file");
  EXPECT_EQ(fault_of("<a><!DOCTYPE a></a>"), "1:4: expected an element, found '<'");
}

TEST(Xml, EveryFaultHasItsPlace) {
  EXPECT_EQ(fault_of(""), "1:1: expected an element, found none");
  EXPECT_EQ(fault_of(" <!-- only -->"), "1:1: expected an element, found none");
  EXPECT_EQ(fault_of("x <a/>"), "1:1: expected an element, found 'x'");
  EXPECT_EQ(fault_of("<a/>\n x"), "2:2: expected the end of the file, found 'x'");
  EXPECT_EQ(fault_of("<a/>\n<b/>"), "2:1: expected the end of the file, found <b>");
  EXPECT_EQ(fault_of("<a>\n<b></a>"), "2:4: expected </b>, found </a>");
  EXPECT_EQ(fault_of("</a>"), "1:1: expected an element, found </a>");
  EXPECT_EQ(fault_of("<a>\n<b>"), "2:1: expected </b> at the end of this element, found none");
  EXPECT_EQ(fault_of("<a></a x>"), "1:8: expected '>' at the end of </a, found 'x'");
  EXPECT_EQ(fault_of("<a"), "1:3: expected an attribute or '>' in <a, found the end of the file");
  EXPECT_EQ(fault_of("<a b>"), "1:5: expected '=' after the attribute b, found '>'");
  EXPECT_EQ(fault_of("<a b=c>"), "1:6: expected the value of the attribute b in quotes, found 'c'");
  EXPECT_EQ(fault_of("<a b='c>\n</a>"), "2:1: expected ' at the end of the attribute b, found '<'");
  EXPECT_EQ(fault_of("<a b='1' c='2' b='3'/>"),
            "1:16: expected one attribute b in <a>, found another");
  EXPECT_EQ(fault_of("<1/>"), "1:2: expected the name of an element, found '1/'");
  EXPECT_EQ(fault_of("<a><!-- x</a>"),
            "1:4: expected '-->' after '<!--', found the end of the file");
  EXPECT_EQ(fault_of("<a><![CDATA[ x</a>"),
            "1:4: expected ']]>' after '<![CDATA[', found the end of the file");
  EXPECT_EQ(fault_of("<?xml"), "1:1: expected '?>' after '<?', found the end of the file");
  EXPECT_EQ(fault_of(std::string_view("<a>\n\0</a>", 9)), "2:1: expected XML, found a zero byte");
}

TEST(Xml, ElementsAreAHundredDeepAtMost) {
  std::string open;
  std::string close;
  for (std::size_t level = 0; level < kMostLevels; ++level) {
    open += "<a>";
    close += "</a>";
  }
  EXPECT_EQ(fault_of(open + close), "none");
  EXPECT_EQ(fault_of(open + "<b/>" + close),
            "1:301: expected at most 100 elements in each other, found more");
}

TEST(Xml, EveryTruncationHasAFaultInTheText) {
  const std::string text =
      "<?xml version='1.0'?><!DOCTYPE a><a b='&lt;&#65;'><!-- c --><![CDATA[d]]><e f=\"g\"/></a>";
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::string_view part(text.data(), length);
    Fault fault;
    EXPECT_EQ(read_tree(part, fault), nullptr) << length;
    EXPECT_TRUE(fault.at >= part.data() && fault.at <= part.data() + part.size()) << length;
  }
}

}  // namespace
}  // namespace kinefile::text::xml
