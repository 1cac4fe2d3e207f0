#pragma once

// The animations of a glTF document as clips, each key kind kept.

#include "gltf/read/accessors.h"
#include "gltf/read/meshes.h"
#include "gltf/read/nodes.h"

#include <tweenfall/anim/clip.h>

#include <vector>

namespace tweenfall::gltf {

[[nodiscard]] std::vector<Clip> read_animations(const Fields& root, Accessors& accessors,
                                                const std::vector<FileNode>& nodes,
                                                const std::vector<FileMesh>& meshes);

}  // namespace tweenfall::gltf
