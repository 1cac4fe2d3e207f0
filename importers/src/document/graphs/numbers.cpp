#include "document/graphs/parts.h"
#include "document/tracks/read_track.h"

namespace tweenfall::document::graphs {

fields::FormOf number_form(Form plain) {
  return fields::FormOf::Make([plain = std::move(plain)](FormStore& store, const ValueForms& values) {
    Form by_parameter = object_of("{\"parameter\": name}", {{"parameter", values.name, "of the graph", true}});
    by_parameter.on_one_line = true;
    return store.add(choice_of(plain.what + ", a list of keys, or {\"parameter\": name}",
                               {store.add(plain), weight_keys_form(store, values), store.add(by_parameter)}));
  });
}

GraphNumber read_number(const json::Value& value, const Form& plain, Building& building) {
  if (value.is(json::Value::Kind::number)) return value.number();
  if (value.is(json::Value::Kind::object)) return ByParameter{text_in(value, "parameter", "")};
  if (auto curve = read_play_keys(value, building.fps, plain, 0, building.problems)) return *curve;
  return 1.0;
}

const Form* place_form(FormStore& store, const ValueForms& values) {
  Form fixed;
  fixed.kind = Form::Kind::tuple;
  fixed.what = "a place: [x, y, z], each a number, keys, or {\"parameter\": name}";
  Form number;
  number.kind = Form::Kind::number;
  number.what = "a number";
  const Form* one = number_form(std::move(number)).in(store, values);
  fixed.parts = {one, one, one};
  fixed.fewest = 3;
  const Form* numbers = store.add(std::move(fixed));
  Form at_node = object_of("a place at a node: {\"node\", \"at\"}",
                           {{"node", values.name, "in whose space the place is given", true},
                            {"at", numbers, "m; absent: the node itself", false, "[0,0,0]"}});
  at_node.on_one_line = true;
  return store.add(choice_of("a node's name, a place in the world [x, y, z], or {\"node\", \"at\"}",
                             {values.name, numbers, store.add(std::move(at_node))}));
}

GraphPlace read_place(const json::Value& value, Building& building) {
  GraphPlace place;
  if (value.is(json::Value::Kind::text)) place.node = value.text();
  const bool at_node = value.is(json::Value::Kind::object);
  if (at_node) place.node = text_in(value, "node");
  const json::Value numbers = at_node ? usable(value, "at") : value;
  if (!numbers || numbers.items().size() != 3) return place;
  for (std::size_t i = 0; i < 3; ++i)
    if (!numbers.items()[i].is(json::Value::Kind::faulty)) place.at[i] = read_number(numbers.items()[i], {}, building);
  return place;
}

std::string swapped_pair(const json::Value& pair, bool name_first) {
  const json::Items parts = pair.items();
  const auto is_name = [&](std::size_t i) { return parts[i].is(json::Value::Kind::text); };
  if (parts.size() != 2 || !is_name(name_first ? 1 : 0) || is_name(name_first ? 0 : 1)) return {};
  const std::string name = json::in_quotes(parts[name_first ? 1 : 0].text());
  return name_first ? "the pose comes before its weight: [" + name + ", weight]"
                    : "the place comes before the pose: [place, " + name + "]";
}

Form share_form() {
  return bounded("a weight from 0 to 1", 0, false, 1);
}

const Form* setting_form(FormStore& store, const ValueForms& values) {
  return store.add(choice_of("a number, true or false", {values.number, values.boolean}));
}

double read_setting(const json::Value& value) {
  if (value.is(json::Value::Kind::boolean)) return value.boolean() ? 1 : 0;
  return value.number();
}

namespace {

const fields::Table<MaskPart>& mask_part_table() {
  using fields::member;
  static const fields::Table<MaskPart> table(
      "a part of a mask",
      {{"joints", &ValueForms::name, "a name or pattern", member<MaskPart>(&MaskPart::joints), true},
       {"weight", bounded("a weight from 0 to 1", 0, false, 1), "of these joints", member<MaskPart>(&MaskPart::weight)},
       {"below", &ValueForms::boolean, "all below them too", member<MaskPart>(&MaskPart::below)}});
  return table;
}

}  // namespace

const Form* mask_form(FormStore& store, const ValueForms& values) {
  Form part = mask_part_table().listing_form(store, values);
  part.on_one_line = true;
  const Form* either = store.add(choice_of("a name, a pattern (\"arm/*\"), or {\"joints\", \"weight\", \"below\"}",
                                           {values.name, store.add(std::move(part))}));
  return store.add(choice_of("a name, a pattern (\"arm/*\"), {\"joints\", \"weight\", \"below\"}, or a list of them",
                             {either, store.add(list_of(either, "a list of parts of a mask"))}));
}

std::vector<MaskPart> read_mask(const json::Value& value, Building& building) {
  std::vector<MaskPart> parts;
  const auto add = [&](const json::Value& part) {
    if (part.is(json::Value::Kind::text)) parts.push_back({.joints = std::string(part.text())});
    if (part.is(json::Value::Kind::object)) mask_part_table().read(part, parts.emplace_back(), building);
  };
  add(value);
  for (const json::Value& part : value.items()) add(part);
  return parts;
}

}  // namespace tweenfall::document::graphs
