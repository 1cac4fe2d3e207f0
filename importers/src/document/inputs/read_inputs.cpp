#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/inputs.h>
#include <tweenfall/importers/whole_file.h>

#include "document/content.h"
#include "document/fields/rule.h"
#include "document/fields/things.h"
#include "document/read/clip_times.h"
#include "document/read/values.h"
#include "document/report/check.h"
#include "document/report/suggestion.h"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace tweenfall {

namespace document::inputs {
namespace {

using Kind = json::Value::Kind;
using fields::Meaning;
using fields::Row;
using fields::Table;

/// A play asked for something.
template <class Action>
struct Asked {
  std::string play;
  Action action{};
  json::Value place{};  // of the play's name
};

// Values

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

// Plays

using Started = Asked<playing::Start>;

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
  static const std::vector<std::pair<std::string, LoopMode>> loops{{"once", LoopMode::once},
                                                                   {"repeat", LoopMode::repeat},
                                                                   {"repeat-offset", LoopMode::repeat_offset},
                                                                   {"pingpong", LoopMode::pingpong}};
  const auto loop_form = [](FormStore& store, const ValueForms&) -> const Form* {
    std::vector<std::string> words;
    words.reserve(loops.size());
    for (const auto& [word, mode] : loops) words.push_back(word);
    return store.add(words_of("a way to loop", words));
  };
  const auto read_loop = [](const json::Value& value, Started& start, Building&) {
    for (const auto& [word, mode] : loops)
      if (value.text() == word) start.action.loop = Loop{mode, 0};
  };
  const auto read_count = [](const json::Value& value, Started& start, Building&) {
    Loop loop = start.action.loop.value_or(Loop{LoopMode::repeat, 0});
    loop.count = value.number();
    start.action.loop = loop;
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
       {"loop", fields::FormOf::Make(loop_form), "absent: as the clip says", {read_loop}},
       {"count", &ValueForms::positive, "number of rounds", {read_count}},
       {"speed", speed_form, "", keys_of<Started>(false, of(&playing::Start::speed))},
       {"weight", weight_form, "", keys_of<Started>(true, of(&playing::Start::weight))},
       {"fade_in", fields::fade_form, "", fade(&playing::Start::fade_in)},
       {"fade_out", fields::fade_form, "", fade(&playing::Start::fade_out)},
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
  static const Table<Seek> table("a seek",
                                 {play_row<Seek>(),
                                  {"to", &ValueForms::not_negative, "clip time",
                                   fields::member<Seek>([](Seek& seek) -> double& { return seek.action.time; }), true},
                                  {"events", &ValueForms::boolean, "whether what lies between fires",
                                   fields::member<Seek>([](Seek& seek) -> bool& { return seek.action.events; })}});
  return table;
}

// Bodies

template <class Settings>
struct OfBody {
  Settings input{};
  json::Value place{};  // of the body's name
};

template <class Thing>
Row<Thing> body_row() {
  const auto read = [](const json::Value& value, Thing& thing, Building&) {
    thing.input.body = value.text();
    thing.place = value;
  };
  return {"body", &ValueForms::name, "a node's name", {read}, true};
}

const Table<OfBody<input::Release>>& release_table() {
  using Release = OfBody<input::Release>;
  const auto velocity = [](const json::Value& value, Release& release, Building& building) {
    fields::read_take_over(value, release.input.settings, building);
  };
  static const Table<Release> table(
      "a release",
      {body_row<Release>(),
       {"velocity", fields::take_over_form, "", {velocity, "\"curve\""}},
       fields::overlap_row<Release>([](Release& release) -> TakeOver& { return release.input.settings; })});
  return table;
}

const Table<OfBody<input::Recover>>& recover_table() {
  using Recover = OfBody<input::Recover>;
  const auto path = [](const json::Value& value, Recover& recover, Building& building) {
    fields::read_path(value, recover.input.settings, building);
  };
  const auto settle = [](const json::Value& value, Recover& recover, Building& building) {
    fields::read_settle(value, recover.input.settings.settle, building);
  };
  static const Table<Recover> table("a recovery", {body_row<Recover>(),
                                                   {"path", fields::path_form, "", {path, "{}"}},
                                                   {"settle", fields::settle_form, "", {settle}}});
  return table;
}

const Table<OfBody<input::Push>>& push_table() {
  using Push = OfBody<input::Push>;
  static const Table<Push> table("a push",
                                 {body_row<Push>(),
                                  {"impulse", &ValueForms::vector, "N s",
                                   fields::member<Push>([](Push& push) -> Vec3& { return push.input.impulse; }), true},
                                  {"point", &ValueForms::vector, "where, in the world, m",
                                   fields::member<Push>([](Push& push) -> Vec3& { return push.input.point; }), true}});
  return table;
}

// One input

/// The inputs as they are read, one after another.
class Reader {
 public:
  explicit Reader(Building& building) : building_(building) {
    for (const Play& play : building.stage.plays)
      plays_.push_back(play.name.empty() ? building.stage.clips[play.clip].name : play.name);
  }

  void read(const json::Value& value) {
    const json::Value at = usable(value, "at");
    if (!at) return;
    const ClipTimes times({}, {}, "stage time has none");
    const std::optional<double> time = times.seconds(at, {}, building_.problems);
    if (!time) return;
    if (*time < last_)
      building_.problems.add(at, "times do not go back; " + number_text(*time) +
                                     " s is before the input before it, at " + number_text(last_) + " s");
    last_ = std::max(last_, *time);
    time_ = *time;
    if (const json::Value start = usable(value, "start")) read_start(start);
    ask<playing::Stop>(usable(value, "stop"), stop_table());
    ask<playing::FadeTo>(usable(value, "fade"), fade_table());
    ask<playing::Weigh>(usable(value, "weigh"), weigh_table());
    ask<playing::SetSpeed>(usable(value, "speed"), speed_table());
    ask<playing::Seek>(usable(value, "seek"), seek_table());
    give<input::Release>(usable(value, "release"), release_table());
    give<input::Recover>(usable(value, "recover"), recover_table());
    give<input::Push>(usable(value, "push"), push_table());
  }

  std::vector<TimedInput> inputs;

 private:
  [[nodiscard]] bool plays(const std::string& name) const {
    return std::find(plays_.begin(), plays_.end(), name) != plays_.end();
  }

  void read_start(const json::Value& value) {
    Started start;
    start_table().read(value, start, building_);
    const std::string& wanted = start.action.clip.empty() ? start.play : start.action.clip;
    const bool runs = plays(start.play);
    if (!runs && building_.clips.count(wanted) == 0 && start.place) {
      const json::Value clip = usable(value, "clip");
      std::vector<std::string> names = building_.clip_names();
      if (!clip) names.insert(names.end(), plays_.begin(), plays_.end());
      building_.problems.add(clip ? clip : start.place, "there is no " +
                                                            std::string(clip ? "clip " : "play and no clip ") +
                                                            json::in_quotes(wanted) + suggestion(wanted, names));
    }
    // What is said of a play holds for it, whether it runs or not.
    bool says_how = false;
    for (const json::Member& member : value.members())
      says_how = says_how || (member.name != "play" && !is_free_name(member.name));
    if (says_how && start.action.clip.empty()) start.action.clip = clip_of(start.play);
    if (!runs) plays_.push_back(start.play);
    inputs.push_back({time_, input::Ask{start.play, start.action}});
  }

  [[nodiscard]] std::string clip_of(const std::string& play) const {
    for (const Play& each : building_.stage.plays)
      if (each.name == play) return building_.stage.clips[each.clip].name;
    return play;
  }

  template <class Action>
  void ask(const json::Value& value, const Table<Asked<Action>>& table) {
    if (!value) return;
    Asked<Action> asked;
    table.read(value, asked, building_);
    if (asked.place && !plays(asked.play))
      building_.problems.add(asked.place,
                             "there is no play " + json::in_quotes(asked.play) + suggestion(asked.play, plays_));
    inputs.push_back({time_, input::Ask{asked.play, asked.action}});
  }

  template <class What>
  void give(const json::Value& value, const Table<OfBody<What>>& table) {
    if (!value) return;
    OfBody<What> of;
    table.read(value, of, building_);
    if (of.place) static_cast<void>(fields::body_called(of.place, building_));
    inputs.push_back({time_, of.input});
  }

  Building& building_;
  std::vector<std::string> plays_;
  double last_ = 0, time_ = 0;
};

struct InputGrammar {
  FormStore store;
  const Form* root = nullptr;

  InputGrammar() {
    const ValueForms values(store);
    std::vector<Field> fields{{"at", values.stage_time, "stage time", true}};
    std::vector<std::string> names;
    const auto add = [&](const std::string& name, const auto& table, const std::string& help) {
      fields.push_back({name, store.add(table.listing_form(store, values)), help});
      names.push_back(name);
    };
    add("start", start_table(), "a play begins, or begins again");
    add("stop", stop_table(), "it is over");
    add("fade", fade_table(), "its weight goes to another");
    add("weigh", weigh_table(), "its weight is another");
    add("speed", speed_table(), "its clock goes on at another speed");
    add("seek", seek_table(), "its clock is elsewhere");
    add("release", release_table(), "a body is let go");
    add("recover", recover_table(), "it follows its path again");
    add("push", push_table(), "an impulse");
    std::string what = "an input: {\"at\"} and one of ";
    for (const std::string& name : names) what += (name == names.front() ? "" : ", ") + json::in_quotes(name);
    Form input = object_of(what, std::move(fields));
    input.together = {exactly_one(names)};
    input.on_one_line = true;
    Form list = list_of(store.add(std::move(input)), "a list of inputs in order of time", 0);
    list.one_a_line = true;
    Form version;
    version.kind = Form::Kind::number;
    version.what = "1, the version that this reader reads";
    version.low = version.high = 1;
    root = store.add(object_of("inputs: {\"tweenfall\": 1, \"inputs\"}",
                               {{"tweenfall", store.add(version), "the version", true},
                                {"inputs", store.add(std::move(list)), "in order of time", true}}));
  }
};

}  // namespace
}  // namespace document::inputs

std::vector<TimedInput> parse_inputs(std::string_view text, const std::string& name, const StageDescription& stage) {
  using namespace document;
  static const inputs::InputGrammar grammar;
  std::vector<json::Fault> faults;
  json::Tree tree = json::Tree::parse(std::string(text), faults, {.largest = largest_document});
  Problems problems;
  for (const json::Fault& fault : faults) problems.add(fault);
  std::vector<TimedInput> read;
  if (!tree.root().is(json::Value::Kind::faulty)) {
    check(*grammar.root, tree, problems);
    Reading reading;
    Building building{tree.root(), {}, reading, problems};
    building.stage = stage;
    for (std::size_t i = 0; i < stage.nodes.size(); ++i) building.nodes.emplace(stage.nodes[i].name, i);
    for (std::size_t i = 0; i < stage.clips.size(); ++i) building.clips.emplace(stage.clips[i].name, i);
    inputs::Reader reader(building);
    if (const json::Value list = usable(tree.root(), "inputs"))
      for (const json::Value& item : list.items())
        if (item.is(json::Value::Kind::object)) reader.read(item);
    read = std::move(reader.inputs);
  }
  if (!problems.empty()) throw DocumentError(problems.located(Severity::error, name, tree));
  return read;
}

std::vector<TimedInput> read_inputs(const std::filesystem::path& file, const StageDescription& stage) {
  using namespace document;
  const std::string name = file.generic_string();
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault)) throw DocumentError({file_problem(name, "this is a folder")});
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw DocumentError({file_problem(name, "cannot be opened; is it there, and may it be read?")});
  const std::optional<std::string> text = read_within(stream, largest_document);
  if (!text) throw DocumentError({file_problem(name, "is larger than a document may be")});
  if (stream.bad()) throw DocumentError({file_problem(name, "cannot be read to its end")});
  return parse_inputs(*text, name, stage);
}

}  // namespace tweenfall
