// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/files.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/document.hpp"
#include "kinefile/format.hpp"
#include "text/source.hpp"

// What the formats of robot models have in common: a list of links, of which a skeleton is made.
namespace kinefile::robot_file {

enum class JointType {
  Fixed,
  Free,
  Revolute,
  Prismatic,
  ContinuousTrack,  ///< a crawler that is no more than a moving surface: it stays in its place
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
  std::size_t link = 0;  ///< which hangs on the other joint; it moves and follows none
  double gain = 1;
  double shift = 0;
};

/// A link and the joint that it hangs on, as a file has them; angles in radians, lengths in metres.
/// All numbers are finite but for limits.
struct Link {
  std::string name;
  std::string parent;  ///< the name of another link; empty: none
  std::string joint_name;
  std::optional<std::size_t> joint_id;
  JointType type = JointType::Fixed;
  Vec3 axis = Vec3::UnitZ();  ///< in the link's frame, of any length
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();  ///< of unit length
  double rest = 0;                   ///< the joint's value at first
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double max_speed = std::numeric_limits<double>::infinity();
  std::optional<Follows> follows;
  Spot spot;                  ///< of its name
  Spot parent_spot;           ///< of its parent's name, or where that might stand
  Spot axis_spot, id_spot{};  ///< of what the file says
};

/// Links in the order of declaration, which is that of children.
struct Robot {
  std::string name;
  std::vector<Link> links;
  std::size_t root = 0;  ///< an index into `links`
};

/// The codes by which a format tells what is wrong with a robot.
struct Codes {
  const char* too_many_links;
  const char* repeated_name;
  const char* bad_parent;
  const char* circle;
  const char* large_id;
  const char* repeated_id;
  const char* not_unit_length;
};

/// How many links a robot may have. Files can say many in few words.
inline constexpr std::size_t kMostLinks = 10'000;

/// The vector of unit length along another one; nothing if that is zero.
std::optional<Vec3> unit_of(const Vec3& vector);

/// A rotation about an axis, which is zero for none.
/// \param angle  in radians
Quat rotation_about(const Vec3& axis, double angle);

/// What a document keeps of a robot's file.
struct KeptFile {
  TextLayout text;
  std::size_t num_joint_ids = 0;  ///< the columns of joint ids, behind those of the root
};

/// Keeps the layout of the file that was named, for a document of a robot.
void keep_layout(Document& document, const TextLayout& text);

/// The layout of the file and the name of the robot.
std::vector<Fact> facts(const Document& document);

/// Makes a document of a robot: its links in depth-first order, children in the order of
/// declaration, the root moving freely; columns for the root's pose, for the joint ids from 0 on
/// and for the joints that have none. A joint that follows another reads that one's column; the
/// column of its own id is there and read by nothing (see `following_columns`).
/// \param format  the document's
/// \returns       nothing after errors, which are in `diagnostics`
/// Source: Choreonoid 2.5 (LinkTraverse, Body::updateLinkTree), whose order of joint values it is.
std::optional<Document> document_of(const Robot& robot, std::string_view format, const Codes& codes,
                                    Diagnostics& diagnostics);

/// Reads a robot that one text describes.
/// \param parse  the format's; nothing after errors
/// \errors the first of those that are in `diagnostics` then
Result<Document> read_text(std::optional<Robot> (*parse)(const text::Source&, Diagnostics&),
                           std::string_view format, const Codes& codes, std::string_view bytes,
                           const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace kinefile::robot_file
