// SPDX-License-Identifier: MIT
#include "writing.hpp"

#include <fmt/format.h>

#include "report.hpp"

namespace kinefile::cli {
namespace {

std::vector<std::string> writable_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (format.write != nullptr) names.emplace_back(format.name);
  }
  return names;
}

}  // namespace

void add_writing_options(CLI::App& command, Writing& writing) {
  command.add_option("--to", writing.to, "Format of the output; else its name tells")
      ->check(CLI::IsMember(writable_formats()))
      ->type_name("FORMAT");
  command
      .add_option("--decimals", writing.decimals,
                  "Digits after the point; else as many as the exact value needs")
      ->check(CLI::Range(0, 30))
      ->type_name("N");
  command.add_flag("--force", writing.may_replace, "Replace an existing file");
}

const Format* output_format(const Writing& writing) {
  return writing.to.empty() ? format_of_name(writing.out) : find_format(writing.to);
}

Result<void> change_components(BodyMotion& body, bool must_agree,
                               const std::function<Result<Motion>(const Motion&)>& change) {
  const Component* main = main_component(body);
  for (const Component& component : body.components) {
    const bool is_known = component.kind != ComponentKind::Other;
    if (!must_agree || !is_known ||
        (component.num_frames == main->num_frames &&
         have_same_times(component.timeline, main->timeline))) {
      continue;
    }
    return fail(make_error(
        ErrorKind::Usage, "CLI002",
        fmt::format("expected components of one length and rate, found {} frames at {} a second of "
                    "'{}' beside {} at {}",
                    component.num_frames, frame_rate(component.timeline), component.content,
                    main->num_frames, frame_rate(main->timeline))));
  }
  for (Component& component : body.components) {
    if (component.kind == ComponentKind::Other) continue;
    auto changed = change(robot::motion_of_component(component));
    if (!changed) return fail(std::move(changed.error()));
    component = robot::with_frames_of(component, *changed);
  }
  return {};
}

int no_output_format(const Writing& writing, const Globals& globals) {
  return usage_error(globals,
                     fmt::format("'{}' shows no format by its name; --to names it", writing.out));
}

const Format* output_format(const Writing& writing, const Document& input) {
  if (writing.out == "-" && writing.to.empty()) return find_format(input.format);
  return output_format(writing);
}

namespace {

KindOptions kind_options(const Writing& writing, const Reading& reading) {
  KindOptions options;
  options.lenient = reading.is_lenient;
  if (writing.form == "links") options.form = robot::BodyForm::Links;
  if (writing.form == "joints") options.form = robot::BodyForm::Joints;
  if (writing.form == "both") options.form = robot::BodyForm::Both;
  if (writing.flow_format == "word_n") options.flow_format = FlowFormat::WordN;
  if (writing.flow_format == "v1r4") options.flow_format = FlowFormat::V1R4;
  options.keeps_up = writing.up == "as-is";
  if (writing.up == "y") options.up = 1;
  if (writing.up == "z") options.up = 2;
  return options;
}

Result<JointMap> load_joint_map(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = FileBytes::open(path);
  if (!bytes) return fail(bytes.error());
  return parse_joint_map(bytes->view(), path, diagnostics);
}

/// Brings a document into a kind that the format can write, on the robot that `--skeleton` names.
Result<Document> in_wanted_kind(Document&& document, const Format& format, const Writing& writing,
                                const Reading& reading, Diagnostics& diagnostics) {
  KindOptions options = kind_options(writing, reading);
  std::optional<Document> model;
  // A skeleton that a motion was read with is none to put it on.
  const bool is_body = std::holds_alternative<BodyMotion>(document.content);
  const bool is_set = format.has_part != nullptr;
  const bool wants_robot = (is_set || (format.name == "choreonoid" && !writing.form.empty())) &&
                           find_format(document.format)->companion.empty();
  if (is_body || wants_robot || !writing.robot.empty()) {
    Reading of_robot = reading;
    if (!writing.robot.empty()) of_robot.skeleton = writing.robot;
    auto loaded = load_skeleton(of_robot, diagnostics);
    if (!loaded) return fail(std::move(loaded.error()));
    model = std::move(*loaded);
    if (model) options.model = &*model;
  }
  if (!writing.joint_map.empty()) {
    auto map = load_joint_map(writing.joint_map, diagnostics);
    if (!map) return fail(std::move(map.error()));
    options.joint_map = std::move(*map);
  }
  return in_kind_of(format, std::move(document), options, diagnostics);
}

Result<void> write_adapted(Document&& document, const Format& format, const Writing& writing,
                           const Reading& reading, Diagnostics& diagnostics) {
  shape::ChannelOptions channels = writing.channels;
  channels.lenient = reading.is_lenient;
  const auto kept = document.extras.file.find("positions");
  channels.adds_positions = kept != document.extras.file.end() && kept->second == "add";
  WriteOptions options = writing.format;
  options.decimals = writing.decimals;
  const bool was_body = std::holds_alternative<BodyMotion>(document.content);
  auto of_kind = in_wanted_kind(std::move(document), format, writing, reading, diagnostics);
  if (!of_kind) return fail(std::move(of_kind.error()));
  document = std::move(*of_kind);
  const bool has_named_skeleton =
      !reading.skeleton.empty() && !format.companion.empty() && !was_body;
  std::optional<Document> skeleton;
  if (has_named_skeleton) {
    Diagnostics ignored;  // a motion that needs it has told of it already
    const bool is_new = document.format != format.name;
    auto loaded = load_skeleton(reading, is_new ? diagnostics : ignored);
    if (!loaded) return fail(std::move(loaded.error()));
    skeleton = std::move(**loaded);
    if (is_new) {
      auto moved = on_skeleton_of(*skeleton, std::move(document), diagnostics);
      if (!moved) return fail(std::move(moved.error()));
      document = std::move(*moved);
    }
  }
  auto adapted = adapted_to(format, std::move(document), channels, diagnostics);
  if (!adapted) return fail(std::move(adapted.error()));
  // The named skeleton serves the output, too, as long as the motion still fits it.
  if (skeleton && skeleton->format == format.companion &&
      are_written_alike(*find_format(format.companion), *skeleton, *adapted)) {
    options.writes_companion = false;
    options.companion = reading.skeleton.substr(reading.skeleton.find_last_of('/') + 1);
  }
  return write_file(writing.out, *adapted, format, options, writing.may_replace, diagnostics);
}

}  // namespace

int write_document(Result<void> made, Document&& document, const Format& format,
                   const Writing& writing, const std::string& source, const Reading& reading,
                   Diagnostics& diagnostics, const Globals& globals) {
  if (made) made = write_adapted(std::move(document), format, writing, reading, diagnostics);
  print_diagnostics(stderr, diagnostics, globals);
  if (made) return kDone;
  if (made.error().place.source.empty()) made.error().place.source = source;
  // What --strict made an error of has been printed already.
  if (!diagnostics.has_errors()) print_error(made.error(), globals);
  return exit_code_of(made.error());
}

}  // namespace kinefile::cli
