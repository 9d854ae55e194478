// SPDX-License-Identifier: MIT
#pragma once

// The diagnostics of the ASF and AMC readers and writers. docs/errors.md gives the cause and cure
// of each; tests/formats/acclaim/invalid has a file and its message for each.

namespace kinefile::acclaim::code {

inline constexpr char kNotAsf[] = "ASF001";
inline constexpr char kUnexpectedEnd[] = "ASF002";
inline constexpr char kUnexpectedWord[] = "ASF003";
inline constexpr char kNotANumber[] = "ASF004";
inline constexpr char kUnknownSection[] = "ASF005";
inline constexpr char kUnknownWord[] = "ASF006";
inline constexpr char kIncompleteBone[] = "ASF007";
inline constexpr char kRepeatedName[] = "ASF008";
inline constexpr char kRepeatedId[] = "ASF009";
inline constexpr char kBadAxisOrder[] = "ASF010";
inline constexpr char kBadDof[] = "ASF011";
inline constexpr char kLimitsDiffer[] = "ASF012";
inline constexpr char kNotUnitLength[] = "ASF013";
inline constexpr char kUnknownBone[] = "ASF014";
inline constexpr char kTwoParents[] = "ASF015";
inline constexpr char kNotInHierarchy[] = "ASF016";
inline constexpr char kNoSection[] = "ASF017";
inline constexpr char kGivenTwice[] = "ASF018";
inline constexpr char kUnitAssumed[] = "ASF019";
inline constexpr char kNotExpressible[] = "ASF020";
inline constexpr char kBadUnit[] = "ASF021";
inline constexpr char kBadName[] = "ASF022";
inline constexpr char kMotionLeftOut[] = "ASF023";
inline constexpr char kNotSaid[] = "ASF024";
inline constexpr char kNegativeLength[] = "ASF025";
inline constexpr char kSwappedLimits[] = "ASF026";
inline constexpr char kLikeDegrees[] = "ASF027";

inline constexpr char kNoSkeleton[] = "AMC001";
inline constexpr char kSkeletonFound[] = "AMC002";
inline constexpr char kOtherSkeleton[] = "AMC003";
inline constexpr char kUnexpectedLine[] = "AMC004";
inline constexpr char kNoSuchBone[] = "AMC005";
inline constexpr char kValueCount[] = "AMC006";
inline constexpr char kBadValue[] = "AMC007";
inline constexpr char kNotFinite[] = "AMC008";
inline constexpr char kMissingBone[] = "AMC009";
inline constexpr char kBoneTwice[] = "AMC010";
inline constexpr char kFrameNumbers[] = "AMC011";
inline constexpr char kRateAssumed[] = "AMC012";
inline constexpr char kBadHeader[] = "AMC013";
inline constexpr char kUnknownHeader[] = "AMC014";
inline constexpr char kNoFrames[] = "AMC015";
inline constexpr char kUnitChanges[] = "AMC016";
inline constexpr char kNeedsAsf[] = "AMC017";

}  // namespace kinefile::acclaim::code
