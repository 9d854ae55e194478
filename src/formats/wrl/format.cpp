// SPDX-License-Identifier: MIT
#include "formats/wrl/format.hpp"

#include <array>

#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "formats/wrl/codes.hpp"
#include "formats/wrl/lexer.hpp"
#include "formats/wrl/parse.hpp"

namespace kinefile::wrl {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".wrl"};
constexpr std::array<ReadOption, 1> kReadOptions = {options::kEncoding};

bool probe(std::string_view head) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (head.starts_with(kByteOrderMark)) head.remove_prefix(kByteOrderMark.size());
  return !find_header(head).empty();
}

Result<Document> read_alone(std::string_view bytes, const ReadOptions& options,
                            Diagnostics& diagnostics) {
  return robot_file::read_text(parse, "wrl", code::kRobot, bytes, options, diagnostics);
}

Result<Document> read(std::string_view bytes, const ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

}  // namespace

Format format() {
  Format format;
  format.name = "wrl";
  format.description = "OpenHRP robot model in VRML97";
  format.extensions = kExtensions;
  format.probe = probe;
  format.read = read;
  format.facts = robot_file::facts;
  format.read_options = kReadOptions;
  return format;
}

}  // namespace kinefile::wrl
