// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/body/codes.hpp"
#include "formats/body/files.hpp"
#include "formats/body/link.hpp"
#include "formats/body/shapes.hpp"

namespace kinefile::body {
namespace {

using robot_file::JointType;
using robot_file::Link;
using text::yaml::Node;
using text::yaml::NodeKind;

constexpr double kFirstUnknownVersion = 2.1;
constexpr double kFewestTrackJoints = 3;
constexpr double kMostTrackJoints = 4096;

/// Reads the links of one file, one node after the other.
class LinkReader {
 public:
  LinkReader(const File& file, Files& files)
      : file_(file),
        files_(files),
        values_{*file.source, *file.tree, files.diagnostics()},
        shapes_(files.diagnostics(), code::kLeftOutShape) {}

  std::optional<robot_file::Robot> read() {
    if (!read_head() || !read_nodes() || !find_root()) return std::nullopt;
    return std::move(robot_);
  }

 private:
  bool fail(const Node& node, const char* code, std::string message) {
    values_.error(node, code, std::move(message));
    return false;
  }

  bool missing(const Node& node, std::string_view what) {
    return fail(node, code::kMissingKey, fmt::format("expected {}, found none", what));
  }

  bool read_head() {
    const Node& root = file_.root();
    const Node* format = find_any(root, {"format"});
    if (format == nullptr || format->text != "ChoreonoidBody") {
      return fail(format == nullptr ? root : *format, code::kNotABody,
                  fmt::format("expected 'format: ChoreonoidBody', found {}",
                              format == nullptr ? "none" : text::quoted(format->text)));
    }
    const Node* version = find_any(root, {"format_version", "formatVersion"});
    if (version == nullptr) return missing(*format, "a format_version");
    const auto number = values_.number(*version, "format_version");
    if (!number) return false;
    if (!(*number < kFirstUnknownVersion)) {
      return fail(*version, code::kVersion,
                  fmt::format("expected a format_version below {}, found {}", kFirstUnknownVersion,
                              *number));
    }
    if (const Node* name = find_any(root, {"name"})) robot_.name = name->text;
    return read_angle_unit(root);
  }

  bool read_angle_unit(const Node& root) {
    const Node* unit = find_any(root, {"angle_unit", "angleUnit"});
    if (unit == nullptr || unit->text == "degree") return true;
    values_.has_degrees = false;
    return unit->text == "radian" ||
           fail(*unit, code::kUnknownWord,
                fmt::format("expected 'degree' or 'radian' as angle_unit, found {}",
                            text::quoted(unit->text)));
  }

  bool read_nodes() {
    const Node* links = find_any(file_.root(), {"links"});
    if (links == nullptr || links->kind == NodeKind::Scalar || links->children.empty()) {
      return fail(links == nullptr ? file_.root() : *links, code::kNoLinks,
                  "expected a list of links, found none");
    }
    const bool has_types = links->kind == NodeKind::Mapping;
    bool is_good = true;
    for (std::size_t i = 0; i < links->children.size() && !is_full_; ++i) {
      const std::string_view type = has_types ? links->children[i++]->text : std::string_view();
      is_good &= read_node(*links->children[i], type);
    }
    if (!is_good) return false;
    return !robot_.links.empty() ||
           fail(*links, code::kNoLinks, "expected a list of links, found none");
  }

  bool find_root() {
    const Node* root = find_any(file_.root(), {"root_link", "rootLink"});
    if (root == nullptr) return true;
    const auto found = std::find_if(robot_.links.begin(), robot_.links.end(),
                                    [root](const Link& link) { return link.name == root->text; });
    robot_.root = static_cast<std::size_t>(found - robot_.links.begin());
    return found != robot_.links.end() ||
           fail(*root, code::kBadParent,
                fmt::format("expected a link as the root, found {}, which is none",
                            text::quoted(root->text)));
  }

  /// \param type  the key of the node, if links are a mapping
  bool read_node(const Node& node, std::string_view type) {
    if (node.kind != NodeKind::Mapping) {
      return fail(node, code::kBadValue, "expected the keys of a link, found something else");
    }
    const Node* own_type = find_any(node, {"type"});
    if (own_type != nullptr) type = own_type->text;
    if (type.empty() || type == "Link") return read_link(node);
    if (type == "SubBody") return read_sub_body(node);
    if (type == "ContinuousTrack") return read_track(node);
    if (type != "Skip") {
      values_.spot(own_type == nullptr ? node : *own_type)
          .report(files_.diagnostics(), Severity::Warning, code::kSkippedNode,
                  fmt::format("expected Link, SubBody, ContinuousTrack or Skip as the type of a "
                              "link, found {}; it is left out (Choreonoid refuses such a file)",
                              text::quoted(type)));
    }
    return true;
  }

  bool add(Link link, const Node& node) {
    is_full_ = robot_.links.size() == robot_file::kMostLinks;
    if (is_full_) {
      return fail(node, code::kTooManyLinks,
                  fmt::format("expected at most {} links, found more", robot_file::kMostLinks));
    }
    robot_.links.push_back(std::move(link));
    return true;
  }

  bool read_link(const Node& node) {
    Link link;
    return read_new_link(node, link) && add(std::move(link), node);
  }

  bool read_new_link(const Node& node, Link& link) {
    const Node* name = find_any(node, {"name"});
    if (name == nullptr) return missing(node, "a name of the link");
    const auto word = values_.word(*name, "a name of the link");
    if (!word) return false;
    link.name = *word;
    link.spot = values_.spot(*name);
    link.parent_spot = link.spot;
    if (const Node* joint_name = find_any(node, {"joint_name", "jointName"})) {
      link.joint_name = joint_name->text;
    }
    if (!read_contents(values_, node, link)) return false;
    link.shapes = read_shapes(values_, node, shapes_);
    return true;
  }

  /// A crawler of many shoes: the first is a free joint, which cannot move as a child; each of the
  /// others is attached to the one before.
  bool read_track(const Node& node) {
    Link link;
    if (!read_new_link(node, link)) return false;
    const Node* count = find_any(node, {"num_joints", "numJoints"});
    const Node* offset = find_any(node, {"joint_offset", "jointOffset"});
    if (link.parent.empty()) return missing(node, "the parent of a ContinuousTrack");
    if (count == nullptr) return missing(node, "the num_joints of a ContinuousTrack");
    if (offset == nullptr) return missing(node, "the joint_offset of a ContinuousTrack");
    const auto number = values_.number(*count, "num_joints");
    const auto step = values_.vector(*offset, "joint_offset");
    if (!number || !step) return false;
    if (!(*number >= kFewestTrackJoints && *number <= kMostTrackJoints)) {
      return fail(*count, code::kTooManyLinks,
                  fmt::format("expected {} to {} as num_joints, found {}", kFewestTrackJoints,
                              kMostTrackJoints, text::quoted(count->text)));
    }
    std::vector<double> angles;
    if (const Node* initial = find_any(node, {"initial_joint_angles", "initialJointAngles"})) {
      auto list = values_.list(*initial, "initial_joint_angles");
      if (!list) return false;
      angles = std::move(*list);
    }
    return add_shoes(node, link, static_cast<std::size_t>(*number), *step, angles);
  }

  bool add_shoes(const Node& node, Link link, std::size_t count, const Vec3& step,
                 const std::vector<double>& angles) {
    const std::string name = link.name;
    link.type = JointType::Free;
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) {
        link.parent = link.name;
        link.type = JointType::Revolute;
        link.translation = step;
        link.rest = i <= angles.size() ? values_.radians(angles[i - 1]) : 0;
      }
      link.name = name + std::to_string(i);
      if (!add(link, node)) return false;
    }
    return true;
  }

  /// Adds the links of another file, with changed names and ids.
  bool read_sub_body(const Node& node) {
    const Node* uri = find_any(node, {"uri"});
    if (uri == nullptr) return missing(node, "the uri of a SubBody");
    const auto word = values_.word(*uri, "a uri");
    if (!word) return false;
    const robot_file::Spot spot = values_.spot(*uri);
    const File* file = files_.open(Files::name_beside(file_, *word), spot);
    const Wrapped wrapped = follow_wrappers(file, files_);
    if (wrapped.other_format != nullptr) {
      return fail(*uri, code::kNotABody,
                  fmt::format("expected a .body file as a SubBody, found a wrapper of {}",
                              text::quoted(wrapped.other_name)));
    }
    const robot_file::Robot* other =
        wrapped.file == nullptr ? nullptr : files_.robot(*wrapped.file, spot);
    return other != nullptr && add_links(node, *other, spot);
  }

  bool add_links(const Node& node, const robot_file::Robot& other, const robot_file::Spot& spot) {
    const auto affix = [&](std::string_view name) {
      const Node* value = text::yaml::find(node, name);
      return value == nullptr ? std::string() : std::string(value->text);
    };
    const std::string prefix = affix("prefix");
    const std::string suffix = affix("suffix");
    const auto renamed = [&](const std::string& name) {
      return name.empty() ? name : prefix + name + suffix;
    };
    const auto offset = id_offset(node);
    if (!offset) return false;
    for (std::size_t l = 0; l < other.links.size(); ++l) {
      Link link = other.links[l];
      link.name = renamed(link.name);
      link.parent = renamed(link.parent);
      link.joint_name = renamed(link.joint_name);
      link.spot = spot;
      if (link.joint_id) {
        set_id(link, static_cast<double>(*link.joint_id) + *offset, link.id_spot);
      }
      if (l == other.root) {
        link.parent.clear();
        link.parent_spot = spot;
        if (!read_contents(values_, node, link)) return false;
      }
      if (!add(std::move(link), node)) return false;
    }
    return true;
  }

  std::optional<double> id_offset(const Node& node) {
    const Node* value = find_any(node, {"joint_id_offset", "jointIdOffset"});
    if (value == nullptr) return 0;
    const auto number = values_.number(*value, "joint_id_offset");
    if (!number || *number == std::floor(*number)) return number;
    fail(*value, code::kBadValue, "expected a whole number as joint_id_offset");
    return std::nullopt;
  }

  const File& file_;
  Files& files_;
  Values values_;
  robot_file::ShapeCollector shapes_;
  robot_file::Robot robot_;
  bool is_full_ = false;  ///< more links are an error that is reported once
};

}  // namespace

std::optional<robot_file::Robot> read_robot(const File& file, Files& files) {
  return LinkReader(file, files).read();
}

}  // namespace kinefile::body
