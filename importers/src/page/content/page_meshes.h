#pragma once

// Meshes, skins and where they hang, as the page wants them.

#include <tweenfall/physics/stage/description.h>

#include <map>
#include <string>

namespace tweenfall::page {

/// Appends `,"meshes":[...],"skins":[...],"instances":[...]`. Instances and joints of nodes that `node_of` does not
/// know are left out.
void append_page_meshes(std::string& out, const StageDescription& stage,
                        const std::map<std::string, std::size_t>& node_of);

}  // namespace tweenfall::page
