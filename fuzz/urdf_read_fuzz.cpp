// SPDX-License-Identifier: MIT
// Any bytes as a robot in URDF: no crash, no hang, and either a valid skeleton or an error with a
// place.

#include "checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  using namespace kinefile::fuzz;
  Diagnostics diagnostics;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto document = find_format("urdf")->read(bytes, {}, diagnostics);
  check_reading(document, diagnostics);
  if (document) check_document(*document);
  return 0;
}
