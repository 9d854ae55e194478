// SPDX-License-Identifier: MIT
#include "baselines.hpp"

#include <fast_float/fast_float.h>
#include <yaml.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>

namespace kinefile::bench {

std::string_view numbers_of_bvh(std::string_view text) {
  const std::size_t frame_time = text.find("Frame Time:");
  return text.substr(text.find('\n', frame_time) + 1);
}

double sum_with_fast_float(std::string_view numbers) {
  const char* p = numbers.data();
  const char* end = p + numbers.size();
  double sum = 0;
  while (true) {
    while (p != end && (*p == ' ' || *p == '\n' || *p == '\t' || *p == '\r')) ++p;
    if (p == end) return sum;
    double value = 0;
    p = fast_float::from_chars(p, end, value).ptr;
    sum += value;
  }
}

double sum_words_with_fast_float(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; };
  const char* p = text.data();
  const char* end = p + text.size();
  double sum = 0;
  while (true) {
    while (p != end && is_blank(*p)) ++p;
    if (p == end) return sum;
    double value = 0;
    const auto read = fast_float::from_chars(p, end, value);
    p = read.ptr;
    if (read.ec == std::errc()) {
      sum += value;
    } else {
      while (p != end && !is_blank(*p)) ++p;
    }
  }
}

double sum_with_commas(std::string_view table) {
  const char* p = table.data() + table.find('\n') + 1;
  const char* end = table.data() + table.size();
  double sum = 0;
  while (p != end) {
    double value = 0;
    p = fast_float::from_chars(p, end, value).ptr + 1;
    sum += value;
  }
  return sum;
}

double sum_with_ifstream(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line) && line.rfind("Frame Time:", 0) != 0) continue;
  double sum = 0;
  double value = 0;
  while (file >> value) sum += value;
  return sum;
}

namespace {

Quat rotation_with_eigen(const Joint& joint, std::span<const double> row) {
  Quat rotation = Quat::Identity();
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Rotation) continue;
    rotation = rotation * Eigen::AngleAxisd(row[dof.coordinate] * kRadiansPerDegree, dof.axis);
  }
  return rotation;
}

void warp_joint_with_eigen(const Joint& joint, std::span<const double> from,
                           std::span<const double> to, double t, double* row) {
  const Quat a = rotation_with_eigen(joint, from);
  const Quat b = rotation_with_eigen(joint, to);
  std::array<Eigen::Index, 3> axes{};
  std::array<std::size_t, 3> columns{};
  std::size_t num_rotations = 0;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    const std::size_t c = dof.coordinate;
    if (dof.kind == DofKind::Rotation) {
      dof.axis.maxCoeff(&axes[num_rotations]);
      columns[num_rotations++] = c;
    } else {
      row[c] = from[c] + t * (to[c] - from[c]);
    }
  }
  const Vec3 angles =
      a.slerp(t, b).toRotationMatrix().eulerAngles(axes[0], axes[1], axes[2]) / kRadiansPerDegree;
  for (std::size_t k = 0; k < 3; ++k) row[columns[k]] = angles[static_cast<Eigen::Index>(k)];
}

}  // namespace

std::vector<double> warped_with_eigen(const Motion& motion, const retime::TimeMap& map) {
  const Clip& clip = motion.clip;
  std::vector<double> rows(map.old_frames.size() * clip.num_coordinates);
  for (std::size_t n = 0; n < map.old_frames.size(); ++n) {
    const auto frame = static_cast<std::size_t>(map.old_frames[n]);
    const double t = map.old_frames[n] - static_cast<double>(frame);
    const auto from = clip.row(frame);
    const auto to = clip.row(std::min(frame + 1, clip.num_frames - 1));
    for (const Joint& joint : motion.skeleton.joints) {
      warp_joint_with_eigen(joint, from, to, t, &rows[n * clip.num_coordinates]);
    }
  }
  return rows;
}

double sum_with_libyaml(std::string_view text) {
  yaml_parser_t parser;
  yaml_parser_initialize(&parser);
  yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(text.data()),
                               text.size());
  double sum = 0;
  yaml_event_t event;
  for (bool is_done = false; !is_done && yaml_parser_parse(&parser, &event) != 0;) {
    if (event.type == YAML_SCALAR_EVENT) {
      sum += std::strtod(reinterpret_cast<const char*>(event.data.scalar.value), nullptr);
    }
    is_done = event.type == YAML_STREAM_END_EVENT;
    yaml_event_delete(&event);
  }
  yaml_parser_delete(&parser);
  return sum;
}

std::vector<double> positions_with_eigen(const Motion& motion) {
  const std::vector<Joint>& joints = motion.skeleton.joints;
  std::vector<Mat3> rotations(joints.size());
  std::vector<Vec3> positions(joints.size());
  std::vector<double> all(motion.clip.num_frames * joints.size() * 3);
  double* out = all.data();
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    const auto row = motion.clip.row(f);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const Joint& joint = joints[j];
      Vec3 position = joint.offset;
      Mat3 rotation = Mat3::Identity();
      for (const DegreeOfFreedom& dof : joint.dofs) {
        const double value = row[dof.coordinate];
        if (dof.kind == DofKind::Translation) {
          position += value * dof.axis;
        } else {
          rotation *= Eigen::AngleAxisd(value * kRadiansPerDegree, dof.axis).toRotationMatrix();
        }
      }
      const bool is_root = joint.parent == kNoParent;
      rotations[j] = is_root ? rotation : Mat3(rotations[joint.parent] * rotation);
      positions[j] =
          is_root ? position : Vec3(positions[joint.parent] + rotations[joint.parent] * position);
      for (Eigen::Index k = 0; k < 3; ++k) *out++ = positions[j][k];
    }
  }
  return all;
}

namespace {

template <class T>
struct PlainDof {
  bool is_rotation;
  std::size_t column;
  Eigen::Matrix<T, 3, 1> axis;
};

template <class T>
struct PlainJoint {
  std::size_t parent;
  Eigen::Matrix<T, 3, 1> offset;
  std::vector<PlainDof<T>> dofs;
};

template <class T>
std::vector<PlainJoint<T>> plain_joints(const Skeleton& skeleton) {
  std::vector<PlainJoint<T>> joints;
  for (const Joint& joint : skeleton.joints) {
    joints.push_back({joint.parent, joint.offset.cast<T>(), {}});
    for (const DegreeOfFreedom& dof : joint.dofs) {
      joints.back().dofs.push_back(
          {dof.kind == DofKind::Rotation, dof.coordinate, dof.axis.cast<T>()});
    }
  }
  return joints;
}

template <class T>
void place_all(const Motion& motion, bool with_rotations, Placed<T>& all) {
  using Vector = Eigen::Matrix<T, 3, 1>;
  using Quaternion = Eigen::Quaternion<T>;
  constexpr T kHalf = static_cast<T>(kRadiansPerDegree / 2);
  const std::vector<PlainJoint<T>> joints = plain_joints<T>(motion.skeleton);
  const std::size_t num_poses = motion.clip.num_frames * joints.size();
  std::vector<Quaternion> rotations(joints.size());
  std::vector<Vector> positions(joints.size());
  all.positions.resize(num_poses * 3);
  all.rotations.resize(with_rotations ? num_poses * 4 : 0);
  T* position_out = all.positions.data();
  T* rotation_out = all.rotations.data();
  for (std::size_t f = 0; f < motion.clip.num_frames; ++f) {
    const auto row = motion.clip.row(f);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const PlainJoint<T>& joint = joints[j];
      Vector position = joint.offset;
      Quaternion rotation = Quaternion::Identity();
      for (const PlainDof<T>& dof : joint.dofs) {
        const T value = static_cast<T>(row[dof.column]);
        if (!dof.is_rotation) {
          position += value * dof.axis;
          continue;
        }
        const T half = value * kHalf;
        const Vector v = std::sin(half) * dof.axis;
        rotation = rotation * Quaternion(std::cos(half), v.x(), v.y(), v.z());
      }
      if (joint.parent != kNoParent) {
        const Quaternion& parent = rotations[joint.parent];
        position = positions[joint.parent] + parent._transformVector(position);
        rotation = parent * rotation;
      }
      positions[j] = position;
      rotations[j] = rotation;
      for (Eigen::Index k = 0; k < 3; ++k) *position_out++ = position[k];
      if (!with_rotations) continue;
      if (rotation.w() < 0) rotation.coeffs() = -rotation.coeffs();
      *rotation_out++ = rotation.w();
      for (Eigen::Index k = 0; k < 3; ++k) *rotation_out++ = rotation.vec()[k];
    }
  }
}

}  // namespace

void place_with_eigen(const Motion& motion, bool with_rotations, Placed<double>& placed) {
  place_all(motion, with_rotations, placed);
}

void place_with_eigen(const Motion& motion, bool with_rotations, Placed<float>& placed) {
  place_all(motion, with_rotations, placed);
}

namespace {

Vec3 nearest_turns_to(const Vec3& near, Vec3 degrees) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    degrees[k] += 360 * std::round((near[k] - degrees[k]) / 360);
  }
  return degrees;
}

/// The angles of a rotation about three different axes, of the two triples the nearer one.
Vec3 angles_with_eigen(const Mat3& rotation, const std::array<Eigen::Index, 3>& axes,
                       const Vec3& near) {
  const Vec3 angles = rotation.eulerAngles(axes[0], axes[1], axes[2]) / kRadiansPerDegree;
  const Vec3 one = nearest_turns_to(near, angles);
  const Vec3 other =
      nearest_turns_to(near, Vec3(angles[0] + 180, 180 - angles[1], angles[2] + 180));
  return (one - near).squaredNorm() <= (other - near).squaredNorm() ? one : other;
}

/// The three rotations of a joint.
struct Turning {
  std::array<Eigen::Index, 3> axes{};
  std::array<std::size_t, 3> columns{};

  Vec3 in_row(const double* row) const {
    return {row[columns[0]], row[columns[1]], row[columns[2]]};
  }
  void put(const Vec3& angles, double* row) const {
    for (std::size_t k = 0; k < 3; ++k) row[columns[k]] = angles[static_cast<Eigen::Index>(k)];
  }
};

Turning turning_of(const Joint& joint) {
  Turning turning;
  std::size_t count = 0;
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (dof.kind != DofKind::Rotation) continue;
    dof.axis.maxCoeff(&turning.axes[count]);
    turning.columns[count++] = dof.coordinate;
  }
  return turning;
}

std::vector<double> numbers_of(const Clip& clip) {
  return {clip.values.begin(), clip.values.end()};
}

/// Filters numbers in both directions around the line between their ends.
void filter_plainly(double cutoff_hz, double rate_hz, std::vector<double>& numbers) {
  const double w =
      std::tan(std::numbers::pi * cutoff_hz / rate_hz) / std::pow(std::numbers::sqrt2 - 1, 0.25);
  const double scale = 1 / (1 + std::numbers::sqrt2 * w + w * w);
  const double b0 = w * w * scale;
  const double a1 = 2 * (w * w - 1) * scale;
  const double a2 = (1 - std::numbers::sqrt2 * w + w * w) * scale;
  const std::size_t count = numbers.size();
  const std::size_t padding =
      std::min(static_cast<std::size_t>(2 * rate_hz / cutoff_hz) + 9, count - 1);
  const double first = numbers[0];
  const double slope = (numbers.back() - first) / static_cast<double>(count - 1);
  std::vector<double> padded(count + 2 * padding);
  for (std::size_t i = 0; i < count; ++i) {
    padded[padding + i] = numbers[i] - (first + slope * static_cast<double>(i));
  }
  for (std::size_t i = 1; i <= padding; ++i) {
    padded[padding - i] = -padded[padding + i];
    padded[padding + count - 1 + i] = -padded[padding + count - 1 - i];
  }
  const auto run = [&](auto begin, auto end) {
    double z1 = (1 - b0) * *begin;
    double z2 = (b0 - a2) * *begin;
    for (auto number = begin; number != end; ++number) {
      const double in = *number;
      const double out = b0 * in + z1;
      z1 = 2 * b0 * in - a1 * out + z2;
      z2 = b0 * in - a2 * out;
      *number = out;
    }
  };
  run(padded.begin(), padded.end());
  run(padded.rbegin(), padded.rend());
  for (std::size_t i = 0; i < count; ++i) {
    numbers[i] = padded[padding + i] + (first + slope * static_cast<double>(i));
  }
}

void smooth_joint_with_eigen(const Motion& motion, const Joint& joint, double cutoff_hz,
                             std::vector<double>& rows) {
  const Clip& clip = motion.clip;
  const double rate = frame_rate(clip.timeline);
  const Turning turning = turning_of(joint);
  std::array<std::vector<double>, 4> parts;
  Quat before = Quat::Identity();
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    Quat q = rotation_with_eigen(joint, clip.row(f));
    if (f > 0 && q.dot(before) < 0) q.coeffs() = -q.coeffs();
    for (std::size_t k = 0; k < 4; ++k) parts[k].push_back(q.coeffs()[static_cast<int>(k)]);
    before = q;
  }
  for (std::vector<double>& part : parts) filter_plainly(cutoff_hz, rate, part);
  for (std::size_t f = 0; f < clip.num_frames; ++f) {
    const Quat q(parts[3][f], parts[0][f], parts[1][f], parts[2][f]);
    double* row = &rows[f * clip.num_coordinates];
    turning.put(
        angles_with_eigen(q.normalized().toRotationMatrix(), turning.axes, turning.in_row(row)),
        row);
  }
}

/// The joint of the other side, or the joint itself.
std::size_t partner_of(const Skeleton& skeleton, std::size_t joint) {
  std::string name = skeleton.joints[joint].name;
  if (name.rfind("Left", 0) == 0) {
    name.replace(0, 4, "Right");
  } else if (name.rfind("Right", 0) == 0) {
    name.replace(0, 5, "Left");
  }
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].name == name) return j;
  }
  return joint;
}

}  // namespace

std::vector<double> reordered_with_eigen(const Motion& motion,
                                         const std::array<Eigen::Index, 3>& order) {
  const Clip& clip = motion.clip;
  std::vector<double> rows = numbers_of(clip);
  for (const Joint& joint : motion.skeleton.joints) {
    const Turning turning = turning_of(joint);
    Vec3 near = Vec3::Zero();
    for (std::size_t f = 0; f < clip.num_frames; ++f) {
      const Mat3 rotation = rotation_with_eigen(joint, clip.row(f)).toRotationMatrix();
      near = angles_with_eigen(rotation, order, near);
      turning.put(near, &rows[f * clip.num_coordinates]);
    }
  }
  return rows;
}

std::vector<double> smoothed_with_eigen(const Motion& motion, double cutoff_hz) {
  const Clip& clip = motion.clip;
  std::vector<double> rows = numbers_of(clip);
  for (const Joint& joint : motion.skeleton.joints) {
    smooth_joint_with_eigen(motion, joint, cutoff_hz, rows);
    for (const DegreeOfFreedom& dof : joint.dofs) {
      if (dof.kind != DofKind::Translation) continue;
      std::vector<double> numbers;
      for (std::size_t f = 0; f < clip.num_frames; ++f) {
        numbers.push_back(clip.row(f)[dof.coordinate]);
      }
      filter_plainly(cutoff_hz, frame_rate(clip.timeline), numbers);
      for (std::size_t f = 0; f < clip.num_frames; ++f) {
        rows[f * clip.num_coordinates + dof.coordinate] = numbers[f];
      }
    }
  }
  return rows;
}

std::vector<double> mirrored_with_eigen(const Motion& motion) {
  const Clip& clip = motion.clip;
  const Mat3 mirror = Vec3(-1, 1, 1).asDiagonal();
  std::vector<double> rows(clip.values.size());
  for (std::size_t j = 0; j < motion.skeleton.joints.size(); ++j) {
    const Joint& joint = motion.skeleton.joints[j];
    const Joint& partner = motion.skeleton.joints[partner_of(motion.skeleton, j)];
    const Turning turning = turning_of(partner);
    Vec3 near = Vec3::Zero();
    for (std::size_t f = 0; f < clip.num_frames; ++f) {
      double* row = &rows[f * clip.num_coordinates];
      const Mat3 rotation = rotation_with_eigen(joint, clip.row(f)).toRotationMatrix();
      near = angles_with_eigen(mirror * rotation * mirror, turning.axes, near);
      turning.put(near, row);
      for (const DegreeOfFreedom& dof : joint.dofs) {
        if (dof.kind != DofKind::Translation) continue;
        row[dof.coordinate] = (dof.axis.x() != 0 ? -1 : 1) * clip.row(f)[dof.coordinate];
      }
    }
  }
  return rows;
}

}  // namespace kinefile::bench
