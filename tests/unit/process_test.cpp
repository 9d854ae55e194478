// SPDX-License-Identifier: MIT
#include "kinefile/process.hpp"

#include <gtest/gtest.h>

#include "kinefile/evidence.hpp"
#include "kinefile/kinematics.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

std::string walk_as_bvh() {
  return test::write_to_string({examples::make_walk({.num_frames = 100}), "bvh", {}}, "bvh");
}

struct Done {
  Report report;
  std::vector<MemoryFile> files;
};

Done done(Job job) {
  auto files = std::make_shared<std::vector<MemoryFile>>();
  Done result{process(job, files_in_memory(files)), {}};
  result.files = *files;
  return result;
}

Job job_of(std::string_view bytes, const std::vector<std::string>& words, std::string target) {
  Job job;
  job.source = "walk.bvh";
  job.bytes = bytes;
  job.operations = parse_operations(words).value();
  job.target = std::move(target);
  return job;
}

TEST(Process, ReadsChangesAndWritesInMemory) {
  const std::string bytes = walk_as_bvh();
  const Done result = done(job_of(bytes, {"mirror", "trim=:60"}, "y.bvh"));
  ASSERT_FALSE(result.report.error);
  EXPECT_EQ(result.report.kind, "motion");
  EXPECT_EQ(result.report.num_frames, 60u);
  ASSERT_EQ(result.files.size(), 1u);
  EXPECT_EQ(result.files[0].name, "y.bvh");
  Diagnostics diagnostics;
  const auto again = read_bytes(result.files[0].bytes, "y.bvh", nullptr, {}, diagnostics);
  ASSERT_TRUE(again);
  EXPECT_EQ(std::get<Motion>(again->content).clip.num_frames, 60u);
}

TEST(Process, AFormatOfTwoFilesGivesTwoNames) {
  const std::string bytes = walk_as_bvh();
  const Done result = done(job_of(bytes, {}, "out/y.amc"));
  ASSERT_FALSE(result.report.error);
  EXPECT_EQ(result.report.files, (std::vector<std::string>{"out/y.asf", "out/y.amc"}));
  ASSERT_EQ(result.files.size(), 2u);
  EXPECT_TRUE(result.files[0].bytes.starts_with("# ") || result.files[0].bytes.starts_with(":"));
}

TEST(Process, WhatFailsWritesNothingAndSaysWhere) {
  const std::string bytes = walk_as_bvh();
  const Done result = done(job_of(bytes, {"trim=50:200"}, "y.bvh"));
  ASSERT_TRUE(result.report.error);
  EXPECT_EQ(result.report.error->code, "EDT003");
  EXPECT_EQ(result.report.error->kind, ErrorKind::Usage);
  EXPECT_EQ(result.report.error->message,
            "trim=50:200: expected frames within 0:100, found 50:200");
  EXPECT_TRUE(result.files.empty());
  EXPECT_TRUE(result.report.files.empty());
  EXPECT_EQ(done(job_of("no motion", {}, "y.bvh")).report.error->code, "BVH001");
}

TEST(Process, ANumberThatBecomesInfiniteIsRefused) {
  const std::string seq =
      "type: CompositeSeq\ncontent: BodyMotion\nformatVersion: 2\ncomponents:\n"
      "  - type: MultiSE3Seq\n    content: LinkPosition\n    SE3Format: XYZRPY\n    numParts: 1\n"
      "    frameRate: 50\n    frames: [ [ [ 0, 0, 1, 1e307, 0, 0 ] ] ]\n";
  Job job = job_of(seq, {}, "y.bvh");
  job.source = "a.seq";
  const Done refused = done(job);
  ASSERT_TRUE(refused.report.error);
  EXPECT_EQ(refused.report.error->code, "CNV011");
  EXPECT_EQ(refused.report.error->kind, ErrorKind::DataLoss);
  EXPECT_TRUE(refused.files.empty());
  // What was not finite before may stay so.
  const std::string odd = test::replaced(seq, "1e307", ".inf");
  job.bytes = odd;
  EXPECT_FALSE(done(job).report.error);
}

/// The axis that points up in a walk on its way to a format of motions in which z does.
std::size_t up_in_format_of_z(const KindOptions& options) {
  Format format;
  format.name = "toy";
  format.conventions.writes = {.motions = true};
  format.conventions.up = 2;
  Diagnostics diagnostics;
  const auto made = in_kind_of(format, {examples::make_walk({.num_frames = 20}), "bvh", {}},
                               options, diagnostics);
  return made ? find_up_axis(std::get<Motion>(made->content)).axis : 0;
}

TEST(Conversion, AFormatsConventionSaysWhatPointsUpUnlessAnOptionDoes) {
  EXPECT_EQ(up_in_format_of_z({}), 2u);
  EXPECT_EQ(up_in_format_of_z({.up = 1}), 1u);
  EXPECT_EQ(up_in_format_of_z({.keeps_up = true}), 1u);
}

TEST(Operations, EveryOperationIsDescribed) {
  for (const OperationInfo& info : operations()) {
    EXPECT_FALSE(info.help.empty()) << info.name;
    EXPECT_TRUE(info.form.apply != nullptr || info.flow_form.apply != nullptr) << info.name;
    for (const OperationForm* form : {&info.form, &info.flow_form}) {
      EXPECT_EQ(usage_of(info, *form).empty(), form->apply == nullptr) << info.name;
      for (const Parameter& parameter : form->parameters) {
        EXPECT_FALSE(parameter.info.help.empty()) << info.name << " " << parameter.info.name;
      }
    }
  }
}

TEST(Operations, UsageIsMadeFromTheParameters) {
  const std::string list = list_of_operations();
  for (const char* usage :
       {"trim=A:B", "mirror[=x|y|z]", "loop=N[,blend=F]", "append=FILE[,blend=F]", "joints=A,B,...",
        "mirror[=A:B[:SIGN],...]", "merge=FILE,SLIDERS", "insert=BLOCK,FILE", "delete=BLOCK"}) {
    EXPECT_NE(list.find(usage), std::string::npos) << usage << " in " << list;
  }
}

TEST(Operations, WordsThatAreNoneAreRefused) {
  for (const char* word : {"nosuch", "trim", "trim=a", "mirror=w", "scale=0", "scale=-1", "loop=x",
                           "up=x", "rename=a", "smooth=", "joints=", "loop=2,blend=", "trim=5",
                           "trim=-1:2", "reverse=", "merge=a.txt", "merge=a.txt,", "mirror="}) {
    const auto operation = parse_operation(word);
    ASSERT_FALSE(operation) << word;
    EXPECT_EQ(operation.error().kind, ErrorKind::Usage) << word;
  }
}

/// Every operation meets every kind of document: it does something or says why not.
TEST(Operations, TakeOrRefuseEveryKindOfDocument) {
  const Motion walk = examples::make_walk({.num_frames = 20});
  BodyMotion body;
  Component component;
  component.content = "JointDisplacement";
  component.num_parts = 2;
  component.num_frames = 3;
  component.values = {1, 2, 3, 4, 5, 6};
  body.components.push_back(component);
  const std::vector<Document> documents = {{walk, "bvh", {}},
                                           {walk.skeleton, "bvh", {}},
                                           {body, "choreonoid", {}},
                                           {BodyMotion{}, "choreonoid", {}},
                                           {PoseFlow{}, "robovie", {}}};
  for (const char* word :
       {"trim=0:2",         "reverse",        "speed=2",          "mirror",
        "scale=2",          "up=z",           "in-place",         "loop=2",
        "append=other.bvh", "joints=Hips",    "rename=Hips:Root", "smooth=3",
        "unwrap",           "zmp=root",       "zmp=global",       "offset=0:1",
        "merge=x.txt,0",    "insert=0,x.txt", "delete=0",         "mirror=0:1"}) {
    const auto operation = parse_operation(word);
    ASSERT_TRUE(operation) << word;
    for (Document document : documents) {
      Diagnostics diagnostics;
      const auto applied = apply({&*operation, 1}, document, {}, diagnostics);
      if (!applied) {
        EXPECT_FALSE(applied.error().code.empty()) << word;
      }
    }
  }
}

}  // namespace
}  // namespace kinefile
