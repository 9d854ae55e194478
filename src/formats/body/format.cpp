// SPDX-License-Identifier: MIT
#include "formats/body/format.hpp"

#include <fmt/format.h>

#include <array>

#include "formats/body/codes.hpp"
#include "formats/body/files.hpp"
#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "text/numbers.hpp"
#include "text/yaml/top_entries.hpp"

namespace kinefile::body {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".body"};
constexpr std::array<ReadOption, 2> kReadOptions = {options::kEncoding, options::kModelRoot};

/// Whether this character can be between a key and its value, in YAML's two styles.
bool joins_key_and_value(char c) { return text::is_blank(c) || c == ':' || c == '"' || c == '\''; }

/// Whether a text names its format at the start of a line or of a mapping.
bool names_format(std::string_view view) {
  constexpr std::string_view kKey = "format";
  for (std::size_t at = view.find("ChoreonoidBody"); at != std::string_view::npos;
       at = view.find("ChoreonoidBody", at + 1)) {
    std::string_view before = view.substr(0, at);
    while (!before.empty() && joins_key_and_value(before.back())) before.remove_suffix(1);
    if (!before.ends_with(kKey)) continue;
    before.remove_suffix(kKey.size());
    while (!before.empty() && joins_key_and_value(before.back())) before.remove_suffix(1);
    if (before.empty() || text::is_line_end(before.back()) || before.back() == '{') return true;
  }
  return false;
}

/// Whether a text is a wrapper of a model file, whatever its extension: older ones are .yaml files.
bool is_wrapper(std::string_view view) {
  const auto is_model_file = [](std::string_view key) {
    return key == "modelFile" || key == "model_file";
  };
  // Most texts need not be parsed.
  if (view.find("modelFile") == std::string_view::npos &&
      view.find("model_file") == std::string_view::npos) {
    return false;
  }
  bool names_model = false;
  bool is_other = false;
  text::yaml::visit_top_entries(view, [&](std::string_view key, std::string_view value) {
    names_model = names_model || (is_model_file(key) && !value.empty());
    is_other = key == "type" || key == "components" || key == "format";
    return !is_other;
  });
  return names_model && !is_other;
}

bool probe(std::string_view head) {
  Diagnostics ignored;
  const auto decoded = text::decode(head, {}, {}, ignored);
  return decoded && (names_format(decoded->view()) || is_wrapper(decoded->view()));
}

/// Reads the model of another format that a wrapper names.
Result<Document> read_other(const Wrapped& wrapped, Files& files) {
  const auto companion = files.find(wrapped.other_name, wrapped.spot);
  if (!companion) return fail(files.diagnostics().first_error());
  ReadOptions options;
  options.source_name = companion->name;
  options.lenient = files.options().lenient;
  auto document = wrapped.other_format->read(companion->bytes, options, files.diagnostics());
  if (!document) return document;
  // It must be a robot, not any skeleton.
  if (document->kept.get<robot_file::KeptFile>() != nullptr) return document;
  wrapped.spot.report(
      files.diagnostics(), Severity::Error, code::kNotABody,
      fmt::format("expected a robot model, found {}", wrapped.other_format->description));
  return fail(files.diagnostics().first_error());
}

Result<Document> read_alone(std::string_view bytes, const ReadOptions& options,
                            Diagnostics& diagnostics) {
  Files files(options, diagnostics);
  const File* first = files.read_first(bytes);
  Result<Document> result = Document();
  const Wrapped wrapped = follow_wrappers(first, files);
  if (wrapped.other_format != nullptr) {
    result = read_other(wrapped, files);
  } else {
    const robot_file::Robot* robot =
        wrapped.file == nullptr
            ? nullptr
            : files.robot(*wrapped.file, {wrapped.file->source.get(), wrapped.file->root().at});
    auto document = robot == nullptr
                        ? std::nullopt
                        : robot_file::document_of(*robot, "body", code::kRobot, diagnostics);
    if (document) result = std::move(*document);
  }
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  result->format = "body";
  robot_file::keep_layout(*result, layout_of(first->decoded));
  return result;
}

Result<Document> read(std::string_view bytes, const ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

}  // namespace

Format format() {
  Format format;
  format.name = "body";
  format.description = "Choreonoid robot model";
  format.extensions = kExtensions;
  format.probe = probe;
  format.read = read;
  format.facts = robot_file::facts;
  format.read_options = kReadOptions;
  return format;
}

}  // namespace kinefile::body
