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

/// What a driver takes over from the script of a vehicle, until a later control changes it. An absent value stays with
/// whoever held it before: the driver, or the script.
struct VehicleControl {
  std::optional<double> throttle{};  ///< -1 to 1; values beyond are clamped
  std::optional<double> brake{};     ///< 0 to 1
  std::optional<double> steer{};     ///< -1 to 1, to the left
};

namespace input {
/// Asks a play for something.
struct Ask {
  std::string play;  ///< name of the play, or else of its clip
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
/// Gives a body to any owner, at once or along a ramp.
struct HandOver {
  std::string body;
  OwnerChange change = {};
};
struct Push {
  std::string body;
  Vec3 impulse{0, 0, 0};  ///< N s
  Vec3 point{0, 0, 0};    ///< world, m
};
/// Sets a parameter of a graph.
struct Set {
  std::string graph;
  std::string parameter;
  double value = 0;  ///< for a flag: 0 or 1
};
/// Sends an event to a graph.
struct Send {
  std::string graph;
  std::string event;
};
/// Drives a vehicle from outside.
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
  /// Of the blows that fall at this time, each in its turn, how many come before it: what is asked for in a callback
  /// may come between two of them.
  int after_blows = 0;
};

}  // namespace tweenfall
