// SPDX-License-Identifier: MIT
#pragma once

// The diagnostics of the URDF reader. docs/errors.md gives the cause and cure of each;
// tests/formats/urdf/invalid has a file and its message for each.

#include "formats/robot_file.hpp"

namespace kinefile::urdf::code {

inline constexpr char kNotUrdf[] = "URD001";
inline constexpr char kMissing[] = "URD002";
inline constexpr char kBadValue[] = "URD003";
inline constexpr char kUnknownType[] = "URD004";
inline constexpr char kRepeatedName[] = "URD005";
inline constexpr char kBadParent[] = "URD006";
inline constexpr char kCircle[] = "URD007";
inline constexpr char kTakenAsFixed[] = "URD008";
inline constexpr char kNotUnitLength[] = "URD009";
inline constexpr char kTooManyLinks[] = "URD010";
inline constexpr char kIgnored[] = "URD011";
inline constexpr char kNoLimit[] = "URD012";
inline constexpr char kBadMimic[] = "URD013";
inline constexpr char kXacro[] = "URD014";
inline constexpr char kQuaternion[] = "URD015";
inline constexpr char kLeftOutShape[] = "URD016";
inline constexpr char kEntity[] = "URD017";

/// Joint ids are counted here, so none is too large and none is repeated.
inline constexpr robot_file::Codes kRobot = {kTooManyLinks,  kRepeatedName, kBadParent,
                                             kCircle,        kTooManyLinks, kTooManyLinks,
                                             kNotUnitLength, kLeftOutShape};

}  // namespace kinefile::urdf::code
