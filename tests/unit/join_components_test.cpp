// SPDX-License-Identifier: MIT
// Loops and joins of body motions without a robot: what each component means.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinefile/operation.hpp"
#include "support/seq.hpp"

namespace kinefile::test {
namespace {

/// A document that must be good.
Document document_of(const std::string& text) {
  auto read = read_seq(text);
  EXPECT_TRUE(read.document) << text_of(read.diagnostics);
  return read.document ? std::move(*read.document) : Document{BodyMotion{}, "choreonoid", {}};
}

/// Applies an operation to a document; `next.seq` is another.
Result<void> edited(Document& document, const std::string& word, const Document& next = {}) {
  OperationContext context;
  context.open = [&next](const std::string&) -> Result<Document> { return next; };
  const auto operation = parse_operation(word);
  Diagnostics diagnostics;
  return apply({&*operation, 1}, document, context, diagnostics);
}

/// The components after an operation, which must succeed.
std::vector<Component> after(const std::string& text, const std::string& word,
                             const std::string& next = "") {
  Document document = document_of(text);
  const auto done = edited(document, word, next.empty() ? Document() : document_of(next));
  EXPECT_TRUE(done) << (done ? "" : done.error().message);
  return std::get<BodyMotion>(document.content).components;
}

std::string refusal_of(const std::string& text, const std::string& next) {
  Document document = document_of(text);
  const auto done = edited(document, "append=next.seq,blend=1", document_of(next));
  return done ? "" : done.error().message;
}

/// A column of a component.
std::vector<double> column(const Component& component, std::size_t index) {
  std::vector<double> numbers;
  for (std::size_t f = 0; f < component.num_frames; ++f) {
    numbers.push_back(component.row(f)[index]);
  }
  return numbers;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
}

const std::vector<std::string> kJointRows = {"[ 0.0, 0.5 ]", "[ 0.1, 0.5 ]", "[ 0.2, 0.5 ]",
                                             "[ 0.3, 0.5 ]"};
const std::vector<std::string> kWalkRows = {
    "[ [ 0, 0.0, 1.00, 1, 0, 0, 0 ] ]", "[ [ 0, 0.5, 0.98, 1, 0, 0, 0 ] ]",
    "[ [ 0, 1.0, 0.96, 1, 0, 0, 0 ] ]", "[ [ 0, 1.5, 0.94, 1, 0, 0, 0 ] ]"};
const std::vector<std::string> kZmpRows = {"[ 0.00, 0.1, 0 ]", "[ 0.01, 0.1, 0 ]",
                                           "[ 0.02, 0.1, 0 ]", "[ 0.03, 0.1, 0 ]"};

TEST(JoinComponents, ValuesOfJointsAreBlendedAsTheyAre) {
  for (const std::size_t blend : {1u, 2u, 3u, 4u}) {
    const auto looped = after(seq_of({joints(kJointRows)}), fmt::format("loop=5,blend={}", blend));
    EXPECT_EQ(looped[0].num_frames, 20 - 4 * blend);
    for (const double value : column(looped[0], 0)) EXPECT_TRUE(value >= 0 && value <= 0.3);
    for (const double value : column(looped[0], 1)) EXPECT_EQ(value, 0.5);
  }
}

TEST(JoinComponents, SoAreTheColumnsOfATable) {
  Diagnostics diagnostics;
  Document table = *find_format("csv")->read(
      "time,J1,J2\n0,0,0.5\n0.1,0.1,0.5\n0.2,0.2,0.5\n0.3,0.3,0.5\n", {}, diagnostics);
  ASSERT_TRUE(edited(table, "loop=3,blend=1"));
  const auto& looped = std::get<BodyMotion>(table.content).components;
  expect_near(column(looped[0], 0), {0, 0.1, 0.2, 0.15, 0.1, 0.2, 0.15, 0.1, 0.2, 0.3});
  EXPECT_EQ(column(looped[0], 1), std::vector<double>(10, 0.5));
}

TEST(JoinComponents, AZmpThatIsRelativeToTheRootStaysThere) {
  const auto looped = after(seq_of({poses(kWalkRows), zmp(kZmpRows, "    isRootRelative: true\n")}),
                            "loop=3,blend=1");
  expect_near(column(looped[1], 0), {0, 0.01, 0.02, 0.015, 0.01, 0.02, 0.015, 0.01, 0.02, 0.03});
  expect_near(column(looped[1], 1), std::vector<double>(10, 0.1));
}

TEST(JoinComponents, LinksGoOnAlongTheGroundAndZIsUp) {
  const auto looped = after(seq_of({poses(kWalkRows)}), "loop=3,blend=1");
  expect_near(column(looped[0], 1), {0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5});
  expect_near(column(looped[0], 2), {1, 0.98, 0.96, 0.97, 0.98, 0.96, 0.97, 0.98, 0.96, 0.94});
}

TEST(JoinComponents, AZmpInTheWorldGoesWithTheRoot) {
  // The root walks a curve; its ZMP is always 0.1 ahead of it and 0.05 to its left.
  std::vector<std::string> links, points;
  for (int f = 0; f < 5; ++f) {
    const double yaw = 0.3 * f;
    const double x = std::sin(yaw), y = 1 - std::cos(yaw);
    links.push_back(fmt::format("[ [ {}, {}, 0.8, {}, 0, 0, {} ] ]", x, y, std::cos(yaw / 2),
                                std::sin(yaw / 2)));
    points.push_back(fmt::format("[ {}, {}, 0 ]", x + 0.1 * std::cos(yaw) - 0.05 * std::sin(yaw),
                                 y + 0.1 * std::sin(yaw) + 0.05 * std::cos(yaw)));
  }
  // Whatever comes first in the file, the link leads.
  for (const auto& file :
       {std::vector{poses(links), zmp(points)}, std::vector{zmp(points), poses(links)}}) {
    Document document = document_of(seq_of(file));
    ASSERT_TRUE(edited(document, "loop=4,blend=1"));
    ASSERT_TRUE(edited(document, "zmp=root"));
    const auto& body = std::get<BodyMotion>(document.content);
    const Component& relative = *find_component(body, ComponentKind::Vectors, kZmp);
    ASSERT_EQ(relative.num_frames, 17u);
    expect_near(column(relative, 0), std::vector<double>(17, 0.1));
    expect_near(column(relative, 1), std::vector<double>(17, 0.05));
    const Component& root = *find_component(body, ComponentKind::Poses, kLinkPosition);
    EXPECT_NEAR(root.row(16)[0], std::sin(0.3 * 16), 1e-12) << "on around the circle";
  }
}

TEST(JoinComponents, WhatAComponentMeansThatNobodyKnowsIsNotGuessed) {
  std::string forces = zmp(kZmpRows);
  forces.replace(forces.find("ZMP"), 3, "Force");
  std::string things = poses(kWalkRows);
  things.replace(things.find("LinkPosition"), 12, "ThingPosition");
  const auto looped = after(seq_of({poses(kWalkRows), forces, things}), "loop=2,blend=1");
  expect_near(column(looped[1], 0), {0, 0.01, 0.02, 0.015, 0.01, 0.02, 0.03});
  expect_near(column(looped[2], 1), {0, 0.5, 1, 0.75, 0.5, 1, 1.5});
}

TEST(JoinComponents, WithoutABlendEveryBitIsKept) {
  const std::string text = seq_of({poses(kWalkRows), joints(kJointRows), zmp(kZmpRows)});
  const auto before = components_of(read_seq(text));
  const auto looped = after(text, "loop=2");
  for (std::size_t c = 0; c < before.size(); ++c) {
    std::vector<double> twice(before[c].values.begin(), before[c].values.end());
    twice.insert(twice.end(), before[c].values.begin(), before[c].values.end());
    expect_same_bits(looped[c].values, twice);
  }
}

TEST(JoinComponents, AnotherBodyMotionMayFollow) {
  const std::string first = seq_of({poses(kWalkRows), joints(kJointRows)});
  // The other order of components, and a rate that is spelt in another way.
  std::string next = seq_of({joints(kJointRows), poses(kWalkRows)});
  next.replace(next.find("frameRate: 10"), 13, "frameRate: 10.000001");
  const auto joined = after(first, "append=next.seq,blend=1", next);
  EXPECT_EQ(joined[0].content, kLinkPosition);
  EXPECT_EQ(joined[0].timeline, (Timeline{FrameRate{10}, 0}));
  expect_near(column(joined[0], 1), {0, 0.5, 1, 1.5, 2, 2.5, 3});
  expect_near(column(joined[1], 0), {0, 0.1, 0.2, 0.15, 0.1, 0.2, 0.3});
  expect_near(column(after(first, "append=next.seq", next)[1], 0),
              {0, 0.1, 0.2, 0.3, 0, 0.1, 0.2, 0.3});
}

TEST(JoinComponents, OtherComponentsDoNotFollow) {
  const std::string walk = seq_of({poses(kWalkRows)});
  const std::string both = seq_of({poses(kWalkRows), joints(kJointRows)});
  EXPECT_EQ(
      refusal_of(both, walk),
      "append=next.seq,blend=1: the components differ: there is no 'JointDisplacement' in the "
      "motion that follows");
  EXPECT_EQ(refusal_of(walk, both),
            "append=next.seq,blend=1: the components differ: the motion that follows has more of "
            "them");
  EXPECT_EQ(refusal_of(walk, seq_of({poses({"[ [ 0, 0, 1, 0, 0, 0 ] ]"}, "", "XYZRPY")})),
            "append=next.seq,blend=1: the components differ: the poses of 'LinkPosition' have "
            "another form in the motion that follows");
  std::string faster = walk;
  faster.replace(faster.find("frameRate: 10"), 13, "frameRate: 12");
  EXPECT_EQ(refusal_of(walk, faster),
            "append=next.seq,blend=1: the frame rates differ: 10 and 12 frames a second");
}

}  // namespace
}  // namespace kinefile::test
