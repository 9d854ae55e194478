// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "kinefile/array.hpp"
#include "kinefile/diagnostics.hpp"
#include "text/source.hpp"
#include "text/yaml/parser.hpp"

namespace kinefile::text::yaml {

enum class NodeKind { Scalar, Sequence, Mapping };

struct Node;

/// The entries of a sequence in which some are rows of numbers.
struct RowEntries {
  struct Entry {
    std::string_view text;       ///< the text of a row; for another node, where it starts
    std::uint32_t shape = 0;     ///< of a row
    const Node* node = nullptr;  ///< null for a row
  };
  std::vector<Entry> entries;
  Array<double> values;  ///< of all rows, one after the other
};

/// A value of a YAML document.
struct Node {
  NodeKind kind = NodeKind::Scalar;
  const char* at = nullptr;  ///< where it starts in the text
  std::string_view tag;
  std::string_view text;  ///< of a scalar
  ScalarStyle style = ScalarStyle::Plain;
  bool is_flow = false;
  /// The entries of a sequence; for a mapping, keys and values in turn: each key once, entries from
  /// `<<` at the end. Empty if `rows` has the entries.
  std::vector<const Node*> children;
  std::unique_ptr<RowEntries> rows;
  std::size_t size = 1;  ///< the nodes in it, aliases counted with their content, and
                         ///< long texts as several

  bool is_plain() const { return kind == NodeKind::Scalar && style == ScalarStyle::Plain; }
};

/// A YAML document. Views and pointers into it live as long as it and its text.
class Tree {
 public:
  const Node& root() const { return *root_; }
  const RowShape& shape(std::size_t index) const { return rows_.shape(index); }
  /// How many numbers a row of a shape has.
  std::size_t num_values(std::size_t index) const { return rows_.num_values(index); }
  /// Whether the document has comments, which a tree does not contain.
  bool has_comments() const { return parser_->has_comments(); }
  /// Moves the rows out of a sequence of the tree, or copies them if aliases may need them.
  /// Precondition: it has rows.
  std::unique_ptr<RowEntries> take_rows(const Node& sequence);

 private:
  friend class TreeBuilder;
  NumberRows rows_;
  std::unique_ptr<Parser> parser_;  ///< keeps the texts of scalars
  std::deque<Node> nodes_;
  const Node* root_ = nullptr;
  bool has_aliases_ = false;
};

/// Reads the first document of a text; further text is reported and not read. Aliases and merges
/// (`<<`) are replaced by their content; of a repeated key the later one is used. Null after
/// errors, which are in `diagnostics`.
/// \errors YML001 to YML011
std::unique_ptr<Tree> read_tree(const Source& source, Diagnostics& diagnostics);

/// The value of a key of a mapping; null if it has none, or is not a mapping.
const Node* find(const Node& node, std::string_view key);

}  // namespace kinefile::text::yaml
