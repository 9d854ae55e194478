// SPDX-License-Identifier: MIT
// Whatever reads is written so that it reads the same, bit for bit, and is written the same again.

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "kinefile/kinefile.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

std::string written(const kinefile::Document& document) {
  std::string text;
  kinefile::Diagnostics diagnostics;
  const auto result = kinefile::find_format("bvh")->write(
      document, {},
      [&text](std::string_view piece) {
        text += piece;
        return true;
      },
      diagnostics);
  require(result.has_value());
  return text;
}

/// The same double, but for what kind of NaN it is.
bool is_same(double a, double b) {
  return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const ReadOptions options = {.lenient = true};
  Diagnostics diagnostics;
  const auto first = find_format("bvh")->read(bytes, options, diagnostics);
  if (!first) return 0;
  const std::string text = written(*first);
  Diagnostics second_diagnostics;
  const auto second = find_format("bvh")->read(text, options, second_diagnostics);
  require(second.has_value());
  require(written(*second) == text);
  require(second->content.index() == first->content.index());
  const Motion* a = std::get_if<Motion>(&first->content);
  const Motion* b = std::get_if<Motion>(&second->content);
  if (a == nullptr) return 0;
  require(a->clip.num_frames == b->clip.num_frames);
  require(a->clip.values.size() == b->clip.values.size());
  for (std::size_t i = 0; i < a->clip.values.size(); ++i) {
    require(is_same(a->clip.values[i], b->clip.values[i]));
  }
  return 0;
}
