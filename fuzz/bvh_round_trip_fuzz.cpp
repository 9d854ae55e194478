// SPDX-License-Identifier: MIT
// Whatever reads is written so that it reads the same, bit for bit, and is written the same again.
// Whatever can become bones is the same motion then.

#include "checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  using namespace kinefile::fuzz;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const ReadOptions options = {.lenient = true};
  Diagnostics diagnostics;
  const auto first = find_format("bvh")->read(bytes, options, diagnostics);
  if (!first) return 0;
  const std::string text = written(*first, "bvh");
  Diagnostics second_diagnostics;
  const auto second = find_format("bvh")->read(text, options, second_diagnostics);
  require(second.has_value());
  require(written(*second, "bvh") == text);
  require(second->content.index() == first->content.index());
  const Motion* a = std::get_if<Motion>(&first->content);
  const Motion* b = std::get_if<Motion>(&second->content);
  if (a == nullptr) return 0;
  require(a->clip.num_frames == b->clip.num_frames);
  require(same_values(a->clip.values, b->clip.values));
  Diagnostics ignored;
  const auto bones = adapted_to(*find_format("amc"), *first, {.lenient = true}, ignored);
  if (!bones) return 0;
  check_document(*bones);
  written(*bones, "asf");
  const double rate = frame_rate(std::get<Motion>(bones->content).clip.timeline);
  if (rate >= 1e-9 && rate <= 1e9) written(*bones, "amc");  // others are refused
  return 0;
}
