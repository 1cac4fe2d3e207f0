#pragma once

/// Models: meshes, nodes, skins and clips from glTF, FBX, BVH, Collada and OBJ files.
///
/// glTF, FBX (7.0 and later, text and binary) and BVH are read from the file itself, so that keys keep
/// their kind and tangents, layers their weights, and frames their exact times; units, axes and clocks
/// are the file's. Collada and OBJ come through assimp; their keys are joined by straight lines.
///
/// A malformed file can end assimp's process or take all its memory, so assimp runs in a program of its
/// own, `tweenfall-import-helper`, within bounds of memory and time. It is looked for where the environment
/// variable TWEENFALL_IMPORT_HELPER says, beside the running program, in `../libexec` of that, and where it
/// was built or installed; without it Collada and OBJ are refused. Where programs cannot be started at all,
/// assimp runs in the caller's process, and a repair says so.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/mesh.h>
#include <tweenfall/physics/stage/description.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace tweenfall {

/// What a node of a model is to physics.
struct ModelBody {
  std::size_t node = 0;
  BodyDescription body = {};
  bool keyed = false;  ///< follows its clips and not its forces
};

struct Model {
  std::string name;         ///< the file's, without its ending
  std::vector<Node> nodes;  ///< parents before children; of nodes with one name the second is "name#2"
  std::vector<Clip> clips;
  std::vector<Mesh> meshes;
  std::vector<Skin> skins;
  std::vector<MeshInstance> instances;
  std::vector<ModelBody> bodies;         ///< of glTF with KHR_physics_rigid_bodies; at most one for each node
  std::vector<JointDescription> joints;  ///< of the same; their ends are nodes of the model that have bodies
  std::vector<std::string> repairs;  ///< what was wrong with the file and how it was read all the same, a sentence each
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
/// become linear keys `fps` a second. Left out, since glTF has no form for them: tracks of colors and of the user's
/// properties, events, loops, and meshes without triangles; pulleys and gears, loads at which joints break, springs
/// that turn limbs, moving surfaces, damping, and friction against rolling.
/// @throws std::runtime_error when the file cannot be written, a clip has no end, or a number exceeds 32-bit floats;
///         the file is written whole or not at all.
void save_glb(const Model& model, const std::filesystem::path& file, double fps = 60);

}  // namespace tweenfall
