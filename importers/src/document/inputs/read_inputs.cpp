#include <tweenfall/anim/player.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/inputs.h>
#include <tweenfall/importers/whole_file.h>

#include "document/content.h"
#include "document/fields/things.h"
#include "document/inputs/input_tables.h"
#include "document/read/clip_times.h"
#include "document/read/values.h"
#include "document/report/check.h"
#include "document/report/suggestion.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <type_traits>

namespace tweenfall {

namespace document::inputs {
namespace {

using fields::Table;

/// Reads the inputs one after another.
class Reader {
 public:
  explicit Reader(Building& building) : building_(building) {
    for (const Play& play : building.stage.plays) {
      const Clip& clip = building.stage.clips[play.clip];
      const std::string& name = play.name.empty() ? clip.name : play.name;
      if (!plays(name)) plays_.push_back(name);
      const bool first = players_.emplace(name, Played{Player(play, clip), play.clip}).second;
      if (!first) shared_.insert(name);
    }
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
    problems_before_ = building_.problems.size();
    if (const json::Value start = usable(value, "start")) read_start(start);
    ask<playing::Stop>(usable(value, "stop"), stop_table());
    ask<playing::FadeTo>(usable(value, "fade"), fade_table());
    ask<playing::Weigh>(usable(value, "weigh"), weigh_table());
    ask<playing::SetSpeed>(usable(value, "speed"), speed_table());
    ask<playing::Seek>(usable(value, "seek"), seek_table());
    give<input::Release>(usable(value, "release"), release_table());
    give<input::Recover>(usable(value, "recover"), recover_table());
    if (const json::Value handed = usable(value, "hand_over")) read_hand_over(handed);
    give<input::Push>(usable(value, "push"), push_table());
    tell<input::Set>(usable(value, "set"), set_table());
    tell<input::Send>(usable(value, "send"), send_table());
    if (const json::Value control = usable(value, "control")) read_control(control);
    if (const json::Value after = usable(value, "after_blows"); after && !inputs.empty())
      inputs.back().after_blows = static_cast<int>(after.number());
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
    // Fields given for a play apply to it, whether it runs or not.
    bool says_how = false;
    for (const json::Member& member : value.members())
      says_how = says_how || (member.name != "play" && !is_free_name(member.name));
    if (says_how && start.action.clip.empty()) start.action.clip = clip_of(start.play);
    if (!runs) plays_.push_back(start.play);
    inputs.push_back({time_, input::Ask{start.play, start.action}});
    play_on(start.play, start.action, value);
  }

  /// Applies the change to the play as the stage will; if it refuses, that is a fault at `place`.
  void play_on(const std::string& name, const PlayAction& action, const json::Value& place) {
    if (building_.problems.size() != problems_before_) return;
    if (shared_.count(name) != 0) {
      building_.problems.add(place, "several plays are called " + json::in_quotes(name) + "; give them names");
      return;
    }
    try {
      if (const auto found = players_.find(name); found != players_.end()) {
        Played& played = found->second;
        played.player = played.player.changed(building_.stage.clips[played.clip], time_, action);
        return;
      }
      // A play that was not started, or whose clip is unknown, has been reported.
      const auto* start = std::get_if<playing::Start>(&action);
      if (!start) return;
      const auto clip = building_.clips.find(start->clip.empty() ? name : start->clip);
      if (clip == building_.clips.end()) return;
      Play play = tweenfall::play_of(*start, clip->second);
      play.at = time_;
      players_.emplace(name, Played{Player(play, building_.stage.clips[clip->second]), clip->second});
    } catch (const std::invalid_argument& fault) {
      building_.problems.add(place, fault.what());
    }
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
    const json::Value to = usable(value, "to");
    play_on(asked.play, asked.action, to ? to : value);
  }

  template <class What>
  void give(const json::Value& value, const Table<OfBody<What>>& table) {
    if (!value) return;
    OfBody<What> of;
    table.read(value, of, building_);
    const std::size_t node = of.place ? fields::body_called(of.place, building_) : no_node;
    constexpr bool releases = std::is_same_v<What, input::Release>;
    if (node != no_node && !std::is_same_v<What, input::Push>) require_movable(of.place, node, releases);
    inputs.push_back({time_, of.input});
  }

  /// That a body can change its owner. @param freely  to be moved by forces, for which it needs a mass
  void require_movable(const json::Value& place, std::size_t node, bool freely) {
    const BodyDescription& body = *building_.stage.nodes[node].body;
    if (body.fixed)
      building_.problems.add(place, json::in_quotes(place.text()) + " is static: nothing can take it over");
    else if (freely && is_scenery(body.shape.solid))
      building_.problems.add(place, json::in_quotes(place.text()) + " is " + kind_name(body.shape.solid) +
                                        ", which has no mass: it stays keyed");
  }

  void read_hand_over(const json::Value& value) {
    OfBody<HandOverRead> of;
    hand_over_table().read(value, of, building_);
    const std::size_t node = of.place ? fields::body_called(of.place, building_) : no_node;
    if (node != no_node) require_movable(of.place, node, of.input.change.change.to.owner() != Owner::keyed);
    inputs.push_back({time_, input::HandOver{of.input.body, of.input.change.change}});
  }

  template <class What>
  void tell(const json::Value& value, const Table<OfGraph<What>>& table) {
    if (!value) return;
    OfGraph<What> of;
    table.read(value, of, building_);
    if (const GraphDescription* graph = graph_called(of.graph, value)) {
      of.input.graph = graph->name;
      if (of.name) look_up(*graph, of.input, of.name);
    }
    inputs.push_back({time_, of.input});
  }

  void read_control(const json::Value& value) {
    Controlled controlled;
    control_table().read(value, controlled, building_);
    const std::vector<VehicleDescription>& vehicles = building_.stage.vehicles;
    std::vector<std::string> names;
    names.reserve(vehicles.size());
    for (const VehicleDescription& vehicle : vehicles) names.push_back(vehicle.name);
    if (controlled.place) {
      if (std::find(names.begin(), names.end(), controlled.input.vehicle) == names.end())
        building_.problems.add(controlled.place, "there is no vehicle " + json::in_quotes(controlled.input.vehicle) +
                                                     suggestion(controlled.input.vehicle, names));
    } else if (names.size() == 1) {
      controlled.input.vehicle = names.front();
    } else if (names.empty()) {
      building_.problems.add(value, "the stage has no vehicle");
    } else {
      building_.problems.add(value, "the stage has several vehicles, " + listed(names) + "; say which \"vehicle\"");
    }
    // Wrong values are reported at their own places.
    if (value.members().size() == (controlled.place ? 1U : 0U))
      building_.problems.add(value, "a control needs a \"throttle\", a \"brake\" or a \"steer\"");
    inputs.push_back({time_, controlled.input});
  }

  /// Null where there is none, which is reported. @param place of its name; none: it is the only one
  const GraphDescription* graph_called(const json::Value& place, const json::Value& whole) {
    const std::vector<GraphDescription>& graphs = building_.stage.graphs;
    std::vector<std::string> names;
    for (const GraphDescription& graph : graphs) {
      if (place ? graph.name == place.text() : graphs.size() == 1) return &graph;
      names.push_back(graph.name);
    }
    if (place)
      building_.problems.add(place,
                             "there is no graph " + json::in_quotes(place.text()) + suggestion(place.text(), names));
    else if (graphs.empty())
      building_.problems.add(whole, "the stage has no graph");
    else
      building_.problems.add(whole, "the stage has several graphs, " + listed(names) + "; say which \"graph\"");
    return nullptr;
  }

  void look_up(const GraphDescription& graph, const input::Set& set, const json::Value& place) {
    std::vector<std::string> names;
    for (const GraphParameter& parameter : graph.parameters) {
      if (parameter.name == set.parameter) {
        if (parameter.curve)
          building_.problems.add(place,
                                 "the parameter " + json::in_quotes(set.parameter) + " has keys and cannot be set");
        return;
      }
      names.push_back(parameter.name);
    }
    building_.problems.add(
        place, "there is no parameter " + json::in_quotes(set.parameter) + suggestion(set.parameter, names));
  }

  void look_up(const GraphDescription& graph, const input::Send& send, const json::Value& place) {
    const std::vector<std::string> names = events_awaited(graph);
    if (std::find(names.begin(), names.end(), send.event) == names.end())
      building_.problems.add(place, "nothing in the graph " + json::in_quotes(graph.name) + " waits for " +
                                        json::in_quotes(send.event) + suggestion(send.event, names));
  }

  struct Played {
    Player player;
    std::size_t clip;
  };

  Building& building_;
  std::vector<std::string> plays_;
  std::map<std::string, Played> players_;
  std::set<std::string> shared_;  // names that several plays have
  double last_ = 0, time_ = 0;
  std::size_t problems_before_ = 0;
};

struct InputGrammar {
  FormStore store;
  const Form* root = nullptr;

  InputGrammar() {
    const ValueForms values(store);
    Form blows;
    blows.kind = Form::Kind::number;
    blows.what = "a whole number from 0 to 1000000";
    blows.low = 0;
    blows.high = 1'000'000;
    blows.whole = true;
    std::vector<Field> fields{{"at", values.stage_time, "stage time", true},
                              {"after_blows", store.add(std::move(blows)), "of those at this very time"}};
    std::vector<std::string> names;
    const auto add = [&](const std::string& name, const auto& table, const std::string& help) {
      fields.push_back({name, store.add(table.listing_form(store, values)), help});
      names.push_back(name);
    };
    add("start", start_table(), "a play begins, or begins again");
    add("stop", stop_table(), "a play ends");
    add("fade", fade_table(), "its weight fades to another value");
    add("weigh", weigh_table(), "its weight changes");
    add("speed", speed_table(), "its speed changes");
    add("seek", seek_table(), "its clock jumps to another time");
    add("release", release_table(), "a body is let go");
    add("recover", recover_table(), "it follows its path again");
    add("hand_over", hand_over_table(), "a body gets any owner, at once or along a ramp");
    add("push", push_table(), "an impulse");
    add("set", set_table(), "a parameter of a graph becomes another number, true or false");
    add("send", send_table(), "an event is sent to a graph");
    add("control", control_table(), "a vehicle is driven from outside from then on");
    std::string what = "an input: {\"at\"} and one of ";
    for (const std::string& name : names) what += (name == names.front() ? "" : ", ") + json::in_quotes(name);
    Form input = object_of(what, std::move(fields));
    input.together = {exactly_one(names)};
    input.on_one_line = true;
    Form list = list_of(store.add(std::move(input)), "a list of inputs in order of time", 0);
    list.one_per_line = true;
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
  if (!stream)
    throw DocumentError({file_problem(
        name, std::filesystem::exists(file, fault) ? "cannot be opened; may it be read?" : "there is no such file")});
  const std::optional<std::string> text = read_within(stream, largest_document);
  if (!text) throw DocumentError({file_problem(name, "is larger than a document may be")});
  if (stream.bad()) throw DocumentError({file_problem(name, "cannot be read to its end")});
  return parse_inputs(*text, name, stage);
}

}  // namespace tweenfall
