#include <tweenfall/anim/mesh.h>

#include <utility>

namespace tweenfall {

namespace {

Vec3 molded(const Mesh& mesh, std::span<const double> weights, std::size_t vertex) {
  Vec3 position = mesh.positions[vertex];
  for (std::size_t target = 0; target < mesh.morphs.size() && target < weights.size(); ++target)
    if (weights[target] != 0) position += weights[target] * mesh.morphs[target].position_offsets[vertex];
  return position;
}

Vec3 skinned(const Influence& influence, const Skin& skin, std::span<const WorldMotion> world, const Vec3& position) {
  Vec3 sum(0, 0, 0);
  for (std::size_t slot = 0; slot < influence.joints.size(); ++slot) {
    const double weight = influence.weights[slot];
    if (weight == 0) continue;
    const std::uint32_t joint = influence.joints[slot];
    const Skin::InverseBind& inverse = skin.inverse_binds[joint];
    const Vec3 in_joint = inverse.linear * position + inverse.translation;
    sum += weight * world[skin.joints[joint]].point(in_joint);
  }
  return sum;
}

}  // namespace

Mesh mesh_of(const SurfaceMesh& surface, std::string name) {
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.positions = surface.positions;
  mesh.normals = surface.normals;
  mesh.texture_coordinates = surface.texture_coordinates;
  mesh.triangles = surface.triangles;
  return mesh;
}

void deform(const Mesh& mesh, std::span<const double> weights, const Skin* skin, std::size_t node,
            std::span<const WorldMotion> world, std::span<Vec3> out) noexcept {
  const std::span<const double> in_force = weights.empty() ? std::span<const double>(mesh.rest_weights) : weights;
  const bool follows_skin = skin && !mesh.influences.empty();
  for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    const Vec3 position = molded(mesh, in_force, vertex);
    out[vertex] = follows_skin ? skinned(mesh.influences[vertex], *skin, world, position) : world[node].point(position);
  }
}

}  // namespace tweenfall
