// SPDX-License-Identifier: MIT
// Options that several formats share, for their tables.
#pragma once

#include <string_view>

#include "kinefile/format.hpp"
#include "text/option_words.hpp"

namespace kinefile::options {

inline constexpr std::string_view kEncodings[] = {"utf-8", "utf-16le", "utf-16be", "latin-1",
                                                  "cp932"};

/// Metres in one unit of length, from a word or a number; empty for another text.
inline std::optional<double> metres_of(std::string_view unit) {
  if (unit == "m") return 1.0;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  if (unit == "inch") return 0.0254;
  const auto factor = words::finite(unit);
  return factor && *factor > 0 && *factor < 1e30 ? factor : std::nullopt;
}

inline constexpr ReadOption kEncoding = words::option<&ReadOptions::encoding>({
    .name = "encoding",
    .type = OptionType::Choice,
    .value_name = "ENCODING",
    .help = "Encoding of the input; else byte order marks and its bytes tell",
    .choices = kEncodings,
});

// Within these limits, frame times and times are finite numbers, too.
inline constexpr ReadOption kFps = words::option<&ReadOptions::fps>({
    .name = "fps",
    .type = OptionType::Number,
    .value_name = "RATE",
    .help = "Frames a second, instead of what the file says",
    .wanted = "frames a second above 0",
    .least = 1e-9,
    .most = 1e9,
});

inline constexpr ReadOption kUnitIn = {
    {
        .name = "unit-in",
        .type = OptionType::Text,
        .value_name = "m|cm|mm|inch|FACTOR",
        .help = "What one unit of length is, where the file does not say (ASF: once divided by its "
                "own unit)",
        .wanted = "m, cm, mm, inch or a factor above 0",
    },
    [](ReadOptions& options, const OptionInfo&, std::string_view word) {
      const auto metres = metres_of(word);
      if (metres) options.metres_per_unit = metres;
      return metres.has_value();
    }};

inline constexpr std::string_view kAxes[] = {"x", "y", "z"};

inline constexpr ReadOption kUpIn = {
    {
        .name = "up-in",
        .type = OptionType::Choice,
        .value_name = "x|y|z",
        .help = "Which axis points up in the file; else the legs and the ground tell",
        .choices = kAxes,
    },
    [](ReadOptions& options, const OptionInfo&, std::string_view word) {
      if (word.size() != 1 || word[0] < 'x' || word[0] > 'z') return false;
      options.up = static_cast<std::size_t>(word[0] - 'x');
      return true;
    }};

inline constexpr ReadOption kModelRoot = words::option<&ReadOptions::model_root>({
    .name = "model-root",
    .type = OptionType::File,
    .value_name = "DIR",
    .help = "A folder above a robot's model (.body) that its parts may lie in; else they lie in "
            "the model's own folder or below it",
});

inline constexpr OptionInfo kProjectInfo = {
    .name = "project",
    .type = OptionType::File,
    .value_name = "FILE",
    .help = "The RobovieMaker project (.rpj) of the robot that a flow is for",
};
/// The caller reads the project.
inline constexpr ReadOption kProject = {kProjectInfo};
inline constexpr WriteOption kProjectOfOutput = {kProjectInfo};

inline constexpr WriteOption kDecimals = words::option<&WriteOptions::decimals>({
    .name = "decimals",
    .type = OptionType::Count,
    .value_name = "N",
    .help = "Digits after the point; else as many as the exact value needs",
    .least = 0,
    .most = 30,
});

}  // namespace kinefile::options
