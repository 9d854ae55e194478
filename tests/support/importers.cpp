// SPDX-License-Identifier: MIT
#include "support/importers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>
#include <sstream>

namespace kinefile::test {
namespace {

using Words = std::vector<std::string>;

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr double kRadians = 3.14159265358979323846 / 180;

/// A node as it is in the file, and where its columns begin.
struct ImportedNode {
  Words name;
  std::size_t parent = kNone;
  Vec3 offset = Vec3::Zero();
  Words channels;
  std::size_t first_column = 0;
  bool has_named_end = false;
};

struct ImportedFile {
  std::string fault;  ///< of the layout; empty: none
  std::vector<ImportedNode> nodes;
  std::vector<std::vector<double>> rows;
};

/// The lines of a text as words; blank lines are skipped.
std::vector<Words> lines_of(std::string_view text) {
  std::vector<Words> lines;
  std::istringstream all{std::string(text)};
  for (std::string line; std::getline(all, line);) {
    std::istringstream one(line);
    Words words;
    for (std::string word; one >> word;) words.push_back(word);
    if (!words.empty()) lines.push_back(words);
  }
  return lines;
}

std::string joined(const Words& words, std::size_t first, const char* between) {
  std::string text;
  for (std::size_t i = first; i < words.size(); ++i) text += (i > first ? between : "") + words[i];
  return text;
}

double number_of(const std::string& word) { return std::strtod(word.c_str(), nullptr); }

std::size_t count_of(const std::string& word) { return std::strtoul(word.c_str(), nullptr, 10); }

/// Reads a file line by line.
class LayoutReader {
 public:
  explicit LayoutReader(std::string_view text) : lines_(lines_of(text)) {}

  ImportedFile read() {
    expect("HIERARCHY");
    while (starts_with("ROOT")) read_node(kNone);
    expect("MOTION");
    read_motion();
    return std::move(file_);
  }

 private:
  bool is_at_end() const { return !file_.fault.empty() || at_ == lines_.size(); }
  bool starts_with(const char* word) const { return !is_at_end() && lines_[at_][0] == word; }

  /// The next line, which must start with a word and have a number of words.
  Words take(const char* word, std::size_t count = kNone) {
    if (!starts_with(word) || (count != kNone && lines_[at_].size() != count)) {
      if (file_.fault.empty()) {
        file_.fault = fmt::format("expected {}, found '{}'", word,
                                  at_ < lines_.size() ? joined(lines_[at_], 0, " ") : "");
      }
      return Words(count == kNone ? 2 : count, "0");
    }
    return lines_[at_++];
  }
  void expect(const char* word) { take(word, 1); }

  void read_node(std::size_t parent) {
    ImportedNode node;
    const Words name = take(parent == kNone ? "ROOT" : "JOINT");
    node.name.assign(name.begin() + 1, name.end());
    node.parent = parent;
    expect("{");
    node.offset = read_offset();
    const Words channels = take("CHANNELS");
    for (std::size_t i = 2; i < channels.size(); ++i) node.channels.push_back(channels[i]);
    const bool has_count = channels.size() > 1 && count_of(channels[1]) == node.channels.size();
    if (!has_count && file_.fault.empty()) file_.fault = "CHANNELS has a wrong count";
    node.first_column = num_columns_;
    num_columns_ += node.channels.size();
    const std::size_t index = file_.nodes.size();
    file_.nodes.push_back(node);
    while (starts_with("JOINT") || starts_with("End")) {
      if (starts_with("JOINT")) {
        read_node(index);
      } else {
        read_end(index);
      }
    }
    expect("}");
  }

  void read_end(std::size_t node) {
    if (take("End").size() > 2) file_.nodes[node].has_named_end = true;
    expect("{");
    read_offset();
    expect("}");
  }

  Vec3 read_offset() {
    const Words words = take("OFFSET", 4);
    return {number_of(words[1]), number_of(words[2]), number_of(words[3])};
  }

  void read_motion() {
    const std::size_t count = count_of(take("Frames:", 2)[1]);
    take("Frame", 3);
    for (; !is_at_end(); ++at_) {
      std::vector<double>& row = file_.rows.emplace_back();
      for (const std::string& word : lines_[at_]) row.push_back(number_of(word));
      if (row.size() != num_columns_) file_.fault = "a row is of another length than CHANNELS say";
    }
    if (file_.fault.empty() && file_.rows.size() != count) file_.fault = "Frames: is wrong";
  }

  std::vector<Words> lines_;
  std::size_t at_ = 0;
  std::size_t num_columns_ = 0;
  ImportedFile file_;
};

/// The axis of a channel such as Xrotation; nothing for another word.
std::optional<Eigen::Index> axis_of(const std::string& channel, std::string_view kind) {
  const auto axis = std::string_view("XYZ").find(channel[0]);
  if (axis == std::string_view::npos || channel.substr(1) != kind) return std::nullopt;
  return static_cast<Eigen::Index>(axis);
}

std::vector<Eigen::Index> axes_of(const ImportedNode& node, std::string_view kind) {
  std::vector<Eigen::Index> axes;
  for (const std::string& channel : node.channels) {
    if (const auto axis = axis_of(channel, kind)) axes.push_back(*axis);
  }
  return axes;
}

/// Blender looks up the order of rotations in a table of all six, and of None for each that is
/// missing, which has only an entry without rotations. Nodes of one name replace each other.
std::string refusal_of_blender(const ImportedFile& file) {
  std::set<std::string> names;
  for (const ImportedNode& node : file.nodes) {
    if (!names.insert(joined(node.name, 0, "_")).second) return "two nodes of one name";
    const auto axes = axes_of(node, "rotation");
    if (axes.size() > 3) return "IndexError: list assignment index out of range";
    const bool is_whole = axes.empty() || std::set(axes.begin(), axes.end()).size() == 3;
    if (is_whole) continue;
    Words key(3, "None");
    for (std::size_t k = 0; k < axes.size(); ++k) key[k] = std::to_string(axes[k]);
    return "KeyError: (" + joined(key, 0, ", ") + ")";
  }
  return "";
}

/// three.js and assimp read one root and know six channels.
std::string refusal_of_strict(const ImportedFile& file, Importer importer) {
  for (std::size_t j = 0; j < file.nodes.size(); ++j) {
    const ImportedNode& node = file.nodes[j];
    if (j > 0 && node.parent == kNone) return "expected MOTION, found ROOT";
    if (node.name.size() != 1) return "a name of several words";
    const std::size_t num_positions = axes_of(node, "position").size();
    if (num_positions + axes_of(node, "rotation").size() != node.channels.size()) {
      return "an unknown channel";
    }
    if (importer == Importer::Assimp && node.has_named_end) return "a name after End Site";
    const bool needs_positions = importer == Importer::Assimp && node.channels.size() == 6;
    if (needs_positions && num_positions != 3) return "Missing position channel";
  }
  return "";
}

/// Where a node is in its parent: what the program makes of OFFSET and of the positions.
Vec3 place_in_parent(const ImportedNode& node, const std::vector<double>& row, Importer importer) {
  Vec3 position = Vec3::Zero();
  bool has_position = false;
  for (std::size_t c = 0; c < node.channels.size(); ++c) {
    const auto axis = axis_of(node.channels[c], "position");
    if (!axis) continue;
    position[*axis] = row[node.first_column + c];
    has_position = true;
  }
  switch (importer) {
    case Importer::Blender:
      return has_position ? position : node.offset;
    case Importer::Three:
      return node.offset + position;
    case Importer::Assimp:
      return node.channels.size() == 6 ? position : node.offset;
  }
  return position;
}

Mat3 turn_in_parent(const ImportedNode& node, const std::vector<double>& row) {
  Mat3 turn = Mat3::Identity();
  for (std::size_t c = 0; c < node.channels.size(); ++c) {
    const auto axis = axis_of(node.channels[c], "rotation");
    if (!axis) continue;
    const double angle = row[node.first_column + c] * kRadians;
    turn = turn * Eigen::AngleAxisd(angle, Vec3::Unit(*axis)).toRotationMatrix();
  }
  return turn;
}

}  // namespace

Import import_bvh(std::string_view text, Importer importer) {
  const ImportedFile file = LayoutReader(text).read();
  Import import;
  import.refusal = file.fault;
  if (import.refusal.empty()) {
    import.refusal = importer == Importer::Blender ? refusal_of_blender(file)
                                                   : refusal_of_strict(file, importer);
  }
  if (!import.refusal.empty()) return import;
  for (const ImportedNode& node : file.nodes) import.names.push_back(joined(node.name, 0, "_"));
  for (const std::vector<double>& row : file.rows) {
    std::vector<Vec3>& places = import.positions.emplace_back();
    std::vector<Mat3> turns;
    for (const ImportedNode& node : file.nodes) {
      const bool is_root = node.parent == kNone;
      const Vec3 local = place_in_parent(node, row, importer);
      const Mat3 parent = is_root ? Mat3(Mat3::Identity()) : turns[node.parent];
      places.push_back(is_root ? local : Vec3(places[node.parent] + parent * local));
      turns.push_back(parent * turn_in_parent(node, row));
    }
  }
  return import;
}

}  // namespace kinefile::test
