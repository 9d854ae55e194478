// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "kinefile/result.hpp"

namespace kinefile::cli {

/// A picture that a page is asked for.
struct Picture {
  int width = 1280;  ///< in pixels
  int height = 720;
  std::string frames;  ///< A:B or A:B:STEP for a sheet of frames; empty: the page chooses
};

/// Shows a page in a Chromium browser without a window, and asks it for a picture: the promise of
/// `kinefile.picture({width, height, frames})` gives a PNG as base64.
/// \param page  its HTML
/// \returns the bytes of the PNG
/// \errors PAG002 (Io) if there is no such browser on the path; PAG003 (Io) if the browser ends,
///         takes more than two minutes, or is interrupted; PAG004 (Io) with the page's own words if
///         it makes no picture; IO003 if the page cannot be written to a temporary file
Result<std::string> picture_of(std::string_view page, const Picture& picture);

}  // namespace kinefile::cli
