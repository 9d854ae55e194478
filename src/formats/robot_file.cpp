// SPDX-License-Identifier: MIT
#include "formats/robot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "formats/robot_shapes.hpp"
#include "text/decode.hpp"

namespace kinefile::robot_file {
namespace {

/// How far a length may be from 1 without a message. An error in the seventh digit has no visible
/// effect.
constexpr double kUnitTolerance = 1e-6;

/// The largest number of missing joint ids. A single large id must not create millions of columns.
constexpr std::size_t kMostLeftOut = 4096;

constexpr std::size_t kNumRootColumns = 7;

/// Finds the index of every link's parent, kNoParent for the root.
class Tree {
 public:
  Tree(const Robot& robot, const Codes& codes, Diagnostics& diagnostics)
      : robot_(robot), codes_(codes), diagnostics_(diagnostics) {}

  bool find_parents() {
    name_links();
    parents_.assign(robot_.links.size(), kNoParent);
    children_.resize(robot_.links.size());
    for (std::size_t l = 0; l < robot_.links.size(); ++l) find_parent(l);
    if (is_good_) find_order();
    return is_good_;
  }

  std::size_t parent(std::size_t link) const { return parents_[link]; }
  /// The links in depth-first order, parents first.
  const std::vector<std::size_t>& order() const { return order_; }

 private:
  void error(const Spot& spot, const char* code, std::string message) {
    spot.report(diagnostics_, Severity::Error, code, std::move(message));
    is_good_ = false;
  }

  void name_links() {
    for (std::size_t l = 0; l < robot_.links.size(); ++l) {
      const Link& link = robot_.links[l];
      if (index_of_.emplace(link.name, l).second) continue;
      error(
          link.spot, codes_.repeated_name,
          fmt::format("expected one link of the name {}, found another", text::quoted(link.name)));
    }
  }

  void find_parent(std::size_t l) {
    const Link& link = robot_.links[l];
    if (link.parent.empty() != (l == robot_.root)) {
      error(
          link.parent_spot, codes_.bad_parent,
          l == robot_.root
              ? fmt::format("expected no parent of the root link {}", text::quoted(link.name))
              : fmt::format("expected a parent of the link {}, since {} is the root",
                            text::quoted(link.name), text::quoted(robot_.links[robot_.root].name)));
      return;
    }
    if (l == robot_.root) return;
    const auto found = index_of_.find(link.parent);
    if (found == index_of_.end()) {
      error(link.parent_spot, codes_.bad_parent,
            fmt::format("expected a link as the parent of {}, found {}, which is none",
                        text::quoted(link.name), text::quoted(link.parent)));
      return;
    }
    parents_[l] = found->second;
    children_[found->second].push_back(l);
  }

  void find_order() {
    std::vector<std::size_t> next = {robot_.root};
    std::vector<bool> is_reached(robot_.links.size(), false);
    while (!next.empty()) {
      const std::size_t l = next.back();
      next.pop_back();
      order_.push_back(l);
      is_reached[l] = true;
      next.insert(next.end(), children_[l].rbegin(), children_[l].rend());
    }
    const auto missed = std::find(is_reached.begin(), is_reached.end(), false);
    if (missed == is_reached.end()) return;
    auto l = static_cast<std::size_t>(missed - is_reached.begin());
    // The link may only be attached to the circle. After this many steps upwards we are in the
    // circle itself.
    for (std::size_t step = 0; step < robot_.links.size(); ++step) l = parents_[l];
    error(robot_.links[l].parent_spot, codes_.circle,
          fmt::format("expected a tree, found that {} is among its own parents",
                      text::quoted(robot_.links[l].name)));
  }

  const Robot& robot_;
  const Codes& codes_;
  Diagnostics& diagnostics_;
  bool is_good_ = true;
  std::unordered_map<std::string_view, std::size_t> index_of_;
  std::vector<std::size_t> parents_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::size_t> order_;
};

/// Counts the columns of joint ids; empty after an error. A repeated id is reported.
std::optional<std::size_t> count_ids(const Robot& robot, const std::vector<std::size_t>& order,
                                     const Codes& codes, Diagnostics& diagnostics) {
  const std::size_t most = kMostLeftOut + robot.links.size();
  std::unordered_map<std::size_t, std::size_t> link_of_id;
  std::size_t count = 0;
  bool is_good = true;
  for (const std::size_t l : order) {
    const Link& link = robot.links[l];
    if (!link.joint_id) continue;
    if (*link.joint_id > most) {
      link.id_spot.report(
          diagnostics, Severity::Error, codes.large_id,
          fmt::format("expected a joint id of at most {}, found a larger one", most));
      is_good = false;
      continue;
    }
    count = std::max(count, *link.joint_id + 1);
    const auto [first, is_new] = link_of_id.emplace(*link.joint_id, l);
    if (is_new) continue;
    link.id_spot.report(
        diagnostics, Severity::Warning, codes.repeated_id,
        fmt::format("the joint id {} of {} is that of {}, too; both read the same values",
                    *link.joint_id, text::quoted(link.name),
                    text::quoted(robot.links[first->second].name)));
  }
  return is_good ? std::optional(count) : std::nullopt;
}

bool moves(const Link& link) {
  return link.type == JointType::Revolute || link.type == JointType::Prismatic;
}

/// The axis of a joint, of unit length; empty after an error.
std::optional<Vec3> axis_of(const Link& link, const Codes& codes, Diagnostics& diagnostics) {
  auto unit = unit_of(link.axis);
  if (!unit) {
    link.axis_spot.report(
        diagnostics, Severity::Error, codes.not_unit_length,
        fmt::format("expected an axis of the joint of {}, found zero", text::quoted(link.name)));
  } else if (!((link.axis - *unit).cwiseAbs().maxCoeff() <= kUnitTolerance)) {
    link.axis_spot.report(
        diagnostics, Severity::Warning, codes.not_unit_length,
        fmt::format("expected an axis of length 1 of the joint of {}, found another length; it is "
                    "taken as a direction (Choreonoid takes it as it is in .body and .wrl files)",
                    text::quoted(link.name)));
  }
  return unit;
}

/// The joint of a link, without its degrees of freedom.
Joint joint_of(const Link& link, bool is_root) {
  Joint joint;
  joint.name = link.name;
  joint.joint_name = link.joint_name;
  if (!is_root) {
    joint.offset = link.translation;
    joint.rest_rotation = link.rotation;
    return joint;
  }
  const Vec3& t = link.translation;
  const Quat& q = link.rotation;
  joint.free_rest = {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()};
  DegreeOfFreedom free;
  free.kind = DofKind::Free;
  joint.dofs.push_back(free);
  return joint;
}

/// \param column  the column of the link's id, or its own column
DegreeOfFreedom dof_of(const Robot& robot, const Link& link, const Vec3& axis, std::size_t column) {
  DegreeOfFreedom dof;
  dof.kind = link.type == JointType::Revolute ? DofKind::Rotation : DofKind::Translation;
  dof.axis = axis;
  dof.coordinate = column;
  dof.rest = link.rest;
  dof.lower = link.lower;
  dof.upper = link.upper;
  dof.max_speed = link.max_speed;
  if (link.follows) {
    const Link& leader = robot.links[link.follows->link];
    dof.coordinate = kNumRootColumns + *leader.joint_id;
    dof.rest = leader.rest;
    dof.gain = link.follows->gain;
    dof.shift = link.follows->shift;
  }
  return dof;
}

/// The columns of the root, and one for each joint id; at first all belong to the root.
std::vector<Coordinate> columns_of_ids(std::size_t num_ids) {
  std::vector<Coordinate> columns;
  for (const char* channel : {"x", "y", "z", "qw", "qx", "qy", "qz"}) {
    columns.push_back({0, channel});
  }
  for (std::size_t id = 0; id < num_ids; ++id) columns.push_back({0, fmt::format("q{}", id)});
  return columns;
}

/// The column of a link's joint; a new one if the joint has no id. None for a root without an id
/// and for a fixed joint.
std::optional<std::size_t> column_of(const Link& link, std::size_t joint, Skeleton& skeleton,
                                     std::vector<bool>& is_taken) {
  if (!link.joint_id) {
    if (joint == 0 || link.type == JointType::Fixed) return std::nullopt;
    skeleton.coordinates.push_back({joint, "q"});
    return skeleton.coordinates.size() - 1;
  }
  const std::size_t column = kNumRootColumns + *link.joint_id;
  if (!is_taken[*link.joint_id]) skeleton.coordinates[column] = {joint, "q"};
  is_taken[*link.joint_id] = true;
  return column;
}

/// Gives every joint the shapes of its link.
void add_shapes(const Robot& robot, const std::vector<std::size_t>& order, const Codes& codes,
                Diagnostics& diagnostics, Skeleton& skeleton) {
  ShapeCollector collector(diagnostics, codes.left_out_shape);
  for (std::size_t j = 0; j < order.size(); ++j) {
    const Link& link = robot.links[order[j]];
    if (!link.shapes) continue;
    for (const VisualShape& shape : *link.shapes) {
      if (!collector.take_one(link.spot)) return;
      skeleton.joints[j].visuals.push_back(shape);
    }
  }
}

/// Gives joints with the same id the same rest value: that of the last of them.
void agree_at_rest(Skeleton& skeleton) {
  const std::vector<double> rest = rest_coordinates(skeleton);
  for (Joint& joint : skeleton.joints) {
    for (DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::Free) dof.rest = rest[dof.coordinate];
    }
  }
}

}  // namespace

std::optional<Vec3> unit_of(const Vec3& vector) {
  const double largest = vector.cwiseAbs().maxCoeff();
  if (largest == 0) return std::nullopt;
  const Vec3 scaled = vector / largest;  // the squares then neither overflow nor underflow
  return Vec3(scaled / scaled.norm());
}

Quat rotation_about(const Vec3& axis, double angle) {
  const auto unit = unit_of(axis);
  if (!unit) return Quat::Identity();
  const Vec3 v = std::sin(angle / 2) * *unit;
  return Quat(std::cos(angle / 2), v.x(), v.y(), v.z()).normalized();
}

void keep_layout(Document& document, const TextLayout& text) {
  const KeptFile* const kept = document.kept.get<KeptFile>();
  document.kept = Kept(KeptFile{text, kept == nullptr ? 0 : kept->num_joint_ids});
}

std::vector<Fact> facts(const Document& document) {
  const KeptFile* const kept = document.kept.get<KeptFile>();
  if (kept == nullptr) return {};
  std::vector<Fact> all = facts_of(kept->text);
  all.push_back({"name", skeleton_of(document).name, {}});
  return all;
}

std::optional<Document> document_of(const Robot& robot, std::string_view format, const Codes& codes,
                                    Diagnostics& diagnostics) {
  if (robot.links.size() > kMostLinks) {
    robot.links.back().spot.report(
        diagnostics, Severity::Error, codes.too_many_links,
        fmt::format("expected at most {} links, found more", kMostLinks));
    return std::nullopt;
  }
  Tree tree(robot, codes, diagnostics);
  if (!tree.find_parents()) return std::nullopt;
  const auto num_ids = count_ids(robot, tree.order(), codes, diagnostics);
  bool is_good = num_ids.has_value();

  Document document;
  Skeleton skeleton;
  skeleton.name = robot.name;
  skeleton.angle_unit = AngleUnit::Radians;
  skeleton.metres_per_unit = 1;
  skeleton.up = 2;
  skeleton.coordinates = columns_of_ids(num_ids.value_or(0));
  std::vector<std::size_t> joint_of_link(robot.links.size(), kNoParent);
  std::vector<bool> is_taken(num_ids.value_or(0), false);
  for (const std::size_t l : tree.order()) {
    const Link& link = robot.links[l];
    const std::size_t j = skeleton.joints.size();
    joint_of_link[l] = j;
    Joint joint = joint_of(link, j == 0);
    if (j > 0) joint.parent = joint_of_link[tree.parent(l)];
    const auto column = is_good ? column_of(link, j, skeleton, is_taken) : std::nullopt;
    if (j > 0 && moves(link)) {
      const auto axis = axis_of(link, codes, diagnostics);
      is_good &= axis.has_value();
      if (axis && column) joint.dofs.push_back(dof_of(robot, link, *axis, *column));
    }
    skeleton.joints.push_back(std::move(joint));
  }
  if (!is_good) return std::nullopt;
  agree_at_rest(skeleton);
  add_shapes(robot, tree.order(), codes, diagnostics, skeleton);
  document.format = format;
  document.kept = Kept(KeptFile{{}, *num_ids});
  document.content = std::move(skeleton);
  return document;
}

Result<Document> read_text(std::optional<Robot> (*parse)(const text::Source&, Diagnostics&),
                           std::string_view format, const Codes& codes, std::string_view bytes,
                           const ReadOptions& options, Diagnostics& diagnostics) {
  auto decoded = text::decode(bytes, options.encoding, options.source_name, diagnostics);
  if (!decoded) return fail(std::move(decoded.error()));
  const text::Source source(options.source_name, decoded->view());
  const auto robot = parse(source, diagnostics);
  auto document =
      robot ? document_of(*robot, format, codes, diagnostics) : std::optional<Document>();
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  keep_layout(*document, layout_of(*decoded));
  return std::move(*document);
}

}  // namespace kinefile::robot_file
