// SPDX-License-Identifier: MIT
// Measures kinefile against named baselines in the same run and prints the ratios.

#include "batch.hpp"
#include "checksum.hpp"
#include "commands.hpp"
#include "files.hpp"
#include "keyframes.hpp"
#include "kinefile/threads.hpp"
#include "motions.hpp"
#include "operations.hpp"
#include "printing.hpp"
#include "report.hpp"
#include "rows.hpp"
#include "subject.hpp"

namespace kinefile::bench {
namespace {

int run(int argc, char** argv) {
  set_max_threads(1);  // measurements of several say so
  make_subject();
  print_memory();
  load_subject();
  add_rows();
  add_files();
  add_printing();
  add_motions();
  add_operations();
  add_commands();
  add_checksum();
  add_batch();
  const bool has_run = run_and_print(argc, argv);
  if (has_run) {
    print_disagreements();
    print_operation_disagreements();
    print_keyframes();
  }
  remove_subject();
  return has_run ? 0 : 2;
}

}  // namespace
}  // namespace kinefile::bench

int main(int argc, char** argv) { return kinefile::bench::run(argc, argv); }
