// SPDX-License-Identifier: MIT
#include <utility>

#include "kinefile/convert.hpp"
#include "kinefile/io.hpp"

namespace kinefile {

Result<Motion> read_motion(const std::string& path, Diagnostics& diagnostics,
                           const ReadOptions& options) {
  auto document = read_file(path, nullptr, options, diagnostics);
  if (!document) return fail(std::move(document.error()));
  if (Motion* motion = std::get_if<Motion>(&document->content)) return std::move(*motion);
  if (const BodyMotion* body = std::get_if<BodyMotion>(&document->content)) {
    return robot::motion_of_links(*body);
  }
  Error error = wrong_kind(*document, "a motion");
  error.place.source = path;
  return fail(std::move(error));
}

}  // namespace kinefile
