#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/read/clip_times.h"
#include "document/report/suggestion.h"
#include "document/tracks/read_track.h"

#include <cmath>

namespace tweenfall::document::fields {

namespace {

constexpr std::size_t no_clip = static_cast<std::size_t>(-1);

const Form* play_weight_form(FormStore& store, const ValueForms& values) {
  return store.add(
      choice_of("a weight from 0 to 1, or a list of keys in stage time",
                {store.add(bounded("a weight from 0 to 1", 0, false, 1)), weight_keys_form(store, values)}));
}

const Form* mask_form(FormStore& store, const ValueForms& values) {
  return store.add(choice_of("a name, a pattern (\"arm/*\"), or a list of them",
                             {values.name, store.add(list_of(values.name, "a list of names or patterns"))}));
}

void read_play_clip(const json::Value& value, Play& play, Building& building) {
  const auto found = building.clips.find(value.text());
  play.clip = found == building.clips.end() ? no_clip : found->second;
  if (play.clip != no_clip || building.excused(value.text())) return;
  // A clip with faults of its own is there all the same.
  const json::Value clips = usable(building.root, "clips");
  if (clips && usable(clips, value.text())) return;
  building.problems.add(value, "there is no clip " + json::in_quotes(value.text()) +
                                   suggestion_or_import(value.text(), building.clip_names()));
}

void read_play_speed(const json::Value& value, Play& play, Building& building) {
  take(value, play.speed, building);
  const std::vector<Clip>& clips = building.stage.clips;
  if (play.speed < 0 && play.clip < clips.size() && std::isinf(clips[play.clip].duration))
    building.problems.add(value, "an endless clip has no end from which to run backwards; give it a \"duration\"");
}

void read_play_weight(const json::Value& value, Play& play, Building& building) {
  if (value.is(json::Value::Kind::number)) play.weight = Curve<double>(value.number());
  if (!value.is(json::Value::Kind::list)) return;
  if (const auto curve = read_weight(value, building.fps, building.problems)) play.weight = *curve;
}

void read_mask(const json::Value& value, Play& play, Building& building) {
  play.mask = names_of(value);
  for (const std::string& name : play.mask)
    if (building.nodes_named(name).empty() && !building.excused(name))
      building.problems.add(
          value, "no node is called " + json::in_quotes(name) + suggestion_or_import(name, building.node_names()));
}

const Table<Play>& play_table() {
  Meaning<Play> at = member<Play>(&Play::at), speed = member<Play>(&Play::speed);
  at.read = [](const json::Value& value, Play& play, Building& building) {
    const ClipTimes times(building.fps, {}, "stage time has none");
    play.at = times.seconds(value, {}, building.problems).value_or(0);
  };
  speed.read = read_play_speed;
  static const Table<Play> table("a play", {{"clip", &ValueForms::name, "name of a clip", {read_play_clip}, true},
                                            {"at", &ValueForms::stage_time, "stage time of its start", at},
                                            {"speed", &ValueForms::number, "clip seconds per stage second", speed},
                                            {"weight", play_weight_form, "over what is below", {read_play_weight, "1"}},
                                            {"mask", mask_form, "nodes it drives; absent: all", {read_mask}}});
  return table;
}

}  // namespace

const Form* play_form(FormStore& store, const ValueForms& values) {
  Form play = play_table().listing_form(store, values);
  play.definition = "play";
  return store.add(std::move(play));
}

std::optional<Play> read_play(const json::Value& value, Building& building) {
  Play play;
  play_table().read(value, play, building);
  if (play.clip == no_clip) return std::nullopt;
  return play;
}

}  // namespace tweenfall::document::fields
