#include <tweenfall/curves/number_text.h>

#include "document/form.h"
#include "document/judge/judge.h"
#include "document/read/clip_times.h"
#include "document/read/values.h"

#include <cmath>
#include <numbers>
#include <optional>

namespace tweenfall::document::judging {

namespace {

using Kind = json::Value::Kind;

// The angles of one track or node, as written.
struct Angles {
  std::optional<double> turned{};  // the first that is not 0
  bool only_quarters = true;       // whether all are quarter turns in radians, to the digits that people write

  void add(const json::Value& angle) {
    constexpr double quarter = std::numbers::pi / 2, digits = 3e-4, most = 16;
    if (!angle.is(Kind::number) || angle.number() == 0) return;
    const double quarters = std::abs(angle.number()) / quarter, whole = std::round(quarters);
    only_quarters = only_quarters && whole >= 1 && whole <= most && std::abs(quarters - whole) < digits;
    if (!turned) turned = angle.number();
  }

  void add_rotation(const json::Value& rotation) {
    add(rotation);
    if (const json::Value angle = usable(rotation, "angle")) add(angle);
    if (const json::Value euler = usable(rotation, "euler"))
      for (const json::Value& angle : euler.items()) add(angle);
  }
};

void judge_angles_at(Building& building, const json::Value& place, const Angles& angles) {
  if (!angles.turned || !angles.only_quarters) return;
  building.problems.note(place,
                         "turns by " + brief_text(*angles.turned) +
                             ", a number of quarter turns in radians; angles here are degrees, a quarter turn is 90");
}

bool turns(std::string_view track) {
  return track.ends_with(".rotation") || track.ends_with(".rotation.x") || track.ends_with(".rotation.y") ||
         track.ends_with(".rotation.z");
}

}  // namespace

void judge_angles(Building& building) {
  const auto each_of = [&](std::string_view list, auto visit) {
    const json::Value things = usable(building.root, list);
    if (!things) return;
    for (const json::Member& thing : things.members())
      if (!is_free_name(thing.name)) visit(thing.value);
  };
  each_of("nodes", [&](const json::Value& node) {
    const json::Value rotation = usable(node, "rotation");
    if (!rotation) return;
    Angles angles;
    angles.add_rotation(rotation);
    judge_angles_at(building, rotation, angles);
  });
  each_of("clips", [&](const json::Value& clip) {
    const json::Value tracks = usable(clip, "tracks");
    if (!tracks) return;
    for (const json::Member& track : tracks.members()) {
      if (is_free_name(track.name) || !turns(track.name)) continue;
      const json::Value keys = track.value.is(Kind::list) ? track.value : usable(track.value, "keys");
      if (!keys) continue;
      Angles angles;
      for (const json::Value& key : keys.items()) angles.add_rotation(key_parts(key).value);
      judge_angles_at(building, track.value, angles);
    }
  });
}

}  // namespace tweenfall::document::judging
