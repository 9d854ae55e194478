// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "document/operation_tables.hpp"
#include "document/operation_words.hpp"
#include "kinefile/flow.hpp"

namespace kinefile::operation {
namespace {

/// An operation that makes a flow out of a flow.
template <class Change>
ApplyOperation on_flow(Change change) {
  return [change](Document& document, const OperationContext& context,
                  Diagnostics& diagnostics) -> Result<void> {
    const PoseFlow* flow = std::get_if<PoseFlow>(&document.content);
    if (flow == nullptr) return fail(ErrorKind::Usage, "CLI001", "expected a flow of poses");
    Result<PoseFlow> changed = change(*flow, context, diagnostics);
    if (!changed) return fail(std::move(changed.error()));
    document.content = std::move(*changed);
    return {};
  };
}

/// Splits a text at the first such character; nothing if there is none.
std::optional<std::pair<std::string, std::string>> split_at(const std::string& text,
                                                            std::size_t at) {
  if (at == std::string::npos) return std::nullopt;
  return std::pair(text.substr(0, at), text.substr(at + 1));
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

/// The pairs of the project that `--project` names, but of sliders in pairs that were given those.
Result<std::vector<flow::MirrorPair>> project_pairs(const PoseFlow& flow,
                                                    const RobotProject& project,
                                                    const std::vector<flow::MirrorPair>& given,
                                                    Diagnostics& diagnostics) {
  std::vector<flow::MirrorPair> pairs = flow::mirror_pairs_of(project, flow.num_sliders);
  std::erase_if(pairs, [&given](const flow::MirrorPair& pair) {
    return std::any_of(given.begin(), given.end(), [&pair](const flow::MirrorPair& other) {
      return other.slider == pair.slider || other.slider == pair.partner ||
             other.partner == pair.slider || other.partner == pair.partner;
    });
  });
  std::string words;
  for (const flow::MirrorPair& pair : flow::doubtful_pairs(flow, pairs)) {
    words += fmt::format("{}{}:{}:1", words.empty() ? "" : ",", pair.slider, pair.partner);
  }
  if (!words.empty()) {
    diagnostics.add(Severity::Warning, "FLW015",
                    fmt::format("the project does not say whether a pair changes its sign; all are "
                                "taken to, though words of some are alike on both sides: mirror={} "
                                "keeps theirs",
                                words));
  }
  pairs.insert(pairs.end(), given.begin(), given.end());
  return pairs;
}

/// Reads a list of sliders, "0-5+12"; nothing if it is none.
std::optional<std::vector<std::size_t>> parse_sliders(const std::string& text) {
  std::vector<std::size_t> sliders;
  for (const std::string& part : words::split(text, '+')) {
    const auto ends = split_at(part, part.find('-'));
    const auto first = words::integer<std::size_t>(ends ? ends->first : part);
    const auto last = ends ? words::integer<std::size_t>(ends->second) : first;
    if (!first || !last || *last < *first || *last >= kNumVariables) return std::nullopt;
    for (std::size_t s = *first; s <= *last; ++s) sliders.push_back(s);
  }
  return sliders;
}

/// The flow of another file.
Result<PoseFlow> other_flow(const std::string& path, const OperationContext& context) {
  auto document = open_other(path, context);
  if (!document) return fail(std::move(document.error()));
  if (auto* flow = std::get_if<PoseFlow>(&document->content)) return std::move(*flow);
  return fail(
      make_error(ErrorKind::Usage, "CLI001", fmt::format("'{}' holds no flow of poses", path)));
}

}  // namespace

ApplyOperation parse_flow_mirror(const std::string* argument) {
  std::vector<flow::MirrorPair> pairs;
  if (argument != nullptr) {
    for (const std::string& word : words::split(*argument, ',')) {
      const auto pair = parse_pair(word);
      if (!pair) return {};
      pairs.push_back(*pair);
    }
  }
  return on_flow([pairs](const PoseFlow& flow, const OperationContext& context,
                         Diagnostics& diagnostics) -> Result<PoseFlow> {
    if (context.project == nullptr && pairs.empty()) {
      return fail(make_error(ErrorKind::Usage, "CLI001",
                             "expected --project, which says what the pairs of sliders are, or "
                             "mirror=A:B,..."));
    }
    if (context.project == nullptr) return flow::mirror(flow, pairs, diagnostics);
    const auto all = project_pairs(flow, *context.project, pairs, diagnostics);
    if (!all) return fail(all.error());
    return flow::mirror(flow, *all, diagnostics);
  });
}

ApplyOperation parse_flow_reverse(const std::string* argument) {
  if (argument != nullptr) return {};
  return on_flow([](const PoseFlow& flow, const OperationContext&, Diagnostics&) {
    return flow::reverse(flow);
  });
}

ApplyOperation parse_flow_speed(const std::string* argument) {
  const auto factor = argument != nullptr ? words::finite(*argument) : std::nullopt;
  if (!factor || !(*factor > 0)) return {};
  return on_flow([factor](const PoseFlow& flow, const OperationContext&, Diagnostics& diagnostics) {
    return flow::speed(flow, *factor, diagnostics);
  });
}

ApplyOperation parse_flow_offset(const std::string* argument) {
  const auto parts = argument != nullptr ? split_at(*argument, argument->find(':')) : std::nullopt;
  const auto slider = parts ? words::integer<std::size_t>(parts->first) : std::nullopt;
  const auto offset = parts ? words::integer<int>(parts->second) : std::nullopt;
  if (!slider || !offset) return {};
  return on_flow([slider, offset](const PoseFlow& flow, const OperationContext&, Diagnostics&) {
    return flow::offset(flow, *slider, *offset);
  });
}

ApplyOperation parse_flow_merge(const std::string* argument) {
  // Names of files may hold commas, lists of sliders do not.
  const auto parts = argument != nullptr ? split_at(*argument, argument->rfind(',')) : std::nullopt;
  const auto sliders = parts ? parse_sliders(parts->second) : std::nullopt;
  if (!sliders || parts->first.empty()) return {};
  return on_flow([path = parts->first, sliders](const PoseFlow& flow,
                                                const OperationContext& context,
                                                Diagnostics&) -> Result<PoseFlow> {
    const auto other = other_flow(path, context);
    if (!other) return other;
    return flow::merge(flow, *other, *sliders);
  });
}

ApplyOperation parse_flow_insert(const std::string* argument) {
  const auto parts = argument != nullptr ? split_at(*argument, argument->find(',')) : std::nullopt;
  const auto block = parts ? words::integer<std::size_t>(parts->first) : std::nullopt;
  if (!block || parts->second.empty()) return {};
  return on_flow([block, path = parts->second](const PoseFlow& flow,
                                               const OperationContext& context,
                                               Diagnostics&) -> Result<PoseFlow> {
    const auto other = other_flow(path, context);
    if (!other) return other;
    return flow::insert(flow, *block, *other);
  });
}

ApplyOperation parse_flow_delete(const std::string* argument) {
  const auto block = argument != nullptr ? words::integer<std::size_t>(*argument) : std::nullopt;
  if (!block) return {};
  return on_flow([block](const PoseFlow& flow, const OperationContext&, Diagnostics&) {
    return flow::erase(flow, *block);
  });
}

}  // namespace kinefile::operation
