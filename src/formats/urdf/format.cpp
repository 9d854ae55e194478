// SPDX-License-Identifier: MIT
#include "formats/urdf/format.hpp"

#include <algorithm>
#include <array>

#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "formats/urdf/codes.hpp"
#include "formats/urdf/parse.hpp"
#include "text/decode.hpp"

namespace kinefile::urdf {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".urdf"};
constexpr std::array<ReadOption, 1> kReadOptions = {options::kEncoding};

/// Skips a part that starts with one word and ends with another; false if there is no such part.
bool skip(std::string_view& text, std::string_view start, std::string_view end) {
  if (!text.starts_with(start)) return false;
  const std::size_t at = text.find(end, start.size());
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + end.size());
  return true;
}

bool probe(std::string_view head) {
  Diagnostics ignored;
  const auto decoded = text::decode(head, {}, {}, ignored);
  if (!decoded) return false;
  std::string_view text = decoded->view();
  do {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  } while (skip(text, "<?", "?>") || skip(text, "<!--", "-->"));
  constexpr std::string_view kRoot = "<robot";
  return text.starts_with(kRoot) && text.size() > kRoot.size() &&
         std::string_view(" \t\r\n>").find(text[kRoot.size()]) != std::string_view::npos;
}

Result<Document> read_alone(std::string_view bytes, const ReadOptions& options,
                            Diagnostics& diagnostics) {
  return robot_file::read_text(parse, "urdf", code::kRobot, bytes, options, diagnostics);
}

Result<Document> read(std::string_view bytes, const ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

}  // namespace

std::vector<Format> formats() {
  Format format;
  format.name = "urdf";
  format.description = "Unified Robot Description Format";
  format.extensions = kExtensions;
  format.probe = probe;
  format.read = read;
  format.facts = robot_file::facts;
  format.read_options = kReadOptions;
  return {format};
}

}  // namespace kinefile::urdf
