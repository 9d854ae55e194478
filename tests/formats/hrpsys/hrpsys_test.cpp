// SPDX-License-Identifier: MIT
// hrpsys sets of text files, in and out. tests/formats/hrpsys/invalid holds a file for every code
// that reading one can give, and beside it the exact diagnostics.

#include "formats/robots/robots.hpp"
#include "support/seq.hpp"

namespace kinefile::test {
namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

/// Reads the first of some files; the others lie beside it.
ReadText read_set(const Files& files) {
  ReadOptions options;
  options.source_name = files[0].first;
  options.companions = files_of(files);
  ReadText read;
  auto document = find_format("hrpsys")->read(files[0].second, options, read.diagnostics);
  if (document) read.document = std::move(*document);
  return read;
}

/// The files of a set of the stem "a", in the order in which they are written.
Files written_set(const Document& document) {
  const auto written = std::make_shared<std::vector<MemoryFile>>();
  const OutputFiles files = files_in_memory(written);
  Diagnostics none;
  EXPECT_TRUE(write("a", document, *find_format("hrpsys"), {}, files, none));
  EXPECT_TRUE(files.commit());
  Files named;
  for (MemoryFile& file : *written) named.emplace_back(file.name, std::move(file.bytes));
  return named;
}

TEST(HrpsysInvalid, EveryFileHasItsExactDiagnostics) {
  std::size_t num_files = 0;
  for (const char* part : {".pos", ".waist", ".hip", ".zmp"}) {
    for (const std::string& name : fixtures("hrpsys/invalid", part)) {
      const std::string expected = fixture(name.substr(0, name.find_last_of('.')) + ".txt");
      const auto read = read_set({{name.substr(name.find_last_of('/') + 1), fixture(name)}});
      EXPECT_EQ(text_of(read.diagnostics), expected) << name;
      EXPECT_EQ(read.document.has_value(), !read.diagnostics.has_errors()) << name;
      ++num_files;
    }
  }
  EXPECT_GT(num_files, 11u);
}

TEST(Hrpsys, ReadsASetByAnyOfItsFiles) {
  const Files files = {{"walk.pos", "# joints\n0 0.1 -0.2\n0.005 0.3 1e-3\n\n0.01 0 nan\n"},
                       {"walk.waist", "0 1 2 3 0.1 0.2 0.3\n0.005 4 5 6 0 0 0\n"},
                       {"walk.hip", "0 0.1 0.2 0.3\n0.005 0 0 0\n"},
                       {"walk.zmp", "0\t7 8 9\r\n0.1 7 8 9\r\n"}};
  for (std::size_t first = 0; first < files.size(); ++first) {
    Files rotated = files;
    std::swap(rotated[0], rotated[first]);
    const auto read = read_set(rotated);
    EXPECT_EQ(text_of(read.diagnostics),
              "walk.pos:5:8: warning[HRP013]: expected a finite number, found 'nan'\n"
              "  0.01 0 nan\n"
              "         ^\n");
    const auto& components = components_of(read);
    ASSERT_EQ(components.size(), 3u);
    EXPECT_EQ(components[0].content, kJointDisplacement);
    EXPECT_EQ(components[0].num_parts, 2u);
    EXPECT_EQ(components[0].num_frames, 3u);
    EXPECT_EQ(components[0].values[3], 1e-3);
    EXPECT_TRUE(std::isnan(components[0].values[5]));
    EXPECT_EQ(components[0].timeline, (Timeline{FrameRate{200}, 0}));
    EXPECT_EQ(components[1].pose_form, PoseForm::RollPitchYaw);
    EXPECT_EQ(components[1].values,
              (std::vector<double>{1, 2, 3, 0.1, 0.2, 0.3, 4, 5, 6, 0, 0, 0}));
    EXPECT_TRUE(components[2].is_root_relative);
    EXPECT_EQ(components[2].timeline, (Timeline{FrameRate{10}, 0}));
  }
}

TEST(Hrpsys, ManyRowsAreReadAsFewAre) {
  std::string text;
  std::vector<double> expected;
  constexpr int kRows = 9000;
  for (int i = 0; i < kRows; ++i) {
    if (i % 700 == 699) text += "# a comment\n\n";
    if (i % 500 == 499) text += "  ";
    text += fmt::format("{:<8} {:10.6f} {}\t{:e}{}", 0.005 * i, 0.25 * i, -i, 0.125,
                        i % 300 == 0 ? " \r\n" : "\n");
    expected.insert(expected.end(), {0.25 * i, static_cast<double>(-i), 0.125});
  }
  const auto read = read_set({{"a.pos", text}});
  const auto& components = components_of(read);
  ASSERT_EQ(components.size(), 1u);
  EXPECT_EQ(components[0].num_frames, static_cast<std::size_t>(kRows));
  EXPECT_EQ(components[0].values, expected);
  EXPECT_EQ(components[0].timeline, (Timeline{FrameRate{200}, 0}));
  const auto odd = read_set({{"a.pos", text + "45 1 2\n"}});
  EXPECT_EQ(odd.diagnostics.first_error().place.line, kRows + 1u + 2 * (kRows / 700));
}

TEST(Hrpsys, TheRootIsPositionsAndAnglesOrPositionsAndMatrices) {
  const auto apart =
      read_set({{"a.waist", "0 1 2 3\n1 4 5 6\n"}, {"a.hip", "0 0.1 0.2 0.3\n1 0.4 0.5 0.6\n"}});
  EXPECT_EQ(components_of(apart)[0].values,
            (std::vector<double>{1, 2, 3, 0.1, 0.2, 0.3, 4, 5, 6, 0.4, 0.5, 0.6}));
  // A quarter turn about z.
  const auto matrix =
      read_set({{"a.waist", "0 1 2 3 0 -1 0 1 0 0 0 0 1\n1 0 0 0 1 0 0 0 1 0 0 0 1\n"}});
  const Component& component = components_of(matrix)[0];
  EXPECT_EQ(component.pose_form, PoseForm::Quaternion);
  EXPECT_NEAR(component.values[3], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(component.values[6], std::sqrt(0.5), 1e-15);
}

TEST(Hrpsys, SpeedsAfterAMatrixAreLeftOut) {
  // Choreonoid 1.4 to 1.7 wrote such files. A quarter turn about z, then half a turn about x.
  const auto read = read_set({{"a.pos", "0 0.1\n0.005 0.2\n"},
                              {"a.waist",
                               "0 1 2 3 0 -1 0 1 0 0 0 0 1 0 0 0 0 0 0\n"
                               "0.005 4 5 6 1 0 0 0 -1 0 0 0 -1 0.5 0 0 0 0 7\n"}});
  EXPECT_EQ(codes_of(read.diagnostics), (std::vector<std::string>{"HRP014"}));
  const Component& root = components_of(read)[1];
  ASSERT_EQ(root.num_frames, 2u);
  EXPECT_EQ(root.row_size(), 7u);
  const double half = std::sqrt(0.5);
  const std::vector<double> expected = {1, 2, 3, half, 0, 0, half, 4, 5, 6, 0, 1, 0, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(root.values[i], expected[i], 1e-15) << i;
  }
  // Other counts are still refused, and so is a matrix that is no rotation.
  EXPECT_EQ(codes_of(read_set({{"a.waist", "0 1 2 3 1 0 0 0 1 0 0 0 1 0 0 0 0 0\n"}}).diagnostics),
            (std::vector<std::string>{"HRP004", "HRP002"}));
  const std::string scaled =
      "0 1 2 3 2 0 0 0 1 0 0 0 1 0 0 0 0 0 0\n0.5 0 0 0 2 0 0 0 1 0 0 0 1 0 0 0 0 0 0\n";
  EXPECT_EQ(codes_of(read_set({{"a.waist", scaled}}).diagnostics),
            (std::vector<std::string>{"HRP014", "HRP006"}));
}

TEST(Hrpsys, AnglesThatDifferAreTold) {
  const auto read = read_set(
      {{"a.waist", "0 1 2 3 0 0 0\n0.5 1 2 3 0 0 0.5\n"}, {"a.hip", "0 0 0 0\n0.5 0 0 0.6\n"}});
  EXPECT_EQ(text_of(read.diagnostics),
            "a.hip:2:1: warning[HRP009]: expected the angles of the .waist file, found others, "
            "first in frame 1; those of .waist count\n  0.5 0 0 0.6\n  ^\n");
  EXPECT_EQ(components_of(read)[0].values[11], 0.5);
}

TEST(Hrpsys, PositionsAndAnglesHaveTheSameTimes) {
  const std::string waist = "0 1 2 3\n0.01 4 5 6\n";
  for (const char* hip : {"0 0 0 0\n", "0 0 0 0\n0.005 0 0 1\n", "5 0 0 0\n5.01 0 0 1\n"}) {
    const auto read = read_set({{"a.waist", waist}, {"a.hip", hip}});
    EXPECT_EQ(read.diagnostics.first_error().code, "HRP011") << hip;
  }
  const auto read = read_set({{"a.waist", "0 1 2 3 0 0 0\n0.01 4 5 6 0 0 0.2\n"},
                              {"a.hip", "0 0 0 0\n0.005 0 0 0.1\n0.01 0 0 0.2\n"}});
  EXPECT_EQ(components_of(read)[0].values[11], 0.2);
  EXPECT_EQ(text_of(read.diagnostics),
            "a.hip:1:1: warning[HRP011]: expected the times of the .waist file, row by row, found "
            "others\n  0 0 0 0\n  ^\n");
}

TEST(Hrpsys, ANameOfNoPartIsRefused) {
  const auto read = read_set({{"walk.dat", "0 1\n"}});
  EXPECT_EQ(read.diagnostics.items().at(0).code, "HRP005");
}

TEST(Hrpsys, WhatIsWrittenReadsTheSame) {
  const auto seq = read_seq(
      seq_of({joints({"[ 0.1, 1e-300 ]", "[ -0.5, 2 ]"}),
              poses({"[ [ 1, 2, 3, 0.1, -0.2, 3 ] ]", "[ [ 4, 5, 6, 0.25, 0, 0 ] ]"}, "", "XYZRPY"),
              zmp({"[ 0.1, 0.2, 0.3 ]"}, "    isRootRelative: true\n")}));
  ASSERT_TRUE(seq.document) << text_of(seq.diagnostics);
  const Files files = written_set(*seq.document);
  EXPECT_EQ(files, (Files{{"a.pos", "0 0.1 1e-300\n0.1 -0.5 2\n"},
                          {"a.waist", "0 1 2 3 0.1 -0.2 3\n0.1 4 5 6 0.25 0 0\n"},
                          {"a.hip", "0 0.1 -0.2 3\n0.1 0.25 0 0\n"},
                          {"a.zmp", "0 0.1 0.2 0.3\n"}}));
  const auto back = read_set(files);
  ASSERT_EQ(components_of(back).size(), 3u);
  EXPECT_EQ(components_of(back)[0].values,
            find_component(std::get<BodyMotion>(seq.document->content), ComponentKind::Values,
                           kJointDisplacement)
                ->values);
  Diagnostics none;
  const Document empty{BodyMotion{}, "choreonoid", {}};
  const auto refused = find_format("hrpsys")->write_set(empty, {}, nullptr, none);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "HRP008");
}

TEST(Hrpsys, AFileWithoutRowsIsNotWritten) {
  BodyMotion body;
  Component& joints_alone = body.components.emplace_back();
  joints_alone.content = kJointDisplacement;
  Diagnostics none;
  const auto refused = find_format("hrpsys")->write_set({body, "", {}}, {}, nullptr, none);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "HRP008");
  EXPECT_EQ(refused.error().message, "expected frames of 'JointDisplacement' to write, found none");
}

TEST(Hrpsys, ARateThatTimesDoNotTellIsNotWritten) {
  BodyMotion body;
  Component& values = body.components.emplace_back();
  values.content = kJointDisplacement;
  values.num_frames = 2;
  values.values = {1, 2};
  values.timeline.given = FrameRate{1e16};
  Diagnostics none;
  const auto refused = find_format("hrpsys")->write_set({body, "", {}}, {}, nullptr, none);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "HRP017");
  EXPECT_EQ(refused.error().kind, ErrorKind::DataLoss);
  EXPECT_EQ(refused.error().message,
            "hrpsys has 1e-09 to 1000000000 frames a second, not 1e+16 as 'JointDisplacement'");
}

}  // namespace
}  // namespace kinefile::test
