// SPDX-License-Identifier: MIT
#include "kinefile/pose_table.hpp"

#include <gtest/gtest.h>

#include "kinefile/kinematics.hpp"
#include "support/support.hpp"

namespace kinefile {
namespace {

struct Table {
  Motion motion = test::motion_of(
      test::bvh_with_rows({"1 2 3 0 0 0 0 0 0", "4 5 6 90 0 0 0 0 0", "7 8 9 0 0 0 0 0 0"}));
  PoseTable spec{&motion.skeleton, &motion.clip.timeline, {0, 1}};
  std::size_t step = 1;
  std::string text;

  Sink sink() {
    return [this](std::string_view piece) {
      text += piece;
      return true;
    };
  }
  WorldPoses poses() const {
    return forward_kinematics(
        motion.skeleton, motion.clip,
        {.frame_step = step, .rotations = true, .directions = true, .tips = true});
  }
};

TEST(PoseTable, CsvHasARowForEachFrameAndJoint) {
  Table table;
  write_pose_csv_header(table.spec, table.sink());
  write_pose_csv(table.spec, table.poses(), table.sink());
  EXPECT_EQ(table.text,
            "frame,time,joint,x,y,z\n"
            "0,0,Hips,1,2,3\n0,0,A,2,4,6\n"
            "1,0.04,Hips,4,5,6\n1,0.04,A,2,6,9\n"
            "2,0.08,Hips,7,8,9\n2,0.08,A,8,10,12\n");
}

TEST(PoseTable, CsvTakesStepsJointsTipsAndUnits) {
  Table table;
  table.spec.joints = {1};
  table.step = 2;
  table.spec.tips = true;
  table.spec.directions = true;
  table.spec.length_scale = 0.5;
  write_pose_csv_header(table.spec, table.sink());
  write_pose_csv(table.spec, table.poses(), table.sink());
  EXPECT_EQ(table.text,
            "frame,time,joint,x,y,z,ux,uy,uz\n"
            "0,0,A,1,2,3,0,1,0\n0,0,A.tip,1,4,3,0,1,0\n"
            "2,0.08,A,4,5,6,0,1,0\n2,0.08,A.tip,4,7,6,0,1,0\n");
}

TEST(PoseTable, CsvQuotesNames) {
  Table table;
  table.motion.skeleton.joints[0].name = "a,b";
  table.spec.joints = {0};
  table.step = 9;
  write_pose_csv(table.spec, table.poses(), table.sink());
  EXPECT_EQ(table.text, "0,0,\"a,b\",1,2,3\n");
}

TEST(PoseTable, JsonHasAnArrayForEachQuantity) {
  Table table;
  table.spec.joints = {1};
  table.step = 2;
  table.spec.tips = true;
  table.spec.rotations = true;
  write_pose_json(table.spec, table.poses(), table.sink());
  EXPECT_EQ(table.text,
            "{\"joints\":[\"A\",\"A.tip\"],\n"
            "\"frames\":[0,2],\n"
            "\"times\":[0,0.08],\n"
            "\"positions\":[[[2,4,6],[2,8,6]],\n  [[8,10,12],[8,14,12]]],\n"
            "\"rotations\":[[[1,0,0,0],[1,0,0,0]],\n  [[1,0,0,0],[1,0,0,0]]]}\n");
}

}  // namespace
}  // namespace kinefile
