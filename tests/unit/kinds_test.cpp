// SPDX-License-Identifier: MIT
// Every format and every operation against every kind of document: no exception, and a document of
// the wrong kind is a Usage error.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "kinefile/convert.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/io.hpp"
#include "kinefile/retime.hpp"
#include "support/flows.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

struct Named {
  std::string name;
  Document document;
};

Motion still(const Skeleton& skeleton) {
  Motion motion{skeleton, {}};
  motion.clip.num_coordinates = skeleton.coordinates.size();
  return motion;
}

BodyMotion body_of_walk() {
  Diagnostics ignored;
  auto body = robot::project(examples::make_walk({.num_frames = 3}), robot::BodyForm::Links,
                             nullptr, ignored);
  EXPECT_TRUE(body);
  return body ? std::move(*body) : BodyMotion{};
}

/// Components without a link pose: values alone, a vector, and one that nobody knows.
BodyMotion odd_body() {
  BodyMotion body;
  for (const ComponentKind kind :
       {ComponentKind::Values, ComponentKind::Vectors, ComponentKind::Other}) {
    Component& component = body.components.emplace_back();
    component.kind = kind;
    component.content = kind == ComponentKind::Vectors ? kZmp : kJointDisplacement;
    component.num_frames = kind == ComponentKind::Other ? 0 : 2;
    component.values.resize(component.num_frames * component.row_size());
    std::fill_n(component.values.mutate().begin(), component.values.size(), 0.5);
  }
  return body;
}

std::vector<Named> documents() {
  const Motion walk = examples::make_walk({.num_frames = 3});
  const Motion parts = robot::motion_of_component(body_of_walk().components[0]);
  std::vector<Named> all;
  all.push_back({"a motion", {walk, "bvh", {}}});
  all.push_back({"a motion without frames", {still(walk.skeleton), "", {}}});
  all.push_back({"a motion without joints", {Motion{}, "", {}}});
  all.push_back({"free parts", {parts, "", {}}});
  all.push_back({"a skeleton", {walk.skeleton, "asf", {}}});
  all.push_back({"a skeleton without joints", {Skeleton{}, "", {}}});
  all.push_back({"a body motion", {body_of_walk(), "choreonoid", {}}});
  all.push_back({"a body motion without links", {odd_body(), "", {}}});
  all.push_back({"a body motion of nothing", {BodyMotion{}, "", {}}});
  all.push_back({"a flow", {test::v1r4_loop(), "robovie", {}}});
  all.push_back({"a flow of nothing", {PoseFlow{}, "", {}}});
  return all;
}

const Sink kNowhere = [](std::string_view) { return true; };

TEST(Kinds, EveryFormatTakesOrRefusesEveryDocument) {
  for (const Format& format : formats()) {
    for (const Named& named : documents()) {
      SCOPED_TRACE(std::string(format.name) + " and " + named.name);
      Diagnostics diagnostics;
      const bool is_taken =
          is_written(format) && contains(format.conventions.writes, named.document);
      const OutputFiles files = files_in_memory(std::make_shared<std::vector<MemoryFile>>());
      const WriteOptions alone = {.writes_companion = false};
      const auto written = write("out", named.document, format, alone, files, diagnostics);
      if (is_taken) continue;  // what it holds may still be refused
      ASSERT_FALSE(written);
      EXPECT_EQ(written.error().kind, ErrorKind::Usage) << to_string(written.error());
    }
  }
}

TEST(Kinds, EveryBridgeTakesOrRefusesEveryDocument) {
  const std::vector<Named> all = documents();
  const shape::RotationOrder xyz = {0, 1, 2};
  for (const Format& format : formats()) {
    for (const Named& named : all) {
      SCOPED_TRACE(std::string(format.name) + " and " + named.name);
      Diagnostics diagnostics;
      (void)adapted_to(format, named.document, {}, diagnostics);
      const auto ordered = adapted_to(format, named.document, {.order = xyz}, diagnostics);
      if (!has_skeleton(named.document)) {
        ASSERT_FALSE(ordered);
        EXPECT_EQ(ordered.error().code, "DOC001");
        EXPECT_EQ(ordered.error().kind, ErrorKind::Usage);
      }
      (void)are_written_alike(format, named.document, all[0].document);
      for (const Named& model : all) {
        for (const auto form :
             {std::optional<robot::BodyForm>(), std::optional(robot::BodyForm::Links),
              std::optional(robot::BodyForm::Both)}) {
          KindOptions options;
          options.form = form;
          options.model = &model.document;
          options.lenient = true;
          const auto made = in_kind_of(format, named.document, options, diagnostics);
          const Kinds& writes = format.conventions.writes;
          if (made && is_written(format) && writes.skeletons == writes.motions) {
            EXPECT_TRUE(contains(writes, *made)) << model.name;
          }
        }
        (void)in_kind_of(format, named.document, {}, diagnostics);
        (void)on_skeleton_of(model.document, named.document, diagnostics);
      }
    }
  }
}

/// Every operation on a motion, with plain arguments.
std::vector<std::pair<const char*, std::function<void(const Motion&)>>> motion_operations() {
  static Diagnostics diagnostics;
  const auto walk = std::make_shared<Motion>(examples::make_walk({.num_frames = 3}));
  return {
      {"trim", [](const Motion& m) { (void)edit::trim(m, 0, 1); }},
      {"reverse", [](const Motion& m) { (void)edit::reverse(m); }},
      {"mirror", [](const Motion& m) { (void)edit::mirror(m, 0, true, diagnostics); }},
      {"scale", [](const Motion& m) { (void)edit::scale(m, 2); }},
      {"up", [](const Motion& m) { (void)edit::up(m, 2, diagnostics); }},
      {"in_place", [](const Motion& m) { (void)edit::in_place(m, test::ignored()); }},
      {"loop", [](const Motion& m) { (void)edit::loop(m, 2, 1, test::ignored()); }},
      {"append",
       [walk](const Motion& m) {
         (void)edit::append(m, m, 1, test::ignored());
         (void)edit::append(m, *walk, 0, test::ignored());
       }},
      {"joints",
       [](const Motion& m) {
         (void)edit::joints(m, std::vector<std::string>{"Hips", "none"}, diagnostics);
       }},
      {"smooth", [](const Motion& m) { (void)edit::smooth(m, 5); }},
      {"unwrap", [](const Motion& m) { (void)edit::unwrap(m); }},
      {"contacts", [](const Motion& m) { (void)retime::contact_weights(m, diagnostics); }},
      {"align",
       [walk](const Motion& m) { (void)retime::align_map(m, *walk, {}, test::ignored()); }},
      {"resample",
       [](const Motion& m) {
         const auto map = retime::resample_map(m.clip, 50);
         if (map) (void)retime::apply(m, *map, {}, diagnostics);
       }},
      {"speed",
       [](const Motion& m) {
         const auto map = retime::speed_map(m.clip, 2);
         if (map) (void)retime::apply(m, *map, {}, diagnostics);
       }},
      {"warp", [](const Motion& m) { (void)retime::warp_map(m.clip.num_frames, {}); }},
      {"world_aligned", [](const Motion& m) { (void)shape::with_world_aligned_rest(m); }},
      {"without_tails",
       [](const Motion& m) { (void)shape::without_tail_translations(m, true, diagnostics); }},
      {"without_unread", [](const Motion& m) { (void)shape::without_unread_columns(m); }},
      {"without_tips", [](const Motion& m) { (void)shape::without_inner_tips(m); }},
      {"bones", [](const Motion& m) { (void)shape::with_bones(m, true, diagnostics); }},
      {"onto_skeleton",
       [walk](const Motion& m) { (void)shape::onto_skeleton(m, walk->skeleton, diagnostics); }},
      {"channels", [](const Motion& m) { (void)shape::with_channels(m, {}, diagnostics); }},
      {"project",
       [](const Motion& m) {
         (void)robot::project(m, robot::BodyForm::Both, nullptr, diagnostics);
         (void)robot::project(m, robot::BodyForm::Links, nullptr, diagnostics);
       }},
      {"onto_robot",
       [walk](const Motion& m) {
         (void)robot::onto_robot(*walk, m.skeleton, {}, true, diagnostics);
         (void)robot::onto_robot(m, m.skeleton, {}, true, diagnostics);
       }},
      {"without_free", [](const Motion& m) { (void)robot::without_free_joints(m); }},
  };
}

TEST(Kinds, EveryOperationTakesOrRefusesEveryMotion) {
  for (const auto& [name, apply] : motion_operations()) {
    for (const Named& named : documents()) {
      if (!has_skeleton(named.document)) continue;
      SCOPED_TRACE(std::string(name) + " and " + named.name);
      const Motion* motion = std::get_if<Motion>(&named.document.content);
      apply(motion != nullptr ? *motion : still(skeleton_of(named.document)));
    }
  }
}

TEST(Kinds, EveryOperationTakesOrRefusesEveryBodyMotion) {
  const std::vector<Named> all = documents();
  for (const Named& named : all) {
    const BodyMotion* body = std::get_if<BodyMotion>(&named.document.content);
    if (body == nullptr) continue;
    SCOPED_TRACE(named.name);
    Diagnostics diagnostics;
    (void)robot::motion_of_links(*body);
    (void)robot::motion_of_components(*body, true, diagnostics);
    (void)robot::zmp(*body, true, diagnostics);
    (void)robot::zmp(*body, false, diagnostics);
    for (const Named& model : all) {
      (void)robot::pose(*body, skeleton_of(model.document), true, diagnostics);
      (void)robot::compare_recorded_links(*body, skeleton_of(model.document), true, diagnostics);
    }
  }
}

TEST(Kinds, RenamingTakesWhatHasJoints) {
  for (Named& named : documents()) {
    const auto renamed = edit::rename(named.document, "Hips", "Pelvis");
    if (has_skeleton(named.document)) continue;
    ASSERT_FALSE(renamed) << named.name;
    EXPECT_EQ(renamed.error().code, "DOC001");
  }
}

TEST(Kinds, AMotionIsWhatItsCountsSay) {
  const Motion walk = examples::make_walk({.num_frames = 3});
  EXPECT_TRUE(validate(walk));
  EXPECT_TRUE(validate(Document{body_of_walk(), "", {}}));
  Motion other = walk;
  ++other.clip.num_coordinates;
  EXPECT_EQ(validate(other).error().code, "MDL002");
  other = walk;
  ++other.clip.num_frames;
  EXPECT_EQ(validate(other).error().code, "MDL002");
  Diagnostics diagnostics;
  const auto written = find_format("bvh")->write({other, "", {}}, {}, kNowhere, diagnostics);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, "MDL002");
  Document body{body_of_walk(), "", {}};
  ++std::get<BodyMotion>(body.content).components[0].num_frames;
  EXPECT_EQ(validate(body).error().code, "MDL002");
}

TEST(Kinds, AMotionIsReadByItsPath) {
  Diagnostics diagnostics;
  const std::string folder = testing::TempDir();
  const auto put = [&folder](const char* name, const Document& document, const char* format) {
    std::ofstream(folder + name) << test::write_to_string(document, format);
    return folder + name;
  };
  const Motion walk = examples::make_walk({.num_frames = 3});
  const auto motion = read_motion(put("kinds.bvh", {walk, "bvh", {}}, "bvh"), diagnostics);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->clip.num_frames, 3u);
  const auto links =
      read_motion(put("kinds.seq", {body_of_walk(), "", {}}, "choreonoid"), diagnostics);
  ASSERT_TRUE(links);
  EXPECT_EQ(links->skeleton.joints[0].name, "link0");
  const auto flow =
      read_motion(put("kinds.txt", {test::v1r4_loop(), "", {}}, "robovie"), diagnostics);
  ASSERT_FALSE(flow);
  EXPECT_EQ(flow.error().code, "DOC001");
  EXPECT_EQ(flow.error().message, "expected a motion, found a flow of poses");
  EXPECT_FALSE(read_motion(folder + "kinds_none.bvh", diagnostics));
}

TEST(Kinds, LineEndsAreNoDifferenceOfSkeletons) {
  const Motion walk = examples::make_walk({.num_frames = 3});
  const Document unix{walk.skeleton, "bvh", {}};
  std::string text = test::write_to_string(unix);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\r\n");
  }
  const Document dos = *test::read_bvh(text).document;
  ASSERT_EQ(test::write_to_string(dos), text);
  EXPECT_TRUE(are_written_alike(*find_format("bvh"), unix, dos));
}

TEST(Kinds, NoFormatWritesFramesAtOtherTimesThanTheirOwn) {
  Motion walk = examples::make_walk({.num_frames = 3});
  walk.clip.timeline.given = FrameTimes{{0, 0.1, 0.3}};
  int num_refused = 0;
  for (const Format& format : formats()) {
    if (format.write == nullptr || !format.conventions.writes.motions) continue;
    Diagnostics diagnostics;
    Document document{walk, "", {}};
    if (format.conventions.has_one_end) {
      Motion bones = *shape::with_bones(walk, false, diagnostics);
      document.content = std::move(bones);
    }
    const auto written = format.write(document, {}, kNowhere, diagnostics);
    if (format.conventions.keeps_times) {
      EXPECT_TRUE(written) << format.name;
      continue;
    }
    ASSERT_FALSE(written) << format.name;
    EXPECT_EQ(written.error().kind, ErrorKind::DataLoss) << format.name;
    EXPECT_NE(written.error().message.find("times of single frames"), std::string::npos);
    ++num_refused;
  }
  EXPECT_EQ(num_refused, 2) << "BVH and AMC";
}

/// A component of one frame.
Component one_frame(ComponentKind kind, const std::string& content) {
  Component component;
  component.kind = kind;
  component.content = content;
  component.num_frames = 1;
  component.values.resize(component.row_size());
  return component;
}

TEST(Kinds, ATableThatCouldNotBeReadBackIsRefused) {
  const Component joints = one_frame(ComponentKind::Values, std::string(kJointDisplacement));
  const Component named = one_frame(ComponentKind::Values, "Grip");
  const Component like_others = one_frame(ComponentKind::Vectors, "a.root");
  const struct {
    std::vector<Component> components;
    std::string fault;
  } cases[] = {
      {{joints, joints}, "expected each column once, found 'joint0.q' again"},
      {{named, named}, "expected each column once, found 'Grip[0].q' again"},
      {{like_others}, "its columns would be taken for other components"},
  };
  for (const auto& one : cases) {
    Diagnostics diagnostics;
    const Document document{BodyMotion{one.components}, "", {}};
    const auto refused = in_kind_of(*find_format("csv"), document, {}, diagnostics);
    ASSERT_FALSE(refused) << one.fault;
    EXPECT_EQ(refused.error().code, "CNV012");
    EXPECT_EQ(refused.error().kind, ErrorKind::DataLoss);
    EXPECT_EQ(refused.error().message, "a table of these components cannot be read back: " +
                                           one.fault + "; --lenient writes it all the same");
    EXPECT_TRUE(diagnostics.items().empty());
    const auto written = in_kind_of(*find_format("csv"), document, {.lenient = true}, diagnostics);
    EXPECT_TRUE(written);
    EXPECT_EQ(diagnostics.count_of("CNV012", Severity::Warning), 1u);
  }
  Diagnostics diagnostics;
  const Document good{BodyMotion{{joints, named, one_frame(ComponentKind::Vectors, "b")}}, "", {}};
  EXPECT_TRUE(in_kind_of(*find_format("csv"), good, {}, diagnostics));
}

TEST(Kinds, ASkeletonAloneNeedsNoSteadyRate) {
  Motion walk = examples::make_walk({.num_frames = 3});
  walk.clip.timeline.given = FrameTimes{{0, 0.1, 0.3}};
  const auto codes_on_the_way_to = [&walk](const char* name) {
    Diagnostics diagnostics;
    EXPECT_TRUE(adapted_to(*find_format(name), {walk, "", {}}, {}, diagnostics));
    return diagnostics.count_of("CNV009", Severity::Note);
  };
  EXPECT_EQ(codes_on_the_way_to("asf"), 0u);
  EXPECT_EQ(codes_on_the_way_to("amc"), 1u);
}

}  // namespace
}  // namespace kinefile
