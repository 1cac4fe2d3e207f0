#include <limits>

#include "chains/chain_solve.h"

namespace tweenfall {
namespace chains {
namespace {

class FreeSolve {
 public:
  FreeSolve(const JointChain& chain, const Arrow& target, ChainShape& shape) noexcept
      : chain_(chain), count_(shape.count()), target_(target), shape_(shape) {
    for (std::size_t i = 0; i < count_; ++i) first_[i] = shape.turn(i);
  }

  void run() noexcept;

 private:
  bool stretch() noexcept;
  void untwist() noexcept;
  void reach_forward_and_backward() noexcept;
  void descend() noexcept;
  bool refine() noexcept;
  void close() noexcept;
  void step(double caution) noexcept;
  [[nodiscard]] Dual distance() const noexcept { return length(target_ - shape_.end()); }

  const JointChain& chain_;
  const std::size_t count_;
  const Arrow target_;
  ChainShape& shape_;
  Turning first_[ChainShape::room];  // the turns of the pose
};

// For targets out of reach: all bones along the line to the target or, where that is too near, all but the longest
// backwards. @returns whether the target is out of reach
bool FreeSolve::stretch() noexcept {
  const Measured way = measured(target_ - shape_.at(0));
  std::size_t longest = 0;
  for (std::size_t i = 0; i < count_; ++i)
    if (shape_.length(i).v > shape_.length(longest).v) longest = i;
  const double reach = shape_.reach().v;
  const bool far = way.length.v >= reach, close = way.length.v <= 2 * shape_.length(longest).v - reach;
  if (!far && !close) return false;
  Arrow along = way.unit;
  if (!way.any) {
    const Measured now = measured(shape_.end() - shape_.at(0));
    along = now.any ? now.unit : Arrow{Vec3(0, 1, 0), Vec3(0, 0, 0)};
  }
  for (std::size_t i = 0; i < count_; ++i)
    shape_.aim(i, shape_.at(i + 1) - shape_.at(i), far || i == longest ? along : -along);
  return true;
}

// Keeps the bones where they are, but by the shortest turns from the pose, as `stretch` does: this removes the twist of
// the sweeps, and none appears or vanishes suddenly where the target goes out of reach.
void FreeSolve::untwist() noexcept {
  Arrow bones[ChainShape::room];
  for (std::size_t i = 0; i < count_; ++i) bones[i] = shape_.at(i + 1) - shape_.at(i);
  for (std::size_t i = 0; i < count_; ++i) shape_.turn(i, first_[i]);
  shape_.place();
  for (std::size_t i = 0; i < count_; ++i) shape_.aim(i, shape_.at(i + 1) - shape_.at(i), bones[i]);
}

void FreeSolve::reach_forward_and_backward() noexcept {
  Arrow wanted[ChainShape::room + 1];
  wanted[count_] = target_;
  for (std::size_t i = count_; i-- > 0;) {
    const Measured back = measured(shape_.at(i) - wanted[i + 1]);
    wanted[i] = back.any ? wanted[i + 1] + shape_.length(i) * back.unit : wanted[i + 1];
  }
  for (std::size_t i = 0; i < count_; ++i) {
    // Only this joint; the others follow when it is their turn.
    shape_.turn(i, turned_towards(shape_.joint(i), shape_.turn(i), shape_.inside(i, shape_.bone(i)),
                                  shape_.inside(i, wanted[i + 1] - shape_.at(i))));
    shape_.place_one(i);
  }
}

void FreeSolve::descend() noexcept {
  for (std::size_t i = count_; i-- > 0;) {
    // Only half way: full turns curl the end up, and differ much for targets that differ little.
    const Measured from = measured(shape_.end() - shape_.at(i)), to = measured(target_ - shape_.at(i));
    if (from.any && to.any) shape_.aim(i, from.unit, from.unit + to.unit);
  }
}

// One Levenberg-Marquardt step: of all ways to bring the end nearer, the one that turns the joints least.
// The damping is proportional to the distance, so steps near the target are Newton steps. Source: Fan and
// Yuan, "On the quadratic convergence of the Levenberg-Marquardt method without nonsingularity assumption",
// 2005.
void FreeSolve::step(double caution) noexcept {
  constexpr double damping = 0.1, widest = 0.5;
  const Arrow missing = target_ - shape_.end();
  const Dual damped = Dual(caution * damping) * length(missing) * shape_.reach();
  Arrow columns[ChainShape::room][3];
  Arrow a[3];
  for (int row = 0; row < 3; ++row) {
    a[row].v[row] = damped.v;
    a[row].d[row] = damped.d;
  }
  const auto axis = [](int k) { return Arrow{Vec3::Unit(k), Vec3(0, 0, 0)}; };
  for (std::size_t i = 0; i < count_; ++i) {
    const Arrow arm = shape_.inside(i, shape_.end() - shape_.at(i));
    for (int k = 0; k < 3; ++k) {
      const Arrow& column = columns[i][k] = shape_.outside(i, cross(axis(k), arm));
      for (int row = 0; row < 3; ++row) a[row] = a[row] + Dual(column.v[row], column.d[row]) * column;
    }
  }
  const Arrow pull = solved(a, missing);
  Dual largest(widest);
  for (std::size_t i = 0; i < count_; ++i)
    for (int k = 0; k < 3; ++k) {
      const Dual turning = dot(columns[i][k], pull);
      if (std::abs(turning.v) > largest.v) largest = turning.v < 0 ? -turning : turning;
    }
  const Dual share = Dual(widest) / largest;
  for (std::size_t i = 0; i < count_; ++i) {
    Arrow by;
    for (int k = 0; k < 3; ++k) by = by + (share * dot(columns[i][k], pull)) * axis(k);
    shape_.turn(i, turned_by(shape_.joint(i), shape_.turn(i), by));
  }
  shape_.place();
}

// @returns whether the end is at the target
bool FreeSolve::refine() noexcept {
  constexpr double there = 1e-13;  // of the chain's length
  const double reach = shape_.reach().v;
  // For targets far out of reach a step may lead away: then it is repeated with more damping.
  double caution = 1;
  Dual missing = distance();
  int idle = 0;  // steps that changed almost nothing
  for (int i = 0; i < 120; ++i) {
    const bool near = missing.v <= there * reach;
    Turning before[ChainShape::room];
    for (std::size_t k = 0; k < count_; ++k) before[k] = shape_.turn(k);
    step(caution);
    if (near) return true;
    const Dual now = distance();
    if (now.v > missing.v) {
      for (std::size_t k = 0; k < count_; ++k) shape_.turn(k, before[k]);
      shape_.place();
      caution *= 4;
      if (caution > 1e12) break;
      continue;
    }
    idle = missing.v - now.v < 1e-12 * reach && now.v > 1e-6 * reach ? idle + 1 : 0;
    missing = now;
    caution = std::max(1.0, caution / 2);
    if (idle == 4) return false;
  }
  return missing.v <= 1e-9 * reach;
}

// Where bones lie nearly on one line, steps lead on ever less. Then one joint turns until the end is as far from the
// start as the target is, by the law of cosines, and the whole toward the target: of all joints that can, the one that
// turns least.
void FreeSolve::close() noexcept {
  const Measured way = measured(target_ - shape_.at(0));
  if (!way.any) return;
  double least = std::numeric_limits<double>::infinity();
  std::size_t joint = 0;
  Arrow aimed;
  for (std::size_t i = 1; i < count_; ++i) {
    const Measured inner = measured(shape_.at(i) - shape_.at(0)), outer = measured(shape_.end() - shape_.at(i));
    if (!inner.any || !outer.any) continue;
    const Dual &a = inner.length, &b = outer.length, &d = way.length, ab = Dual(2) * a * b;
    // One plus and one minus the cosine of the angle between both.
    const Dual more = (d - a + b) * (d + a - b) / ab, less = (a + b - d) * (a + b + d) / ab;
    if (!(more.v > 0) || !(less.v > 0)) continue;
    Measured aside = measured(across(outer.unit, inner.unit));
    if (!aside.any) aside.unit = Arrow{any_across(inner.unit.v), Vec3(0, 0, 0)};
    const Arrow to = (more - Dual(1)) * inner.unit + root(more * less) * aside.unit;
    const double turn = (to.v - outer.unit.v).norm();
    if (!(turn < least)) continue;
    least = turn;
    joint = i;
    aimed = to;
  }
  if (joint == 0) return;
  shape_.aim(joint, shape_.end() - shape_.at(joint), aimed);
  shape_.aim(0, shape_.end() - shape_.at(0), target_ - shape_.at(0));
}

void FreeSolve::run() noexcept {
  if (stretch()) return;
  bend(target_, shape_);
  for (int i = 0; i < chain_.sweeps(); ++i)
    if (chain_.method() == ChainMethod::fabrik)
      reach_forward_and_backward();
    else
      descend();
  // What it leaves over is shared by all joints: the steps after it begin near the target.
  if (chain_.method() == ChainMethod::ccd)
    for (int i = 0; i < 8; ++i) reach_forward_and_backward();
  // Long chains that have to turn over need several attempts, and reaching forward and backward uncurls them.
  bool there = refine();
  for (int more = 0; !there && more < 8; ++more) {
    for (int i = 0; i < 8; ++i) reach_forward_and_backward();
    there = refine();
  }
  if (!there) close();
  untwist();
}

}  // namespace

void bend(const Arrow& target, ChainShape& shape) noexcept {
  const Arrow missing = target - shape.end();
  const Dual square = dot(missing, missing), share = square / (square + shape.reach() * shape.reach());
  for (std::size_t i = 0; i < shape.count(); ++i) {
    Vec3 axis = any_across(shape.joint(i).bone);
    if (const auto* hinge = std::get_if<HingeLimit>(&shape.joint(i).limit))
      axis = (hinge->low + hinge->high < 0 ? -1 : 1) * hinge->axis;
    shape.turn(i, turned_by(shape.joint(i), shape.turn(i), (Dual(0.02) * share) * Arrow{axis, Vec3(0, 0, 0)}));
  }
  shape.place();
}

Arrow solved(const Arrow (&a)[3], const Arrow& b) noexcept {
  const Arrow c = cross(a[1], a[2]);
  const Dual volume = dot(a[0], c);
  if (!(std::abs(volume.v) > 0)) return {};
  const Dual x = dot(c, b), y = dot(cross(a[2], a[0]), b), z = dot(cross(a[0], a[1]), b);
  const Dual all[3] = {x / volume, y / volume, z / volume};
  return {{all[0].v, all[1].v, all[2].v}, {all[0].d, all[1].d, all[2].d}};
}

void reach_freely(const JointChain& chain, const Arrow& target, ChainShape& shape) noexcept {
  FreeSolve(chain, target, shape).run();
}

}  // namespace chains

void reach(const JointChain& chain, const Sample<Vec3>& target, const Sample<double>& weight,
           std::span<Motion> pose) noexcept {
  using namespace chains;
  if (is_nothing(weight)) return;
  const WorldMotion parent = above(chain.nodes(), chain.joints().front().node, pose);
  const Inward inward(parent);
  if (inward.flat()) return;
  ChainShape shape(chain, pose);
  if (shape.reach().v > 0)
    (chain.limited() ? reach_within_limits : reach_freely)(chain, inward.point(arrow(target)), shape);
  for (std::size_t i = 0; i < chain.joints().size(); ++i) turn_to(pose[chain.joints()[i].node], shape.local(i), weight);
}

}  // namespace tweenfall
