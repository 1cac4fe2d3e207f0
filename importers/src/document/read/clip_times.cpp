#include "document/read/clip_times.h"

#include <tweenfall/curves/number_text.h>

#include "document/form.h"
#include "document/read/times.h"
#include "document/read/values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

// Seconds if they can be computed without the duration; problems are reported later.
std::optional<double> early_seconds(json::Value time, std::optional<double> previous, std::optional<double> fps) {
  if (!time) return {};
  if (time.is(Kind::number)) return time.number();
  const std::optional<TimeInWords> words = time.is(Kind::text) ? time_in_words(time.text()) : std::nullopt;
  if (!words || words->unit == TimeInWords::Unit::percent) return {};
  if (words->unit == TimeInWords::Unit::frames && !fps) return {};
  if (words->after_previous && !previous) return {};
  const double amount = words->unit == TimeInWords::Unit::frames ? words->amount / *fps : words->amount;
  return words->after_previous ? *previous + amount : amount;
}

json::Value keys_of(const json::Value& track) {
  if (track.is(Kind::list)) return track;
  return usable(track, "keys");
}

// The tracks of numbers inside a track.
json::Items parts_of(const json::Value& track) {
  if (const json::Value mix = usable(track, "barycentric"))
    if (const json::Value weights = usable(mix, "weights")) return weights.items();
  if (const json::Value ratios = usable(track, "aspect")) return json::Items::only(ratios);
  return {};
}

bool is_endless(const json::Value& track) {
  for (const char* name : {"oscillator", "spring", "projectile", "pendulum", "orbit", "expression"})
    if (track.find(name)) return true;
  return false;
}

// The duration of a function that begins at 0 s and ends; 0 where there is none.
double passing_time(const json::Value& track) {
  for (const char* name : {"path", "line", "arc"})
    if (const json::Value function = usable(track, name)) return number_in(function, "duration", 1);
  for (const char* name : {"spline", "bezier", "b_spline"}) {
    const json::Value spline = usable(track, name);
    if (!spline) continue;
    const json::Value points = usable(spline, "points");
    const json::Value times = usable(spline, "times"), knots = usable(spline, "knots");
    if (times && !times.items().empty()) return times.items().back().number();
    // A B-spline ends at the knot whose index is its number of points.
    if (knots && points && points.items().size() < knots.items().size())
      return knots.items()[points.items().size()].number();
    return number_in(spline, "duration", 1);
  }
  return 0;
}

// How far tracks reach, s.
struct Reach {
  double latest = 0;
  bool any_keys = false, any_functions = false;

  void add(const json::Value& track, std::optional<double> fps) {
    any_functions = any_functions || is_endless(track);
    if (const double passing = passing_time(track); passing > 0) {
      any_keys = true;
      latest = std::max(latest, passing);
    }
    for (const json::Value& part : parts_of(track)) add(part, fps);
    const json::Value keys = keys_of(track);
    if (!keys) return;
    any_keys = true;
    std::optional<double> time;
    for (const json::Value& key : keys.items()) {
      time = early_seconds(key_parts(key).time, time, fps);
      if (time) latest = std::max(latest, *time);
    }
  }
};

}  // namespace

KeyParts key_parts(const json::Value& key) {
  KeyParts parts;
  const auto item = [&](std::size_t i) {
    return i < key.items().size() && !key.items()[i].is(Kind::faulty) ? key.items()[i] : json::Value();
  };
  if (key.is(Kind::list)) {
    parts.time = item(0);
    parts.value = item(1);
    parts.ease = item(2);
  } else if (key.is(Kind::object)) {
    parts.time = usable(key, "t");
    parts.value = usable(key, "v");
    parts.ease = usable(key, "ease");
    parts.in = usable(key, "in");
    parts.out = usable(key, "out");
    parts.value_in = usable(key, "v_in");
  }
  return parts;
}

std::optional<double> ClipTimes::seconds(const json::Value& time, std::optional<double> previous,
                                         Problems& problems) const {
  if (time.is(Kind::number)) return time.number();
  const std::optional<TimeInWords> words = time.is(Kind::text) ? time_in_words(time.text()) : std::nullopt;
  if (!words) return {};
  double amount = words->amount;
  if (words->unit == TimeInWords::Unit::frames) {
    if (!fps_) {
      problems.add(time, json::in_quotes(time.text()) +
                             " counts frames; say how many there are per second, with \"fps\" in the document");
      return {};
    }
    amount /= *fps_;
  } else if (words->unit == TimeInWords::Unit::percent) {
    if (!duration_) {
      problems.add(time, json::in_quotes(time.text()) + " is a share of the duration, but " + no_duration_reason_);
      return {};
    }
    amount = amount / 100 * *duration_;
  }
  if (!words->after_previous) return amount;
  if (!previous) {
    problems.add(time, json::in_quotes(time.text()) + " counts from the one before it, and there is none");
    return {};
  }
  return *previous + amount;
}

std::vector<std::optional<double>> ClipTimes::of_keys(const json::Value& keys, Problems& problems) const {
  std::vector<std::optional<double>> out;
  std::optional<double> previous;
  bool any_before = false;
  for (const json::Value& key : keys.items()) {
    const KeyParts parts = key_parts(key);
    std::optional<double> time;
    if (parts.time) {
      // After a faulty key, a "+" has nothing to count from; that is not a fault of this key.
      Problems unheard;
      time = seconds(parts.time, previous, any_before && !previous ? unheard : problems);
    }
    if (time && previous && !(*time > *previous))
      problems.add(parts.time, "key times must increase; " + number_text(*time) +
                                   " s is not after the key before it, " + number_text(*previous) + " s");
    if (time && !std::isfinite(*time)) time.reset();
    previous = time;
    any_before = true;
    out.push_back(time);
  }
  return out;
}

double clip_duration(const json::Value& clip, std::optional<double> fps) {
  if (const json::Value said = usable(clip, "duration"))
    if (const std::optional<double> seconds = early_seconds(said, {}, fps)) return *seconds;
  Reach reach;
  if (const json::Value tracks = usable(clip, "tracks"))
    for (const json::Member& track : tracks.members())
      if (!is_free_name(track.name)) reach.add(track.value, fps);
  double latest = reach.latest;
  if (reach.any_functions && !reach.any_keys) return std::numeric_limits<double>::infinity();
  if (const json::Value events = usable(clip, "events")) {
    std::optional<double> time;
    for (const json::Value& event : events.items()) {
      if (event.is(Kind::list) && !event.items().empty()) {
        time = early_seconds(event.items().front(), time, fps);
      } else {
        time = early_seconds(usable(event, "from"), time, fps);
        const std::optional<double> end = early_seconds(usable(event, "to"), time, fps);
        if (end) latest = std::max(latest, *end);
      }
      if (time) latest = std::max(latest, *time);
    }
  }
  return latest;
}

}  // namespace tweenfall::document
