#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/report/foreign_words.h"

namespace tweenfall::document::fields {

namespace {

using Node = NodeDescription;

const Table<Node>& place_table() {
  constexpr auto position = [](Node& node) -> Vec3& { return node.rest.position; };
  constexpr auto rotation = [](Node& node) -> Quat& { return node.rest.rotation; };
  const Meaning<Node> scale = {[](const json::Value& value, Node& node, Building&) {
                                 if (const std::optional<Vec3> given = scale_of(value)) node.rest.scale = *given;
                               },
                               "1"};
  static const Table<Node> table(
      "a node", {{"position", &ValueForms::vector, "relative to the parent, m", member<Node>(position)},
                 {"rotation", &ValueForms::rotation, "", member<Node>(rotation)},
                 {"scale", &ValueForms::scale, "", scale}});
  return table;
}

const Table<Node>& look_table() {
  const Meaning<Node> body = {
      [](const json::Value& value, Node& node, Building& building) { node.body = read_body(value, building); }};
  static const Table<Node> table("a node",
                                 {{"color", &ValueForms::color, "", member<Node>(&Node::color)},
                                  {"group", &ValueForms::name, "name for rules", member<Node>(&Node::group)},
                                  {"body", body_form, "", body, false, {}, {"rigidbody", "rigid_body", "physics"}}});
  return table;
}

}  // namespace

const Form* node_form(FormStore& store, const ValueForms& values) {
  Form node = object_of("a node", {{"parent", values.name, "name of another node"}});
  for (const Table<Node>* table : {&place_table(), &look_table()})
    for (Field& field : table->form(store, values).fields) node.fields.push_back(std::move(field));
  node.definition = "node";
  node.said_of = said_of_field_of_node;
  return store.add(std::move(node));
}

void read_place(const json::Value& value, NodeDescription& node, Building& building) {
  place_table().read(value, node, building);
}

std::vector<std::string> place_names() {
  return place_table().names();
}

void read_look(const json::Value& value, NodeDescription& node, Building& building) {
  look_table().read(value, node, building);
}

}  // namespace tweenfall::document::fields
