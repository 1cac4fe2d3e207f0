#pragma once

// Meshes, skins and their nodes in the form of the page.

#include <tweenfall/physics/stage/description.h>

#include <map>
#include <string>

namespace tweenfall::page {

/// Appends `,"meshes":[...],"skins":[...],"instances":[...]`. Instances and joints whose nodes are not in `node_of` are
/// left out.
void append_page_meshes(std::string& out, const StageDescription& stage,
                        const std::map<std::string, std::size_t>& node_of);

}  // namespace tweenfall::page
