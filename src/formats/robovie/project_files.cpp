// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "formats/robovie/codes.hpp"
#include "formats/robovie/project.hpp"
#include "model/slider_words.hpp"

namespace kinefile::robovie {
namespace {

/// MASTER_CLOCK in microseconds; the usual value means a sixtieth of a second.
constexpr int kUsualClock = 16667;
/// INTERPOlATION_SETTING of a slider that jumps to its new value at once.
constexpr int kJumps = 3;
constexpr std::size_t kMostBasePoses = 1000;
constexpr int kMostSounds = 10'000;

/// The parts of a list "1,2,3".
std::vector<std::string_view> split_list(std::string_view text) {
  std::vector<std::string_view> parts;
  for (bool goes_on = !trimmed(text).empty(); goes_on;) {
    const std::size_t comma = text.find(',');
    goes_on = comma != std::string_view::npos;
    parts.push_back(trimmed(text.substr(0, comma)));
    text.remove_prefix(goes_on ? comma + 1 : text.size());
  }
  return parts;
}

void tell_bad(const ProjectLine& line, std::string_view expected, std::string_view found) {
  line.reader().warn(
      code::kBadNumber,
      fmt::format("expected {}, found {}", expected, found.empty() ? "nothing" : shown(found)),
      found.empty() ? line.at() : found.data());
}

void read_clock(const ProjectLine& line, RobotProject& project) {
  if (!line.has(1)) return;
  const auto microseconds = line.integer(0, 1, 10'000'000);
  if (!microseconds) return;
  project.tick_seconds = *microseconds == kUsualClock ? 1.0 / 60 : *microseconds * 1e-6;
}

void read_interpolation(const ProjectLine& line, RobotProject& project) {
  const auto parts = split_list(line.text(0));
  for (std::size_t s = 0; s < std::min(parts.size(), project.sliders.size()); ++s) {
    const auto how = parse_integer(parts[s]);
    if (!how) return tell_bad(line, "a whole number a slider", parts[s]);
    project.sliders[s].jumps = *how == kJumps;
  }
}

void read_servo_line(const ProjectLine& line, Servo& servo) {
  if (line.key() == "MOTOR_VARINDEX" && line.has(1)) {
    servo.slider = line.integer(0, -1, static_cast<int>(kNumVariables) - 1).value_or(-1);
  } else if (line.key() == "MOTOR_LIMIT" && line.has(2)) {
    const auto minimum = line.integer(0, -32768, 32767);
    const auto maximum = line.integer(1, -32768, 32767);
    if (!minimum || !maximum) return;
    if (*minimum > *maximum) return tell_bad(line, "a larger number", line.text(1));
    servo.minimum = *minimum;
    servo.maximum = *maximum;
  }
}

/// The sliders that a base pose names, in its order.
std::vector<std::size_t> read_slider_list(const ProjectLine& line) {
  std::vector<std::size_t> sliders;
  for (const std::string_view part : split_list(line.text(0))) {
    const auto number = parse_integer(part);
    if (!number || *number < 0 || *number >= static_cast<int>(kNumVariables)) {
      tell_bad(line, "the number of a slider", part);
      break;
    }
    sliders.push_back(static_cast<std::size_t>(*number));
  }
  return sliders;
}

/// Assigns words to the sliders of a base pose; there may be fewer words than sliders.
void read_base_values(const ProjectLine& line, const std::vector<std::size_t>& sliders,
                      BasePose& pose) {
  const auto parts = split_list(line.text(0));
  for (std::size_t i = 0; i < std::min(parts.size(), sliders.size()); ++i) {
    const auto word = parse_word(parts[i]);
    if (!word) return tell_bad(line, "a word such as 0x01ff", parts[i]);
    if (sliders[i] < pose.values.size()) pose.values[sliders[i]] = word->value;
  }
}

void read_servo_mask(const ProjectLine& line, BasePose& pose) {
  const std::string_view digits = trimmed(line.text(0));
  if (digits.size() != kNumServos || digits.find_first_not_of("01") != std::string_view::npos) {
    return tell_bad(line, "30 digits 0 or 1", digits);
  }
  for (std::size_t i = 0; i < kNumServos; ++i) pose.servo_off[i] = digits[i] == '1';
}

/// Whether a sound of the list exists; if we cannot look, we assume so.
bool is_there(const Reader& reader, std::string path) {
  if (!reader.options.companions.open) return true;
  std::replace(path.begin(), path.end(), '\\', '/');
  return reader.options.companions.open(path).has_value();
}

void read_sound(const ProjectLine& line, RobotProject& project) {
  if (!line.has(2)) return;
  const auto number = line.integer(0, 0, kMostSounds - 1);
  if (!number) return;
  const auto index = static_cast<std::size_t>(*number);
  if (project.sounds.size() <= index) project.sounds.resize(index + 1);
  const std::string path(line.text(1));
  if (!path.empty() && !is_there(line.reader(), path)) {
    line.reader().warn(code::kMissingSound,
                       fmt::format("the sound {} is not there", text::quoted(path)), line.at());
  }
  project.sounds[index] = path;
}

}  // namespace

void read_rom(const Reader& reader, RobotProject& project) {
  for_each_line(reader, [&](const ProjectLine& line) {
    if (line.key() == "MASTER_CLOCK") {
      read_clock(line, project);
    } else if (line.key() == "INTERPOlATION_SETTING" || line.key() == "INTERPOLATION_SETTING") {
      read_interpolation(line, project);
    } else if (line.key() == "MOTORNAME" && project.servos.size() < kNumServos) {
      project.servos.emplace_back();
      project.servos.back().name = line.text(0);
    } else if (!project.servos.empty()) {
      read_servo_line(line, project.servos.back());
    }
  });
}

void read_base_poses(const Reader& reader, RobotProject& project) {
  std::vector<std::size_t> sliders;
  for_each_line(reader, [&](const ProjectLine& line) {
    if (line.key() == "MAINDEFPOS_NUM") {
      const auto number = line.has(1) ? line.integer(0, 0, kMostBasePoses - 1) : std::nullopt;
      project.base_pose = static_cast<std::size_t>(number.value_or(0));
    } else if (line.key() == "DEFPOS" && project.base_poses.size() < kMostBasePoses) {
      project.base_poses.emplace_back();
      project.base_poses.back().name = line.text(0);
      project.base_poses.back().values.resize(project.sliders.size());
      sliders.clear();
    } else if (!project.base_poses.empty()) {
      BasePose& pose = project.base_poses.back();
      if (line.key() == "AXISENABLE") sliders = read_slider_list(line);
      if (line.key() == "DEFPOS_VALUE") read_base_values(line, sliders, pose);
      if (line.key() == "SERVOENABLE") read_servo_mask(line, pose);
    }
  });
  if (project.base_pose >= project.base_poses.size() && !project.base_poses.empty()) {
    reader.warn(code::kBadNumber,
                fmt::format("expected the number of a base pose (MAINDEFPOS_NUM) from 0 to {}, "
                            "found {}",
                            project.base_poses.size() - 1, project.base_pose),
                reader.source.text().data());
    project.base_pose = 0;
  }
}

void read_map(const Reader& reader, RobotProject& project) {
  for_each_line(reader, [&](const ProjectLine& line) {
    if (line.key() == "VOICE") read_sound(line, project);
  });
}

}  // namespace kinefile::robovie
