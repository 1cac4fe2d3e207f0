#include "document/grammar/grammar_parts.h"

#include <string>
#include <utility>

namespace tweenfall::document {

// One modifier: an object with the name of its kind, and its range and influence.
const Form* modifiers_form(FormStore& store, const ValueForms& values) {
  const Form* number = values.number;
  const Form* not_negative = values.not_negative;
  Form whole;
  whole.kind = Form::Kind::number;
  whole.what = "a whole number of at least 0";
  whole.low = 0;
  whole.whole = true;
  const Form* count = store.add(whole);
  Form layer_count = whole;
  layer_count.what = "a whole number from 1 to 16";
  layer_count.low = 1;
  layer_count.high = 16;
  const Form* layers = store.add(std::move(layer_count));
  const Form* cycle = store.add(words_of("a way to cycle", {"none", "repeat", "repeat-offset", "mirror"}));
  const Field add{"add", values.boolean, "added to the curve, else in its place", false, "false"};

  std::vector<Field> kinds;
  const auto kind = [&](const std::string& name, const std::string& help, std::vector<Field> fields) {
    kinds.push_back({name, store.add(object_of(help, std::move(fields))), help});
  };
  kind("cycles", "the curve again and again beyond its keys",
       {{"before", cycle, "before the first key", false, "\"repeat\""},
        {"after", cycle, "after the last key", false, "\"repeat\""},
        {"plays_before", count, "how often at most; 0: without end", false, "0"},
        {"plays_after", count, "how often at most; 0: without end", false, "0"}});
  kind("noise", "smooth noise",
       {{"mix", store.add(words_of("a way to mix", {"add", "replace", "multiply"})), "", false, "\"add\""},
        {"seed", count, "another number, other noise", false, "0"},
        {"strength", number, "values reach from -strength to strength", false, "1"},
        {"scale", values.positive, "s between the zeros of the coarsest layer", false, "1"},
        {"phase", number, "s, added to the time", false, "0"},
        {"layers", layers, "each twice as fine and half as strong", false, "1"}});
  kind("polynomial", "a polynomial of time in seconds",
       {{"coefficients", values.numbers, "of 1, t, t^2, ...", true}, add});
  kind("factors", "a product of straight lines over time",
       {{"lines", store.add(list_of(values.vector_2, "a list of [slope, value at 0 s]")), "", true}, add});
  kind("function", "amplitude f(multiplier t + phase) + offset",
       {{"name", store.add(words_of("a function", {"sin", "cos", "tan", "sqrt", "ln", "sinc"})), "radians", true},
        {"amplitude", number, "", false, "1"},
        {"multiplier", number, "1/s", false, "1"},
        {"phase", number, "radians", false, "0"},
        {"offset", number, "", false, "0"},
        add});
  kind("stepped", "time in steps",
       {{"step", values.positive, "s", true},
        {"offset", number, "s, where a step begins", false, "0"},
        {"start", number, "s, where steps begin"},
        {"end", number, "s, where steps end"}});
  kind("limits", "bounds on value and time",
       {{"low", number, "least value"},
        {"high", number, "greatest value"},
        {"start", number, "s, earliest time"},
        {"end", number, "s, latest time"}});
  kind("envelope", "a band of values, stretched to one that moves",
       {{"reference", number, "", false, "0"},
        {"low", number, "of the band, from the reference", false, "-1"},
        {"high", number, "of the band, from the reference", false, "1"},
        {"points", store.add(list_of(values.vector, "a list of [time, low, high]")), "the band it is stretched to",
         true}});
  kinds.push_back({"warp", weight_keys_form(store, values), "keys of the time to show, s over s"});
  kind("placement", "stretched and moved: value_offset + value_scale curve((t - time_offset) / time_scale)",
       {{"time_offset", number, "s", false, "0"},
        {"time_scale", number, "not 0; below 0 backwards", false, "1"},
        {"value_offset", number, "", false, "0"},
        {"value_scale", number, "", false, "1"}});

  std::vector<std::string> names;
  names.reserve(kinds.size());
  for (const Field& field : kinds) names.push_back(field.name);
  Form influence;
  influence.kind = Form::Kind::number;
  influence.what = "an influence from 0 to 1";
  influence.low = 0;
  influence.high = 1;
  Form one = object_of("a modifier: {\"noise\": {...}, \"range\", \"influence\"}", std::move(kinds));
  one.fields.push_back({"range",
                        store.add(object_of("a range: {\"start\", \"end\", \"blend_in\", \"blend_out\"}",
                                            {{"start", number, "s", true},
                                             {"end", number, "s", true},
                                             {"blend_in", not_negative, "s", false, "0"},
                                             {"blend_out", not_negative, "s", false, "0"}})),
                        "where it acts; absent: everywhere"});
  one.fields.push_back({"influence", store.add(std::move(influence)), "", false, "1"});
  one.together = {exactly_one(std::move(names))};
  one.definition = "modifier";
  Form list = list_of(store.add(std::move(one)), "a list of modifiers, the innermost first");
  list.one_per_line = true;
  list.definition = "modifiers";
  return store.add(std::move(list));
}

Field modifiers_field(FormStore& store, const Form* modifiers, std::size_t size) {
  const Field over_numbers{"modifiers", modifiers, "laid over the curve"};
  if (size == 1) return over_numbers;
  Form parts = object_of("modifiers: a list, or lists by component", {});
  for (std::size_t i = 0; i < size; ++i)
    parts.fields.push_back({std::string(1, "xyzw"[i]), modifiers, "over it alone"});
  parts.definition = "modifiers-" + std::to_string(size);
  const Form* either = store.add(choice_of(parts.what, {modifiers, store.add(parts)}));
  return {"modifiers", either, "laid over the curve: a list for all components alike, or lists by component"};
}

}  // namespace tweenfall::document
