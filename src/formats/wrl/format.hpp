// SPDX-License-Identifier: MIT
#pragma once

#include "kinefile/format.hpp"

namespace kinefile::wrl {

/// Robot models of OpenHRP in VRML97 (.wrl), read only. See docs/formats/body.md.
Format format();

}  // namespace kinefile::wrl
