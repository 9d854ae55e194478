// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "kinefile/format.hpp"
#include "support/support.hpp"

namespace kinefile {
namespace {

TEST(Registry, NamesAndExtensionsAreUnique) {
  std::set<std::string_view> words;
  for (const Format& format : formats()) {
    EXPECT_TRUE(words.insert(format.name).second) << format.name;
    for (const std::string_view extension : format.extensions) {
      EXPECT_TRUE(extension.starts_with('.'));
      EXPECT_TRUE(words.insert(extension).second) << extension;
    }
    EXPECT_TRUE(format.read != nullptr || format.write != nullptr || format.write_poses != nullptr)
        << format.name;
  }
}

TEST(Registry, FindsFormats) {
  EXPECT_EQ(find_format("bvh")->name, "bvh");
  EXPECT_EQ(find_format("none"), nullptr);
  EXPECT_EQ(format_of_name("a/b.BVH")->name, "bvh");
  EXPECT_EQ(format_of_name("bvh"), nullptr);
  EXPECT_EQ(detect_format("\xEF\xBB\xBF\n # x\nhierarchy\n", "x.json")->name, "bvh");
  EXPECT_EQ(detect_format("", "x.json")->name, "json");
  EXPECT_EQ(detect_format("what", "x"), nullptr);
}

TEST(Registry, AnOutputOfTheInputsExtensionHasItsFormat) {
  const Format* bvh = find_format("bvh");
  const auto name_of = [](const Format* format) {
    return format == nullptr ? std::string_view("none") : format->name;
  };
  EXPECT_EQ(name_of(format_of_output("out.txt", "in.txt", bvh)), "bvh");
  EXPECT_EQ(name_of(format_of_output("a.b/out.TXT", "c/in.txt", bvh)), "bvh");
  EXPECT_EQ(name_of(format_of_output("out.dat", "in.dat", bvh)), "bvh");
  EXPECT_EQ(name_of(format_of_output("out.csv", "in.txt", bvh)), "csv");
  EXPECT_EQ(name_of(format_of_output("out.txt", "in.bvh", bvh)), "robovie");
  EXPECT_EQ(name_of(format_of_output("out.txt", "in.txt", nullptr)), "robovie");
  EXPECT_EQ(name_of(format_of_output("out.yaml", "in.yaml", find_format("body"))), "choreonoid")
      << "which is only read";
  EXPECT_EQ(name_of(format_of_output("out", "in", bvh)), "none");
  EXPECT_EQ(name_of(format_of_output("a.txt/out", "in.txt", bvh)), "none");
}

/// The extension of the foreign format that a file is of; empty if it is of none.
std::string_view foreign_of(std::string_view head, std::string_view name) {
  const ForeignFormat* foreign = find_foreign(head, name, detect_format(head, name));
  return foreign == nullptr ? std::string_view() : foreign->extension;
}

TEST(Registry, KnowsFormatsThatAreNotReadByContentThenByName) {
  const std::string poses = "# Body pose sequence format version 1.0\n\ntype: PoseSeq\nrefs:\n";
  for (const char* name : {"a.pseq", "a.yaml", "a.seq", "a"}) {
    EXPECT_EQ(foreign_of(poses, name), ".pseq") << name;
  }
  EXPECT_EQ(foreign_of("what", "A.PSEQ"), ".pseq");
  EXPECT_EQ(foreign_of("type: CompositeSeq\n", "a.pseq"), "") << "the content counts";
  EXPECT_EQ(foreign_of("type: Other\n", "a.yaml"), "");
  EXPECT_EQ(foreign_of("what", "a.csv"), "");
}

TEST(Json, ShowsSkeletonColumnsAndValues) {
  const auto read = test::read_bvh(test::bvh_with_rows({"1 2 3 nan inf 0 -inf 0 -0"}));
  const std::string text = test::write_to_string(*read.document, "json");
  EXPECT_NE(text.find("{\"name\":\"A\",\"parent\":\"Hips\",\"offset\":[1,2,3]"), std::string::npos);
  EXPECT_NE(text.find("\"frame_time\":0.04,\n\"columns\":[\"Hips.Xposition\",\"Hips.Yposition\""),
            std::string::npos);
  EXPECT_NE(text.find("\"values\":[[1,2,3,\"nan\",\"inf\",0,\"-inf\",0,-0]]}\n"),
            std::string::npos);
}

TEST(Csv, ShowsTimesAndColumns) {
  const auto read =
      test::read_bvh(test::bvh_with_rows({"1 2 3 4 5 6 7 8 9", "0 0 0 0 0 0 0 0 .5"}));
  EXPECT_EQ(test::write_to_string(*read.document, "csv"),
            "time,Hips.Xposition,Hips.Yposition,Hips.Zposition,Hips.Zrotation,Hips.Xrotation,"
            "Hips.Yrotation,A.Zrotation,A.Xrotation,A.Yrotation\n"
            "0,1,2,3,4,5,6,7,8,9\n"
            "0.04,0,0,0,0,0,0,0,0,0.5\n");
}

}  // namespace
}  // namespace kinefile
