// SPDX-License-Identifier: MIT
#pragma once

// RobovieMaker's motion files. Sources: the maker's description of the format ("RobovieMaker2
// course", no. 6), and files that RobovieMaker2 wrote; docs/formats/robovie.md gives the source of
// each rule.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "kinefile/pose_flow.hpp"

namespace kinefile::robovie {

enum class Keyword {
  MotionFormat,
  EnableAxis,
  MotionInfo,
  StartMot,
  EndMot,
  Pose,
  OldLoop,
  VarCon,
  VarVar,
  Mif,
};

/// A keyword as written, without its colon, and the names of its settings.
struct KeywordRow {
  std::string_view word;
  std::span<const std::string_view> settings;
};

/// The row of a keyword; the settings of a pose differ between the formats.
KeywordRow row_of(Keyword keyword, FlowFormat format);

/// All keywords, in their order.
inline constexpr std::array<Keyword, 10> kKeywords = {
    Keyword::MotionFormat, Keyword::EnableAxis, Keyword::MotionInfo, Keyword::StartMot,
    Keyword::EndMot,       Keyword::Pose,       Keyword::OldLoop,    Keyword::VarCon,
    Keyword::VarVar,       Keyword::Mif};

/// The places of a block's words: the opening brackets of its settings.
struct BlockPlaces {
  const char* body = nullptr;                ///< the keyword of the line with its kind
  std::array<const char*, 5> settings = {};  ///< the settings of that line
  const char* normal = nullptr;              ///< its arrows; in WORD_N next and break
  const char* branch = nullptr;
};

/// The content of a motion file: the format contains only what the model holds.
struct FlowFile {
  PoseFlow flow;
  std::vector<BlockPlaces> places;  ///< one per block
  const char* start = nullptr;      ///< the first line; null: it does not specify the format
  bool is_whole = true;             ///< every line and arrow could be read
  bool has_blank_lines = false;     ///< before its first block
};

/// Operations and conditions are numbered in this order.
inline constexpr int kNumOperations = 5;
inline constexpr int kNumConditions = 8;

}  // namespace kinefile::robovie
