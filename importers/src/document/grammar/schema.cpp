#include <tweenfall/importers/document.h>

#include "document/grammar/grammar.h"
#include "document/write/write.h"

#include <cmath>
#include <map>
#include <utility>

namespace tweenfall {

namespace document {

namespace {

constexpr const char* free_names = "^(//|x-)";

JsonValue names_list(const std::vector<std::string>& names) {
  JsonValue list = json_list({});
  for (const std::string& name : names) list.items.push_back(json_text(name));
  return list;
}

JsonValue one_member(const std::string& name, JsonValue value) {
  JsonValue object = json_object();
  add_member(object, name, std::move(value));
  return object;
}

class SchemaMaker {
 public:
  // The schema of a shape, or a reference to where it is defined.
  JsonValue of(const Shape& shape) {
    if (shape.definition.empty()) return written_out(shape);
    if (definitions_.count(shape.definition) == 0) {
      definitions_[shape.definition] = json_object();
      definitions_[shape.definition] = written_out(shape);
    }
    return one_member("$ref", json_text("#/definitions/" + shape.definition));
  }

  JsonValue written_out(const Shape& shape) {
    JsonValue out = json_object();
    if (!shape.what.empty()) add_member(out, "description", json_text(shape.what));
    switch (shape.kind) {
      case Shape::Kind::any:
        return json_object();
      case Shape::Kind::number:
        number(shape, out);
        break;
      case Shape::Kind::boolean:
        if (shape.only_true)
          add_member(out, "const", json_boolean(true));
        else
          add_member(out, "type", json_text("boolean"));
        break;
      case Shape::Kind::text:
        text(shape, out);
        break;
      case Shape::Kind::list:
        add_member(out, "type", json_text("array"));
        add_member(out, "items", of(*shape.element));
        count(out, "minItems", shape.fewest, 0);
        count(out, "maxItems", shape.most, Shape::no_limit);
        break;
      case Shape::Kind::tuple: {
        add_member(out, "type", json_text("array"));
        JsonValue parts = json_list({});
        for (const Shape* part : shape.parts) parts.items.push_back(of(*part));
        add_member(out, "items", std::move(parts));
        count(out, "minItems", shape.fewest, 0);
        count(out, "maxItems", shape.parts.size(), Shape::no_limit);
        break;
      }
      case Shape::Kind::object:
        object(shape, out);
        break;
      case Shape::Kind::choice: {
        JsonValue any = json_list({});
        for (const Shape* alternative : shape.alternatives) any.items.push_back(of(*alternative));
        add_member(out, "anyOf", std::move(any));
        break;
      }
    }
    return out;
  }

  JsonValue definitions() {
    JsonValue out = json_object();
    for (auto& [name, schema] : definitions_) add_member(out, name, schema);
    return out;
  }

 private:
  static void count(JsonValue& out, const char* name, std::size_t number, std::size_t usual) {
    if (number != usual) add_member(out, name, json_number(static_cast<double>(number)));
  }

  static void number(const Shape& shape, JsonValue& out) {
    if (shape.low == shape.high) {
      add_member(out, "const", json_number(shape.low));
      return;
    }
    add_member(out, "type", json_text(shape.whole ? "integer" : "number"));
    if (std::isfinite(shape.low))
      add_member(out, shape.above_low ? "exclusiveMinimum" : "minimum", json_number(shape.low));
    if (std::isfinite(shape.high)) add_member(out, "maximum", json_number(shape.high));
  }

  static void text(const Shape& shape, JsonValue& out) {
    JsonValue fitting = json_object();
    add_member(fitting, "type", json_text("string"));
    if (!shape.pattern.empty()) add_member(fitting, "pattern", json_text(shape.pattern));
    JsonValue words = one_member("enum", names_list(shape.words));
    if (!shape.words.empty() && !shape.pattern.empty()) {
      add_member(out, "anyOf", json_list({std::move(words), std::move(fitting)}));
      return;
    }
    for (JsonMember& member : (shape.words.empty() ? fitting : words).members) out.members.push_back(std::move(member));
  }

  void object(const Shape& shape, JsonValue& out) {
    add_member(out, "type", json_text("object"));
    JsonValue properties = json_object(), required = json_list({});
    for (const Field& field : shape.fields) {
      JsonValue schema = of(*field.shape);
      // What stands beside "$ref" is not read in draft-07.
      if (schema.find("$ref") && !(field.help.empty() && field.standard.empty()))
        schema = one_member("allOf", json_list({std::move(schema)}));
      if (!field.help.empty()) {
        std::erase_if(schema.members, [](const JsonMember& member) { return member.name == "description"; });
        add_member(schema, "description", json_text(field.help));
      }
      if (!field.standard.empty()) {
        std::vector<JsonFault> faults;
        add_member(schema, "default", parse_json(field.standard, faults));
      }
      add_member(properties, field.name, std::move(schema));
      if (field.required) required.items.push_back(json_text(field.name));
    }
    if (!properties.members.empty()) add_member(out, "properties", std::move(properties));
    JsonValue patterns = one_member(free_names, json_object());
    for (const Ending& each : shape.endings) {
      std::string escaped;
      for (const char c : each.ending) escaped += c == '.' ? std::string("\\.") : std::string(1, c);
      add_member(patterns, "^(?!//|x-)[\\s\\S]+" + escaped + "$", of(*each.shape));
    }
    add_member(out, "patternProperties", std::move(patterns));
    add_member(out, "additionalProperties", shape.others ? of(*shape.others) : json_boolean(false));
    if (!shape.name_pattern.empty())
      add_member(out, "propertyNames",
                 one_member("anyOf", json_list({one_member("pattern", json_text(free_names)),
                                                one_member("pattern", json_text(shape.name_pattern))})));
    if (!required.items.empty()) add_member(out, "required", std::move(required));
    together(shape, out);
  }

  static void together(const Shape& shape, JsonValue& out) {
    JsonValue rules = json_list({}), needs = json_object();
    for (const Together& rule : shape.together) {
      if (rule.rule == Together::Rule::exactly_one) {
        JsonValue one = json_list({});
        for (const std::string& name : rule.names) one.items.push_back(one_member("required", names_list({name})));
        rules.items.push_back(one_member("oneOf", std::move(one)));
      } else if (rule.rule == Together::Rule::at_most_one) {
        for (std::size_t i = 0; i < rule.names.size(); ++i)
          for (std::size_t k = i + 1; k < rule.names.size(); ++k)
            rules.items.push_back(
                one_member("not", one_member("required", names_list({rule.names[i], rule.names[k]}))));
      } else {
        add_member(needs, rule.names[0], names_list({rule.names[1]}));
      }
    }
    if (!needs.members.empty()) add_member(out, "dependencies", std::move(needs));
    if (!rules.items.empty()) add_member(out, "allOf", std::move(rules));
  }

  std::map<std::string, JsonValue> definitions_;
};

}  // namespace

}  // namespace document

std::string document_schema() {
  using namespace document;
  SchemaMaker maker;
  JsonValue root = maker.written_out(document_shape());
  JsonValue out = json_object();
  add_member(out, "$schema", json_text("http://json-schema.org/draft-07/schema#"));
  add_member(out, "title", json_text("tweenfall document"));
  for (JsonMember& member : root.members) out.members.push_back(std::move(member));
  add_member(out, "definitions", maker.definitions());
  return write(document::Shape{}, out);
}

}  // namespace tweenfall
