#include <tweenfall/anim/two_bone.h>

#include "chains/moving.h"
#include "chains/problems.h"

namespace tweenfall {
namespace chains {
namespace {

constexpr double nothing = 1e-14;  // of the chain's length

struct TwoBones {
  Arrow first, second;  // in the space of the start
  Turning carried;      // from the space in which the middle turns to that of the start
};

TwoBones two_bones(const TwoBoneChain& chain, std::span<const Motion> pose) noexcept {
  const Hierarchy& nodes = chain.nodes();
  const Motion &start = pose[chain.start()], &middle = pose[chain.middle()];
  const Arrow end = nodes[chain.end()].parent == chain.middle()
                        ? position_of(pose[chain.end()])
                        : position_of(seen_from(nodes, chain.middle(), chain.end(), pose));
  const Arrow scale = scale_of(start);
  TwoBones bones;
  if (nodes[chain.middle()].parent == chain.start()) {
    bones.first = componentwise(scale, position_of(middle));
    bones.second = componentwise(scale, Turned(middle) * componentwise(scale_of(middle), end));
    return bones;
  }
  const Motion carrier = seen_from(nodes, chain.start(), nodes[chain.middle()].parent, pose);
  const Motion carried = compose(carrier, middle);
  bones.carried = rotation_of(carrier);
  bones.first = componentwise(scale, position_of(carried));
  bones.second = componentwise(scale, Turned(carried) * componentwise(scale_of(carried), end));
  return bones;
}

// How far the end is to be from the start, d being the distance of the target.
Dual softened(const Dual& d, const Dual& reach, double softness) noexcept {
  const double share = std::clamp(softness, 0.0, 0.5);
  const Dual width = Dual(share) * reach, from = reach - width;
  if (!(width.v > 0) || d.v <= from.v) return d;
  return from + width * (Dual(1) - exponential((from - d) / width));
}

// Where the middle goes, across the line to the target: `side`, and `normal`, about which it bends.
struct Plane {
  Arrow side, normal;
};

// The pose's own, given by the axis about which it bends.
Plane own_plane(const Arrow& along, const Turned& turn, const Arrow& hinge, const Arrow& first) noexcept {
  const Measured normal = measured(across(turn * hinge, along));
  if (normal.length.v > 1e-9) return {cross(along, normal.unit), normal.unit};
  const Measured beside = measured(across(turn * first, along));
  const Arrow side = beside.length.v > 1e-9 ? beside.unit : Arrow{any_across(along.v), Vec3(0, 0, 0)};
  return {side, cross(side, along)};
}

// The pole's. Where the pole is nearly along the chain, it turns over from the pose's own: without a flip where the
// pole goes through the line.
Plane pole_plane(const Arrow& pole, const Arrow& along, const Turned& turn, const Arrow& hinge,
                 const Arrow& first) noexcept {
  constexpr double blend = 0.02;
  const double size = pole.v.squaredNorm();
  const Measured beside = measured(across(pole, along));
  if (beside.any && beside.length.v * beside.length.v >= blend * blend * size)
    return {beside.unit, cross(beside.unit, along)};
  const Plane own = own_plane(along, turn, hinge, first);
  if (!beside.any) return own;
  const Dual share = smooth_step(beside.length / (Dual(blend) * length(pole)));
  const Dual angle = share * angle_of(-dot(own.normal, beside.unit), dot(own.side, beside.unit));
  const elementary::SinCos sin_cos = elementary::sin_cos(angle.v);
  const Dual cosine(sin_cos.cos, -sin_cos.sin * angle.d), sine(sin_cos.sin, sin_cos.cos * angle.d);
  const Arrow side = cosine * own.side - sine * own.normal;
  return {side, cross(side, along)};
}

}  // namespace
}  // namespace chains

TwoBoneChain::TwoBoneChain(const Hierarchy& nodes, const TwoBoneSettings& settings) : nodes_(nodes) {
  chains::Problems problems("two-bone chain");
  start_ = problems.node(nodes, settings.start, "start");
  middle_ = problems.node(nodes, settings.middle, "middle");
  end_ = problems.node(nodes, settings.end, "end");
  if (start_ != no_node && middle_ != no_node)
    problems.require(chains::is_below(nodes, middle_, start_),
                     "middle (" + settings.middle.text() + ") must be below start (" + settings.start.text() + ")");
  if (middle_ != no_node && end_ != no_node)
    problems.require(chains::is_below(nodes, end_, middle_),
                     "end (" + settings.end.text() + ") must be below middle (" + settings.middle.text() + ")");
  if (settings.axis) problems.require_finite(*settings.axis, "axis");
  problems.report();

  std::vector<Motion> rest(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) rest[i].pose = nodes[i].rest;
  const chains::TwoBones bones = chains::two_bones(*this, rest);
  const Vec3 &first = bones.first.v, &second = bones.second.v;
  const Vec3 axis = settings.axis ? *settings.axis : Vec3(first.cross(second));
  const double size = std::sqrt(axis.squaredNorm());
  const double bone = std::sqrt(first.squaredNorm()), lengths = bone * std::sqrt(second.squaredNorm());
  if (settings.axis) {
    problems.require(size > 0, "axis is zero");
    problems.require(bone == 0 || std::sqrt(axis.cross(first).squaredNorm()) > 1e-6 * size * bone,
                     "axis is along the bone from start to middle; it must be across it");
  } else {
    problems.require(size > 1e-6 * lengths && size > 0,
                     "it is straight at rest, so that which way it bends must be told: give axis, about which the "
                     "middle turns when it bends, in the space of the start");
  }
  problems.report();
  axis_ = axis / size;
}

void reach(const TwoBoneChain& chain, const TwoBoneGoal& goal, const Sample<double>& weight,
           std::span<Motion> pose) noexcept {
  if (chains::is_nothing(weight)) return;
  reach(chain, goal, weight, chains::above(chain.nodes(), chain.start(), pose), pose);
}

void reach(const TwoBoneChain& chain, const TwoBoneGoal& goal, const Sample<double>& weight, const WorldMotion& parent,
           std::span<Motion> pose) noexcept {
  using namespace chains;
  if (is_nothing(weight)) return;
  const Inward inward(parent);
  if (inward.flat()) return;
  Motion& start = pose[chain.start()];
  Motion& middle = pose[chain.middle()];
  const Turned turn(start);
  const TwoBones bones = two_bones(chain, pose);
  const Measured first_bone = measured(bones.first), second_bone = measured(bones.second);
  const Dual &a = first_bone.length, &b = second_bone.length, reach = a + b;
  if (!(reach.v > 0)) return;

  const Measured way = measured(inward.point(arrow(goal.target)) - position_of(start));
  const Dual& d = way.length;
  Arrow along = way.unit;
  if (d.v <= nothing * reach.v) {
    const Measured unturned = measured(bones.first + bones.second);
    along = turn * (unturned.length.v > nothing * reach.v ? unturned.unit
                    : first_bone.any                      ? first_bone.unit
                                                          : second_bone.unit);
  }

  if (a.v <= nothing * reach.v || b.v <= nothing * reach.v) {
    const Arrow from = turn * unit(bones.first + bones.second);
    turn_to(start, arc(from, along, any_across(from.v)) * rotation_of(start), weight);
    return;
  }

  // The triangle of the two bones and the line to the target, by Heron's formula.
  const Dual least = a.v >= b.v ? a - b : b - a;
  Dual distance = softened(d, reach, goal.softness);
  Dual area;  // four times
  if (distance.v >= reach.v)
    distance = reach;
  else if (distance.v <= least.v)
    distance = least;
  else
    area = root((reach - distance) * (reach + distance) * (distance - least) * (distance + least));
  const Dual square = distance * distance;
  Dual cosine(0), sine(1);  // of the angle at the start
  if (distance.v > nothing * reach.v) {
    const Dual inverse = Dual(0.5) / (a * distance);
    cosine = (square + (a - b) * reach) * inverse;
    sine = area * inverse;
  }
  const Dual inverse = Dual(0.5) / (a * b);
  const Dual bend_cosine = (square - a * a - b * b) * inverse, bend_sine = area * inverse;

  const Arrow& first = first_bone.unit;
  Measured hinge = measured(across({chain.axis(), Vec3(0, 0, 0)}, first));
  if (!(hinge.length.v > 1e-9)) hinge.unit = {any_across(first.v), Vec3(0, 0, 0)};
  const Axes old = axes(first, hinge.unit);
  const Turning at_middle = arc(second_bone.unit, bend_cosine * first - bend_sine * old.z, hinge.unit.v);

  const Plane plane = goal.pole ? pole_plane(inward.direction(arrow(*goal.pole)), along, turn, hinge.unit, first)
                                : own_plane(along, turn, hinge.unit, first);
  turn_to(start, between(old, axes(cosine * along + sine * plane.side, plane.normal)), weight);
  if (chain.nodes()[chain.middle()].parent == chain.start())
    turn_to(middle, at_middle * rotation_of(middle), weight);
  else
    turn_to(middle, chains::inverse(bones.carried) * at_middle * bones.carried * rotation_of(middle), weight);
}

}  // namespace tweenfall
