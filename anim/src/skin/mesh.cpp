#include <tweenfall/anim/mesh.h>

#include <algorithm>
#include <utility>

namespace tweenfall {

void Influences::add(std::span<const Influence> of_vertex) {
  all_.insert(all_.end(), of_vertex.begin(), of_vertex.end());
  ends_.push_back(all_.size());
}

void Influences::add(std::initializer_list<Influence> of_vertex) {
  add(std::span<const Influence>(of_vertex.begin(), of_vertex.size()));
}

std::span<const Influence> Influences::operator[](std::size_t vertex) const noexcept {
  const std::size_t first = vertex == 0 ? 0 : ends_[vertex - 1];
  return std::span<const Influence>(all_).subspan(first, ends_[vertex] - first);
}

std::size_t Influences::most() const noexcept {
  std::size_t most = 0;
  for (std::size_t vertex = 0; vertex < size(); ++vertex) most = std::max(most, (*this)[vertex].size());
  return most;
}

namespace skin {
namespace {

Vec3 molded(const Mesh& mesh, std::span<const double> weights, std::size_t vertex) {
  Vec3 position = mesh.positions[vertex];
  for (std::size_t target = 0; target < mesh.morphs.size() && target < weights.size(); ++target)
    if (weights[target] != 0) position += weights[target] * mesh.morphs[target].position_offsets[vertex];
  return position;
}

Vec3 skinned(std::span<const Influence> influences, const Skin& skin, std::span<const WorldMotion> world,
             const Vec3& position) {
  Vec3 sum(0, 0, 0);
  for (const auto& [joint, weight] : influences) {
    if (weight == 0) continue;
    const Skin::InverseBind& inverse = skin.inverse_binds[joint];
    const Vec3 in_joint = inverse.linear * position + inverse.translation;
    sum += weight * world[skin.joints[joint]].point(in_joint);
  }
  return sum;
}

}  // namespace
}  // namespace skin

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
    const Vec3 position = skin::molded(mesh, in_force, vertex);
    out[vertex] =
        follows_skin ? skin::skinned(mesh.influences[vertex], *skin, world, position) : world[node].point(position);
  }
}

}  // namespace tweenfall
