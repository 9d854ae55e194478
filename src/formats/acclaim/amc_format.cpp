// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>

#include "formats/acclaim/bind.hpp"
#include "formats/acclaim/codes.hpp"
#include "formats/acclaim/format.hpp"
#include "formats/acclaim/parser.hpp"
#include "formats/acclaim/print.hpp"
#include "formats/common_options.hpp"
#include "formats/files.hpp"
#include "text/decode.hpp"
#include "text/scanner.hpp"

namespace kinefile::acclaim {
namespace {

constexpr Kinds kAmcWrites = {.motions = true};
constexpr std::array<std::string_view, 1> kAmcExtensions = {".amc"};
constexpr std::array<ReadOption, 4> kAmcReadOptions = {options::kFps, options::kEncoding,
                                                       options::kUnitIn, options::kUpIn};
constexpr std::array<WriteOption, 1> kAmcWriteOptions = {options::kDecimals};
constexpr double kUsualRate = 120;

bool probe_amc(std::string_view head) {
  constexpr std::array<std::string_view, 4> kKeywords = {":fully-specified", ":degrees", ":radians",
                                                         ":force-all-joints-be-3dof"};
  return text::starts_with_ignoring_case(head, "#!OML:ASF") ||
         text::is_one_of(Lexer(head).take(), kKeywords);
}

/// The skeleton of a motion, and the data kept from its file.
struct Found {
  Skeleton skeleton;
  AsfFile kept;
  std::string name;
};

/// The skeleton as :FORCE-ALL-JOINTS-BE-3DOF makes it.
Result<Skeleton> forced(const Document& document) {
  auto unbound = unbind(skeleton_of(document), kept_file_of(document));
  if (!unbound) return fail(std::move(unbound.error()));
  const double length = unbound->file.length.value_or(1.0);
  const Skeleton& skeleton = skeleton_of(document);
  return bind(unbound->file, {true, skeleton.metres_per_unit * length, skeleton.up});
}

/// The skeleton that was read earlier.
Result<Found> skeleton_of_options(const AmcHeader& header, const ReadOptions& options,
                                  Diagnostics& diagnostics) {
  const Document& document = *options.skeleton;
  const std::string& name = options.skeleton_name;
  const auto refuse = [&](const std::string& why) {
    Error error = make_error(ErrorKind::Usage, code::kOtherSkeleton,
                             fmt::format("expected an ASF skeleton, found {}", why), name);
    diagnostics.add(error);
    return fail(std::move(error));
  };
  if (document.format != "asf") return refuse(document.format);
  auto skeleton = header.forces_3dof ? forced(document) : skeleton_of(document);
  if (!skeleton) return refuse("one that ASF cannot say: " + skeleton.error().message);
  return Found{std::move(*skeleton), kept_file_of(document).asf, name};
}

Result<Found> skeleton_beside(const AmcHeader& header, const text::Source& source,
                              const ReadOptions& options, Diagnostics& diagnostics) {
  const char* at = header.hint_at != nullptr ? header.hint_at : source.text().data();
  std::string how;
  const auto companion = find_skeleton(header, options, how);
  if (!companion) {
    const std::string hint =
        header.skeleton_hint.empty()
            ? ""
            : fmt::format(", which names {}", text::quoted(header.skeleton_hint));
    text::report(source, diagnostics, Severity::Error, code::kNoSkeleton,
                 fmt::format("expected the .asf file of this motion{} beside it, found none, or "
                             "several; --skeleton names it",
                             hint),
                 at);
    return fail(diagnostics.first_error());
  }
  text::report(source, diagnostics, Severity::Note, code::kSkeletonFound,
               fmt::format("the skeleton is '{}', {}", companion->name, how), at);
  ReadOptions skeleton_options = options;
  skeleton_options.source_name = companion->name;
  skeleton_options.encoding.clear();
  auto skeleton = read_skeleton(companion->bytes, skeleton_options, diagnostics);
  if (!skeleton) return fail(std::move(skeleton.error()));
  const BindOptions how_bound = {header.forces_3dof, skeleton->metres_per_quotient, options.up};
  return Found{bind(skeleton->file, how_bound), kept_of(std::move(skeleton->file)),
               companion->name};
}

Timeline timeline_of(const AmcHeader& header, const text::Source& source,
                     const ReadOptions& options, Diagnostics& diagnostics) {
  const double rate = options.fps.value_or(header.samples_per_second.value_or(kUsualRate));
  if (!options.fps && !header.samples_per_second) {
    text::report(source, diagnostics, Severity::Note, code::kRateAssumed,
                 "the file does not say its frame rate; 120 frames a second are assumed (--fps "
                 "says otherwise)",
                 source.text().data());
  }
  return {FrameRate{rate}, 0};
}

/// The data of the file that is kept for `write`.
KeptMotion kept_motion(const AmcHeader& header, const AmcBody& body,
                       const std::vector<BoneColumns>& bones, const ReadOptions& options) {
  KeptMotion kept;
  kept.other_lines = header.other_lines;
  kept.forces_3dof = header.forces_3dof;
  kept.rate = options.fps                 ? RateSource::Asked
              : header.samples_per_second ? RateSource::File
                                          : RateSource::Assumed;
  for (const std::size_t b : body.bone_order) kept.bone_order.push_back(bones[b].name);
  return kept;
}

/// Frames of a file that are not in the text of its beginning.
struct RestOfFrames {
  const ByteSource& bytes;
  std::size_t offset = 0;  ///< where one begins
};

/// Reads them behind those of the beginning; false if any of them is not like the first one.
bool read_rest(const RestOfFrames& rest, AmcBody& body) {
  if (!body.like) return false;
  const auto count = read_like_frames(*body.like, rest.bytes, rest.offset,
                                      body.last_frame_number + 1, body.values);
  body.num_frames += count.value_or(0);
  return count.has_value();
}

/// Reads a motion. Fails without an error if the rest is to be read in another way.
/// \param rest  more frames, behind the text; null: there are none
std::optional<Document> read_amc_text(const text::DecodedText& decoded, const RestOfFrames* rest,
                                      const ReadOptions& options, Diagnostics& diagnostics) {
  const text::Source source(options.source_name, decoded.view());
  Parser parser{source, options.lenient, diagnostics, Lexer(source.text())};
  const AmcHeader header = parse_amc_header(parser);
  auto found = options.skeleton != nullptr ? skeleton_of_options(header, options, diagnostics)
                                           : skeleton_beside(header, source, options, diagnostics);
  if (!found) {
    if (!diagnostics.has_errors()) diagnostics.add(found.error());
    return std::nullopt;
  }
  Motion motion;
  motion.skeleton = std::move(found->skeleton);
  if (header.angle) tell_angles_in(*header.angle, motion.skeleton);
  const std::vector<BoneColumns> bones = columns_of_bones(motion.skeleton);
  AmcBody body = parse_amc_body(parser, bones, found->name);
  if (diagnostics.has_errors() || (rest != nullptr && !read_rest(*rest, body))) return std::nullopt;
  motion.clip.timeline = timeline_of(header, source, options, diagnostics);
  motion.clip.timeline.first_frame_number = body.first_frame_number;
  motion.clip.num_frames = body.num_frames;
  motion.clip.num_coordinates = motion.skeleton.coordinates.size();
  motion.clip.values = std::move(body.values);

  KeptMotion kept = kept_motion(header, body, bones, options);
  kept.skeleton_name = found->name;
  Document document;
  document.format = "amc";
  document.kept = Kept(KeptFile{layout_of(decoded), std::move(found->kept), std::move(kept)});
  document.content = std::move(motion);
  return document;
}

Result<Document> read_amc_alone(std::string_view bytes, const ReadOptions& options,
                                Diagnostics& diagnostics) {
  const auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded) return fail(decoded.error());
  auto document = read_amc_text(*decoded, nullptr, options, diagnostics);
  if (!document) return fail(diagnostics.first_error());
  return *std::move(document);
}

std::optional<Result<Document>> read_amc_pieces(const ByteSource& bytes, const ReadOptions& options,
                                                Diagnostics& diagnostics) {
  const Array<char> head = text::read_head_to(bytes, third_frame_in);
  if (head.empty()) return std::nullopt;
  const auto decoded =
      text::decode({head.data(), head.size()}, options.encoding, options.source_name, diagnostics);
  if (!decoded || !decoded->storage.empty()) return std::nullopt;
  const RestOfFrames rest{bytes, head.size()};
  auto document = read_amc_text(*decoded, &rest, options, diagnostics);
  if (!document || diagnostics.has_errors()) return std::nullopt;
  return *std::move(document);
}

Result<Document> read_amc(std::string_view bytes, const ReadOptions& options,
                          Diagnostics& diagnostics) {
  return read_with_own_diagnostics(read_amc_alone, bytes, options, diagnostics);
}

AmcHeading heading_of(const KeptFile& kept, const Motion& motion, const WriteOptions& options) {
  AmcHeading heading;
  heading.skeleton = options.companion;
  heading.angle = motion.skeleton.angle_unit;
  if (!kept.motion) return heading;
  heading.other_lines = kept.motion->other_lines;
  heading.bone_order = kept.motion->bone_order;
  heading.first_frame_number = motion.clip.timeline.first_frame_number;
  // A rate that the file did not specify is written only if it has changed.
  heading.says_rate =
      kept.motion->rate != RateSource::Assumed || frame_rate(motion.clip.timeline) != kUsualRate;
  return heading;
}

/// \errors ASF020 (DataLoss) if frames have a rate that the reader does not take
Result<void> expect_rate(const Timeline& timeline) {
  const double rate = frame_rate(timeline);
  if (rate >= kLeastRate && rate <= kMostRate) return {};
  return fail(make_error(
      ErrorKind::DataLoss, code::kNotExpressible,
      fmt::format("AMC has {} to {} frames a second, not {}", kLeastRate, kMostRate, rate)));
}

/// Writes a motion, whose own frames are not looked at.
Result<void> write_all(const Document& document, EachBlock frames, const WriteOptions& options,
                       const Sink& sink) {
  const Motion& motion = std::get<Motion>(document.content);
  const Timeline& timeline = motion.clip.timeline;
  if (auto rate = expect_rate(timeline); !rate) return rate;
  const KeptFile kept = kept_file_of(document);
  auto unbound = unbind(motion.skeleton, kept);
  if (!unbound) return fail(std::move(unbound.error()));
  text::Printer printer(sink, {.decimals = options.decimals});
  return finish(printer,
                print_amc(printer, *unbound, heading_of(kept, motion, options), timeline,
                          motion.skeleton.coordinates.size(), frames, line_end_of(kept.text)));
}

Result<void> write_amc(const Document& document, const WriteOptions& options, const Sink& sink,
                       Diagnostics&) {
  const Motion* motion = std::get_if<Motion>(&document.content);
  if (motion == nullptr && has_skeleton(document)) {
    return fail(make_error(ErrorKind::Usage, code::kNeedsAsf,
                           "expected a motion to write as AMC, found a skeleton alone, which is "
                           "written as ASF"));
  }
  if (auto taken = expect_kind(document, kAmcWrites, "a motion to write as AMC"); !taken) {
    return taken;
  }
  auto steady = expect_steady(motion->clip, code::kNotExpressible, "AMC");
  if (!steady) return steady;
  return write_all(
      document, [motion](UseBlock use) { return for_each_block(motion->clip, use); }, options,
      sink);
}

Result<void> write_amc_frames(const LongMotion& motion, const WriteOptions& options,
                              const Sink& sink, Diagnostics&) {
  return write_all(
      motion.document, [&motion](UseBlock use) { return for_each_block(motion.frames, use); },
      options, sink);
}

}  // namespace

Format amc_format() {
  Format format;
  format.name = "amc";
  format.description = "Acclaim motion, with its skeleton beside it";
  format.extensions = kAmcExtensions;
  format.companion = "asf";
  format.probe = probe_amc;
  format.read = read_amc;
  if (kReadsInBlocks) format.read_pieces = read_amc_pieces;
  format.write = write_amc;
  if (kReadsInBlocks) format.write_frames = write_amc_frames;
  format.facts = facts;
  format.takes_skeleton = true;
  format.conventions.writes = kAmcWrites;
  format.conventions.has_one_end = true;
  format.read_options = kAmcReadOptions;
  format.write_options = kAmcWriteOptions;
  return format;
}

}  // namespace kinefile::acclaim
