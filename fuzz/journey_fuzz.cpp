// SPDX-License-Identifier: MIT
// Any files as any format, on the way that a user goes: read, checked, described, placed in the
// world, converted to every format. What is written is read back as the same, or it is not written.
//
// An input is two bytes of options and a folder of files (folder.hpp).

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "checks.hpp"
#include "folder.hpp"
#include "read_back.hpp"
#include "text_mutator.hpp"

namespace {

using namespace kinefile;
using namespace kinefile::fuzz;

/// Conversions of more numbers than this would take too long for one input.
constexpr std::size_t kMaxValues = 5'000;

/// What the inputs of this process came to, which is printed at its end.
struct Counts {
  std::size_t num_inputs = 0, num_read = 0, num_written = 0, num_read_back = 0;

  ~Counts() {
    std::fprintf(stderr, "journey: %zu mutants, %zu read, %zu files written, %zu read back\n",
                 num_inputs, num_read, num_written, num_read_back);
  }
};
Counts counts;

/// An input's options, and what stands beside its first file.
struct Journey {
  std::uint8_t bits = 0;
  const Format* format = nullptr;
  Folder folder;
  std::shared_ptr<const Document> skeleton;
  std::string skeleton_name;
  std::shared_ptr<const RobotProject> project;

  bool is_lenient() const { return (bits & 1) != 0; }
  bool is_strict() const { return (bits & 2) != 0; }
};

Journey journey_of(const std::uint8_t* data, std::size_t size) {
  Journey journey;
  journey.bits = data[0];
  const std::size_t format = data[1] % (formats().size() + 1);
  if (format > 0) journey.format = &formats()[format - 1];
  journey.folder = folder_of({reinterpret_cast<const char*>(data) + 2, size - 2});
  ReadOptions options;
  options.lenient = journey.is_lenient();
  options.companions = resolver_of(journey.folder);
  Diagnostics ignored;
  if (const auto* file = companion_of(journey.folder, {".body", ".urdf", ".wrl", ".asf", ".bvh"})) {
    auto skeleton = read_bytes(file->bytes, file->name, nullptr, options, ignored);
    if (skeleton) journey.skeleton = std::make_shared<const Document>(std::move(*skeleton));
    journey.skeleton_name = file->name;
  }
  if (const auto* file = companion_of(journey.folder, {".rpj"})) {
    auto project = read_project(file->bytes, options, ignored);
    if (project) journey.project = std::make_shared<const RobotProject>(std::move(*project));
  }
  return journey;
}

Result<Document> read_document(const Journey& journey) {
  ReadOptions options;
  options.lenient = journey.is_lenient();
  options.keeps_times = (journey.bits & 4) != 0;
  if ((journey.bits & 8) != 0) options.fps = 25;
  if ((journey.bits & 16) != 0) options.metres_per_unit = 0.01;
  options.companions = resolver_of(journey.folder);
  if ((journey.bits & 32) == 0) options.skeleton = journey.skeleton;
  options.skeleton_name = journey.skeleton_name;
  options.project = journey.project;
  const MemoryFile& file = journey.folder.front();
  const std::string name = file.name.empty() ? "a" : file.name;
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = journey.is_strict();
  auto document = read_bytes(file.bytes, name, journey.format, options, diagnostics);
  const bool is_unknown = !document && document.error().code.starts_with("FMT");
  require(is_unknown || document.has_value() == !diagnostics.has_errors());
  for (const Diagnostic& item : diagnostics.items()) to_string(item);
  return document;
}

DocumentSource source_of(const Journey& journey) {
  if (journey.skeleton == nullptr) return {};
  return [&journey](Diagnostics&) -> Result<std::shared_ptr<const Document>> {
    return journey.skeleton;
  };
}

/// Checks a document, describes it and puts it in the world.
void look_at(const Document& document, const Journey& journey) {
  const DocumentSource robot = source_of(journey);
  Diagnostics diagnostics;
  check(document, {.name = "a", .robot = robot, .lenient = journey.is_lenient()}, diagnostics);
  for (const Diagnostic& item : diagnostics.items()) to_string(item);
  info(document, {.poses = true, .project = journey.project.get()});
  auto placed = place(document, robot, journey.is_lenient(), diagnostics);
  if (!placed) return;
  const bool is_still = placed->is_still;
  const auto table =
      fk(std::move(*placed),
         {.rest = is_still, .frames = "0:1", .tips = true, .rotations = true, .name = "a"});
  if (!table) return;
  std::string json;
  const auto written = write_table(*table, *find_format("json"), {}, appending_to(json));
  require(written.has_value() && is_json(json), "fk's JSON is none", json);
}

/// Writes a document in a format, if it can be, and reads back what was written.
void convert(const Document& document, const Format& format, const Journey& journey) {
  AdaptOptions adapting;
  adapting.kinds.lenient = adapting.channels.lenient = journey.is_lenient();
  adapting.skeleton = source_of(journey);
  adapting.skeleton_name = journey.skeleton_name;
  WriteOptions writing;
  writing.project = journey.project;
  Diagnostics diagnostics;
  const auto adapted = adapt(document, format, adapting, writing, diagnostics);
  if (!adapted) {
    require(!adapted.error().message.empty(), "refused without a word", std::string(format.name));
    return;
  }
  writing.writes_companion = true;
  const auto files = files_of(*adapted, format, writing);
  if (!files) return;
  counts.num_written += files->size();
  ReadOptions reading;
  reading.lenient = journey.is_lenient();
  reading.keeps_times = true;
  reading.project = journey.project;
  read_back(*files, *adapted, format, std::holds_alternative<BodyMotion>(document.content),
            reading);
  counts.num_read_back += files->size();
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// libFuzzer's hook: changes texts as texts, and a third of them as it usually does.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  if (size < 3 || seed % 3 == 0) return LLVMFuzzerMutate(data, size, most);
  if (seed % 16 == 1) data[0] = static_cast<std::uint8_t>(seed >> 8);
  const std::string_view text(reinterpret_cast<const char*>(data) + 2, size - 2);
  const std::string mutated = TextMutator(text, seed).mutated().substr(0, most - 2);
  std::copy(mutated.begin(), mutated.end(), data + 2);
  return mutated.size() + 2;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ++counts.num_inputs;
  if (size < 2) return 0;
  const Journey journey = journey_of(data, size);
  const auto document = read_document(journey);
  if (!document) return 0;
  ++counts.num_read;
  if (!std::holds_alternative<PoseFlow>(document->content)) check_document(*document);
  look_at(*document, journey);
  if (num_values_of(*document) > kMaxValues) return 0;
  for (const Format& format : formats()) {
    if (is_written(format)) convert(*document, format, journey);
  }
  return 0;
}
