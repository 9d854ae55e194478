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

/// What an operation may need in addition to the document that it changes.
struct OperationContext {
  bool lenient = false;  ///< repairs what docs/errors.md names, with a warning each
  /// Reads another file that an operation names (`append=FILE`); null: no file can be read.
  std::function<Result<Document>(const std::string& name)> open = {};
  /// For flows: the robot's project, which gives the pairs for mirroring. Null: none.
  std::shared_ptr<const RobotProject> project = nullptr;
};

/// A parameter of an operation. It sets a member of a struct that only the operation knows.
using Parameter = Option<std::any>;

/// How an operation is called on some documents, and what it does to them.
struct OperationForm {
  /// In the order of the operation's word: NAME=FIRST, then each after its separator; named
  /// parameters come last.
  std::span<const Parameter> parameters = {};
  /// Makes the struct of parameters with default values.
  std::any (*defaults)() = nullptr;
  /// Changes a document; null: there is no such form.
  Result<void> (*apply)(Document& document, const std::any& options,
                        const OperationContext& context, Diagnostics& diagnostics) = nullptr;
};

/// An entry of the table of operations, from which `kinefile edit`, its help and its completions
/// are made.
struct OperationInfo {
  std::string_view name;
  std::string_view help;             ///< what it does, in one line
  bool needs_motion = true;          ///< if false, it also takes a skeleton alone
  bool works_on_components = false;  ///< it takes a body motion without its robot
  OperationForm form = {};           ///< for all documents except flows
  OperationForm flow_form = {};      ///< for flows
};

/// All operations, in the order in which they are listed.
std::span<const OperationInfo> operations();

/// The usage of a form of an operation: "loop=N[,blend=F]"; empty if there is no such form.
std::string usage_of(const OperationInfo& info, const OperationForm& form);

/// One operation with its parameters, read from a word such as "trim=10:20".
struct Operation {
  std::string word;
  const OperationInfo* info = nullptr;
  std::any options = {};       ///< for all documents except flows; empty: the word is not valid for
                               ///< them
  std::any flow_options = {};  ///< empty: the word is not valid for flows
};

/// Reads an operation.
/// \errors CLI001 (Usage) if no operation has that name, or its parameters are not valid
Result<Operation> parse_operation(const std::string& word);

/// The usages of all operations, in one text, for help.
std::string list_of_operations();

/// Reads several operations, one per word.
/// \errors as `parse_operation`
Result<std::vector<Operation>> parse_operations(std::span<const std::string> words);

/// Applies operations one after the other. An error names the operation that failed; the document
/// is then in an unspecified state.
/// \errors CLI001 (Usage) if an operation does not take this kind of document; those of the
///         operations
Result<void> apply(std::span<const Operation> operations, Document& document,
                   const OperationContext& context, Diagnostics& diagnostics);

/// Changes the motion of a document. A skeleton alone is passed to `change` as a motion without
/// frames. The components of a body motion are changed one by one, each as a motion of separate
/// parts (see `robot::motion_of_component`); all must have one length and rate. After an error the
/// document is in an unspecified state: its motion may have been moved out of it.
/// \errors those of `change`; CLI002 (Usage) if the components do not agree; CLI001 for a flow
Result<void> change_motion(Document& document, const std::function<Result<Motion>(Motion)>& change);

/// Changes the components of a body motion one by one, each as a motion of separate parts.
/// \param must_agree  whether they must have one length and rate
/// \errors CLI002 (Usage) if they must and do not; those of `change`
Result<void> change_components(BodyMotion& body, bool must_agree,
                               const std::function<Result<Motion>(Motion)>& change);

/// Every `step`-th frame from `begin` to `end`, `end` not included.
struct FrameRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t step = 1;

  /// The number of frames in the range.
  std::size_t num_frames() const { return (end - begin + step - 1) / step; }
};

/// Reads A:B or A:B:STEP; either end may be omitted. An empty text means all frames. Returns
/// nothing for other texts, and for frames beyond `num_frames`.
std::optional<FrameRange> parse_range(const std::string& text, std::size_t num_frames);

}  // namespace kinefile

#pragma GCC visibility pop
