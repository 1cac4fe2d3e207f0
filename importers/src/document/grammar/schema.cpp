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
  // The schema of a form, or a reference to where it is defined.
  Json of(const Form& form) {
    if (form.definition.empty()) return written_out(form);
    if (definitions_.count(form.definition) == 0) {
      definitions_[form.definition] = Json::object();
      definitions_[form.definition] = written_out(form);
    }
    return one_member("$ref", "#/definitions/" + form.definition);
  }

  Json written_out(const Form& form) {
    Json out = Json::object();
    if (!form.what.empty()) out["description"] = form.what;
    switch (form.kind) {
      case Form::Kind::any:
        return Json::object();
      case Form::Kind::number:
        number(form, out);
        break;
      case Form::Kind::boolean:
        if (form.only_true)
          out["const"] = true;
        else
          out["type"] = "boolean";
        break;
      case Form::Kind::text:
        text(form, out);
        break;
      case Form::Kind::list:
        out["type"] = "array";
        out["items"] = of(*form.element);
        count(out, "minItems", form.fewest, 0);
        count(out, "maxItems", form.most, Form::no_limit);
        break;
      case Form::Kind::tuple: {
        out["type"] = "array";
        Json parts = Json::array();
        for (const Form* part : form.parts) parts.push_back(of(*part));
        out["items"] = std::move(parts);
        count(out, "minItems", form.fewest, 0);
        count(out, "maxItems", form.parts.size(), Form::no_limit);
        break;
      }
      case Form::Kind::object:
        object(form, out);
        break;
      case Form::Kind::choice: {
        Json any = Json::array();
        for (const Form* alternative : form.alternatives) any.push_back(of(*alternative));
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

  static void number(const Form& form, Json& out) {
    if (form.low == form.high) {
      out["const"] = form.low;
      return;
    }
    out["type"] = (form.whole ? "integer" : "number");
    if (std::isfinite(form.low)) out[form.above_low ? "exclusiveMinimum" : "minimum"] = form.low;
    if (std::isfinite(form.high)) out["maximum"] = form.high;
  }

  static void text(const Form& form, Json& out) {
    Json fitting = Json::object();
    fitting["type"] = "string";
    if (!form.pattern.empty()) fitting["pattern"] = form.pattern;
    const Json words = one_member("enum", form.words);
    if (!form.words.empty() && !form.pattern.empty())
      out["anyOf"] = {words, fitting};
    else
      out.update(form.words.empty() ? fitting : words);
  }

  void object(const Form& form, Json& out) {
    out["type"] = "object";
    Json properties = Json::object(), required = Json::array();
    for (const Field& field : form.fields) {
      Json schema = of(*field.form);
      // In draft-07 anything beside "$ref" is ignored.
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
    for (const Ending& each : form.endings) {
      std::string escaped;
      for (const char c : each.ending) escaped += c == '.' ? std::string("\\.") : std::string(1, c);
      patterns["^(?!//|x-)[\\s\\S]+" + escaped + "$"] = of(*each.form);
    }
    out["patternProperties"] = std::move(patterns);
    out["additionalProperties"] = form.others ? of(*form.others) : Json(false);
    if (!form.name_pattern.empty())
      out["propertyNames"] = one_member(
          "anyOf", Json::array({one_member("pattern", free_names), one_member("pattern", form.name_pattern)}));
    if (!required.empty()) out["required"] = std::move(required);
    together(form, out);
  }

  static void together(const Form& form, Json& out) {
    Json rules = Json::array(), needs = Json::object();
    for (const Together& rule : form.together) {
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
  const Json root = maker.written_out(document_form());
  Json out = Json::object();
  out["$schema"] = "http://json-schema.org/draft-07/schema#";
  out["title"] = "tweenfall document";
  out.update(root);
  out["definitions"] = maker.definitions();
  std::vector<json::Fault> faults;
  return write(document::Form{}, json::Tree::parse(out.dump(), faults).root());
}

}  // namespace tweenfall
