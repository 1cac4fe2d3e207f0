#pragma once

// The parts of graphs: the form of each, and how it is read. Names are not looked up here: a graph is checked against
// nodes and clips as a whole.

#include <tweenfall/anim/graph.h>

#include "document/fields/table.h"

#include <string>
#include <vector>

namespace tweenfall::document::graphs {

// A number, keys over the graph's time, or {"parameter": name}.
[[nodiscard]] fields::FormOf number_form(Form plain);
[[nodiscard]] GraphNumber read_number(const json::Value& value, const Form& plain, Building& building);
// A node's name, three numbers, or {"node", "at"}.
const Form* place_form(FormStore& store, const ValueForms& values);
[[nodiscard]] GraphPlace read_place(const json::Value& value, Building& building);
// What to say of a pair whose parts are in the other order, or empty. One of the two is a pose's name.
[[nodiscard]] std::string swapped_pair(const json::Value& pair, bool name_first);
// A number; true is 1 and false is 0.
const Form* setting_form(FormStore& store, const ValueForms& values);
[[nodiscard]] double read_setting(const json::Value& value);

const Form* mask_form(FormStore& store, const ValueForms& values);
[[nodiscard]] std::vector<MaskPart> read_mask(const json::Value& value, Building& building);

// A pose: one of the operations
const Form* pose_form(FormStore& store, const ValueForms& values);
void read_pose(const json::Value& value, GraphPose& pose, Building& building);

// The word of each operation, and the fields beside it
struct OperationWord {
  std::vector<fields::Row<GraphPose>> rows;  // the first names the operation, which the others need
  bool has_base = false;                     // it changes a pose, its base
};
[[nodiscard]] OperationWord clip_word();
[[nodiscard]] OperationWord rest_word();
[[nodiscard]] OperationWord blend_word();
[[nodiscard]] OperationWord layers_word();
[[nodiscard]] OperationWord space_word();
[[nodiscard]] OperationWord machine_word();
[[nodiscard]] OperationWord two_bone_word();
[[nodiscard]] OperationWord look_at_word();
[[nodiscard]] OperationWord reach_word();
[[nodiscard]] OperationWord feet_word();
[[nodiscard]] OperationWord mirror_word();
[[nodiscard]] OperationWord retarget_word();
[[nodiscard]] OperationWord root_motion_word();
[[nodiscard]] OperationWord spring_word();
[[nodiscard]] OperationWord jiggle_word();

// The word of an operation that changes a pose, which is an object with the fields of a table.
template <class Operation>
[[nodiscard]] OperationWord word_of(const char* name, const fields::Table<Operation>& table, const char* help) {
  const auto read = [&table](const json::Value& value, GraphPose& pose, Building& building) {
    table.read(value, pose.operation.emplace<Operation>(), building);
  };
  return {.rows = {{name, fields::form_of(table), help, {read}}}, .has_base = true};
}

// Rows that many operations have
[[nodiscard]] Form share_form();  // a weight from 0 to 1
template <class Thing, class Access>
[[nodiscard]] fields::Row<Thing> number_row(std::string name, Form plain, std::string help, std::string standard,
                                            Access access) {
  const auto read = [access, plain](const json::Value& value, Thing& thing, Building& building) {
    std::invoke(access, thing) = read_number(value, plain, building);
  };
  return {std::move(name), number_form(std::move(plain)), std::move(help), {read, std::move(standard)}};
}
template <class Thing>
[[nodiscard]] fields::Row<Thing> weight_row() {
  return number_row<Thing>("weight", share_form(), "0 leaves the base as it is, 1 changes it wholly", "1",
                           &Thing::weight);
}
// A member that is a place, a direction, or an angle written in degrees; optional or not.
template <class Thing, class Access>
[[nodiscard]] fields::Row<Thing> place_row(std::string name, std::string help, bool required, Access access) {
  const auto read = [access](const json::Value& value, Thing& thing, Building& building) {
    std::invoke(access, thing) = read_place(value, building);
  };
  return {std::move(name), place_form, std::move(help), {read}, required};
}
template <class Thing, class Access>
[[nodiscard]] fields::Row<Thing> axis_row(std::string name, std::string help, Access access) {
  const auto read = [access](const json::Value& value, Thing& thing, Building& building) {
    if (const std::optional<Vec3> axis = axis_of(value, building.problems)) std::invoke(access, thing) = *axis;
  };
  return {std::move(name), &ValueForms::axis, std::move(help), {read}};
}
template <class Thing, class Access>
[[nodiscard]] fields::Row<Thing> angle_row(std::string name, Form form, std::string help, std::string standard,
                                           Access access) {
  const auto read = [access](const json::Value& value, Thing& thing, Building&) {
    std::invoke(access, thing) = radians(value.number());
  };
  return {std::move(name), std::move(form), std::move(help), {read, std::move(standard)}};
}

template <class Operation>
[[nodiscard]] Operation& as(GraphPose& pose) {
  if (auto* operation = std::get_if<Operation>(&pose.operation)) return *operation;
  return pose.operation.emplace<Operation>();
}

}  // namespace tweenfall::document::graphs
