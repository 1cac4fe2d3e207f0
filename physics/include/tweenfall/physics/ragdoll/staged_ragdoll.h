#pragma once

/// The skinned figure of a stage as a ragdoll: its own nodes get bodies and joints, so that rules hand it over like
/// anything else on the stage, joint by joint with the animation's own velocities, and take it back.

#include <tweenfall/physics/ragdoll/ragdoll.h>
#include <tweenfall/physics/stage/description.h>

namespace tweenfall {

/// Fits bones to all skinned meshes of a stage, and gives their nodes bodies, and joints named after the moving nodes.
/// Bodies that a playing clip moves are keyed, others free. The bones of a figure pass through each other and collide
/// with everything else: they get the group that `body` names, or else one of the 64 that nothing on the stage uses.
/// A node that has a body keeps it.
/// @param group  the name by which rules refer to all of its nodes; `drive` of `body` is ignored
/// @param meshes  name or pattern of the nodes that show the meshes of the figure
/// @returns the bones
/// @throws std::invalid_argument as `fit_ragdoll`, for a stage without a skinned mesh, or when no group is free
std::vector<RagdollBone> add_ragdoll(StageDescription& stage, const RagdollSettings& settings = {},
                                     const RagdollBody& body = {}, const std::string& group = "ragdoll",
                                     const std::string& meshes = "*");

}  // namespace tweenfall
