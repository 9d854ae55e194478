// SPDX-License-Identifier: MIT
#pragma once

/// Codes of RobovieMaker's motions and projects; docs/errors.md has a section on each.
namespace kinefile::robovie::code {

inline constexpr char kNotAMotion[] = "RBV001";
inline constexpr char kUnknownFormat[] = "RBV002";
inline constexpr char kUnknownKeyword[] = "RBV003";
inline constexpr char kFullWidth[] = "RBV004";
inline constexpr char kPunctuation[] = "RBV005";
inline constexpr char kNumSettings[] = "RBV006";
inline constexpr char kSingleBrackets[] = "RBV007";
inline constexpr char kDoubledBrackets[] = "RBV008";
inline constexpr char kNotANumber[] = "RBV009";
inline constexpr char kBadAxis[] = "RBV010";
inline constexpr char kNoAxis[] = "RBV011";
inline constexpr char kHeaderAgain[] = "RBV012";
inline constexpr char kOtherFormat[] = "RBV013";
inline constexpr char kNumWords[] = "RBV014";
inline constexpr char kBadWord[] = "RBV015";
inline constexpr char kBadTime[] = "RBV016";
inline constexpr char kNoSuchBlock[] = "RBV017";
inline constexpr char kPoseToItself[] = "RBV018";
inline constexpr char kBadMask[] = "RBV019";
inline constexpr char kNotOneStart[] = "RBV020";
inline constexpr char kNoBody[] = "RBV021";
inline constexpr char kNoInfo[] = "RBV022";
inline constexpr char kBadOperation[] = "RBV023";
inline constexpr char kBadCondition[] = "RBV024";
inline constexpr char kBadVariable[] = "RBV025";
inline constexpr char kBadConstant[] = "RBV026";
inline constexpr char kBadPosition[] = "RBV027";
inline constexpr char kNeedlessBranch[] = "RBV028";
inline constexpr char kDivisionByZero[] = "RBV029";
inline constexpr char kNoPose[] = "RBV030";
inline constexpr char kNoEnd[] = "RBV031";
inline constexpr char kUnreachable[] = "RBV032";
inline constexpr char kDeadEnd[] = "RBV033";
inline constexpr char kEndlessCycle[] = "RBV034";
inline constexpr char kCycleWithoutPose[] = "RBV035";
inline constexpr char kNoBranch[] = "RBV036";
inline constexpr char kBlockToItself[] = "RBV037";
inline constexpr char kUndefined[] = "RBV038";
inline constexpr char kNoBits[] = "RBV039";
inline constexpr char kNeedlessDetail[] = "RBV040";
inline constexpr char kReadOnly[] = "RBV041";
inline constexpr char kSoundPath[] = "RBV042";
inline constexpr char kUnknownSound[] = "RBV043";
inline constexpr char kDisabledSlider[] = "RBV044";
inline constexpr char kBeyondLimits[] = "RBV045";
inline constexpr char kOffStep[] = "RBV046";
inline constexpr char kTooFast[] = "RBV047";
inline constexpr char kOtherEncoding[] = "RBV048";
inline constexpr char kLastSliders[] = "RBV049";
inline constexpr char kFewWords[] = "RBV050";
inline constexpr char kSpelling[] = "RBV051";
inline constexpr char kCannotEncode[] = "RBV052";
inline constexpr char kCannotWrite[] = "RBV053";

inline constexpr char kNotAProject[] = "RPJ001";
inline constexpr char kNoSliders[] = "RPJ002";
inline constexpr char kMissingFile[] = "RPJ003";
inline constexpr char kBadSetting[] = "RPJ004";
inline constexpr char kBadNumber[] = "RPJ005";
inline constexpr char kBadPair[] = "RPJ006";
inline constexpr char kMissingSound[] = "RPJ007";

}  // namespace kinefile::robovie::code
