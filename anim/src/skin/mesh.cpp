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

Mesh mesh_of(const SurfaceMesh& surface, std::string name) {
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.positions = surface.positions;
  mesh.normals = surface.normals;
  mesh.texture_coordinates = surface.texture_coordinates;
  mesh.triangles = surface.triangles;
  return mesh;
}

}  // namespace tweenfall
