// SPDX-License-Identifier: MIT
#include "formats/robovie/syntax.hpp"

namespace kinefile::robovie {
namespace {

constexpr std::array<std::string_view, 1> kFormatSettings = {"format"};
constexpr std::array<std::string_view, 1> kAxisSettings = {"number of sliders"};
constexpr std::array<std::string_view, 7> kInfoSettings = {
    "name", "x", "y", "normal turn", "branch turn", "normal", "branch"};
constexpr std::array<std::string_view, 5> kWordNSettings = {"time", "words", "next", "break",
                                                            "sound"};
constexpr std::array<std::string_view, 4> kPoseSettings = {"time", "words", "sound", "servo mask"};
constexpr std::array<std::string_view, 3> kVarConSettings = {"variable", "operation", "constant"};
constexpr std::array<std::string_view, 3> kVarVarSettings = {"variable", "operation",
                                                             "other variable"};
constexpr std::array<std::string_view, 3> kMifSettings = {"variable", "condition", "detail"};

}  // namespace

KeywordRow row_of(Keyword keyword, FlowFormat format) {
  switch (keyword) {
    case Keyword::MotionFormat:
      return {"_MOTION_FORMAT", kFormatSettings};
    case Keyword::EnableAxis:
      return {"_ENABLE_AXIS", kAxisSettings};
    case Keyword::MotionInfo:
      return {"_MOTION_INFO", kInfoSettings};
    case Keyword::StartMot:
      return {"_STARTMOT", {}};
    case Keyword::EndMot:
      return {"_ENDMOT", {}};
    case Keyword::OldLoop:
      return {"_OLDLOOP", {}};
    case Keyword::VarCon:
      return {"_VARCON", kVarConSettings};
    case Keyword::VarVar:
      return {"_VARVAR", kVarVarSettings};
    case Keyword::Mif:
      return {"_MIF", kMifSettings};
    case Keyword::Pose:
      break;
  }
  if (format == FlowFormat::WordN) return {"_POSE", kWordNSettings};
  return {"_POSE", kPoseSettings};
}

}  // namespace kinefile::robovie
