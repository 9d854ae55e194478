// SPDX-License-Identifier: MIT
// Any text as YAML: our parser and libyaml find the same events at the same places, or both find a
// fault; and rows of numbers that are taken as a whole say what they say one by one.

#include <cstdint>

#include "checks.hpp"
#include "support/yaml_events.hpp"
#include "text/decode.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  using namespace kinefile::test;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  Diagnostics diagnostics;
  const auto decoded = text::decode(bytes, "utf-8", {}, diagnostics);
  if (!decoded || !diagnostics.items().empty()) return 0;
  const std::string_view text = decoded->view();
  bool is_refused = false;
  const auto events = yaml_events(text, {}, &is_refused);
  if (is_refused) return 0;
  fuzz::require(events == libyaml_events(text));
  fuzz::require(yaml_events(text, {.takes_rows = true, .has_numbers = true}) ==
                yaml_events(text, {.takes_rows = false, .has_numbers = true}));
  return 0;
}
