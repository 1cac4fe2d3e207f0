#include "document/graphs/parts.h"

namespace tweenfall::document::graphs {

namespace {

using fields::member;
using fields::Table;
using Kind = json::Value::Kind;

Form pair_of_names(const char* what, const ValueForms& values) {
  Form pair;
  pair.kind = Form::Kind::tuple;
  pair.what = what;
  pair.parts = {values.name, values.name};
  pair.fewest = 2;
  pair.on_one_line = true;
  return pair;
}

// Mirror

const Form* sides_form(FormStore& store, const ValueForms& values) {
  return store.add(
      list_of(store.add(pair_of_names("two names or patterns: [left, right]", values)), "a list of [left, right]"));
}

const Table<MirrorPose>& mirror_table() {
  using Pose = MirrorPose;
  const auto pairs = [](const json::Value& value, Pose& pose, Building&) {
    for (const json::Value& pair : value.items())
      if (pair.items().size() == 2)
        pose.pairs.push_back({std::string(pair.items()[0].text()), std::string(pair.items()[1].text())});
  };
  static const Table<Pose> table(
      "a mirror",
      {{"pairs", sides_form, "names or patterns of the two sides; absent: as they are usually named", {pairs}},
       axis_row<Pose>("normal", "of the mirror plane, in the space of the figure's parent; absent: x", &Pose::normal),
       {"figure", &ValueForms::name, "a node: it and all below it; absent: all nodes", member<Pose>(&Pose::figure)},
       weight_row<Pose>()});
  return table;
}

// Retarget

const Table<RetargetPair>& retarget_pair_table() {
  static const Table<RetargetPair> table(
      "a pair", {{"source", &ValueForms::name, "a name or pattern", member<RetargetPair>(&RetargetPair::source), true},
                 {"target", &ValueForms::name, "a name or pattern", member<RetargetPair>(&RetargetPair::target), true},
                 {"moves", &ValueForms::boolean, "whether its movement from rest is copied, too",
                  member<RetargetPair>(&RetargetPair::moves)}});
  return table;
}

const Form* map_form(FormStore& store, const ValueForms& values) {
  Form full = retarget_pair_table().listing_form(store, values);
  full.on_one_line = true;
  const Form* pair = store.add(choice_of(
      "a pair: [source, target], or {\"source\", \"target\", \"moves\"}",
      {store.add(pair_of_names("two names or patterns: [source, target]", values)), store.add(std::move(full))}));
  return store.add(list_of(pair, "a list of pairs of joints"));
}

const Table<RetargetStance>& stance_table() {
  using Stance = RetargetStance;
  const auto position = [](const json::Value& value, Stance& stance, Building&) { stance.position = vector_of(value); };
  const auto rotation = [](const json::Value& value, Stance& stance, Building& building) {
    fields::take(value, stance.rotation.emplace(1, 0, 0, 0), building);
  };
  static const Table<Stance> table("a stance",
                                   {{"position", &ValueForms::vector, "relative to the parent, m", {position}},
                                    {"rotation", &ValueForms::rotation, "", {rotation}}});
  return table;
}

const Form* stances_form(FormStore& store, const ValueForms& values) {
  Form stance = stance_table().listing_form(store, values);
  stance.on_one_line = true;
  return store.add(map_of(store.add(std::move(stance)), "an object with stances by names of nodes"));
}

const Table<RetargetPose>& retarget_table() {
  using Pose = RetargetPose;
  const auto pairs = [](const json::Value& value, Pose& pose, Building& building) {
    for (const json::Value& item : value.items()) {
      RetargetPair pair;
      if (item.is(Kind::object)) retarget_pair_table().read(item, pair, building);
      if (item.is(Kind::list) && item.items().size() == 2)
        pair = {std::string(item.items()[0].text()), std::string(item.items()[1].text())};
      pose.pairs.push_back(std::move(pair));
    }
  };
  const auto stances = [](const json::Value& value, Pose& pose, Building& building) {
    for (const json::Member& member : value.members()) {
      if (is_free_name(member.name) || !member.value.is(Kind::object)) continue;
      RetargetStance stance{std::string(member.name)};
      stance_table().read(member.value, stance, building);
      pose.stance.push_back(std::move(stance));
    }
  };
  static const Table<Pose> table(
      "a retarget",
      {{"source", &ValueForms::name, "the figure that is followed: a node and all below", member<Pose>(&Pose::source),
        true},
       {"target", &ValueForms::name, "the figure that follows", member<Pose>(&Pose::target), true},
       {"pairs", map_form, "joints of the one and the other, by names or patterns", {pairs}, true},
       {"scale", &ValueForms::positive, "of ways; absent: the ratio of the hip heights", member<Pose>(&Pose::scale)},
       axis_row<Pose>("up", "along which heights are measured; absent: y", &Pose::up),
       {"turn", &ValueForms::rotation, "from the space of the source's parent to that of the target's",
        member<Pose>(&Pose::turn)},
       {"stance",
        stances_form,
        "local poses of nodes of either figure in which both stand alike; absent: at rest",
        {stances}},
       weight_row<Pose>()});
  return table;
}

// Root motion

const Table<RootMotionPose>& root_motion_table() {
  using Pose = RootMotionPose;
  using Turn = RootParts::Turn;
  static const Table<Pose> table(
      "a root motion",
      {{"node", &ValueForms::name, "that carries the figure, such as the hips", member<Pose>(&Pose::node), true},
       {"accumulate", &ValueForms::boolean, "whether its path continues from loop to loop and from clip to clip",
        member<Pose>(&Pose::accumulates)},
       {"onto", &ValueForms::name, "a node above it that is moved instead; absent: the figure walks on the spot",
        member<Pose>(&Pose::onto)},
       {"horizontal", &ValueForms::boolean, "its movement over the ground",
        member<Pose>([](Pose& pose) -> bool& { return pose.parts.horizontal; })},
       {"vertical", &ValueForms::boolean, "its movement up and down",
        member<Pose>([](Pose& pose) -> bool& { return pose.parts.vertical; })},
       fields::one_of<Pose, Turn>("turn", "a turn: \"none\", \"yaw\" or \"all\"",
                                  {{"none", Turn::none}, {"yaw", Turn::yaw}, {"all", Turn::all}},
                                  "what part of its rotation: none, that about up, or all",
                                  [](Pose& pose) -> Turn& { return pose.parts.turn; }),
       axis_row<Pose>("up", "absent: y", [](Pose& pose) -> Vec3& { return pose.parts.up; }),
       weight_row<Pose>()});
  return table;
}

}  // namespace

OperationWord mirror_word() {
  return word_of("mirror", mirror_table(), "left and right change sides");
}

OperationWord retarget_word() {
  return word_of("retarget", retarget_table(), "a figure does what another one does");
}

OperationWord root_motion_word() {
  return word_of("root_motion", root_motion_table(), "what carries the figure is taken out of its pose");
}

}  // namespace tweenfall::document::graphs
