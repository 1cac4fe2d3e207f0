#include "saving/bytes.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace tweenfall::saving {

namespace {

/// Precedes a hull, a mesh or a height field that has not been written yet.
constexpr std::uint32_t first_time = 0xffffffff;

}  // namespace

bool ByteWriter::known(std::unordered_map<const void*, std::uint32_t>& all, const void* data) {
  const auto [found, added] = all.try_emplace(data, static_cast<std::uint32_t>(all.size()));
  number(added ? first_time : found->second);
  return !added;
}

void ByteWriter::mesh(const TriangleMesh& mesh) {
  if (known(meshes_, mesh.vertices().data())) return;
  number(static_cast<std::uint64_t>(mesh.vertices().size()));
  for (const Vec3& vertex : mesh.vertices()) walk(*this, vertex);
  number(static_cast<std::uint64_t>(mesh.triangles().size()));
  for (const std::uint32_t corner : mesh.triangles()) number(corner);
}

void ByteWriter::heights(const HeightField& field) {
  if (known(fields_, field.heights().data())) return;
  number(static_cast<std::uint64_t>(field.columns()));
  number(field.spacing_x());
  number(field.spacing_z());
  number(static_cast<std::uint64_t>(field.heights().size()));
  for (const double height : field.heights()) number(height);
}

void ByteWriter::hull(const ConvexHull& hull) {
  if (known(hulls_, hull.vertices().data())) return;
  number(static_cast<std::uint64_t>(hull.vertices().size()));
  for (const Vec3& vertex : hull.vertices()) walk(*this, vertex);
  number(static_cast<std::uint64_t>(hull.faces().size()));
  for (const ConvexHull::Face& face : hull.faces()) {
    number(static_cast<std::uint64_t>(face.corners));
    for (const std::uint32_t corner : hull.corners(face)) number(corner);
  }
}

void ByteWriter::field(const Field&) {
  throw std::invalid_argument(
      "a world with a field cannot be saved, since a field is a function: remove it with remove_force, and add it "
      "again after loading");
}

Hull ByteReader::read_hull() {
  std::uint32_t index = 0;
  number(index);
  if (index != first_time) {
    require(index < hulls_.size(), "there is no such hull");
    return Hull{hulls_[index]};
  }
  std::vector<Vec3> vertices;
  list(vertices);
  std::vector<std::vector<std::uint32_t>> faces;
  list(faces);
  return Hull{hulls_.emplace_back(vertices, faces)};
}

TriangleMesh ByteReader::read_mesh() {
  std::uint32_t index = 0;
  number(index);
  if (index != first_time) {
    require(index < meshes_.size(), "there is no such mesh");
    return meshes_[index];
  }
  SurfaceMesh mesh;
  list(mesh.positions);
  list(mesh.triangles);
  TriangleMesh read(mesh);
  require(read.vertices().size() == mesh.positions.size() && read.triangles().size() == mesh.triangles.size(),
          "a mesh has vertices or triangles that it cannot have");
  return meshes_.emplace_back(read);
}

HeightField ByteReader::read_heights() {
  std::uint32_t index = 0;
  number(index);
  if (index != first_time) {
    require(index < fields_.size(), "there is no such height field");
    return fields_[index];
  }
  std::uint64_t columns = 0;
  double spacing_x = 0, spacing_z = 0;
  number(columns);
  number(spacing_x);
  number(spacing_z);
  std::vector<double> heights;
  list(heights);
  require(columns <= heights.size(), "a height field has more columns than heights");
  return fields_.emplace_back(static_cast<std::size_t>(columns), heights, spacing_x, spacing_z);
}

Compound ByteReader::read_compound() {
  require(!in_compound_, "a compound is a part of another one");
  in_compound_ = true;
  std::vector<Shape> parts;
  list(parts);
  in_compound_ = false;
  return Compound(std::move(parts));
}

void ByteReader::field(Field&) {
  require(false, "a field cannot have been saved");
  throw std::logic_error("a field was read");
}

std::uint64_t ByteReader::count() {
  std::uint64_t count = 0;
  number(count);
  require(count <= bytes_.size() - place_, "it tells of more than there is room for");
  return count;
}

void ByteReader::require(bool holds, const char* what) const {
  if (!holds)
    throw std::invalid_argument(std::string("a saved ") + kind_ + " is wrong at byte " + std::to_string(place_) +
                                " of its contents: " + what);
}

}  // namespace tweenfall::saving
