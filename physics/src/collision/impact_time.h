#pragma once

#include <optional>

#include "forces/free_flight.h"

namespace tweenfall::collision {

/// Where a body would be some time after the start of a step if nothing touched it.
struct Prediction {
  Vec3 center;
  Quat rotation;
  [[nodiscard]] Pose node(const state::Body& body) const;
};

/// A body's path through the step: keyed bodies along their displacement, free ones under their load.
struct Course {
  const state::Body* body = nullptr;
  const Shape* shape = nullptr;  ///< of the body, or a part of it
  Vec3 linear{0, 0, 0};
  Vec3 angular{0, 0, 0};
  Vec3 acceleration{0, 0, 0};
  double swing = 0;  ///< greatest speed of a surface point along any direction due to the body's spin, m/s
  [[nodiscard]] Prediction at(double time) const;
};

/// Shapes nearer than this have met, m.
constexpr double hair = 1e-7;

[[nodiscard]] Course course_of(const state::Body& body, const forces::Load& load, double dt);

/// Whether shapes with this gap along a unit direction stay apart along it by more than two hairs from a time
/// until `dt`.
[[nodiscard]] bool stay_apart(const Course& a, const Course& b, const Vec3& direction, double gap, double from,
                              double dt);

/// The time in (0, dt] at which two separated shapes first get nearer than `near`, by conservative advancement: no
/// step is longer than the gap divided by the greatest speed at which it can close.
/// @param apart  a direction along which they are apart at the start, if one is known
/// Source: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, chapter 2.
/// @return nothing when they do not meet
[[nodiscard]] std::optional<double> impact_time(const Course& a, const Course& b, double dt, double near = hair,
                                                const Vec3& apart = Vec3(0, 0, 0));

}  // namespace tweenfall::collision
