// SPDX-License-Identifier: MIT
#pragma once

// The diagnostics of the reader of OpenHRP's VRML models. docs/errors.md gives the cause and cure
// of each; tests/formats/wrl/invalid has a file and its message for each.

#include "formats/robot_file.hpp"

namespace kinefile::wrl::code {

inline constexpr char kNotAModel[] = "WRL001";
inline constexpr char kUnexpectedEnd[] = "WRL002";
inline constexpr char kUnexpectedWord[] = "WRL003";
inline constexpr char kBadValue[] = "WRL004";
inline constexpr char kUnknownType[] = "WRL005";
inline constexpr char kMissing[] = "WRL006";
inline constexpr char kRepeatedName[] = "WRL007";
inline constexpr char kBadParent[] = "WRL008";
inline constexpr char kLargeId[] = "WRL009";
inline constexpr char kRepeatedId[] = "WRL010";
inline constexpr char kNotUnitLength[] = "WRL011";
inline constexpr char kTooDeep[] = "WRL012";
inline constexpr char kTooManyLinks[] = "WRL013";
inline constexpr char kMisplacedJoint[] = "WRL014";
inline constexpr char kHeader[] = "WRL015";
inline constexpr char kLeftOutShape[] = "WRL016";

/// Joints are nested, so there is no circle.
inline constexpr robot_file::Codes kRobot = {kTooManyLinks,  kRepeatedName, kBadParent,
                                             kBadParent,     kLargeId,      kRepeatedId,
                                             kNotUnitLength, kLeftOutShape};

}  // namespace kinefile::wrl::code
