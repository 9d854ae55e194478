// SPDX-License-Identifier: MIT
// make_walk OUT [FRAMES [RATE]]: writes a person's walk in the format that OUT's name shows.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "kinefile/kinefile.hpp"
#include "walk.hpp"

int main(int argc, char** argv) {
  kinefile::examples::WalkOptions walk;
  if (argc > 2) walk.num_frames = std::strtoull(argv[2], nullptr, 10);
  if (argc > 3) walk.frame_rate = std::strtod(argv[3], nullptr);
  const kinefile::Format* format = argc > 1 ? kinefile::format_of_name(argv[1]) : nullptr;
  if (argc < 2 || argc > 4 || format == nullptr || !(walk.frame_rate > 0)) {
    std::fputs("usage: make_walk OUT [FRAMES [RATE]]\n", stderr);
    return 2;
  }
  kinefile::Document document;
  document.content = kinefile::examples::make_walk(walk);
  kinefile::Diagnostics diagnostics;
  auto adapted = kinefile::adapted_to(*format, std::move(document), {}, diagnostics);
  kinefile::Result<void> written;
  if (adapted) {
    written =
        kinefile::write_file(argv[1], *adapted, *format, {}, {.may_replace = true}, diagnostics);
  } else {
    written = kinefile::fail(std::move(adapted.error()));
  }
  if (written) return 0;
  std::fprintf(stderr, "%s\n", kinefile::to_string(written.error()).c_str());
  return 1;
}
