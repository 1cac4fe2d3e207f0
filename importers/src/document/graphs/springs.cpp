#include "document/graphs/parts.h"

namespace tweenfall::document::graphs {

namespace {

using fields::member;
using fields::Row;
using fields::Table;

// The settings of a spring, as fields of any thing that has one.
template <class Thing, class Access>
std::vector<Row<Thing>> spring_rows(Access spring, bool with_gravity) {
  const auto part = [spring](auto SpringSettings::*value) {
    return member<Thing>([ spring, value ](Thing & thing) -> auto& { return spring(thing).*value; });
  };
  std::vector<Row<Thing>> rows = {{"hz", bounded("a frequency from 0 to 100,000 Hz", 0, false, 1e5),
                                   "of the spring, undamped; 0 for none", part(&SpringSettings::hz)},
                                  {"damping", bounded("a damping ratio from 0 to 100", 0, false, 100),
                                   "0 rings forever, 1 does not overshoot", part(&SpringSettings::damping)},
                                  {"steps_per_second", bounded("a number from 1 to 100,000", 1, false, 1e5),
                                   "of its grid in time", part(&SpringSettings::steps_per_second)}};
  if (with_gravity)
    rows.push_back(
        {"gravity", &ValueForms::vector, "acceleration that acts on it, m/s^2", part(&SpringSettings::gravity)});
  return rows;
}

const Table<SpringSettings>& place_spring_table() {
  static const Table<SpringSettings> table(
      "a spring", spring_rows<SpringSettings>([](SpringSettings& spring) -> SpringSettings& { return spring; }, true));
  return table;
}

const Table<SpringSettings>& turn_spring_table() {
  static const Table<SpringSettings> table(
      "a spring", spring_rows<SpringSettings>([](SpringSettings& spring) -> SpringSettings& { return spring; }, false));
  return table;
}

Row<SpringPose> spring_row(const char* name, const char* help, const Table<SpringSettings>& table,
                           std::optional<SpringSettings> SpringPose::*spring) {
  const auto read = [&table, spring](const json::Value& value, SpringPose& pose, Building& building) {
    table.read(value, (pose.*spring).emplace(), building);
  };
  return {name, fields::form_of(table), help, {read}};
}

const Table<SpringPose>& spring_table() {
  using Pose = SpringPose;
  static const Table<Pose> table(
      "a node on springs",
      {{"node", &ValueForms::name, "of the graph", member<Pose>(&Pose::node), true},
       spring_row("position", "of its place in the world", place_spring_table(), &Pose::position),
       spring_row("rotation", "of its rotation in the world", turn_spring_table(), &Pose::rotation),
       weight_row<Pose>()});
  return table;
}

const Form* swinging_joints_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(values.name, "a list of joints, each below the one before"));
}

const Table<JigglePose>& jiggle_table() {
  using Pose = JigglePose;
  static const Table<Pose> table("a chain that swings", [] {
    const auto joints = [](const json::Value& value, Pose& pose, Building&) { pose.joints = names_of(value); };
    std::vector<Row<Pose>> rows = {
        {"tip", &ValueForms::vector, "tail of the last joint, in its own space, m; absent: it is only a tail",
         member<Pose>(&Pose::tip)},
        {"joints", swinging_joints_form, "from the one nearest to the root on", {joints}, true}};
    for (Row<Pose>& row : spring_rows<Pose>([](Pose& pose) -> SpringSettings& { return pose.spring; }, true))
      rows.push_back(std::move(row));
    rows.push_back(angle_row<Pose>("limit", bounded("an angle from 0 to 180 degrees", 0, false, 180),
                                   "the farthest that a joint swings, degrees", "180", &Pose::limit));
    rows.push_back(angle_row<Pose>("ease", bounded("an angle of 0 or more degrees", 0, false),
                                   "over which it slows to a stop before the limit, degrees; absent: 0.2 rad", "",
                                   &Pose::ease));
    rows.push_back(weight_row<Pose>());
    return rows;
  }());
  return table;
}

}  // namespace

OperationWord spring_word() {
  return word_of("spring", spring_table(), "a node follows by springs");
}

OperationWord jiggle_word() {
  return word_of("jiggle", jiggle_table(), "a chain of joints swings after what carries it");
}

}  // namespace tweenfall::document::graphs
