#pragma once

/// The details of `detail.h` for a stage, by nodes, as left by its last step before or at `Stage::time`.

#include <tweenfall/physics/detail.h>
#include <tweenfall/physics/stage/stage.h>

#include <vector>

namespace tweenfall {

struct NodeDetail {
  NodeId node = no_node;
  NodeId island = no_node;  ///< first of the nodes whose bodies are solved together; `no_node` as in `BodyDetail`
  bool asleep = false;
  Bounds box{Vec3(0, 0, 0), Vec3(0, 0, 0)};
};

struct ContactDetail {
  NodeId a = no_node, b = no_node;
  Vec3 point{0, 0, 0};   ///< m, world
  Vec3 normal{0, 0, 0};  ///< from a to b
  double impulse = 0;    ///< of the pair in the last step, N s
};

struct StageDetail {
  std::vector<NodeDetail> nodes;  ///< those with bodies, in order
  std::vector<ContactDetail> contacts;
};

/// @throws std::logic_error for a stage that was moved from
[[nodiscard]] StageDetail detail_of(const Stage& stage);

}  // namespace tweenfall
