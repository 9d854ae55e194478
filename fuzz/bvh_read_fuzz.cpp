// SPDX-License-Identifier: MIT
// Any bytes, read with any options: no crash, no hang, and either a valid document or an error
// with a place. What can be read by pieces gives the same as whole.

#include <algorithm>
#include <span>
#include <string_view>

#include "checks.hpp"
#include "kinefile/bvh.hpp"
#include "pieces.hpp"

namespace {

using namespace kinefile;
using namespace kinefile::fuzz;

/// The same for frames that are read when they are asked for: all of them, and those from one on.
void check_frames(std::string_view bytes, const ReadOptions& options, const Result<Document>& whole,
                  const Diagnostics& of_whole) {
  Diagnostics diagnostics;
  const auto found = find_format("bvh")->open_frames(source_of(bytes), 0, options, diagnostics);
  if (!found) return;
  require(whole.has_value());
  check_messages(diagnostics, of_whole);
  const Clip& clip = std::get<Motion>(whole->content).clip;
  const std::size_t num_frames = found->frames.num_frames;
  require(num_frames == clip.num_frames && found->frames.num_coordinates == clip.num_coordinates);
  for (const std::size_t first : {std::size_t{0}, num_frames / 2}) {
    const auto rows = found->frames.rows(first, num_frames - first);
    const std::span<const double> values = clip.values;
    require(rows && same_values(*rows, values.subspan(first * clip.num_coordinates)));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
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
  check_pieces("bvh", bytes, options, document, diagnostics);
  check_frames(bytes, options, document, diagnostics);
  if (document) check_document(*document);
  return 0;
}
