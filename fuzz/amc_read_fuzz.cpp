// SPDX-License-Identifier: MIT
// Any bytes as a motion: no crash, no hang, and either a valid motion or an error with a place.
// What reads is written so that it reads the same, bit for bit. The skeleton is what stands before
// a zero byte, if there is one, else a fixed one.

#include <memory>

#include "checks.hpp"
#include "pieces.hpp"

namespace {

constexpr char kArm[] =
    ":version 1.10\n:root\norder TX TY TZ RX RY RZ\naxis XYZ\n:bonedata\n"
    "begin id 1 name upper direction 0 1 0 length 2 axis 0 0 90 XYZ dof rx ry rz end\n"
    "begin id 2 name lower direction 1 0 0 length 3 axis 0 0 0 XYZ dof rz end\n"
    ":hierarchy\nbegin\nroot upper\nupper lower\nend\n";

kinefile::Resolver resolver_of(const std::string& skeleton) {
  kinefile::Resolver resolver;
  resolver.open = [skeleton](const std::string& name) {
    const auto owner = std::make_shared<const std::string>(skeleton);
    return std::optional(kinefile::CompanionFile{name, *owner, owner});
  };
  return resolver;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinefile;
  using namespace kinefile::fuzz;
  if (size == 0) return 0;
  std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  std::string skeleton = kArm;
  const std::size_t border = bytes.find('\0');
  if (border != std::string_view::npos) {
    skeleton = bytes.substr(0, border);
    bytes.remove_prefix(border + 1);
  }
  ReadOptions options;
  options.source_name = "t.amc";
  options.lenient = (data[0] & 1) != 0;
  if ((data[0] & 2) != 0) options.fps = 25;
  options.companions = resolver_of(skeleton);
  Diagnostics diagnostics;
  const auto document = find_format("amc")->read(bytes, options, diagnostics);
  check_reading(document, diagnostics);
  check_pieces("amc", bytes, options, document, diagnostics);
  if (!document) return 0;
  check_document(*document);
  const std::string text = written(*document, "amc");
  options.companions = resolver_of(written(*document, "asf"));
  Diagnostics again;
  const auto second = find_format("amc")->read(text, options, again);
  require(second.has_value());
  require(same_values(std::get<Motion>(document->content).clip.values,
                      std::get<Motion>(second->content).clip.values));
  require(written(*second, "amc") == text);
  return 0;
}
