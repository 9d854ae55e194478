// SPDX-License-Identifier: MIT
// Included once for every instruction set, behind lanes-inl.hpp, so without an include guard.
// What a planned joint does to a pose, in every lane.

HWY_BEFORE_NAMESPACE();
namespace kinefile::simd {
namespace HWY_NAMESPACE {

/// The columns of a pass, from one of its frames on.
template <class T>
struct ColumnLanes {
  const Row<double, T>* rows;
  std::size_t lane;
};

/// The values of an input in double precision, from a frame on.
HWY_INLINE Lanes<double> values_at(const Input& input, const double* numbers) {
  const Lanes<double> lanes = hn::Load(Tag<double>(), numbers);
  if (input.gain == 1 && input.shift == 0) return lanes;
  return fill<double>(input.gain) * lanes + fill<double>(input.shift);
}

HWY_INLINE Lanes<double> values_of(const Input& input, const ColumnLanes<double>& columns) {
  return values_at(input, columns.rows[input.coordinate].v + columns.lane);
}

/// The angles of a turn.
HWY_INLINE Lanes<double> angles_of(const Input& input, const ColumnLanes<double>& columns, bool) {
  return values_of(input, columns);
}

#if HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SCALAR
template <class D>
HWY_INLINE Lanes<float> narrow(const D* doubles) {
  return hn::DemoteTo(Tag<float>(), doubles[0]);
}
#else
template <class D>
HWY_INLINE Lanes<float> narrow(const D* doubles) {
  constexpr hn::Half<Tag<float> > half;
  return hn::Combine(Tag<float>(), hn::DemoteTo(half, doubles[1]), hn::DemoteTo(half, doubles[0]));
}
#endif

/// How many vectors of doubles have the lanes of a vector of floats.
constexpr std::size_t kWide = kLanes<float> / kLanes<double>;

HWY_INLINE Lanes<float> values_of(const Input& input, const ColumnLanes<float>& columns) {
  Lanes<double> wide[kWide];
  for (std::size_t i = 0; i < kWide; ++i) {
    wide[i] =
        values_at(input, columns.rows[input.coordinate].v + columns.lane + i * kLanes<double>);
  }
  return narrow(wide);
}

/// The same in single precision; whole turns are subtracted from large ones before.
HWY_INLINE Lanes<float> angles_of(const Input& input, const ColumnLanes<float>& columns,
                                  bool is_in_degrees) {
  constexpr Tag<double> d;
  const double turn = is_in_degrees ? 360 : 2 * std::numbers::pi;
  Lanes<double> wide[kWide];
  for (std::size_t i = 0; i < kWide; ++i) {
    wide[i] =
        values_at(input, columns.rows[input.coordinate].v + columns.lane + i * kLanes<double>);
    if (HWY_LIKELY(hn::AllTrue(d, hn::Abs(wide[i]) <= fill<double>(turn)))) continue;
    alignas(64) double angles[kLanes<double>];
    hn::Store(wide[i], d, angles);
    for (double& angle : angles) {  // a lane must not depend on others
      if (!(std::abs(angle) <= turn)) angle = std::remainder(angle, turn);
    }
    wide[i] = hn::Load(d, angles);
  }
  return narrow(wide);
}

/// The product with a quaternion whose vector has one number: turns w and `along` into each other,
/// and the other two.
template <class T>
HWY_INLINE void turn_about(Lanes<T> sine, Lanes<T> cosine, Lanes<T>& w, Lanes<T>& along,
                           Lanes<T>& next, Lanes<T>& last) {
  const Lanes<T> old_w = w;
  const Lanes<T> old_next = next;
  w = cosine * w - sine * along;
  along = cosine * along + sine * old_w;
  next = cosine * next + sine * last;
  last = cosine * last - sine * old_next;
}

/// Multiplies a rotation by that of a turn.
/// \param sine, cosine  of half of its angle
template <class T>
HWY_INLINE void apply_turn(const Turn& turn, Lanes<T> sine, Lanes<T> cosine,
                           QuaternionLanes<T>& q) {
  if (turn.axis == 0) {
    turn_about<T>(sine, cosine, q.w, q.x, q.y, q.z);
  } else if (turn.axis == 1) {
    turn_about<T>(sine, cosine, q.w, q.y, q.z, q.x);
  } else if (turn.axis == 2) {
    turn_about<T>(sine, cosine, q.w, q.z, q.x, q.y);
  } else {
    q = q * QuaternionLanes<T>{cosine, sine * fill<T>(turn.direction[0]),
                               sine * fill<T>(turn.direction[1]),
                               sine * fill<T>(turn.direction[2])};
  }
}

/// The position of a joint's origin in its parent's frame.
template <class T>
HWY_INLINE VectorLanes<T> local_position(const PlannedJoint& joint, const ColumnLanes<T>& columns) {
  VectorLanes<T> position = fill<T>(joint.offset);
  for (const Shift& shift : joint.shifts) {
    const Lanes<T> by = values_of(shift.input, columns);
    const Vector& u = shift.direction;
    if (u[0] != 0) position.x = position.x + fill<T>(u[0]) * by;
    if (u[1] != 0) position.y = position.y + fill<T>(u[1]) * by;
    if (u[2] != 0) position.z = position.z + fill<T>(u[2]) * by;
  }
  return position;
}

/// Applies a joint's tail moves, which act on its children and tips.
template <class T>
HWY_INLINE void apply_tail(const PlannedJoint& joint, const ColumnLanes<T>& columns,
                           VectorLanes<T>& point) {
  for (std::size_t m = joint.tail_moves.size(); m-- > 0;) {
    const TailMove& move = joint.tail_moves[m];
    const Vector& u = move.direction;
    const Lanes<T> values = values_of(move.input, columns);
    if (move.is_scale && move.axis < 3) {  // a single product loses no digits
      Lanes<T>& number = move.axis == 0 ? point.x : move.axis == 1 ? point.y : point.z;
      number = number * values;
      continue;
    }
    const auto along = point.x * fill<T>(u[0]) + point.y * fill<T>(u[1]) + point.z * fill<T>(u[2]);
    const auto step = move.is_scale ? (values - fill<T>(1)) * along : values;
    point =
        point + VectorLanes<T>{step * fill<T>(u[0]), step * fill<T>(u[1]), step * fill<T>(u[2])};
  }
}

/// The first number of each quaternion that is not 0.
template <class T>
HWY_INLINE Lanes<T> first_number(const QuaternionLanes<T>& q) {
  const auto zero = fill<T>(0);
  if (HWY_LIKELY(hn::AllFalse(Tag<T>(), q.w == zero))) return q.w;
  const auto of_last = hn::IfThenElse(q.y == zero, q.z, q.y);
  return hn::IfThenElse(q.w == zero, hn::IfThenElse(q.x == zero, of_last, q.x), q.w);
}

/// The unit quaternions of quaternions whose lengths are 1 but for rounding. The sign is such that
/// w
/// >= 0, and if w = 0 the first other nonzero number is positive: equal rotations have equal
/// numbers. None is -0.
template <class T>
HWY_INLINE QuaternionLanes<T> canonical(const QuaternionLanes<T>& q) {
  const auto square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  // One step of Newton's method for 1 / sqrt(square), with the first number's sign.
  const auto size = fill<T>(1.5) - fill<T>(0.5) * square;
  const auto by = hn::CopySign(size, first_number<T>(q));
  const auto zero = fill<T>(0);
  return {q.w * by + zero, q.x * by + zero, q.y * by + zero, q.z * by + zero};
}

}  // namespace HWY_NAMESPACE
}  // namespace kinefile::simd
HWY_AFTER_NAMESPACE();
