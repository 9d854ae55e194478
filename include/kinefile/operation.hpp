// SPDX-License-Identifier: MIT
#pragma once

#include <any>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinefile/document.hpp"
#include "kinefile/option.hpp"
#include "kinefile/result.hpp"
#include "kinefile/robot_project.hpp"

#pragma GCC visibility push(default)

namespace kinefile {

/// What an operation may need beside the document that it changes.
struct OperationContext {
  bool lenient = false;  ///< repairs what docs/errors.md names, with a warning each
  /// Reads another file that an operation names (`append=FILE`); null: there is none to be had.
  std::function<Result<Document>(const std::string& name)> open = {};
  /// Of flows: the robot's project, which knows the pairs of a mirror. Null: none.
  std::shared_ptr<const RobotProject> project = nullptr;
};

/// A parameter of an operation. It sets a member of a struct that only the operation knows.
using Parameter = Option<std::any>;

/// How an operation is called on some documents, and what it does to them.
struct OperationForm {
  /// In the order of the operation's word: NAME=FIRST, then each after its separator; those that
  /// are told by their names come last.
  std::span<const Parameter> parameters = {};
  /// Makes the struct of the parameters with its defaults.
  std::any (*defaults)() = nullptr;
  /// Changes a document; null: there is no such form.
  Result<void> (*apply)(Document& document, const std::any& options,
                        const OperationContext& context, Diagnostics& diagnostics) = nullptr;
};

/// An operation as the table of operations has it: what `kinefile edit`, its help and its
/// completions know of it.
struct OperationInfo {
  std::string_view name;
  std::string_view help;             ///< what it does, in one line
  bool needs_motion = true;          ///< else it takes a skeleton alone, too
  bool works_on_components = false;  ///< whether it takes a body motion without its robot
  OperationForm form = {};           ///< of all documents but flows
  OperationForm flow_form = {};      ///< of flows
};

/// Every operation, in the order in which they are listed.
std::span<const OperationInfo> operations();

/// How a form of an operation is called: "loop=N[,blend=F]"; empty where there is no such form.
std::string usage_of(const OperationInfo& info, const OperationForm& form);

/// One operation with its parameters, read from a word such as "trim=10:20".
struct Operation {
  std::string word;
  const OperationInfo* info = nullptr;
  std::any options = {};       ///< for all documents but flows; empty: the word is none for them
  std::any flow_options = {};  ///< empty: the word is none for flows
};

/// Reads an operation.
/// \errors CLI001 (Usage) if there is none of that name, or its parameters are not what it takes
Result<Operation> parse_operation(const std::string& word);

/// How the operations are called, in one text, for help.
std::string list_of_operations();

/// Reads several, each a word.
/// \errors as `parse_operation`
Result<std::vector<Operation>> parse_operations(std::span<const std::string> words);

/// Applies operations one after the other. An error names the one that it came from; the document
/// is then in an unspecified state.
/// \errors CLI001 (Usage) if an operation does not take this kind of document; those of the
///         operations
Result<void> apply(std::span<const Operation> operations, Document& document,
                   const OperationContext& context, Diagnostics& diagnostics);

/// Changes the motion of a document. A skeleton alone is given to `change` as a motion without
/// frames. The components of a body motion are changed one by one, each as a motion of loose parts
/// (see `robot::motion_of_component`); all must have one length and rate. After an error the
/// document is in an unspecified state: its motion may have been taken out of it.
/// \errors those of `change`; CLI002 (Usage) if the components do not agree; CLI001 for a flow
Result<void> change_motion(Document& document, const std::function<Result<Motion>(Motion)>& change);

/// Changes the components of a body motion one by one, each as a motion of loose parts.
/// \param must_agree  whether they must have one length and rate
/// \errors CLI002 (Usage) if they must and do not; those of `change`
Result<void> change_components(BodyMotion& body, bool must_agree,
                               const std::function<Result<Motion>(Motion)>& change);

/// Frames from `begin` to `end`, `end` not included, every `step` of them.
struct FrameRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t step = 1;

  /// How many frames it holds.
  std::size_t num_frames() const { return (end - begin + step - 1) / step; }
};

/// Reads A:B or A:B:STEP, either end left out at will; all frames for an empty text. Nothing for
/// other texts, and for frames that a motion of so many does not have.
std::optional<FrameRange> parse_range(const std::string& text, std::size_t num_frames);

}  // namespace kinefile

#pragma GCC visibility pop
