// SPDX-License-Identifier: MIT
#pragma once

// The diagnostics of the BVH reader and writer. docs/errors.md gives the cause and cure of each;
// tests/formats/bvh/invalid has a file and its message for each.

namespace kinefile::bvh::code {

inline constexpr char kNotBvh[] = "BVH001";
inline constexpr char kUnexpectedEnd[] = "BVH002";
inline constexpr char kUnexpectedWord[] = "BVH003";
inline constexpr char kNoName[] = "BVH004";
inline constexpr char kBadOffset[] = "BVH005";
inline constexpr char kNoOffset[] = "BVH006";
inline constexpr char kGivenTwice[] = "BVH007";
inline constexpr char kBadChannelCount[] = "BVH008";
inline constexpr char kChannelCountDiffers[] = "BVH009";
inline constexpr char kUnknownChannel[] = "BVH010";
inline constexpr char kNoChannels[] = "BVH011";
inline constexpr char kTooDeep[] = "BVH012";
inline constexpr char kExtraBrace[] = "BVH013";
inline constexpr char kNoHierarchyWord[] = "BVH014";
inline constexpr char kComment[] = "BVH015";
inline constexpr char kRepeatedName[] = "BVH016";
inline constexpr char kNoMotionWord[] = "BVH017";
inline constexpr char kNoMotion[] = "BVH018";
inline constexpr char kBadFrames[] = "BVH019";
inline constexpr char kFramesNotWhole[] = "BVH020";
inline constexpr char kNoFrames[] = "BVH021";
inline constexpr char kBadFrameTime[] = "BVH022";
inline constexpr char kNoFrameTime[] = "BVH023";
inline constexpr char kDecimalComma[] = "BVH024";
inline constexpr char kNotANumber[] = "BVH025";
inline constexpr char kOutOfRange[] = "BVH026";
inline constexpr char kNotFinite[] = "BVH027";
inline constexpr char kRowLength[] = "BVH028";
inline constexpr char kReadAsStream[] = "BVH029";
inline constexpr char kMoreRows[] = "BVH030";
inline constexpr char kFewerRows[] = "BVH031";
inline constexpr char kImpossibleCount[] = "BVH032";
inline constexpr char kTextAfterFrames[] = "BVH033";
inline constexpr char kPositionsChosen[] = "BVH034";
inline constexpr char kPositionsDoubtful[] = "BVH035";
inline constexpr char kNotExpressible[] = "BVH036";
inline constexpr char kPositionsAdded[] = "BVH037";
inline constexpr char kUnusualFrameTime[] = "BVH038";
inline constexpr char kChannelTwice[] = "BVH039";

}  // namespace kinefile::bvh::code
