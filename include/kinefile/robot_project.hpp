// SPDX-License-Identifier: MIT
#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/format.hpp"
#include "kinefile/pose_flow.hpp"
#include "kinefile/result.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// How a slider changes when a pose is mirrored (_PAIR).
enum class PairKind {
  None = 0,    ///< unaffected
  Centre = 1,  ///< has no partner; its sign changes
  Right = 2,   ///< swaps with its partner
  Left = 3,    ///< swaps with its partner
};

/// A slider of a robot, and the meaning of its words.
struct Slider {
  std::string name;
  int style = 0;                ///< how it is shown: 0 number, 1 bits, 2 degrees, 4 sound
  double units_per_degree = 0;  ///< words per degree; 0 if it is not shown in degrees
  int minimum = -32768, maximum = 32767;
  int step = 1;
  bool is_disabled = false;
  bool jumps = false;  ///< takes its new value at once instead of by interpolation
  PairKind pair = PairKind::None;
  int partner = -1;  ///< the partner slider, for `Right` and `Left`
};

/// The default pose of a robot (medit_defpos.ini).
struct BasePose {
  std::string name;
  std::vector<std::int16_t> values;  ///< by slider; 0 for sliders that the file does not name
  std::bitset<kNumServos> servo_off;
};

/// A servo of a robot (medit_rom.ini).
struct Servo {
  std::string name;
  int slider = -1;  ///< the variable that it follows
  int minimum = -32767, maximum = 32767;
};

/// A robot as its RobovieMaker project describes it: .rpj and the files that it names.
struct RobotProject {
  std::string name;                ///< MODELNAME
  double tick_seconds = 1.0 / 60;  ///< MASTER_CLOCK; 16667 µs is read as 1/60 s
  std::vector<Slider> sliders;     ///< by number
  std::vector<BasePose> base_poses;
  std::size_t base_pose = 0;        ///< the one in use
  std::vector<Servo> servos;        ///< by channel
  std::vector<std::string> sounds;  ///< paths of the sound list, including empty ones
};

/// The values of the base pose in use, one per slider; all 0 without one.
std::vector<std::int16_t> base_values(const RobotProject& project);

/// Reads a project. Its files are found through `options.companions`; a missing file is a warning,
/// except for the list of sliders, which is an error.
/// \errors RPJ001 and up with their places
Result<RobotProject> read_project(std::string_view bytes, const ReadOptions& options,
                                  Diagnostics& diagnostics);

}  // namespace kinefile

#pragma GCC visibility pop
