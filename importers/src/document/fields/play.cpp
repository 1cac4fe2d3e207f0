#include "document/fields/fill.h"
#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/read/clip_times.h"
#include "document/report/suggestion.h"
#include "document/tracks/read_track.h"

#include <cmath>

namespace tweenfall::document::fields {

namespace {

constexpr std::size_t no_clip = static_cast<std::size_t>(-1);

/// A number, keys in the play's own time, or keys that state their clock.
const Form* timed_form(FormStore& store, const ValueForms& values, const std::string& what, const Form* number) {
  const Form* keys = weight_keys_form(store, values);
  Form told = object_of(what + " with its clock: {\"clock\", \"keys\"}",
                        {{"clock", store.add(words_of("a clock", {"play", "stage"})),
                          "play: seconds since the play's start; stage: stage time", false, "\"play\""},
                         {"keys", keys, "in order of time", true}});
  return store.add(choice_of(what + ": a number, or keys over the play's own time", {number, keys, store.add(told)}));
}
Form weight_form() {
  return bounded("a weight from 0 to 1", 0, false, 1);
}
const Form* play_weight_form(FormStore& store, const ValueForms& values) {
  return timed_form(store, values, weight_form().what, store.add(weight_form()));
}
const Form* play_speed_form(FormStore& store, const ValueForms& values) {
  return timed_form(store, values, "a speed", values.number);
}

}  // namespace

const Form* fade_form(FormStore& store, const ValueForms& values) {
  Form full = object_of("a fade: {\"seconds\", \"ease\"}",
                        {{"seconds", values.not_negative, "stage seconds", true},
                         {"ease", values.ease, "how the weight goes there", false, "\"linear\""}});
  full.on_one_line = true;
  Form either = choice_of("a fade: seconds, or {\"seconds\", \"ease\"}", {values.not_negative, store.add(full)});
  either.definition = "fade";
  return store.add(std::move(either));
}

Fade read_fade(const json::Value& value) {
  Fade fade;
  if (value.is(json::Value::Kind::number)) fade.seconds = value.number();
  if (!value.is(json::Value::Kind::object)) return fade;
  fade.seconds = number_in(value, "seconds", 0);
  if (const json::Value word = usable(value, "ease"))
    if (const std::optional<Ease> ease = Ease::named(word.text())) fade.ease = *ease;
  return fade;
}

namespace {

const Form* mask_form(FormStore& store, const ValueForms& values) {
  return store.add(choice_of("a name, a pattern (\"arm/*\"), or a list of them",
                             {values.name, store.add(list_of(values.name, "a list of names or patterns"))}));
}

void read_play_clip(const json::Value& value, Play& play, Building& building) {
  const auto found = building.clips.find(value.text());
  play.clip = found == building.clips.end() ? no_clip : found->second;
  if (play.clip != no_clip || building.excused(value.text())) return;
  // A clip that has faults of its own still exists.
  const json::Value clips = usable(building.root, "clips");
  if (clips && usable(clips, value.text())) return;
  std::string meant = suggestion_or_import(value.text(), building.clip_names());
  if (meant.empty()) meant = building.said_of_failed_import(value.text());
  building.problems.add(value, "there is no clip " + json::in_quotes(value.text()) + meant);
}

/// The curve of keys; keys on the stage's clock are converted to the play's.
std::optional<Curve<double>> read_timed(const json::Value& value, const Play& play, const Form& number,
                                        Building& building) {
  const json::Value keys = value.is(json::Value::Kind::list) ? value : usable(value, "keys");
  if (!keys) return {};
  const double from = text_in(value, "clock") == "stage" ? play.at : 0;
  return read_play_keys(keys, building.fps, number, from, building.problems);
}

void read_play_speed(const json::Value& value, Play& play, Building& building) {
  if (value.is(json::Value::Kind::number)) play.speed = value.number();
  if (const auto curve = read_timed(value, play, {}, building)) play.speed = PlaySpeed(*curve);
}

void read_play_weight(const json::Value& value, Play& play, Building& building) {
  if (value.is(json::Value::Kind::number)) play.weight = Curve<double>(value.number());
  if (const auto curve = read_timed(value, play, weight_form(), building)) play.weight = *curve;
}

/// A time of the played clip in seconds.
std::optional<double> read_clip_time(const json::Value& value, const Play& play, Building& building) {
  std::optional<double> duration;
  if (play.clip < building.stage.clips.size() && std::isfinite(building.stage.clips[play.clip].duration))
    duration = building.stage.clips[play.clip].duration;
  const ClipTimes times(building.fps, duration, "this clip is endless");
  return times.seconds(value, play.from, building.problems);
}

void read_from(const json::Value& value, Play& play, Building& building) {
  play.from = read_clip_time(value, play, building).value_or(0);
}
void read_to(const json::Value& value, Play& play, Building& building) {
  play.to = read_clip_time(value, play, building);
}

Loop own_loop(const Play& play, const Building& building) {
  return play.loop.value_or(play.clip < building.stage.clips.size() ? building.stage.clips[play.clip].loop : Loop{});
}

void read_play_loop(const json::Value& value, Play& play, Building&) {
  play.loop = read_loop(value);
}

void read_play_count(const json::Value& value, Play& play, Building& building) {
  std::optional<Loop> loop = own_loop(play, building);
  // A play with a count repeats, even if the clip does not; and the play's count overrides the clip's.
  if (!play.loop && loop->mode == LoopMode::once) loop->mode = LoopMode::repeat;
  if (!play.loop) loop->count = 0;
  read_count_beside(value, loop, building.problems);
  play.loop = loop;
}

/// Checks a play as a whole; faults are reported at its place.
void check_play(const json::Value& value, const Play& play, Building& building) {
  if (play.clip >= building.stage.clips.size()) return;
  const Clip& clip = building.stage.clips[play.clip];
  for (const std::string& problem : problems_of(play, clip)) building.problems.add(value, problem);
  if (play.speed.first_direction() < 0 && std::isinf(play.to.value_or(clip.duration)))
    if (const json::Value speed = usable(value, "speed"))
      building.problems.add(speed, "an endless clip has no end from which to run backwards; give it a \"duration\"");
  if (!play.name.empty())
    for (const Play& other : building.stage.plays)
      if (other.name == play.name)
        if (const json::Value name = usable(value, "name"))
          building.problems.add(name, "another play is called " + json::in_quotes(play.name) + " already");
}

void read_mask(const json::Value& value, Play& play, Building& building) {
  play.mask = names_of(value);
  for (const std::string& name : play.mask)
    if (building.nodes_named(name).empty() && !building.excused(name))
      building.problems.add(
          value, "no node is called " + json::in_quotes(name) + suggestion_or_import(name, building.node_names()));
}

const Table<Play>& play_table() {
  Meaning<Play> at = member<Play>(&Play::at);
  at.read = [](const json::Value& value, Play& play, Building& building) {
    const ClipTimes times(building.fps, {}, "stage time has none");
    play.at = times.seconds(value, {}, building.problems).value_or(0);
  };
  const auto fade = [](Fade Play::*member) {
    return Meaning<Play>{[member](const json::Value& value, Play& play, Building&) { play.*member = read_fade(value); },
                         "0"};
  };
  static const Table<Play> table(
      "a play", {{"name", &ValueForms::name, "by which it is changed while it runs; absent: the clip's",
                  member<Play>(&Play::name)},
                 {"clip", &ValueForms::name, "name of a clip", {read_play_clip}, true},
                 {"at", &ValueForms::stage_time, "stage time of its start", at},
                 {"from", &ValueForms::key_time, "where the section of the clip begins, clip time", {read_from, "0"}},
                 {"to", &ValueForms::key_time, "where it ends; absent: with the clip", {read_to}},
                 {"offset", &ValueForms::not_negative, "seconds of all rounds that lie behind when it starts",
                  member<Play>(&Play::offset)},
                 one_of<Play, bool>("direction", "a direction", {{"forward", false}, {"reverse", true}},
                                    "each round from its start to its end, or back", &Play::reverse),
                 {"loop", loop_or_once_form, "absent: as the clip says", {read_play_loop}},
                 {"count",
                  &ValueForms::positive,
                  "number of rounds; absent: as the clip says, or with \"loop\" without end",
                  {read_play_count}},
                 {"speed", play_speed_form, "clip seconds per stage second", {read_play_speed, "1"}},
                 {"weight", play_weight_form, "over what is below", {read_play_weight, "1"}},
                 {"fade_in", fade_form, "stage seconds from its start in which the weight comes", fade(&Play::fade_in)},
                 {"fade_out", fade_form, "stage seconds to its end in which it goes", fade(&Play::fade_out)},
                 filling<Play>("fill", &Play::fill),
                 {"mask", mask_form, "nodes it drives; absent: all", {read_mask}}});
  return table;
}

}  // namespace

const Form* play_form(FormStore& store, const ValueForms& values) {
  Form play = play_table().listing_form(store, values);
  play.definition = "play";
  play.instead = [](const json::Value& value) {
    const bool named = value.is(json::Value::Kind::text);
    return named ? "; say {\"clip\": " + json::in_quotes(value.text()) + "}" : std::string();
  };
  return store.add(std::move(play));
}

std::optional<Play> read_play(const json::Value& value, Building& building) {
  Play play;
  const std::size_t before = building.problems.size();
  play_table().read(value, play, building);
  if (building.problems.size() == before) check_play(value, play, building);
  if (play.clip == no_clip) return std::nullopt;
  return play;
}

json::Value place_of_fade_in(const json::Value& play) {
  return below(play, {"fade_in"});
}

json::Value place_of_fade_out(const json::Value& play) {
  return below(play, {"fade_out"});
}

}  // namespace tweenfall::document::fields
