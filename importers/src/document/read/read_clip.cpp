#include <tweenfall/anim/component.h>
#include <tweenfall/curves/number_text.h>

#include "document/fields/things.h"
#include "document/form.h"
#include "document/read/values.h"
#include "document/tracks/read_track.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

void read_events(const json::Value& list, const ClipTimes& times, double duration, Clip& clip, Problems& problems) {
  const auto inside = [&](const json::Value& time, double seconds) {
    if (seconds >= 0 && seconds <= duration) return;
    problems.add(time, seconds < 0
                           ? "an event before the clip's start would never happen; found " + number_text(seconds) + " s"
                           : "an event after the clip's end would never happen; " + number_text(seconds) +
                                 " s is after " + number_text(duration) + " s");
  };
  std::optional<double> previous;
  for (const json::Value& item : list.items()) {
    const bool row = item.is(Kind::list);
    if (!row && !item.is(Kind::object)) continue;
    const auto part = [&](std::size_t i) {
      return i < item.items().size() && !item.items()[i].is(Kind::faulty) ? item.items()[i] : json::Value();
    };
    const json::Value from = row ? part(0) : usable(item, "from");
    const json::Value name = row ? part(1) : usable(item, "name");
    const json::Value data = row ? part(2) : usable(item, "data");
    const json::Value to = row ? json::Value() : usable(item, "to");
    ClipEvent event;
    const std::optional<double> start = from ? times.seconds(from, previous, problems) : std::nullopt;
    previous = start;
    if (!start) continue;
    inside(from, *start);
    event.from = event.to = *start;
    if (to) {
      const std::optional<double> end = times.seconds(to, start, problems);
      if (!end) continue;
      if (!(*end > *start))
        problems.add(to, "an event ends after it starts; \"to\" is " + number_text(*end) + " s, \"from\" " +
                             number_text(*start) + " s");
      else
        inside(to, *end);
      event.to = *end;
    }
    if (name) event.name = name.text();
    if (data) event.data = json::on_one_line(data);
    clip.events.push_back(std::move(event));
  }
  std::stable_sort(clip.events.begin(), clip.events.end(),
                   [](const ClipEvent& a, const ClipEvent& b) { return a.from < b.from; });
}

void read_tracks(const json::Value& tracks, const ClipTimes& times, Clip& clip, Problems& problems) {
  std::vector<json::Member> read_from;
  for (const json::Member& member : tracks.members()) {
    if (is_free_name(member.name)) continue;
    std::optional<Track> track = read_track(member, times, problems);
    if (!track) continue;
    clip.tracks.push_back(std::move(*track));
    read_from.push_back(member);
  }
  for (const Rivals& pair : rivals(clip.tracks))
    problems.add_name_beside(read_from[pair.second], "the tracks " + pair.problem, read_from[pair.first]);
}

}  // namespace

Clip read_clip(const json::Member& member, std::optional<double> fps, Problems& problems) {
  const json::Value& value = member.value;
  Clip clip;
  clip.name = member.name;
  if (!value.is(Kind::object)) return clip;

  std::optional<double> said_duration;
  if (const json::Value said = usable(value, "duration"))
    said_duration = ClipTimes(fps, {}, "").seconds(said, {}, problems);
  clip.duration = clip_duration(value, fps);
  // Times that depend on a faulty duration are not faulty themselves.
  if (value.find("duration") && !said_duration && !(clip.duration > 0 && std::isfinite(clip.duration)))
    clip.duration = 1;
  const bool endless = std::isinf(clip.duration);
  const bool has_share = clip.duration > 0 && !endless;
  const ClipTimes times(
      fps, has_share ? std::optional(clip.duration) : std::nullopt,
      endless ? "this clip is endless; give it a \"duration\"" : "this clip has none; give it a \"duration\"");

  if (const json::Value loop = usable(value, "loop")) {
    clip.loop = fields::read_loop(loop).value_or(Loop{LoopMode::repeat, 0});
    if (endless) problems.add(loop, "an endless clip cannot loop; give it a \"duration\"");
    if (clip.duration <= 0) problems.add(loop, "a clip of no length cannot loop; give it a \"duration\"");
  }
  if (const json::Value tracks = usable(value, "tracks")) read_tracks(tracks, times, clip, problems);
  if (const json::Value events = usable(value, "events")) read_events(events, times, clip.duration, clip, problems);
  return clip;
}

}  // namespace tweenfall::document
