// SPDX-License-Identifier: MIT
#include "formats/choreonoid/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "formats/choreonoid/bind.hpp"
#include "formats/choreonoid/codes.hpp"
#include "formats/choreonoid/reader.hpp"
#include "formats/choreonoid/unbind.hpp"
#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "text/decode.hpp"
#include "text/yaml/top_entries.hpp"

namespace kinefile::choreonoid {
namespace {

constexpr std::array<std::string_view, 3> kExtensions = {".seq", ".yaml", ".yml"};
constexpr std::array<std::string_view, 3> kRoundings = {"ceil", "floor", "slerp"};
constexpr std::array<std::string_view, 3> kSe3Formats = {"XYZQWQXQYQZ", "XYZQXQYQZQW", "XYZRPY"};
constexpr std::array<std::string_view, 3> kStyles = {"as-is", "yaml", "json"};

constexpr std::array<ReadOption, 4> kReadOptions = {
    options::kFps,
    options::kEncoding,
    words::option<&kinefile::ReadOptions::timed_rounding>({
        .name = "timed-rounding",
        .type = OptionType::Choice,
        .value_name = "HOW",
        .help = "Where frames with times go (.seq): to the first frame at or after their time, the "
                "last at or before it, or none: slerp interpolates",
        .choices = kRoundings,
        .default_word = "ceil",
    }),
    words::option<&kinefile::ReadOptions::keeps_times>({
        .name = "keep-times",
        .type = OptionType::Flag,
        .help = "Leave frames with times at their times (.seq)",
    }),
};

/// An option for writing .seq only.
template <auto Member>
constexpr WriteOption seq_option(const OptionInfo& info) {
  return words::format_option<kinefile::WriteOptions, Member>(info);
}

constexpr std::array<WriteOption, 5> kWriteOptions = {
    seq_option<&choreonoid::WriteOptions::version>({
        .name = "seq-version",
        .type = OptionType::Count,
        .value_name = "N",
        .help = "Format version of a .seq output; else the file's own, or 2",
        .least = 1,
        .most = 4,
    }),
    seq_option<&choreonoid::WriteOptions::se3_format>({
        .name = "se3-format",
        .type = OptionType::Choice,
        .value_name = "FORMAT",
        .help = "How a .seq output writes poses; else as the file does, or XYZQWQXQYQZ",
        .choices = kSe3Formats,
    }),
    seq_option<&choreonoid::WriteOptions::style>({
        .name = "style",
        .type = OptionType::Choice,
        .value_name = "STYLE",
        .help = "Layout of a .seq output: yaml, json (all in flow style), or as the file's",
        .choices = kStyles,
    }),
    seq_option<&choreonoid::WriteOptions::choreonoid_digits>({
        .name = "choreonoid-digits",
        .type = OptionType::Flag,
        .help = "Nine significant digits in a .seq output, as Choreonoid writes",
    }),
    options::kDecimals,
};

constexpr Kinds kWrites = {.body_motions = true};

/// The type at the top of a file; empty if there is none.
std::string type_at_top(std::string_view head) {
  Diagnostics ignored;
  const auto decoded = text::decode(head, {}, {}, ignored);
  std::string type;
  if (!decoded) return type;
  text::yaml::visit_top_entries(decoded->view(),
                                [&type](std::string_view key, std::string_view value) {
                                  if (key == "type") type = value;
                                  return key != "type";
                                });
  return type;
}

bool probe(std::string_view head) {
  const std::string type = type_at_top(head);
  return type == "CompositeSeq" || type == "BodyMotion";
}

constexpr std::array<ForeignFormat, 1> kForeign = {{
    {".pseq", [](std::string_view head) { return type_at_top(head) == "PoseSeq"; },
     "a sequence of Choreonoid's key poses (PoseSeq), between which Choreonoid alone interpolates; "
     "generate its body motion there and save that as .seq"},
}};

/// Reports repeated components: Choreonoid uses the last.
void check_repeated(const Reader& reader, const SeqFile& file) {
  std::set<std::pair<ComponentKind, std::string_view>> seen;
  for (const SeqComponent& component : file.components) {
    if (component.kind == ComponentKind::Other) continue;
    const std::string_view content = usual_content(component);
    if (seen.emplace(component.kind, content).second) continue;
    reader.warn(code::kSameComponent,
                fmt::format("expected one component of content {}, found another; the last one "
                            "counts",
                            text::quoted(content)),
                component.at);
  }
}

/// Reports contents that are kept but not interpreted by kinefile.
void note_contents(const Reader& reader, const SeqFile& file) {
  constexpr std::array<std::string_view, 9> kKnown = {"JointDisplacement",
                                                      "JointPosition",
                                                      "MultiJointDisplacementSeq",
                                                      "LinkPosition",
                                                      "MultiLinkPositionSeq",
                                                      "ZMP",
                                                      "ZMPSeq",
                                                      "RelativeZMP",
                                                      "RelativeZmp"};
  for (const SeqComponent& component : file.components) {
    if (component.kind == ComponentKind::Other) continue;
    const auto known = std::find(kKnown.begin(), kKnown.end(), component.content);
    const auto index = static_cast<std::size_t>(known - kKnown.begin());
    const ComponentKind wanted = index < 3   ? ComponentKind::Values
                                 : index < 5 ? ComponentKind::Poses
                                             : ComponentKind::Vectors;
    if (known == kKnown.end()) {
      reader.tell(Severity::Note, code::kOtherContent,
                  fmt::format("the content {} is kept and means nothing to kinefile",
                              text::quoted(component.content)),
                  component.at);
    } else if (component.kind != wanted) {
      reader.warn_rejected(fmt::format("the content {} does not belong to the type {}",
                                       text::quoted(component.content), component.type),
                           component.at);
    }
  }
}

/// Reports a motion without joints and links, with which Choreonoid crashes.
void check_motion(const Reader& reader, const SeqFile& file) {
  const auto is_motion = [](const SeqComponent& component) {
    const std::string_view content = usual_content(component);
    return (component.kind == ComponentKind::Values && content == kJointDisplacement) ||
           (component.kind == ComponentKind::Poses && content == kLinkPosition);
  };
  if (std::any_of(file.components.begin(), file.components.end(), is_motion)) return;
  const char* at = file.components.empty() ? reader.tree.root().at : file.components.front().at;
  reader.warn_rejected("there are neither joint displacements nor poses of links", at);
}

/// Reports names with which Choreonoid crashes.
void check_names(const Reader& reader, const SeqFile& file) {
  for (const SeqComponent& component : file.components) {
    if (component.kind == ComponentKind::Other) continue;
    const bool is_of_version_3 =
        component.content.starts_with("Multi") || component.content == "ZMPSeq";
    if (is_of_version_3 && file.major >= 2 && file.major != 3) {
      reader.warn_rejected(
          fmt::format("the content {} is one of format version 3", text::quoted(component.content)),
          component.at);
    }
  }
}

/// Whether frames keep their times because there is no rate to import them at; a note tells so.
bool keeps_times_for_lack_of_rate(const Reader& reader, const SeqComponent& component) {
  const bool has_rate = reader.options.fps || component.frame_rate;
  if (has_rate || !reader.options.keeps_times_without_rate) return false;
  reader.tell(Severity::Note, code::kNoTimedRate,
              "there is no frameRate, at which the frames with times are imported; here they keep "
              "their times, other commands need --fps or --keep-times",
              component.at);
  return true;
}

Result<Document> read_alone(std::string_view bytes, const kinefile::ReadOptions& options,
                            Diagnostics& diagnostics) {
  auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded) return fail(std::move(decoded.error()));
  const text::Source source(options.source_name, decoded->view());
  const auto tree = text::yaml::read_tree(source, diagnostics);
  if (tree == nullptr) return fail(diagnostics.first_error());
  const Reader reader{source, *tree, options, diagnostics};
  SeqFile file = parse(reader);
  std::optional<TimedRounding> rounding;
  for (SeqComponent& component : file.components) {
    if (diagnostics.has_errors()) break;
    if (!component.has_times) continue;
    if (options.keeps_times || keeps_times_for_lack_of_rate(reader, component)) {
      check_kept_times(reader, component);
    } else {
      resample_timed(reader, component);
      rounding = options.timed_rounding;
    }
  }
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  note_contents(reader, file);
  check_repeated(reader, file);
  check_names(reader, file);
  check_motion(reader, file);
  Document document;
  document.format = "choreonoid";
  KeptFile kept = kept_of(file, layout_of(*decoded));
  kept.rounding = rounding;
  document.kept = Kept(std::move(kept));
  document.content = bind(std::move(file), options.fps);
  return document;
}

Result<Document> read(std::string_view bytes, const kinefile::ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

Result<void> write(const Document& document, const kinefile::WriteOptions& options,
                   const Sink& sink, Diagnostics& diagnostics) {
  if (auto valid = validate(document); !valid) return valid;
  const auto file =
      unbind(document, options.of_formats.get<choreonoid::WriteOptions>(), diagnostics);
  if (!file) return fail(file.error());
  // Without a point in numbers with an exponent, some readers of YAML read 1e-05 as a word.
  text::Printer printer(
      sink,
      {.decimals = options.decimals, .points_exponents = true, .quotes_non_finite = file->is_json});
  const KeptFile* const kept = document.kept.get<KeptFile>();
  print_file(printer, *file, kept == nullptr ? "\n" : line_end_of(kept->text));
  return finish(printer);
}

/// How frames with times were read.
Fact fact_of(TimedRounding rounding) {
  const std::string_view word = kRoundings[static_cast<std::size_t>(rounding)];
  const bool holds = rounding != TimedRounding::Slerp;
  return {"timed_rounding", std::string(word),
          holds ? "timed frames hold their values (--timed-rounding slerp interpolates)"
                : "timed frames are interpolated"};
}

std::vector<Fact> facts(const Document& document) {
  const KeptFile* const kept = document.kept.get<KeptFile>();
  if (kept == nullptr) return {};
  const std::string keys = kept->is_snake_case ? "snake_case" : "camelCase";
  const std::string style = kept->is_json ? "json" : "block";
  const std::string version = kept->version.empty() ? "1 (not said)" : kept->version;
  std::vector<Fact> all = {{"version", kept->version, "format version " + version},
                           {"keys", keys, keys},
                           {"style", style, style + " style"}};
  for (Fact& fact : facts_of(kept->text)) all.push_back(std::move(fact));
  if (kept->rounding) all.push_back(fact_of(*kept->rounding));
  if (kept->has_comments) all.push_back({"comments", "yes", {}});
  if (!kept->unknown_keys.empty()) all.push_back({"unknown_keys", kept->unknown_keys, {}});
  return all;
}

std::string component_type(const Component& component) {
  const KeptComponent* const kept = component.kept.get<KeptComponent>();
  return kept == nullptr ? std::string() : kept->type;
}

}  // namespace

Format format() {
  Format format;
  format.name = "choreonoid";
  format.description = "Choreonoid's body motion: values, poses and vectors over time";
  format.extensions = kExtensions;
  format.probe = probe;
  format.foreign = kForeign;
  format.read = read;
  format.write = write;
  format.facts = facts;
  format.component_type = component_type;
  format.conventions.writes = kWrites;
  format.conventions.up = 2;
  format.conventions.angle_unit = AngleUnit::Radians;
  format.read_options = kReadOptions;
  format.write_options = kWriteOptions;
  format.conventions.keeps_times = true;
  return format;
}

}  // namespace kinefile::choreonoid
