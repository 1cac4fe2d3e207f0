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
  const Motion carrier = nodes[chain.middle()].parent == chain.start()
                             ? Motion{}
                             : seen_from(nodes, chain.start(), nodes[chain.middle()].parent, pose);
  const Motion middle = compose(carrier, pose[chain.middle()]),
               end = seen_from(nodes, chain.middle(), chain.end(), pose);
  const Arrow scale = scale_of(pose[chain.start()]);
  TwoBones bones;
  bones.carried = rotation_of(carrier);
  bones.first = componentwise(scale, position_of(middle));
  bones.second = componentwise(scale, rotation_of(middle) * componentwise(scale_of(middle), position_of(end)));
  return bones;
}

// How far the end is to be from the start, d being the distance of the target.
Dual softened(const Dual& d, const Dual& reach, double softness) noexcept {
  const double share = std::clamp(softness, 0.0, 0.5);
  const Dual width = Dual(share) * reach, from = reach - width;
  // Of less nothing is seen, and nothing could be as fast.
  if (!(share > 1e-9) || !(width.v > 0) || d.v <= from.v) return d;
  return from + width * (Dual(1) - exponential((from - d) / width));
}

// Where the middle goes, across the line to the target: `side`, and `normal`, about which it bends.
struct Plane {
  Arrow side, normal;
};

// The pose's own, given by the axis about which it bends.
template <class Vector>
Plane own_plane(const Arrow& along, const Turned& turn, const Axes<Vector>& bone) noexcept {
  const Measured normal = measured(across(turn * bone.y, along));
  if (normal.length.v > 1e-9) return {cross(along, normal.unit), normal.unit};
  const Measured beside = measured(across(turn * bone.x, along));
  const Arrow side = beside.length.v > 1e-9 ? beside.unit : Arrow{any_across(along.v), Vec3(0, 0, 0)};
  return {side, cross(side, along)};
}

// The pole's. Where the pole is nearly along the chain, it turns over from the pose's own: without a flip where the
// pole goes through the line.
template <class Vector>
Plane pole_plane(const Arrow& pole, const Arrow& along, const Turned& turn, const Axes<Vector>& bone) noexcept {
  constexpr double blend = 0.02;
  const double size = pole.v.squaredNorm();
  const Measured beside = measured(across(pole, along));
  if (beside.any && beside.length.v * beside.length.v >= blend * blend * size)
    return {beside.unit, cross(beside.unit, along)};
  const Plane own = own_plane(along, turn, bone);
  if (!beside.any) return own;
  const Dual share = smooth_step(beside.length / (Dual(blend) * length(pole)));
  const Dual angle = share * angle_of(-dot(own.normal, beside.unit), dot(own.side, beside.unit));
  const elementary::SinCos sin_cos = elementary::sin_cos(angle.v);
  const Dual cosine(sin_cos.cos, -sin_cos.sin * angle.d), sine(sin_cos.sin, sin_cos.cos * angle.d);
  const Arrow side = cosine * own.side - sine * own.normal;
  return {side, cross(side, along)};
}

// The two turns that a solve is about.
struct Bend {
  Turning start;   // the whole rotation of the start
  Turning middle;  // what comes to the middle's, in the space of the start
};

// The solve proper, for bones that change their lengths or, in a third less time, do not.
// @param bone         axes of the first bone: along it, that about which the middle bends, and the third
// @param a, b         lengths of the bones
// @param second       the second's direction
// @param along, d     direction and distance of the target from the start
template <class Vector, class Number>
Bend bent(const Axes<Vector>& bone, const Number& a, const Number& b, const Arrow& second, const Arrow& along,
          const Dual& d, const Turned& turn, const Inward& inward, const TwoBoneGoal& goal) noexcept {
  // The triangle of the two bones and the line to the target, by Heron's formula. Cosines are told by how far they are
  // from where the chain is folded or stretched: else bones of very unequal lengths would lose which of them it is.
  const bool first_longer = Dual(a).v >= Dual(b).v;
  const Dual reach = a + b, least = first_longer ? a - b : b - a;
  const Dual distance = softened(d, reach, goal.softness);
  Dual cosine(first_longer ? 1 : -1), sine(0);  // of the angle at the start
  Dual bend_cosine(-1), bend_sine(0);
  if (distance.v >= reach.v) {
    cosine = bend_cosine = Dual(1);
  } else if (distance.v > least.v) {
    const Dual left = reach - distance, over = distance - least, both = reach + distance;
    const Dual folded = over * (distance + least), area = root(left * both * folded);  // four times
    const Dual inverse = Dual(0.5) / (distance * a);
    const Number inverse_of_bones = 0.5 / (a * b);
    cosine = first_longer ? Dual(1) - left * over * inverse : over * both * inverse - Dual(1);
    sine = area * inverse;
    bend_cosine = folded * inverse_of_bones - Dual(1);
    bend_sine = area * inverse_of_bones;
  }
  if (distance.v <= nothing * reach.v && least.v <= nothing * reach.v) {
    cosine = Dual(0);  // folded onto the start, to the side
    sine = Dual(1);
  }

  const Plane plane =
      goal.pole ? pole_plane(inward.direction(arrow(*goal.pole)), along, turn, bone) : own_plane(along, turn, bone);
  return {between(bone, axes(cosine * along + sine * plane.side, plane.normal)),
          arc(second, bend_cosine * bone.x - bend_sine * bone.z, place_of(bone.y))};
}

// The axis about which the middle bends, across the first bone.
Arrow hinge_of(const TwoBoneChain& chain, const Arrow& first) noexcept {
  const Measured hinge = measured(across({chain.axis(), Vec3(0, 0, 0)}, first));
  return hinge.length.v > 1e-9 ? hinge.unit : Arrow{any_across(first.v), Vec3(0, 0, 0)};
}

// Whether nothing but rotations moves in a chain of three nodes, of which none stretches unevenly.
bool is_stiff(const TwoBoneChain& chain, const Motion& start, const Motion& middle, const Motion& end) noexcept {
  const auto still = [](const Vec3& v) { return v.x() == 0 && v.y() == 0 && v.z() == 0; };
  const Vec3& scale = start.pose.scale;
  return chain.nodes()[chain.middle()].parent == chain.start() && chain.nodes()[chain.end()].parent == chain.middle() &&
         scale.x() == scale.y() && scale.y() == scale.z() && scale.x() > 0 && still(start.scale_rate) &&
         still(middle.scale_rate) && still(middle.twist.linear) && still(end.twist.linear);
}

}  // namespace
}  // namespace chains

TwoBoneChain::TwoBoneChain(const Hierarchy& nodes, const TwoBoneSettings& settings) : nodes_(nodes) {
  chains::Problems problems("two-bone chain");
  start_ = problems.node(nodes, settings.start, "start");
  middle_ = problems.node(nodes, settings.middle, "middle");
  end_ = problems.node(nodes, settings.end, "end");
  if (start_ != no_node && middle_ != no_node)
    problems.require(chains::is_below(nodes, middle_, start_), "middle (" + chains::called(nodes, settings.middle) +
                                                                   ") must be below start (" +
                                                                   chains::called(nodes, settings.start) + ")");
  if (middle_ != no_node && end_ != no_node)
    problems.require(chains::is_below(nodes, end_, middle_), "end (" + chains::called(nodes, settings.end) +
                                                                 ") must be below middle (" +
                                                                 chains::called(nodes, settings.middle) + ")");
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
  Motion &start = pose[chain.start()], &middle = pose[chain.middle()];
  const Motion& end = pose[chain.end()];
  const Turned turn(start);
  const Measured way = measured(inward.point(arrow(goal.target)) - position_of(start));

  if (is_stiff(chain, start, middle, end)) {
    const Vec3 first = start.pose.scale.x() * middle.pose.position,
               second = start.pose.scale.x() * middle.pose.scale.cwiseProduct(end.pose.position);
    const double a = std::sqrt(first.squaredNorm()), b = std::sqrt(second.squaredNorm());
    const Vec3 along = (1 / a) * first, hinge = chain.axis() - chain.axis().dot(along) * along;
    const double size = std::sqrt(hinge.squaredNorm());
    if (a > nothing * (a + b) && b > nothing * (a + b) && size > 1e-9 && way.length.v > nothing * (a + b)) {
      const Bend bend =
          bent<Vec3, double>(axes<Vec3>(along, (1 / size) * hinge), a, b, Turned(middle) * Vec3((1 / b) * second),
                             way.unit, way.length, turn, inward, goal);
      turn_to(start, bend.start, weight);
      turn_to(middle, bend.middle * rotation_of(middle), weight);
      return;
    }
  }

  const TwoBones bones = two_bones(chain, pose);
  const Measured first = measured(bones.first), second = measured(bones.second);
  const double length = first.length.v + second.length.v;
  if (!(length > 0)) return;
  Arrow along = way.unit;
  if (way.length.v <= nothing * length) {
    const Measured unturned = measured(bones.first + bones.second);
    along = turn * (unturned.length.v > nothing * length ? unturned.unit : first.any ? first.unit : second.unit);
  }
  if (first.length.v <= nothing * length || second.length.v <= nothing * length) {
    const Arrow from = turn * unit(bones.first + bones.second);
    turn_to(start, arc(from, along, any_across(from.v)) * rotation_of(start), weight);
    return;
  }
  const Bend bend = bent<Arrow, Dual>(axes(first.unit, hinge_of(chain, first.unit)), first.length, second.length,
                                      second.unit, along, way.length, turn, inward, goal);
  turn_to(start, bend.start, weight);
  turn_to(middle, chains::inverse(bones.carried) * bend.middle * bones.carried * rotation_of(middle), weight);
}

}  // namespace tweenfall
