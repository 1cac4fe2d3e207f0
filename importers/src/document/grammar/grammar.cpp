#include "document/grammar/grammar.h"

#include "document/fields/rule.h"
#include "document/fields/things.h"
#include "document/grammar/grammar_parts.h"
#include "document/graphs/graphs.h"
#include "document/systems/systems.h"

#include <utility>

namespace tweenfall::document {

namespace {

const Form* import_form(FormStore& store, const ValueForms& values) {
  Form imports = object_of("an object with files by the name they get here", {});
  imports.definition = "import";
  imports.one_per_line = true;
  Form path = *values.name;
  path.what = "the path of a file";
  imports.others = store.add(std::move(path));
  imports.instead = [](const json::Value& value) -> std::string {
    if (!value.is(json::Value::Kind::text)) return {};
    return "; say {\"model\": " + json::on_one_line(value) + "}, and its nodes are \"model/...\"";
  };
  imports.name_pattern = "^[^/*]+$";
  imports.name_fault = [](std::string_view name) -> std::string {
    if (!name.empty() && name.find_first_of("/*") == std::string_view::npos) return {};
    return "the name of an import is not empty and has no '/' or '*'; found " + json::in_quotes(name);
  };
  return store.add(std::move(imports));
}

struct Grammar {
  FormStore store;
  const Form* root = nullptr;

  Grammar() {
    const ValueForms values(store);
    const auto named = [&](const Form* form, const std::string& what) { return store.add(map_of(form, what)); };
    const auto rows_of = [&](const Form* form, const std::string& what) {
      Form list = list_of(form, what, 0);
      list.one_per_line = true;
      return store.add(std::move(list));
    };
    Form version;
    version.kind = Form::Kind::number;
    version.what = "1, the version that this reader reads";
    version.low = version.high = document_version;
    Form text;
    text.kind = Form::Kind::text;
    text.what = "a text";
    const Form* any_text = store.add(text);
    Form frames;
    frames.kind = Form::Kind::number;
    frames.what = "frames per second above 0";
    frames.low = 0;
    frames.above_low = true;

    Form document = object_of(
        "a document: an object with \"tweenfall\": 1",
        {{"$schema", any_text, "for editors"},
         {"tweenfall", store.add(version), "the version", true},
         {"name", any_text, "", false, "\"\""},
         {"fps", store.add(frames), "what \"12f\" counts", false, "", {"frame_rate", "framerate"}},
         {"import", import_form(store, values), "files whose nodes and clips come in"},
         {"nodes",
          named(fields::node_form(store, values), "an object with nodes by name"),
          "",
          false,
          "",
          {"bodies", "objects", "entities"}},
         {"clips",
          named(clip_form(store, values), "an object with clips by name"),
          "",
          false,
          "{}",
          {"animations", "animation", "actions"}},
         {"systems", systems::form(store, values), "x' = f(x, t) by formulas, each a clip", false, "{}"},
         {"play", rows_of(fields::play_form(store, values), "a list of plays"), "absent: the only clip"},
         {"graphs", graphs::form(store, values), "what lies over the plays", false, "{}", {"graph", "animator"}},
         {"world", fields::world_form(store, values), "", false, "{}", {"physics"}},
         {"handoff",
          rows_of(fields::rule_form(store, values), "a list of rules"),
          "",
          false,
          "[]",
          {"rules", "handoffs", "hand_off", "hand-off", "triggers"}}});
    document.one_per_line = true;
    root = store.add(std::move(document));
  }
};

}  // namespace

const Form& document_form() {
  static const Grammar grammar;
  return *grammar.root;
}

}  // namespace tweenfall::document
