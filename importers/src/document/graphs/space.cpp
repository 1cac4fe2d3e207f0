#include "document/graphs/parts.h"

namespace tweenfall::document::graphs {

namespace {

using fields::Table;

// Places along a line are numbers, those on a plane pairs of them.
const Form* place_form(FormStore& store, const ValueForms& values) {
  return store.add(choice_of("a place: a number, or [x, y]", {values.number, values.vector_2}));
}

const Form* space_poses_form(FormStore& store, const ValueForms& values) {
  Form entry;
  entry.kind = Form::Kind::tuple;
  entry.what = "a pose and its place: [place, pose]";
  entry.parts = {place_form(store, values), values.name};
  entry.fewest = 2;
  entry.on_one_line = true;
  entry.foremost_fault = [](const json::Value& value) { return swapped_pair(value, false); };
  return store.add(list_of(store.add(std::move(entry)), "a list of [place, pose]", 1, most_blended));
}

const Form* by_form(FormStore& store, const ValueForms& values) {
  Form by = choice_of("a parameter, or a list of two",
                      {values.name, store.add(list_of(values.name, "a list of two parameters", 2, 2))});
  by.instead = [](const json::Value& value) {
    const json::Value name = value.find("parameter");
    return name && name.is(json::Value::Kind::text) ? "; write its name alone, " + json::in_quotes(name.text())
                                                    : std::string();
  };
  return store.add(std::move(by));
}

const Form* sync_form(FormStore& store, const ValueForms& values) {
  Form yes;
  yes.kind = Form::Kind::boolean;
  yes.what = "true";
  yes.only_true = true;
  return store.add(choice_of("true, or the pattern of the events that are markers (\"foot *\")",
                             {store.add(std::move(yes)), values.name}));
}

const Table<SpacePose>& space_table() {
  const auto by = [](const json::Value& value, SpacePose& space, Building&) {
    if (value.is(json::Value::Kind::text)) space.by.emplace_back(ByParameter{std::string(value.text())});
    // A faulty one counts too: the space still has two numbers.
    for (const json::Value& item : value.items()) space.by.emplace_back(ByParameter{std::string(item.text())});
  };
  const auto poses = [](const json::Value& value, SpacePose& space, Building& building) {
    for (const json::Value& item : value.items()) {
      SpacePose::Entry& entry = space.entries.emplace_back();
      if (item.items().size() != 2) continue;
      const json::Value place = item.items()[0];
      entry.pose = item.items()[1].text();
      const bool on_plane = place.is(json::Value::Kind::list) && place.items().size() == 2;
      entry.place = on_plane ? Vec2(place.items()[0].number(), place.items()[1].number()) : Vec2(place.number(), 0);
      if (place.is(json::Value::Kind::faulty) || space.by.empty()) continue;
      if (on_plane != (space.by.size() == 2))
        building.problems.add(place, on_plane ? "a space of one parameter has numbers for places"
                                              : "a space of two parameters has places [x, y]");
    }
  };
  const auto sync = [](const json::Value& value, SpacePose& space, Building&) {
    space.sync = value.is(json::Value::Kind::text) ? std::string(value.text()) : std::string();
  };
  static const Table<SpacePose> table(
      "a blend space",
      {{"bands", &ValueForms::boolean, "on a plane: weights by gradient bands, not by triangles",
        fields::member<SpacePose>(&SpacePose::bands)},
       {"by", by_form, "the parameter, or the two", {by}, true},
       {"poses", space_poses_form, "each with its place", {poses}, true},
       {"sync", sync_form, "the clips run in phase; true: by the events whose names all of them share", {sync}}});
  return table;
}

const Form* space_form(FormStore& store, const ValueForms& values) {
  return store.add(space_table().listing_form(store, values));
}

void read_space(const json::Value& value, GraphPose& pose, Building& building) {
  space_table().read(value, pose.operation.emplace<SpacePose>(), building);
}

}  // namespace

OperationWord space_word() {
  return {{{"space", space_form, "poses at places, by where a parameter is among them", {read_space}}}};
}

}  // namespace tweenfall::document::graphs
