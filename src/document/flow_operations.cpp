// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "document/operation_tables.hpp"
#include "kinefile/flow.hpp"

namespace kinefile::operation {
namespace {

/// What an operation does to a flow.
template <class Options>
using ChangeOfFlow = Result<PoseFlow> (*)(const PoseFlow&, const Options&, const OperationContext&,
                                          Diagnostics&);

template <class Options, ChangeOfFlow<Options> Change>
Result<void> change_flow_by(Document& document, const Options& options,
                            const OperationContext& context, Diagnostics& diagnostics) {
  const PoseFlow* flow = std::get_if<PoseFlow>(&document.content);
  if (flow == nullptr) return fail(ErrorKind::Usage, "CLI001", "expected a flow of poses");
  Result<PoseFlow> changed = Change(*flow, options, context, diagnostics);
  if (!changed) return fail(std::move(changed.error()));
  document.content = std::move(*changed);
  return {};
}

/// The form of an operation that is a function of a flow.
template <class Options, ChangeOfFlow<Options> Change>
OperationForm flow_form(std::span<const Parameter> parameters = {}) {
  return form<Options, change_flow_by<Options, Change>>(parameters);
}

/// Reads "A:B" or "A:B:SIGN".
std::optional<flow::MirrorPair> parse_pair(const std::string& text) {
  const auto parts = words::split(text, ':');
  if (parts.size() != 2 && parts.size() != 3) return std::nullopt;
  const auto slider = words::integer<std::size_t>(parts[0]);
  const auto partner = words::integer<std::size_t>(parts[1]);
  const auto sign = parts.size() == 3 ? words::integer<int>(parts[2]) : std::optional(-1);
  if (!slider || !partner || !sign || (*sign != 1 && *sign != -1)) return std::nullopt;
  return flow::MirrorPair{*slider, *partner, *sign};
}

/// Reads pairs, "A:B:SIGN,...".
std::optional<std::vector<flow::MirrorPair>> parse_pairs(std::string_view text) {
  std::vector<flow::MirrorPair> pairs;
  for (const std::string& word : words::split(text, ',')) {
    const auto pair = parse_pair(word);
    if (!pair) return std::nullopt;
    pairs.push_back(*pair);
  }
  return pairs.empty() ? std::nullopt : std::optional(pairs);
}

/// Pairs as `mirror` takes them: "A:B:SIGN,...".
std::string words_of_pairs(const std::vector<flow::MirrorPair>& pairs) {
  std::string words;
  for (const flow::MirrorPair& pair : pairs) {
    words +=
        fmt::format("{}{}:{}:{}", words.empty() ? "" : ",", pair.slider, pair.partner, pair.sign);
  }
  return words;
}

bool is_among(const flow::MirrorPair& pair, const std::vector<flow::MirrorPair>& given) {
  return std::any_of(given.begin(), given.end(), [&pair](const flow::MirrorPair& other) {
    return other.slider == pair.slider || other.slider == pair.partner ||
           other.partner == pair.slider || other.partner == pair.partner;
  });
}

/// Pairs of a project, by what the words of a flow show about their signs.
struct ShownPairs {
  std::vector<flow::MirrorPair> shown;     ///< clearly
  std::vector<flow::MirrorPair> doubtful;  ///< those that may have sign 1
  std::vector<flow::MirrorPair> unshown;   ///< those that move, and show nothing
  std::string contradictions;
};

/// Gives pairs the signs that words show clearly.
ShownPairs take_shown_signs(const std::vector<flow::SignEvidence>& evidence,
                            std::vector<flow::MirrorPair>& pairs,
                            const std::vector<flow::MirrorPair>& given) {
  ShownPairs found;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    flow::MirrorPair& pair = pairs[p];
    const auto& [alike, opposite, is_clear, moves] = evidence[p];
    if (is_among(pair, given)) continue;
    if (moves && !alike && !opposite) found.unshown.push_back(pair);
    if (alike && opposite) {
      found.contradictions += fmt::format(
          "{}sliders {} and {} are alike in block {} and opposite in block {}",
          found.contradictions.empty() ? "" : "; ", pair.slider, pair.partner, *alike, *opposite);
    } else if (is_clear && (alike || opposite)) {
      pair.sign = alike ? 1 : -1;
      found.shown.push_back(pair);
    } else if (alike) {
      found.doubtful.push_back({pair.slider, pair.partner, 1});
    }
  }
  return found;
}

/// The pairs of the project that `--project` names; pairs that were given replace those of the same
/// sliders.
/// \errors FLW018 (Usage) if the words contradict each other about the sign of another pair
Result<std::vector<flow::MirrorPair>> project_pairs(const PoseFlow& flow,
                                                    const RobotProject& project,
                                                    const std::vector<flow::MirrorPair>& given,
                                                    Diagnostics& diagnostics) {
  std::vector<flow::MirrorPair> pairs = flow::mirror_pairs_of(project, flow.num_sliders);
  const ShownPairs found =
      take_shown_signs(flow::sign_evidence(flow, project, pairs), pairs, given);
  if (!found.contradictions.empty()) {
    return fail(ErrorKind::Usage, "FLW018",
                fmt::format("the project does not say whether a pair changes its sign, and the "
                            "words contradict each other: {}; mirror=A:B:SIGN says it",
                            found.contradictions));
  }
  if (!found.shown.empty()) {
    diagnostics.add(Severity::Note, "FLW017",
                    fmt::format("the project does not say whether a pair changes its sign; "
                                "the words of poses show it: mirror={}",
                                words_of_pairs(found.shown)));
  }
  if (!found.unshown.empty()) {
    diagnostics.add(Severity::Note, "FLW019",
                    fmt::format("neither the project nor the poses say whether a pair changes its "
                                "sign; these are taken to: mirror={}",
                                words_of_pairs(found.unshown)));
  }
  if (!found.doubtful.empty()) {
    diagnostics.add(Severity::Warning, "FLW015",
                    fmt::format("the project does not say whether a pair changes its sign; some "
                                "are taken to, though the words of both sides are alike in one "
                                "pose, which is not symmetric: mirror={} keeps their sign",
                                words_of_pairs(found.doubtful)));
  }
  std::erase_if(pairs, [&given](const flow::MirrorPair& pair) { return is_among(pair, given); });
  pairs.insert(pairs.end(), given.begin(), given.end());
  return pairs;
}

/// Reads a list of sliders, "0-5+12"; empty if the text is not one.
std::optional<std::vector<std::size_t>> parse_sliders(std::string_view text) {
  std::vector<std::size_t> sliders;
  for (const std::string& part : words::split(text, '+')) {
    const std::size_t dash = part.find('-');
    const auto first = words::integer<std::size_t>(part.substr(0, dash));
    const auto last =
        dash == std::string::npos ? first : words::integer<std::size_t>(part.substr(dash + 1));
    if (!first || !last || *last < *first || *last >= kNumVariables) return std::nullopt;
    for (std::size_t s = *first; s <= *last; ++s) sliders.push_back(s);
  }
  return sliders.empty() ? std::nullopt : std::optional(sliders);
}

/// The flow of another file.
Result<PoseFlow> other_flow(const std::string& path, const OperationContext& context) {
  auto document = open_other(path, context);
  if (!document) return fail(std::move(document.error()));
  if (auto* flow = std::get_if<PoseFlow>(&document->content)) return std::move(*flow);
  return fail(
      make_error(ErrorKind::Usage, "CLI001", fmt::format("'{}' holds no flow of poses", path)));
}

struct FlowMirror {
  std::vector<flow::MirrorPair> pairs;
};

Result<PoseFlow> mirror_flow(const PoseFlow& flow, const FlowMirror& mirror,
                             const OperationContext& context, Diagnostics& diagnostics) {
  if (context.project == nullptr && mirror.pairs.empty()) {
    return fail(make_error(ErrorKind::Usage, "CLI001",
                           "expected --project, which says what the pairs of sliders are, or "
                           "mirror=A:B,..."));
  }
  if (context.project == nullptr) return flow::mirror(flow, mirror.pairs, diagnostics);
  const auto all = project_pairs(flow, *context.project, mirror.pairs, diagnostics);
  if (!all) return fail(all.error());
  return flow::mirror(flow, *all, diagnostics);
}

constexpr std::array<Parameter, 1> kFlowMirror = {
    parameter<&FlowMirror::pairs, parse_pairs>(
        {.name = "pairs",
         .value_name = "A:B[:SIGN],...",
         .help = "Sliders that change places; else those of the project",
         .separator = '='}),
};

Result<PoseFlow> reverse_flow(const PoseFlow& flow, const NoOptions&, const OperationContext&,
                              Diagnostics&) {
  return flow::reverse(flow);
}

struct FlowSpeed {
  double factor = 1;
};

Result<PoseFlow> change_flow_speed(const PoseFlow& flow, const FlowSpeed& speed,
                                   const OperationContext&, Diagnostics& diagnostics) {
  return flow::speed(flow, speed.factor, diagnostics);
}

constexpr std::array<Parameter, 1> kFlowSpeed = {
    parameter<&FlowSpeed::factor>({.name = "factor",
                                   .type = OptionType::Number,
                                   .value_name = "X",
                                   .help = "How many times as fast",
                                   .least = std::numeric_limits<double>::min(),
                                   .is_required = true,
                                   .separator = '='}),
};

struct Offset {
  std::size_t slider = 0;
  int value = 0;
};

Result<PoseFlow> offset_slider(const PoseFlow& flow, const Offset& offset, const OperationContext&,
                               Diagnostics&) {
  return flow::offset(flow, offset.slider, offset.value);
}

constexpr std::array<Parameter, 2> kOffset = {
    parameter<&Offset::slider>({.name = "slider",
                                .type = OptionType::Count,
                                .value_name = "SLIDER",
                                .help = "Whose words change",
                                .is_required = true,
                                .separator = '='}),
    parameter<&Offset::value>({.name = "value",
                               .type = OptionType::Count,
                               .value_name = "VALUE",
                               .help = "What is added to them",
                               .is_required = true,
                               .separator = ':'}),
};

struct Merge {
  std::string file;
  std::vector<std::size_t> sliders;
};

Result<PoseFlow> merge_flow(const PoseFlow& flow, const Merge& merge,
                            const OperationContext& context, Diagnostics&) {
  const auto other = other_flow(merge.file, context);
  if (!other) return fail(other.error());
  return flow::merge(flow, *other, merge.sliders);
}

constexpr std::array<Parameter, 2> kMerge = {
    parameter<&Merge::file>({.name = "file",
                             .type = OptionType::File,
                             .value_name = "FILE",
                             .help = "The other flow",
                             .is_required = true,
                             .separator = '='}),
    parameter<&Merge::sliders, parse_sliders>({.name = "sliders",
                                               .value_name = "SLIDERS",
                                               .help = "Those to take: 0-5+12",
                                               .is_required = true,
                                               .separator = ','}),
};

struct Insert {
  std::size_t block = 0;
  std::string file;
};

Result<PoseFlow> insert_flow(const PoseFlow& flow, const Insert& insert,
                             const OperationContext& context, Diagnostics&) {
  const auto other = other_flow(insert.file, context);
  if (!other) return fail(other.error());
  return flow::insert(flow, insert.block, *other);
}

/// The parameter that names a block.
template <auto Member>
constexpr Parameter block_parameter(std::string_view help) {
  return parameter<Member>({.name = "block",
                            .type = OptionType::Count,
                            .value_name = "BLOCK",
                            .help = help,
                            .is_required = true,
                            .separator = '='});
}

constexpr std::array<Parameter, 2> kInsert = {
    block_parameter<&Insert::block>("The block before"),
    parameter<&Insert::file>({.name = "file",
                              .type = OptionType::File,
                              .value_name = "FILE",
                              .help = "The other flow",
                              .is_required = true,
                              .separator = ','}),
};

struct Delete {
  std::size_t block = 0;
};

Result<PoseFlow> delete_block(const PoseFlow& flow, const Delete& options, const OperationContext&,
                              Diagnostics&) {
  return flow::erase(flow, options.block);
}

constexpr std::array<Parameter, 1> kDelete = {
    block_parameter<&Delete::block>("The block that goes"),
};

}  // namespace

OperationForm reverse_of_flow() { return flow_form<NoOptions, reverse_flow>(); }
OperationForm speed_of_flow() { return flow_form<FlowSpeed, change_flow_speed>(kFlowSpeed); }
OperationForm mirror_of_flow() { return flow_form<FlowMirror, mirror_flow>(kFlowMirror); }

OperationInfo offset() {
  return {.name = "offset",
          .help = "Adds to the words of a slider",
          .flow_form = flow_form<Offset, offset_slider>(kOffset)};
}

OperationInfo merge() {
  return {.name = "merge",
          .help = "Sliders of another flow",
          .flow_form = flow_form<Merge, merge_flow>(kMerge)};
}

OperationInfo insert() {
  return {.name = "insert",
          .help = "Poses of another flow after a block",
          .flow_form = flow_form<Insert, insert_flow>(kInsert)};
}

OperationInfo erase() {
  return {.name = "delete",
          .help = "A flow without a block",
          .flow_form = flow_form<Delete, delete_block>(kDelete)};
}

}  // namespace kinefile::operation
