#include <algorithm>

#include "planar/contacts/contact_solver.h"

namespace tweenfall::planar::inner {

namespace {

void turn_both(const ContactBlock& block, int lane, BodyRow* velocities, double impulse) {
  velocities[block.a[lane] / row_length].turn -= block.inverse_moment_a[lane] * impulse;
  velocities[block.b[lane] / row_length].turn += block.inverse_moment_b[lane] * impulse;
}

}  // namespace

void ContactSolver::warm_start_rolling() {
  for (const Rolling& rolling : rolling_)
    turn_both(blocks_[rolling.place / lane_count], static_cast<int>(rolling.place % lane_count), velocities_.data(),
              rolling.impulse);
}

/// A torque against the spin of b relative to a, at most the rolling friction times the force that presses them
/// together: Coulomb's law for spins. Source of the coefficient that is a length: Meriam and Kraige, Engineering
/// Mechanics: Statics, on rolling resistance.
void ContactSolver::resist_rolling() {
  for (Rolling& rolling : rolling_) {
    const ContactBlock& block = blocks_[rolling.place / lane_count];
    const int lane = static_cast<int>(rolling.place % lane_count);
    double pressing = 0;
    for (int i = 0; i < block.points; ++i) pressing += block.point[i].normal[lane];
    const double spin = velocities_[block.b[lane] / row_length].turn - velocities_[block.a[lane] / row_length].turn;
    const double limit = rolling.friction * pressing;
    const double next = std::clamp(rolling.impulse - rolling.mass * spin, -limit, limit);
    turn_both(block, lane, velocities_.data(), next - rolling.impulse);
    rolling.impulse = next;
  }
}

}  // namespace tweenfall::planar::inner
