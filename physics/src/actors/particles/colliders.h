#pragma once

#include <vector>

#include "actors/particles/block.h"
#include "pairs/bounds_tree.h"

namespace tweenfall::particles {

/// The bodies of a world that turn particles back, as they are at the end of a step.
class Colliders {
 public:
  Colliders(const World& world, double dt, double radius, double restitution, double friction);
  [[nodiscard]] bool empty() const { return bodies_.empty() && planes_.empty(); }

  /// Changes the ends of paths that lead into bodies.
  /// @param dt  until the end of the step
  void turn_back(std::size_t count, double dt, const Lists& from, const Lists& with, Lists& places,
                 Lists& speeds) const;

 private:
  struct Collider {
    const Shape* shape;
    Pose pose;
    Vec3 center;
    Twist twist;  ///< at the center
    double restitution, friction;

    [[nodiscard]] Vec3 velocity_at(const Vec3& place) const {
      return twist.linear + twist.angular.cross(place - center);
    }
  };
  struct Way {
    Vec3 from, with, acceleration;
    double dt;  ///< time left

    [[nodiscard]] Vec3 place(double t) const { return from + t * with + 0.5 * t * t * acceleration; }
    [[nodiscard]] Vec3 velocity(double t) const { return with + t * acceleration; }
  };
  struct Meeting {
    const Collider* with = nullptr;
    double time = 0;
    Vec3 normal{0, 1, 0};
    double depth = 0;  ///< overlap from the start, m
  };

  [[nodiscard]] bool near(const Bounds& bounds) const;
  [[nodiscard]] Meeting first_meeting(const Way& way) const;
  void meet(const Collider& body, const Way& way, Meeting& first) const;
  /// @return whether the particle moves on after it
  bool answer(const Meeting& meeting, Way& way) const;

  std::vector<Collider> bodies_, planes_;
  pairs::BoundsTree tree_;
  double radius_, restitution_, friction_;
};

}  // namespace tweenfall::particles
