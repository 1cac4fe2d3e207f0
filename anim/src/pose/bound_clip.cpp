#include "pose/bound_clip.h"

#include "clip/landing.h"
#include "pose/clip_values.h"

#include <tweenfall/anim/component.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <tuple>

namespace tweenfall::pose {
namespace {

template <class T>
const T* required(const Track& track, const Clip& clip, const char* expected, std::string& problems) {
  if (const T* curve = std::get_if<T>(&track.curve)) return curve;
  problems += "\n  clip \"" + clip.name + "\": track \"" + track.name() + "\" must carry " + expected;
  return nullptr;
}

void set_part(BoundClip::Entry& entry, Parts part, bool present, bool relative) {
  entry.parts = static_cast<Parts>(present ? entry.parts | part : entry.parts & ~part);
  entry.relative = static_cast<Parts>(present && relative ? entry.relative | part : entry.relative & ~part);
}

}  // namespace

/// The tracks of one node, while they are collected.
class BoundClip::Binding {
 public:
  explicit Binding(std::size_t node) { entry.node = node; }

  void bind(const Track& track, const Clip& clip, std::string& problems) {
    if (const std::optional<Component> component = component_named(track.property)) {
      bind_component(track, *component, clip, problems);
      return;
    }
    switch (property_named(track.property)) {
      case Property::position:
        curves.position = required<Curve<Vec3>>(track, clip, "vectors", problems);
        set_part(entry, position_part, curves.position != nullptr, track.relative);
        break;
      case Property::rotation:
        curves.rotation = required<Curve<Quat>>(track, clip, "rotations", problems);
        set_part(entry, rotation_part, curves.rotation != nullptr, track.relative);
        break;
      case Property::scale:
        curves.scale = required<Curve<Vec3>>(track, clip, "vectors", problems);
        set_part(entry, scale_part, curves.scale != nullptr, track.relative);
        break;
      case Property::color:
        entry.color = required<Curve<Color>>(track, clip, "colors", problems);
        break;
      case Property::weights:
        entry.weights = required<WeightCurves>(track, clip, "weights", problems);
        break;
      case Property::user:
        break;
    }
  }

  /// Merges the angles into one rotation, and computes the gain per loop.
  void complete(const Clip& clip, const Pose& rest) {
    if (angles_[0] || angles_[1] || angles_[2]) {
      turned_ = turned_by(angles_, rest.rotation);
      curves.rotation = &*turned_;
    }
    if (!std::isfinite(clip.duration)) return;
    if (const Curve<Vec3>* curve = curves.position)
      entry.gain = curve->value(clip.duration, Side::in) - curve->value(0.0);
    if (const Curve<Quat>* curve = curves.rotation)
      entry.turn = log_map(curve->value(clip.duration, Side::in) * curve->value(0.0).conjugate());
    for (const Number& number : numbers)
      if (!number.of_scale)
        entry.gain[number.index] = number.curve->value(clip.duration, Side::in) - number.curve->value(0.0);
  }

  Entry entry{};
  MotionCurves::Parts curves;
  std::vector<Number> numbers;

 private:
  void bind_component(const Track& track, Component component, const Clip& clip, std::string& problems) {
    const auto* curve = required<Curve<double>>(track, clip, "numbers", problems);
    if (!curve) return;
    const auto index = static_cast<std::size_t>(component.index);
    if (component.property == Property::color) {
      entry.tints[index] = curve;
    } else if (component.property == Property::rotation) {
      if (!is_of_three_axes(track.order)) {
        problems += "\n  clip \"" + clip.name + "\": track \"" + track.name() +
                    "\" is an angle of an order that turns twice about one axis";
        return;
      }
      angles_[index] = &track;
      set_part(entry, rotation_part, true, false);
    } else {
      const bool of_scale = component.property == Property::scale;
      numbers.push_back({curve, of_scale, component.index, track.relative});
      entry.parts = static_cast<Parts>(entry.parts | (1u << (component.index + (of_scale ? 4 : 0))));
    }
  }

  std::array<const Track*, 3> angles_{};
  std::optional<Curve<Quat>> turned_;
};

BoundClip::BoundClip(const Clip& clip, const Hierarchy& nodes, std::string& problems)
    : clip_(&clip), lands_(clips::lands_on_last_key(clip)) {
  entry_of_.assign(nodes.size(), no_entry);
  std::deque<Binding> driven;
  for (const Track& track : clip.tracks) {
    if (is_user_track(track)) {
      user_tracks_.emplace(track.name(), &track);
      continue;
    }
    const std::optional<std::size_t> node = nodes.find(track.node);
    if (!node) {
      problems += "\n  clip \"" + clip.name + "\": there is no node \"" + track.node + "\"";
      continue;
    }
    std::uint32_t& index = entry_of_[*node];
    if (index == no_entry) {
      index = static_cast<std::uint32_t>(driven.size());
      driven.emplace_back(*node);
    }
    driven[index].bind(track, clip, problems);
  }
  for (const Rivals& pair : rivals(clip.tracks))
    problems += "\n  clip \"" + clip.name + "\": the tracks " + pair.problem;
  if (!problems.empty()) return;
  std::vector<Binding*> in_order;
  in_order.reserve(driven.size());
  for (Binding& node : driven) in_order.push_back(&node);
  std::ranges::sort(in_order, {}, [](const Binding* node) { return node->entry.node; });
  for (Binding* node : in_order) {
    node->complete(clip, nodes[node->entry.node].rest);
    Entry& entry = node->entry;
    if (entry.relative || !node->numbers.empty()) finished_ = false;
    entry.first_number = static_cast<std::uint32_t>(numbers_.size());
    entry.numbers = static_cast<std::uint32_t>(node->numbers.size());
    numbers_.insert(numbers_.end(), node->numbers.begin(), node->numbers.end());
    entry_of_[entry.node] = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back(entry);
    curves_.add(entry.node, node->curves);
  }
}

void BoundClip::sample(const Hierarchy& nodes, const ClipClock& clock, std::span<Motion> local) const noexcept {
  curves_.sample(clock.time, clock.side, clock.rate, local);
  if (finished_ && !clock.climbs) return;
  for (std::uint32_t i = 0; i < entries_.size(); ++i) {
    const std::size_t node = entries_[i].node;
    finish(i, nodes[node].rest, clock, local[node]);
  }
}

void BoundClip::sample_entry(std::uint32_t index, const Hierarchy& nodes, const ClipClock& clock,
                             Motion& motion) const noexcept {
  curves_.sample_one(index, clock.time, clock.side, clock.rate, motion);
  if (!finished_ || clock.climbs) finish(index, nodes[entries_[index].node].rest, clock, motion);
}

void BoundClip::set_numbers(const Entry& entry, const Pose& rest, const ClipClock& clock,
                            Motion& motion) const noexcept {
  for (std::uint32_t i = entry.first_number; i < entry.first_number + entry.numbers; ++i) {
    const Number& number = numbers_[i];
    const Sample<double> sample = number.curve->sample(clock.time, clock.side);
    const double rate = sample.rate * clock.rate;
    if (number.of_scale) {
      const double own = number.relative ? rest.scale[number.index] : 1;
      motion.pose.scale[number.index] = sample.value * own;
      motion.scale_rate[number.index] = rate * own;
    } else {
      const double own = number.relative ? rest.position[number.index] : 0;
      motion.pose.position[number.index] = sample.value + own;
      motion.twist.linear[number.index] = rate;
    }
  }
}

// In a loop with offset each round continues from where the one before ended.
void BoundClip::climb(std::uint32_t index, const Pose& rest, const ClipClock& clock, Motion& motion) const noexcept {
  const Entry& entry = entries_[index];
  Vec3 gain = entry.gain, turn = entry.turn;
  if (clock.from != 0 || clock.to != clip_->duration) {
    Motion first, last;
    for (const auto& [end, time, side] : {std::tuple(&first, clock.from, Side::out), {&last, clock.to, Side::in}}) {
      curves_.sample_one(index, time, side, 0, *end);
      ClipClock there;
      there.time = time;
      there.side = side;
      if (entry.numbers) set_numbers(entry, rest, there, *end);
    }
    gain = last.pose.position - first.pose.position;
    turn = log_map(last.pose.rotation * first.pose.rotation.conjugate());
  }
  if (entry.parts & position_part) motion.pose.position += clock.cycle * gain;
  if (entry.parts & rotation_part) {
    const Quat turned = exp_map(clock.cycle * turn);
    motion.pose.rotation = turned * motion.pose.rotation;
    motion.twist.angular = turned * motion.twist.angular;
  }
}

// Completes the motion from the curves' values: adds the gain of a loop with offset, and composes relative tracks with
// the rest pose.
void BoundClip::finish(std::uint32_t index, const Pose& rest, const ClipClock& clock, Motion& motion) const noexcept {
  const Entry& entry = entries_[index];
  if (entry.numbers) set_numbers(entry, rest, clock, motion);
  if (clock.climbs && clock.cycle != 0) climb(index, rest, clock, motion);
  if (entry.relative & position_part) {
    motion.pose.position = rest.position + rest.rotation * Vec3(rest.scale.cwiseProduct(motion.pose.position));
    motion.twist.linear = rest.rotation * Vec3(rest.scale.cwiseProduct(motion.twist.linear));
  }
  if (entry.relative & rotation_part) {
    motion.pose.rotation = rest.rotation * motion.pose.rotation;
    motion.twist.angular = rest.rotation * motion.twist.angular;
  }
  if (entry.relative & scale_part) {
    motion.pose.scale = rest.scale.cwiseProduct(motion.pose.scale);
    motion.scale_rate = rest.scale.cwiseProduct(motion.scale_rate);
  }
}

}  // namespace tweenfall::pose
