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

GraphNumber read_number(const json::Value& value, Building& building) {
  if (value.is(json::Value::Kind::number)) return value.number();
  if (value.is(json::Value::Kind::object)) return ByParameter{text_in(value, "parameter", "")};
  if (auto curve = read_plain_keys(value, building.problems)) return *curve;
  return 1.0;
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
