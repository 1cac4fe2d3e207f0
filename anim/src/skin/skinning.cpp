#include <tweenfall/anim/skinning.h>

#include "chains/moving.h"

namespace tweenfall {
namespace skin {
namespace {

using chains::Arrow;
using chains::Dual;
using chains::Turning;

// A matrix and its rate, and the translation.
struct Affine {
  Mat3 linear = Mat3::Zero(), linear_rate = Mat3::Zero();
  Arrow origin;

  [[nodiscard]] Arrow direction(const Arrow& a) const noexcept {
    return {linear * a.v, linear_rate * a.v + linear * a.d};
  }
  [[nodiscard]] Arrow point(const Arrow& a) const noexcept { return direction(a) + origin; }
};

// By the cofactors, which are a multiple of the inverse transpose and exist for singular matrices too.
Arrow normal_through(const Affine& m, const Arrow& normal) noexcept {
  const Arrow a{m.linear.col(0), m.linear_rate.col(0)}, b{m.linear.col(1), m.linear_rate.col(1)},
      c{m.linear.col(2), m.linear_rate.col(2)};
  const Arrow bc = cross(b, c);
  const auto part = [&](int i) { return Dual(normal.v[i], normal.d[i]); };
  const Arrow sum = part(0) * bc + part(1) * cross(c, a) + part(2) * cross(a, b);
  return a.v.dot(bc.v) < 0 ? -sum : sum;
}

Affine linear_blend(std::span<const Influence> influences, std::span<const SkinJoint> joints) noexcept {
  Affine sum;
  for (const auto& [joint, weight] : influences) {
    if (weight == 0) continue;
    const WorldFrame& frame = joints[joint].moved;
    sum.linear += weight * frame.linear;
    sum.linear_rate += weight * frame.linear_rate;
    sum.origin.v += weight * frame.origin;
    sum.origin.d += weight * frame.velocity;
  }
  return sum;
}

// The rate of a quaternion from its angular velocity.
Quat rate_of(const Quat& q, const Vec3& spin) noexcept {
  const Quat rate = Quat(0, spin.x(), spin.y(), spin.z()) * q;
  return Quat(0.5 * rate.coeffs());
}

// Whose joint decides the signs of the others' rotations: one that hardly counts must not set the others against each
// other.
const Influence* heaviest(std::span<const Influence> influences) noexcept {
  const Influence* heaviest = nullptr;
  for (const Influence& each : influences)
    if (!heaviest || std::abs(each.weight) > std::abs(heaviest->weight)) heaviest = &each;
  return heaviest;
}

Affine dual_quaternion_blend(std::span<const Influence> influences, std::span<const SkinJoint> joints) noexcept {
  // Real and dual part, each with its rate.
  Vec4 real(0, 0, 0, 0), real_rate(0, 0, 0, 0), dual(0, 0, 0, 0), dual_rate(0, 0, 0, 0);
  Affine stretch;
  const Influence* const pivot = heaviest(influences);
  for (const auto& [joint, weight] : influences) {
    if (weight == 0) continue;
    const SkinJoint& each = joints[joint];
    const Quat rate = rate_of(each.rotation, each.spin);
    const Quat place(0, each.moved.origin.x(), each.moved.origin.y(), each.moved.origin.z());
    const Quat speed(0, each.moved.velocity.x(), each.moved.velocity.y(), each.moved.velocity.z());
    const Quat moved = place * each.rotation, moving_on = speed * each.rotation, moving = place * rate;
    const double share = joints[pivot->joint].rotation.dot(each.rotation) < 0 ? -weight : weight;
    real += share * each.rotation.coeffs();
    real_rate += share * rate.coeffs();
    dual += 0.5 * share * moved.coeffs();
    dual_rate += 0.5 * share * (moving_on.coeffs() + moving.coeffs());
    stretch.linear += weight * each.stretch;
    stretch.linear_rate += weight * each.stretch_rate;
  }
  const double square = real.squaredNorm();
  if (!(square > 1e-24)) return linear_blend(influences, joints);
  const Quat q(real / std::sqrt(square));
  const Quat turning = Quat(real_rate) * Quat(real).conjugate();
  Affine result;
  const Mat3 matrix = q.toRotationMatrix();
  const Vec3 spin = (2 / square) * turning.vec();
  // The position is twice the dual part times the conjugate of the real part, divided by the square of its length.
  const Quat back = Quat(real).conjugate(), back_rate = Quat(real_rate).conjugate();
  const Quat place = Quat(dual) * back, place_on = Quat(dual_rate) * back, place_back = Quat(dual) * back_rate;
  result.origin.v = (2 / square) * place.vec();
  result.origin.d =
      (2 / square) * (place_on.vec() + place_back.vec()) - (2 * real.dot(real_rate) / square) * result.origin.v;
  result.linear = matrix * stretch.linear;
  for (int i = 0; i < 3; ++i) {
    const Vec3 column = result.linear.col(i);
    result.linear_rate.col(i) = spin.cross(column) + matrix * stretch.linear_rate.col(i);
  }
  return result;
}

// Applies the morph targets to a list of the mesh.
class Molding {
 public:
  Molding(const Mesh& mesh, std::span<const double> weights, std::span<const double> rates) noexcept
      : mesh_(mesh), weights_(weights.empty() ? std::span<const double>(mesh.rest_weights) : weights), rates_(rates) {}

  /// @param offsets_of called with the number of a target, returns its list or an empty one
  template <class OffsetsOf>
  [[nodiscard]] Arrow at(const Vec3& rest, std::size_t vertex, const OffsetsOf& offsets_of) const noexcept {
    Arrow molded{rest, Vec3(0, 0, 0)};
    for (std::size_t target = 0; target < mesh_.morphs.size() && target < weights_.size(); ++target) {
      const double rate = target < rates_.size() ? rates_[target] : 0;
      if (weights_[target] == 0 && rate == 0) continue;
      const std::span<const Vec3> offsets = offsets_of(target);
      if (offsets.empty()) continue;
      molded.v += weights_[target] * offsets[vertex];
      molded.d += rate * offsets[vertex];
    }
    return molded;
  }
  [[nodiscard]] Arrow position(std::size_t vertex) const noexcept {
    return at(mesh_.positions[vertex], vertex,
              [&](std::size_t target) { return std::span<const Vec3>(mesh_.morphs[target].position_offsets); });
  }
  [[nodiscard]] Arrow normal(std::size_t vertex) const noexcept {
    return at(mesh_.normals[vertex], vertex,
              [&](std::size_t target) { return std::span<const Vec3>(mesh_.morphs[target].normal_offsets); });
  }
  [[nodiscard]] Arrow tangent(std::size_t vertex) const noexcept {
    return at(mesh_.tangents[vertex].head<3>(), vertex,
              [&](std::size_t target) { return std::span<const Vec3>(mesh_.morphs[target].tangent_offsets); });
  }

 private:
  const Mesh& mesh_;
  std::span<const double> weights_, rates_;
};

void write(std::span<Vec3> values, std::span<Vec3> rates, std::size_t vertex, const Arrow& a) noexcept {
  if (!values.empty()) values[vertex] = a.v;
  if (!rates.empty()) rates[vertex] = a.d;
}

// Splits a matrix into a rotation and the rest: the first column keeps its direction, the second its plane.
void split(SkinJoint& joint) noexcept {
  const Mat3 &m = joint.moved.linear, &rate = joint.moved.linear_rate;
  const Arrow a{m.col(0), rate.col(0)}, b{m.col(1), rate.col(1)};
  const chains::Measured x = measured(a), z = measured(cross(a, b));
  if (!x.any || !z.any) {
    joint.rotation = Quat(1, 0, 0, 0);
    joint.spin = Vec3(0, 0, 0);
    joint.stretch = m;
    joint.stretch_rate = rate;
    return;
  }
  const chains::Axes<Arrow> own = axes(x.unit, cross(z.unit, x.unit));
  const Turning turn{chains::rotation_between(chains::axes<Vec3>({1, 0, 0}, {0, 1, 0}), {own.x.v, own.y.v, own.z.v}),
                     spin_of(own)};
  joint.rotation = turn.v;
  joint.spin = turn.w;
  for (int i = 0; i < 3; ++i) {
    const Arrow column = chains::inverse(turn) * Arrow{m.col(i), rate.col(i)};
    joint.stretch.col(i) = column.v;
    joint.stretch_rate.col(i) = column.d;
  }
}

}  // namespace
}  // namespace skin

void skin_joints(const Skin& skin, std::span<const WorldMotion> world, std::span<SkinJoint> joints) noexcept {
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const WorldMotion& node = world[skin.joints[i]];
    const Skin::InverseBind& bind = skin.inverse_binds[i];
    WorldFrame& moved = joints[i].moved;
    moved.linear = node.linear * bind.linear;
    moved.linear_rate = node.linear_rate * bind.linear;
    moved.origin = node.point(bind.translation);
    moved.velocity = node.point_velocity(bind.translation);
    skin::split(joints[i]);
  }
}

SkinJoint skin_joint(const WorldMotion& node) noexcept {
  SkinJoint joint;
  joint.moved = {node.linear, node.linear_rate, node.motion.pose.position, node.motion.twist.linear};
  skin::split(joint);
  return joint;
}

void deform(const Mesh& mesh, std::span<const SkinJoint> joints, const Deformation& how,
            const DeformedMesh& out) noexcept {
  using namespace skin;
  const Molding molding(mesh, how.weights, how.weight_rates);
  const bool places = !out.positions.empty() || !out.velocities.empty();
  const bool normals = !mesh.normals.empty() && (!out.normals.empty() || !out.normal_rates.empty());
  const bool tangents = !mesh.tangents.empty() && (!out.tangents.empty() || !out.tangent_rates.empty());
  const Influence whole{0, 1};
  const bool alone = mesh.influences.empty() || joints.size() == 1;
  for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    const std::span<const Influence> influences =
        alone ? std::span<const Influence>(&whole, 1) : mesh.influences[vertex];
    const Affine carried =
        how.blend == SkinBlend::linear ? linear_blend(influences, joints) : dual_quaternion_blend(influences, joints);
    if (places) write(out.positions, out.velocities, vertex, carried.point(molding.position(vertex)));
    if (normals)
      write(out.normals, out.normal_rates, vertex, measured(normal_through(carried, molding.normal(vertex))).unit);
    if (tangents)
      write(out.tangents, out.tangent_rates, vertex, measured(carried.direction(molding.tangent(vertex))).unit);
  }
}

void deform(const Mesh& mesh, std::span<const double> weights, const Skin* skin, std::size_t node,
            std::span<const WorldMotion> world, std::span<Vec3> out) noexcept {
  const skin::Molding molding(mesh, weights, {});
  for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    const Vec3 position = molding.position(vertex).v;
    if (!skin || mesh.influences.empty()) {
      out[vertex] = world[node].point(position);
      continue;
    }
    Vec3 sum(0, 0, 0);
    for (const auto& [joint, weight] : mesh.influences[vertex]) {
      if (weight == 0) continue;
      const Skin::InverseBind& inverse = skin->inverse_binds[joint];
      sum += weight * world[skin->joints[joint]].point(inverse.linear * position + inverse.translation);
    }
    out[vertex] = sum;
  }
}

}  // namespace tweenfall
