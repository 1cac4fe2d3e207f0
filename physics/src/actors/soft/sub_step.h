#pragma once

#include <span>
#include <vector>

#include "actors/soft/chains.h"
#include "actors/soft/meetings/partners.h"
#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

/// A node near a body's surface: at the end of the sub-step it must be in front of the plane there.
struct NodeContact {
  std::uint32_t node = 0, partner = 0;
  Vec3 normal{0, 1, 0};   ///< out of the body, at the end of the sub-step
  Vec3 arm{0, 0, 0};      ///< from the partner's center to its surface, at the end
  Vec3 carried{0, 0, 0};  ///< displacement of the surface there in the sub-step if nothing more is given, m
  double least = 0;       ///< required gap between node and surface, m; below 0 if they overlap
  double friction = 0;
  double pressed = 0;  ///< push along the normal in this sub-step, kg m
  double rubbed = 0;   ///< push across it
};

/// A pin in a sub-step.
struct Held {
  static constexpr std::uint32_t nobody = 0xffffffffu;
  std::uint32_t node = 0;
  std::uint32_t partner = nobody;  ///< a movable holder; nobody: the node is where `place` is
  Vec3 arm{0, 0, 0};               ///< from its center, at the end
  Vec3 place{0, 0, 0};             ///< at the end, if the partner is given nothing more
  Vec3 velocity{0, 0, 0};          ///< there, if it is led
  Vec3 pushed{0, 0, 0};            ///< onto the holder, kg m
};

/// One sub-step of a soft body, for either solver: the results are positions, velocities, and pushes.
struct SubStep {
  SoftBody& body;
  Partners& partners;
  std::span<NodeContact> contacts;
  std::span<Held> held;
  KeptChains& chains;
  Vec3 gravity;
  double h = 0;           ///< s
  bool backward = false;  ///< constraints in the order from last to first
};

void solve_positions(SubStep& step);
void solve_springs(SubStep& step);

}  // namespace tweenfall::soft
