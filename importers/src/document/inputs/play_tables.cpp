#include <tweenfall/curves/number_text.h>

#include "document/fields/fill.h"
#include "document/fields/things.h"
#include "document/inputs/input_tables.h"
#include "document/read/clip_times.h"
#include "document/read/values.h"

namespace tweenfall::document::inputs {

using fields::Meaning;
using fields::Row;
using fields::Table;

namespace {

using Kind = json::Value::Kind;

const Form* keys_form(FormStore& store, const ValueForms& values, const std::string& what) {
  Form row;
  row.kind = Form::Kind::tuple;
  row.what = "a key: [seconds, value] or [seconds, value, ease]";
  row.parts = {values.number, values.number, values.ease};
  row.fewest = 2;
  row.on_one_line = true;
  const Form* keys = store.add(list_of(store.add(std::move(row)), "a list of keys over seconds from then on"));
  return store.add(choice_of(what + ": a number, or keys over seconds from then on", {values.number, keys}));
}
const Form* weight_form(FormStore& store, const ValueForms& values) {
  return keys_form(store, values, "a weight from 0 to 1");
}
const Form* speed_form(FormStore& store, const ValueForms& values) {
  return keys_form(store, values, "a speed");
}

PlayKeys read_keys(const json::Value& value, bool weight, Building& building) {
  if (value.is(Kind::number)) {
    if (weight && !(value.number() >= 0 && value.number() <= 1))
      building.problems.add(value, "expected a weight from 0 to 1, found " + number_text(value.number()));
    return {{0, value.number()}};
  }
  PlayKeys keys;
  for (const json::Value& item : value.items()) {
    const KeyParts parts = key_parts(item);
    if (!parts.time || !parts.value) continue;
    PlayKey key{parts.time.number(), parts.value.number()};
    if (parts.ease)
      if (const std::optional<Ease> ease = Ease::named(parts.ease.text())) key.ease = *ease;
    if (weight && !(key.value >= 0 && key.value <= 1))
      building.problems.add(parts.value, "expected a weight from 0 to 1, found " + number_text(key.value));
    if (!keys.empty() && !(key.time > keys.back().time))
      building.problems.add(parts.time, "key times must increase; " + number_text(key.time) +
                                            " s is not after the key before it, " + number_text(keys.back().time) +
                                            " s");
    keys.push_back(key);
  }
  return keys;
}

template <class Thing, class Access>
Meaning<Thing> keys_of(bool weight, Access access) {
  return {[weight, access](const json::Value& value, Thing& thing, Building& building) {
            std::invoke(access, thing) = read_keys(value, weight, building);
          },
          "1"};
}

template <class Thing>
Row<Thing> play_row() {
  const auto read = [](const json::Value& value, Thing& thing, Building&) {
    thing.play = value.text();
    thing.place = value;
  };
  return {"play", &ValueForms::name, "its name, else that of its clip", {read}, true};
}

template <class Thing, class Access>
Row<Thing> ease_row(Access access) {
  const auto read = [access](const json::Value& value, Thing& thing, Building&) {
    std::invoke(access, thing) = Ease::named(value.text());
  };
  return {"ease", &ValueForms::ease, "absent: value and rate go on, and it comes to rest", {read}};
}

}  // namespace

const Table<Started>& start_table() {
  const auto of = [](auto member) {
    return [member](Started & start) -> auto& {
      return start.action.*member;
    };
  };
  const auto fade = [](Fade playing::Start::*member) {
    return Meaning<Started>{[member](const json::Value& value, Started& start, Building&) {
                              start.action.*member = fields::read_fade(value);
                            },
                            "0"};
  };
  const auto read_loop = [](const json::Value& value, Started& start, Building&) {
    start.action.loop = fields::read_loop(value);
  };
  const auto read_count = [](const json::Value& value, Started& start, Building& building) {
    if (!start.action.loop) start.action.loop = Loop{LoopMode::repeat, 0};
    fields::read_count_beside(value, start.action.loop, building.problems);
  };
  const auto read_to = [](const json::Value& value, Started& start, Building&) { start.action.to = value.number(); };
  const auto read_mask = [](const json::Value& value, Started& start, Building&) {
    start.action.mask = names_of(value);
  };
  const auto mask_form = [](FormStore& store, const ValueForms& values) -> const Form* {
    return store.add(choice_of("a name, a pattern (\"arm/*\"), or a list of them",
                               {values.name, store.add(list_of(values.name, "a list of names or patterns"))}));
  };
  static const Table<Started> table(
      "a start",
      {play_row<Started>(),
       {"clip", &ValueForms::name, "of a play that there is not yet; absent: as it is given, or of that name",
        fields::member<Started>(of(&playing::Start::clip))},
       {"from", &ValueForms::not_negative, "clip time", fields::member<Started>(of(&playing::Start::from))},
       {"to", &ValueForms::positive, "clip time", {read_to}},
       {"offset", &ValueForms::not_negative, "s", fields::member<Started>(of(&playing::Start::offset))},
       fields::one_of<Started, bool>("direction", "a direction", {{"forward", false}, {"reverse", true}}, "",
                                     of(&playing::Start::reverse)),
       {"loop", fields::loop_or_once_form, "absent: as the clip says", {read_loop}},
       {"count", &ValueForms::positive, "number of rounds", {read_count}},
       {"speed", speed_form, "", keys_of<Started>(false, of(&playing::Start::speed))},
       {"weight", weight_form, "", keys_of<Started>(true, of(&playing::Start::weight))},
       {"fade_in", fields::fade_form, "", fade(&playing::Start::fade_in)},
       {"fade_out", fields::fade_form, "", fade(&playing::Start::fade_out)},
       fields::filling<Started>("fill", of(&playing::Start::fill)),
       {"mask", fields::FormOf::Make(mask_form), "nodes it drives; absent: all", {read_mask}}});
  return table;
}

const Table<Asked<playing::Stop>>& stop_table() {
  using Stop = Asked<playing::Stop>;
  static const Table<Stop> table("a stop",
                                 {play_row<Stop>(),
                                  {"seconds", &ValueForms::not_negative, "of fading",
                                   fields::member<Stop>([](Stop& stop) -> double& { return stop.action.seconds; })},
                                  ease_row<Stop>([](Stop & stop) -> auto& { return stop.action.ease; })});
  return table;
}

const Table<Asked<playing::FadeTo>>& fade_table() {
  using FadeTo = Asked<playing::FadeTo>;
  static const Table<FadeTo> table(
      "a fade", {play_row<FadeTo>(),
                 {"weight", bounded("a weight from 0 to 1", 0, false, 1), "to which it goes",
                  fields::member<FadeTo>([](FadeTo& fade) -> double& { return fade.action.weight; }), true},
                 {"seconds", &ValueForms::not_negative, "",
                  fields::member<FadeTo>([](FadeTo& fade) -> double& { return fade.action.seconds; })},
                 ease_row<FadeTo>([](FadeTo & fade) -> auto& { return fade.action.ease; })});
  return table;
}

const Table<Asked<playing::Weigh>>& weigh_table() {
  using Weigh = Asked<playing::Weigh>;
  static const Table<Weigh> table("a weight", {play_row<Weigh>(),
                                               {"weight", weight_form, "",
                                                keys_of<Weigh>(
                                                    true, [](Weigh & weigh) -> auto& { return weigh.action.weight; }),
                                                true}});
  return table;
}

const Table<Asked<playing::SetSpeed>>& speed_table() {
  using SetSpeed = Asked<playing::SetSpeed>;
  static const Table<SetSpeed> table(
      "a speed", {play_row<SetSpeed>(),
                  {"speed", speed_form, "",
                   keys_of<SetSpeed>(
                       false, [](SetSpeed & set) -> auto& { return set.action.speed; }),
                   true},
                  {"seconds", &ValueForms::not_negative, "in which it goes there",
                   fields::member<SetSpeed>([](SetSpeed& set) -> double& { return set.action.seconds; })}});
  return table;
}

const Table<Asked<playing::Seek>>& seek_table() {
  using Seek = Asked<playing::Seek>;
  static const Table<Seek> table(
      "a seek", {play_row<Seek>(),
                 {"to", &ValueForms::not_negative, "clip time",
                  fields::member<Seek>([](Seek& seek) -> double& { return seek.action.time; }), true},
                 {"events", &ValueForms::boolean, "whether events in between fire",
                  fields::member<Seek>([](Seek& seek) -> bool& { return seek.action.events; })},
                 {"fade", &ValueForms::not_negative, "seconds in which the pose before fades out; 0: a jump",
                  fields::member<Seek>([](Seek& seek) -> double& { return seek.action.fade; })}});
  return table;
}

}  // namespace tweenfall::document::inputs
