// SPDX-License-Identifier: MIT
#include "text/yaml/tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_set>

namespace kinefile::text::yaml {
namespace {

/// An empty text where a node starts.
std::string_view place_of(const Node& node) {
  return {node.at, 0};  // NOLINT(bugprone-string-constructor): its place is what counts
}

/// How many nodes, numbers and pieces of text aliases and merges may add to a document: a constant,
/// plus a number per byte of the text. A short text could otherwise add billions.
constexpr std::size_t kMostAdded = 100'000;
constexpr std::size_t kMostAddedPerByte = 4;
/// Characters of a scalar that count as one value.
constexpr std::size_t kPieceOfText = 8;
/// Where counting stops.
constexpr std::size_t kCountLimit = std::numeric_limits<std::size_t>::max() / 4;

/// The bytes of a row besides its text: a line end, the indentation, "- ".
constexpr std::size_t kRowMargin = 9;

/// The most bytes that are reserved for rows, for each byte of the text.
constexpr std::size_t kMostReservedPerByte = 24;

std::size_t added(std::size_t a, std::size_t b) { return std::min(a + b, kCountLimit); }

}  // namespace

/// Builds a tree, event by event.
class TreeBuilder {
 public:
  TreeBuilder(Tree& tree, const Source& source, Diagnostics& diagnostics)
      : tree_(tree), source_(source), diagnostics_(diagnostics) {
    tree_.parser_ = std::make_unique<Parser>(source.text(), &tree_.rows_);
  }

  bool build() {
    Event event;
    while (!is_failed_ && tree_.parser_->next(event)) {
      if (event.kind == EventKind::StreamEnd) return has_root();
      if (event.kind == EventKind::DocumentEnd) return see_what_follows();
      add(event);
    }
    if (!is_failed_) {
      const Fault& fault = *tree_.parser_->fault();
      tell(Severity::Error, fault.code, fault.message, fault.at);
    }
    return false;
  }

 private:
  bool has_root() {
    if (tree_.root_ == nullptr) {
      tell(Severity::Error, "YML005", "expected a YAML document, found none", source_.end());
    }
    return tree_.root_ != nullptr;
  }

  bool see_what_follows() {
    Event event;
    if (!tree_.parser_->next(event) || event.kind != EventKind::StreamEnd) {
      const Fault* fault = tree_.parser_->fault() ? &*tree_.parser_->fault() : nullptr;
      tell(Severity::Warning, "YML006", "what follows the first document is not read",
           fault == nullptr ? event.at : fault->at);
    }
    return has_root();
  }

  void tell(Severity severity, const char* code, std::string message, const char* at) {
    report(source_, diagnostics_, severity, code, std::move(message), at);
    is_failed_ |= severity == Severity::Error;
  }

  void add(const Event& event) {
    switch (event.kind) {
      case EventKind::SequenceStart:
      case EventKind::MappingStart:
        open(event);
        break;
      case EventKind::SequenceEnd:
      case EventKind::MappingEnd:
        close();
        break;
      case EventKind::Scalar:
        attach(*make(event, NodeKind::Scalar));
        break;
      case EventKind::Alias:
        add_alias(event);
        break;
      case EventKind::Row:
        add_row(event);
        break;
      default:
        break;
    }
  }

  Node* make(const Event& event, NodeKind kind) {
    Node& node = tree_.nodes_.emplace_back();
    node.kind = kind;
    node.at = event.at;
    node.tag = event.tag;
    node.text = event.value;
    node.style = event.style;
    node.is_flow = event.is_flow;
    node.size = 1 + event.value.size() / kPieceOfText;
    if (event.anchor.empty()) return &node;
    const auto [place, is_new] = anchors_.insert_or_assign(event.anchor, &node);
    if (!is_new) {
      tell(Severity::Warning, "YML011",
           fmt::format("expected the anchor '&{}' once, found it again; the later one counts from "
                       "here on (Choreonoid refuses such a file)",
                       place->first),
           event.at);
    }
    return &node;
  }

  void open(const Event& event) {
    open_.push_back(make(
        event, event.kind == EventKind::SequenceStart ? NodeKind::Sequence : NodeKind::Mapping));
    is_open_.insert(open_.back());
  }

  void close() {
    Node& node = *open_.back();
    open_.pop_back();
    is_open_.erase(&node);
    if (node.kind == NodeKind::Mapping) finish_mapping(node);
    attach(node);
  }

  /// Adds a finished node to the open one.
  void attach(const Node& node) {
    if (open_.empty()) {
      tree_.root_ = &node;
      return;
    }
    Node& parent = *open_.back();
    parent.size = added(parent.size, node.size);
    if (parent.rows) {
      parent.rows->entries.push_back({place_of(node), 0, &node});
    } else {
      parent.children.push_back(&node);
    }
  }

  void add_alias(const Event& event) {
    const auto found = anchors_.find(event.anchor);
    if (found == anchors_.end() || is_open_.contains(found->second)) {
      tell(Severity::Error, "YML007",
           found == anchors_.end()
               ? fmt::format("expected an anchor before its alias '*{}', found none", event.anchor)
               : fmt::format("expected an alias of something else, found '*{}' within what it "
                             "stands for",
                             event.anchor),
           event.at);
      return;
    }
    tree_.has_aliases_ = true;
    count_added(found->second->size, event.at);
    attach(*found->second);
  }

  void count_added(std::size_t count, const char* at) {
    num_added_ = added(num_added_, count);
    const std::size_t most = kMostAdded + kMostAddedPerByte * source_.text().size();
    if (num_added_ <= most || is_failed_) return;
    tell(Severity::Error, "YML008",
         fmt::format("expected aliases that add at most {} values, found more", most), at);
  }

  void add_row(const Event& event) {
    Node& parent = *open_.back();
    if (!parent.rows) start_rows(parent, event);
    const auto values = tree_.rows_.pop(event.row, event.num_rows);
    parent.rows->values.append(values);
    const auto shape = static_cast<std::uint32_t>(event.row);
    for (std::size_t i = 0; i < event.num_rows; ++i) {
      const bool is_alone = event.num_rows == 1;
      parent.rows->entries.push_back(
          {is_alone ? event.value : tree_.rows_.text(i), shape, nullptr});
    }
    parent.size = added(parent.size, event.num_rows + values.size());
  }

  void start_rows(Node& sequence, const Event& event) {
    sequence.rows = std::make_unique<RowEntries>();
    for (const Node* child : sequence.children) {
      sequence.rows->entries.push_back({place_of(*child), 0, child});
    }
    sequence.children.clear();
    // Reserves space for as many more rows as the text may contain, so that numbers need not move.
    // Unused memory is not committed; but a text of many lists would reserve for each of them what
    // the rest of the text may contain, so all together have a limit.
    const auto num_bytes = static_cast<std::size_t>(source_.end() - event.at);
    const std::size_t num_rows = num_bytes / (event.value.size() / event.num_rows + kRowMargin) + 1;
    std::size_t num_values = 0;
    for (const std::int32_t group : tree_.rows_.shape(event.row)) {
      if (group != kEmptyGroup) num_values += static_cast<std::size_t>(std::abs(group));
    }
    const std::size_t reserved =
        num_rows * (sizeof(RowEntries::Entry) + num_values * sizeof(double));
    if (reserved > kMostReservedPerByte * source_.text().size() - num_reserved_) return;
    num_reserved_ += reserved;
    sequence.rows->entries.reserve(num_rows);
    sequence.rows->values.reserve(num_rows * num_values);
  }

  /// Keeps the last of repeated keys, and adds the entries of merges.
  void finish_mapping(Node& mapping) {
    std::vector<const Node*> children;
    std::vector<const Node*> merged;
    std::unordered_map<std::string_view, std::size_t> places;
    for (std::size_t i = 0; i + 1 < mapping.children.size(); i += 2) {
      const Node* key = mapping.children[i];
      const Node* value = mapping.children[i + 1];
      if (key->kind == NodeKind::Scalar) {
        if (key->is_plain() && key->text == "<<" && key->tag.empty()) {
          merged.push_back(value);
          continue;
        }
        const auto [place, is_new] = places.emplace(key->text, children.size());
        if (!is_new) {
          tell(Severity::Warning, "YML009",
               fmt::format("expected the key {} once, found it again; the later one counts",
                           quoted(key->text)),
               key->at);
          children[place->second] = key;
          children[place->second + 1] = value;
          continue;
        }
      }
      children.insert(children.end(), {key, value});
    }
    mapping.children = std::move(children);
    for (const Node* value : merged) merge(mapping, *value, places, true);
  }

  void merge(Node& mapping, const Node& from,
             std::unordered_map<std::string_view, std::size_t>& places, bool may_be_list) {
    if (from.kind == NodeKind::Sequence && may_be_list && !from.rows) {
      for (const Node* entry : from.children) merge(mapping, *entry, places, false);
      return;
    }
    if (from.kind != NodeKind::Mapping) {
      tell(Severity::Error, "YML010", "expected a mapping behind '<<', or a list of mappings",
           from.at);
      return;
    }
    count_added(from.size, from.at);
    for (std::size_t i = 0; i + 1 < from.children.size() && !is_failed_; i += 2) {
      const Node* key = from.children[i];
      if (key->kind != NodeKind::Scalar) continue;
      if (!places.emplace(key->text, mapping.children.size()).second) continue;
      mapping.children.insert(mapping.children.end(), {key, from.children[i + 1]});
    }
  }

  Tree& tree_;
  const Source& source_;
  Diagnostics& diagnostics_;
  std::vector<Node*> open_;
  std::unordered_set<const Node*> is_open_;
  std::unordered_map<std::string_view, Node*> anchors_;
  std::size_t num_added_ = 0;
  std::size_t num_reserved_ = 0;  ///< bytes, for the rows of all lists
  bool is_failed_ = false;
};

std::unique_ptr<RowEntries> Tree::take_rows(const Node& sequence) {
  if (has_aliases_)
    return std::make_unique<RowEntries>(*sequence.rows);  // other nodes may need them
  // The tree owns its nodes; it only shows them to others as const.
  return std::move(const_cast<Node&>(sequence).rows);
}

std::unique_ptr<Tree> read_tree(const Source& source, Diagnostics& diagnostics) {
  auto tree = std::make_unique<Tree>();
  TreeBuilder builder(*tree, source, diagnostics);
  if (!builder.build()) return nullptr;
  return tree;
}

const Node* find(const Node& node, std::string_view key) {
  if (node.kind != NodeKind::Mapping) return nullptr;
  for (std::size_t i = 0; i + 1 < node.children.size(); i += 2) {
    const Node* candidate = node.children[i];
    if (candidate->kind == NodeKind::Scalar && candidate->text == key) {
      return node.children[i + 1];
    }
  }
  return nullptr;
}

}  // namespace kinefile::text::yaml
