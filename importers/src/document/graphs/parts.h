#pragma once

// What graphs are made of: each part's form, and how it is read. Names that stand for nothing are not looked up here:
// a graph is held against nodes and clips as a whole.

#include <tweenfall/anim/graph.h>

#include "document/fields/table.h"

#include <string>
#include <vector>

namespace tweenfall::document::graphs {

// A number, keys over the graph's time, or {"parameter": name}.
[[nodiscard]] fields::FormOf number_form(Form plain);
[[nodiscard]] GraphNumber read_number(const json::Value& value, Building& building);
// A number; true is 1 and false is 0.
const Form* setting_form(FormStore& store, const ValueForms& values);
[[nodiscard]] double read_setting(const json::Value& value);

const Form* mask_form(FormStore& store, const ValueForms& values);
[[nodiscard]] std::vector<MaskPart> read_mask(const json::Value& value, Building& building);

// A pose: one of the operations
const Form* pose_form(FormStore& store, const ValueForms& values);
void read_pose(const json::Value& value, GraphPose& pose, Building& building);

// One word each, and what else is said beside it
struct OperationWord {
  std::vector<fields::Row<GraphPose>> rows;  // the first names the operation
};
[[nodiscard]] OperationWord clip_word();
[[nodiscard]] OperationWord rest_word();
[[nodiscard]] OperationWord blend_word();
[[nodiscard]] OperationWord layers_word();
[[nodiscard]] OperationWord space_word();
[[nodiscard]] OperationWord machine_word();

template <class Operation>
[[nodiscard]] Operation& as(GraphPose& pose) {
  if (auto* operation = std::get_if<Operation>(&pose.operation)) return *operation;
  return pose.operation.emplace<Operation>();
}

}  // namespace tweenfall::document::graphs
