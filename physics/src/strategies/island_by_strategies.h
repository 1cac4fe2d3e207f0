#pragma once

#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "strategies/gathering.h"

namespace tweenfall::strategies {

/// Whether a world asks for any strategy besides the defaults for contacts.
[[nodiscard]] bool chosen(const WorldSettings& settings);

/// A part of a step.
struct Part {
  double h = 0;       ///< its length, s; 0 for a single instant
  double left = 0;    ///< time from its start to the end of the step, s
  double step = 0;    ///< the whole step, s: speeds below what gravity gives in it are no blows
  bool late = false;  ///< an instant at the end of the step
  bool blows = true;  ///< bodies that are watched to the time of their impact bounce, too
};

/// Moves the parties of an island through a part of a step, by the strategies that the world asks for.
class IslandByStrategies {
 public:
  /// Changes the velocities of all, and moves those that an impulse reached.
  /// @param moved  by index: set for those
  /// @return the residual of complementarity, m/s; 0 unless the impulses are solved for it
  double respond(std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
                 std::span<contacts::ContactConstraint* const> contacts, const WorldSettings& settings,
                 const Part& part, std::vector<char>& moved);

 private:
  void gather(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
              std::span<contacts::ContactConstraint* const> contacts, const WorldSettings& settings, const Part& part);
  std::uint32_t party_of(const std::vector<state::Body>& bodies, std::uint32_t index, const Part& part);

  Gathering island_;
  std::vector<std::uint32_t> places_;  ///< by body
};

}  // namespace tweenfall::strategies
