// SPDX-License-Identifier: MIT
// Any bytes, read with any options: no crash, no hang, and either a valid document or an error
// with a place.

#include "checks.hpp"
#include "kinefile/bvh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  using namespace kinefile::fuzz;
  if (size == 0) return 0;
  ReadOptions options;
  options.lenient = (data[0] & 1) != 0;
  options.of_formats.edit<bvh::ReadOptions>().positions =
      static_cast<bvh::PositionMode>((data[0] >> 1) % 3);
  constexpr const char* kEncodings[] = {"", "utf-8", "cp932", "utf-16le"};
  options.encoding = kEncodings[(data[0] >> 3) % 4];
  if ((data[0] & 64) != 0) options.fps = 25;
  Diagnostics diagnostics;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto document = find_format("bvh")->read(bytes, options, diagnostics);
  check_reading(document, diagnostics);
  if (document) check_document(*document);
  return 0;
}
