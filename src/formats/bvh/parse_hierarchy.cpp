// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_set>
#include <utility>

#include "formats/bvh/codes.hpp"
#include "formats/bvh/parser.hpp"
#include "kinefile/skeleton.hpp"
#include "text/numbers.hpp"

namespace kinefile::bvh {
namespace {

using text::equals_ignoring_case;
using text::quoted;
using text::starts_with_ignoring_case;

/// After this many structural errors the rest of the hierarchy gives no new information.
constexpr std::size_t kMaxStructureErrors = 20;

/// A node or an End Site whose closing brace was not read yet.
struct OpenBlock {
  std::size_t node = 0;
  bool is_end_site = false;
  bool has_offset = false;
  bool has_channels = false;
  const char* at = nullptr;     ///< where it was named
  std::size_t indentation = 0;  ///< of its keyword
};

struct Hierarchy {
  Parser& parser;
  std::vector<OpenBlock> open;
  std::vector<const char*> name_places;
  std::size_t num_structure_errors = 0;
  bool is_cut_off = false;  ///< the file ended too early, which was reported
  /// How many joints are indented further than their parents, and how many are not.
  std::size_t num_indented = 0;
  std::size_t num_not_indented = 0;

  File& file() { return parser.file; }
  text::Scanner& scanner() { return parser.scanner; }
};

bool is_end_site_word(std::string_view word) {
  return equals_ignoring_case(word, "End") || starts_with_ignoring_case(word, "EndSite");
}

bool is_motion_word(std::string_view word) {
  return equals_ignoring_case(word, "MOTION") || starts_with_ignoring_case(word, "Frames") ||
         equals_ignoring_case(word, "Frame");
}

void report_structure(Hierarchy& h, std::string_view expected, std::string_view found) {
  if (found.empty() && std::exchange(h.is_cut_off, true)) return;
  const char* code = found.empty() ? code::kUnexpectedEnd : code::kUnexpectedWord;
  h.parser.report(Severity::Error, code,
                  fmt::format("expected {}, found {}", expected, quoted(found)), found.data());
  h.parser.is_structure_sound = false;
  ++h.num_structure_errors;
}

/// Reports a joint without a name, and makes one.
/// \param next  the brace in its place
std::string_view make_node_name(Hierarchy& h, std::string_view keyword, std::string_view next) {
  std::string name = fmt::format("joint{}", h.file().nodes.size());
  const std::string remedy = fmt::format("it is called '{}'", name);
  h.parser.repair(code::kNoName,
                  fmt::format("expected a name after {}, found {}", keyword, quoted(next)), remedy,
                  next.data(), "gives it one");
  return h.file().made_names.emplace_back(std::move(name));
}

/// Consumes the name after ROOT or JOINT; it may contain blanks, and may be on the next line.
/// \param at  out: its place
std::string_view take_node_name(Hierarchy& h, std::string_view keyword, const char*& at) {
  std::string_view name = h.scanner().take_name();
  if (name.empty()) {
    while (skip_comment(h.parser)) continue;
    const std::string_view next = h.scanner().peek();
    at = next.data();
    if (next.empty()) {
      report_structure(h, fmt::format("a name after {}", keyword), next);
      return next;
    }
    if (next == "{" || next == "}") return make_node_name(h, keyword, next);
    name = h.scanner().take_name();
  }
  at = name.data();
  return name;
}

/// The number of characters before a word in its line, or a limit: a whole file may be one line.
std::size_t indentation_of(const Hierarchy& h, const char* word) {
  constexpr std::ptrdiff_t kMost = 1000;
  const char* const begin = h.parser.source.text().data();
  const char* p = word;
  while (p != begin && word - p < kMost && !text::is_line_end(p[-1])) --p;
  return static_cast<std::size_t>(word - p);
}

void take_open_brace(Hierarchy& h) {
  while (skip_comment(h.parser)) continue;
  const std::string_view word = h.scanner().peek();
  if (word == "{") {
    h.scanner().take();
  } else {
    report_structure(h, "'{'", word);
  }
}

/// \param word  the keyword in the text
void open_node(Hierarchy& h, std::string_view keyword, std::string_view word, std::size_t parent) {
  Node node;
  const std::size_t indentation = indentation_of(h, word.data());
  if (!h.open.empty()) {
    ++(indentation > h.open.back().indentation ? h.num_indented : h.num_not_indented);
  }
  const char* at = nullptr;
  node.name = take_node_name(h, keyword, at);
  node.parent = parent;
  h.open.push_back({h.file().nodes.size(), false, false, false, at, indentation});
  h.name_places.push_back(at);
  h.file().nodes.push_back(std::move(node));
  take_open_brace(h);
}

/// `End Site`, `End site`, `EndSite`, `End Site NAME`, and `End Site20`, whose name is 20.
void open_end_site(Hierarchy& h, std::string_view word) {
  const std::size_t node = h.open.back().node;
  constexpr std::size_t kSiteLength = 4;
  std::string_view site = word.substr(3);
  if (site.empty()) site = h.scanner().take_in_line();
  if (!starts_with_ignoring_case(site, "Site")) {
    report_structure(h, "Site after End", site.empty() ? h.scanner().peek() : site);
    if (site.empty()) return;
  }
  h.scanner().move_to(site.data() + std::min(site.size(), kSiteLength));
  h.open.push_back({node, true, false, true, word.data(), 0});
  h.file().nodes[node].end_sites.push_back({h.scanner().take_name(), {}});
  take_open_brace(h);
}

void parse_offset(Hierarchy& h, std::string_view keyword) {
  OpenBlock& block = h.open.back();
  Node& node = h.file().nodes[block.node];
  if (block.has_offset) {
    h.parser.report(Severity::Error, code::kGivenTwice, "expected one OFFSET, found another",
                    keyword.data());
  }
  block.has_offset = true;
  auto& offset = block.is_end_site ? node.end_sites.back().offset : node.offset;
  for (double& component : offset) {
    const std::string_view token = h.scanner().peek();
    const auto value = parse_value(h.parser, token, code::kBadOffset, "3 numbers after OFFSET");
    if (!value) {
      h.is_cut_off |= token.empty();
      if (!is_keyword(token)) h.scanner().take_name();
      return;
    }
    h.scanner().take();
    component = *value;
  }
}

/// Whether a channel can follow others: one direction has one position and one scale, and no order
/// of rotations has a letter twice in a row, though ZXZ has one twice.
bool can_follow(std::span<const Channel> before, const Channel& channel) {
  if (channel.kind == ChannelKind::Unknown) return true;
  for (auto other = before.rbegin(); other != before.rend(); ++other) {
    if (other->kind != channel.kind) continue;
    if (other->axis == channel.axis) return false;
    if (channel.kind == ChannelKind::Rotation) return true;
  }
  return true;
}

/// Warns of the first channel of a joint that its list names again.
void check_channels_differ(Hierarchy& h, const Node& node) {
  const std::span<const Channel> all(node.channels);
  for (std::size_t c = 1; c < all.size(); ++c) {
    if (can_follow(all.first(c), all[c])) continue;
    h.parser.report(Severity::Warning, code::kChannelTwice,
                    fmt::format("expected another channel of '{}' here, found {} again; both are "
                                "read",
                                node.name, quoted(all[c].word)),
                    all[c].word.data());
    return;
  }
}

/// Reads the words of a CHANNELS list, which may continue in the next line.
void take_channel_words(Hierarchy& h, Node& node, std::size_t claim) {
  while (true) {
    if (skip_comment(h.parser)) continue;
    const std::string_view word = h.scanner().peek();
    const Channel channel = channel_of_word(word);
    if (node.channels.size() == kMaxChannels && !is_keyword(word)) {
      h.parser.report(
          Severity::Error, code::kBadChannelCount,
          fmt::format("expected at most {} channels in a joint, found more", kMaxChannels),
          word.data());
      h.parser.is_structure_sound = false;
      h.scanner().take_name();
      return;
    }
    if (channel.kind == ChannelKind::Unknown) {
      if (is_keyword(word) || node.channels.size() >= claim) return;
      h.parser.repair(code::kUnknownChannel,
                      fmt::format("expected a channel such as Xposition, Yrotation or Zscale, "
                                  "found {}",
                                  quoted(word)),
                      "its column is kept and moves nothing", word.data());
    }
    node.channels.push_back(channel);
    h.scanner().take();
  }
}

/// Whether this is CHANNELS 0 in an End Site, which `--lenient` passes over.
bool pass_over_no_channels(Hierarchy& h, std::string_view keyword) {
  if (!h.open.back().is_end_site) return false;
  const std::string_view count = h.scanner().peek();
  if (text::parse_count(count) != 0) return false;
  h.scanner().take();
  const std::string_view next = h.scanner().peek();
  if (channel_of_word(next).kind != ChannelKind::Unknown) {
    h.scanner().move_to(count.data());
    return false;
  }
  h.parser.repair(code::kGivenTwice, "expected no CHANNELS in an End Site, found CHANNELS 0",
                  "it is passed over", keyword.data(), "passes over it");
  return true;
}

void parse_channels(Hierarchy& h, std::string_view keyword) {
  if (pass_over_no_channels(h, keyword)) return;
  OpenBlock& block = h.open.back();
  Node& node = h.file().nodes[block.node];
  if (block.has_channels) {
    h.parser.report(Severity::Error, code::kGivenTwice,
                    block.is_end_site ? "expected no CHANNELS in an End Site, found some"
                                      : "expected one CHANNELS list, found another",
                    keyword.data());
    h.parser.is_structure_sound = false;
  }
  block.has_channels = true;
  const std::string_view token = h.scanner().peek();
  if (token.empty()) return report_structure(h, "a count after CHANNELS", token);
  const auto claim = text::parse_count(token);
  if (!claim || *claim > kMaxChannels) {
    h.parser.report(Severity::Error, code::kBadChannelCount,
                    fmt::format("expected a count from 0 to {} after CHANNELS, found {}",
                                kMaxChannels, quoted(token)),
                    token.data());
    h.parser.is_structure_sound = false;
    if (!claim && channel_of_word(token).kind == ChannelKind::Unknown) {
      if (!is_keyword(token)) h.scanner().take_name();
      return;
    }
  }
  if (claim) h.scanner().take();
  const std::size_t num_before = node.channels.size();
  take_channel_words(h, node, claim.value_or(0));
  const std::size_t num_words = node.channels.size() - num_before;
  const bool is_counted = node.channels.size() < kMaxChannels;
  if (claim && *claim <= kMaxChannels && *claim != num_words && is_counted) {
    h.parser.report(Severity::Warning, code::kChannelCountDiffers,
                    fmt::format("CHANNELS says {}, but {} {}; as many columns are read", *claim,
                                num_words, num_words == 1 ? "name follows" : "names follow"),
                    token.data());
  }
  if (h.parser.is_structure_sound) check_channels_differ(h, node);
}

void close_block(Hierarchy& h) {
  const OpenBlock block = h.open.back();
  const Node& node = h.file().nodes[block.node];
  h.open.pop_back();
  if (!block.has_offset) {
    h.parser.repair(code::kNoOffset,
                    block.is_end_site
                        ? fmt::format("expected an OFFSET in the End Site of '{}', "
                                      "found none",
                                      node.name)
                        : fmt::format("expected an OFFSET in joint '{}', found none", node.name),
                    "0 0 0 is assumed", block.at);
  }
  if (!block.has_channels) {
    h.parser.report(Severity::Warning, code::kNoChannels,
                    fmt::format("joint '{}' has no CHANNELS list; it has no columns", node.name),
                    block.at);
  }
}

void skip_wrong_word(Hierarchy& h, std::string_view expected, std::string_view word) {
  report_structure(h, expected, word);
  if (word != "{") h.scanner().take_name();
}

/// Whether a missing brace may be one in the middle, so that later joints have wrong parents: a
/// joint has an End Site and then a joint, or is not indented further than its parent where others
/// are.
bool may_lack_inner_brace(const Hierarchy& h) {
  if (h.num_indented > 0 && h.num_not_indented > 0) return true;
  const std::vector<Node>& nodes = h.parser.file.nodes;
  return std::any_of(nodes.begin(), nodes.end(), [&nodes](const Node& node) {
    return node.parent != kNoParent && !nodes[node.parent].end_sites.empty();
  });
}

/// At the end of the hierarchy: closes the blocks that are open, which `--lenient` allows. Returns
/// whether that is possible.
bool close_open_blocks(Hierarchy& h, std::string_view word) {
  const bool has_end_without_offset = h.open.back().is_end_site && !h.open.back().has_offset;
  if (word.empty() || has_end_without_offset || may_lack_inner_brace(h)) return false;
  while (!h.open.empty()) {
    const OpenBlock& block = h.open.back();
    const std::string_view name = h.file().nodes[block.node].name;
    const bool is_closed = h.parser.repair(
        code::kUnexpectedWord,
        fmt::format("expected '}}' to close {}'{}', found {}",
                    block.is_end_site ? "the End Site of " : "", name, quoted(word)),
        "it is closed here", word.data(), "closes it");
    if (!is_closed) {
      h.parser.is_structure_sound = false;
      return true;
    }
    close_block(h);
  }
  return true;
}

/// A word inside a ROOT or JOINT. Returns false at the end of the hierarchy.
bool parse_in_node(Hierarchy& h, std::string_view word) {
  const std::size_t node = h.open.back().node;
  if (equals_ignoring_case(word, "OFFSET")) {
    parse_offset(h, word);
  } else if (equals_ignoring_case(word, "CHANNELS")) {
    parse_channels(h, word);
  } else if (equals_ignoring_case(word, "JOINT")) {
    open_node(h, "JOINT", word, node);
  } else if (is_end_site_word(word)) {
    open_end_site(h, word);
  } else if (word == "}") {
    close_block(h);
  } else if (is_motion_word(word) || word.empty()) {
    const Node& open = h.file().nodes[node];
    if (!close_open_blocks(h, word)) {
      report_structure(h, fmt::format("'}}' to close '{}'", open.name), word);
    }
    h.scanner().move_to(word.data());
    return false;
  } else if (equals_ignoring_case(word, "ROOT")) {
    report_structure(h, "JOINT within a joint", word);
    open_node(h, "ROOT", word, node);
  } else {
    skip_wrong_word(h, "OFFSET, CHANNELS, JOINT, End Site or '}'", word);
  }
  return true;
}

/// A word inside an End Site. Returns false at the end of the hierarchy.
bool parse_in_end_site(Hierarchy& h, std::string_view word) {
  if (equals_ignoring_case(word, "OFFSET")) {
    parse_offset(h, word);
  } else if (equals_ignoring_case(word, "CHANNELS")) {
    parse_channels(h, word);
  } else if (word == "}") {
    close_block(h);
  } else if (is_motion_word(word) || word.empty()) {
    if (!close_open_blocks(h, word)) {
      report_structure(h, "OFFSET or '}' in an End Site", word);
    }
    h.scanner().move_to(word.data());
    return false;
  } else {
    skip_wrong_word(h, "OFFSET or '}' in an End Site", word);
  }
  return true;
}

/// A word outside of all braces. Returns false at the end of the hierarchy.
bool parse_at_top(Hierarchy& h, std::string_view word) {
  if (equals_ignoring_case(word, "ROOT")) {
    open_node(h, "ROOT", word, kNoParent);
  } else if (equals_ignoring_case(word, "JOINT")) {
    report_structure(h, "ROOT or MOTION", word);
    open_node(h, "JOINT", word, kNoParent);
  } else if (word == "}") {
    h.parser.report(Severity::Warning, code::kExtraBrace,
                    "expected ROOT or MOTION, found another '}'; it is passed over", word.data());
  } else if (word.empty() || is_motion_word(word)) {
    h.scanner().move_to(word.data());
    return false;
  } else {
    skip_wrong_word(h, "ROOT or MOTION", word);
  }
  return true;
}

bool parse_next(Hierarchy& h) {
  const std::string_view word = h.scanner().take();
  if (h.open.empty()) return parse_at_top(h, word);
  return h.open.back().is_end_site ? parse_in_end_site(h, word) : parse_in_node(h, word);
}

bool parse_first_word(Parser& parser) {
  while (skip_comment(parser)) continue;
  const std::string_view word = parser.scanner.peek();
  if (equals_ignoring_case(word, "HIERARCHY")) {
    parser.scanner.take();
    return true;
  }
  if (equals_ignoring_case(word, "ROOT")) {
    parser.report(Severity::Warning, code::kNoHierarchyWord,
                  "expected HIERARCHY before ROOT; the file is read without it", word.data());
    return true;
  }
  parser.report(
      Severity::Error, code::kNotBvh,
      fmt::format("expected HIERARCHY at the start of a BVH file, found {}", quoted(word)),
      word.data());
  return false;
}

void check_names(Hierarchy& h) {
  std::unordered_set<std::string_view> seen;
  for (std::size_t i = 0; i < h.file().nodes.size(); ++i) {
    const std::string_view name = h.file().nodes[i].name;
    if (!name.empty() && !seen.insert(name).second) {
      h.parser.report(Severity::Warning, code::kRepeatedName,
                      fmt::format("joint name {} stands for more than one joint", quoted(name)),
                      h.name_places[i]);
    }
  }
}

/// Consumes MOTION, which may be missing. Returns whether there is motion to read.
bool take_motion_word(Hierarchy& h) {
  Parser& parser = h.parser;
  const std::string_view word = parser.scanner.peek();
  if (equals_ignoring_case(word, "MOTION")) {
    parser.scanner.take();
  } else if (is_motion_word(word)) {
    parser.report(
        Severity::Warning, code::kNoMotionWord,
        fmt::format("expected MOTION before {}; the file is read without it", quoted(word)),
        word.data());
  } else {
    if (parser.is_structure_sound && !h.is_cut_off) {
      parser.report(Severity::Warning, code::kNoMotion,
                    "expected MOTION, found the end of the file; the file holds a skeleton alone",
                    word.data());
    }
    return false;
  }
  return true;
}

}  // namespace

bool is_keyword(std::string_view word) {
  return word.empty() || word == "{" || word == "}" || word.starts_with('#') ||
         equals_ignoring_case(word, "ROOT") || equals_ignoring_case(word, "JOINT") ||
         equals_ignoring_case(word, "OFFSET") || equals_ignoring_case(word, "CHANNELS") ||
         is_end_site_word(word) || is_motion_word(word);
}

bool parse_hierarchy(Parser& parser) {
  if (!parse_first_word(parser)) return false;
  Hierarchy h{parser, {}, {}};
  while (h.num_structure_errors < kMaxStructureErrors && !h.is_cut_off) {
    if (skip_comment(parser)) continue;
    const bool is_in_end_site = !h.open.empty() && h.open.back().is_end_site;
    if (h.open.size() - (is_in_end_site ? 1 : 0) > kMaxDepth) {
      parser.report(Severity::Error, code::kTooDeep,
                    fmt::format("expected joints nested at most {} deep, found more", kMaxDepth),
                    parser.scanner.position());
      return false;
    }
    if (!parse_next(h)) break;
  }
  check_names(h);
  if (parser.file.nodes.empty() && parser.is_structure_sound) {
    report_structure(h, "ROOT after HIERARCHY", parser.scanner.peek());
  }
  return take_motion_word(h);
}

}  // namespace kinefile::bvh
