// SPDX-License-Identifier: MIT
// Mirrored in a plane of the world with S = I - 2 n n^T, joint j with world pose W_j gives its
// partner k the pose W'_k = S W_j M_j. M_j = G_j^-1 T G_k transforms j's frame to k's: G are the
// joints' frames in a pose that is its own image in the skeleton's plane, with mirror T; the pose
// with angles 0, or a frame. In its parent's frame, k's pose is M_p^-1 L_j M_j, where M_p^-1 is S
// for a root. k's degrees of freedom make the part B D_j M_j of it, where B = R_k^-1 M_p^-1 R_j and
// R are rest rotations. In the pose with angles 0, and with S = T, B is M_j^-1: a rotation about a
// becomes the opposite rotation about M_j^-1 a. If no joint has a rest rotation, every M is T.
#pragma once

#include <cstddef>
#include <vector>

#include "edit/mirror_plane.hpp"
#include "kinefile/motion.hpp"

namespace kinefile::edit {

/// A number that is copied from one degree of freedom to another, with the same or the opposite
/// sign.
struct Copy {
  DegreeOfFreedom from;
  DegreeOfFreedom to;
  double sign = 1;
};

/// How the motion of one joint becomes that of its partner.
struct JointPlan {
  std::size_t source = 0;
  std::size_t target = 0;
  Mat3 frame = Mat3::Identity();   ///< M_j: from the target's frame to the source's, mirrored
  Mat3 parent = Mat3::Identity();  ///< M_p^-1: from the source's parent's to the target's parent's
  Quat before = Quat::Identity();  ///< -B
  Quat after = Quat::Identity();   ///< -M_j
  bool is_conjugate = true;        ///< B is M_j^-1
  std::vector<Copy> copies;
  bool has_partner = true;
  bool follows = false;            ///< the target follows another joint in some column
  bool is_alone = true;            ///< no plan before it has to do with the target's columns
  bool is_rotation_found = false;  ///< angles are recomputed
  bool is_position_found = false;
};

/// What plans and the mirrored motion rely on.
struct MirrorContext {
  const Motion& motion;
  double size = 0;
  bool lenient = false;
  Diagnostics& diagnostics;
  std::vector<Quat> frames = {};            ///< G: the rotations of joints in the symmetric pose
  std::vector<std::size_t> leaders = {};    ///< of columns
  std::vector<double> rest = {};            ///< of columns
  Mat3 skeleton_mirror = Mat3::Identity();  ///< T
  Mat3 world_mirror = Mat3::Identity();     ///< S
  bool is_at_rest = true;                   ///< the symmetric pose is that with angles 0
};

/// \param plane  of `find_mirror_plane`
MirrorContext mirror_context(const Motion& motion, const MirrorPlane& plane, bool lenient,
                             Diagnostics& diagnostics);

/// A vector times a mirror matrix; exact if that only changes signs.
Vec3 reflect(const Mat3& mirror, const Vec3& v);

/// Plans all joints that move; those first that are alone.
/// \param pairs  the partner of every joint, or kNoParent; shape (joints)
std::vector<JointPlan> plan_joints(const MirrorContext& context,
                                   const std::vector<std::size_t>& pairs);

/// Whether the degrees of freedom of two partners differ so that motion is lost.
bool is_position_lost(const Joint& source, const Joint& target);

}  // namespace kinefile::edit
