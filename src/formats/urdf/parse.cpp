// SPDX-License-Identifier: MIT
#include "formats/urdf/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "formats/urdf/codes.hpp"
#include "formats/urdf/elements.hpp"
#include "text/numbers.hpp"

namespace kinefile::urdf {
namespace {

using robot_file::JointType;
using robot_file::Link;
using tinyxml2::XMLAttribute;
using tinyxml2::XMLElement;

/// Roll, pitch and yaw: about the fixed axes x, y and z, in this order.
Quat rotation_of(const Vec3& rpy) {
  const Quat roll = robot_file::rotation_about(Vec3::UnitX(), rpy.x());
  const Quat pitch = robot_file::rotation_about(Vec3::UnitY(), rpy.y());
  const Quat yaw = robot_file::rotation_about(Vec3::UnitZ(), rpy.z());
  return (yaw * pitch * roll).normalized();
}

/// Whether the version of a file is 1.1 or later; none means 1.0.
bool has_version_of_quaternions(const XMLElement& robot) {
  const char* const attribute = robot.Attribute("version");
  if (attribute == nullptr) return false;
  const std::string_view version = attribute;
  const std::size_t dot = std::min(version.find('.'), version.size());
  const auto major = text::parse_count(version.substr(0, dot));
  const auto minor = text::parse_count(version.substr(std::min(dot + 1, version.size())));
  return major && (*major > 1 || (*major == 1 && minor.value_or(0) >= 1));
}

/// Whether an element says where a joint is, or what it joins; others need not be understood.
bool is_of_joints(const XMLElement& element) {
  for (const tinyxml2::XMLNode* node = &element; node != nullptr; node = node->Parent()) {
    const XMLElement* one = node->ToElement();
    if (one != nullptr && one->Name() == std::string_view("joint")) return true;
  }
  const std::string_view name = element.Name();
  return name == "robot" || name == "link";
}

class Parser {
 public:
  Parser(const text::Source& source, Diagnostics& diagnostics) : elements_(source, diagnostics) {}

  std::optional<robot_file::Robot> parse() {
    const XMLElement* root = elements_.read_root("robot");
    if (root == nullptr || !check_expanded(*root)) return std::nullopt;
    knows_quaternions_ = has_version_of_quaternions(*root);
    const char* name = root->Attribute("name");
    robot_.name = name == nullptr ? "" : name;
    // All links first, because joints may come before the links that they join.
    for_each(*root, "link", [this](const XMLElement& element) { read_link(element); });
    for_each(*root, "joint", [this](const XMLElement& element) { read_joint(element); });
    if (is_good_) find_root(*root);
    if (is_good_) follow_mimics();
    if (!is_good_) return std::nullopt;
    return std::move(robot_);
  }

 private:
  /// A link of the file, and whether it is the child of a joint.
  struct Known {
    const XMLElement* element = nullptr;
    bool is_child = false;
  };

  /// A joint that follows another, as in the file.
  struct Mimic {
    std::size_t link = 0;
    std::string joint;      ///< the name of the other
    std::size_t other = 0;  ///< the link below the other joint
    double multiplier = 1;
    double offset = 0;
    robot_file::Spot spot;
  };

  template <class Function>
  static void for_each(const XMLElement& parent, const char* name, const Function& function) {
    for (const XMLElement* element = parent.FirstChildElement(name); element != nullptr;
         element = element->NextSiblingElement(name)) {
      function(*element);
    }
  }

  void error(const robot_file::Spot& spot, const char* code, std::string message) {
    elements_.report(Severity::Error, spot, code, std::move(message));
    is_good_ = false;
  }

  void warn(const XMLElement& element, const char* code, std::string message) {
    elements_.report(Severity::Warning, elements_.spot(element), code, std::move(message));
  }

  /// Reports the first element or attribute of a file that xacro must expand first.
  bool check_expanded(const XMLElement& element) {
    const std::string_view name = element.Name();
    if (name.starts_with("xacro:")) return report_xacro(elements_.spot(element), element.Name());
    for (const XMLAttribute* attribute = element.FirstAttribute(); attribute != nullptr;
         attribute = attribute->Next()) {
      const bool has_expression =
          std::string_view(attribute->Value()).find("${") != std::string_view::npos;
      if (!has_expression || !is_of_joints(element)) continue;
      return report_xacro(elements_.spot(element, *attribute), attribute->Value());
    }
    for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      if (!check_expanded(*child)) return false;
    }
    return true;
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

  void read_link(const XMLElement& element) {
    const std::string name = take(elements_.word(element, "name"));
    if (name.empty()) return;
    names_.push_back(name);
    if (!links_.emplace(name, Known{&element, false}).second) {
      error(elements_.spot(element), code::kRepeatedName,
            fmt::format("expected one link of the name {}, found another", text::quoted(name)));
    }
  }

  /// The link that a joint's <parent> or <child> names.
  Known* find_link(const XMLElement& joint, const char* role, std::string& name) {
    const XMLElement* element = joint.FirstChildElement(role);
    if (element == nullptr) {
      error(elements_.spot(joint), code::kMissing,
            fmt::format("expected <{}> in a <joint>, found none", role));
      return nullptr;
    }
    name = take(elements_.word(*element, "link"));
    const auto found = links_.find(name);
    if (found != links_.end()) return &found->second;
    if (!name.empty()) {
      error(elements_.spot(*element), code::kBadParent,
            fmt::format("expected a link as the {} of a joint, found {}, which is none", role,
                        text::quoted(name)));
    }
    return nullptr;
  }

  void read_joint(const XMLElement& element) {
    Link link;
    link.joint_name = take(elements_.word(element, "name"));
    const Known* parent = find_link(element, "parent", link.parent);
    Known* child = find_link(element, "child", link.name);
    if (parent == nullptr || child == nullptr) return;
    if (child->is_child) {
      error(elements_.spot(element), code::kBadParent,
            fmt::format("expected one joint above the link {}, found another",
                        text::quoted(link.name)));
      return;
    }
    child->is_child = true;
    link.spot = elements_.spot(*child->element);
    link.parent_spot = elements_.spot(*element.FirstChildElement("parent"));
    read_type(element, link);
    read_origin(element, link);
    read_axis(element, link);
    read_limit(element, link);
    if (const XMLElement* mimic = element.FirstChildElement("mimic")) read_mimic(*mimic, link);
    robot_.links.push_back(std::move(link));
  }

  /// \param link  the link that is being read, which will be the next one
  void read_mimic(const XMLElement& element, const Link& link) {
    if (link.type == JointType::Fixed) {
      warn(element, code::kIgnored,
           fmt::format("<mimic> is ignored: the joint {} does not move",
                       text::quoted(link.joint_name)));
      return;
    }
    Mimic mimic;
    mimic.link = robot_.links.size();
    mimic.joint = take(elements_.word(element, "joint"));
    mimic.multiplier = take(elements_.number(element, "multiplier", 1));
    mimic.offset = take(elements_.number(element, "offset", 0));
    mimic.spot = elements_.spot(element);
    mimics_.push_back(std::move(mimic));
  }

  /// Finds the joint at the end of each chain of mimics.
  void follow_mimics() {
    std::unordered_map<std::string_view, std::size_t> link_of_joint;
    for (std::size_t l = 0; l < robot_.links.size(); ++l) {
      link_of_joint.emplace(robot_.links[l].joint_name, l);
    }
    std::unordered_map<std::size_t, const Mimic*> mimic_of_link;
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
    for (const Mimic& mimic : mimics_) {
      if (is_good_) follow_mimic(mimic, mimic_of_link);
    }
  }

  void follow_mimic(const Mimic& mimic,
                    const std::unordered_map<std::size_t, const Mimic*>& mimic_of_link) {
    robot_file::Follows follows{mimic.other, mimic.multiplier, mimic.offset};
    for (std::size_t step = 0; step <= mimics_.size(); ++step) {
      const auto next = mimic_of_link.find(follows.link);
      if (next == mimic_of_link.end()) {
        end_mimic(mimic, follows);
        return;
      }
      follows = {next->second->other, follows.gain * next->second->multiplier,
                 follows.gain * next->second->offset + follows.shift};
    }
    error(mimic.spot, code::kBadMimic,
          fmt::format("expected a joint that follows none in the end, found that {} mimics itself",
                      text::quoted(robot_.links[mimic.link].joint_name)));
  }

  /// Makes a joint follow the joint at the end of its chain, if that moves.
  void end_mimic(const Mimic& mimic, const robot_file::Follows& follows) {
    const Link& leader = robot_.links[follows.link];
    if (!std::isfinite(follows.gain) || !std::isfinite(follows.shift)) {
      error(mimic.spot, code::kBadMimic,
            "expected multipliers whose product is finite, found others");
    } else if (leader.type == JointType::Fixed) {
      elements_.report(Severity::Warning, mimic.spot, code::kIgnored,
                       fmt::format("<mimic> is ignored: the joint {} does not move, so {} reads "
                                   "values of its own",
                                   text::quoted(leader.joint_name),
                                   text::quoted(robot_.links[mimic.link].joint_name)));
    } else {
      robot_.links[mimic.link].follows = follows;
    }
  }

  /// Reads the type of a joint, and sets its id; joints that move have ids in file order.
  void read_type(const XMLElement& element, Link& link) {
    const std::string type = take(elements_.word(element, "type"));
    if (type.empty() || type == "fixed") return;
    if (type == "floating" || type == "planar") {
      warn(element, code::kTakenAsFixed,
           fmt::format("a {} joint is taken as fixed (as in Choreonoid)", type));
    } else if (type == "revolute" || type == "continuous" || type == "prismatic") {
      link.type = type == "prismatic" ? JointType::Prismatic : JointType::Revolute;
      link.joint_id = num_ids_++;
    } else {
      error(elements_.spot(element), code::kUnknownType,
            fmt::format("expected revolute, continuous, prismatic, fixed, floating or planar as "
                        "the type of a joint, found {}",
                        text::quoted(type)));
    }
  }

  void read_origin(const XMLElement& element, Link& link) {
    const XMLElement* origin = element.FirstChildElement("origin");
    for_each(element, "pose", [this](const XMLElement& pose) {
      warn(pose, code::kIgnored, "<pose> is ignored: URDF says the place of a joint by <origin>");
    });
    if (origin == nullptr) return;
    for_each(element, "origin", [&](const XMLElement& other) {
      if (&other != origin)
        warn(other, code::kIgnored, "<origin> is ignored: the first one counts");
    });
    link.translation = take(elements_.vector(*origin, "xyz", Vec3::Zero()));
    link.rotation = read_rotation(*origin);
  }

  /// The rotation of an <origin>. Source: urdfdom 5 (pose.cpp, URDF 1.1).
  Quat read_rotation(const XMLElement& origin) {
    constexpr const char* kQuaternion = "quat_xyzw";
    const bool has_quaternion = origin.FindAttribute(kQuaternion) != nullptr;
    if (has_quaternion && !knows_quaternions_) {
      elements_.report(Severity::Warning,
                       elements_.spot(origin, *origin.FindAttribute(kQuaternion)),
                       code::kQuaternion,
                       "quat_xyzw is ignored: it needs version=\"1.1\" in <robot> (as in urdfdom)");
    } else if (has_quaternion && origin.FindAttribute("rpy") != nullptr) {
      error(elements_.spot(origin), code::kQuaternion,
            "expected either rpy or quat_xyzw, found both");
      return Quat::Identity();
    } else if (has_quaternion) {
      return take(elements_.quaternion(origin, kQuaternion));
    }
    return rotation_of(take(elements_.vector(origin, "rpy", Vec3::Zero())));
  }

  void read_axis(const XMLElement& element, Link& link) {
    const XMLElement* axis = element.FirstChildElement("axis");
    link.axis = Vec3::UnitX();
    link.axis_spot = elements_.spot(axis == nullptr ? element : *axis);
    if (axis != nullptr) link.axis = take(elements_.vector(*axis, "xyz", Vec3::UnitX()));
  }

  void read_limit(const XMLElement& element, Link& link) {
    const bool is_continuous = element.Attribute("type", "continuous") != nullptr;
    const XMLElement* limit = element.FirstChildElement("limit");
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
      link.lower = take(elements_.limit(*limit, "lower", 0));
      link.upper = take(elements_.limit(*limit, "upper", 0));
    }
    link.max_speed = std::abs(take(elements_.limit(*limit, "velocity", link.max_speed)));
  }

  /// The root is the only link without a parent joint.
  void find_root(const XMLElement& robot) {
    const std::string* root = nullptr;
    for (const std::string& name : names_) {
      if (links_.at(name).is_child) continue;
      if (root != nullptr) {
        error(elements_.spot(*links_.at(name).element), code::kBadParent,
              fmt::format("expected one link without a joint above it, found {} and {}",
                          text::quoted(*root), text::quoted(name)));
        return;
      }
      root = &name;
    }
    if (root == nullptr) {
      const bool is_empty = names_.empty();
      error(elements_.spot(is_empty ? robot : *links_.at(names_.front()).element),
            is_empty ? code::kMissing : code::kCircle,
            is_empty ? "expected a <link> in the <robot>, found none"
                     : "expected a link without a joint above it, found none");
      return;
    }
    Link link;
    link.name = *root;
    link.spot = elements_.spot(*links_.at(*root).element);
    link.parent_spot = link.spot;
    robot_.root = robot_.links.size();
    robot_.links.push_back(std::move(link));
  }

  Elements elements_;
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
