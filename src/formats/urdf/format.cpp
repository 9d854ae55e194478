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

/// The name of the first element; empty if there is none.
std::string root_element(std::string_view head) {
  Diagnostics ignored;
  const auto decoded = text::decode(head, {}, {}, ignored);
  if (!decoded) return {};
  std::string_view text = decoded->view();
  do {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  } while (skip(text, "<?", "?>") || skip(text, "<!--", "-->") || skip(text, "<!DOCTYPE", ">"));
  if (!text.starts_with('<')) return {};
  text.remove_prefix(1);
  const std::size_t end = text.find_first_of(" \t\r\n/>");
  return end == std::string_view::npos ? std::string() : std::string(text.substr(0, end));
}

bool probe(std::string_view head) { return root_element(head) == "robot"; }

constexpr std::array<ForeignFormat, 1> kForeign = {{
    {".sdf", [](std::string_view head) { return root_element(head) == "sdf"; },
     "SDFormat, which describes models and worlds for Gazebo; give the robot's URDF, or convert "
     "the model with a tool such as sdf2urdf"},
}};

Result<Document> read_alone(std::string_view bytes, const ReadOptions& options,
                            Diagnostics& diagnostics) {
  return robot_file::read_text(parse, "urdf", code::kRobot, bytes, options, diagnostics);
}

Result<Document> read(std::string_view bytes, const ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

}  // namespace

Format format() {
  Format format;
  format.name = "urdf";
  format.description = "Unified Robot Description Format";
  format.extensions = kExtensions;
  format.probe = probe;
  format.foreign = kForeign;
  format.read = read;
  format.facts = robot_file::facts;
  format.read_options = kReadOptions;
  return format;
}

}  // namespace kinefile::urdf
