#pragma once

// The deformers of an FBX geometry: skins and blend shapes.

#include "fbx/nodes.h"
#include "fbx/surface/geometry.h"

namespace tweenfall::fbx {

/// An affine map: linear * p + translation.
using Affine = Skin::InverseBind;

/// The transform that a node applies to its geometry but not to its children.
[[nodiscard]] Affine geometric_transform(const Objects& objects, std::size_t model);

/// Joints and weights for the control points of a geometry.
struct SkinData {
  Skin skin;                                         ///< no joints where the geometry has no skin
  std::vector<std::vector<Influence>> influences{};  ///< one list per control point, each summing to 1
};
/// Points without an influence follow the mesh's own node.
[[nodiscard]] SkinData read_skin(std::size_t geometry, std::size_t model, std::size_t control_points,
                                 const Objects& objects, const Nodes& nodes, models::ModelProblems& problems);

/// One shape of a blend shape channel: how far control points move.
struct Shape {
  std::string name;
  std::size_t channel = 0;  ///< the object whose DeformPercent moves it
  std::size_t place = 0;    ///< index among the channel's shapes
  std::vector<std::uint32_t> points;
  std::vector<Vec3> position_offsets, normal_offsets;  ///< one per point; normals may be empty
};

/// All shapes of a geometry, channel by channel.
[[nodiscard]] std::vector<Shape> read_shapes(std::size_t geometry, const Objects& objects,
                                             models::ModelProblems& problems);

/// The weight of each shape, at rest or as a stack moves it.
[[nodiscard]] std::vector<Channel<double>> shape_weights(const std::vector<Shape>& shapes, const Objects& objects,
                                                         const Stack* stack);

}  // namespace tweenfall::fbx
