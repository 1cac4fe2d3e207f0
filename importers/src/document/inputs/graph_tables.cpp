#include "document/graphs/parts.h"
#include "document/inputs/input_tables.h"

namespace tweenfall::document::inputs {

using fields::Row;
using fields::Table;

namespace {

template <class Thing>
Row<Thing> graph_row() {
  const auto read = [](const json::Value& value, Thing& thing, Building&) {
    thing.input.graph = value.text();
    thing.graph = value;
  };
  return {"graph", &ValueForms::name, "absent: the only one", {read}};
}

}  // namespace

const Table<OfGraph<input::Set>>& set_table() {
  using Set = OfGraph<input::Set>;
  const auto parameter = [](const json::Value& value, Set& set, Building&) {
    set.input.parameter = value.text();
    set.name = value;
  };
  const auto setting = [](const json::Value& value, Set& set, Building&) {
    set.input.value = graphs::read_setting(value);
  };
  static const Table<Set> table("a setting", {graph_row<Set>(),
                                              {"parameter", &ValueForms::name, "of the graph", {parameter}, true},
                                              {"value", graphs::setting_form, "from then on", {setting}, true}});
  return table;
}

const Table<OfGraph<input::Send>>& send_table() {
  using Send = OfGraph<input::Send>;
  const auto event = [](const json::Value& value, Send& send, Building&) {
    send.input.event = value.text();
    send.name = value;
  };
  static const Table<Send> table(
      "something sent",
      {graph_row<Send>(), {"event", &ValueForms::name, "for which its machines wait", {event}, true}});
  return table;
}

}  // namespace tweenfall::document::inputs
