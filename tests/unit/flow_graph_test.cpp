// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/flows.hpp"
#include "support/support.hpp"

namespace kinefile::test {
namespace {

bool has_line(const std::string& text, const std::string& line) {
  return text.find("\n  " + line + "\n") != std::string::npos;
}

TEST(FlowGraph, DrawsBlocksWhereTheEditorDoes) {
  const std::string graph = flow::graph(v1r4_loop());
  EXPECT_TRUE(graph.starts_with("digraph flow {\n"));
  EXPECT_TRUE(graph.ends_with("}\n"));
  EXPECT_TRUE(has_line(graph, "b0 [label=\"0 start\", pos=\"75,-15!\", shape=oval];"));
  EXPECT_TRUE(
      has_line(graph, "b1 [label=\"1 pose POSE 0\\n40 ticks\", pos=\"75,-69!\", shape=box];"));
  EXPECT_TRUE(has_line(graph,
                       "b4 [label=\"4 loop LOOP\", pos=\"75,-312!\", shape=hexagon, style=filled, "
                       "fillcolor=\"#ffe9b3\"];"));
  EXPECT_TRUE(has_line(
      graph, "b6 [label=\"6 end    END   \", pos=\"75,-474!\", shape=oval, peripheries=2];"));
  EXPECT_TRUE(has_line(graph, "b3 -> b4;"));
  EXPECT_TRUE(has_line(graph, "b4 -> b2;"));
  EXPECT_TRUE(has_line(graph, "b4 -> b5 [style=dashed, label=\"leave\"];"));
}

TEST(FlowGraph, PutsPosesOfWordNInAColumn) {
  const std::string graph = flow::graph(word_n_loop());
  EXPECT_TRUE(has_line(graph, "b1 [label=\"1 pose\\n10 ticks\", pos=\"0,-81!\", shape=box];"));
  EXPECT_TRUE(has_line(
      graph, "b3 [label=\"3 pose\\n30 ticks\", pos=\"0,-243!\", shape=box, peripheries=2];"));
  EXPECT_TRUE(has_line(graph, "b1 -> b3 [style=dashed, label=\"break\"];"));
  EXPECT_EQ(graph.find("-> b-1"), std::string::npos);
}

TEST(FlowGraph, SaysWhatBlocksDo) {
  PoseFlow flow = v1r4_counter();
  pose_of(flow.blocks[2]).sound = "a\\b.wav";
  pose_of(flow.blocks[2]).servo_off[3] = true;
  pose_of(flow.blocks[3]).ticks = 1;
  const std::string graph = flow::graph(flow);
  EXPECT_NE(graph.find("\"1 arithmetic\\nv64 := 0\""), std::string::npos);
  EXPECT_NE(graph.find("\"2 pose\\n10 ticks\\na\\\\b.wav\\n1 servos off\""), std::string::npos);
  EXPECT_NE(graph.find("\"3 pose\\n1 tick\""), std::string::npos);
  EXPECT_NE(graph.find("\"4 arithmetic\\nv64 += 1\""), std::string::npos);
  EXPECT_NE(graph.find("\"5 branch\\nv64 >= 3?\""), std::string::npos);
  EXPECT_TRUE(has_line(graph, "b5 -> b6 [style=dashed, label=\"branch\"];"));
  const PoseFlow bits =
      v1r4_of({start_block(1), variable_block(1, Arithmetic::Divide, 9, 2),
               branch_block(241, Condition::BitsMatch, -32640, 3, 3), end_block()});
  EXPECT_NE(flow::graph(bits).find("v1 /= v9"), std::string::npos);
  EXPECT_NE(flow::graph(bits).find("v241 & 0x80 = 0x80?"), std::string::npos);
}

TEST(FlowGraph, MarksWhatNoWayLeadsTo) {
  const PoseFlow flow = v1r4_of({start_block(2), pose_block(5, {0}, 2), end_block()});
  const std::string graph = flow::graph(flow);
  EXPECT_TRUE(has_line(graph,
                       "b1 [label=\"1 pose\\n5 ticks\\nno way leads here\", pos=\"0,-0!\", "
                       "shape=box, color=gray, fontcolor=gray, style=dashed];"));
  EXPECT_EQ(flow::graph(v1r4_loop()).find("no way leads here"), std::string::npos);
}

TEST(FlowGraph, EscapesNames) {
  PoseFlow flow = v1r4_of({start_block(1), end_block()});
  flow.blocks[1].name = "say \"hi\" \\N\n起立";
  EXPECT_NE(flow::graph(flow).find("label=\"1 end say \\\"hi\\\" \\\\N 起立\""), std::string::npos);
}

TEST(FlowGraph, DrawsAFlowWithoutBlocks) {
  EXPECT_TRUE(flow::graph(v1r4_of({})).ends_with("}\n"));
  EXPECT_TRUE(flow::graph(word_n_of({})).ends_with("}\n"));
}

}  // namespace
}  // namespace kinefile::test
