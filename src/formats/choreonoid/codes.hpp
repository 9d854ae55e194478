// SPDX-License-Identifier: MIT
#pragma once

/// Codes of the .seq format's diagnostics; docs/errors.md has a section on each.
namespace kinefile::choreonoid::code {

inline constexpr char kNotABodyMotion[] = "SEQ001";
inline constexpr char kOtherType[] = "SEQ002";
inline constexpr char kBadVersion[] = "SEQ003";
inline constexpr char kNoComponents[] = "SEQ004";
inline constexpr char kUnknownType[] = "SEQ005";
inline constexpr char kOtherContent[] = "SEQ006";
inline constexpr char kUnknownKey[] = "SEQ007";
inline constexpr char kNoRate[] = "SEQ008";
inline constexpr char kBadRate[] = "SEQ009";
inline constexpr char kBadParts[] = "SEQ010";
inline constexpr char kBadBool[] = "SEQ011";
inline constexpr char kNoPoseFormat[] = "SEQ012";
inline constexpr char kBadPoseFormat[] = "SEQ013";
inline constexpr char kNoFrames[] = "SEQ014";
inline constexpr char kBadFrame[] = "SEQ015";
inline constexpr char kNotANumber[] = "SEQ016";
inline constexpr char kNotFinite[] = "SEQ017";
inline constexpr char kChoreonoidRejects[] = "SEQ018";
inline constexpr char kTimeNotAbove[] = "SEQ019";
inline constexpr char kBadTime[] = "SEQ020";
inline constexpr char kSameFrame[] = "SEQ021";
inline constexpr char kNoTimedRate[] = "SEQ022";
inline constexpr char kBeforeFirst[] = "SEQ023";
inline constexpr char kSameComponent[] = "SEQ024";
inline constexpr char kCommentsDropped[] = "SEQ025";
inline constexpr char kRateSnapped[] = "SEQ026";
inline constexpr char kCannotWrite[] = "SEQ027";
inline constexpr char kRateFound[] = "SEQ028";
inline constexpr char kNoRotation[] = "SEQ029";
inline constexpr char kOtherLength[] = "SEQ030";
inline constexpr char kFrameCountDiffers[] = "SEQ031";
inline constexpr char kUnusualRate[] = "SEQ032";

}  // namespace kinefile::choreonoid::code
