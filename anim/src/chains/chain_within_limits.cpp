#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "chains/chain_solve.h"
#include "chains/search/chain_search.h"
#include "chains/search/drawn.h"

// Why steps do not flip: each is a continuous function of the pose and the target, and so is a sequence of them.
// Methods that are not continuous are avoided: undoing a step that did not help, keeping the better of two results,
// locking joints that have met a limit. Only where the steps do not lead to the target, a chain that may leap is
// searched for (search/chain_search.h).

namespace tweenfall::chains {
namespace {

constexpr double widest = 0.5;   // rad, that a joint turns in one step
constexpr double there = 1e-13;  // of the chain's length

// The degrees of freedom of the joints, and their ranges.
struct Ways {
  struct Way {
    std::size_t joint;
    Arrow axis;    // in the axes of the joint's rest pose
    Arrow column;  // how the end moves with it, m/rad
    Dual ease;     // how easily it turns; 1 or more
    Dual low, high;
    bool is_round;  // as in `Freedom`
    Dual out;
  };
  std::size_t count = 0;
  Way way[3 * ChainShape::room];
};

Dual turned(const Ways::Way& way, const Arrow& pull) noexcept {
  const Dual turn = way.ease * dot(way.column, pull);
  return turn.v <= way.low.v ? way.low : turn.v >= way.high.v ? way.high : turn;
}

// The turns of a way and the one beside it that are limited together.
std::pair<Dual, Dual> turned(const Ways::Way& way, const Ways::Way& beside, const Arrow& pull) noexcept {
  const Dual x = way.out + way.ease * dot(way.column, pull), y = way.ease * dot(beside.column, pull);
  const Dual far = root(x * x + y * y);
  if (far.v <= way.high.v) return {x - way.out, y};
  const Dual share = way.high / far;
  return {share * x - way.out, share * y};
}

// Calls `visit` with each way and its turn under a pull.
template <class Visit>
void turn_all(const Ways& ways, const Arrow& pull, const Visit& visit) noexcept {
  for (std::size_t i = 0; i < ways.count; ++i) {
    const Ways::Way& way = ways.way[i];
    if (!way.is_round) {
      visit(way, turned(way, pull));
      continue;
    }
    const Ways::Way& beside = ways.way[++i];
    const auto [turn, aside] = turned(way, beside, pull);
    visit(way, turn);
    visit(beside, aside);
  }
}

// The pull under which the joints turn until the remainder of `missing` equals damping * pull. Their difference is the
// gradient of a strictly concave function, so there is exactly one such pull, and Newton's method with line search
// finds it.
Arrow pull_of(const Ways& ways, const Dual& damping, const Arrow& missing) noexcept {
  Mat3 slope;
  const auto left = [&](const Vec3& pull) {
    Vec3 rest = missing.v - damping.v * pull;
    slope = damping.v * Mat3::Identity();
    for (std::size_t i = 0; i < ways.count; ++i) {
      const Ways::Way& way = ways.way[i];
      const Vec3& a = way.column.v;
      const double turn = way.ease.v * a.dot(pull);
      if (!way.is_round) {
        rest -= std::clamp(turn, way.low.v, way.high.v) * a;
        if (turn > way.low.v && turn < way.high.v) slope += (way.ease.v * a) * a.transpose();
        continue;
      }
      const Vec3& b = ways.way[++i].column.v;
      const double x = way.out.v + turn, y = way.ease.v * b.dot(pull), far = std::sqrt(x * x + y * y);
      if (far <= way.high.v) {
        rest -= turn * a + y * b;
        slope += way.ease.v * (a * a.transpose() + b * b.transpose());
      } else {
        const double share = way.high.v / far;
        rest -= (share * x - way.out.v) * a + (share * y) * b;
        const Vec3 along = (x * b - y * a) / far;
        slope += (way.ease.v * share) * along * along.transpose();
      }
    }
    return rest;
  };
  const auto newton = [&](const Vec3& by) -> Vec3 { return slope.inverse() * by; };

  constexpr double exact = 1e-14;
  constexpr int most = 60, halvings = 40;
  Arrow pull;
  Vec3 now = left(pull.v);
  for (int i = 0; i < most && now.squaredNorm() > exact * exact * missing.v.squaredNorm(); ++i) {
    const Vec3 on = newton(now);
    const double slack = 0.5 * now.dot(on);
    double share = 1;
    Vec3 next = left(pull.v + on);
    for (int k = 0; k < halvings && next.dot(on) < -slack; ++k) {
      share *= 0.5;
      next = left(pull.v + share * on);
    }
    pull.v += share * on;
    now = next;
  }

  Vec3 rate = missing.d - damping.d * pull.v;
  turn_all(ways, pull,
           [&](const Ways::Way& way, const Dual& turn) { rate -= turn.v * way.column.d + turn.d * way.column.v; });
  pull.d = newton(rate);
  return pull;
}

class LimitedSolve {
 public:
  LimitedSolve(const JointChain& chain, const Arrow& target, ChainShape& shape) noexcept;
  void run() noexcept;
  bool go_on(const ChainShape& home, const Dual& share, bool searches) noexcept;

 private:
  void move_off() noexcept;
  void search() noexcept;
  enum class Steps { all, some, glance };
  void track(Steps steps) noexcept;
  double step(const Arrow& target) noexcept;
  void start_over(int number) noexcept;
  void glance_from(int number) noexcept;
  [[nodiscard]] Dual distance() const noexcept { return length(target_ - shape_.end()); }
  [[nodiscard]] bool arrived() const noexcept { return distance().v <= 1e-9 * shape_.reach().v; }

  const JointChain& chain_;
  const std::size_t count_;
  const Arrow target_;
  ChainShape& shape_;
  Dual curvature_;  // bound on the change of the end's motion as all joints turn, m
  Dual ease_[ChainShape::room];
  Ways ways_;  // of the current step; kept because constructing them takes longer than the step
};

// The second derivative of the end's position by the turns of two joints is no longer than the bones from the later one
// on. The sum over all others bounds how much a joint's turn can bend the path of the end (Gershgorin).
LimitedSolve::LimitedSolve(const JointChain& chain, const Arrow& target, ChainShape& shape) noexcept
    : chain_(chain), count_(shape.count()), target_(target), shape_(shape) {
  Dual bones, sum, own[ChainShape::room];
  for (std::size_t i = count_; i-- > 0;) {
    bones = bones + shape.length(i);
    sum = sum + bones;
    own[i] = sum + static_cast<double>(i) * bones;
  }
  curvature_ = own[0];
  for (std::size_t i = 0; i < count_; ++i)
    ease_[i] = chain.method() == ChainMethod::fabrik || !(own[i].v > 0) ? Dual(1) : own[0] / own[i];
}

// One Levenberg-Marquardt step within the limits: of all ways to bring the end nearer, the one that turns the joints
// least. It is damped by as much as the path of the end can bend, in proportion to the remaining distance: far from the
// target it always leads nearer, and close to it it is a Newton step.
// @returns the largest turn, rad
double LimitedSolve::step(const Arrow& target) noexcept {
  const Arrow missing = target - shape_.end();
  ways_.count = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Freedom freedom = freedom_of(shape_.joint(i), shape_.turn(i));
    const Arrow arm = shape_.inside(i, shape_.end() - shape_.at(i));
    for (int k = 0; k < freedom.count; ++k) {
      const Freedom::Way& way = freedom.ways[k];
      ways_.way[ways_.count++] = {.joint = i,
                                  .axis = way.axis,
                                  .column = shape_.outside(i, cross(way.axis, arm)),
                                  .ease = ease_[i],
                                  .low = way.low.v < -widest ? Dual(-widest) : way.low,
                                  .high = way.high.v > widest && !way.is_round ? Dual(widest) : way.high,
                                  .is_round = way.is_round,
                                  .out = way.out};
    }
  }
  // Too small to matter; keeps the pull finite where nothing is free to turn.
  const Dual least = 1e-14 * shape_.reach() * shape_.reach();
  const Arrow pull = pull_of(ways_, length(missing) * curvature_ + least, missing);
  double largest = 0;
  Arrow by[ChainShape::room];
  turn_all(ways_, pull, [&](const Ways::Way& way, const Dual& turn) {
    largest = std::max(largest, std::abs(turn.v));
    by[way.joint] = by[way.joint] + turn * way.axis;
  });
  for (std::size_t i = 0; i < count_; ++i) shape_.turn(i, turned_by(shape_.joint(i), shape_.turn(i), by[i]));
  shape_.place();
  return largest;
}

// Moves toward the middle of the limits, more for farther targets: from there all joints have room to turn.
void LimitedSolve::move_off() noexcept {
  constexpr double half_way = 0.1;  // of the chain's length
  const Dual missing = distance(), square = missing * missing, reach = half_way * shape_.reach();
  const Dual share = square / (square + reach * reach);
  for (std::size_t i = 0; i < count_; ++i) {
    const Turning& turn = shape_.turn(i);
    const Arrow way = log_turn(middle_of(shape_.joint(i), turn) * inverse(turn));
    shape_.turn(i, within_limits(shape_.joint(i), exp_turn(share * way) * turn));
  }
  shape_.place();
  bend(target_, shape_);
}

// @param steps  to the end; a few, always as many; or only as long as they lead on by a tenth in four steps
void LimitedSolve::track(Steps steps) noexcept {
  constexpr int most = 300, few = 40, glance = 4;
  constexpr double still = 1e-14;  // rad
  const Arrow from = shape_.end();
  // Clamped to the reach of the chain: a farther target in the same direction has the same result.
  const Measured way = measured(target_ - shape_.at(0));
  const Arrow to = way.length.v > shape_.reach().v ? shape_.at(0) + shape_.reach() * way.unit : target_;
  for (int i = 1; i < chain_.sweeps(); ++i) step(from + Dual(static_cast<double>(i) / chain_.sweeps()) * (to - from));
  double at_a_glance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < (steps == Steps::some ? few : most); ++i) {
    const Dual now = distance();
    const bool near = now.v <= there * shape_.reach().v;
    if (steps == Steps::glance && i % glance == 0) {
      if (now.v > 0.9 * at_a_glance && !arrived()) return;
      at_a_glance = now.v;
    }
    if (step(target_) < still || near) return;
  }
}

// Sets the joints to other poses within their limits, the same ones in every solve.
void LimitedSolve::start_over(int number) noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    const JointChain::Joint& joint = shape_.joint(i);
    double at[3];
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = drawn((static_cast<std::size_t>(number) * ChainShape::room + i) * 3 + k);
    Arrow by;
    if (const auto* hinge = std::get_if<HingeLimit>(&joint.limit)) {
      by.v = (hinge->low + at[0] * (hinge->high - hinge->low)) * hinge->axis;
      shape_.turn(i, turned_by(joint, {}, by));
    } else if (const auto* cone = std::get_if<ConeLimit>(&joint.limit)) {
      const Vec3 across = any_across(joint.bone), beside = joint.bone.cross(across);
      const elementary::SinCos around = elementary::sin_cos(2 * std::numbers::pi * at[0]);
      const Vec3 twist = (cone->twist_low + at[2] * (cone->twist_high - cone->twist_low)) * joint.bone;
      by.v = (cone->swing * std::sqrt(at[1])) * (around.cos * across + around.sin * beside);
      shape_.turn(i, within_limits(joint, exp_turn(by) * exp_turn({twist, Vec3(0, 0, 0)})));
    }
  }
  shape_.place();
}

void LimitedSolve::glance_from(int number) noexcept {
  start_over(number);
  bend(target_, shape_);
  track(Steps::glance);
}

void LimitedSolve::run() noexcept {
  move_off();
  const bool searches = chain_.leaps() && is_searchable(shape_);
  track(searches ? Steps::some : Steps::all);
  if (!chain_.leaps() || arrived()) return;
  if (searches)
    search_everywhere(target_, shape_);
  else
    search();
}

bool LimitedSolve::go_on(const ChainShape& home, const Dual& share, bool searches) noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    const Turning& turn = shape_.turn(i);
    const Arrow way = log_turn(home.turn(i) * inverse(turn));
    shape_.turn(i, within_limits(shape_.joint(i), exp_turn(share * way) * turn));
  }
  shape_.place();
  bend(target_, shape_);
  const bool descends = chain_.leaps() && is_searchable(shape_);
  track(descends ? Steps::some : Steps::all);
  if (!chain_.leaps() || arrived()) return arrived();
  if (!descends) {
    if (searches) search();
    return arrived();
  }
  // What is nearest to where it is may be at the target but for a hair: no reason to leap.
  constexpr double hair = 1e-6;  // of the chain's length
  descend(target_, shape_);
  if (searches && distance().v > hair * shape_.reach().v) search_from_here(target_, shape_);
  return distance().v <= hair * shape_.reach().v;
}

void LimitedSolve::search() noexcept {
  // What is missed by little may yet be reached from few places; what is missed by more surely is out of reach.
  constexpr int some = 100, many = 400;
  constexpr double little = 0.02, matters = 1e-6;  // of the chain's length
  const double reach = shape_.reach().v;
  ChainShape nearest = shape_;
  double least = distance().v, missed = least;
  // The most promising places for what cannot be reached, the best first.
  constexpr std::size_t few = 8;
  std::pair<double, int> promising[few];
  std::size_t count = 0;
  for (int number = 0; number < (missed < little * reach ? many : some); ++number) {
    glance_from(number);
    // Where the end comes to its farthest, or to its nearest, the last bit takes many steps.
    if (!arrived() && distance().v < 0.1 * little * reach) track(Steps::all);
    if (arrived()) return;
    missed = std::min(missed, distance().v);
    std::pair<double, int> next(distance().v, number);
    for (std::size_t i = 0; i < count; ++i)
      if (next < promising[i]) std::swap(next, promising[i]);
    if (count < few) promising[count++] = next;
  }
  for (std::size_t i = 0; i < count; ++i) {
    glance_from(promising[i].second);
    track(Steps::all);
    if (distance().v > least - matters * reach) continue;
    nearest = shape_;
    least = distance().v;
  }
  shape_ = nearest;
}

}  // namespace

void reach_within_limits(const JointChain& chain, const Arrow& target, ChainShape& shape) noexcept {
  LimitedSolve(chain, target, shape).run();
}

bool follow_within_limits(const JointChain& chain, const Arrow& target, const ChainShape& home, const Dual& share,
                          bool searches, ChainShape& shape) noexcept {
  return LimitedSolve(chain, target, shape).go_on(home, share, searches);
}

}  // namespace tweenfall::chains
