#include <tweenfall/anim/play.h>
#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tweenfall {

/// The speed of a play's clock, and the clip time that has passed.
struct PlaySpeed::Warp {
  Curve<double> speed, way;
  double way_at_start = 0;
  std::vector<double> turns{};
  std::vector<int> directions{};  // after each turn; the first is from the start on
  double greatest = 0;
};

namespace clips {
namespace {

int sign_of(double number) noexcept {
  return number > 0 ? 1 : number < 0 ? -1 : 0;
}

const Curve<double>& ending(const Curve<double>& speed) {
  if (!std::isfinite(speed.start()) || !std::isfinite(speed.end()))
    throw std::invalid_argument("the speed of a play is a number, or a curve that has an end");
  if (speed.before() != Outside::hold || speed.after() != Outside::hold)
    throw std::invalid_argument("the speed of a play holds its values before its first key and after its last");
  return speed;
}

}  // namespace
}  // namespace clips

PlaySpeed::PlaySpeed(const Curve<double>& speed) {
  if (clips::ending(speed).knots().empty()) {
    *this = PlaySpeed(speed.value(0));
    return;
  }
  auto warp = std::make_shared<Warp>(Warp{speed, antiderivative(speed)});
  warp->way_at_start = warp->way.value(0);
  for (const double knot : speed.knots())
    if (knot > 0) warp->turns.push_back(knot);
  for (const double root : roots(speed))
    if (root > 0) warp->turns.push_back(root);
  std::ranges::sort(warp->turns);
  warp->turns.erase(std::unique(warp->turns.begin(), warp->turns.end()), warp->turns.end());
  // Between two turns the speed has one sign; it is taken half way.
  double from = 0;
  for (const double turn : warp->turns) {
    warp->directions.push_back(clips::sign_of(speed.value(from + (turn - from) / 2)));
    from = turn;
  }
  warp->directions.push_back(clips::sign_of(speed.value(from + 1)));
  const Range extent = range(speed, speed.start(), speed.end());
  warp->greatest = std::max(std::abs(extent.low), std::abs(extent.high));
  warp_ = std::move(warp);
}

double PlaySpeed::at(double own, Side side) const noexcept {
  return warp_ ? warp_->speed.value(own, side) : constant_;
}

double PlaySpeed::way(double own) const noexcept {
  return warp_ ? warp_->way.value(own) - warp_->way_at_start : constant_ * own;
}

int PlaySpeed::direction(double own, Side side) const noexcept {
  if (!warp_) return clips::sign_of(constant_);
  const std::vector<double>& turns = warp_->turns;
  const auto next = side == Side::out ? std::ranges::upper_bound(turns, own) : std::ranges::lower_bound(turns, own);
  return warp_->directions[static_cast<std::size_t>(next - turns.begin())];
}

int PlaySpeed::direction_after(std::size_t turn) const noexcept {
  return warp_ ? warp_->directions[turn] : clips::sign_of(constant_);
}

int PlaySpeed::first_direction() const noexcept {
  if (!warp_) return clips::sign_of(constant_);
  for (const int direction : warp_->directions)
    if (direction != 0) return direction;
  return 0;
}

std::span<const double> PlaySpeed::turns() const noexcept {
  return warp_ ? std::span<const double>(warp_->turns) : std::span<const double>();
}

double PlaySpeed::greatest() const noexcept {
  return warp_ ? warp_->greatest : std::abs(constant_);
}

std::optional<Curve<double>> PlaySpeed::curve() const {
  return warp_ ? std::optional(warp_->speed) : std::nullopt;
}

}  // namespace tweenfall
