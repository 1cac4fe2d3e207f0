#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <array>

#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

/// Whether a clip that counts has an event of this name. @param body  if given, only plays that move its node count
bool has_event(const Animation& animation, const std::string& name, const StagedBody* body) {
  bool any = false;
  animation.for_each_play(
      body ? body->path.clock() : ClockOverride{}, body ? body->node : no_node, [&](const RunningPlay& play) {
        any = any || std::ranges::find(play.clip->events, name, &ClipEvent::name) != play.clip->events.end();
      });
  return any;
}

struct Reason {
  const StageState& state;
  const StagedBody& body;
  const Attempt& attempt;

  std::string operator()(const when::At& at) const {
    if (at.time > state.handled)
      return brief_text(at.time) + " s lies beyond the end of the run, " + brief_text(state.time) + " s";
    return "at " + brief_text(at.time) + " s the body was where the rule would take it, or the rule came later";
  }
  std::string operator()(const when::Marker& marker) const {
    if (!has_event(body.path.animation(), marker.name, &body))
      return "no playing clip that moves the body has an event \"" + marker.name + "\"";
    return "the event \"" + marker.name + "\" did not come while it waited";
  }
  std::string operator()(const when::Event& event) const {
    if (!has_event(*state.animation, event.name, nullptr)) return "no playing clip has an event \"" + event.name + "\"";
    return "the event \"" + event.name + "\" did not come while it waited";
  }
  std::string operator()(const when::ClipEnd&) const { return "no clip that moves the body ended while it waited"; }
  std::string operator()(const when::SpeedPeak&) const {
    return "the speed on the body's path had no peak while it waited";
  }
  std::string operator()(const when::ContactHit& hit) const {
    const std::string what = hit.with.empty() ? "nothing" : "nothing named \"" + hit.with + "\"";
    if (!attempt.touched) return what + " touched the body";
    return "the greatest blow was " + brief_text(attempt.impulse) + " N s at " + brief_text(attempt.speed) +
           " m/s; it waits for " + brief_text(hit.impulse) + " N s at " + brief_text(hit.speed) + " m/s";
  }
  std::string operator()(const when::Asleep& asleep) const {
    return "it was free and still for " + brief_text(attempt.still) + " s at most; the rule waits for " +
           brief_text(asleep.seconds) + " s";
  }
  std::string operator()(const when::Enter& enter) const {
    return (enter.who.empty() ? "the body" : "nothing named \"" + enter.who + "\"") +
           std::string(enter.who.empty() ? " did not come" : " came") + " into \"" + enter.region +
           "\" while it waited";
  }
  std::string operator()(const when::Leave& leave) const {
    return (leave.who.empty() ? "the body" : "nothing named \"" + leave.who + "\"") +
           std::string(leave.who.empty() ? " did not leave" : " left") + " \"" + leave.region + "\" while it waited";
  }
  std::string operator()(const when::Saturated& saturated) const {
    return "its drive was at its limit for " + brief_text(attempt.saturated) + " s at most; the rule waits for " +
           brief_text(saturated.seconds) + " s";
  }
  std::string operator()(const when::Error& error) const {
    return "it was " + brief_text(attempt.error) + " m from its path at most; the rule waits for " +
           brief_text(error.distance) + " m";
  }
};

}  // namespace

std::vector<UnfiredRule> unfired_rules(const StageState& state) {
  std::vector<UnfiredRule> unfired;
  for (const ArmedRule& armed : state.armed) {
    if (armed.gone) continue;
    const StagedBody& body = state.bodies[armed.body];
    if (armed.attempt.fired) {
      if (body.coming && body.coming->rule == armed.rule)
        unfired.push_back({armed.rule, body.node,
                           "its next change is due at " + brief_text(body.coming->due) +
                               " s, which lies beyond the end of the run, " + brief_text(state.time) + " s"});
      continue;
    }
    const Rule& rule = *state.rules[armed.rule];
    std::string reason;
    if (!armed.attempt.waited) {
      constexpr std::array owners = {"keyed", "driven", "free"};
      reason = std::string("the body was ") + owners[static_cast<std::size_t>(rule.to.owner())] +
               " all the time, which is what the rule makes it";
    } else {
      // With `all`, triggers that came while the rule waited are not what it lacked.
      const bool some_lacked = rule.when.all && std::ranges::count(armed.latched, char{0}) > 0;
      for (std::size_t i = 0; i < rule.when.triggers.size(); ++i)
        if (!some_lacked || !armed.latched[i])
          reason +=
              (reason.empty() ? "" : "; ") + std::visit(Reason{state, body, armed.attempt}, rule.when.triggers[i]);
    }
    unfired.push_back({armed.rule, body.node, std::move(reason)});
  }
  return unfired;
}

}  // namespace tweenfall::staging
