#include "chains/search/limited_descent.h"

#include <algorithm>

// In which ways the joints of a chain can turn from where they are.

namespace tweenfall::chains {

// Sets what a way along the rim of the disc of a swing needs.
template <class Number>
void LimitedDescent<Number>::along_rim(Way& way) const noexcept {
  const std::size_t k = way.first;
  const Number &x = state_.at[k], &y = state_.at[k + 1];
  const Number inverse = reciprocal(root(x * x + y * y));
  way.x = -(y * inverse);
  way.y = x * inverse;
  way.rim = -((x * slope_[k] + y * slope_[k + 1]) * inverse * inverse);
  way.spin = way.x * spin_[k] + way.y * spin_[k + 1];
  way.column = way.x * column_[k] + way.y * column_[k + 1];
  way.slope = way.x * slope_[k] + way.y * slope_[k + 1];
}

template <class Number>
auto LimitedDescent<Number>::add(std::size_t i, std::size_t k) noexcept -> Way& {
  Way& way = way_[ways_++];
  way.joint = i;
  way.first = k;
  way.is_swing = way.is_rim = way.is_stopped = false;
  way.rim = Number(0);
  way.spin = spin_[k];
  way.column = column_[k];
  way.slope = slope_[k];
  return way;
}

// What is at a limit, and would be nearer beyond, stays there.
template <class Number>
void LimitedDescent<Number>::open() noexcept {
  constexpr double rim = 1 - 1e-12;
  ways_ = 0;
  const auto add_if_free = [&](std::size_t i, std::size_t k) {
    const double at = value_of(state_.at[k]), slope = value_of(slope_[k]);
    const Joint& joint = joint_[i];
    if (!(joint.low < joint.high) || (at <= joint.low && slope >= 0) || (at >= joint.high && slope <= 0)) return;
    add(i, k);
  };
  for (std::size_t i = 0; i < count_; ++i) {
    const Joint& joint = joint_[i];
    const std::size_t k = joint.first;
    if (joint.kind == Kind::hinge) {
      add_if_free(i, k);
    } else if (joint.kind == Kind::free) {
      for (std::size_t each = 0; each < 3; ++each) add(i, k + each);
    } else {
      const Number &x = state_.at[k], &y = state_.at[k + 1];
      const Number far = root(x * x + y * y);
      if (!(joint.swing > 0)) {
        // It only twists.
      } else if (value_of(far) >= rim * joint.swing && value_of(x * slope_[k] + y * slope_[k + 1]) < 0) {
        Way& way = add(i, k);
        way.is_swing = way.is_rim = true;
        along_rim(way);
      } else {
        for (std::size_t each = 0; each < 2; ++each) {
          Way& way = add(i, k + each);
          way.is_swing = true;
          way.x = Number(each == 0 ? 1 : 0);
          way.y = Number(each == 0 ? 0 : 1);
        }
      }
      add_if_free(i, k + 2);
    }
  }
}

// The same ways as before, from where it is now.
template <class Number>
void LimitedDescent<Number>::open_again() noexcept {
  for (std::size_t j = 0; j < ways_; ++j) {
    Way& way = way_[j];
    if (way.is_rim) {
      along_rim(way);
      continue;
    }
    way.spin = spin_[way.first];
    way.column = column_[way.first];
    way.slope = slope_[way.first];
  }
}

template <class Number>
void LimitedDescent<Number>::prepare(bool frozen) noexcept {
  slopes();
  if (frozen)
    open_again();
  else
    open();
  for (std::size_t a = 0; a < ways_; ++a) way_[a].slanted = way_[a].column + cross(miss_, way_[a].spin);
  for (std::size_t a = 0; a < ways_; ++a)
    for (std::size_t b = a; b < ways_; ++b) matrix_[a][b] = curvature(way_[a], way_[b]);
}

// The second derivative, of which the first way is not behind the other.
template <class Number>
Number LimitedDescent<Number>::curvature(const Way& a, const Way& b) const noexcept {
  if (a.joint == b.joint) {
    const Number held = &a == &b ? strength_ * square_ : Number(0);
    if (a.is_swing && b.is_swing) {
      const Number(&s)[3] = swings_[a.joint];
      return a.x * (b.x * s[0] + b.y * s[1]) + a.y * (b.x * s[1] + b.y * s[2]) + (&a == &b ? a.rim : Number(0));
    }
    if (joint_[a.joint].kind == Kind::free) return 0.5 * (dot(a.slanted, b.column) + dot(b.slanted, a.column)) + held;
    return dot(a.slanted, b.column) + held;
  }
  return dot(a.slanted, b.column);
}

// The class is instantiated where the rest of it is defined.
template void LimitedDescent<double>::open() noexcept;
template void LimitedDescent<Dual>::open() noexcept;
template void LimitedDescent<double>::open_again() noexcept;
template void LimitedDescent<Dual>::open_again() noexcept;
template void LimitedDescent<double>::prepare(bool) noexcept;
template void LimitedDescent<Dual>::prepare(bool) noexcept;
template void LimitedDescent<double>::along_rim(Way&) const noexcept;
template void LimitedDescent<Dual>::along_rim(Way&) const noexcept;
template auto LimitedDescent<double>::add(std::size_t, std::size_t) noexcept -> Way&;
template auto LimitedDescent<Dual>::add(std::size_t, std::size_t) noexcept -> Way&;
template double LimitedDescent<double>::curvature(const Way&, const Way&) const noexcept;
template Dual LimitedDescent<Dual>::curvature(const Way&, const Way&) const noexcept;

}  // namespace tweenfall::chains
