// SPDX-License-Identifier: MIT
#include "formats/urdf/format.hpp"

namespace kinefile::urdf {

std::vector<Format> formats() { return {}; }

}  // namespace kinefile::urdf
