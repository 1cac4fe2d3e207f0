// Going forward and back, saving and loading, and callbacks on the way.

#include "attack/stage/calls.h"

#include <stdexcept>

namespace tweenfall::attack {

namespace {

/// A long advance is refused or takes its time: it must not happen here.
bool takes_long(double seconds) {
  return seconds > 10 && seconds < 1e9;
}

void advance(Caller& caller) {
  const double seconds = caller.arguments.number(0, 0.05);
  if (!takes_long(seconds)) caller.stage.advance(seconds);
}

void advance_to(Caller& caller) {
  const double seconds = caller.arguments.number(0, 0.05);
  if (!takes_long(seconds)) caller.stage.advance_to(caller.stage.time() + seconds);
}

void seek(Caller& caller) {
  const double time = caller.arguments.number(0, 1);
  if (!takes_long(time)) caller.stage.seek(time);
}

/// Goes back, and to where it was.
void seek_there(Caller& caller) {
  const double time = caller.stage.time();
  const std::uint64_t hash = caller.stage.state_hash();
  caller.stage.seek(caller.random.between(0, time));
  caller.stage.seek(time);
  caller.require(caller.stage.state_hash() == hash, "back and forth it comes to other bits");
}

void save_and_load(Caller& caller) {
  const std::uint64_t hash = caller.stage.state_hash();
  const std::vector<std::byte> saved = caller.stage.save();
  if (caller.arguments.one_in(2)) {
    caller.stage.load(saved);
  } else {
    Stage other(caller.description);
    other.load(saved);
    caller.stage = std::move(other);
  }
  caller.require(caller.stage.state_hash() == hash, "loaded it has other bits");
}

void load_damaged(Caller& caller) {
  const std::vector<std::byte> saved = caller.stage.save();
  std::string bytes(reinterpret_cast<const char*>(saved.data()), saved.size());
  mutate_bytes(caller.random, bytes);
  caller.stage.load(std::as_bytes(std::span(bytes)));
}

void move_away(Caller& caller) {
  Stage other(std::move(caller.stage));
  try {
    caller.stage.advance(0.1);
    caller.fault = "a stage that was moved from goes on";
  } catch (const std::logic_error&) {
  }
  caller.stage = std::move(other);
}

/// What a caller does inside of a callback: changes, queries, and forbidden calls.
void answer(Caller& caller, NodeId node) {
  const std::size_t answer = below(caller.random, 6);
  if (caller.log) *caller.log << "  told at " << caller.stage.time() << ": answer " << answer << '\n';
  try {
    switch (answer) {
      case 0:
        caller.stage.apply_impulse(node, Vec3(0, 1e-3, 0), Vec3(0, 0, 0));
        break;
      case 1:
        caller.stage.release(node);
        break;
      case 2:
        (void)caller.stage.world(node);
        break;
      case 3:
        (void)caller.stage.add({.name = "told" + std::to_string(caller.added++)});
        break;
      case 4:
        caller.stage.seek(0);
        caller.fault = "a callback sought";
        break;
      default:
        caller.stage.on_event({});
    }
  } catch (const std::logic_error&) {
  }
}

void on_event(Caller& caller) {
  caller.stage.on_event(
      [&caller](const StageEvent& event) { answer(caller, event.nodes.empty() ? 0 : event.nodes[0]); });
}

void on_contact(Caller& caller) {
  caller.stage.on_contact([&caller](const StageEvent& event) { answer(caller, event.nodes.at(0)); });
}

void on_handoff(Caller& caller) {
  caller.stage.on_handoff([&caller](const HandOff& handoff) { answer(caller, handoff.node); });
}

}  // namespace

std::span<const Call> calls_of_time() {
  static constexpr Call list[] = {{"advance", 24, advance},
                                  {"advance_to", 10, advance_to},
                                  {"seek", 4, seek},
                                  {"seek back and forth", 1, seek_there},
                                  {"save and load", 2, save_and_load},
                                  {"load what is damaged", 1, load_damaged},
                                  {"move", 1, move_away},
                                  {"on_event", 1, on_event},
                                  {"on_contact", 1, on_contact},
                                  {"on_handoff", 1, on_handoff}};
  return list;
}

}  // namespace tweenfall::attack
