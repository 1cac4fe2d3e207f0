#include <tweenfall/importers/document.h>

#include "document/grammar/grammar.h"
#include "document/write/write.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <utility>

namespace tweenfall {

namespace document {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* free_names = "^(//|x-)";

Json one_member(const std::string& name, Json value) {
  Json object = Json::object();
  object[name] = std::move(value);
  return object;
}

class SchemaMaker {
 public:
  // The schema of a shape, or a reference to where it is defined.
  Json of(const Shape& shape) {
    if (shape.definition.empty()) return written_out(shape);
    if (definitions_.count(shape.definition) == 0) {
      definitions_[shape.definition] = Json::object();
      definitions_[shape.definition] = written_out(shape);
    }
    return one_member("$ref", "#/definitions/" + shape.definition);
  }

  Json written_out(const Shape& shape) {
    Json out = Json::object();
    if (!shape.what.empty()) out["description"] = shape.what;
    switch (shape.kind) {
      case Shape::Kind::any:
        return Json::object();
      case Shape::Kind::number:
        number(shape, out);
        break;
      case Shape::Kind::boolean:
        if (shape.only_true)
          out["const"] = true;
        else
          out["type"] = "boolean";
        break;
      case Shape::Kind::text:
        text(shape, out);
        break;
      case Shape::Kind::list:
        out["type"] = "array";
        out["items"] = of(*shape.element);
        count(out, "minItems", shape.fewest, 0);
        count(out, "maxItems", shape.most, Shape::no_limit);
        break;
      case Shape::Kind::tuple: {
        out["type"] = "array";
        Json parts = Json::array();
        for (const Shape* part : shape.parts) parts.push_back(of(*part));
        out["items"] = std::move(parts);
        count(out, "minItems", shape.fewest, 0);
        count(out, "maxItems", shape.parts.size(), Shape::no_limit);
        break;
      }
      case Shape::Kind::object:
        object(shape, out);
        break;
      case Shape::Kind::choice: {
        Json any = Json::array();
        for (const Shape* alternative : shape.alternatives) any.push_back(of(*alternative));
        out["anyOf"] = std::move(any);
        break;
      }
    }
    return out;
  }

  Json definitions() {
    Json out = Json::object();
    for (auto& [name, schema] : definitions_) out[name] = schema;
    return out;
  }

 private:
  static void count(Json& out, const char* name, std::size_t number, std::size_t usual) {
    if (number != usual) out[name] = (static_cast<double>(number));
  }

  static void number(const Shape& shape, Json& out) {
    if (shape.low == shape.high) {
      out["const"] = shape.low;
      return;
    }
    out["type"] = (shape.whole ? "integer" : "number");
    if (std::isfinite(shape.low)) out[shape.above_low ? "exclusiveMinimum" : "minimum"] = shape.low;
    if (std::isfinite(shape.high)) out["maximum"] = shape.high;
  }

  static void text(const Shape& shape, Json& out) {
    Json fitting = Json::object();
    fitting["type"] = "string";
    if (!shape.pattern.empty()) fitting["pattern"] = shape.pattern;
    const Json words = one_member("enum", shape.words);
    if (!shape.words.empty() && !shape.pattern.empty())
      out["anyOf"] = {words, fitting};
    else
      out.update(shape.words.empty() ? fitting : words);
  }

  void object(const Shape& shape, Json& out) {
    out["type"] = "object";
    Json properties = Json::object(), required = Json::array();
    for (const Field& field : shape.fields) {
      Json schema = of(*field.shape);
      // What stands beside "$ref" is not read in draft-07.
      if (schema.contains("$ref") && !(field.help.empty() && field.standard.empty()))
        schema = one_member("allOf", Json::array({std::move(schema)}));
      if (!field.help.empty()) {
        schema.erase("description");
        schema["description"] = field.help;
      }
      if (!field.standard.empty()) schema["default"] = Json::parse(field.standard);
      properties[field.name] = std::move(schema);
      if (field.required) required.push_back(field.name);
    }
    if (!properties.empty()) out["properties"] = std::move(properties);
    Json patterns = one_member(free_names, Json::object());
    for (const Ending& each : shape.endings) {
      std::string escaped;
      for (const char c : each.ending) escaped += c == '.' ? std::string("\\.") : std::string(1, c);
      patterns["^(?!//|x-)[\\s\\S]+" + escaped + "$"] = of(*each.shape);
    }
    out["patternProperties"] = std::move(patterns);
    out["additionalProperties"] = shape.others ? of(*shape.others) : Json(false);
    if (!shape.name_pattern.empty())
      out["propertyNames"] = one_member(
          "anyOf", Json::array({one_member("pattern", free_names), one_member("pattern", shape.name_pattern)}));
    if (!required.empty()) out["required"] = std::move(required);
    together(shape, out);
  }

  static void together(const Shape& shape, Json& out) {
    Json rules = Json::array(), needs = Json::object();
    for (const Together& rule : shape.together) {
      if (rule.rule == Together::Rule::exactly_one) {
        Json one = Json::array();
        for (const std::string& name : rule.names) one.push_back(one_member("required", Json::array({name})));
        rules.push_back(one_member("oneOf", std::move(one)));
      } else if (rule.rule == Together::Rule::at_most_one) {
        for (std::size_t i = 0; i < rule.names.size(); ++i)
          for (std::size_t k = i + 1; k < rule.names.size(); ++k)
            rules.push_back(one_member("not", one_member("required", Json::array({rule.names[i], rule.names[k]}))));
      } else {
        needs[rule.names[0]] = Json::array({rule.names[1]});
      }
    }
    if (!needs.empty()) out["dependencies"] = std::move(needs);
    if (!rules.empty()) out["allOf"] = std::move(rules);
  }

  std::map<std::string, Json> definitions_;
};

}  // namespace

}  // namespace document

std::string document_schema() {
  using namespace document;
  SchemaMaker maker;
  const Json root = maker.written_out(document_shape());
  Json out = Json::object();
  out["$schema"] = "http://json-schema.org/draft-07/schema#";
  out["title"] = "tweenfall document";
  out.update(root);
  out["definitions"] = maker.definitions();
  std::vector<JsonFault> faults;
  return write(document::Shape{}, JsonTree::parse(out.dump(), faults).root());
}

}  // namespace tweenfall
