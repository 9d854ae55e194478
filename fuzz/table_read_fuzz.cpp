// SPDX-License-Identifier: MIT
// Any bytes as a CSV table or as an hrpsys set: no crash, no hang, and either components or errors
// with places; components that are written and read again are the same numbers.

#include <algorithm>
#include <iterator>
#include <vector>

#include "checks.hpp"
#include "pieces.hpp"

namespace {

using namespace kinefile;
using namespace kinefile::fuzz;

constexpr std::string_view kParts[] = {".pos", ".waist", ".hip", ".zmp"};

/// The files of a set, one behind the other, with a zero between them.
Resolver set_of(std::string_view bytes) {
  Resolver resolver;
  resolver.open = [bytes](const std::string& name) -> std::optional<CompanionFile> {
    std::string_view rest = bytes;
    for (const std::string_view part : kParts) {
      const std::size_t end = rest.find('\0');
      if (name == "a" + std::string(part)) return CompanionFile{name, rest.substr(0, end), nullptr};
      if (end == std::string_view::npos) return std::nullopt;
      rest = rest.substr(end + 1);
    }
    return std::nullopt;
  };
  return resolver;
}

void read_set(std::string_view bytes, ReadOptions options) {
  options.companions = set_of(bytes);
  options.source_name = "a.pos";
  const auto first = options.companions.open("a.pos");
  Diagnostics diagnostics;
  const auto document = find_format("hrpsys")->read(first->bytes, options, diagnostics);
  check_reading(document, diagnostics);
  if (!document) return;
  check_document(*document);
  const auto open = [](std::string_view part) -> Result<Sink> {
    require(std::find(std::begin(kParts), std::end(kParts), part) != std::end(kParts));
    return Sink([](std::string_view) { return true; });
  };
  require(find_format("hrpsys")->write_set(*document, {}, open, diagnostics).has_value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  ReadOptions options;
  if ((data[0] & 2) != 0) options.fps = 25;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if ((data[0] & 1) != 0) {
    read_set(bytes, options);
    return 0;
  }
  Diagnostics diagnostics;
  const auto document = find_format("csv")->read(bytes, options, diagnostics);
  check_reading(document, diagnostics);
  check_pieces("csv", bytes, options, document, diagnostics);
  if (document) check_document(*document);
  return 0;
}
