#pragma once

// The animations of a glTF document as clips, each key kind kept.

#include "gltf/accessors.h"
#include "gltf/meshes.h"
#include "gltf/nodes.h"

#include <tweenfall/anim/clip.h>

#include <vector>

namespace tweenfall::gltf {

[[nodiscard]] std::vector<Clip> read_animations(const Fields& root, Accessors& accessors,
                                                const std::vector<FileNode>& nodes,
                                                const std::vector<FileMesh>& meshes);

}  // namespace tweenfall::gltf
