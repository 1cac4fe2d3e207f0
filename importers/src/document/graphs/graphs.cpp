#include "document/graphs/graphs.h"

#include <tweenfall/anim/graph_doubts.h>

#include "document/graphs/parts.h"
#include "document/read/clip_times.h"
#include "document/report/suggestion.h"
#include "document/tracks/read_track.h"

#include <algorithm>
#include <charconv>

namespace tweenfall::document::graphs {

namespace {

using fields::Table;
using Kind = json::Value::Kind;

// Parameters

const Table<GraphParameter>& parameter_table() {
  const auto start = [](const json::Value& value, GraphParameter& parameter, Building&) {
    parameter.start = read_setting(value);
  };
  const auto track = [](const json::Value&, GraphParameter&, Building&) {};  // it is read with its clip
  static const Table<GraphParameter> table(
      "a parameter",
      {{"start", setting_form, "until it is set", {start, "0"}},
       {"half_life", &ValueForms::not_negative, "of the critically damped spring by which poses follow what was set, s",
        fields::member<GraphParameter>(&GraphParameter::half_life)},
       {"track", &ValueForms::name, "of numbers, which it follows from the graph's start on", {track}},
       {"clip", &ValueForms::name, "of the track; absent: the only one that has it", {track}}});
  return table;
}

std::optional<Curve<double>> followed_track(const json::Value& parameter, Building& building) {
  const json::Value track = usable(parameter, "track");
  if (!track || !building.failed_imports.empty()) return std::nullopt;
  try {
    return track_curve(building.stage.clips, track.text(), text_in(parameter, "clip", ""));
  } catch (const std::invalid_argument& problem) {
    building.problems.add(track, problem.what());
    return std::nullopt;
  }
}

const Form* parameter_form(FormStore& store, const ValueForms& values) {
  Form full = parameter_table().listing_form(store, values);
  full.on_one_line = true;
  full.together = {at_most_one({"track", "start"}),
                   at_most_one({"track", "half_life"}),
                   {Together::Rule::first_needs_second, {"clip", "track"}}};
  return store.add(
      choice_of("a number, true, false, {\"start\", \"half_life\"}, {\"track\", \"clip\"}, or a list of keys",
                {values.number, values.boolean, store.add(std::move(full)), weight_keys_form(store, values)}));
}

void read_parameters(const json::Value& value, GraphDescription& graph, Building& building) {
  for (const json::Member& member : value.members()) {
    if (is_free_name(member.name)) continue;
    GraphParameter& parameter = graph.parameters.emplace_back();
    parameter.name = member.name;
    if (member.value.is(Kind::object)) {
      parameter_table().read(member.value, parameter, building);
      parameter.curve = followed_track(member.value, building);
    } else if (member.value.is(Kind::list)) {
      parameter.curve = read_play_keys(member.value, building.fps, {}, 0, building.problems);
    } else {
      parameter.start = read_setting(member.value);
    }
  }
}

// Inputs

const Form* inputs_form(FormStore& store, const ValueForms& values) {
  Form input;
  input.kind = Form::Kind::tuple;
  input.what = "an input: [time, parameter, value] or [time, event]";
  input.parts = {values.stage_time, values.name, setting_form(store, values)};
  input.fewest = 2;
  input.on_one_line = true;
  input.foremost_fault = [time = values.stage_time](const json::Value& value) {
    if (value.items().empty() || !value.items()[0].is(Kind::text)) return std::string();
    const Form* const form = resolved(*time, value.items()[0]);
    if (!form || !form->fits || form->fits(value.items()[0].text())) return std::string();
    const bool known = form->why && !form->why(value.items()[0].text()).empty();
    return known ? std::string()
                 : "the time of an input comes first: [time, parameter, value] or [time, event]; found " +
                       json::on_one_line(value);
  };
  Form list = list_of(store.add(std::move(input)), "a list of inputs", 0);
  list.one_per_line = true;
  return store.add(std::move(list));
}

void read_inputs(const json::Value& value, GraphDescription& graph, Building& building) {
  const ClipTimes times(building.fps, {}, "a graph's time has none");
  for (const json::Value& item : value.items()) {
    GraphInput& input = graph.inputs.emplace_back();
    if (item.items().size() < 2) continue;
    input.time = times.seconds(item.items()[0], {}, building.problems).value_or(0);
    input.name = item.items()[1].text();
    if (item.items().size() > 2) input.value = read_setting(item.items()[2]);
  }
}

// Reactions to events of clips

const Form* reactions_form(FormStore& store, const ValueForms& values) {
  Form reaction;
  reaction.kind = Form::Kind::tuple;
  reaction.what = "a reaction: [event of a clip, parameter, value] or [event of a clip, event]";
  reaction.parts = {values.name, values.name, setting_form(store, values)};
  reaction.fewest = 2;
  reaction.on_one_line = true;
  Form list = list_of(store.add(std::move(reaction)), "a list of reactions", 0);
  list.one_per_line = true;
  return store.add(std::move(list));
}

void read_reactions(const json::Value& value, GraphDescription& graph, Building&) {
  for (const json::Value& item : value.items()) {
    GraphReaction& reaction = graph.reactions.emplace_back();
    if (item.items().size() < 2) continue;
    reaction.event = item.items()[0].text();
    reaction.name = item.items()[1].text();
    if (item.items().size() > 2) reaction.value = read_setting(item.items()[2]);
  }
}

// The whole

const Form* poses_form(FormStore& store, const ValueForms& values) {
  return store.add(map_of(pose_form(store, values), "an object with poses by name"));
}
const Form* parameters_form(FormStore& store, const ValueForms& values) {
  return store.add(map_of(parameter_form(store, values), "an object with parameters by name"));
}

void read_poses(const json::Value& value, GraphDescription& graph, Building& building) {
  for (const json::Member& member : value.members()) {
    if (is_free_name(member.name)) continue;
    GraphPose& pose = graph.poses.emplace_back();
    pose.name = member.name;
    read_pose(member.value, pose, building);
  }
}

const Table<GraphDescription>& graph_table() {
  static const Table<GraphDescription> table(
      "a graph",
      {{"parameters", parameters_form, "numbers that come from outside", {read_parameters, "{}"}},
       {"poses", poses_form, "made of clips and of each other", {read_poses}, true},
       {"output", &ValueForms::name, "the pose that shows; absent: the last",
        fields::member<GraphDescription>(&GraphDescription::output)},
       {"inputs", inputs_form, "parameters that are set and events that are sent", {read_inputs, "[]"}},
       {"on", reactions_form, "events of clips that set parameters or send events", {read_reactions, "[]"}}});
  return table;
}

// The value at a fault's place, or the last on the way that is there, and whether it is all the way. A list of one may
// stand without its brackets.
std::pair<json::Value, bool> place_in(json::Value value, const std::vector<std::string>& place) {
  for (const std::string& part : place) {
    json::Value next = usable(value, part);
    if (value.is(Kind::list)) {
      std::size_t index = 0;
      std::from_chars(part.data(), part.data() + part.size(), index);
      if (index < value.items().size() && !value.items()[index].is(Kind::faulty)) next = value.items()[index];
    }
    if (!next && part == "0" && !value.is(Kind::list)) continue;
    if (!next) return {value, false};
    value = next;
  }
  return {value, true};
}

// The faults of a graph reported before it is checked against its clips and nodes: parts left out because of them are
// missing then, which is not another fault.
class Told {
 public:
  Told(const json::Value& graph, const Problems& problems) : graph_(graph), places_(problems.places()) {}

  // Whether there were any.
  [[nodiscard]] bool is_any() const { return holds_any(graph_); }

  // Whether something missing at a place may be a consequence of a reported fault.
  [[nodiscard]] bool leads_to(const GraphFault& fault, const json::Value& at) const {
    if (places_.empty()) return false;
    if (is_spoiled("parameters") || is_spoiled("poses")) return true;
    // In a pose, of a fault in that pose; elsewhere, of a fault in any pose, since only poses without faults exist.
    const bool in_pose = fault.place.size() > 1 && fault.place[0] == "poses";
    const json::Value poses = graph_.find("poses");
    if (in_pose) {
      const json::Value pose = poses.find(fault.place[1]);
      return holds_any(at) || (!(tells_of_none(fault) && names_stranger(at, pose)) && holds_consequential(pose));
    }
    const bool sets = !fault.place.empty() && fault.place[0] == "inputs" && at.items().size() > 2;
    return holds_any(poses) && !names_nothing(sets ? at.items()[1] : at);
  }

 private:
  // Whether it is a name that no part of the graph has, left out or not: no fault of a part can be why it is unknown.
  [[nodiscard]] bool names_nothing(const json::Value& value) const {
    if (!value.is(Kind::text)) return false;
    const std::string_view name = value.text();
    return !graph_.find("parameters").find(name) && !graph_.find("poses").find(name);
  }
  // Whether it says that something of a name is not there.
  [[nodiscard]] static bool tells_of_none(const GraphFault& fault) {
    return fault.message.find("there is no ") != std::string::npos;
  }
  // Whether it is a name, well read, of what would be outside the pose: a node, a clip, a parameter.
  [[nodiscard]] bool names_stranger(const json::Value& value, const json::Value& pose) const {
    const json::Value name = value.is(Kind::object) ? value.find("parameter") : value;
    return names_nothing(name) && !has_member(pose, name.text());
  }
  [[nodiscard]] static bool has_member(const json::Value& value, std::string_view name) {
    if (value.find(name)) return true;
    for (const json::Member& member : value.members())
      if (has_member(member.value, name)) return true;
    for (const json::Value& item : value.items())
      if (has_member(item, name)) return true;
    return false;
  }

  // Whether there is a fault in a pose that may make something else in it wrong.
  [[nodiscard]] bool holds_consequential(const json::Value& pose) const {
    const auto first = std::ranges::lower_bound(places_, pose.offset());
    return std::any_of(first, std::ranges::lower_bound(places_, pose.offset() + pose.length()),
                       [&](std::size_t place) { return !is_harmless(place, pose); });
  }
  // Whether a place is in a member that has a sound value in place of a faulty one, on which no other member depends.
  [[nodiscard]] static bool is_harmless(std::size_t place, json::Value value) {
    static constexpr std::string_view harmless[] = {"ground", "weight", "floor", "lowest", "highest", "evenness",
                                                    "tilt",   "sweeps", "leaps", "method", "limits",  "swing",
                                                    "twist",  "share",  "limit", "ease",   "eye",     "softness",
                                                    "fade",   "settle", "moves", "follows"};
    const auto holds_place = [&](const json::Value& part) {
      return place >= part.offset() && place < part.offset() + part.length();
    };
    for (;;) {
      json::Value next;
      for (const json::Member& member : value.members())
        if (holds_place(member.value)) {
          if (std::ranges::count(harmless, member.name) > 0) return true;
          next = member.value;
        }
      for (const json::Value& item : value.items())
        if (holds_place(item)) next = item;
      if (!next) return false;
      value = next;
    }
  }

  [[nodiscard]] bool is_spoiled(const char* part) const { return graph_.find(part).is(Kind::faulty); }
  [[nodiscard]] bool holds_any(const json::Value& value) const {
    if (!value) return false;
    const auto first = std::ranges::lower_bound(places_, value.offset());
    return first != places_.end() && *first < value.offset() + value.length();
  }

  json::Value graph_;
  std::vector<std::size_t> places_;  // in order
};

Hierarchy hierarchy_of(const Building& building) {
  std::vector<Node> nodes;
  nodes.reserve(building.stage.nodes.size());
  for (const NodeDescription& node : building.stage.nodes)
    nodes.push_back({.name = node.name, .parent = node.parent, .rest = node.rest});
  return Hierarchy(std::move(nodes));
}

// Leaves out tracks whose nodes do not exist, which are reported at their own places.
std::vector<Clip> clips_of_known_nodes(const Building& building) {
  std::vector<Clip> clips = building.stage.clips;
  for (Clip& clip : clips)
    std::erase_if(clip.tracks, [&](const Track& track) { return building.nodes.count(track.node) == 0; });
  return clips;
}

void tell_faults(const json::Value& value, const GraphDescription& graph, Building& building) {
  if (!building.failed_imports.empty()) return;
  std::vector<GraphFault> faults;
  try {
    faults = inspect(graph, hierarchy_of(building), clips_of_known_nodes(building));
  } catch (const std::invalid_argument&) {
    return;  // a fault of the nodes, which is reported elsewhere
  }
  const bool sound = building.problems.empty();
  const Told told(value, building.problems);
  for (GraphFault& fault : faults)
    if (const auto [place, whole] = place_in(value, fault.place); (whole || sound) && !told.leads_to(fault, place))
      building.problems.add(place, std::move(fault.message));
  for (GraphFault& doubt : doubts_about(graph))
    building.problems.note(place_in(value, doubt.place).first, std::move(doubt.message));
}

// Only clips have events, so an event that no clip has never happens.
void tell_events_of_no_clip(const json::Value& value, Building& building) {
  if (!building.failed_imports.empty() || Told(usable(building.root, "clips"), building.problems).is_any()) return;
  std::vector<std::string> names;
  for (const Clip& clip : building.stage.clips)
    for (const ClipEvent& event : clip.events) names.push_back(event.name);
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (const json::Value& reaction : usable(value, "on").items()) {
    if (reaction.items().empty() || !reaction.items()[0].is(Kind::text)) continue;
    const json::Value event = reaction.items()[0];
    if (!std::ranges::binary_search(names, event.text()))
      building.problems.add(event,
                            "no clip has an event " + json::in_quotes(event.text()) + suggestion(event.text(), names));
  }
}

}  // namespace

const Form* form(FormStore& store, const ValueForms& values) {
  Form graph = graph_table().listing_form(store, values);
  graph.one_per_line = true;
  graph.definition = "graph";
  return store.add(map_of(store.add(std::move(graph)), "an object with graphs by name"));
}

void read(const json::Value& value, Building& building) {
  for (const json::Member& member : value.members()) {
    if (is_free_name(member.name) || !member.value.is(Kind::object)) continue;
    GraphDescription graph;
    graph.name = member.name;
    graph_table().read(member.value, graph, building);
    tell_faults(member.value, graph, building);
    tell_events_of_no_clip(member.value, building);
    building.stage.graphs.push_back(std::move(graph));
  }
}

}  // namespace tweenfall::document::graphs
