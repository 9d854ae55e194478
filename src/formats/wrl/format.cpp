// SPDX-License-Identifier: MIT
#include "formats/wrl/format.hpp"

#include <array>

#include "formats/files.hpp"
#include "formats/wrl/codes.hpp"
#include "formats/wrl/parse.hpp"
#include "text/decode.hpp"

namespace kinefile::wrl {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".wrl"};

bool probe(std::string_view head) {
  return head.starts_with("#VRML") || head.starts_with("\xEF\xBB\xBF#VRML");
}

Result<Document> read_alone(std::string_view bytes, const ReadOptions& options,
                            Diagnostics& diagnostics) {
  auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded) return fail(std::move(decoded.error()));
  const text::Source source(options.source_name, decoded->view());
  const auto robot = parse(source, diagnostics);
  auto document = robot ? robot::document_of(*robot, "wrl", code::kRobot, diagnostics)
                        : std::optional<Document>();
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  document->extras.file["encoding"] = decoded->description();
  document->extras.file["line_end"] = text::line_end_of(decoded->view());
  return std::move(*document);
}

Result<Document> read(std::string_view bytes, const ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

}  // namespace

Format format() {
  return {"wrl", "OpenHRP robot model in VRML97", kExtensions, {}, probe, read, nullptr};
}

}  // namespace kinefile::wrl
