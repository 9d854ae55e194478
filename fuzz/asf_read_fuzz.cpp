// SPDX-License-Identifier: MIT
// Any bytes as a skeleton, read with any options: no crash, no hang, and either a valid skeleton or
// an error with a place. What reads is written so that it reads, and is written, the same again.

#include "checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  using namespace kinefile::fuzz;
  if (size == 0) return 0;
  ReadOptions options;
  options.lenient = (data[0] & 1) != 0;
  if ((data[0] & 2) != 0) options.metres_per_unit = 0.01;
  Diagnostics diagnostics;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto document = find_format("asf")->read(bytes, options, diagnostics);
  check_reading(document, diagnostics);
  if (!document) return 0;
  check_document(*document);
  const std::string text = written(*document, "asf");
  Diagnostics again;
  const auto second = find_format("asf")->read(text, options, again);
  require(second.has_value());
  require(written(*second, "asf") == text);
  return 0;
}
