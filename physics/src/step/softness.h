#pragma once

#include <algorithm>
#include <limits>
#include <numbers>

namespace tweenfall::step {

/// How an overlapping contact gives way while positions are corrected.
struct Softness {
  double rate = 0;    ///< share of the overlap that is taken apart, 1/s
  double speed = 0;   ///< at most, m/s
  double firm = 1;    ///< share of the speed error met by a pass
  double giving = 0;  ///< share of the impulse let go by a pass

  /// Overlap from which on it is taken apart no faster, m.
  [[nodiscard]] double deep() const { return rate > 0 ? speed / rate : std::numeric_limits<double>::infinity(); }
};

/// Of the contacts of a step of `dt` seconds.
/// Source: Catto, Solver2D, 2024 (soft contacts).
/// @param parts  as many as `dt` fits into the whole step: contacts give way as they do in that, or what rests would
/// settle anew in each part
/// @param cycles  of a contact's spring in a sub-step: what it bears presses it in by the inverse square of them
[[nodiscard]] inline Softness soft_contacts(double push_out_speed, double dt, int sub_steps, double parts = 1,
                                            double cycles = 0.125) {
  constexpr double damping = 10;  // ratio
  // In shorter steps than this overlap is taken apart more slowly, in the end not at all: the speed that it needs
  // is the shorter the step the greater, and would be a blow, s.
  constexpr double unhurried = 1e-3;
  const double h = dt / sub_steps;
  const double turn = 2 * std::numbers::pi * cycles / parts;
  const double stiffness = turn * (2 * damping + turn);
  const double hurry = std::min(1.0, dt * parts / unhurried);
  return {hurry * hurry * turn / (h * (2 * damping + turn)), push_out_speed, stiffness / (1 + stiffness),
          1 / (1 + stiffness)};
}

/// By how much the impulses of a part of a step are longer when they are kept, so that whatever comes next starts from
/// those of a whole step. Of very short parts the rounding would grow with them.
/// @param parts  as many as the part fits into the whole
[[nodiscard]] inline double kept_as_whole(double parts) {
  constexpr double most = 8;
  return parts > most ? 1 : parts;
}

}  // namespace tweenfall::step
