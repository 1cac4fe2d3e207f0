#pragma once

/// Triangle meshes deformed by a skeleton and by morph targets.

#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/curves/surface_mesh.h>

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace tweenfall {

/// How far each vertex moves when a morph target's weight is 1.
struct MorphTarget {
  std::string name;
  std::vector<Vec3> position_offsets;  ///< one per vertex
  std::vector<Vec3> normal_offsets;    ///< one per vertex, or empty
  std::vector<Vec3> tangent_offsets;   ///< one per vertex, or empty
};

/// One joint that pulls on a vertex.
struct Influence {
  std::uint32_t joint = 0;  ///< index into the skin's joints
  double weight = 0;        ///< those of one vertex sum to 1

  bool operator==(const Influence&) const = default;
};

/// The joints that pull on each vertex of a mesh: any number per vertex, all of them in one list.
class Influences {
 public:
  /// Adds those of the next vertex.
  void add(std::span<const Influence> of_vertex);
  void add(std::initializer_list<Influence> of_vertex);

  [[nodiscard]] std::size_t size() const noexcept { return ends_.size(); }  ///< vertices
  [[nodiscard]] bool empty() const noexcept { return ends_.empty(); }
  [[nodiscard]] std::span<const Influence> operator[](std::size_t vertex) const noexcept;
  [[nodiscard]] std::size_t most() const noexcept;  ///< the greatest number for any vertex

  bool operator==(const Influences&) const = default;

 private:
  std::vector<Influence> all_;
  std::vector<std::size_t> ends_;  // where each vertex's part of the list ends
};

struct Mesh {
  std::string name;
  std::vector<Vec3> positions;  ///< in the mesh's own space, m
  std::vector<Vec3> normals;    ///< unit; one per vertex, or empty
  /// Unit, along the surface; one per vertex, or empty. The fourth number is 1 where the direction across it is
  /// normal x tangent, and -1 where it is the opposite.
  std::vector<Vec4> tangents;
  std::vector<Vec2> texture_coordinates;  ///< one per vertex, or empty
  std::vector<std::uint32_t> triangles;   ///< three vertices each, counter-clockwise seen from outside
  Influences influences;                  ///< one per vertex, or empty when not skinned
  std::vector<MorphTarget> morphs;
  std::vector<double> rest_weights;  ///< one per morph target
  Color base_color{Vec4{0.8, 0.8, 0.8, 1}};
};

/// A swept or turned surface as a mesh for display.
[[nodiscard]] Mesh mesh_of(const SurfaceMesh& surface, std::string name = {});

/// The nodes that are the joints of a mesh, and their inverse bind matrices.
struct Skin {
  struct InverseBind {
    Mat3 linear = Mat3::Identity();
    Vec3 translation{0, 0, 0};
  };
  std::vector<std::size_t> joints;         ///< node indices
  std::vector<InverseBind> inverse_binds;  ///< one per joint
};

/// A mesh attached to a node, skinned or not.
struct MeshInstance {
  std::size_t node = no_node;
  std::size_t mesh = 0;        ///< index of the mesh
  std::size_t skin = no_node;  ///< index of the skin; `no_node` for none
};

/// World positions of a mesh's vertices: morphs first, then skin or node.
///
/// @param weights  one per morph target, or empty for the mesh's rest weights
/// @param skin     null when the mesh follows only `node`
/// @param world    world motion of every node
/// @param out      written, one per vertex, m
void deform(const Mesh& mesh, std::span<const double> weights, const Skin* skin, std::size_t node,
            std::span<const WorldMotion> world, std::span<Vec3> out) noexcept;

}  // namespace tweenfall
