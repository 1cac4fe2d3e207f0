#pragma once

// What a caller may change on a stage, as values: so that going back finds the changes again, and saving keeps them.

#include <tweenfall/physics/stage/description.h>
#include <tweenfall/physics/stage/input.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tweenfall::staging {

struct StageState;
struct Happening;

namespace change {
struct None {};  ///< only an instant
struct Release {
  std::size_t node = no_node;
  TakeOver settings = {};
};
struct Recover {
  std::size_t node = no_node;
  HandBack settings = {};
};
struct HandOver {
  std::size_t node = no_node;
  OwnerChange change = {};
};
struct Arm {
  Rule rule;
};
struct Add {
  NodeDescription node;
};
struct Remove {
  std::size_t node = no_node;
};
struct Push {
  std::size_t node = no_node;
  Vec3 impulse{0, 0, 0};  ///< N s
  Vec3 point{0, 0, 0};    ///< world
};
struct Join {
  JointDescription joint;
};
struct Part {
  std::string joint;
};
struct Ignore {
  std::size_t a = no_node, b = no_node;
  bool ignored = true;  ///< false: they meet again
};
/// Asks a play for something.
struct Ask {
  std::string play;
  PlayAction action;
};
/// Sends something to a graph.
struct Tell {
  std::string graph;
  std::string name;               ///< of a parameter, or of an event
  std::optional<double> value{};  ///< absent: the event is sent
};
/// Drives a vehicle.
struct Control {
  std::string vehicle;
  VehicleControl control = {};
};
}  // namespace change

using Change = std::variant<change::None, change::Release, change::Recover, change::HandOver, change::Arm, change::Add,
                            change::Remove, change::Push, change::Join, change::Part, change::Ignore, change::Ask,
                            change::Tell, change::Control>;

/// A change at an exact time. If it throws, it has changed nothing.
struct Command {
  double time = 0;
  Change change;
  int at_once = 0;  ///< of the blows that fall at its time, how many have fallen when it is made
};

/// @param step  of the stage, s
/// @throws std::invalid_argument for an impossible change
void make_change(StageState& state, const Command& command, double step, std::vector<Happening>& happenings);

/// Whether the change affects who is on the stage and which rules wait for whom, which follows from changes alone and
/// not from how anything moves.
[[nodiscard]] bool is_of_cast(const Change& change);

}  // namespace tweenfall::staging
