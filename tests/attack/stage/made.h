#pragma once

// Stages with every kind of thing that a stage can hold, and what may be asked of them.

#include "attack/mutation.h"

#include <tweenfall/physics/stage/description.h>
#include <tweenfall/physics/stage/input.h>

namespace tweenfall::attack {

/// Numbers and names for one call: good ones or, if `odd`, some odd ones.
struct Arguments {
  Random& random;
  bool odd = false;
  bool misnames = false;  ///< whether names may be wrong

  [[nodiscard]] bool one_in(std::size_t count) const { return below(random, count) == 0; }
  [[nodiscard]] double number(double low, double high) const;
  [[nodiscard]] Vec3 vector(double size) const;
  /// `right`, or sometimes a name that nothing has, or that of something else.
  [[nodiscard]] std::string name(const std::string& right) const;
};

/// A floor, bodies that are free, keyed and driven, some below others, a clip with events that loops; and now and then
/// a graph, joints, forces, rules, a sensor, a vehicle, a rope or a cloth, and particles.
[[nodiscard]] StageDescription made_stage(Random& random);

[[nodiscard]] Shape made_shape(Random& random);
[[nodiscard]] NodeDescription made_node(const Arguments& arguments, const std::string& name);
[[nodiscard]] JointDescription made_joint(const Arguments& arguments, std::size_t a, std::size_t b);
[[nodiscard]] Rule made_rule(const Arguments& arguments, double time);
[[nodiscard]] TakeOver made_take_over(const Arguments& arguments);
[[nodiscard]] HandBack made_hand_back(const Arguments& arguments);
[[nodiscard]] OwnerChange made_change(const Arguments& arguments);
[[nodiscard]] PlayAction made_action(const Arguments& arguments);
[[nodiscard]] VehicleControl made_control(const Arguments& arguments);
[[nodiscard]] Input made_input(const Arguments& arguments);

}  // namespace tweenfall::attack
