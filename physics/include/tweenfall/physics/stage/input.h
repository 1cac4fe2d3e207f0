#pragma once

/// Outside input as values: what is asked of a stage from outside, each at its exact time, so that it can be kept and
/// given again. The same inputs at the same times give the same bits.

#include <tweenfall/anim/player.h>
#include <tweenfall/physics/handoff/rule.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tweenfall {

/// What a driver holds of a vehicle's script, from when it is told until it is told otherwise; what is absent stays
/// with who held it before: the driver, or the script.
struct VehicleControl {
  std::optional<double> throttle{};  ///< -1 to 1; what is beyond counts as these
  std::optional<double> brake{};     ///< 0 to 1
  std::optional<double> steer{};     ///< -1 to 1, to the left
};

namespace input {
/// A play is asked for something.
struct Ask {
  std::string play;  ///< its name, else that of its clip
  PlayAction action;
};
struct Release {
  std::string body;
  TakeOver settings = {};
};
struct Recover {
  std::string body;
  HandBack settings = {};
};
/// A body gets any owner, at once or along a ramp.
struct HandOver {
  std::string body;
  OwnerChange change = {};
};
struct Push {
  std::string body;
  Vec3 impulse{0, 0, 0};  ///< N s
  Vec3 point{0, 0, 0};    ///< world, m
};
/// A parameter of a graph is set.
struct Set {
  std::string graph;
  std::string parameter;
  double value = 0;  ///< of a flag: 0 or 1
};
/// An event is sent to a graph.
struct Send {
  std::string graph;
  std::string event;
};
/// A vehicle is driven from outside.
struct Control {
  std::string vehicle;
  VehicleControl control = {};
};
}  // namespace input

using Input = std::variant<input::Ask, input::Release, input::Recover, input::HandOver, input::Push, input::Set,
                           input::Send, input::Control>;

struct TimedInput {
  double time = 0;  ///< stage time, s
  Input what;
};

}  // namespace tweenfall
