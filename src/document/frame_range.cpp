// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "kinefile/operation.hpp"
#include "text/option_words.hpp"

namespace kinefile {

std::optional<FrameRange> parse_range(const std::string& text, std::size_t num_frames) {
  std::vector<std::string> parts = words::split(text, ':');
  if (!text.empty() && text.back() == ':' && parts.size() < 2) parts.emplace_back();
  FrameRange range{0, num_frames, 1};
  if (text.empty()) return range;
  if (parts.size() == 1) {  // one frame
    const auto frame = words::integer<std::size_t>(parts[0]);
    if (!frame || *frame >= num_frames) return std::nullopt;
    return FrameRange{*frame, *frame + 1, 1};
  }
  if (parts.size() > 3 || parts.empty()) return std::nullopt;
  const std::array<std::size_t*, 3> numbers = {&range.begin, &range.end, &range.step};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    if (part.empty() && i < 2) continue;
    const auto number = words::integer<std::size_t>(part);
    if (!number) return std::nullopt;
    *numbers[i] = *number;
  }
  const bool is_inside = range.begin <= range.end && range.end <= num_frames && range.step > 0;
  if (!is_inside) return std::nullopt;
  range.step = std::min(range.step, num_frames + 1);  // a longer step gives the first frame, too
  return range;
}

}  // namespace kinefile
