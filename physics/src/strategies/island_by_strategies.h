#pragma once

#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "strategies/gathering.h"

namespace tweenfall::strategies {

/// Whether a world asks for any way but the usual ones to meet contacts.
[[nodiscard]] bool chosen(const WorldSettings& settings);

/// A part of a step.
struct Part {
  double h = 0;       ///< its length, s; 0 for what happens at one instant
  double left = 0;    ///< of the step, from its start on, s
  double step = 0;    ///< the whole step, s: what is slower than gravity makes it in one is no blow
  bool blows = true;  ///< what meets bounces
  bool ahead = true;  ///< gaps may close in it, but no further; else only what touches already counts
};

/// Moves the parties of an island, by the strategies that the world asks for, through a part of a step.
class IslandByStrategies {
 public:
  /// Changes the velocities of all, and moves those that an impulse reached.
  /// @param moved  by index: set for those
  /// @return how far off complementarity the impulses are, m/s; 0 unless they are solved for it
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
