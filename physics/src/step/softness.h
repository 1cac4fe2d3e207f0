#pragma once

#include <algorithm>
#include <limits>
#include <numbers>

namespace tweenfall::step {

/// How soft an overlapping contact is while positions are corrected.
struct Softness {
  double rate = 0;    ///< share of the overlap that is removed, 1/s
  double speed = 0;   ///< greatest speed, m/s
  double firm = 1;    ///< share of the speed error that one pass removes
  double giving = 0;  ///< share of the impulse that one pass lets go

  /// Overlap beyond which it is removed no faster, m.
  [[nodiscard]] double deep() const { return rate > 0 ? speed / rate : std::numeric_limits<double>::infinity(); }
};

/// For the contacts of a step of `dt` seconds.
/// Source: Catto, Solver2D, 2024 (soft contacts).
/// @param parts  how often `dt` fits into the whole step: contacts are as soft as in the whole step, or resting bodies
/// would settle anew in each part
/// @param cycles  of a contact's spring in a sub-step: a load presses it in by their inverse square
[[nodiscard]] inline Softness soft_contacts(double push_out_speed, double dt, int sub_steps, double parts = 1,
                                            double cycles = 0.125) {
  constexpr double damping = 10;  // ratio
  // In shorter steps than this, overlap is removed more slowly, and in the end not at all: the shorter the step, the
  // greater the speed it needs, which would act like a blow, s.
  constexpr double unhurried = 1e-3;
  const double h = dt / sub_steps;
  const double turn = 2 * std::numbers::pi * cycles / parts;
  const double stiffness = turn * (2 * damping + turn);
  const double hurry = std::min(1.0, dt * parts / unhurried);
  return {hurry * hurry * turn / (h * (2 * damping + turn)), push_out_speed, stiffness / (1 + stiffness),
          1 / (1 + stiffness)};
}

/// Factor by which the impulses of a part of a step are enlarged when they are kept, so that whatever comes next starts
/// from those of a whole step. In very short parts rounding would be enlarged with them.
/// @param parts  how often the part fits into the whole
[[nodiscard]] inline double kept_as_whole(double parts) {
  constexpr double most = 8;
  return parts > most ? 1 : parts;
}

}  // namespace tweenfall::step
