// SPDX-License-Identifier: MIT
#pragma once

// The codes of diagnostics; docs/errors.md gives the cause and cure of each.
namespace kinefile::hrpsys::code {

inline constexpr const char* kNotANumber = "HRP001";
inline constexpr const char* kOtherColumns = "HRP002";
inline constexpr const char* kNotRising = "HRP003";
inline constexpr const char* kNoRate = "HRP004";
inline constexpr const char* kUnknownPart = "HRP005";
inline constexpr const char* kNoRotation = "HRP006";
inline constexpr const char* kNoOrientation = "HRP007";
inline constexpr const char* kNothingToWrite = "HRP008";
inline constexpr const char* kHipDiffers = "HRP009";
inline constexpr const char* kNoRows = "HRP010";
inline constexpr const char* kOtherTimes = "HRP011";
inline constexpr const char* kLateStart = "HRP012";
inline constexpr const char* kNotFinite = "HRP013";
inline constexpr const char* kSpeedsLeftOut = "HRP014";
inline constexpr const char* kGap = "HRP015";
inline constexpr const char* kSlow = "HRP016";
inline constexpr const char* kOddRate = "HRP017";

}  // namespace kinefile::hrpsys::code
