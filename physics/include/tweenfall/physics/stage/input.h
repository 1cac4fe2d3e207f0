#pragma once

/// Outside input as values: what is asked of a stage from outside, each at its exact time, so that it can be kept and
/// given again. The same inputs at the same times give the same bits.

#include <tweenfall/anim/player.h>
#include <tweenfall/physics/handoff/rule.h>

#include <string>
#include <variant>
#include <vector>

namespace tweenfall {

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
}  // namespace input

using Input = std::variant<input::Ask, input::Release, input::Recover, input::Push, input::Set, input::Send>;

struct TimedInput {
  double time = 0;  ///< stage time, s
  Input what;
};

}  // namespace tweenfall
