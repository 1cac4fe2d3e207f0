#include <tweenfall/anim/two_bone.h>

#include <bit>
#include <cstdint>

#include "chains/moving.h"
#include "chains/problems.h"

namespace tweenfall {
namespace chains {
namespace {

constexpr double nothing = 1e-14;  // of the chain's length

struct TwoBones {
  Arrow first, second;  // in the space of the start
  Turning carried;      // from the space of the middle's turn to that of the start
  Vec3 start_reflection{1, 1, 1}, carrier_reflection{1, 1, 1};  // of what is below the start, and between the two
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
  bones.start_reflection = tweenfall::pose::reflection_of(pose[chain.start()].pose.scale);
  bones.carrier_reflection = tweenfall::pose::reflection_of(carrier.pose.scale);
  bones.first = componentwise(scale, position_of(middle));
  bones.second = componentwise(scale, rotation_of(middle) * componentwise(scale_of(middle), position_of(end)));
  return bones;
}

// The wanted distance of the end from the start, where d is that of the target.
Dual softened(const Dual& d, const Dual& reach, double share) noexcept {
  const Dual width = Dual(share) * reach, from = reach - width;
  if (!(width.v > 0) || d.v <= from.v) return d;
  return from + width * (Dual(1) - exponential((from - d) / width));
}

// The line to the target. Numbers that are ready early are used where they suffice, so that slow ones are not waited
// for.
struct Line {
  Vec3 way;               // along it, of any length
  double square, length;  // of the way
  Arrow along;            // of length 1
};

// The part of a direction perpendicular to the line.
struct Beside {
  Vec3 unit, third;     // `third` is perpendicular to both: along x unit
  double straight = 0;  // its part along the line, relative to its length across it
  double size = 0;      // length of the part, times the square of the line's length
  double inverse = 0;   // 1 / length of the part
};
[[gnu::always_inline]] inline Beside beside(const Vec3& direction, const Line& line) noexcept {
  Beside part;
  const double straight = direction.dot(line.way);
  const Vec3 across = line.square * direction - straight * line.way;
  const double square = across.squaredNorm(), root = std::sqrt(square), inverse = root * (1 / square);
  part.size = root;
  part.inverse = line.square * inverse;
  part.unit = inverse * across;
  part.third = line.along.v.cross(part.unit);
  part.straight = straight * line.length * inverse;
  return part;
}

// The plane of the bend, given by two directions perpendicular to the line to the target: `side`, to which the middle
// goes, and `normal`, about which it bends; along x normal is the side.
struct Plane {
  Vec3 side, normal;
  double turning;  // about the line, rad/s
};

// The first bone as moved by the pose.
struct Carried {
  const Quat& rotation;
  Vec3 spin;
};

// The pose's own plane, given by its bending axis.
template <class Vector>
[[gnu::always_inline]] inline Plane own_plane(const Line& line, const Carried& carried,
                                              const Axes<Vector>& bone) noexcept {
  const Vec3& spin = carried.spin;
  const Arrow& along = line.along;
  const auto turning = [&](const Beside& part) {
    return spin.dot(along.v) - part.straight * (spin.dot(part.unit) + along.d.dot(part.third));
  };
  const Beside normal = beside(carried.rotation * place_of(bone.y), line);
  if (normal.size > 1e-9 * line.square) return {normal.third, normal.unit, turning(normal)};
  const Beside side = beside(carried.rotation * place_of(bone.x), line);
  if (side.size > 1e-9 * line.square) return {side.unit, -side.third, turning(side)};
  const Vec3 any = any_across(along.v);
  return {any, any.cross(along.v), 0};
}

// The plane through the pole. Where the pole is nearly along the chain, it blends over from the pose's own plane, so
// that nothing flips where the pole crosses the line.
template <class Vector>
[[gnu::always_inline]] inline Plane pole_plane(const Arrow& pole, const Line& line, const Carried& carried,
                                               const Axes<Vector>& bone) noexcept {
  constexpr double blend = 0.02, least = 1e-150;
  const Arrow& along = line.along;
  const double enough = blend * line.square;
  const Beside side = beside(pole.v, line);
  const Plane poles{side.unit, -side.third,
                    side.inverse * pole.d.dot(side.third) - side.straight * along.d.dot(side.third)};
  if (side.size > least && side.size * side.size >= enough * enough * pole.v.squaredNorm()) return poles;
  const Plane own = own_plane(line, carried, bone);
  if (!(side.size > least)) return own;
  const Arrow across_line = across(pole, along);
  const Dual share = smooth_step(length(across_line) / (Dual(blend) * length(pole)));
  const Dual whole(elementary::atan2(-own.normal.dot(poles.side), own.side.dot(poles.side)),
                   poles.turning - own.turning);
  const Dual angle = share * whole;
  const elementary::SinCos turn = elementary::sin_cos(angle.v);
  const Vec3 turned = turn.cos * own.side - turn.sin * own.normal;
  return {turned, turned.cross(along.v), own.turning + angle.d};
}

// The result of a solve.
struct Bend {
  Turning start;       // the whole rotation of the start
  Vec3 way, way_spin;  // in its space: the direction of the second bone, and its angular velocity
};

// The solve itself, for bones of changing or, faster, of constant lengths.
// @param bone         axes of the first bone: along it, the bending axis, and the third
// @param a, b         lengths of the bones
// @param line, d      line from the start to the target, and its distance
template <class Vector, class Number>
[[gnu::always_inline]] inline Bend bent(const Axes<Vector>& bone, const Number& a, const Number& b, const Line& line,
                                        const Dual& d, const Motion& start, const Inward& inward,
                                        const TwoBoneGoal& goal) noexcept {
  const Vec3 &x = place_of(bone.x), &y = place_of(bone.y), &z = place_of(bone.z);
  Carried carried{start.pose.rotation, start.twist.angular};
  Vec3 own_spin(0, 0, 0);  // of the bone's axes
  if constexpr (std::is_same_v<Vector, Arrow>) {
    own_spin = spin_of(bone);
    carried.spin += carried.rotation * own_spin;
  }
  const Plane plane =
      goal.pole ? pole_plane(inward.direction(arrow(*goal.pole)), line, carried, bone) : own_plane(line, carried, bone);
  // The triangle of the two bones and the line to the target, by Heron's formula. Cosines are computed from the
  // distance to the folded or the stretched chain: otherwise rounding would confuse the two for bones of very different
  // lengths.
  const Dual wide_a(a), wide_b(b);
  const bool first_longer = wide_a.v >= wide_b.v;
  const Dual reach = wide_a + wide_b;
  const double least = std::abs(wide_a.v - wide_b.v);
  // A smaller softness would be invisible, with rates too large.
  const Dual distance = goal.softness > 1e-9 ? softened(d, reach, std::min(goal.softness, 0.5)) : d;
  double cosine = first_longer ? 1 : -1, sine = 0, turning = 0;  // of the angle at the start
  double bend_cosine = -1, bend_sine = 0, bending = 0;           // of the angle by which the chain is bent
  if (distance.v >= reach.v) {
    cosine = bend_cosine = 1;
  } else if (distance.v > least) {
    const double left = reach.v - distance.v, over = distance.v - least, both = reach.v + distance.v;
    const double folded = over * (distance.v + least), area = std::sqrt(left * both * folded);  // four times
    const double inverse_of_all = 0.5 / (distance.v * wide_a.v * wide_b.v);
    const double inverse = inverse_of_all * wide_b.v, inverse_of_bones = inverse_of_all * distance.v;
    cosine = first_longer ? 1 - left * over * inverse : over * both * inverse - 1;
    sine = area * inverse;
    bend_cosine = folded * inverse_of_bones - 1;
    bend_sine = area * inverse_of_bones;
    // From the rates of b b = a a + d d - 2 a d cos and d d = a a + b b + 2 a b cos.
    const double squares = wide_b.v * wide_b.d - wide_a.v * wide_a.d, twice = area > 0 ? 2 / area : 0;
    turning = ((wide_a.v * cosine - distance.v) * distance.d + squares + wide_a.d * distance.v * cosine) * twice;
    bending = (wide_a.v * wide_a.d + wide_b.v * wide_b.d - distance.v * distance.d +
               (wide_a.d * wide_b.v + wide_a.v * wide_b.d) * bend_cosine) *
              twice;
  }
  if (distance.v <= nothing * reach.v && least <= nothing * reach.v) {
    cosine = 0;  // folded onto the start, to the side
    sine = 1;
    turning = 0;
  }

  Bend bend;
  // The bone is turned within its own plane, and that plane onto the plane of the bend.
  const Axes<Vec3> from{cosine * x - sine * z, y, sine * x + cosine * z};
  bend.start.v = rotation_between(from, {line.along.v, plane.normal, plane.side});
  bend.start.w = line.along.v.cross(line.along.d) + plane.turning * line.along.v - turning * plane.normal;
  bend.way = bend_cosine * x - bend_sine * z;
  bend.way_spin = bending * y;
  if constexpr (std::is_same_v<Vector, Arrow>) {
    bend.start.w -= bend.start.v * own_spin;
    bend.way_spin += own_spin;
  }
  return bend;
}

// The body turned the shortest way that brings its point `from`, at the distance `far`, to the direction `to`; where
// they are opposite, by half a turn about `axis`, perpendicular to both.
[[gnu::always_inline]] inline Turning swung(const Turning& body, const Vec3& from, double far, const Vec3& to,
                                            const Vec3& to_spin, const Vec3& axis) noexcept {
  const Vec3 x = from.cross(to);
  const double s = far + from.dot(to);
  if (s < 1e-14 * far) return Turning{Quat(0, axis.x(), axis.y(), axis.z()), Vec3(0, 0, 0)} * body;
  Turning turned{Quat(s, x.x(), x.y(), x.z()) * body.v, to_spin + ((body.w - to_spin).dot(from + far * to) / s) * to};
  const double square = turned.v.squaredNorm();
  turned.v.coeffs() *= std::sqrt(square) * (1 / square);
  return turned;
}

// The first bone of a chain with the middle at `middle` from its start.
TwoBoneChain::Bone bone_to(const Vec3& middle, const Vec3& axis) noexcept {
  TwoBoneChain::Bone bone{.to_middle = middle, .length = std::sqrt(middle.squaredNorm())};
  bone.x = middle / bone.length;
  const Vec3 hinge = axis - axis.dot(bone.x) * bone.x;
  bone.across = std::sqrt(hinge.squaredNorm());
  bone.y = hinge / bone.across;
  bone.z = bone.x.cross(bone.y);
  return bone;
}

// The axis about which the middle bends, perpendicular to the first bone.
Arrow hinge_of(const TwoBoneChain& chain, const Arrow& first) noexcept {
  const Measured hinge = measured(across({chain.axis(), Vec3(0, 0, 0)}, first));
  return hinge.length.v > 1e-9 ? hinge.unit : Arrow{any_across(first.v), Vec3(0, 0, 0)};
}

// Whether only rotations move in a chain of three nodes, none with a non-uniform scale.
bool is_stiff(const TwoBoneChain& chain, const Motion& start, const Motion& middle, const Motion& end) noexcept {
  const auto bits = [](const Vec3& v) {
    return std::bit_cast<std::uint64_t>(v.x()) | std::bit_cast<std::uint64_t>(v.y()) |
           std::bit_cast<std::uint64_t>(v.z());
  };
  const Vec3& scale = start.pose.scale;
  return chain.adjacent() && scale.x() == scale.y() && scale.y() == scale.z() && scale.x() > 0 &&
         (bits(start.scale_rate) | bits(middle.scale_rate) | bits(middle.twist.linear) | bits(end.twist.linear)) << 1 ==
             0;
}

}  // namespace
}  // namespace chains

TwoBoneChain::TwoBoneChain(const Hierarchy& nodes, const TwoBoneSettings& settings) : nodes_(nodes) {
  chains::Problems problems("two-bone chain");
  start_ = problems.at({"start"}).node(nodes, settings.start, "start");
  middle_ = problems.at({"middle"}).node(nodes, settings.middle, "middle");
  end_ = problems.at({"end"}).node(nodes, settings.end, "end");
  if (start_ != no_node && middle_ != no_node)
    problems.at({"middle"})
        .require(chains::is_below(nodes, middle_, start_), "middle (" + chains::called(nodes, settings.middle) +
                                                               ") must be below start (" +
                                                               chains::called(nodes, settings.start) + ")");
  if (middle_ != no_node && end_ != no_node)
    problems.at({"end"}).require(chains::is_below(nodes, end_, middle_),
                                 "end (" + chains::called(nodes, settings.end) + ") must be below middle (" +
                                     chains::called(nodes, settings.middle) + ")");
  if (settings.axis) problems.at({"axis"}).require_finite(*settings.axis, "axis");
  problems.report();

  std::vector<Motion> rest(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) rest[i].pose = nodes[i].rest;
  const chains::TwoBones bones = chains::two_bones(*this, rest);
  const Vec3 &first = bones.first.v, &second = bones.second.v;
  const Vec3 axis =
      settings.axis ? Vec3(bones.start_reflection.cwiseProduct(*settings.axis)) : Vec3(first.cross(second));
  const double size = std::sqrt(axis.squaredNorm());
  const double bone = std::sqrt(first.squaredNorm()), lengths = bone * std::sqrt(second.squaredNorm());
  if (settings.axis) {
    problems.at({"axis"}).require(size > 0, "axis is zero");
    problems.require(bone == 0 || std::sqrt(axis.cross(first).squaredNorm()) > 1e-6 * size * bone,
                     "axis is along the bone from start to middle; it must be across it");
  } else {
    problems.at({}).require(size > 1e-6 * lengths && size > 0,
                            "it is straight at rest, so that which way it bends must be told: give \"axis\", such as "
                            "[0, 0, 1], about which the middle turns when it bends, in the space of the start");
  }
  problems.report();
  axis_ = axis / size;
  rest_bone_ = chains::bone_to(nodes[middle_].rest.position, axis_);
  adjacent_ = nodes[middle_].parent == start_ && nodes[end_].parent == middle_;
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
  const Arrow to_target = inward.point(arrow(goal.target)) - position_of(start);

  if (is_stiff(chain, start, middle, end)) {
    const TwoBoneChain::Bone* bone = &chain.rest_bone();
    TwoBoneChain::Bone moved;
    if (middle.pose.position != bone->to_middle) bone = &(moved = bone_to(middle.pose.position, chain.axis()));
    const double scale = start.pose.scale.x();
    const Vec3 second = scale * middle.pose.scale.cwiseProduct(end.pose.position);
    const double a = scale * bone->length, b = std::sqrt(second.squaredNorm());
    const double square = to_target.v.squaredNorm(), far = std::sqrt(square);
    if (a > nothing * (a + b) && b > nothing * (a + b) && bone->across > 1e-9 && far > nothing * (a + b)) {
      const double inverse = far * (1 / square);
      const Vec3 straight = inverse * to_target.v;
      const double leaving = straight.dot(to_target.d);
      const Line line{to_target.v, square, far, {straight, inverse * (to_target.d - leaving * straight)}};
      const Bend bend =
          bent<Vec3, double>({bone->x, bone->y, bone->z}, a, b, line, {far, leaving}, start, inward, goal);
      turn_to(start, bend.start, weight);
      turn_to(middle, swung(rotation_of(middle), middle.pose.rotation * second, b, bend.way, bend.way_spin, bone->y),
              weight);
      return;
    }
  }

  const Measured way = measured(to_target);
  const TwoBones bones = two_bones(chain, pose);
  const Measured first = measured(bones.first), second = measured(bones.second);
  const double length = first.length.v + second.length.v;
  if (!(length > 0)) return;
  Arrow along = way.unit;
  if (way.length.v <= nothing * length) {
    const Measured unturned = measured(bones.first + bones.second);
    along = rotation_of(start) * (unturned.length.v > nothing * length ? unturned.unit
                                  : first.any                          ? first.unit
                                                                       : second.unit);
  }
  if (first.length.v <= nothing * length || second.length.v <= nothing * length) {
    const Arrow from = rotation_of(start) * unit(bones.first + bones.second);
    turn_to(start, arc(from, along, any_across(from.v)) * rotation_of(start), weight);
    return;
  }
  const Axes<Arrow> bone = axes(first.unit, hinge_of(chain, first.unit));
  const Bend bend =
      bent<Arrow, Dual>(bone, first.length, second.length, {along.v, 1, 1, along}, way.length, start, inward, goal);
  turn_to(start, bend.start, weight);
  const Turning bending = arc(second.unit, {bend.way, bend.way_spin.cross(bend.way)}, bone.y.v);
  // Where scales mirror, the middle turns the other way round for what is above it.
  const Turning local = chains::inverse(bones.carried) * reflected_by(bones.start_reflection, bending) * bones.carried *
                        reflected_by(bones.carrier_reflection, rotation_of(middle));
  turn_to(middle, reflected_by(bones.carrier_reflection, local), weight);
}

}  // namespace tweenfall
