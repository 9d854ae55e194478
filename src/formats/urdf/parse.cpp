// SPDX-License-Identifier: MIT
#include "formats/urdf/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "formats/urdf/codes.hpp"
#include "formats/urdf/shapes.hpp"
#include "formats/urdf/values.hpp"
#include "text/numbers.hpp"

namespace kinefile::urdf {
namespace {

using robot_file::JointType;
using robot_file::Link;
using text::xml::Attribute;
using text::xml::Element;
using text::xml::find_attribute;
using text::xml::find_child;

/// Whether the version of a file is 1.1 or later; none means 1.0.
bool has_version_of_quaternions(const Element& robot) {
  const Attribute* const attribute = find_attribute(robot, "version");
  if (attribute == nullptr) return false;
  const std::string_view version = attribute->value;
  const std::size_t dot = std::min(version.find('.'), version.size());
  const auto major = text::parse_count(version.substr(0, dot));
  const auto minor = text::parse_count(version.substr(std::min(dot + 1, version.size())));
  return major && (*major > 1 || (*major == 1 && minor.value_or(0) >= 1));
}

/// Whether an element says where a joint is, or what it joins; others need not be understood.
bool is_of_joints(const Element& element) {
  for (const Element* one = &element; one != nullptr; one = one->parent) {
    if (one->name == "joint") return true;
  }
  return element.name == "robot" || element.name == "link";
}

class Parser {
 public:
  Parser(const text::Source& source, Diagnostics& diagnostics) : values_{source, diagnostics} {}

  std::optional<robot_file::Robot> parse() {
    const auto tree = read_elements(values_.source, "robot", values_.diagnostics);
    if (!tree || !check_expanded(*tree)) return std::nullopt;
    const Element& root = tree->root();
    knows_quaternions_ = has_version_of_quaternions(root);
    const Attribute* name = find_attribute(root, "name");
    robot_.name = name == nullptr ? "" : name->value;
    // All links first, because joints may come before the links that they join.
    for_each(root, "link", [this](const Element& element) { read_link(element); });
    for_each(root, "joint", [this](const Element& element) { read_joint(element); });
    if (is_good_) find_root(root);
    if (is_good_) follow_mimics();
    if (!is_good_) return std::nullopt;
    read_shapes(root);
    return std::move(robot_);
  }

 private:
  /// A link of the file, and whether it is the child of a joint.
  struct Known {
    const Element* element = nullptr;
    bool is_child = false;
  };

  /// A joint that follows another, as in the file.
  struct Mimic {
    std::size_t link = 0;
    std::string joint;      ///< the name of the other
    std::size_t other = 0;  ///< the link below the other joint
    double multiplier = 1;
    double offset = 0;
    bool is_followed = false;  ///< whether `other` is at the end of its chain
    robot_file::Spot spot;
  };

  template <class Function>
  static void for_each(const Element& parent, const char* name, const Function& function) {
    for (const Element* element : parent.children) {
      if (element->name == name) function(*element);
    }
  }

  void error(const robot_file::Spot& spot, const char* code, std::string message) {
    values_.report_fault(spot, code, std::move(message));
    is_good_ = false;
  }

  void warn(const Element& element, const char* code, std::string message) {
    values_.warn(values_.spot(element), code, std::move(message));
  }

  /// Reports the first element or attribute of a file that xacro must expand first.
  bool check_expanded(const text::xml::Tree& tree) {
    return std::all_of(tree.elements.begin(), tree.elements.end(),
                       [this](const Element& element) { return check_expanded(element); });
  }

  bool check_expanded(const Element& element) {
    if (element.name.starts_with("xacro:")) {
      return report_xacro(values_.spot(element), element.name);
    }
    if (!is_of_joints(element)) return true;
    for (const Attribute& attribute : element.attributes) {
      if (attribute.value.find("${") != std::string::npos) {
        return report_xacro(values_.spot(attribute), attribute.value);
      }
      warn_of_entities(attribute);
    }
    return true;
  }

  /// Warns of a reference to an entity that a DOCTYPE would have to declare.
  void warn_of_entities(const Attribute& attribute) {
    const std::string& value = attribute.value;
    for (std::size_t at = value.find('&'); at != std::string::npos; at = value.find('&', at + 1)) {
      std::size_t end = at + 1;
      while (end < value.size() && is_of_entity_name(value[end])) ++end;
      if (end == at + 1 || end == value.size() || value[end] != ';') continue;
      values_.warn(
          values_.spot(attribute), code::kEntity,
          fmt::format("expected characters, found {}, an entity that no file declares here; "
                      "it is kept as it stands",
                      text::quoted(value.substr(at, end + 1 - at))));
      return;
    }
  }

  static bool is_of_entity_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  }

  bool report_xacro(const robot_file::Spot& spot, std::string_view found) {
    error(spot, code::kXacro,
          fmt::format("expected URDF, found {}, which xacro expands: run 'xacro FILE > ROBOT.urdf' "
                      "and read that",
                      text::quoted(found)));
    return false;
  }

  /// Stores a value that may be missing because of an error.
  template <class T>
  T take(std::optional<T> value) {
    is_good_ &= value.has_value();
    return value ? std::move(*value) : T{};
  }

  void read_link(const Element& element) {
    const std::string name = take(values_.word(element, "name"));
    if (name.empty()) return;
    names_.push_back(name);
    if (!links_.emplace(name, Known{&element, false}).second) {
      error(values_.spot(element), code::kRepeatedName,
            fmt::format("expected one link of the name {}, found another", text::quoted(name)));
    }
  }

  /// The link that a joint's <parent> or <child> names.
  Known* find_link(const Element& joint, const char* role, std::string& name) {
    const Element* element = find_child(joint, role);
    if (element == nullptr) {
      error(values_.spot(joint), code::kMissing,
            fmt::format("expected <{}> in a <joint>, found none", role));
      return nullptr;
    }
    name = take(values_.word(*element, "link"));
    const auto found = links_.find(name);
    if (found != links_.end()) return &found->second;
    if (!name.empty()) {
      error(values_.spot(*element), code::kBadParent,
            fmt::format("expected a link as the {} of a joint, found {}, which is none", role,
                        text::quoted(name)));
    }
    return nullptr;
  }

  void read_joint(const Element& element) {
    Link link;
    link.joint_name = take(values_.word(element, "name"));
    const Known* parent = find_link(element, "parent", link.parent);
    Known* child = find_link(element, "child", link.name);
    if (parent == nullptr || child == nullptr) return;
    if (child->is_child) {
      error(values_.spot(element), code::kBadParent,
            fmt::format("expected one joint above the link {}, found another",
                        text::quoted(link.name)));
      return;
    }
    child->is_child = true;
    link.spot = values_.spot(*child->element);
    link.parent_spot = values_.spot(*find_child(element, "parent"));
    read_type(element, link);
    place_joint(element, link);
    read_axis(element, link);
    read_limit(element, link);
    if (const Element* mimic = find_child(element, "mimic")) read_mimic(*mimic, link);
    robot_.links.push_back(std::move(link));
  }

  /// \param link  the link that is being read, which will be the next one
  void read_mimic(const Element& element, const Link& link) {
    if (link.type == JointType::Fixed) {
      warn(element, code::kIgnored,
           fmt::format("<mimic> is ignored: the joint {} does not move",
                       text::quoted(link.joint_name)));
      return;
    }
    Mimic mimic;
    mimic.link = robot_.links.size();
    mimic.joint = take(values_.word(element, "joint"));
    mimic.multiplier = take(values_.number(element, "multiplier", 1));
    mimic.offset = take(values_.number(element, "offset", 0));
    mimic.spot = values_.spot(element);
    mimics_.push_back(std::move(mimic));
  }

  /// Finds the joint at the end of each chain of mimics.
  void follow_mimics() {
    std::unordered_map<std::string_view, std::size_t> link_of_joint;
    for (std::size_t l = 0; l < robot_.links.size(); ++l) {
      link_of_joint.emplace(robot_.links[l].joint_name, l);
    }
    std::unordered_map<std::size_t, Mimic*> mimic_of_link;
    for (Mimic& mimic : mimics_) {
      const auto found = link_of_joint.find(mimic.joint);
      if (found == link_of_joint.end()) {
        error(mimic.spot, code::kBadMimic,
              fmt::format("expected the name of a joint to mimic, found {}, which is none",
                          text::quoted(mimic.joint)));
      } else {
        mimic.other = found->second;
        mimic_of_link.emplace(mimic.link, &mimic);
      }
    }
    for (Mimic& mimic : mimics_) {
      if (is_good_ && !mimic.is_followed) follow_mimic(mimic, mimic_of_link);
      if (is_good_) end_mimic(mimic, {mimic.other, mimic.multiplier, mimic.offset});
    }
  }

  /// Replaces the joint that one follows by the one at the end of the chain, for all in the chain.
  void follow_mimic(Mimic& mimic, const std::unordered_map<std::size_t, Mimic*>& mimic_of_link) {
    std::vector<Mimic*> chain;
    const Mimic* end = nullptr;
    for (Mimic* one = &mimic; one != nullptr && end == nullptr;) {
      chain.push_back(one);
      if (chain.size() > mimics_.size()) {
        error(mimic.spot, code::kBadMimic,
              fmt::format("expected a joint that follows none in the end, found that {} mimics "
                          "itself",
                          text::quoted(robot_.links[mimic.link].joint_name)));
        return;
      }
      const auto next = mimic_of_link.find(one->other);
      one = next == mimic_of_link.end() ? nullptr : next->second;
      if (one != nullptr && one->is_followed) end = one;
    }
    for (auto one = chain.rbegin(); one != chain.rend(); ++one) {
      Mimic& own = **one;
      if (end != nullptr) {
        own.other = end->other;
        own.offset += own.multiplier * end->offset;
        own.multiplier *= end->multiplier;
      }
      own.is_followed = true;
      end = &own;
    }
  }

  /// Makes a joint follow the joint at the end of its chain, if that moves.
  void end_mimic(const Mimic& mimic, const robot_file::Follows& follows) {
    const Link& leader = robot_.links[follows.link];
    if (!std::isfinite(follows.gain) || !std::isfinite(follows.shift)) {
      error(mimic.spot, code::kBadMimic,
            "expected multipliers whose product is finite, found others");
    } else if (leader.type == JointType::Fixed) {
      values_.warn(mimic.spot, code::kIgnored,
                   fmt::format("<mimic> is ignored: the joint {} does not move, so {} reads "
                               "values of its own",
                               text::quoted(leader.joint_name),
                               text::quoted(robot_.links[mimic.link].joint_name)));
    } else {
      robot_.links[mimic.link].follows = follows;
    }
  }

  /// Reads the type of a joint, and sets its id; joints that move have ids in file order.
  void read_type(const Element& element, Link& link) {
    const std::string type = take(values_.word(element, "type"));
    if (type.empty() || type == "fixed") return;
    if (type == "floating" || type == "planar") {
      warn(element, code::kTakenAsFixed,
           fmt::format("a {} joint is taken as fixed (as in Choreonoid)", type));
    } else if (type == "revolute" || type == "continuous" || type == "prismatic") {
      link.type = type == "prismatic" ? JointType::Prismatic : JointType::Revolute;
      link.joint_id = num_ids_++;
    } else {
      error(values_.spot(element), code::kUnknownType,
            fmt::format("expected revolute, continuous, prismatic, fixed, floating or planar as "
                        "the type of a joint, found {}",
                        text::quoted(type)));
    }
  }

  void place_joint(const Element& element, Link& link) {
    const Element* origin = find_child(element, "origin");
    for_each(element, "pose", [this](const Element& pose) {
      warn(pose, code::kIgnored, "<pose> is ignored: URDF says the place of a joint by <origin>");
    });
    if (origin == nullptr) return;
    for_each(element, "origin", [&](const Element& other) {
      if (&other != origin)
        warn(other, code::kIgnored, "<origin> is ignored: the first one counts");
    });
    const Origin place = take(read_origin(values_, *origin, knows_quaternions_));
    link.translation = place.translation;
    link.rotation = place.rotation;
  }

  void read_axis(const Element& element, Link& link) {
    const Element* axis = find_child(element, "axis");
    link.axis = Vec3::UnitX();
    link.axis_spot = values_.spot(axis == nullptr ? element : *axis);
    if (axis != nullptr) link.axis = take(values_.vector(*axis, "xyz", Vec3(Vec3::UnitX())));
  }

  void read_limit(const Element& element, Link& link) {
    const Attribute* type = find_attribute(element, "type");
    const bool is_continuous = type != nullptr && type->value == "continuous";
    const Element* limit = find_child(element, "limit");
    if (link.type == JointType::Fixed) return;
    if (limit == nullptr) {
      if (is_continuous) return;
      warn(element, code::kNoLimit,
           fmt::format("expected <limit> in the joint {}, found none; it is taken as unlimited "
                       "(Choreonoid refuses such a file)",
                       text::quoted(link.joint_name)));
      return;
    }
    if (!is_continuous) {
      link.lower = take(values_.limit(*limit, "lower", 0));
      link.upper = take(values_.limit(*limit, "upper", 0));
    }
    link.max_speed = std::abs(take(values_.limit(*limit, "velocity", link.max_speed)));
  }

  void read_shapes(const Element& robot) {
    ShapeReader reader(values_.source, values_.diagnostics, robot, knows_quaternions_);
    std::unordered_map<std::string_view, robot_file::SharedShapes> shapes;
    for (const std::string& name : names_) shapes[name] = reader.read(*links_.at(name).element);
    for (Link& link : robot_.links) link.shapes = shapes.at(link.name);
  }

  /// The root is the only link without a parent joint.
  void find_root(const Element& robot) {
    const std::string* root = nullptr;
    for (const std::string& name : names_) {
      if (links_.at(name).is_child) continue;
      if (root != nullptr) {
        error(values_.spot(*links_.at(name).element), code::kBadParent,
              fmt::format("expected one link without a joint above it, found {} and {}",
                          text::quoted(*root), text::quoted(name)));
        return;
      }
      root = &name;
    }
    if (root == nullptr) {
      const bool is_empty = names_.empty();
      error(values_.spot(is_empty ? robot : *links_.at(names_.front()).element),
            is_empty ? code::kMissing : code::kCircle,
            is_empty ? "expected a <link> in the <robot>, found none"
                     : "expected a link without a joint above it, found none");
      return;
    }
    Link link;
    link.name = *root;
    link.spot = values_.spot(*links_.at(*root).element);
    link.parent_spot = link.spot;
    robot_.root = robot_.links.size();
    robot_.links.push_back(std::move(link));
  }

  Values values_;
  robot_file::Robot robot_;
  std::unordered_map<std::string, Known> links_;
  std::vector<std::string> names_;  ///< of links, in file order
  std::vector<Mimic> mimics_;
  std::size_t num_ids_ = 0;
  bool knows_quaternions_ = false;  ///< the file is of URDF 1.1 or later
  bool is_good_ = true;
};

}  // namespace

std::optional<robot_file::Robot> parse(const text::Source& source, Diagnostics& diagnostics) {
  return Parser(source, diagnostics).parse();
}

}  // namespace kinefile::urdf
