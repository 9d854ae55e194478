// SPDX-License-Identifier: MIT
#include "kinefile/servo_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <set>

#include "text/decode.hpp"
#include "text/numbers.hpp"
#include "text/printer.hpp"
#include "text/source.hpp"
#include "text/yaml/tree.hpp"

namespace kinefile {
namespace {

using text::yaml::Node;
using text::yaml::NodeKind;

constexpr int kLowestWord = -32768, kHighestWord = 32767;
/// The value that editors write for a sixtieth of a second, in microseconds.
constexpr double kSixtieth = 16667;
constexpr double kMicroseconds = 1e6;

/// The slider is not known yet.
constexpr std::size_t kNoSlider = std::numeric_limits<std::size_t>::max();

/// The range of a number in a map.
struct Range {
  double lowest, highest;
  bool is_whole = true;
};

constexpr Range kWordRange = {kLowestWord, kHighestWord};

/// A node in the form for a message.
std::string shown(const Node& node) {
  if (node.kind != NodeKind::Scalar) return "a list or mapping";
  return node.text.empty() ? "nothing" : text::quoted(node.text);
}

/// Reads a map from a tree; continues after faults, so that all are reported.
class MapReader {
 public:
  MapReader(const text::Source& source, Diagnostics& diagnostics)
      : source_(source), diagnostics_(diagnostics) {}

  ServoMap read(const Node& root) {
    const Node* servos = text::yaml::find(root, "servos");
    if (root.kind != NodeKind::Mapping || servos == nullptr || servos->kind != NodeKind::Sequence) {
      tell("SVM001", "expected a servo map: a mapping with a list 'servos'",
           servos == nullptr ? root.at : servos->at);
      return std::move(map_);
    }
    tell_unknown_keys(root, {"sliders", "tick", "base_pose", "servos"});
    read_head(root);
    if (servos->rows != nullptr) {
      tell_no_entry(servos->rows->entries.front().text.data());
      return std::move(map_);
    }
    for (const Node* entry : servos->children) read_entry(*entry);
    return std::move(map_);
  }

 private:
  void tell(const char* code, std::string message, const char* at,
            Severity severity = Severity::Error) {
    text::report(source_, diagnostics_, severity, code, std::move(message), at);
  }

  void tell_no_entry(const char* at) {
    tell("SVM001", "expected a servo: a mapping with 'slider', 'joint' and 'units_per_degree'", at);
  }

  void tell_unknown_keys(const Node& mapping, std::initializer_list<std::string_view> known) {
    for (std::size_t i = 0; i + 1 < mapping.children.size(); i += 2) {
      const Node& key = *mapping.children[i];
      if (std::find(known.begin(), known.end(), key.text) != known.end()) continue;
      tell("SVM002",
           fmt::format("expected one of {}, found the key {}", fmt::join(known, ", "), shown(key)),
           key.at, Severity::Warning);
    }
  }

  /// A number within a range; reports why it is not valid.
  std::optional<double> number(const Node& node, std::string_view what, Range range) {
    const text::Number found = text::parse_number(node.text);
    const bool is_good = node.is_plain() && found.fault == text::NumberFault::None &&
                         found.value >= range.lowest && found.value <= range.highest &&
                         (!range.is_whole || found.value == std::floor(found.value));
    if (is_good) return found.value;
    tell("SVM006",
         fmt::format("expected {} as a {}number from {} to {}, found {}", what,
                     range.is_whole ? "whole " : "", range.lowest, range.highest, shown(node)),
         node.at);
    return std::nullopt;
  }

  /// Reads the number of a key, if the mapping has it, into `value`.
  template <class T>
  void read_number(const Node& mapping, std::string_view key, Range range, T& value) {
    const Node* node = text::yaml::find(mapping, key);
    if (node == nullptr) return;
    if (const auto found = number(*node, key, range)) value = static_cast<T>(*found);
  }

  void read_head(const Node& root) {
    read_number(root, "sliders", {1, 64}, map_.num_sliders);
    double tick = kSixtieth;
    read_number(root, "tick", {1, 10'000'000}, tick);
    if (tick != kSixtieth) map_.tick_seconds = tick / kMicroseconds;
    const Node* base = text::yaml::find(root, "base_pose");
    if (base == nullptr) return;
    if (base->kind != NodeKind::Sequence || base->rows != nullptr ||
        base->children.size() > map_.num_sliders) {
      tell("SVM006",
           fmt::format("expected 'base_pose' as a list of at most {} words, one a slider",
                       map_.num_sliders),
           base->at);
      return;
    }
    for (const Node* word : base->children) {
      map_.base_pose.push_back(
          static_cast<std::int16_t>(number(*word, "a word of base_pose", kWordRange).value_or(0)));
    }
  }

  void read_entry(const Node& node) {
    if (node.kind != NodeKind::Mapping) return tell_no_entry(node.at);
    tell_unknown_keys(
        node, {"slider", "joint", "sign", "units_per_degree", "offset", "min", "max", "step"});
    for (const std::string_view key : {"slider", "joint", "units_per_degree"}) {
      if (text::yaml::find(node, key) != nullptr) continue;
      tell("SVM003", fmt::format("expected '{}' in a servo, found none", key), node.at);
    }
    ServoMapEntry entry;
    entry.slider = kNoSlider;
    const double highest = static_cast<double>(map_.num_sliders) - 1;
    read_number(node, "slider", {0, highest}, entry.slider);
    read_joint(node, entry);
    read_sign(node, entry);
    read_number(node, "units_per_degree", {1e-3, 1e6, false}, entry.units_per_degree);
    read_number(node, "offset", {-1e6, 1e6, false}, entry.offset);
    read_number(node, "min", kWordRange, entry.minimum);
    read_number(node, "max", kWordRange, entry.maximum);
    read_number(node, "step", {1, 65535}, entry.step);
    if (entry.minimum > entry.maximum) {
      tell("SVM006",
           fmt::format("expected 'min' up to 'max', found {} and {}", entry.minimum, entry.maximum),
           node.at);
    }
    tell_repetition(node, entry);
    map_.entries.push_back(std::move(entry));
  }

  void read_joint(const Node& mapping, ServoMapEntry& entry) {
    const Node* joint = text::yaml::find(mapping, "joint");
    if (joint == nullptr) return;
    if (joint->kind != NodeKind::Scalar || joint->text.empty()) {
      return tell("SVM003", "expected the name of a joint, found none", joint->at);
    }
    entry.joint = joint->text;
  }

  void read_sign(const Node& mapping, ServoMapEntry& entry) {
    const Node* sign = text::yaml::find(mapping, "sign");
    if (sign == nullptr) return;
    const double found = text::parse_number(sign->text).value;
    if (!sign->is_plain() || (found != 1 && found != -1)) {
      return tell("SVM004", fmt::format("expected 'sign' as 1 or -1, found {}", shown(*sign)),
                  sign->at);
    }
    entry.sign = found;
  }

  void tell_repetition(const Node& node, const ServoMapEntry& entry) {
    if (entry.slider != kNoSlider && !sliders_.insert(entry.slider).second) {
      tell("SVM005", fmt::format("expected slider {} once, found it again", entry.slider),
           text::yaml::find(node, "slider")->at);
    }
    if (!entry.joint.empty() && !joints_.insert(entry.joint).second) {
      tell("SVM005",
           fmt::format("expected joint {} once, found it again", text::quoted(entry.joint)),
           text::yaml::find(node, "joint")->at);
    }
  }

  const text::Source& source_;
  Diagnostics& diagnostics_;
  ServoMap map_;
  std::set<std::size_t> sliders_;
  std::set<std::string> joints_;
};

}  // namespace

Result<ServoMap> parse_servo_map(std::string_view text, const std::string& source_name,
                                 Diagnostics& diagnostics) {
  const auto decoded = text::decode(text, {}, source_name, diagnostics);
  if (!decoded) return fail(decoded.error());
  const text::Source source(source_name, decoded->view());
  const auto tree = text::yaml::read_tree(source, diagnostics);
  if (tree == nullptr) return fail(diagnostics.first_error());
  ServoMap map = MapReader(source, diagnostics).read(tree->root());
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  return map;
}

std::string to_yaml(const ServoMap& map) {
  const double tick =
      map.tick_seconds == 1.0 / 60 ? kSixtieth : std::round(map.tick_seconds * kMicroseconds);
  std::string yaml = fmt::format(
      "# A servo map of kinefile: angle in degrees = sign * (word - offset) / units_per_degree\n"
      "sliders: {}\ntick: {}  # microseconds\n",
      map.num_sliders, tick);
  if (!map.base_pose.empty()) {
    yaml += fmt::format("base_pose: [{}]\n", fmt::join(map.base_pose, ", "));
  }
  yaml += map.entries.empty() ? "servos: []\n" : "servos:\n";
  for (const ServoMapEntry& entry : map.entries) {
    yaml += fmt::format(
        "  - {{slider: {}, joint: {}, sign: {}, units_per_degree: {}, offset: {}, min: {}, "
        "max: {}, step: {}}}\n",
        entry.slider, text::json_string(entry.joint), entry.sign, entry.units_per_degree,
        entry.offset, entry.minimum, entry.maximum, entry.step);
  }
  return yaml;
}

}  // namespace kinefile
