#pragma once

#include "forces/free_flight.h"

namespace tweenfall::islands {

/// A body through a sub-step: at its start, before the rebound, and now.
struct BodyCourse {
  Twist start, before, after;
  Vec3 start_center, center;
  Quat start_rotation, rotation;
};

/// Energy of an island through a sub-step, J: a rebound must not leave it more than it had and than was put into it.
struct IslandEnergy {
  double limit = 0;                              ///< what it may have after: what it had, and the work done on it
  double without = 0, slope = 0, curvature = 0;  ///< kinetic, by the share of the rebound that is let through

  void add(const state::Body& body, const forces::Load& load, const BodyCourse& course);
  /// Of a body with the same moment about every axis: `work` was done on it, J.
  void add(double mass, double moment, const Twist& start, const Twist& before, const Twist& after, double work);
  /// The greatest share of the rebound that stays within the limit.
  [[nodiscard]] double share_within() const;
};

}  // namespace tweenfall::islands
