#include "stage/roster/staged_softs.h"

#include <tweenfall/curves/hermite.h>
#include <tweenfall/curves/nearest_name.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stage/between.h"
#include "stage/whole_pose.h"

namespace tweenfall::staging {

namespace {

/// The nearest node above one that has a body; `no_node` for none.
NodeId carrier_of(const StageState& state, NodeId node) {
  for (NodeId i = node; i != no_node; i = (*state.nodes)[i].parent)
    if (state.body(i)) return i;
  return no_node;
}

void add_pin(StageState& state, WholePose& pose, const SoftDescription& described, const SoftPinDescription& pinned,
             SoftSettings& settings, std::vector<LedPin>& led) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument("its pin of node " + std::to_string(pinned.node) + ": " + why);
  };
  if (pinned.node >= settings.positions.size())
    refuse("there is none; its nodes are 0 to " + std::to_string(settings.positions.size() - 1));
  if (const auto* at = std::get_if<when::At>(&pinned.until); at && std::isnan(at->time))
    refuse("the time until which it holds must be a number");
  const Vec3& place = settings.positions[pinned.node];
  SoftPin pin{.node = pinned.node};
  if (pinned.to == no_node) {
    pin.point = pinned.point.value_or(place);
  } else {
    if (pinned.to >= state.nodes->size()) refuse("there is no node number " + std::to_string(pinned.to));
    const NodeId carrier = carrier_of(state, pinned.to);
    if (carrier != no_node && carrier != pinned.to)
      refuse("\"" + (*state.nodes)[pinned.to].name + "\" is carried by the body of \"" + (*state.nodes)[carrier].name +
             "\": pin it to that");
    if (const StagedBody* body = state.body(pinned.to)) {
      pin.body = body->id;
      pin.in_place = !pinned.point;
      pin.point = pinned.point.value_or(Vec3(0, 0, 0));
    } else {
      const WorldMotion& world = pose.authored(pinned.to);
      if (!(std::abs(world.linear.determinant()) > 1e-12) && !pinned.point)
        refuse("\"" + (*state.nodes)[pinned.to].name + "\" has a scale of 0; give the point on it");
      const Vec3 point =
          pinned.point ? *pinned.point : Vec3(world.linear.inverse() * (place - world.motion.pose.position));
      pin.point = world.point(point);
      led.push_back({{}, pinned.node, pinned.to, point});
    }
  }
  if (std::ranges::any_of(settings.pins, [&](const SoftPin& other) { return other.node == pin.node; }))
    refuse("another pin of " + described.name + " holds this node");
  settings.pins.push_back(pin);
}

/// When a pin lets go, in (from, to]; infinity if it does not.
double end_time_of(const StageState& state, const EndingPin& pin, double from, double to) {
  double time = infinity;
  if (const auto* at = std::get_if<when::At>(&pin.until)) time = at->time;
  if (const auto* event = std::get_if<when::Event>(&pin.until))
    time = event_time(*state.animation, {}, event->name, no_node, from, to);
  return time > from && time <= to ? time : infinity;
}

}  // namespace

void add_softs(StageState& state, const StageDescription& description, std::vector<StageFault>& faults) {
  auto softs = std::make_shared<StagedSofts>();
  WholePose pose(state, state.time, Side::out);
  for (std::size_t i = 0; i < description.softs.size(); ++i) {
    const SoftDescription& described = description.softs[i];
    const auto refuse = [&](const std::string& why) {
      faults.push_back({StageFault::Part::soft, i, "the soft body \"" + described.name + "\": " + why});
    };
    if (std::ranges::any_of(softs->list, [&](const auto& other) { return other.first == described.name; }))
      refuse("another one has this name");
    SoftSettings settings = described.soft;
    settings.pins.clear();
    std::vector<LedPin> led;
    try {
      for (const SoftPinDescription& pin : described.pins) add_pin(state, pose, described, pin, settings, led);
      const SoftId id = add_soft(state.world, settings);
      softs->list.emplace_back(described.name, id);
      softs->nodes.push_back(settings.positions.size());
      for (LedPin& pin : led) {
        pin.soft = id;
        softs->led.push_back(pin);
      }
      for (const SoftPinDescription& pin : described.pins)
        if (pin.until.index() != 0) softs->ending.push_back({described.name, id, pin.node, pin.to, pin.until});
    } catch (const std::invalid_argument& fault) {
      refuse(fault.what());
    }
  }
  state.softs = std::move(softs);
}

void lead_pins(StageState& state, WholePose& pose) {
  for (const LedPin& pin : state.softs->led) {
    const std::vector<SoftPinReading> pins = soft_pins(state.world, pin.soft);
    const auto holds = [&](const SoftPinReading& reading) {
      return reading.pin.node == pin.node && reading.pin.body == BodyId{};
    };
    if (std::ranges::none_of(pins, holds)) continue;
    if (!state.present[pin.to]) {
      unpin(state.world, pin.soft, pin.node);
      continue;
    }
    const WorldMotion& world = pose.authored(pin.to);
    lead_pin(state.world, pin.soft, pin.node, world.point(pin.point), world.point_velocity(pin.point));
  }
}

double next_pin_end(const StageState& state, double from, double to) {
  double next = infinity;
  for (const EndingPin& pin : state.softs->ending) next = std::min(next, end_time_of(state, pin, from, to));
  return next;
}

void end_pins(StageState& state, double from, std::vector<Happening>& happenings) {
  for (const EndingPin& pin : state.softs->ending) {
    const double time = end_time_of(state, pin, from, state.handled);
    if (!std::isfinite(time)) continue;
    unpin(state.world, pin.soft, pin.node);
    StageEvent event;
    event.time = std::max(0.0, time);
    event.name = "unpinned";
    event.data = "{\"node\": " + std::to_string(pin.node) + "}";
    if (pin.to != no_node) event.nodes.push_back(pin.to);
    event.joint = pin.name;
    happenings.push_back({event.time, event});
  }
}

void report_tears(const StageState& state, std::vector<Happening>& happenings) {
  for (const auto& [name, id] : state.softs->list)
    for (const SoftTear& tear : soft_tears(state.world, id)) {
      StageEvent event;
      event.time = std::min(tear.time, state.time);
      event.name = "torn";
      event.data = "{\"edge\": " + std::to_string(tear.edge) + ", \"at\": [" + number_text(tear.place.x()) + ", " +
                   number_text(tear.place.y()) + ", " + number_text(tear.place.z()) + "]}";
      event.joint = name;
      happenings.push_back({event.time, event});
    }
}

SoftNodes soft_nodes(const StageState& from, const StageState& to, std::string_view name, double time) {
  const auto found = std::ranges::find_if(to.softs->list, [&](const auto& soft) { return soft.first == name; });
  if (found == to.softs->list.end()) {
    std::vector<std::string> names;
    for (const auto& [known, id] : to.softs->list) names.push_back(known);
    const std::string nearest = nearest_name(name, names);
    throw std::invalid_argument("there is no soft body \"" + std::string(name) + "\"" +
                                (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  }
  const SoftId id = found->second;
  const bool between = is_between(from, to, time);
  const World& shown = between ? from.world : to.world;
  SoftNodes nodes;
  const auto start = soft_positions(shown, id), start_rates = soft_velocities(shown, id);
  const auto end = soft_positions(to.world, id), end_rates = soft_velocities(to.world, id);
  const double span = to.time - from.time, beyond = between ? 0 : time - to.time;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (between) {
      const Sample<Vec3> way =
          hermite::sample<Vec3>(start[i], start_rates[i], end[i], end_rates[i], span, (time - from.time) / span);
      nodes.positions.push_back(way.value);
      nodes.velocities.push_back(way.rate);
    } else {
      nodes.positions.push_back(start[i] + beyond * start_rates[i]);
      nodes.velocities.push_back(start_rates[i]);
    }
  }
  for (std::size_t i = 0; i < soft_settings(shown, id).edges.size(); ++i)
    nodes.torn.push_back(torn(shown, id, i) ? 1 : 0);
  return nodes;
}

}  // namespace tweenfall::staging
