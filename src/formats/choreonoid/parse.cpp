// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/choreonoid/codes.hpp"
#include "formats/choreonoid/reader.hpp"
#include "text/numbers.hpp"
#include "text/scanner.hpp"
#include "text/yaml/emit.hpp"

namespace kinefile::choreonoid {
namespace {

using text::quoted;
using text::yaml::find;
using text::yaml::Node;
using text::yaml::NodeKind;

/// A key, in the spelling of versions below 4 and in that of version 4.
struct Key {
  std::string_view camel;
  std::string_view snake;
};

constexpr Key kType{"type", "type"};
constexpr Key kContent{"content", "content"};
constexpr Key kPurpose{"purpose", "purpose"};
constexpr Key kVersion{"formatVersion", "format_version"};
constexpr Key kRate{"frameRate", "frame_rate"};
constexpr Key kNumFrames{"numFrames", "num_frames"};
constexpr Key kNumParts{"numParts", "num_parts"};
constexpr Key kPoseFormat{"SE3Format", "se3_format"};
constexpr Key kOldPoseFormat{"format", "format"};
constexpr Key kRootRelative{"isRootRelative", "is_root_relative"};
constexpr Key kHasTime{"hasFrameTime", "has_frame_time"};
constexpr Key kComponents{"components", "components"};
constexpr Key kFrames{"frames", "frames"};

constexpr std::array<Key, 13> kKnownKeys = {
    kType,       kContent,       kPurpose,      kVersion, kRate,       kNumFrames, kNumParts,
    kPoseFormat, kOldPoseFormat, kRootRelative, kHasTime, kComponents, kFrames};

const Node* find_key(const Node& node, const Key& key) {
  const Node* found = find(node, key.snake);
  return found != nullptr ? found : find(node, key.camel);
}

bool is_known(std::string_view name) {
  return std::any_of(kKnownKeys.begin(), kKnownKeys.end(),
                     [name](const Key& key) { return key.camel == name || key.snake == name; });
}

/// Keeps the keys that the format does not have, as YAML lines.
std::string keep_unknown(const Reader& reader, const Node& node) {
  std::string lines;
  for (std::size_t i = 0; i + 1 < node.children.size(); i += 2) {
    const Node& key = *node.children[i];
    if (key.kind == NodeKind::Scalar && is_known(key.text)) continue;
    reader.warn(code::kUnknownKey,
                fmt::format("expected a key of the format, found {}; it is kept as it stands",
                            key.kind == NodeKind::Scalar ? quoted(key.text) : "a list or mapping"),
                key.at);
    if (!lines.empty()) lines += '\n';
    lines += text::yaml::entry_text(key, *node.children[i + 1]);
  }
  return lines;
}

/// Notes a numFrames that is not the count of frames: only the frames themselves count.
/// \param node  its number; null: there is none
void note_frame_count(const Reader& reader, const Node* node, std::size_t num_frames) {
  if (node == nullptr) return;
  const auto count =
      node->kind == NodeKind::Scalar ? text::parse_count(node->text) : std::optional<std::size_t>();
  if (count == num_frames) return;
  reader.tell(
      Severity::Note, code::kFrameCountDiffers,
      fmt::format("numFrames is {}, but there are {} frames, which are read",
                  node->kind == NodeKind::Scalar ? quoted(node->text) : "no number", num_frames),
      node->at);
}

/// Notes a rate that is hardly meant: the seconds of a frame in the place of the rate, or the like.
void note_unusual_rate(const Reader& reader, double rate, const Node& node) {
  constexpr double kLowest = 1, kHighest = 1e4;
  if (reader.options.fps || (rate > kLowest && rate <= kHighest)) return;
  reader.tell(Severity::Note, code::kUnusualRate,
              fmt::format("expected frames a second, found {}, which makes {:.6g} s a frame; --fps "
                          "says another rate",
                          quoted(node.text), 1 / rate),
              node.at);
}

/// Reads one component; missing keys may be at the top of the file.
class ComponentParser {
 public:
  ComponentParser(const Reader& reader, const Node& top, const Node& node, const SeqFile& file)
      : reader_(reader), top_(top), node_(node), file_(file) {}

  SeqComponent parse() {
    component_.at = node_.at;
    component_.type = word(kType);
    parse_content();
    if (!parse_kind()) return std::move(component_);
    parse_rate();
    if (component_.kind == ComponentKind::Vectors) {
      component_.is_root_relative = boolean(kRootRelative).value_or(false);
    }
    const std::size_t num_errors = reader_.diagnostics.count(Severity::Error);
    parse_num_parts();
    if (component_.kind == ComponentKind::Poses) parse_pose_format();
    parse_has_time();
    const bool knows_shape = reader_.diagnostics.count(Severity::Error) == num_errors;
    component_.unknown_keys = keep_unknown(reader_, node_);
    parse_frames(knows_shape);
    return std::move(component_);
  }

 private:
  /// The component's own value, or the one at the top.
  const Node* value(const Key& key) const {
    const Node* own = find_key(node_, key);
    return own != nullptr ? own : find_key(top_, key);
  }

  std::string word(const Key& key) const {
    const Node* node = value(key);
    return node != nullptr && node->kind == NodeKind::Scalar ? std::string(node->text) : "";
  }

  void parse_content() {
    component_.content = word(kContent);
    // The oldest files have `purpose`.
    const bool has_own = find_key(node_, kContent) != nullptr;
    if (!has_own && find_key(node_, kPurpose) != nullptr) {
      component_.content = word(kPurpose);
      if (file_.major >= 2) {
        reader_.warn_rejected("from format version 2 on it wants 'content', not 'purpose'",
                              find_key(node_, kPurpose)->at);
      }
    }
  }

  bool parse_kind() {
    const std::string& type = component_.type;
    const bool is_old_pose = type == "MultiSe3Seq" || type == "MultiAffine3Seq";
    if (type == "MultiValueSeq") {
      component_.kind = ComponentKind::Values;
    } else if (type == "MultiSE3Seq" || is_old_pose) {
      component_.kind = ComponentKind::Poses;
      if (is_old_pose && file_.major >= 2) {
        reader_.warn_rejected(fmt::format("the type {} is one of format version 1", quoted(type)),
                              value(kType)->at);
      }
    } else if (type == "Vector3Seq") {
      component_.kind = ComponentKind::Vectors;
    } else {
      component_.kind = ComponentKind::Other;
      const Node* at = value(kType);
      reader_.warn(code::kUnknownType,
                   fmt::format("expected the type MultiValueSeq, MultiSE3Seq or Vector3Seq, found "
                               "{}; the component is kept as it stands",
                               type.empty() ? "none" : quoted(type)),
                   at != nullptr ? at->at : node_.at);
      component_.text = text::yaml::block_text(node_);
      return false;
    }
    return true;
  }

  void parse_rate() {
    const Node* node = value(kRate);
    if (node == nullptr) return;
    const auto rate = read_number(reader_, *node);
    if (!rate) return;
    if (*rate > 0 && std::isfinite(*rate) && std::isfinite(1 / *rate)) {
      component_.frame_rate = rate;
      note_unusual_rate(reader_, *rate, *node);
    } else if (!reader_.options.fps) {
      reader_.error(code::kBadRate,
                    fmt::format("expected frames a second above 0, found {}; --fps says otherwise",
                                quoted(node->text)),
                    node->at);
    }
  }

  void parse_num_parts() {
    if (component_.kind == ComponentKind::Vectors) return;
    const Node* node = value(kNumParts);
    if (node == nullptr) {
      reader_.error(code::kBadParts,
                    "expected numParts, the number of parts of a frame, found none", node_.at);
      return;
    }
    const auto count = node->kind == NodeKind::Scalar ? text::parse_count(node->text)
                                                      : std::optional<std::size_t>();
    if (count && *count > 0) {
      component_.num_parts = *count;
      return;
    }
    const auto number =
        node->kind == NodeKind::Scalar ? text::parse_number(node->text) : text::Number{};
    constexpr double kMost = 1e9;
    if (number.value >= 1 && number.value <= kMost && number.value == std::floor(number.value)) {
      component_.num_parts = static_cast<std::size_t>(number.value);
      reader_.warn_rejected("it wants numParts as a whole number without a point", node->at);
      return;
    }
    reader_.error(code::kBadParts,
                  fmt::format("expected a whole number of parts from 1 up, found {}",
                              node->kind == NodeKind::Scalar ? quoted(node->text) : "none"),
                  node->at);
  }

  void parse_pose_format() {
    const bool is_old = file_.major < 2;
    const Node* node = value(is_old ? kOldPoseFormat : kPoseFormat);
    if (node == nullptr) {
      node = value(is_old ? kPoseFormat : kOldPoseFormat);
      if (node != nullptr) {
        reader_.warn_rejected(is_old ? "in format version 1 it wants 'format', not 'SE3Format'"
                                     : "from format version 2 on it wants 'SE3Format'",
                              node->at);
      }
    } else if (find(node_, kPoseFormat.snake) == node || find(top_, kPoseFormat.snake) == node) {
      reader_.warn_rejected("it wants 'SE3Format', not 'se3_format'", node->at);
    }
    if (node == nullptr) {
      reader_.error(code::kNoPoseFormat,
                    "expected SE3Format, which says how poses are written, found none", node_.at);
      return;
    }
    set_pose_order(*node);
  }

  void set_pose_order(const Node& node) {
    constexpr std::array<std::pair<std::string_view, PoseOrder>, 3> kOrders = {{
        {"XYZQWQXQYQZ", PoseOrder::QuaternionWFirst},
        {"XYZQXQYQZQW", PoseOrder::QuaternionWLast},
        {"XYZRPY", PoseOrder::RollPitchYaw},
    }};
    for (const auto& [name, order] : kOrders) {
      if (!text::equals_ignoring_case(node.text, name)) continue;
      component_.pose_order = order;
      if (node.text != name &&
          !reader_.repair(code::kBadPoseFormat,
                          fmt::format("expected {}, found {}", name, quoted(node.text)),
                          "it is taken for the former", node.at)) {
        return;
      }
      if (order == PoseOrder::QuaternionWLast && file_.major >= 2) {
        reader_.warn_rejected(fmt::format("it reads {} in format version 1 alone", name), node.at);
      }
      return;
    }
    reader_.error(code::kBadPoseFormat,
                  fmt::format("expected XYZQWQXQYQZ, XYZQXQYQZQW or XYZRPY, found {}",
                              node.kind == NodeKind::Scalar ? quoted(node.text) : "no word"),
                  node.at);
  }

  /// The truth value of a key; empty if it has none.
  std::optional<bool> boolean(const Key& key) const {
    constexpr std::array<std::string_view, 4> kTrue = {"true", "yes", "on", "y"};
    constexpr std::array<std::string_view, 4> kFalse = {"false", "no", "off", "n"};
    const Node* node = value(key);
    if (node == nullptr) return std::nullopt;
    if (node->kind == NodeKind::Scalar) {
      if (text::is_one_of(node->text, kTrue)) return true;
      if (text::is_one_of(node->text, kFalse)) return false;
    }
    reader_.error(code::kBadBool,
                  fmt::format("expected true or false behind {}, found {}", key.camel,
                              node->kind == NodeKind::Scalar ? quoted(node->text) : "no word"),
                  node->at);
    return std::nullopt;
  }

  void parse_has_time() {
    const auto has_time = boolean(kHasTime);
    if (!has_time) return;
    component_.has_times = *has_time;
    if (file_.major < 2) {
      reader_.warn_rejected("it knows hasFrameTime from format version 2 on", value(kHasTime)->at);
    }
  }

  /// \param knows_shape  whether the keys before them define the shape of a frame
  void parse_frames(bool knows_shape) {
    const Node* frames = find(node_, "frames");
    if (frames == nullptr || frames->kind != NodeKind::Sequence) {
      reader_.error(code::kNoFrames,
                    fmt::format("expected frames, a list with an entry a frame, found {}",
                                frames == nullptr ? "none" : "no list"),
                    frames == nullptr ? node_.at : frames->at);
      return;
    }
    const bool has_frames = frames->rows || !frames->children.empty();
    if (!has_frames) reader_.warn_rejected("there are no frames", frames->at);
    const bool has_times = component_.has_times && has_frames;
    if (!has_times && !component_.frame_rate && !reader_.options.fps) {
      const bool was_given = value(kRate) != nullptr;  // in this case it has been reported
      if (!was_given) {
        reader_.error(code::kNoRate,
                      "expected frameRate, here or at the top of the file, found none; --fps says "
                      "it, too",
                      node_.at);
      }
    }
    if (!knows_shape) return;
    const std::size_t num_errors = reader_.diagnostics.count(Severity::Error);
    choreonoid::parse_frames(reader_, *frames, component_);
    if (reader_.diagnostics.count(Severity::Error) > num_errors) return;
    note_frame_count(reader_, find_key(node_, kNumFrames), component_.num_frames);
  }

  const Reader& reader_;
  const Node& top_;
  const Node& node_;
  const SeqFile& file_;
  SeqComponent component_;
};

/// Notes a numFrames at the top that is the count of none of the components.
void note_top_frame_count(const Reader& reader, const Node& top, const SeqFile& file) {
  const Node* const node = find_key(top, kNumFrames);
  if (node == nullptr || file.components.empty()) return;
  const auto count = text::parse_count(node->text);
  const bool is_known =
      std::any_of(file.components.begin(), file.components.end(),
                  [&](const SeqComponent& one) { return count == one.num_frames; });
  if (!is_known) note_frame_count(reader, node, file.components.front().num_frames);
}

void parse_version(const Reader& reader, const Node& top, SeqFile& file) {
  const Node* node = find_key(top, kVersion);
  if (node == nullptr) return;
  file.version = std::string(node->text);
  const auto number = text::parse_number(node->text);
  if (node->kind != NodeKind::Scalar || number.fault != text::NumberFault::None ||
      !(number.value >= 0)) {
    reader.warn(code::kBadVersion,
                fmt::format("expected a format version from 1 to 4, found {}; read as 1, as "
                            "Choreonoid does",
                            node->kind == NodeKind::Scalar ? quoted(node->text) : "no number"),
                node->at);
    file.version = "1";
    return;
  }
  constexpr double kNewest = 5;
  if (number.value < kNewest) {
    file.major = std::max(1, static_cast<int>(number.value));
    return;
  }
  file.major = 4;
  file.version = "4";
  reader.repair(code::kBadVersion,
                fmt::format("expected a format version below 5, found {}", quoted(node->text)),
                "it is read as 4", node->at);
}

void check_type(const Reader& reader, const Node& top, const SeqFile& file) {
  const Node* node = find_key(top, kType);
  const std::string_view type =
      node != nullptr && node->kind == NodeKind::Scalar ? node->text : std::string_view();
  const std::string_view wanted = file.major < 2 ? "BodyMotion" : "CompositeSeq";
  if (type == wanted) return;
  const char* at = node != nullptr ? node->at : top.at;
  if (type == "BodyMotion" || type == "CompositeSeq" || node == nullptr) {
    reader.warn(code::kOtherType,
                fmt::format("expected the type {} in format version {}, found {}; Choreonoid 2.x "
                            "does not read it",
                            wanted, file.major, type.empty() ? "none" : quoted(type)),
                at);
    return;
  }
  reader.error(code::kNotABodyMotion,
               fmt::format("expected the type {}, found {}", wanted,
                           type.empty() ? "no word" : quoted(type)),
               at);
}

}  // namespace

SeqFile parse(const Reader& reader) {
  SeqFile file;
  const Node& top = reader.tree.root();
  if (top.kind != NodeKind::Mapping) {
    reader.error(code::kNotABodyMotion,
                 "expected a mapping with type, content and components at the top of the file",
                 top.at);
    return file;
  }
  file.is_json = top.is_flow;
  file.has_comments = reader.tree.has_comments();
  file.is_snake_case = find(top, kVersion.snake) != nullptr || find(top, kRate.snake) != nullptr;
  parse_version(reader, top, file);
  check_type(reader, top, file);
  if (const Node* rate = find_key(top, kRate)) {
    const auto number = text::parse_number(rate->text);
    if (number.fault == text::NumberFault::None) file.frame_rate = number.value;
  }
  file.unknown_keys = keep_unknown(reader, top);
  const Node* components = find_key(top, kComponents);
  if (components == nullptr || components->kind != NodeKind::Sequence) {
    reader.error(code::kNoComponents,
                 fmt::format("expected components, a list, found {}",
                             components == nullptr ? "none" : "no list"),
                 components == nullptr ? top.at : components->at);
    return file;
  }
  for (const Node* node : components->children) {
    if (node->kind == NodeKind::Mapping) {
      file.components.push_back(ComponentParser(reader, top, *node, file).parse());
    } else {
      reader.error(code::kNoComponents, "expected a mapping a component", node->at);
    }
  }
  if (components->rows) {
    reader.error(code::kNoComponents, "expected a mapping a component", components->at);
  }
  if (!reader.diagnostics.has_errors()) note_top_frame_count(reader, top, file);
  return file;
}

}  // namespace kinefile::choreonoid
