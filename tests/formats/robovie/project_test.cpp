// SPDX-License-Identifier: MIT
// Robots' projects, and motions that are held against them.

#include <algorithm>

#include "formats/robovie/robovie.hpp"
#include "kinefile/robovie.hpp"

namespace kinefile::test {
namespace {

constexpr char kProject[] =
    "MODELNAME:[[robot]]\r\nROMINI:[[rom.ini]]\r\nMAPINI:[[map.ini]]\r\n"
    "DEFPOSINI:[[pos.ini]]\r\nSLDINI:[[sld.ini]]\r\n";

/// A project of four sliders: two arms in degrees, one disabled, one of sounds.
Files small_project() {
  return {{"sld.ini",
           "_CENTER_BAR:[0.5]-[0]\n"
           "_NUMBER:[00]\n_AXISNAME:[[arm_l]]\n_PAIR:[3]-[1]\n_PUTSTYLE:[2]-[2]-[100.0]\n"
           "_DIVISION:[-1000]-[1000]-[10]\n_FLAG:[0]-[4]\n\n"
           "_NUMBER:[01]\n_AXISNAME:[[arm_r]]\n_PAIR:[2]-[0]\n_PUTSTYLE:[2]-[2]-[182.0417]\n"
           "_DIVISION:[-32768]-[32767]-[128]\n_FLAG:[0]-[4]\n\n"
           "_NUMBER:[02]\n_AXISNAME:[[]]\n_PAIR:[1]-[0]\n_PUTSTYLE:[0]-[2]-[364.0]\n"
           "_DIVISION:[0]-[100]-[1]\n_FLAG:[0]-[5]\n\n"
           "_NUMBER:[03]\n_AXISNAME:[[voice]]\n_PAIR:[0]-[0]\n_PUTSTYLE:[4]-[0]-[1.0]\n"
           "_DIVISION:[0]-[256]-[1]\n_FLAG:[0]-[4]\n"},
          {"rom.ini",
           "# a comment\nMASTER_CLOCK:[16667]\nINTERPOlATION_SETTING:[1,1,1,3]\n\n"
           "MOTORNAME:[[left]]\nMOTOR_VARINDEX:[0]-[31]-[132]\nMOTOR_LIMIT:[-500]-[600]\n\n"
           "MOTORNAME:[[]]\nMOTOR_VARINDEX:[1]-[31]-[132]\nMOTOR_LIMIT:[-32767]-[32767]\n"},
          {"pos.ini",
           "MAINDEFPOS_NUM:[1]\nDEFPOS:[[zero]]\nAXISENABLE:[0,1]\nDEFPOS_VALUE:[0x0000,0x0000]\n\n"
           "DEFPOS:[[stand]]\nAXISENABLE:[1,0,3]\n"
           "SERVOENABLE:[100000000000000000000000000000]\nDEFPOS_VALUE:[0xff80,0x0064]\n"},
          {"map.ini", "MODESW:[0]-[0]-[[]]\nVOICE:[0]-[[snd\\drum.wav]]\nVOICE:[2]-[[]]\n"},
          {"snd/drum.wav", ""}};
}

struct ReadProject {
  std::optional<RobotProject> project;
  Diagnostics diagnostics;
};

ReadProject read_small(const Files& files, std::string_view rpj = kProject) {
  ReadProject read;
  ReadOptions options;
  options.source_name = "robot.rpj";
  options.companions = resolver_of(files);
  auto project = read_project(rpj, options, read.diagnostics);
  EXPECT_EQ(project.has_value(), !read.diagnostics.has_errors());
  if (project) read.project = std::move(*project);
  return read;
}

/// What is said about a project in whose file a text is replaced.
std::string words_about(const std::string& file, std::string_view old, std::string_view by) {
  Files files = small_project();
  files[file] = replaced(files[file], old, by);
  return text_of(read_small(files).diagnostics);
}

TEST(RobotProjectReader, ReadsWhatItsFilesSay) {
  const ReadProject read = read_small(small_project());
  EXPECT_EQ(text_of(read.diagnostics), "");
  ASSERT_TRUE(read.project);
  const RobotProject& project = *read.project;
  EXPECT_EQ(project.name, "robot");
  EXPECT_EQ(project.tick_seconds, 1.0 / 60);
  ASSERT_EQ(project.sliders.size(), 4u);
  EXPECT_EQ(project.sliders[0].name, "arm_l");
  EXPECT_EQ(project.sliders[0].units_per_degree, 100);
  EXPECT_EQ(project.sliders[0].minimum, -1000);
  EXPECT_EQ(project.sliders[0].maximum, 1000);
  EXPECT_EQ(project.sliders[0].step, 10);
  EXPECT_EQ(project.sliders[0].pair, PairKind::Left);
  EXPECT_EQ(project.sliders[0].partner, 1);
  EXPECT_EQ(project.sliders[1].pair, PairKind::Right);
  EXPECT_EQ(project.sliders[2].units_per_degree, 0);
  EXPECT_EQ(project.sliders[2].pair, PairKind::Centre);
  EXPECT_EQ(project.sliders[2].partner, -1);
  EXPECT_TRUE(project.sliders[2].is_disabled);
  EXPECT_FALSE(project.sliders[0].is_disabled);
  EXPECT_FALSE(project.sliders[2].jumps);
  EXPECT_TRUE(project.sliders[3].jumps);
  EXPECT_EQ(project.sliders[3].style, 4);
  ASSERT_EQ(project.servos.size(), 2u);
  EXPECT_EQ(project.servos[0].name, "left");
  EXPECT_EQ(project.servos[1].slider, 1);
  EXPECT_EQ(project.servos[0].minimum, -500);
  EXPECT_EQ(project.servos[0].maximum, 600);
  ASSERT_EQ(project.base_poses.size(), 2u);
  EXPECT_EQ(project.base_poses[1].name, "stand");
  EXPECT_TRUE(project.base_poses[1].servo_off.test(0));
  // The list names three sliders and gives two values, as old files do.
  EXPECT_EQ(base_values(project), (std::vector<std::int16_t>{100, -128, 0, 0}));
  EXPECT_EQ(project.sounds, (std::vector<std::string>{"snd\\drum.wav", "", ""}));
}

TEST(RobotProjectReader, TakesOtherClocksAsTheyAre) {
  Files files = small_project();
  files["rom.ini"] = replaced(files["rom.ini"], "16667", "10000");
  EXPECT_DOUBLE_EQ(read_small(files).project->tick_seconds, 0.01);
}

TEST(RobotProjectReader, FaultsHaveTheirWords) {
  EXPECT_EQ(text_of(read_small(small_project(), "HIERARCHY\n").diagnostics),
            "robot.rpj:1:1: error[RPJ001]: expected a robot project (MODELNAME:, SLDINI:), found "
            "none\n  HIERARCHY\n  ^\n");
  EXPECT_EQ(text_of(read_small(small_project(), "MODELNAME:[[a]]\n").diagnostics).substr(0, 59),
            "robot.rpj:1:1: error[RPJ002]: expected SLDINI:, found none\n");
  Files without = small_project();
  without.erase("sld.ini");
  EXPECT_EQ(codes_of(read_small(without).diagnostics), std::vector<std::string>{"RPJ002"});
  without = small_project();
  without["sld.ini"] = "no sliders\n";
  EXPECT_EQ(codes_of(read_small(without).diagnostics), std::vector<std::string>{"RPJ002"});
  for (const std::string name : {"rom.ini", "pos.ini", "map.ini"}) {
    without = small_project();
    without.erase(name);
    const ReadProject read = read_small(without);
    EXPECT_EQ(codes_of(read.diagnostics), std::vector<std::string>{"RPJ003"});
    EXPECT_TRUE(read.project) << name;
  }
  EXPECT_EQ(words_about("sld.ini", "_DIVISION:[0]-[100]-[1]", "_DIVISION:[0]-[100]"),
            "sld.ini:20:1: warning[RPJ004]: expected 3 settings after _DIVISION:, found 2; the "
            "line is passed over\n  _DIVISION:[0]-[100]\n  ^\n");
  EXPECT_EQ(words_about("rom.ini", "[16667]", "[fast]"),
            "rom.ini:2:15: warning[RPJ005]: expected a whole number from 1 to 10000000, found "
            "'fast'; it is passed over\n  MASTER_CLOCK:[fast]\n                ^\n");
  EXPECT_EQ(words_about("pos.ini", "NUM:[1]", "NUM:[2]").substr(0, 36),
            "pos.ini:1:1: warning[RPJ005]: expect");
  EXPECT_EQ(words_about("sld.ini", "_PAIR:[2]-[0]", "_PAIR:[2]-[3]"),
            "sld.ini:1:1: warning[RPJ006]: expected slider 0 and its partner to name each other, "
            "found 1\n  _CENTER_BAR:[0.5]-[0]\n  ^\n"
            "sld.ini:1:1: warning[RPJ006]: expected slider 1 and its partner to name each other, "
            "found 3\n  _CENTER_BAR:[0.5]-[0]\n  ^\n");
  EXPECT_EQ(words_about("map.ini", "drum", "bell"),
            "map.ini:2:1: warning[RPJ007]: the sound 'snd\\bell.wav' is not there\n"
            "  VOICE:[0]-[[snd\\bell.wav]]\n  ^\n");
}

/// A motion of poses for the small project.
std::string motion_with(const std::string& first, const std::string& second = "0x0000,0X0000") {
  return as_editor("_MOTION_FORMAT:[ POSEDEF_WORD_N ]\n_ENABLE_AXIS:[" +
                   std::to_string(std::count(first.begin(), first.end(), ',') + 1) +
                   "]\n_POSE:[10]-[" + first + "]-[1]-[-1]-[[]]\n_POSE:[10]-[" + second +
                   "]-[-1]-[-1]-[[SND\\drum.wav]]\n");
}

std::vector<std::string> warnings_of(const std::string& motion,
                                     std::optional<double> max_speed = std::nullopt,
                                     bool has_project = true) {
  ReadOptions options;
  if (has_project) {
    options.project = std::make_shared<const RobotProject>(*read_small(small_project()).project);
  }
  options.of_formats = robovie::ReadOptions{max_speed};
  std::vector<std::string> lines;
  const ReadText read = read_robovie(motion, options);
  for (const Diagnostic& item : read.diagnostics.items()) {
    lines.push_back(to_string(item).substr(0, to_string(item).find('\n')));
  }
  return lines;
}

TEST(RobovieOnARobot, WordsAndSoundsAreHeldAgainstTheProject) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(warnings_of(motion_with("0x0064,0X0000")), Lines{});
  EXPECT_EQ(warnings_of(motion_with("0x03f2,0X0001")),
            Lines{"t.txt:3:13: warning[RBV045]: expected -1000 to 1000 for slider 0 ('arm_l'), "
                  "found 1010"});
  EXPECT_EQ(
      warnings_of(motion_with("0X03f2,0x0001")),
      Lines{"t.txt:3:20: warning[RBV046]: expected -32768 plus a multiple of 128 for slider 1 "
            "('arm_r'), found 1"});
  EXPECT_EQ(warnings_of(motion_with("0x0000,0x0000,0x0000", "0X0000,0X0000,0X0000")),
            Lines{"t.txt:3:27: warning[RBV044]: slider 2 is enabled here and disabled in the "
                  "project"});
  const std::string other = replaced(motion_with("0x0000,0X0000"), as_editor("drum").substr(2),
                                     as_editor("bell").substr(2));
  EXPECT_EQ(warnings_of(other),
            Lines{"t.txt:4:38: warning[RBV043]: expected a sound of the project's list, found "
                  "'SND\\bell.wav'"});
}

TEST(RobovieOnARobot, SpeedsAreUnitsATick) {
  using Lines = std::vector<std::string>;
  const std::string motion = motion_with("0x0064,0X0000", "0xff9c,0X0000");  // 100 to -100
  EXPECT_EQ(warnings_of(motion, 20), Lines{});
  const Lines fast = {
      "t.txt:4:13: warning[RBV047]: slider 0 goes from 100 to -100 in 10 ticks, 20 a tick, coming "
      "from pose 0; the limit is 19.9"};
  EXPECT_EQ(warnings_of(motion, 19.9), fast);
  EXPECT_EQ(warnings_of(motion, 19.9, false), fast);
  // A disabled slider is where the base pose has it, if there is one: 100.
  const std::string from_base = motion_with("0X0000,0X0000", "0x0000,0X0000");
  EXPECT_EQ(warnings_of(from_base, 9.9).size(), 1u);
  EXPECT_EQ(warnings_of(from_base, 9.9, false), Lines{});
}

}  // namespace
}  // namespace kinefile::test
