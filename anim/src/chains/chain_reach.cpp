#include "chains/joint_limits.h"

namespace tweenfall {
namespace chains {
namespace {

constexpr std::size_t room = JointChain::most_joints;

// A chain in one pose, as it is turned: in the space of the first joint's parent.
class Solve {
 public:
  Solve(const JointChain& chain, std::span<const Motion> pose, const Arrow& target) noexcept;

  void run() noexcept;
  /// The rotation of a joint, in the axes of its parent.
  [[nodiscard]] Turning local(std::size_t i) const noexcept { return fixed_[i] * turn_[i]; }

 private:
  [[nodiscard]] const JointChain::Joint& joint(std::size_t i) const noexcept { return chain_.joints()[i]; }
  void place(std::size_t from) noexcept;
  void set(std::size_t i, const Turning& turn) noexcept {
    turn_[i] = turn;
    place(i);
  }
  /// A direction of the space in which all stand, in the axes in which the joint's turn is told.
  [[nodiscard]] Arrow inside(std::size_t i, const Arrow& a) const noexcept { return inverse(outer_[i]) * a; }
  void aim(std::size_t i, const Arrow& from, const Arrow& to) noexcept {
    set(i, turned_towards(joint(i), turn_[i], inside(i, from), inside(i, to)));
  }

  bool stretch() noexcept;
  void untwist() noexcept;
  void bend() noexcept;
  void reach_forward_and_backward() noexcept;
  void descend() noexcept;
  void sweep() noexcept;
  bool refine(int steps) noexcept;
  void step(double caution) noexcept;
  [[nodiscard]] Dual distance() const noexcept { return length(target_ - at_[count_]); }
  bool attempt(int steps) noexcept;
  void start_over(int number) noexcept;

  const JointChain& chain_;
  const std::size_t count_;
  Arrow target_;
  Dual reach_;
  Arrow bone_[room];  // to the next joint, in the joint's own axes, at its size
  Dual length_[room];
  Turning between_[room];            // from the own axes of the joint before to those of the parent
  Turning fixed_[room];              // rest rotation
  Turning first_[room];              // the turns that the pose has
  Turning turn_[room];               // from rest, in the axes of the rest pose
  Turning outer_[room], own_[room];  // of the rest pose and of the joint, in the space in which all stand
  Arrow at_[room + 1];               // joints and the end
};

Solve::Solve(const JointChain& chain, std::span<const Motion> pose, const Arrow& target) noexcept
    : chain_(chain), count_(chain.joints().size()), target_(target) {
  const Hierarchy& nodes = chain.nodes();
  Arrow scale{Vec3(1, 1, 1), Vec3(0, 0, 0)};
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t node = joint(i).node, next = i + 1 < count_ ? joint(i + 1).node : chain.end();
    scale = componentwise(scale, scale_of(pose[node]));
    bone_[i] = componentwise(scale, position_of(seen_from(nodes, node, next, pose)));
    length_[i] = length(bone_[i]);
    reach_ = reach_ + length_[i];
    fixed_[i].v = joint(i).rest;
    if (i + 1 < count_ && nodes[next].parent != node) {
      const Motion carrier = seen_from(nodes, node, nodes[next].parent, pose);
      between_[i + 1] = rotation_of(carrier);
      scale = componentwise(scale, scale_of(carrier));
    }
    turn_[i] = first_[i] = within_limits(joint(i), inverse(fixed_[i]) * rotation_of(pose[node]));
  }
  at_[0] = position_of(pose[joint(0).node]);
  place(0);
}

void Solve::place(std::size_t from) noexcept {
  for (std::size_t i = from; i < count_; ++i) {
    outer_[i] = (i == 0 ? between_[0] : own_[i - 1] * between_[i]) * fixed_[i];
    own_[i] = outer_[i] * turn_[i];
    at_[i + 1] = at_[i] + own_[i] * bone_[i];
  }
}

// What no bending reaches: all bones along the line to the target, and where it is too near, all but the longest
// backwards. @returns whether it was so
bool Solve::stretch() noexcept {
  const Measured way = measured(target_ - at_[0]);
  std::size_t longest = 0;
  for (std::size_t i = 0; i < count_; ++i)
    if (length_[i].v > length_[longest].v) longest = i;
  const bool far = way.length.v >= reach_.v, close = way.length.v <= 2 * length_[longest].v - reach_.v;
  if (!far && !close) return false;
  Arrow along = way.unit;
  if (!way.any) {
    const Measured now = measured(at_[count_] - at_[0]);
    along = now.any ? now.unit : Arrow{Vec3(0, 1, 0), Vec3(0, 0, 0)};
  }
  for (std::size_t i = 0; i < count_; ++i) aim(i, at_[i + 1] - at_[i], far || i == longest ? along : -along);
  return true;
}

// Bones where they are, but by the shortest turns from the pose, as a stretch turns them: no twist is left that came on
// the way, and none comes or goes at once where the target leaves what can be reached.
void Solve::untwist() noexcept {
  Arrow bones[room];
  for (std::size_t i = 0; i < count_; ++i) bones[i] = at_[i + 1] - at_[i];
  std::copy(first_, first_ + count_, turn_);
  place(0);
  for (std::size_t i = 0; i < count_; ++i) aim(i, at_[i + 1] - at_[i], bones[i]);
}

// Bends every joint a little, the more the farther the target is from the end: a chain that lies straight on the line
// to its target has nowhere else to begin.
void Solve::bend() noexcept {
  const Arrow missing = target_ - at_[count_];
  const Dual square = dot(missing, missing), share = square / (square + reach_ * reach_);
  for (std::size_t i = 0; i < count_; ++i) {
    Vec3 axis = any_across(joint(i).bone);
    if (const auto* hinge = std::get_if<HingeLimit>(&joint(i).limit))
      axis = (hinge->low + hinge->high < 0 ? -1 : 1) * hinge->axis;
    turn_[i] = turned_by(joint(i), turn_[i], (Dual(0.02) * share) * Arrow{axis, Vec3(0, 0, 0)});
  }
  place(0);
}

void Solve::reach_forward_and_backward() noexcept {
  Arrow wanted[room + 1];
  wanted[count_] = target_;
  for (std::size_t i = count_; i-- > 0;) {
    const Measured back = measured(at_[i] - wanted[i + 1]);
    wanted[i] = back.any ? wanted[i + 1] + length_[i] * back.unit : wanted[i + 1];
  }
  for (std::size_t i = 0; i < count_; ++i) {
    // The joint alone; the others follow when their turn comes.
    const Arrow bone = own_[i] * bone_[i];
    turn_[i] = turned_towards(joint(i), turn_[i], inside(i, bone), inside(i, wanted[i + 1] - at_[i]));
    own_[i] = outer_[i] * turn_[i];
    at_[i + 1] = at_[i] + own_[i] * bone_[i];
    if (i + 1 < count_) {
      outer_[i + 1] = own_[i] * between_[i + 1] * fixed_[i + 1];
      own_[i + 1] = outer_[i + 1] * turn_[i + 1];
    }
  }
}

void Solve::descend() noexcept {
  for (std::size_t i = count_; i-- > 0;) {
    // Half way only: whole turns curl the end up, and differ much for targets that differ little.
    const Measured from = measured(at_[count_] - at_[i]), to = measured(target_ - at_[i]);
    if (from.any && to.any) aim(i, from.unit, from.unit + to.unit);
  }
}

void Solve::sweep() noexcept {
  for (int i = 0; i < chain_.sweeps(); ++i)
    if (chain_.method() == ChainMethod::fabrik)
      reach_forward_and_backward();
    else
      descend();
}

// Solves the symmetric a x = b by cofactors.
Arrow solved(const Arrow (&a)[3], const Arrow& b) noexcept {
  const Arrow c = cross(a[1], a[2]);
  const Dual volume = dot(a[0], c);
  if (!(std::abs(volume.v) > 0)) return {};
  const Dual x = dot(c, b), y = dot(cross(a[2], a[0]), b), z = dot(cross(a[0], a[1]), b);
  const Dual all[3] = {x / volume, y / volume, z / volume};
  return {{all[0].v, all[1].v, all[2].v}, {all[0].d, all[1].d, all[2].d}};
}

// One step of Levenberg and Marquardt: of all ways to turn that bring the end nearer, the one with the least turning.
// The damping goes with the distance, so that steps near the target are Newton's.
// Source: Fan and Yuan, "On the quadratic convergence of the Levenberg-Marquardt method without nonsingularity
// assumption", 2005.
void Solve::step(double caution) noexcept {
  constexpr double damping = 0.1, widest = 0.5;
  const Arrow missing = target_ - at_[count_];
  const Dual damped = Dual(caution * damping) * length(missing) * reach_;
  Arrow columns[room][3];
  Freedom freedom[room];
  bool held[room][3] = {};
  for (std::size_t i = 0; i < count_; ++i) {
    freedom[i] = freedom_of(joint(i), turn_[i]);
    const Arrow arm = inside(i, at_[count_] - at_[i]);
    for (int k = 0; k < freedom[i].count; ++k) columns[i][k] = outer_[i] * cross(freedom[i].ways[k].axis, arm);
  }
  Arrow pull;
  for (bool changed = true; changed;) {
    changed = false;
    Arrow a[3];
    for (int row = 0; row < 3; ++row) {
      a[row].v[row] = damped.v;
      a[row].d[row] = damped.d;
    }
    for (std::size_t i = 0; i < count_; ++i)
      for (int k = 0; k < freedom[i].count; ++k)
        if (!held[i][k])
          for (int row = 0; row < 3; ++row)
            a[row] = a[row] + Dual(columns[i][k].v[row], columns[i][k].d[row]) * columns[i][k];
    pull = solved(a, missing);
    for (std::size_t i = 0; i < count_; ++i)
      for (int k = 0; k < freedom[i].count; ++k) {
        const double turning = columns[i][k].v.dot(pull.v);
        const Freedom::Way& way = freedom[i].ways[k];
        if (held[i][k] || !((way.at_low && turning < 0) || (way.at_high && turning > 0))) continue;
        held[i][k] = changed = true;
      }
  }
  Dual largest(widest);
  for (std::size_t i = 0; i < count_; ++i)
    for (int k = 0; k < freedom[i].count; ++k) {
      const Dual turning = dot(columns[i][k], pull);
      if (!held[i][k] && std::abs(turning.v) > largest.v) largest = turning.v < 0 ? -turning : turning;
    }
  const Dual share = Dual(widest) / largest;
  for (std::size_t i = 0; i < count_; ++i) {
    Arrow by;
    for (int k = 0; k < freedom[i].count; ++k)
      if (!held[i][k]) by = by + (share * dot(columns[i][k], pull)) * freedom[i].ways[k].axis;
    turn_[i] = turned_by(joint(i), turn_[i], by);
  }
  place(0);
}

// @returns whether the end is at the target
bool Solve::refine(int steps) noexcept {
  constexpr double there = 1e-13;  // of the chain's length
  // Far from what can be reached a step may lead away: then it is taken anew with more damping.
  double caution = 1;
  Dual missing = distance();
  int idle = 0;  // steps that did next to nothing
  for (int i = 0; i < steps; ++i) {
    const bool near = missing.v <= there * reach_.v;
    Turning before[room];
    std::copy(turn_, turn_ + count_, before);
    step(caution);
    if (near) return true;
    const Dual now = distance();
    if (now.v > missing.v) {
      std::copy(before, before + count_, turn_);
      place(0);
      caution *= 4;
      if (caution > 1e12) break;
      continue;
    }
    idle = missing.v - now.v < 1e-12 * reach_.v && now.v > 1e-6 * reach_.v ? idle + 1 : 0;
    missing = now;
    caution = std::max(1.0, caution / 2);
    if (idle == 4) return false;
  }
  return missing.v <= 1e-9 * reach_.v;
}

bool Solve::attempt(int steps) noexcept {
  bend();
  sweep();
  return refine(steps);
}

// Joints at other places within their limits, the same for every solve, where they did not get on from the pose's own.
void Solve::start_over(int number) noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    // Even spread over the ranges. Source: Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
    constexpr double steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    double at[3];
    for (int k = 0; k < 3; ++k) {
      const double place = 0.5 + steps[k] * (number * 7 + static_cast<double>(i) * 3);
      at[k] = place - std::floor(place);
    }
    Arrow by;
    if (const auto* hinge = std::get_if<HingeLimit>(&joint(i).limit)) {
      by.v = (hinge->low + at[0] * (hinge->high - hinge->low)) * hinge->axis;
      turn_[i] = turned_by(joint(i), {}, by);
    } else if (const auto* cone = std::get_if<ConeLimit>(&joint(i).limit)) {
      const Vec3 across = any_across(joint(i).bone), beside = joint(i).bone.cross(across);
      const elementary::SinCos around = elementary::sin_cos(2 * std::numbers::pi * at[0]);
      const Vec3 twist = (cone->twist_low + at[2] * (cone->twist_high - cone->twist_low)) * joint(i).bone;
      by.v = (cone->swing * std::sqrt(at[1])) * (around.cos * across + around.sin * beside);
      turn_[i] = within_limits(joint(i), exp_turn(by) * exp_turn({twist, Vec3(0, 0, 0)}));
    }
  }
  place(0);
}

void Solve::run() noexcept {
  constexpr int many = 120;
  if (!(reach_.v > 0)) return;
  if (!chain_.limited()) {
    if (stretch()) return;
    // Long chains that have to turn over need more than one go, and reaching forward and backward uncurls them.
    bool there = attempt(many);
    for (int more = 0; !there && more < 8; ++more) {
      for (int i = 0; i < 8; ++i) reach_forward_and_backward();
      there = refine(many);
    }
    untwist();
    return;
  }
  if (attempt(many)) return;
  if (length(target_ - at_[0]).v > reach_.v) return;
  Turning best[room];
  std::copy(turn_, turn_ + count_, best);
  constexpr int more = 12, few = 30;  // what can be reached from there is reached soon
  for (int number = 0; number < more; ++number) {
    start_over(number);
    if (attempt(few)) return;
  }
  std::copy(best, best + count_, turn_);
  place(0);
}

}  // namespace
}  // namespace chains

void reach(const JointChain& chain, const Sample<Vec3>& target, const Sample<double>& weight,
           std::span<Motion> pose) noexcept {
  using namespace chains;
  if (is_nothing(weight)) return;
  const Inward inward(above(chain.nodes(), chain.joints().front().node, pose));
  if (inward.flat()) return;
  Solve solve(chain, pose, inward.point(arrow(target)));
  solve.run();
  for (std::size_t i = 0; i < chain.joints().size(); ++i) turn_to(pose[chain.joints()[i].node], solve.local(i), weight);
}

}  // namespace tweenfall
