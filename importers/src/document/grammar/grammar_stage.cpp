#include "document/fields/things.h"
#include "document/grammar/grammar_parts.h"

#include <algorithm>
#include <utility>

namespace tweenfall::document {

namespace {

const Form* force_form(FormStore& store, const ValueForms& values) {
  const Form* drag = store.add(object_of("a drag: {\"linear\", \"quadratic\", \"angular\"}",
                                         {{"linear", values.not_negative, "kg/s", false, "0"},
                                          {"quadratic", values.not_negative, "kg/m", false, "0"},
                                          {"angular", values.not_negative, "kg m^2/s", false, "0"}}));
  const Form* spring = store.add(
      object_of("a spring: {\"a\", \"b\", \"anchor_a\", \"anchor_b\", \"rest_length\", \"stiffness\", \"damping\"}",
                {{"a", values.name, "node with a body", true},
                 {"b", values.name, "node with a body; absent: the world"},
                 {"anchor_a", values.vector, "on a, m", false, "[0, 0, 0]"},
                 {"anchor_b", values.vector, "on b or in the world, m", false, "[0, 0, 0]"},
                 {"rest_length", values.not_negative, "m", false, "0"},
                 {"stiffness", values.not_negative, "N/m", true},
                 {"damping", values.not_negative, "N s/m", false, "0"}}));
  Form form = object_of("a force: one of \"drag\", \"spring\"",
                        {{"drag", drag, "of the medium, on every body"}, {"spring", spring, ""}});
  form.together = {exactly_one({"drag", "spring"})};
  form.definition = "force";
  return store.add(std::move(form));
}

// One trigger; `groups` adds "all" and "any" of them.
std::vector<Field> trigger_fields(FormStore& store, const ValueForms& values) {
  Form yes;
  yes.kind = Form::Kind::boolean;
  yes.what = "true";
  yes.only_true = true;
  const Form* contact = store.add(object_of("a contact: {\"impulse\", \"speed\", \"with\"}",
                                            {{"impulse", values.not_negative, "N s, at least", false, "0"},
                                             {"speed", values.not_negative, "of approach, m/s, at least", false, "0"},
                                             {"with", values.name, "name or pattern of the other node; absent: any"}}));
  return {{"at", values.stage_time, "stage time"},
          {"marker", values.name, "an event of a clip that animates the body"},
          {"event", values.name, "an event of any playing clip"},
          {"clip_end", store.add(yes), "the last play that animates the body is over"},
          {"contact", contact, ""},
          {"asleep", values.positive, "seconds of stillness"}};
}

const Form* when_form(FormStore& store, const ValueForms& values) {
  const auto names = [](const std::vector<Field>& fields) {
    std::vector<std::string> out(fields.size());
    std::transform(fields.begin(), fields.end(), out.begin(), [](const Field& field) { return field.name; });
    return out;
  };
  std::vector<Field> fields = trigger_fields(store, values);
  Form trigger = object_of("a trigger", fields);
  trigger.together = {exactly_one(names(fields))};
  trigger.definition = "trigger";
  const Form* list = store.add(list_of(store.add(trigger), "a list of triggers"));
  fields.push_back({"all", list, "every one: instants latch, conditions must hold"});
  fields.push_back({"any", list, "whichever comes first"});
  Form when = object_of("a trigger, or \"all\" or \"any\" of a list", fields);
  when.together = {exactly_one(names(fields))};
  when.definition = "when";
  return store.add(std::move(when));
}

const Form* velocity_form(FormStore& store, const ValueForms& values) {
  const Form* source = store.add(words_of("a velocity: \"curve\", \"step\" or \"zero\"", {"curve", "step", "zero"}));
  const Form* add = store.add(object_of("what is added: {\"linear\", \"angular\"}",
                                        {{"linear", values.vector, "m/s", false, "[0, 0, 0]"},
                                         {"angular", values.vector, "degrees/s", false, "[0, 0, 0]"}}));
  Form full = object_of("a velocity: {\"source\" or \"average\", \"scale\", \"add\"}",
                        {{"source", source, "", false, "\"curve\""},
                         {"average", values.positive, "over the last seconds"},
                         {"scale", values.number, "factor", false, "1"},
                         {"add", add, "after scaling", false, "{}"}});
  full.together = {at_most_one({"source", "average"})};
  Form form = choice_of("a velocity: \"curve\", \"step\", \"zero\", or {\"source\" or \"average\", \"scale\", \"add\"}",
                        {source, store.add(full)});
  form.definition = "velocity";
  return store.add(std::move(form));
}

}  // namespace

const Form* node_form(FormStore& store, const ValueForms& values) {
  Form node = object_of("a node", {{"parent", values.name, "name of another node"},
                                   {"position", values.vector, "relative to the parent, m", false, "[0, 0, 0]"},
                                   {"rotation", values.rotation, ""},
                                   {"scale", values.scale, "", false, "1"},
                                   {"color", values.color, ""},
                                   {"group", values.name, "name for rules"},
                                   {"body", fields::body_form(store, values), ""}});
  node.definition = "node";
  return store.add(std::move(node));
}

const Form* play_form(FormStore& store, const ValueForms& values) {
  const Form* weight =
      store.add(choice_of("a weight from 0 to 1, or a list of keys in stage time",
                          {store.add(bounded("a weight from 0 to 1", 0, false, 1)), weight_keys_form(store, values)}));
  const Form* mask =
      store.add(choice_of("a name, a pattern (\"arm/*\"), or a list of them",
                          {values.name, store.add(list_of(values.name, "a list of names or patterns"))}));
  Form play = object_of("a play: {\"clip\", \"at\", \"speed\", \"weight\", \"mask\"}",
                        {{"clip", values.name, "name of a clip", true},
                         {"at", values.stage_time, "stage time of its start", false, "0"},
                         {"speed", values.number, "clip seconds per stage second", false, "1"},
                         {"weight", weight, "over what is below", false, "1"},
                         {"mask", mask, "nodes it drives; absent: all"}});
  play.definition = "play";
  return store.add(std::move(play));
}

const Form* world_form(FormStore& store, const ValueForms& values) {
  Form fraction;
  fraction.kind = Form::Kind::text;
  fraction.pattern = "^1/[1-9][0-9]{0,8}$";
  fraction.fits = [](std::string_view text) {
    return text.size() > 2 && text.size() <= 11 && text.substr(0, 2) == "1/" && text[2] != '0' &&
           text.substr(2).find_first_not_of("0123456789") == std::string_view::npos;
  };
  const Form* step =
      store.add(choice_of("a step: seconds above 0, or \"1/N\"", {values.positive, store.add(fraction)}));
  const Form* never = store.add(
      choice_of("seconds above 0, or \"never\"", {values.positive, store.add(words_of("\"never\"", {"never"}))}));
  Form forces = list_of(force_form(store, values), "a list of forces", 0);
  forces.one_a_line = true;
  Form world = object_of(
      "a world", {{"gravity", values.vector, "m/s^2", false, "[0, -9.81, 0]"},
                  {"step", step, "s", false, "\"1/240\""},
                  {"integrator", store.add(words_of("an integrator", {"exact-quadratic", "semi-implicit-euler"})), "",
                   false, "\"exact-quadratic\""},
                  {"iterations", store.add(bounded("a whole number from 1 to 10000", 1, false, 10000, true)),
                   "passes of the contact solver", false, "20"},
                  {"sleep_speed", values.not_negative, "m/s below which a body counts as still", false, "0.02"},
                  {"sleep_after", never, "seconds of stillness", false, "0.5"},
                  {"push_out_speed", values.not_negative, "m/s at which overlap is taken apart", false, "0.5"},
                  {"forces", store.add(std::move(forces)), "", false, "[]"}});
  world.definition = "world";
  return store.add(std::move(world));
}

const Form* rule_form(FormStore& store, const ValueForms& values) {
  const Form* bodies =
      store.add(choice_of("a node's name, a pattern (\"tower/*\"), or a list of them",
                          {values.name, store.add(list_of(values.name, "a list of names or patterns"))}));
  const Form* path = store.add(object_of("a path: {\"clip\", \"time\", \"anchor\"}",
                                         {{"clip", values.name, "absent: what played before"},
                                          {"time", store.add(words_of("a clock", {"run", "hold", "restart"})),
                                           "where the clip's clock stands", false, "\"run\""},
                                          {"anchor", store.add(words_of("an anchor", {"keep", "here", "ground"})),
                                           "where the path lies", false, "\"keep\""}}));
  Form settle = object_of(
      "a settle: one of \"quintic\", \"half_life\", \"dead_blend\", in seconds",
      {{"quintic", values.positive, "s"}, {"half_life", values.positive, "s"}, {"dead_blend", values.positive, "s"}});
  settle.together = {exactly_one({"quintic", "half_life", "dead_blend"})};
  Form rule = object_of("a rule of the hand-off",
                        {{"body", bodies, "whom it is about"},
                         {"group", values.name, "all nodes of a group"},
                         {"when", when_form(store, values), "", true},
                         {"to", fields::owner_form(store, values), "the new owner", true},
                         {"velocity", velocity_form(store, values), "of a released body", false, "\"curve\""},
                         {"path", path, "of a body that is taken back", false, "{}"},
                         {"settle", store.add(settle), "how the difference dies away", false, "{\"quintic\": 0.3}"},
                         {"once", values.boolean, "false: armed again after it was false", false, "true"}});
  rule.together = {exactly_one({"body", "group"})};
  rule.definition = "rule";
  return store.add(std::move(rule));
}

const Form* import_form(FormStore& store, const ValueForms& values) {
  Form import = object_of("an object with files by the name they get here", {});
  import.definition = "import";
  import.one_a_line = true;
  import.others = values.name;
  import.name_pattern = "^[^/*]+$";
  import.name_fault = [](std::string_view name)
                          ->std::string {
                            if (!name.empty() && name.find_first_of("/*") == std::string_view::npos) return {};
  return "the name of an import is not empty and has no '/' or '*'; found " + in_quotes(name);
};
return store.add(std::move(import));
}  // namespace tweenfall::document

}  // namespace tweenfall::document
