// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "kinefile/format.hpp"
#include "text/decode.hpp"

namespace kinefile::robovie {

/// Decodes a file of RobovieMaker: without a byte order mark or valid UTF-8 it is code page 932.
/// Bytes that are not characters are errors; with --lenient they become U+FFFD.
Result<text::DecodedText> decode_motion(std::string_view bytes,
                                        const kinefile::ReadOptions& options,
                                        Diagnostics& diagnostics);

}  // namespace kinefile::robovie
