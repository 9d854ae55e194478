// SPDX-License-Identifier: MIT
#include "support/random_clips.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kinefile::test {

double random_number(RandomSource& random, double low, double high) {
  // Not std::uniform_real_distribution, which gives other numbers with other libraries.
  const double unit = static_cast<double>(random() >> 11) * 0x1p-53;
  return low + (high - low) * unit;
}

bool random_chance(RandomSource& random, double probability) {
  return random_number(random, 0, 1) < probability;
}

std::size_t random_below(RandomSource& random, std::size_t bound) { return random() % bound; }

Vec3 random_vector(RandomSource& random, double size) {
  const double x = random_number(random, -size, size);
  const double y = random_number(random, -size, size);
  return {x, y, random_number(random, -size, size)};
}

Quat random_rotation(RandomSource& random) {
  const Vec3 axis = random_vector(random, 1) + Vec3(0, 0, 1e-3);
  return Quat(Eigen::AngleAxisd(random_number(random, -3.1, 3.1), axis.normalized()));
}

std::size_t columns_of_meaning(Means means) {
  if (means == Means::Free) return 7;
  if (means == Means::Ball) return 4;
  return means == Means::Vector ? 3 : 1;
}

double quarter_turn(const Skeleton& skeleton) {
  return skeleton.angle_unit == AngleUnit::Degrees ? 90 : std::numbers::pi / 2;
}

namespace {

constexpr std::size_t kNumRandomFrames = 14;

/// A clip in the making.
struct ClipMaker {
  RandomSource& random;
  const std::vector<Means>& meanings;
  Motion& motion;

  const Skeleton& skeleton() const { return motion.skeleton; }
};

/// A curve through the frames: about a middle, as far from it, with a frequency.
double curve_at(double middle, double size, double frequency, double phase, std::size_t frame) {
  return middle + size * std::sin(frequency * static_cast<double>(frame) + phase);
}

void fill_free(ClipMaker& maker, std::size_t column, const Rows& rows) {
  const Vec3 start = random_vector(maker.random, 1);
  const Vec3 speed = random_vector(maker.random, 0.1);
  const Quat turn = random_rotation(maker.random);
  const Vec3 spin = random_vector(maker.random, 0.3);
  for (std::size_t f = 0; f < kNumRandomFrames; ++f) {
    const auto frame = static_cast<double>(f);
    const Vec3 place = start + frame * speed;
    const Quat q = turn * exp_of(frame * spin);
    const double numbers[] = {place[0], place[1], place[2], q.w(), q.x(), q.y(), q.z()};
    std::copy_n(numbers, 7, rows[f].begin() + static_cast<std::ptrdiff_t>(column));
  }
}

void fill_ball(ClipMaker& maker, std::size_t column, const Rows& rows) {
  const Quat turn = random_rotation(maker.random);
  const Vec3 spin = random_vector(maker.random, 0.3);
  for (std::size_t f = 0; f < kNumRandomFrames; ++f) {
    const Quat q = turn * exp_of(static_cast<double>(f) * spin);
    const double length = 1 + 0.1 * static_cast<double>(f % 3);  // normalised in kinematics only
    const double numbers[] = {length * q.w(), length * q.x(), length * q.y(), length * q.z()};
    std::copy_n(numbers, 4, rows[f].begin() + static_cast<std::ptrdiff_t>(column));
  }
}

void fill_vector(ClipMaker& maker, std::size_t column, const Rows& rows) {
  const double quarter = quarter_turn(maker.skeleton());
  const Vec3 middle = random_vector(maker.random, 1.5 * quarter);
  const Vec3 way = random_vector(maker.random, 0.1 * quarter);
  for (std::size_t f = 0; f < kNumRandomFrames; ++f) {
    const Vec3 vector = middle + static_cast<double>(f) * way;
    std::copy_n(vector.data(), 3, rows[f].begin() + static_cast<std::ptrdiff_t>(column));
  }
}

/// Fills columns that mean one thing. Returns false for one that is a number by itself.
bool fill_whole(ClipMaker& maker, std::size_t column, const Rows& rows) {
  switch (maker.meanings[column]) {
    case Means::Free:
      fill_free(maker, column, rows);
      return true;
    case Means::Ball:
      fill_ball(maker, column, rows);
      return true;
    case Means::Vector:
      fill_vector(maker, column, rows);
      return true;
    default:
      return false;
  }
}

/// Lets columns that repeat what joints have by following others do so.
void fill_following(ClipMaker& maker, const Rows& rows) {
  for (const FollowingColumn& following : following_columns(maker.skeleton())) {
    const DegreeOfFreedom& dof = maker.skeleton().joints[following.joint].dofs[0];
    for (std::size_t f = 0; f < kNumRandomFrames; ++f) {
      rows[f][following.column] = value_of(dof, rows[f][dof.coordinate]);
    }
  }
}

}  // namespace

void fill_random_clip(RandomSource& random, const std::vector<Means>& meanings, bool without_frames,
                      Motion& motion) {
  ClipMaker maker{random, meanings, motion};
  Clip& clip = maker.motion.clip;
  clip.num_frames = without_frames ? 0 : kNumRandomFrames;
  clip.num_coordinates = maker.meanings.size();
  clip.timeline = {FrameTime{1.0 / 60}, 0};
  clip.values.assign(clip.num_frames * clip.num_coordinates, 0);
  if (without_frames) return;
  const Rows rows = clip.mutate();
  const double quarter = quarter_turn(maker.skeleton());
  for (std::size_t c = 0; c < maker.meanings.size(); ++c) {
    const Means means = maker.meanings[c];
    if (fill_whole(maker, c, rows)) {
      c += columns_of_meaning(means) - 1;
      continue;
    }
    const bool is_still = random_chance(maker.random, 0.15);
    const double size = (means == Means::Angle   ? quarter
                         : means == Means::Scale ? 0.3
                                                 : 0.5) *
                        (is_still ? 0 : 1);
    const double spread = means == Means::Angle ? quarter : 0.3;
    const double middle =
        random_number(maker.random, -spread, spread) + (means == Means::Scale ? 1 : 0);
    const double frequency = random_number(maker.random, 0.05, 0.5);
    const double phase = random_number(maker.random, 0, 6);
    for (std::size_t f = 0; f < kNumRandomFrames; ++f) {
      rows[f][c] = curve_at(middle, size, frequency, phase, f);
    }
  }
  fill_following(maker, rows);
}

}  // namespace kinefile::test
