// SPDX-License-Identifier: MIT
#pragma once

#include "formats/acclaim/syntax.hpp"
#include "kinefile/document.hpp"

namespace kinefile::acclaim {

/// What the model does not hold of a skeleton: words for `asf_of_extras`.
Extras extras_of(const AsfFile& file);

/// What is kept of the file that a skeleton was read from: everything but the bones, and of each
/// bone what its words say. Bones stand in no order and have no parents.
AsfFile asf_of_extras(const Extras& extras);

/// Reads one bone's words back; faulty or missing ones are left out.
Bone bone_of_extras(const std::string& name, const std::map<std::string, std::string>& words);

}  // namespace kinefile::acclaim
