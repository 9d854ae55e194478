// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/files.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"
#include "text/source.hpp"

// The common part of the formats of robot models: a list of links, from which a skeleton is made.
namespace kinefile::robot_file {

enum class JointType {
  Fixed,
  Free,
  Revolute,
  Prismatic,
  ContinuousTrack,  ///< a crawler that is only a moving surface: its joint does not move
};

/// A place in one of the texts that a robot is read from.
struct Spot {
  const text::Source* source = nullptr;
  const char* at = nullptr;

  void report(Diagnostics& diagnostics, Severity severity, const char* code,
              std::string message) const {
    text::report(*source, diagnostics, severity, code, std::move(message), at);
  }
};

/// How a joint follows another one: its value is gain * the other's + shift.
struct Follows {
  std::size_t link =
      0;  ///< the link below the other joint, which moves and does not follow another
  double gain = 1;
  double shift = 0;
};

/// The shapes of a link, which its copies share; null if there are none.
using SharedShapes = std::shared_ptr<const std::vector<VisualShape>>;

/// A link and the joint above it, as in the file; angles in radians, lengths in metres. All numbers
/// except limits are finite.
struct Link {
  std::string name;
  std::string parent;  ///< the name of another link; empty: none
  std::string joint_name;
  std::optional<std::size_t> joint_id;
  JointType type = JointType::Fixed;
  Vec3 axis = Vec3::UnitZ();  ///< in the link's frame, of any length
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();  ///< of unit length
  double rest = 0;                   ///< the joint's initial value
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double max_speed = std::numeric_limits<double>::infinity();
  std::optional<Follows> follows;
  SharedShapes shapes;        ///< in the link's frame
  Spot spot;                  ///< of its name
  Spot parent_spot;           ///< of its parent's name, or where that name belongs
  Spot axis_spot, id_spot{};  ///< of the values in the file
};

/// Links in the order of declaration, which is also the order of children.
struct Robot {
  std::string name;
  std::vector<Link> links;
  std::size_t root = 0;  ///< an index into `links`
};

/// The codes with which a format reports the faults of a robot.
struct Codes {
  const char* too_many_links;
  const char* repeated_name;
  const char* bad_parent;
  const char* circle;
  const char* large_id;
  const char* repeated_id;
  const char* not_unit_length;
  const char* left_out_shape;
};

/// The largest number of links of a robot. A short file can describe very many.
inline constexpr std::size_t kMostLinks = 10'000;

/// The unit vector along another vector; empty if that is zero.
std::optional<Vec3> unit_of(const Vec3& vector);

/// A rotation about an axis; the identity if the axis is zero.
/// \param angle  in radians
Quat rotation_about(const Vec3& axis, double angle);

/// What a document keeps of a robot's file.
struct KeptFile {
  TextLayout text;
  std::size_t num_joint_ids = 0;  ///< the columns of joint ids, after those of the root
};

/// Keeps the layout of the file that was read, in the document of a robot.
void keep_layout(Document& document, const TextLayout& text);

/// The layout of the file and the name of the robot.
std::vector<Fact> facts(const Document& document);

/// Makes a document from a robot: its links in depth-first order, children in the order of
/// declaration; the root moves freely. There are columns for the root's pose, for the joint ids
/// from 0 up, and for the joints without an id. A joint that follows another reads the other's
/// column; nothing reads the column of its own id (see `following_columns`).
/// \param format  the document's
/// \returns       empty after errors, which are in `diagnostics`
/// Source: Choreonoid 2.5 (LinkTraverse, Body::updateLinkTree), which has the same order of joint
/// values.
std::optional<Document> document_of(const Robot& robot, std::string_view format, const Codes& codes,
                                    Diagnostics& diagnostics);

/// Reads a robot that one text describes.
/// \param parse  the parser of the format; its result is empty after errors
/// \errors the first error in `diagnostics`
Result<Document> read_text(std::optional<Robot> (*parse)(const text::Source&, Diagnostics&),
                           std::string_view format, const Codes& codes, std::string_view bytes,
                           const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace kinefile::robot_file
