// SPDX-License-Identifier: MIT
// The table of operations, and how they are applied to documents of every kind.
#include <fmt/format.h>

#include <algorithm>

#include "document/conventions.hpp"
#include "document/operation_tables.hpp"
#include "kinefile/operation.hpp"
#include "kinefile/robot.hpp"

namespace kinefile {
namespace {

tl::unexpected<Error> refuse_operation(std::string message) {
  return fail(ErrorKind::Usage, "CLI001", std::move(message));
}

/// How to call an operation, for each kind of document.
std::string usages_of(const OperationInfo& info) {
  const std::string usage = usage_of(info, info.form);
  const std::string of_flow = usage_of(info, info.flow_form);
  if (of_flow.empty() || of_flow == usage) return usage;
  return usage.empty() ? of_flow : fmt::format("{} (of a flow: {})", usage, of_flow);
}

/// Whether a parameter is given by name.
bool is_named(const Parameter& parameter) { return parameter.info.separator == 0; }

/// Removes ",NAME=WORD" from the end of an argument.
/// \returns the word; empty if the argument does not name the parameter
std::optional<std::string> take_named(const Parameter& parameter, std::string& argument) {
  const std::string key = fmt::format(",{}=", parameter.info.name);
  const std::size_t at = argument.rfind(key);
  if (at == std::string::npos) return std::nullopt;
  std::string word = argument.substr(at + key.size());
  argument.erase(at);
  return word;
}

/// The words of the parameters that are given by position; fewer than there are parameters if a
/// separator is missing.
std::vector<std::string> words_by_place(std::span<const Parameter> parameters,
                                        std::string_view argument) {
  std::vector<std::string> words;
  for (std::size_t p = 0; p + 1 < parameters.size() && !is_named(parameters[p + 1]); ++p) {
    const char separator = parameters[p + 1].info.separator;
    // Names of files may contain separators; the parameters after them do not.
    const bool is_file = parameters[p].info.type == OptionType::File;
    const std::size_t at = is_file ? argument.rfind(separator) : argument.find(separator);
    if (at == std::string_view::npos) return words;
    words.emplace_back(argument.substr(0, at));
    argument.remove_prefix(at + 1);
  }
  words.emplace_back(argument);
  return words;
}

/// Whether the first parameter and all after it may be omitted.
bool can_be_bare(const OperationForm& form) {
  return form.parameters.empty() || !form.parameters.front().info.is_required;
}

/// Reads the parameters of a form from the text after "="; null if there is none. Empty if the form
/// does not accept them.
std::any parse_options(const OperationForm& form, const std::string* argument) {
  if (form.apply == nullptr) return {};
  std::any options = form.defaults();
  if (argument == nullptr) return can_be_bare(form) ? options : std::any();
  if (form.parameters.empty()) return {};
  std::string text = *argument;
  for (const Parameter& parameter : form.parameters) {
    if (!is_named(parameter)) continue;
    const auto word = take_named(parameter, text);
    if (word && !parameter.set(options, parameter.info, *word)) return {};
  }
  const std::vector<std::string> words = words_by_place(form.parameters, text);
  for (std::size_t p = 0; p < form.parameters.size(); ++p) {
    const Parameter& parameter = form.parameters[p];
    if (is_named(parameter)) continue;
    if (p >= words.size() || !parameter.set(options, parameter.info, words[p])) return {};
  }
  return options;
}

std::vector<OperationInfo> all_operations() {
  using namespace operation;
  return {trim(),     reverse(), speed(),  mirror(), scale(),  up(),
          in_place(), loop(),    append(), joints(), rename(), smooth(),
          unwrap(),   zmp(),     offset(), merge(),  insert(), erase()};
}

/// Why an operation cannot be applied to a document; empty if it can.
std::string hindrance(const Operation& operation, const Document& document) {
  if (std::holds_alternative<PoseFlow>(document.content)) {
    return operation.flow_options.has_value() ? "" : "a motion, and the file holds a flow of poses";
  }
  if (!operation.options.has_value()) return "a flow of poses, and the file holds none";
  if (!has_skeleton(document) && !operation.info->works_on_components) {
    return "a skeleton, and the file holds components";
  }
  if (operation.info->needs_motion && std::holds_alternative<Skeleton>(document.content)) {
    return "a motion, and the file holds a skeleton alone";
  }
  return {};
}

}  // namespace

std::span<const OperationInfo> operations() {
  static const std::vector<OperationInfo> kOperations = all_operations();
  return kOperations;
}

std::string usage_of(const OperationInfo& info, const OperationForm& form) {
  if (form.apply == nullptr) return {};
  std::string usage(info.name);
  for (const Parameter& parameter : form.parameters) {
    const OptionInfo& own = parameter.info;
    const std::string part = is_named(parameter)
                                 ? fmt::format(",{}={}", own.name, own.value_name)
                                 : fmt::format("{}{}", own.separator, own.value_name);
    usage += own.is_required ? part : fmt::format("[{}]", part);
  }
  return usage;
}

std::string list_of_operations() {
  std::string list, of_flows;
  const auto add = [](std::string& text, const std::string& usage) {
    if (!usage.empty()) text += fmt::format("{}{}", text.empty() ? "" : ", ", usage);
  };
  for (const OperationInfo& info : operations()) {
    add(list, usage_of(info, info.form));
    add(of_flows, usage_of(info, info.flow_form));
  }
  return list + "; of a flow: " + of_flows;
}

Result<Operation> parse_operation(const std::string& word) {
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const std::string text = equals == std::string::npos ? "" : word.substr(equals + 1);
  const std::string* const argument = equals == std::string::npos ? nullptr : &text;
  for (const OperationInfo& info : operations()) {
    if (info.name != name) continue;
    Operation made{word, &info, parse_options(info.form, argument),
                   parse_options(info.flow_form, argument)};
    if (made.options.has_value() || made.flow_options.has_value()) return made;
    return refuse_operation(fmt::format("expected {}, found '{}'", usages_of(info), word));
  }
  return refuse_operation(
      fmt::format("there is no operation '{}'; there are {}", name, list_of_operations()));
}

Result<std::vector<Operation>> parse_operations(std::span<const std::string> words) {
  std::vector<Operation> made;
  for (const std::string& word : words) {
    auto one = parse_operation(word);
    if (!one) return fail(std::move(one.error()));
    made.push_back(std::move(*one));
  }
  return made;
}

Result<void> apply(std::span<const Operation> operations, Document& document,
                   const OperationContext& context, Diagnostics& diagnostics) {
  for (const Operation& operation : operations) {
    if (const std::string needed = hindrance(operation, document); !needed.empty()) {
      return refuse_operation(fmt::format("'{}' needs {}", operation.word, needed));
    }
    const bool is_flow = std::holds_alternative<PoseFlow>(document.content);
    const OperationForm& form = is_flow ? operation.info->flow_form : operation.info->form;
    auto applied = form.apply(document, is_flow ? operation.flow_options : operation.options,
                              context, diagnostics);
    if (applied) continue;
    Error error = std::move(applied.error());
    if (error.place.source.empty()) error.message = operation.word + ": " + error.message;
    return fail(std::move(error));
  }
  return {};
}

Result<void> expect_agreement(const BodyMotion& body) {
  const Component* const other = robot::find_disagreement(body);
  if (other == nullptr) return {};
  return fail(
      ErrorKind::Usage, "CLI002",
      fmt::format("expected components of one length and rate, found {}; 'kinefile resample "
                  "--fps {:.6g}' brings them to one",
                  robot::words_of_disagreement(*other, *main_component(body)),
                  nominal_frame_rate(main_component(body)->timeline)));
}

Result<void> change_components(BodyMotion& body, bool must_agree,
                               const std::function<Result<Motion>(Motion)>& change) {
  if (must_agree) {
    if (auto agreed = expect_agreement(body); !agreed) return agreed;
  }
  for (Component& component : body.components) {
    if (component.kind == ComponentKind::Other) continue;
    auto changed = change(robot::motion_of_component(component));
    if (!changed) return fail(std::move(changed.error()));
    component = robot::with_frames_of(component, *changed);
  }
  return {};
}

Result<void> change_motion(Document& document,
                           const std::function<Result<Motion>(Motion)>& change) {
  if (BodyMotion* body = std::get_if<BodyMotion>(&document.content)) {
    return change_components(*body, true, change);
  }
  if (!has_skeleton(document)) return refuse_operation("expected a motion, found a flow of poses");
  Motion* const motion = std::get_if<Motion>(&document.content);
  Result<Motion> changed =
      change(motion != nullptr ? std::move(*motion) : still_or_moving(document));
  if (!changed) return fail(std::move(changed.error()));
  put_motion(std::move(*changed), document);
  return {};
}

}  // namespace kinefile
