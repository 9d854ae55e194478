// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "edit_operations.hpp"
#include "report.hpp"
#include "writing.hpp"

namespace kinefile::cli {
namespace {

struct Edit {
  std::string file;
  std::vector<std::string> words;
  Writing writing;
  Reading reading;
};

Result<std::vector<Operation>> parse_operations(const std::vector<std::string>& words) {
  std::vector<Operation> operations;
  for (const std::string& word : words) {
    auto operation = parse_operation(word);
    if (!operation) return fail(std::move(operation.error()));
    operations.push_back(std::move(*operation));
  }
  return operations;
}

/// What keeps an operation from a document; empty if nothing does.
std::string hindrance(const Operation& operation, const Document& document) {
  if (std::holds_alternative<PoseFlow>(document.content)) {
    return operation.apply_to_flow ? "" : "a motion, and the file holds a flow of poses";
  }
  if (!operation.apply) return "a flow of poses, and the file holds none";
  if (!has_skeleton(document) && !operation.works_on_parts) {
    return "a skeleton, and the file holds components";
  }
  if (operation.needs_motion && std::holds_alternative<Skeleton>(document.content)) {
    return "a motion, and the file holds a skeleton alone";
  }
  return {};
}

/// Does one operation after the other. An error names the one that it came from.
Result<void> apply(const std::vector<Operation>& operations, Document& document,
                   const EditContext& context) {
  for (const Operation& operation : operations) {
    if (const std::string needed = hindrance(operation, document); !needed.empty()) {
      return fail(make_error(ErrorKind::Usage, "CLI001",
                             fmt::format("'{}' needs {}", operation.word, needed)));
    }
    const bool is_flow = std::holds_alternative<PoseFlow>(document.content);
    auto applied = (is_flow ? operation.apply_to_flow : operation.apply)(document, context);
    if (applied) continue;
    Error error = std::move(applied.error());
    if (error.place.source.empty()) error.message = operation.word + ": " + error.message;
    return fail(std::move(error));
  }
  return {};
}

int run(Edit& edit, const Globals& globals) {
  const auto operations = parse_operations(edit.words);
  if (!operations) return usage_error(globals, operations.error().message);
  if (edit.writing.out != "-" && output_format(edit.writing) == nullptr) {
    return no_output_format(edit.writing, globals);
  }
  int exit_code = kDone;
  auto document = load(edit.file, edit.reading, globals, exit_code);
  if (!document) return exit_code;
  const Format* format = output_format(edit.writing, *document);
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = edit.reading.is_strict;
  auto applied = apply(*operations, *document, {edit.reading, diagnostics});
  return write_document(std::move(applied), std::move(*document), *format, edit.writing, edit.file,
                        edit.reading, diagnostics, globals);
}

}  // namespace

void add_edit(CLI::App& app, Globals& globals) {
  auto edit = std::make_shared<Edit>();
  edit->writing.out = "-";
  CLI::App* command =
      app.add_subcommand("edit", "Change a motion, by operations in the order given");
  command->add_option("FILE", edit->file, "File to read; - is standard input")->required();
  command->add_option("OP", edit->words, list_of_operations())->required();
  command
      ->add_option("-o,--out", edit->writing.out,
                   "File to write; else standard output, in the input's format")
      ->type_name("OUT");
  add_writing_options(*command, edit->writing);
  add_reading_options(*command, edit->reading);
  command->callback(
      [edit, &globals] { globals.run = [edit, &globals] { return run(*edit, globals); }; });
}

}  // namespace kinefile::cli
