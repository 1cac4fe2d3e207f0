#pragma once

// The fields of everything else in a stage, each listed once.

#include "stage/saving/described_fields.h"

namespace tweenfall::saving {

template <>
inline constexpr int last_of<EventKind> = static_cast<int>(EventKind::end);
template <>
inline constexpr int last_of<LoopMode> = static_cast<int>(LoopMode::pingpong);
template <>
inline constexpr int last_of<Fill> = static_cast<int>(Fill::both);

// Changes

template <Is<staging::change::None> T, class Visit>
void each_field(T&, const Visit&) {}

template <class T, class Visit>
requires Is<T, staging::change::Release> || Is<T, staging::change::Recover> || Is<T, staging::change::HandOver>
void each_field(T& change, const Visit& visit) {
  auto& [node, settings] = change;
  visit.places(node);
  visit(settings);
}

template <class T, class Visit>
requires Is<T, staging::change::Arm> || Is<T, staging::change::Add> || Is<T, staging::change::Join> ||
    Is<T, staging::change::Part>
void each_field(T& change, const Visit& visit) {
  auto& [what] = change;
  visit(what);
}

template <Is<staging::change::Remove> T, class Visit>
void each_field(T& change, const Visit& visit) {
  auto& [node] = change;
  visit.places(node);
}

template <Is<staging::change::Push> T, class Visit>
void each_field(T& change, const Visit& visit) {
  auto& [node, impulse, point] = change;
  visit.places(node);
  visit(impulse, point);
}

template <Is<staging::change::Ignore> T, class Visit>
void each_field(T& change, const Visit& visit) {
  auto& [a, b, ignored] = change;
  visit.places(a, b);
  visit(ignored);
}

template <Is<Ease> T, class Visit>
void each_field(T& ease, const Visit& visit) {
  std::string word = ease.name();
  visit(word);
  if constexpr (!std::is_const_v<T>) {
    const std::optional<Ease> named = Ease::named(word);
    if (!named) throw std::invalid_argument("a saved stage has an unknown ease \"" + word + "\"");
    ease = *named;
  }
}

template <Is<Loop> T, class Visit>
void each_field(T& loop, const Visit& visit) {
  auto& [mode, count] = loop;
  visit(mode, count);
}

template <Is<Fade> T, class Visit>
void each_field(T& fade, const Visit& visit) {
  auto& [seconds, ease] = fade;
  visit(seconds, ease);
}

template <Is<PlayKey> T, class Visit>
void each_field(T& key, const Visit& visit) {
  auto& [time, value, ease] = key;
  visit(time, value, ease);
}

template <Is<playing::Start> T, class Visit>
void each_field(T& start, const Visit& visit) {
  auto& [clip, from, to, offset, reverse, loop, speed, weight, fade_in, fade_out, mask, fill] = start;
  visit(clip, from, to, offset, reverse, loop, speed, weight, fade_in, fade_out, mask, fill);
}

template <class T, class Visit>
requires Is<T, playing::Stop> || Is<T, playing::FadeTo>
void each_field(T& fade, const Visit& visit) {
  if constexpr (Is<T, playing::FadeTo>) visit(fade.weight);
  bool says_how = fade.ease.has_value();
  Ease ease = fade.ease.value_or(Ease::linear());
  visit(fade.seconds, says_how, ease);
  if constexpr (!std::is_const_v<T>) fade.ease = says_how ? std::optional(ease) : std::nullopt;
}

template <Is<playing::Weigh> T, class Visit>
void each_field(T& weigh, const Visit& visit) {
  auto& [weight] = weigh;
  visit(weight);
}

template <Is<playing::SetSpeed> T, class Visit>
void each_field(T& set, const Visit& visit) {
  auto& [speed, seconds] = set;
  visit(speed, seconds);
}

template <Is<playing::Seek> T, class Visit>
void each_field(T& seek, const Visit& visit) {
  auto& [time, events, fade] = seek;
  visit(time, events, fade);
}

template <Is<staging::change::Ask> T, class Visit>
void each_field(T& ask, const Visit& visit) {
  auto& [play, action] = ask;
  visit(play, action);
}

template <Is<staging::change::Tell> T, class Visit>
void each_field(T& tell, const Visit& visit) {
  auto& [graph, name, value] = tell;
  visit(graph, name, value);
}

template <Is<VehicleControl> T, class Visit>
void each_field(T& control, const Visit& visit) {
  auto& [throttle, brake, steer] = control;
  visit(throttle, brake, steer);
}

template <Is<staging::change::Control> T, class Visit>
void each_field(T& told, const Visit& visit) {
  auto& [vehicle, control] = told;
  visit(vehicle, control);
}

template <Is<staging::Command> T, class Visit>
void each_field(T& command, const Visit& visit) {
  auto& [time, change, at_once] = command;
  visit(time, change, at_once);
}

// What happened

template <Is<StageEvent> T, class Visit>
void each_field(T& event, const Visit& visit) {
  auto& [time, name, data, nodes, impulse, joint, kind] = event;
  visit(time, name, data, impulse, joint, kind);
  constexpr std::size_t most = 2;
  auto count = static_cast<std::uint8_t>(nodes.size());
  visit(count);
  if constexpr (!std::is_const_v<T>) nodes.resize(std::min<std::size_t>(count, most));
  for (auto& node : nodes) visit.places(node);
}

template <Is<HandOff> T, class Visit>
void each_field(T& handoff, const Visit& visit) {
  auto& [node, from, to, time, cause, before, after] = handoff;
  visit.places(node);
  visit(from, to, time, cause, before, after);
}

template <Is<staging::Happening> T, class Visit>
void each_field(T& happening, const Visit& visit) {
  auto& [time, what] = happening;
  visit(time, what);
}

// What changes while it runs

template <Is<QuinticDecay> T, class Visit>
void each_field(T& decay, const Visit& visit) {
  auto& [coefficients, duration] = decay;
  for (auto& coefficient : coefficients) visit(coefficient);
  visit(duration);
}

template <Is<SpringDecay> T, class Visit>
void each_field(T& decay, const Visit& visit) {
  auto& [offset, rate, half_life] = decay;
  visit(offset, rate, half_life);
}

template <Is<ClockOverride> T, class Visit>
void each_field(T& clock, const Visit& visit) {
  auto& [stage, timeline, clip, starts_by] = clock;
  visit(stage, timeline, starts_by);
  visit.places(clip);
}

/// The private fields of paths.
struct PathFields {
  template <class T, class Visit>
  static void of_offset(T& offset, const Visit& visit) {
    visit(offset.settle_, offset.start_, offset.any_, offset.body_, offset.quintic_, offset.spring_);
    for (auto& [value, rate] : offset.extrapolated_) visit(value, rate);
  }
  template <class T, class Visit>
  static void of_path(T& path, const Visit& visit) {
    visit(path.since_, path.clock_, path.anchor_);
    if constexpr (std::is_const_v<T>) {
      of_offset(path.settle(), visit);
    } else {
      SettleOffset settle = path.settle();
      of_offset(settle, visit);
      path.settle_ = std::make_shared<const SettleOffset>(settle);
    }
    bool has_above = path.above_ != nullptr;
    visit(has_above);
    if constexpr (!std::is_const_v<T>)
      if (!has_above) path.above_ = nullptr;
    if (!has_above) return;
    std::size_t node = path.above_ ? path.above_->node_ : 0;
    visit.places(node);
    if constexpr (std::is_const_v<T>) {
      of_path(*path.above_, visit);
    } else {
      const Hierarchy& nodes = path.animation_->nodes();
      std::size_t up = nodes[path.node_].parent;
      while (up != no_node && up != node) up = nodes[up].parent;
      if (up == no_node) throw std::invalid_argument("a saved stage has a bad path: it settles along one not above it");
      Path above(path.animation_, node);
      of_path(above, visit);
      path.above_ = std::make_shared<const Path>(std::move(above));
    }
  }
};

template <Is<SettleOffset> T, class Visit>
void each_field(T& offset, const Visit& visit) {
  PathFields::of_offset(offset, visit);
}

template <Is<staging::SizeOffset> T, class Visit>
void each_field(T& offset, const Visit& visit) {
  auto& [settle, start, any, shown, rate, quintic, spring] = offset;
  visit(settle, start, any, shown, rate, quintic, spring);
}

template <Is<staging::SettlingNode> T, class Visit>
void each_field(T& settling, const Visit& visit) {
  auto& [node, offset, size] = settling;
  visit.places(node);
  visit(offset, size);
}

template <Is<WorldMotion> T, class Visit>
void each_field(T& world, const Visit& visit) {
  auto& [linear, linear_rate, motion] = world;
  visit(linear, linear_rate, motion);
}

template <Is<staging::Ramp> T, class Visit>
void each_field(T& ramp, const Visit& visit) {
  auto& [from, to, start, seconds, settle] = ramp;
  visit(from, to, start, seconds, settle);
}

template <Is<staging::ComingChange> T, class Visit>
void each_field(T& coming, const Visit& visit) {
  auto& [rule, place, due] = coming;
  visit.places(rule, place);
  visit(due);
}

template <Is<staging::StagedBody> T, class Visit>
void each_field(T& body, const Visit& visit) {
  auto& [node, id, path, released_at, shown, present, below, drive, surface, saturated_for, by_track, size, ramp,
         coming] = body;
  follows_from_others(node, id, present, drive, surface);
  PathFields::of_path(path, visit);
  WorldMotion left = *shown;
  visit(released_at, left, saturated_for, by_track, ramp, coming);
  if constexpr (!std::is_const_v<T>) shown = std::make_shared<const WorldMotion>(left);
  auto own = size ? *size : staging::SizeOffset{};
  visit(own);
  if constexpr (!std::is_const_v<T>) size = own.any ? std::make_shared<const staging::SizeOffset>(own) : nullptr;
  auto settling = below ? *below : std::vector<staging::SettlingNode>{};
  visit(settling);
  if constexpr (!std::is_const_v<T>)
    below =
        settling.empty() ? nullptr : std::make_shared<const std::vector<staging::SettlingNode>>(std::move(settling));
}

template <Is<staging::Attempt> T, class Visit>
void each_field(T& attempt, const Visit& visit) {
  auto& [fired, waited, touched, impulse, speed, still, saturated, error] = attempt;
  visit(fired, waited, touched, impulse, speed, still, saturated, error);
}

template <Is<staging::ArmedRule> T, class Visit>
void each_field(T& armed, const Visit& visit) {
  auto& [body, rule, latched, done, was_true, gone, vetoed, attempt] = armed;
  follows_from_others(body, rule, gone);
  for (auto& one : latched) visit(one);
  visit(done, was_true, vetoed, attempt);
}

template <Is<staging::Blow> T, class Visit>
void each_field(T& blow, const Visit& visit) {
  auto& [a, b, met, began, impulse, speed] = blow;
  visit(a, b, met, began, impulse, speed);
}

template <Is<std::pair<BodyId, BodyId>> T, class Visit>
void each_field(T& pair, const Visit& visit) {
  visit(pair.first, pair.second);
}

template <Is<staging::Strain> T, class Visit>
void each_field(T& strain, const Visit& visit) {
  auto& [a, b, since, told] = strain;
  visit(a, b, since, told);
}

template <Is<staging::Squeeze> T, class Visit>
void each_field(T& squeeze, const Visit& visit) {
  auto& [body, last] = squeeze;
  visit(body, last);
}

template <Is<staging::Tear> T, class Visit>
void each_field(T& tear, const Visit& visit) {
  auto& [joint, since, told] = tear;
  visit.places(joint);
  visit(since, told);
}

template <Is<WheelReading> T, class Visit>
void each_field(T& reading, const Visit& visit) {
  auto& [touches, length, spin, angle, load, slip, point, force, steer] = reading;
  visit(touches, length, spin, angle, load, slip, point, force, steer);
}

template <Is<staging::StagedVehicle> T, class Visit>
void each_field(T& staged, const Visit& visit) {
  follows_from_others(staged.described);
  auto readings = staged.vehicle.readings();
  visit(readings, staged.control);
  if constexpr (!std::is_const_v<T>) staged.vehicle.restore(std::move(readings));
}

/// The private fields of particles.
struct ParticleFields {
  template <class T, class Visit>
  static void of(T& p, const Visit& visit) {
    visit(p.time_, p.emitted_, p.left_out_, p.by_hand_);
    visit(p.x_, p.y_, p.z_, p.vx_, p.vy_, p.vz_, p.born_, p.dies_, p.number_);
    for (auto& source : p.sources_) visit(source.number, source.emitter.end);
    if constexpr (!std::is_const_v<T>) {
      const std::size_t count = p.x_.size();
      for (const auto* list : {&p.y_, &p.z_, &p.vx_, &p.vy_, &p.vz_, &p.born_, &p.dies_})
        if (list->size() != count) throw std::invalid_argument("a saved stage has a bad list of particles");
      if (p.number_.size() != count || count > p.settings_.most)
        throw std::invalid_argument("a saved stage has a bad list of particles");
    }
  }
};

template <Is<staging::StagedParticles> T, class Visit>
void each_field(T& staged, const Visit& visit) {
  follows_from_others(staged.described);
  ParticleFields::of(staged.particles, visit);
}

template <Is<staging::StagedJoint> T, class Visit>
void each_field(T& joint, const Visit& visit) {
  auto& [name, id, a, b, until] = joint;
  visit(name, id);
  visit.places(a, b);
  visit(until);
}

}  // namespace tweenfall::saving
