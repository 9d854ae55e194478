// SPDX-License-Identifier: MIT
// What a format keeps beyond the model goes where its joint goes, and no other format sees it.
#include "kinefile/kept.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "kinefile/convert.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/io.hpp"
#include "kinefile/shape.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

/// What a format might keep of a joint.
struct Toy {
  std::string of;
};

/// The name that a joint had when it was labelled; "none" if it was not.
std::string toy_of(const Joint& joint) {
  const Toy* const toy = joint.kept.get<Toy>();
  return toy == nullptr ? "none" : toy->of;
}

Motion labelled_walk() {
  Motion walk = examples::make_walk({.num_frames = 4});
  for (Joint& joint : walk.skeleton.joints) joint.kept = Kept(Toy{joint.name});
  return walk;
}

void expect_labels_of_names(const Skeleton& skeleton) {
  for (const Joint& joint : skeleton.joints) EXPECT_EQ(toy_of(joint), joint.name);
}

TEST(Kept, GivesItsValueAsTheTypeThatItHas) {
  const Kept nothing;
  EXPECT_TRUE(nothing.is_empty());
  EXPECT_EQ(nothing.get<Toy>(), nullptr);
  const Kept kept(Toy{"a"});
  EXPECT_FALSE(kept.is_empty());
  EXPECT_EQ(kept.get<std::string>(), nullptr);
  ASSERT_NE(kept.get<Toy>(), nullptr);
  EXPECT_EQ(kept.get<Toy>()->of, "a");
}

TEST(Kept, CopiesShareTheValueAndOutliveEachOther) {
  Kept first(Toy{"a"});
  const Kept second = first;
  EXPECT_EQ(first.get<Toy>(), second.get<Toy>());
  first = Kept();
  EXPECT_EQ(second.get<Toy>()->of, "a");
}

TEST(KeptOfJoints, StaysWithThemWhenOthersAreDropped) {
  const std::vector<std::string> names = {"Head"};
  Diagnostics diagnostics;
  const auto head = edit::joints(labelled_walk(), names, diagnostics);
  ASSERT_TRUE(head);
  EXPECT_LT(head->skeleton.joints.size(), labelled_walk().skeleton.joints.size());
  expect_labels_of_names(head->skeleton);
}

TEST(KeptOfJoints, StaysWithARenamedOne) {
  Document document{labelled_walk(), "", {}};
  ASSERT_TRUE(edit::rename(document, "Head", "Skull"));
  const auto& joints = skeleton_of(document).joints;
  const auto skull = std::find_if(joints.begin(), joints.end(),
                                  [](const Joint& joint) { return joint.name == "Skull"; });
  ASSERT_NE(skull, joints.end());
  EXPECT_EQ(toy_of(*skull), "Head");
}

TEST(KeptOfJoints, StaysThroughAppendingAndMirroring) {
  Diagnostics diagnostics;
  const auto twice =
      edit::append(labelled_walk(), examples::make_walk({.num_frames = 4}), 0, test::ignored());
  ASSERT_TRUE(twice);
  expect_labels_of_names(twice->skeleton);
  const auto mirrored = edit::mirror(labelled_walk(), 0, false, diagnostics);
  ASSERT_TRUE(mirrored);
  expect_labels_of_names(mirrored->skeleton);
}

TEST(KeptOfJoints, GoesToTheirBonesAndNotToNewOnes) {
  Diagnostics diagnostics;
  const Motion walk = labelled_walk();
  const auto bones = shape::with_bones(walk, false, diagnostics);
  ASSERT_TRUE(bones);
  std::size_t num_new = 0;
  for (const Joint& joint : bones->skeleton.joints) {
    // The root of a file of bones has a fixed name; its first bone keeps the old one.
    const std::string name = joint.name.substr(0, joint.name.find("_root_kf_helper"));
    const bool is_old = std::any_of(walk.skeleton.joints.begin(), walk.skeleton.joints.end(),
                                    [&](const Joint& old) { return old.name == name; });
    EXPECT_EQ(toy_of(joint), is_old ? name : "none") << joint.name;
    num_new += is_old ? 0 : 1;
  }
  EXPECT_GT(num_new, 1u);  // the root, and bones that lead to joints
  EXPECT_EQ(bones->skeleton.joints.size(), walk.skeleton.joints.size() + num_new);
}

/// The files that a motion is written as in a format.
std::string written_as(const Format& format, Document document) {
  Diagnostics diagnostics;
  auto adapted = adapted_to(format, std::move(document), {}, diagnostics);
  if (!adapted) return adapted.error().message;
  const auto memory = std::make_shared<std::vector<MemoryFile>>();
  const OutputFiles files = files_in_memory(memory);
  if (auto written = write("out", *adapted, format, {}, files, diagnostics); !written) {
    return written.error().message;
  }
  EXPECT_TRUE(files.commit());
  std::string all;
  for (const MemoryFile& file : *memory) all += file.name + "\n" + file.bytes;
  return all;
}

TEST(KeptOfJoints, IsNothingToFormatsThatDoNotKnowIt) {
  std::size_t num_written = 0;
  for (const Format& format : formats()) {
    if (!format.conventions.writes.motions) continue;
    const Motion plain = examples::make_walk({.num_frames = 4});
    Document kept{labelled_walk(), "toy", Kept(Toy{"the file"})};
    EXPECT_EQ(written_as(format, kept), written_as(format, {plain, "", {}})) << format.name;
    ++num_written;
  }
  EXPECT_GE(num_written, 4u);
}

TEST(KeptOfFiles, OneFormatsIsNothingToAnother) {
  std::string text = test::write_to_string({examples::make_walk({.num_frames = 2}), "", {}});
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\r\n");
  }
  const Document dos = *test::read_bvh(text).document;
  EXPECT_EQ(test::fact_of(dos, "line_end"), "crlf");
  EXPECT_EQ(test::write_to_string(dos), text);
  for (const char* format : {"asf", "amc", "csv", "json"}) {
    const std::string other = written_as(*find_format(format), dos);
    EXPECT_NE(other.find('\n'), std::string::npos) << format;
    EXPECT_EQ(other.find('\r'), std::string::npos) << format;
  }
}

}  // namespace
}  // namespace kinefile
