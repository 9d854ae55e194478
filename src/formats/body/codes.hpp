// SPDX-License-Identifier: MIT
#pragma once

// The diagnostics of the reader of Choreonoid's robot models. docs/errors.md gives the cause and
// cure of each; tests/formats/body/invalid has a file and its message for each.

#include "formats/robot_file.hpp"

namespace kinefile::body::code {

inline constexpr char kNotABody[] = "BDY001";
inline constexpr char kVersion[] = "BDY002";
inline constexpr char kNoLinks[] = "BDY003";
inline constexpr char kBadValue[] = "BDY004";
inline constexpr char kUnknownWord[] = "BDY005";
inline constexpr char kSkippedNode[] = "BDY006";
inline constexpr char kMissingKey[] = "BDY007";
inline constexpr char kRepeatedName[] = "BDY008";
inline constexpr char kBadParent[] = "BDY009";
inline constexpr char kCircle[] = "BDY010";
inline constexpr char kLargeId[] = "BDY011";
inline constexpr char kRepeatedId[] = "BDY012";
inline constexpr char kNotUnitLength[] = "BDY013";
inline constexpr char kFileNotFound[] = "BDY014";
inline constexpr char kNestedFiles[] = "BDY015";
inline constexpr char kTooManyLinks[] = "BDY016";
inline constexpr char kUnknownKey[] = "BDY017";
inline constexpr char kLeftOutShape[] = "BDY018";

inline constexpr robot_file::Codes kRobot = {kTooManyLinks,  kRepeatedName, kBadParent,
                                             kCircle,        kLargeId,      kRepeatedId,
                                             kNotUnitLength, kLeftOutShape};

}  // namespace kinefile::body::code
