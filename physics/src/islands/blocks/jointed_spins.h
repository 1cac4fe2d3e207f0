#pragma once

#include <optional>
#include <vector>

#include "forces/free_flight.h"
#include "state/body.h"

namespace tweenfall::blocks {

/// How the spins of jointed bodies change by themselves in a sub-step. Impulses act at its start, but the spin with
/// which the body goes through it is that of its middle: what they give turns along for half a sub-step. Without this
/// half, the axis of a gyroscope would sink, the faster the faster it spins.
/// Source: the composition of Strang, On the Construction and Comparison of Difference Schemes, SIAM Journal on
/// Numerical Analysis 5, 1968.
class JointedSpins {
 public:
  /// For this many bodies; none of them spins yet.
  void begin(std::size_t bodies) { spins_.assign(bodies, {}); }
  [[nodiscard]] bool empty() const { return spins_.empty(); }
  void clear() { spins_.clear(); }

  /// @return the angular velocity from the middle of the sub-step before to the middle of this one, world axes; for a
  /// body that turns too fast to be followed, its own, which then stays as it is
  [[nodiscard]] Vec3 begin_sub_step(std::size_t place, const state::Body& body, const forces::Load& load,
                                    const Quat& rotation, const Vec3& angular, double h);
  /// Does not follow this one in the sub-step.
  void leave(std::size_t place) { spins_[place].half = 0; }
  [[nodiscard]] bool follows(std::size_t place) const { return spins_[place].half > 0; }
  /// @return the angular velocity including what impulses gave since the start of the sub-step, turned along
  [[nodiscard]] Vec3 followed(std::size_t place, const state::Body& body, const Vec3& angular);
  /// @return the angular velocity after impulses at the end of a sub-step, which begin_sub_step then turns along
  /// for a whole one
  [[nodiscard]] Vec3 turned_back(std::size_t place, const state::Body& body, const Quat& rotation, const Vec3& before,
                                 const Vec3& after) const;

 private:
  struct Spin {
    double half = 0;            ///< half of a sub-step, s; 0: nothing is followed
    Quat rotation{1, 0, 0, 0};  ///< where impulses act
    Vec3 torque{0, 0, 0};       ///< body axes, as all below, N m
    std::optional<int> top;     ///< its axis, if it is a symmetric top without torque
    Vec3 at_impulse{0, 0, 0};   ///< rad/s
    Vec3 flown{0, 0, 0};        ///< at the end if nothing acts
    Vec3 bent{0, 0, 0};         ///< by how much the part from impulses has been turned along
  };
  [[nodiscard]] static Vec3 after_half(const Spin& spin, const state::Body& body, const Vec3& start);

  std::vector<Spin> spins_;  ///< by place
};

}  // namespace tweenfall::blocks
