#pragma once

#include <span>
#include <vector>

#include "actors/soft/meetings/partners.h"
#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

/// A node near a body's surface: it must end the sub-step before the plane there.
struct NodeContact {
  std::uint32_t node = 0, partner = 0;
  Vec3 normal{0, 1, 0};   ///< out of the body, at the end of the sub-step
  Vec3 arm{0, 0, 0};      ///< from the partner's center to its surface, at the end
  Vec3 carried{0, 0, 0};  ///< how the surface there goes in the sub-step if nothing more is given, m
  double least = 0;       ///< gap between node and surface that is asked for, m; below 0 where they overlap
  double friction = 0;
  double pressed = 0;  ///< push along the normal in this sub-step, kg m
  double rubbed = 0;   ///< and across it
};

/// A pin in a sub-step.
struct Held {
  static constexpr std::uint32_t nobody = 0xffffffffu;
  std::uint32_t node = 0;
  std::uint32_t partner = nobody;  ///< that can be moved; nobody: the node is where `place` is
  Vec3 arm{0, 0, 0};               ///< from its center, at the end
  Vec3 place{0, 0, 0};             ///< at the end, if the partner is given nothing more
  Vec3 velocity{0, 0, 0};          ///< there, of what is led
  Vec3 pushed{0, 0, 0};            ///< onto what holds, kg m
};

/// One sub-step of a soft body, for either solver: they leave places, velocities, and what is pushed.
struct SubStep {
  SoftBody& body;
  Partners& partners;
  std::span<NodeContact> contacts;
  std::span<Held> held;
  Vec3 gravity;
  double h = 0;           ///< s
  bool backward = false;  ///< constraints in the order from last to first
};

void solve_positions(SubStep& step);
void solve_springs(SubStep& step);

}  // namespace tweenfall::soft
