#include <tweenfall/anim/play.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/stage/recording.h>

#include "document/fields/things.h"
#include "document/judge/instants.h"
#include "document/judge/judge.h"
#include "document/read/values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tweenfall::document::judging {

namespace {

constexpr double hour = 3600, longest_usual_step = 0.1, shortest_usual_step = 0.99e-4;  // s
constexpr double most_usual_rate = 1e4;                                                 // steps per second

// @return whether turns can be judged by steps of this length
bool judge_step(Building& building) {
  const double step = building.stage.step;
  if (step < shortest_usual_step)
    building.problems.note(fields::place_of_step(place_of_world(building)),
                           "steps of " + brief_text(step) + " s are " + brief_text(1 / step) +
                               " per second, each of which takes its time; 1/240 is usual");
  if (!(step > longest_usual_step)) return true;
  const bool rate = step > 1 && step <= most_usual_rate && step == std::floor(step);
  building.problems.note(fields::place_of_step(place_of_world(building)),
                         "steps of " + brief_text(step) + " s are too long for bodies that move" +
                             (rate ? "; did you mean \"1/" + number_text(step) + "\"?" : "; 1/240 is usual"));
  return false;
}

// Clip seconds per second of the fastest play of each clip; 1 for clips that are only played on request.
std::vector<double> fastest_plays(const StageDescription& stage) {
  std::vector<double> fastest(stage.clips.size(), 1);
  for (const Play& play : stage.plays)
    if (play.clip < fastest.size()) fastest[play.clip] = std::max(fastest[play.clip], play.speed.greatest());
  return fastest;
}

// The greatest angular speed near any key or half way between two, rad/s.
double fastest_turn(const Curve<Quat>& curve, double duration) {
  double fastest = 0;
  look_along(curve, duration,
             [&](double time, Side side) { fastest = std::max(fastest, curve.rate(time, side).norm()); });
  return fastest;
}

void judge_turns(Building& building, const Clip& clip, double speed) {
  const double most = std::numbers::pi / building.stage.step;
  for (const Track& track : clip.tracks) {
    const auto* rotation = std::get_if<Curve<Quat>>(&track.curve);
    if (!rotation) continue;
    const double fastest = fastest_turn(*rotation, clip.duration) * speed;
    if (!(fastest > most)) continue;
    building.problems.note(place_of_track(building, clip, track),
                           "turns by " + brief_text(degrees(fastest)) +
                               " degrees per second, more than half a turn in a step of " +
                               brief_text(building.stage.step) + " s; bodies and pictures cannot follow that");
  }
}

void judge_spins(Building& building) {
  const double most = std::numbers::pi / building.stage.step;
  for (std::size_t i = 0; i < building.stage.nodes.size(); ++i) {
    const std::optional<BodyDescription>& body = building.stage.nodes[i].body;
    if (!body || !(body->twist.angular.norm() > most)) continue;
    building.problems.note(fields::place_of_spin(below(place_of_node(building, i), {"body"})),
                           "spins by " + brief_text(degrees(body->twist.angular.norm())) +
                               " degrees per second, more than half a turn in a step of " +
                               brief_text(building.stage.step) + " s; contacts cannot follow that");
  }
}

// Checks for more events in a step than a run accepts; also for clips that do not play, since one can be chosen.
void judge_loop(Building& building, std::size_t clip, double speed) {
  const Play play{.clip = clip, .speed = speed};
  const std::string& name = building.stage.clips[clip].name;
  const Clip& described = building.stage.clips[clip];
  const std::string fault =
      too_many_events(play, described, building.stage.step + 1e-6, most_events_in_step(described));
  if (!fault.empty()) building.problems.add(below(place_of_clip(building, name), {"loop"}), fault);
}

// Notes it if a recording of the usual length would have more events than it can hold.
/// @param usual  that length, s
void note_recorded_events(Building& building, const json::Value& place, const Play& play, double usual) {
  const StageDescription& stage = building.stage;
  // Half of it, because `too_many_events` allows for twice as many.
  if (!too_many_events(play, stage.clips[play.clip], usual / 2).empty())
    building.problems.note(place,
                           "has more than a million events within " + brief_text(usual) +
                               " s, the usual length of a recording, and no recording holds so many: lengthen its "
                               "loop, or end the recording earlier");
}

// A play that is over before its weight has come, or whose weight would have to go before it starts.
void note_long_fades(Building& building, const json::Value& place, const Play& play) {
  const double lasts = end_time(play, building.stage.clips[play.clip]) - play.at;
  const auto judge_fade = [&](const Fade& fade, const json::Value& where, const char* so) {
    if (!(fade.seconds > lasts * (1 + 1e-9))) return;
    building.problems.note(where, "takes " + brief_text(fade.seconds) + " s, but the play is over after " +
                                      brief_text(lasts) + " s: " + so);
  };
  judge_fade(play.fade_in, fields::place_of_fade_in(place),
             "its whole weight comes only later, if it still shows then");
  judge_fade(play.fade_out, fields::place_of_fade_out(place), "it never has its whole weight");
}

// Keys after the stated end of a clip are never reached.
void note_late_ends(Building& building, const Clip& clip) {
  const json::Value clips = usable(building.root, "clips"), own = clips ? usable(clips, clip.name) : clips;
  if (!own || !usable(own, "duration") || !std::isfinite(clip.duration)) return;
  for (const Track& track : clip.tracks) {
    const double last = extent(track.curve).second;
    if (!std::isfinite(last) || last <= clip.duration * (1 + 1e-9)) continue;
    building.problems.note(place_of_track(building, clip, track),
                           "goes on to " + brief_text(last) + " s, but the clip ends at " + brief_text(clip.duration) +
                               " s: what comes after is never reached");
  }
}

}  // namespace

void judge_pace(Building& building) {
  const StageDescription& stage = building.stage;
  const bool usual = judge_step(building);
  if (usual) judge_spins(building);
  const std::vector<double> fastest = fastest_plays(stage);
  const double length = natural_length(stage);
  const json::Value list = usable(building.root, "play");
  for (std::size_t i = 0; list && i < std::min(stage.plays.size(), list.items().size()); ++i) {
    const Play& play = stage.plays[i];
    const std::string fault = too_many_events(play, stage.clips[play.clip], stage.step + 1e-6);
    if (!fault.empty())
      building.problems.add(list.items()[i], fault);
    else
      note_recorded_events(building, list.items()[i], play, length);
    note_long_fades(building, list.items()[i], play);
  }
  if (!list && stage.clips.size() == 1)
    note_recorded_events(building, place_of_clip(building, stage.clips[0].name), {}, length);
  for (std::size_t i = 0; i < stage.clips.size(); ++i) {
    const Clip& clip = stage.clips[i];
    if (usual) judge_turns(building, clip, fastest[i]);
    judge_loop(building, i, fastest[i]);
    note_late_ends(building, clip);
    if (std::isfinite(clip.duration) && clip.duration > hour)
      building.problems.note(below(place_of_clip(building, clip.name), {"duration"}),
                             "lasts " + brief_text(clip.duration) +
                                 " s, longer than an hour; without --until only its first seconds are shown");
  }
}

}  // namespace tweenfall::document::judging
