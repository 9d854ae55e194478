// SPDX-License-Identifier: MIT
// The operations in the table, and the parts of their entries.
#pragma once

#include "kinefile/operation.hpp"
#include "text/option_words.hpp"

namespace kinefile::operation {

OperationInfo trim();
OperationInfo reverse();
OperationInfo speed();
OperationInfo mirror();
OperationInfo scale();
OperationInfo up();
OperationInfo in_place();
OperationInfo loop();
OperationInfo append();
OperationInfo joints();
OperationInfo rename();
OperationInfo smooth();
OperationInfo unwrap();
OperationInfo zmp();
OperationInfo offset();
OperationInfo merge();
OperationInfo insert();
OperationInfo erase();

/// The flow forms of operations that work on both motions and flows.
OperationForm reverse_of_flow();
OperationForm speed_of_flow();
OperationForm mirror_of_flow();

/// The options of an operation without parameters.
struct NoOptions {};

/// A parameter that sets a member of a struct of options.
template <auto Member>
constexpr Parameter parameter(const OptionInfo& info) {
  return {info, [](std::any& options, const OptionInfo& own, std::string_view word) {
            auto* target = std::any_cast<words::OwnerOf<Member>>(&options);
            return target != nullptr && words::read_into(target->*Member, own, word);
          }};
}

/// A parameter whose text has its own syntax.
/// \tparam Read  std::optional<Value>(std::string_view)
template <auto Member, auto Read>
constexpr Parameter parameter(const OptionInfo& info) {
  return {info, [](std::any& options, const OptionInfo&, std::string_view word) {
            auto* target = std::any_cast<words::OwnerOf<Member>>(&options);
            auto value = Read(word);
            if (target == nullptr || !value) return false;
            target->*Member = std::move(*value);
            return true;
          }};
}

/// The form of an operation that is a function of a document.
template <class Options,
          Result<void> (*Change)(Document&, const Options&, const OperationContext&, Diagnostics&)>
OperationForm form(std::span<const Parameter> parameters = {}) {
  return {parameters, [] { return std::any(Options{}); },
          [](Document& document, const std::any& options, const OperationContext& context,
             Diagnostics& diagnostics) {
            const Options* own = std::any_cast<Options>(&options);
            return Change(document, own != nullptr ? *own : Options{}, context, diagnostics);
          }};
}

/// \tparam Change  Result<Motion>(Motion or const Motion&, const Options&, const OperationContext&,
///                 Diagnostics&)
template <class Options, auto Change>
Result<void> change_motion_by(Document& document, const Options& options,
                              const OperationContext& context, Diagnostics& diagnostics) {
  return change_motion(document, [&](Motion motion) {
    return Change(std::move(motion), options, context, diagnostics);
  });
}

/// The form of an operation that is a function of a motion.
template <class Options, auto Change>
OperationForm motion_form(std::span<const Parameter> parameters = {}) {
  return form<Options, change_motion_by<Options, Change>>(parameters);
}

/// Reads another file that an operation names.
/// \errors CLI001 (Usage) if the context cannot open files; the reader's errors
inline Result<Document> open_other(const std::string& name, const OperationContext& context) {
  if (context.open) return context.open(name);
  return fail(ErrorKind::Usage, "CLI001", "'" + name + "' cannot be read: no other files can be");
}

}  // namespace kinefile::operation
