// SPDX-License-Identifier: MIT
#pragma once

#include "formats/choreonoid/syntax.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"

namespace kinefile::choreonoid {

/// Keys of what a document's extras keep of a .seq file, and of a component's.
namespace extra {
inline constexpr char kVersion[] = "version";    ///< "2"; empty where the file says none
inline constexpr char kSpelling[] = "keys";      ///< "snake_case" or "camelCase"
inline constexpr char kStyle[] = "style";        ///< "block" or "json"
inline constexpr char kComments[] = "comments";  ///< there where the file has some
inline constexpr char kUnknownKeys[] = "unknown_keys";
inline constexpr char kType[] = "type";
inline constexpr char kContent[] = "content";
inline constexpr char kPoseFormat[] = "se3_format";
inline constexpr char kText[] = "text";
}  // namespace extra

/// What a .seq file means. \param fps  instead of the rates that it says
BodyMotion bind(SeqFile&& file, std::optional<double> fps, Extras& extras);

/// What its content is called here, whatever the format version calls it.
std::string_view usual_content(const SeqComponent& component);

/// The word for an order of a pose's numbers, "XYZRPY".
std::string_view word_of(PoseOrder order);

}  // namespace kinefile::choreonoid
