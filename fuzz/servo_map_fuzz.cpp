// SPDX-License-Identifier: MIT
// Any bytes as a servo map: no crash, no hang, and either a map that reads the same again once it
// is written, or an error with a place.

#include "checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  using namespace kinefile::fuzz;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Diagnostics diagnostics;
  const auto map = parse_servo_map(text, "t.yaml", diagnostics);
  require(map.has_value() == !diagnostics.has_errors());
  for (const Diagnostic& item : diagnostics.items()) require(item.place.line > 0);
  if (!map) return 0;
  const std::string yaml = to_yaml(*map);
  Diagnostics again;
  const auto same = parse_servo_map(yaml, "again.yaml", again);
  require(same.has_value() && again.items().empty() && to_yaml(*same) == yaml);
  return 0;
}
