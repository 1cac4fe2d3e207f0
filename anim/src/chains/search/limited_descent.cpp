#include "chains/search/limited_descent.h"

#include "chains/search/drawn.h"
#include "chains/search/swing_series.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace tweenfall::chains {

template <class Number>
std::size_t LimitedDescent<Number>::coordinates_of(const ChainShape& shape) noexcept {
  std::size_t count = 0;
  for (std::size_t i = 0; i < shape.count(); ++i)
    count += std::holds_alternative<HingeLimit>(shape.joint(i).limit) ? 1 : 3;
  return count;
}

template <class Number>
LimitedDescent<Number>::LimitedDescent(const ChainShape& shape, const Arrow& target) noexcept
    : shape_(shape), count_(shape.count()), start_(Vector::of(shape.at(0))), target_(Vector::of(target)) {
  Number reach(0);
  std::size_t first = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    Joint& joint = joint_[i];
    joint.first = first;
    joint.before = Rotation::of(shape.before(i));
    joint.bone = Vector::of(shape.arm(i));
    if constexpr (std::is_same_v<Number, Dual>)
      reach = reach + shape.length(i);
    else
      reach = reach + shape.length(i).v;
    const JointLimit& limit = shape.joint(i).limit;
    joint.axis = shape.joint(i).bone;
    joint.kind = Kind::free;
    if (const auto* hinge = std::get_if<HingeLimit>(&limit)) {
      joint.kind = Kind::hinge;
      joint.axis = hinge->axis;
      joint.low = hinge->low;
      joint.high = hinge->high;
    } else if (const auto* cone = std::get_if<ConeLimit>(&limit)) {
      joint.kind = Kind::socket;
      joint.low = cone->twist_low;
      joint.high = cone->twist_high;
      joint.swing = cone->swing;
    }
    joint.across = any_across(joint.axis);
    joint.beside = joint.axis.cross(joint.across);
    first += joint.kind == Kind::hinge ? 1 : 3;
  }
  square_ = reach * reach;
  coordinates_ = first;
  to_shape(home_);
}

// Brings the coordinates of a joint within its limits.
template <class Number>
void LimitedDescent<Number>::bound(const Joint& joint, Number* at) noexcept {
  if (joint.kind == Kind::socket) {
    const Number square = at[0] * at[0] + at[1] * at[1];
    if (value_of(square) > joint.swing * joint.swing) {
      const Number inside = joint.swing * reciprocal(root(square));
      at[0] = inside * at[0];
      at[1] = inside * at[1];
    }
  }
  Number& last = at[joint.kind == Kind::hinge ? 0 : 2];
  if (value_of(last) < joint.low) last = Number(joint.low);
  if (value_of(last) > joint.high) last = Number(joint.high);
}

template <class Number>
void LimitedDescent<Number>::to_shape(State& state) const noexcept {
  const auto number = [](const Dual& a) {
    if constexpr (std::is_same_v<Number, Dual>)
      return a;
    else
      return a.v;
  };
  for (std::size_t i = 0; i < count_; ++i) {
    const Joint& joint = joint_[i];
    const Turning& turn = shape_.turn(i);
    Number* at = state.at + joint.first;
    if (joint.kind == Kind::free) {
      state.free[i] = Rotation::of(turn);
      at[0] = at[1] = at[2] = Number(0);
      continue;
    }
    const Dual twist = twist_about(joint.axis, turn);
    if (joint.kind == Kind::hinge) {
      at[0] = number(twist);
    } else {
      const Arrow swing = log_turn(turn * inverse(about(joint.axis, twist)));
      at[0] = number(dot(swing, Arrow{joint.across, Vec3(0, 0, 0)}));
      at[1] = number(dot(swing, Arrow{joint.beside, Vec3(0, 0, 0)}));
      at[2] = number(twist);
    }
    bound(joint, at);
  }
}

template <class Number>
void LimitedDescent<Number>::begin() noexcept {
  state_ = home_;
  place();
}

template <class Number>
template <class Other>
void LimitedDescent<Number>::begin(const LimitedDescent<Other>& other) noexcept {
  for (std::size_t k = 0; k < coordinates_; ++k) state_.at[k] = Number(value_of(other.state_.at[k]));
  const auto still = [](const Three<Other>& a) {
    return Vector{Number(value_of(a.x)), Number(value_of(a.y)), Number(value_of(a.z))};
  };
  for (std::size_t i = 0; i < count_; ++i)
    if (joint_[i].kind == Kind::free)
      state_.free[i] = {still(other.state_.free[i].x), still(other.state_.free[i].y), still(other.state_.free[i].z)};
  place();
}

template <class Number>
void LimitedDescent<Number>::hold(double strength) noexcept {
  strength_ = strength;
  place();
}

template <class Number>
double LimitedDescent<Number>::distance() const noexcept {
  return std::sqrt(value_of(dot(miss_, miss_)));
}

// The rotation vector of a joint without limits, from where the shape is.
template <class Number>
auto LimitedDescent<Number>::log_of_free(std::size_t i) const noexcept -> Vector {
  const Rotation &to = state_.free[i], &from = home_.free[i];
  // Half of the sum of the cross products is the sine along the axis.
  const Vector sine = Number(0.5) * (cross(from.x, to.x) + cross(from.y, to.y) + cross(from.z, to.z));
  const Number cosine = 0.5 * (dot(from.x, to.x) + dot(from.y, to.y) + dot(from.z, to.z) - Number(1));
  const Number length = root(dot(sine, sine));
  if (!(value_of(length) > 1e-9)) return sine;
  return (arc_of(length, cosine) * reciprocal(length)) * sine;
}

// How far a coordinate is from where the shape is.
template <class Number>
Number LimitedDescent<Number>::away(std::size_t i, std::size_t k) const noexcept {
  if (joint_[i].kind != Kind::free) return state_.at[k] - home_.at[k];
  const Vector log = log_of_free(i);
  return k == joint_[i].first ? log.x : k == joint_[i].first + 1 ? log.y : log.z;
}

template <class Number>
void LimitedDescent<Number>::begin(int number, double share) noexcept {
  if (share < 1) state_ = home_;
  for (std::size_t i = 0; i < count_; ++i) {
    const Joint& joint = joint_[i];
    Number* at = state_.at + joint.first;
    const auto to = [&](Number& coordinate, double other) {
      coordinate = share < 1 ? (1 - share) * coordinate + Number(share * other) : Number(other);
    };
    double draw[3];
    for (std::size_t k = 0; k < 3; ++k) draw[k] = drawn((static_cast<std::size_t>(number) * room_joints + i) * 3 + k);
    if (joint.kind == Kind::free) {
      const auto along = [&](const Vec3& axis, double drawn_angle) {
        return turned_about(Vector::of(axis), Number(share * std::numbers::pi * (2 * drawn_angle - 1)));
      };
      const Rotation by = along(joint.across, draw[0]) * along(joint.beside, draw[1]) * along(joint.axis, draw[2]);
      state_.free[i] = share < 1 ? by * state_.free[i] : by;
      at[0] = at[1] = at[2] = Number(0);
      continue;
    }
    if (joint.kind == Kind::hinge) {
      to(at[0], joint.low + draw[0] * (joint.high - joint.low));
      continue;
    }
    const elementary::SinCos around = elementary::sin_cos(2 * std::numbers::pi * draw[0]);
    const double far = joint.swing * std::sqrt(draw[1]);
    to(at[0], far * around.cos);
    to(at[1], far * around.sin);
    to(at[2], joint.low + draw[2] * (joint.high - joint.low));
  }
  place();
}

template <class Number>
double LimitedDescent<Number>::turned() const noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t k = joint_[i].first; k < joint_[i].first + (joint_[i].kind == Kind::hinge ? 1 : 3); ++k) {
      const double by = value_of(away(i, k));
      sum += by * by;
    }
  return std::sqrt(sum);
}

template <class Number>
Turning LimitedDescent<Number>::turn(std::size_t i) const noexcept {
  const Joint& joint = joint_[i];
  const auto dual = [](const Number& a) {
    if constexpr (std::is_same_v<Number, Dual>)
      return a;
    else
      return Dual(a);
  };
  const auto arrow_of = [&](const Vector& a) {
    const Dual x = dual(a.x), y = dual(a.y), z = dual(a.z);
    return Arrow{{x.v, y.v, z.v}, {x.d, y.d, z.d}};
  };
  const Number* at = state_.at + joint.first;
  if (joint.kind == Kind::hinge) return about(joint.axis, dual(at[0]));
  if (joint.kind == Kind::socket) {
    const Vec3 still(0, 0, 0);
    const Arrow swing = dual(at[0]) * Arrow{joint.across, still} + dual(at[1]) * Arrow{joint.beside, still};
    return exp_turn(swing) * about(joint.axis, dual(at[2]));
  }
  const Arrow x = arrow_of(state_.free[i].x), y = arrow_of(state_.free[i].y), z = arrow_of(state_.free[i].z);
  Quat turn = rotation_between({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, {x.v, y.v, z.v});
  turn.coeffs() /= std::sqrt(turn.squaredNorm());
  return {turn, 0.5 * (x.v.cross(x.d) + y.v.cross(y.d) + z.v.cross(z.d))};
}

template <class Number>
void LimitedDescent<Number>::place() noexcept {
  place_[0] = start_;
  Rotation own;
  for (std::size_t i = 0; i < count_; ++i) {
    const Joint& joint = joint_[i];
    const Number* at = state_.at + joint.first;
    const Rotation outer = i == 0 ? joint.before : own * joint.before;
    outer_[i] = outer;
    if (joint.kind == Kind::free) {
      own = outer * state_.free[i];
    } else if (joint.kind == Kind::hinge) {
      own = outer * turned_about(Vector::of(joint.axis), at[0]);
    } else {
      sines_of(at[0] * at[0] + at[1] * at[1], sines_[i]);
      const Vector swing = at[0] * Vector::of(joint.across) + at[1] * Vector::of(joint.beside);
      own = outer * turned_about(swing, sines_[i][0], sines_[i][1]) * turned_about(Vector::of(joint.axis), at[2]);
    }
    place_[i + 1] = place_[i] + own * joint.bone;
  }
  miss_ = place_[count_] - target_;
  worth_ = 0.5 * dot(miss_, miss_);
  if (!(strength_ > 0)) return;
  Number sum(0);
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t k = joint_[i].first; k < joint_[i].first + (joint_[i].kind == Kind::hinge ? 1 : 3); ++k) {
      const Number by = away(i, k);
      sum = sum + by * by;
    }
  worth_ = worth_ + (0.5 * strength_) * square_ * sum;
}

template <class Number>
void LimitedDescent<Number>::slopes() noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    const Joint& joint = joint_[i];
    const Number* at = state_.at + joint.first;
    const Vector arm = place_[count_] - place_[i], torque = cross(arm, miss_);
    const auto set = [&](std::size_t k, const Vector& spin) {
      spin_[joint.first + k] = spin;
      column_[joint.first + k] = cross(spin, arm);
      slope_[joint.first + k] = dot(spin, torque);
    };
    if (joint.kind == Kind::hinge) {
      set(0, outer_[i] * Vector::of(joint.axis));
      continue;
    }
    if (joint.kind == Kind::free) {
      set(0, outer_[i].x);
      set(1, outer_[i].y);
      set(2, outer_[i].z);
      continue;
    }
    const Number &x = at[0], &y = at[1];
    const Vector across = Vector::of(joint.across), beside = Vector::of(joint.beside), swing = x * across + y * beside;
    const Number(&sines)[3] = sines_[i];
    const auto spin = [&](const Vector& a) {
      const Vector once = cross(swing, a);
      return a + sines[1] * once + sines[2] * cross(swing, once);
    };
    const auto swung = [&](const Vector& a) {
      const Vector once = cross(swing, a);
      return a + sines[0] * once + sines[1] * cross(swing, once);
    };
    set(0, outer_[i] * spin(across));
    set(1, outer_[i] * spin(beside));
    set(2, outer_[i] * swung(Vector::of(joint.axis)));

    // How the first two spins change with the swing itself.
    Number slopes[2];
    sine_slopes_of(x * x + y * y, sines, slopes);
    const Vector inner = back(outer_[i], torque);
    const auto changes = [&](const Vector& a, const Vector& by, const Number& along) {
      const Vector once = cross(swing, a), twice = cross(swing, once), other = cross(by, a);
      const Number faster = 2.0 * along;
      return (faster * slopes[0]) * once + sines[1] * other + (faster * slopes[1]) * twice +
             sines[2] * (cross(by, once) + cross(swing, other));
    };
    const std::size_t a = joint.first, b = a + 1;
    const auto slanted = [&](std::size_t k) { return column_[k] + cross(miss_, spin_[k]); };
    swings_[i][0] = dot(slanted(a), column_[a]) + dot(inner, changes(across, across, x));
    swings_[i][1] = dot(slanted(a), column_[b]) + dot(inner, changes(across, beside, y));
    swings_[i][2] = dot(slanted(b), column_[b]) + dot(inner, changes(beside, beside, y));
  }
  if (!(strength_ > 0)) return;
  const Number held = strength_ * square_;
  for (std::size_t i = 0; i < count_; ++i) {
    const Joint& joint = joint_[i];
    for (std::size_t k = joint.first; k < joint.first + (joint.kind == Kind::hinge ? 1 : 3); ++k)
      slope_[k] = slope_[k] + held * away(i, k);
    if (joint.kind != Kind::socket) continue;
    swings_[i][0] = swings_[i][0] + held;
    swings_[i][2] = swings_[i][2] + held;
  }
}

// The step to where the slope would vanish, by the factors of Cholesky. Ways that would go beyond their limits go just
// there, and the others as if these had. @returns whether it leads down
template <class Number>
bool LimitedDescent<Number>::solve(double damping) noexcept {
  constexpr int passes = 4;
  for (std::size_t j = 0; j < ways_; ++j) {
    pull_[j] = -way_[j].slope;
    way_[j].is_stopped = false;
  }
  for (int pass = 0; pass < passes; ++pass) {
    if (!solve_unstopped(damping)) return pass > 0;
    if (pass + 1 == passes || !stop()) break;
  }
  return true;
}

// @returns whether a way goes beyond its limits, and is stopped there
template <class Number>
bool LimitedDescent<Number>::stop() noexcept {
  bool any = false;
  const auto stop_at = [&](std::size_t j, const Number& step) {
    way_[j].is_stopped = any = true;
    step_[j] = step;
    for (std::size_t i = 0; i < ways_; ++i)
      if (!way_[i].is_stopped) pull_[i] = pull_[i] - (i < j ? matrix_[i][j] : matrix_[j][i]) * step;
  };
  for (std::size_t j = 0; j < ways_; ++j) {
    const Way& way = way_[j];
    const Joint& joint = joint_[way.joint];
    if (way.is_stopped || joint.kind == Kind::free) continue;
    if (!way.is_swing) {
      const Number& at = state_.at[way.first];
      const double to = value_of(at) + value_of(step_[j]);
      if (to < joint.low)
        stop_at(j, Number(joint.low) - at);
      else if (to > joint.high)
        stop_at(j, Number(joint.high) - at);
      continue;
    }
    if (j + 1 == ways_ || !way_[j + 1].is_swing || way_[j + 1].joint != way.joint) continue;
    const Number &x = state_.at[joint.first], &y = state_.at[joint.first + 1];
    const Number to_x = x + step_[j], to_y = y + step_[j + 1], square = to_x * to_x + to_y * to_y;
    if (value_of(square) <= joint.swing * joint.swing) continue;
    const Number share = joint.swing * reciprocal(root(square));
    way_[j + 1].is_stopped = true;
    stop_at(j, share * to_x - x);
    stop_at(j + 1, share * to_y - y);
    ++j;
  }
  return any;
}

template <class Number>
bool LimitedDescent<Number>::solve_unstopped(double damping) noexcept {
  const Number damped = damping * square_;
  const double least = 1e-15 * value_of(square_);
  std::size_t list[room], count = 0;
  for (std::size_t j = 0; j < ways_; ++j)
    if (!way_[j].is_stopped) list[count++] = j;
  Number inverse[room], half[room];
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t i = j; i < count; ++i) {
      Number sum = matrix_[list[j]][list[i]];
      if (i == j) sum = sum + damped;
      for (std::size_t k = 0; k < j; ++k) sum = sum - matrix_[i][k] * matrix_[j][k];
      if (i > j) {
        matrix_[i][j] = sum * inverse[j];
      } else {
        if (!(value_of(sum) > least)) return false;
        inverse[j] = reciprocal(root(sum));
      }
    }
  }
  for (std::size_t j = 0; j < count; ++j) {
    Number sum = pull_[list[j]];
    for (std::size_t k = 0; k < j; ++k) sum = sum - matrix_[j][k] * half[k];
    half[j] = sum * inverse[j];
  }
  for (std::size_t j = count; j-- > 0;) {
    Number sum = half[j];
    for (std::size_t k = j + 1; k < count; ++k) sum = sum - matrix_[k][j] * step_[list[k]];
    step_[list[j]] = sum * inverse[j];
  }
  return true;
}

template <class Number>
void LimitedDescent<Number>::keep() noexcept {
  std::copy_n(state_.at, coordinates_, kept_.at);
  for (std::size_t i = 0; i < count_; ++i)
    if (joint_[i].kind == Kind::free) kept_.free[i] = state_.free[i];
}

template <class Number>
void LimitedDescent<Number>::restore() noexcept {
  std::copy_n(kept_.at, coordinates_, state_.at);
  for (std::size_t i = 0; i < count_; ++i)
    if (joint_[i].kind == Kind::free) state_.free[i] = kept_.free[i];
}

// Turns by the step, within the limits.
template <class Number>
void LimitedDescent<Number>::move() noexcept {
  constexpr double widest = 1;  // rad
  Number farthest(widest);
  for (std::size_t j = 0; j < ways_; ++j)
    if (std::abs(value_of(step_[j])) > value_of(farthest)) farthest = value_of(step_[j]) < 0 ? -step_[j] : step_[j];
  const bool clipped = value_of(farthest) > widest;
  const Number share = clipped ? widest * reciprocal(farthest) : Number(1);
  for (std::size_t j = 0; j < ways_; ++j) {
    const Way& way = way_[j];
    const Number by = clipped ? share * step_[j] : step_[j];
    if (way.is_swing) {
      const std::size_t k = joint_[way.joint].first;
      state_.at[k] = state_.at[k] + by * way.x;
      state_.at[k + 1] = state_.at[k + 1] + by * way.y;
    } else {
      state_.at[way.first] = state_.at[way.first] + by;
    }
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const Joint& joint = joint_[i];
    Number* at = state_.at + joint.first;
    if (joint.kind == Kind::free) {
      const Vector by{at[0], at[1], at[2]};
      Number sines[3];
      sines_of(dot(by, by), sines);
      state_.free[i] = turned_about(by, sines[0], sines[1]) * state_.free[i];
      at[0] = at[1] = at[2] = Number(0);
      continue;
    }
    bound(joint, at);
  }
  place();
}

template <class Number>
auto LimitedDescent<Number>::run(int steps, double no_worse) noexcept -> End {
  constexpr double there = 1e-13, first_damping = 0.1, least_damping = 1e-10, most_damping = 1e3;
  constexpr double down = 16, up = 8, as_foreseen = 0.5;
  // What is foreseen is trusted after some steps, and more where little is left: of 64 ways down, few go to the end.
  constexpr int warm = 5;
  constexpr double little = 0.01, doubt = 8, less_doubt = 2, same = 1e-8;
  const double square = value_of(square_), worthless = 0.5 * no_worse * no_worse;
  double damping = first_damping;
  for (int done = 0; done < steps; ++done) {
    if (2 * value_of(worth_) <= there * there * square) return End::reached;
    prepare(false);
    const double before = value_of(worth_);
    keep();
    bool better = false;
    double foreseen = 0;
    for (; damping <= most_damping; damping *= up) {
      if (!solve(damping)) continue;
      foreseen = 0;
      for (std::size_t j = 0; j < ways_; ++j) foreseen -= 0.5 * value_of(step_[j]) * value_of(way_[j].slope);
      if (foreseen < 0) continue;
      if (foreseen <= 1e-16 * before || foreseen <= 1e-30 * square) return End::nearest;
      const double at_best = before - (foreseen < little * before ? less_doubt : doubt) * foreseen;
      if (done >= warm && at_best > worthless * (1 - same)) return End::hopeless;
      move();
      better = value_of(worth_) < before;
      if (better) break;
      restore();
    }
    if (!better) {
      place();
      return End::nearest;
    }
    const double gained = before - value_of(worth_);
    damping = gained > as_foreseen * foreseen ? std::max(least_damping, damping / down) : damping;
  }
  return 2 * value_of(worth_) <= there * there * square ? End::reached : End::tired;
}

template <class Number>
void LimitedDescent<Number>::settle(int steps, double damping, bool frozen) noexcept {
  for (int i = 0; i < steps; ++i) {
    prepare(frozen);
    if (!solve(damping)) return;
    move();
  }
}

template class LimitedDescent<double>;
template class LimitedDescent<Dual>;
template void LimitedDescent<Dual>::begin(const LimitedDescent<double>&) noexcept;
template void LimitedDescent<double>::begin(const LimitedDescent<double>&) noexcept;

}  // namespace tweenfall::chains
