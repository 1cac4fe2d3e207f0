#pragma once

#include "forces/free_flight.h"

namespace tweenfall::islands {

/// A body through a sub-step: at its start, before the rebound, and now.
struct BodyCourse {
  Twist start, before, after;
  Vec3 start_center, center;
  Quat start_rotation, rotation;
};

/// Energy of an island through a sub-step, J: a rebound must not leave it with more than it had and was given.
struct IslandEnergy {
  double limit = 0;                              ///< what it may have afterwards: what it had, plus the work done on it
  double without = 0, slope = 0, curvature = 0;  ///< kinetic, by the share of the rebound let through

  void add(const state::Body& body, const forces::Load& load, const BodyCourse& course);
  /// Adds a body with the same moment about every axis, on which `work` was done, J.
  void add(double mass, double moment, const Twist& start, const Twist& before, const Twist& after, double work);
  /// The greatest share of the rebound that stays within the limit.
  [[nodiscard]] double share_within() const;
};

}  // namespace tweenfall::islands
