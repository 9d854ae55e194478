// SPDX-License-Identifier: MIT
#include "formats/bvh/format.hpp"

#include <fmt/format.h>

#include <array>

#include "formats/bvh/bind.hpp"
#include "formats/bvh/codes.hpp"
#include "formats/bvh/parser.hpp"
#include "formats/bvh/print.hpp"
#include "formats/bvh/read_pieces.hpp"
#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "text/decode.hpp"

namespace kinefile::bvh {
namespace {

constexpr std::array<std::string_view, 1> kExtensions = {".bvh"};
constexpr std::string_view kReplace = "replace";

bool set_positions(kinefile::ReadOptions& options, const OptionInfo&, std::string_view word) {
  const auto positions = parse_positions(word);
  if (positions) options.of_formats.edit<bvh::ReadOptions>().positions = *positions;
  return positions.has_value();
}

constexpr std::array<ReadOption, 5> kReadOptions = {
    options::kFps,
    ReadOption{
        {
            .name = "positions",
            .type = OptionType::Text,
            .value_name = "MODE",
            .help = "What BVH position channels do to OFFSET: replace it, add to it, or auto "
                    "to decide from bones and the ground; or root=MODE,others=MODE",
            .default_word = kReplace,
            .wanted = "replace, add, auto or root=MODE,others=MODE",
        },
        set_positions},
    options::kEncoding,
    options::kUnitIn,
    options::kUpIn,
};
constexpr std::array<WriteOption, 1> kWriteOptions = {options::kDecimals};

constexpr Kinds kWrites = {.motions = true, .skeletons = true};

/// The data that a document keeps from its file.
struct KeptFile {
  TextLayout text;
  std::string positions = "replace";  ///< the value of --positions that it was read with
};

bool probe(std::string_view head) {
  Diagnostics ignored;
  const auto decoded = text::decode(head, {}, {}, ignored);
  if (!decoded) return false;
  text::Scanner scanner(decoded->view());
  while (scanner.peek().starts_with('#')) scanner.take_line();
  const std::string_view word = scanner.peek();
  return text::equals_ignoring_case(word, "HIERARCHY") || text::equals_ignoring_case(word, "ROOT");
}

/// What --positions means for a file: the modes asked for, and what the file shows.
struct SettledPositions {
  PositionModes modes;
  std::string option;  ///< the value of --positions for these modes
};

/// Reports the clear guesses that the reading contradicts, joint by joint.
void tell_doubts(const File& file, const text::Source& source, const SettledPositions& settled,
                 const std::vector<PositionGuess>& guesses, Diagnostics& diagnostics) {
  PositionModes right = settled.modes;
  for (const PositionGuess& guess : guesses) {
    if (guess.is_clear) right[guess.node] = guess.mode;
  }
  const std::string option = option_of(file, right);
  for (const PositionGuess& guess : guesses) {
    if (!guess.is_clear || guess.mode == settled.modes[guess.node]) continue;
    const std::string_view name = file.nodes[guess.node].name;
    const bool is_added = guess.mode == PositionMode::Add;
    diagnostics.add(source.diagnose(
        Severity::Note, code::kPositionsDoubtful,
        fmt::format("the positions of '{}' {} its OFFSET, but look as if they {} it: {} "
                    "(--positions {})",
                    name, is_added ? "replace" : "are added to",
                    is_added ? "were added to" : "replaced", guess.reason, option),
        name.data()));
  }
}

/// Decides the meaning of position channels, and reports it if the file is not clear.
SettledPositions settle_positions(const File& file, const text::Source& source,
                                  const kinefile::ReadOptions& options, Diagnostics& diagnostics) {
  const Positions& asked = options.of_formats.get<bvh::ReadOptions>().positions;
  const std::vector<PositionGuess> guesses = guess_positions(file, options.up);
  SettledPositions settled;
  settled.modes = settled_positions(file, asked, guesses);
  settled.option = option_of(file, settled.modes);
  if (asked.root == PositionMode::Auto || asked.others == PositionMode::Auto) {
    const std::string why =
        guesses.empty()
            ? "no OFFSET tells"
            : fmt::format("{}: {}", file.nodes[guesses.front().node].name, guesses.front().reason);
    diagnostics.add(source.diagnose(
        Severity::Note, code::kPositionsChosen,
        fmt::format("positions are read as --positions {}: {}", settled.option, why),
        file.nodes.front().name.data()));
  }
  tell_doubts(file, source, settled, guesses, diagnostics);
  return settled;
}

}  // namespace

Document document_of(File&& file, const text::Source& source, const TextLayout& layout,
                     const kinefile::ReadOptions& options, Diagnostics& diagnostics) {
  const bool has_motion = file.has_motion;
  SettledPositions positions = settle_positions(file, source, options, diagnostics);
  Document document;
  document.format = "bvh";
  document.kept = Kept(KeptFile{layout, std::move(positions.option)});
  Motion motion = bvh::bind(std::move(file), positions.modes);
  motion.skeleton.metres_per_unit = options.metres_per_unit.value_or(0);
  motion.skeleton.up = options.up;
  if (options.fps) motion.clip.timeline = {FrameRate{*options.fps}, 0};
  if (has_motion) {
    document.content = std::move(motion);
  } else {
    document.content = std::move(motion.skeleton);
  }
  return document;
}

namespace {

/// Reads a document; `diagnostics` contains only messages about this file.
Result<Document> read_alone(std::string_view bytes, const kinefile::ReadOptions& options,
                            Diagnostics& diagnostics) {
  auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded) return fail(std::move(decoded.error()));
  std::string_view view = decoded->view();
  // The end-of-file character of CP/M and DOS, and line ends after it.
  const std::size_t last = view.find_last_not_of("\r\n \t\x1A");
  const std::size_t mark = view.find('\x1A', last == std::string_view::npos ? 0 : last);
  if (mark != std::string_view::npos) view = view.substr(0, mark);
  const text::Source source(options.source_name, view);
  File file = parse(source, {options.lenient, options.fps.has_value()}, diagnostics);
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  return document_of(std::move(file), source, layout_of(*decoded, view), options, diagnostics);
}

Result<Document> read(std::string_view bytes, const kinefile::ReadOptions& options,
                      Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_alone, bytes, options, diagnostics);
}

/// Writes the hierarchy, and the frames if the document is a motion.
/// \param num_frames, frames  of the motion, whose own clip is not looked at
Result<void> write_all(const Document& document, std::size_t num_frames, EachBlock frames,
                       const kinefile::WriteOptions& options, const Sink& sink,
                       Diagnostics& diagnostics) {
  const Motion* const motion = std::get_if<Motion>(&document.content);
  const Skeleton& skeleton = skeleton_of(document);
  const auto unbound = unbind(skeleton);
  if (!unbound) return fail(unbound.error());
  if (const std::string option = option_of(skeleton); option != kReplace) {
    diagnostics.add(Severity::Note, code::kPositionsAdded,
                    fmt::format("position values are written as they are, to be added to OFFSET; "
                                "read the file with --positions {}",
                                option));
  }
  const KeptFile* const kept = document.kept.get<KeptFile>();
  const std::string_view line_end = kept == nullptr ? "\n" : line_end_of(kept->text);
  text::Printer printer(sink, {.decimals = options.decimals});
  print_hierarchy(printer, unbound->file, line_end);
  Result<void> printed;
  if (motion != nullptr) {
    print_counts(printer, num_frames, motion->clip.timeline, line_end);
    printed = frames([&](const FrameBlock& block) {
      printer.print_rows(block.num_frames, skeleton.coordinates.size(),
                         [&](text::Printer& part, std::size_t begin, std::size_t end) {
                           print_frames(part, *unbound, block.rows, begin, end, line_end);
                         });
      return printer.is_good();
    });
  }
  return finish(printer, std::move(printed));
}

Result<void> write(const Document& document, const kinefile::WriteOptions& options,
                   const Sink& sink, Diagnostics& diagnostics) {
  if (auto taken = expect_kind(document, kWrites, "a motion or a skeleton to write as BVH");
      !taken) {
    return taken;
  }
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (motion != nullptr) {
    auto steady = expect_steady(motion->clip, code::kNotExpressible, "BVH");
    if (!steady) return steady;
  }
  return write_all(
      document, motion == nullptr ? 0 : motion->clip.num_frames,
      [motion](UseBlock use) { return for_each_block(motion->clip, use); }, options, sink,
      diagnostics);
}

Result<void> write_frames(const LongMotion& motion, const kinefile::WriteOptions& options,
                          const Sink& sink, Diagnostics& diagnostics) {
  return write_all(
      motion.document, motion.frames.num_frames,
      [&motion](UseBlock use) { return for_each_block(motion.frames, use); }, options, sink,
      diagnostics);
}

/// Whether the file's positions were read as added to OFFSET.
bool were_positions_added(const Document& document) {
  const KeptFile* const kept = document.kept.get<KeptFile>();
  return kept != nullptr && kept->positions == "add";
}

std::vector<Fact> facts(const Document& document) {
  const KeptFile* const kept = document.kept.get<KeptFile>();
  if (kept == nullptr) return {};
  std::vector<Fact> all = facts_of(kept->text);
  const std::string words = kept->positions == kReplace ? "positions replace OFFSET"
                            : kept->positions == "add"  ? "positions added to OFFSET"
                                                        : "positions " + kept->positions;
  all.push_back({"positions", kept->positions, words});
  return all;
}

}  // namespace

Format format() {
  Format format;
  format.name = "bvh";
  format.description = "Biovision Hierarchy: skeleton and motion";
  format.extensions = kExtensions;
  format.probe = probe;
  format.read = read;
  if (kReadsInBlocks) {
    format.read_pieces = read_pieces;
    format.open_frames = open_frames;
    format.write_frames = write_frames;
  }
  format.write = write;
  format.facts = facts;
  format.adds_positions = were_positions_added;
  format.conventions.writes = kWrites;
  format.conventions.angle_unit = AngleUnit::Degrees;
  format.conventions.turns_at_rest = false;
  format.conventions.has_whole_channels = true;
  format.read_options = kReadOptions;
  format.write_options = kWriteOptions;
  return format;
}

}  // namespace kinefile::bvh
