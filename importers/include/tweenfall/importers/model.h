#pragma once

/// Models: meshes, nodes, skins and clips from glTF, FBX, BVH, Collada and OBJ files.
///
/// glTF, FBX (7.0 and later, text and binary) and BVH are read from the file itself, so that keys keep
/// their kind and tangents, layers their weights, and frames their exact times; units, axes and clocks are those of the
/// file. Collada and OBJ come through assimp; their keys are joined by straight lines.
///
/// A malformed file can end assimp's process or take all its memory, so assimp runs in a program of its
/// own, `tweenfall-import-helper`, within bounds of memory and time. It is looked for at the path in the environment
/// variable TWEENFALL_IMPORT_HELPER, beside the running program, in `../libexec` from there, and where it was built or
/// installed; without it Collada and OBJ files are refused. Where programs cannot be started at all, assimp runs in the
/// caller's process, and a repair says so.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/mesh.h>
#include <tweenfall/physics/stage/description.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tweenfall {

/// The body of a node of a model.
struct ModelBody {
  std::size_t node = 0;
  BodyDescription body = {};
  bool keyed = false;  ///< follows its clips instead of forces
};

struct Model {
  std::string name;         ///< that of the file, without its extension
  std::vector<Node> nodes;  ///< parents before children; a second node with the same name is called "name#2"
  std::vector<Clip> clips;
  std::vector<Mesh> meshes;
  std::vector<Skin> skins;
  std::vector<MeshInstance> instances;
  std::vector<ModelBody> bodies;         ///< from glTF with KHR_physics_rigid_bodies; at most one for each node
  std::vector<JointDescription> joints;  ///< from the same; their ends are nodes of the model that have bodies
  /// Nodes whose bodies pass through each other; read from a file, this is part of the groups of the bodies.
  std::vector<std::pair<std::size_t, std::size_t>> ignored;
  std::vector<std::string> repairs;  ///< faults of the file and how it was read nevertheless, one sentence each
};

/// A file that could not be loaded; `what()` names it and says why, one problem per line, with the line and column
/// where the file is text; bytes of the file that cannot be shown are spelled out (`terminal_text`).
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws ModelError; nothing else, whatever the file holds.
[[nodiscard]] Model load_model(const std::filesystem::path& file);

/// Writes nodes, clips, meshes and skins as binary glTF 2.0, bodies and joints by the extensions KHR_implicit_shapes
/// and KHR_physics_rigid_bodies. Step, linear and cubic tracks stay what they are where glTF has the form, others
/// become linear keys, `fps` per second. Left out, since glTF has no form for them: color tracks and user tracks,
/// events, loops, and meshes without triangles; pulleys and gears, loads at which joints break, springs that turn
/// limbs, moving surfaces, damping, and rolling friction.
/// @throws std::runtime_error when the file cannot be written, a clip has no end, or a number exceeds 32-bit floats;
///         the file is written whole or not at all.
void save_glb(const Model& model, const std::filesystem::path& file, double fps = 60);

}  // namespace tweenfall
