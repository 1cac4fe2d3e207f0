#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "islands/handed_on.h"
#include "islands/island_contents.h"
#include "islands/islands.h"

namespace tweenfall::islands {

/// Relative gain of energy of jointed bodies in a step that passes for an error of the step.
inline constexpr double passable_gain = 0.01;

/// Where a body was and how it moved at the start of a step.
struct FreeStart {
  Vec3 center;
  Quat rotation;
  Twist twist;
};

/// Bodies that push, or hold by joints, only each other in a step keep their angular momentum. But impulses act where
/// the bodies were when the contact was found, joints hold only up to their remaining gaps, and the bodies move on
/// while the impulses are being computed: the error this leaves is given back to all of them together as a turn about
/// their common center of mass, which no contact feels, and its energy is taken from their other motion. That center
/// moves as their momentum says; contacts add no energy to the motion relative to it, and joints without motors and
/// springs no more than `passable_gain` of it. What this changes is told of the contacts and joints between them.
class FreeIslands {
 public:
  /// Call it before the bodies of a step.
  void begin(std::size_t bodies) { slots_.resize(bodies, nobody); }
  /// @param moved  by index: set for the bodies that the solver moved
  /// @param start_of  a FreeStart by index
  template <class StartOf>
  void keep(const IslandContents& island, std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
            const std::vector<char>& moved, Integrator integrator, double dt, const StartOf& start_of) {
    if (!gather(island, bodies, loads, moved)) return;
    for (Member& member : members_) member.start = start_of(member.index);
    keep_all(island, bodies, integrator, dt);
    for (const Member& member : members_) slots_[member.index] = nobody;
  }

 private:
  static constexpr std::uint32_t nobody = 0xffffffffu;

  struct Member {
    std::uint32_t index = 0;
    bool gripped = false;  ///< its spin changes with that of the others
    bool jointed = false;  ///< joints hold it only up to their remaining gaps
    bool driven = false;   ///< motors and springs may give it energy
    FreeStart start;
    Vec3 left{0, 0, 0};  ///< the velocity with which the solver left it, m/s
  };

  /// @return whether nothing else holds or pushes them
  bool gather(const IslandContents& island, const std::vector<state::Body>& bodies,
              const std::vector<forces::Load>& loads, const std::vector<char>& moved);
  void keep_all(const IslandContents& island, std::vector<state::Body>& bodies, Integrator integrator, double dt);
  static void keep_group(std::span<const Member> group, std::vector<state::Body>& bodies, Integrator integrator,
                         double dt);

  std::vector<std::uint32_t> slots_;  ///< from a body's index into members_
  std::vector<Member> members_, group_;
  Islands groups_;  ///< of members_: those that pushed each other
  std::unique_ptr<HandedOn> handed_on_;
};

}  // namespace tweenfall::islands
