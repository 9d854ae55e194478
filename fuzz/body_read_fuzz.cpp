// SPDX-License-Identifier: MIT
// Any bytes as a robot of Choreonoid's: no crash, no hang, and either a valid skeleton or an error
// with a place. What stands before a zero byte, if there is one, is every file that it names.

#include <memory>

#include "checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  using namespace kinefile::fuzz;
  std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ReadOptions options;
  options.source_name = "t.body";
  const std::size_t border = bytes.find('\0');
  if (border != std::string_view::npos) {
    const auto other = std::make_shared<const std::string>(bytes.substr(0, border));
    bytes.remove_prefix(border + 1);
    options.companions.open = [other](const std::string& name) {
      return std::optional(CompanionFile{name, *other, other});
    };
  }
  Diagnostics diagnostics;
  const auto document = find_format("body")->read(bytes, options, diagnostics);
  check_reading(document, diagnostics);
  if (document) check_document(*document);
  return 0;
}
