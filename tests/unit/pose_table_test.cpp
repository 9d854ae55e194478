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
  PoseTable spec{&motion.skeleton, &motion.clip.timeline, {0, 3, 1}, {0, 1}};

  /// What a format writes, a frame at a time.
  std::string written(const char* format) const {
    std::string text;
    const auto blocks = [this](UsePoses use) {
      for (std::size_t f = spec.frames.begin; f < spec.frames.end; f += spec.frames.step) {
        if (!use(poses_of_frame(f))) return false;
      }
      return true;
    };
    EXPECT_TRUE(find_format(format)->write_poses(spec, blocks, {}, [&text](std::string_view piece) {
      text += piece;
      return true;
    }));
    return text;
  }

  WorldPoses poses_of_frame(std::size_t frame) const {
    return forward_kinematics(motion.skeleton, motion.clip,
                              {.first_frame = frame,
                               .num_frames = 1,
                               .rotations = true,
                               .directions = true,
                               .tips = true});
  }
};

TEST(PoseTable, CsvHasARowForEachFrameAndJoint) {
  Table table;
  EXPECT_EQ(table.written("csv"),
            "frame,time,joint,x,y,z\n"
            "0,0,Hips,1,2,3\n0,0,A,2,4,6\n"
            "1,0.04,Hips,4,5,6\n1,0.04,A,2,6,9\n"
            "2,0.08,Hips,7,8,9\n2,0.08,A,8,10,12\n");
}

TEST(PoseTable, CsvTakesStepsJointsTipsAndUnits) {
  Table table;
  table.spec.joints = {1};
  table.spec.frames.step = 2;
  table.spec.tips = true;
  table.spec.directions = true;
  table.spec.length_scale = 0.5;
  EXPECT_EQ(table.written("csv"),
            "frame,time,joint,x,y,z,ux,uy,uz\n"
            "0,0,A,1,2,3,0,1,0\n0,0,A.tip,1,4,3,0,1,0\n"
            "2,0.08,A,4,5,6,0,1,0\n2,0.08,A.tip,4,7,6,0,1,0\n");
}

TEST(PoseTable, CsvQuotesNames) {
  Table table;
  table.motion.skeleton.joints[0].name = "a,b";
  table.spec.joints = {0};
  table.spec.frames.end = 1;
  EXPECT_EQ(table.written("csv"), "frame,time,joint,x,y,z\n0,0,\"a,b\",1,2,3\n");
}

TEST(PoseTable, JsonHasAnArrayForEachQuantity) {
  Table table;
  table.spec.joints = {1};
  table.spec.frames.step = 2;
  table.spec.tips = true;
  table.spec.rotations = true;
  EXPECT_EQ(table.written("json"),
            "{\"joints\":[\"A\",\"A.tip\"],\n"
            "\"frames\":[0,2],\n"
            "\"times\":[0,0.08],\n"
            "\"positions\":[[[2,4,6],[2,8,6]],\n  [[8,10,12],[8,14,12]]],\n"
            "\"rotations\":[[[1,0,0,0],[1,0,0,0]],\n  [[1,0,0,0],[1,0,0,0]]]}\n");
}

TEST(PoseTable, WithoutFramesThereAreNoRows) {
  Table table;
  table.spec.frames.end = 0;
  table.spec.directions = true;
  EXPECT_EQ(table.written("csv"), "frame,time,joint,x,y,z,ux,uy,uz\n");
  EXPECT_EQ(table.written("json"),
            "{\"joints\":[\"Hips\",\"A\"],\n\"frames\":[],\n\"times\":[],\n"
            "\"positions\":[],\n\"directions\":[]}\n");
}

TEST(PoseTable, StopsWithTheSink) {
  const Table table;
  for (const char* const format : {"csv", "json"}) {
    std::size_t num_blocks = 0;
    const auto blocks = [&](UsePoses use) {
      ++num_blocks;
      return use(table.poses_of_frame(0));
    };
    EXPECT_FALSE(find_format(format)->write_poses(table.spec, blocks, {},
                                                  [](std::string_view) { return false; }));
    EXPECT_EQ(num_blocks, 1u);
  }
}

}  // namespace
}  // namespace kinefile
