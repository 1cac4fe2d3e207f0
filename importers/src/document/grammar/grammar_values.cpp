#include <tweenfall/curves/ease.h>

#include "document/grammar/grammar_parts.h"
#include "document/read/times.h"
#include "document/report/color_words.h"
#include "document/report/spellings.h"
#include "document/report/suggestion.h"

#include <algorithm>

namespace tweenfall::document {

namespace {

bool is_hex_color(std::string_view text) {
  if (text.size() != 4 && text.size() != 7 && text.size() != 9) return false;
  if (text.front() != '#') return false;
  return std::all_of(text.begin() + 1, text.end(),
                     [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); });
}

Form text_of(std::string what, std::string pattern, std::function<bool(std::string_view)> fits) {
  Form form;
  form.kind = Form::Kind::text;
  form.what = std::move(what);
  form.pattern = std::move(pattern);
  form.fits = std::move(fits);
  return form;
}

Form time_text(std::string pattern, bool share_of_duration, std::function<bool(std::string_view)> fits) {
  Form form = text_of("", std::move(pattern), std::move(fits));
  form.why = [share_of_duration](std::string_view text) { return time_meant(text, share_of_duration); };
  return form;
}

Form named(Form form, std::string definition) {
  form.definition = std::move(definition);
  return form;
}

// Words as they are; calls by their name, with anything between the brackets: Ease::named checks that, and says why it
// is wrong.
const Form* ease_form(FormStore& store) {
  Form form;
  form.kind = Form::Kind::text;
  form.what = "an ease";
  form.definition = "ease";
  std::vector<std::string> calls;
  std::string pattern;
  for (const std::string& spelling : Ease::names()) {
    const std::size_t bracket = spelling.find('(');
    const std::string word = spelling.substr(0, bracket);
    if (bracket == std::string::npos) {
      form.words.push_back(word);
    } else if (std::find(calls.begin(), calls.end(), word) == calls.end()) {
      calls.push_back(word);
      form.hints.push_back(spelling);
      pattern += (pattern.empty() ? "" : "|") + word;
    }
  }
  if (!calls.empty()) form.pattern = "^(" + pattern + ")\\(.*\\)$";
  // The spellings that the schema knows: words as they are, calls without spaces before their bracket.
  form.fits = [calls](std::string_view text) {
    const std::size_t bracket = text.find('(');
    return bracket != std::string_view::npos &&
           std::find(calls.begin(), calls.end(), text.substr(0, bracket)) != calls.end() &&
           Ease::named(text).has_value();
  };
  form.why = [calls, alone = form.words](std::string_view text) -> std::string {
    // Names in other programs.
    if (const std::string ours = Ease::ours(text); !ours.empty()) return "; did you mean \"" + ours + "\"?";
    const std::size_t bracket = text.find('(');
    if (bracket == std::string_view::npos) return {};
    const std::string word(text.substr(0, bracket));
    if (std::find(calls.begin(), calls.end(), word) == calls.end()) {
      const bool takes_none = std::find(alone.begin(), alone.end(), word) != alone.end();
      return takes_none ? "; " + json::in_quotes(word) + " takes no values" : suggestion(word, calls);
    }
    std::string reason;
    (void)Ease::named(text, &reason);
    return reason.empty() ? std::string() : "; " + reason;
  };
  return store.add(std::move(form));
}

}  // namespace

Form bounded(std::string what, double low, bool above_low, double high, bool whole) {
  Form form;
  form.kind = Form::Kind::number;
  form.what = std::move(what);
  form.low = low;
  form.above_low = above_low;
  form.high = high;
  form.whole = whole;
  return form;
}

Form object_of(std::string what, std::vector<Field> fields) {
  Form form;
  form.kind = Form::Kind::object;
  form.what = std::move(what);
  form.fields = std::move(fields);
  return form;
}

Form list_of(const Form* element, std::string what, std::size_t fewest, std::size_t most) {
  Form form;
  form.kind = Form::Kind::list;
  form.what = std::move(what);
  form.element = element;
  form.fewest = fewest;
  form.most = most;
  return form;
}

Form map_of(const Form* element, std::string what) {
  Form map = object_of(std::move(what), {});
  map.others = element;
  map.one_per_line = true;
  map.instead = member_meant;
  map.name_pattern = "^[\\s\\S]+$";
  map.name_fault = [](std::string_view name) { return std::string(name.empty() ? "a name is not empty" : ""); };
  return map;
}

Form words_of(std::string what, std::vector<std::string> words) {
  Form form;
  form.kind = Form::Kind::text;
  form.what = std::move(what);
  form.words = std::move(words);
  return form;
}

Form choice_of(std::string what, std::vector<const Form*> alternatives) {
  Form form;
  form.kind = Form::Kind::choice;
  form.what = std::move(what);
  form.alternatives = std::move(alternatives);
  return form;
}

ValueForms::ValueForms(FormStore& store) {
  Form truth;
  truth.kind = Form::Kind::boolean;
  truth.what = "true or false";
  boolean = store.add(truth);
  any = store.add({});

  Form any_name = text_of("a name", "^[\\s\\S]+$", [](std::string_view text) { return !text.empty(); });
  any_name.instead = [](const json::Value& value) {
    return value.is(json::Value::Kind::number) ? std::string("; things are called by their names, in quotes")
                                               : std::string();
  };
  name = store.add(std::move(any_name));
  number = store.add(bounded("a number", -Form::infinite, false));
  positive = store.add(bounded("a number above 0", 0, true));
  not_negative = store.add(bounded("a number of at least 0", 0, false));
  const auto vector_of = [&](std::size_t size, const std::string& definition) {
    return store.add(named(list_of(number, "a list of " + std::to_string(size) + " numbers", size, size), definition));
  };
  vector_2 = vector_of(2, "vector-2");
  vector = vector_of(3, "vector-3");
  vector_4 = vector_of(4, "vector-4");
  any_vector = store.add(named(list_of(number, "a list of 2, 3 or 4 numbers", 2, 4), "vector"));
  numbers = store.add(named(list_of(number, "a list of numbers"), "numbers"));

  const std::string digits = "[0-9]{1,12}(\\.[0-9]{1,12})?";
  key_time = store.add(named(choice_of("a time: seconds, \"12f\", \"50%\" or \"+0.25\"",
                                       {number, store.add(time_text("^(\\+" + digits + "f?|" + digits + "[f%])$", true,
                                                                    [](std::string_view text) {
                                                                      const auto time = time_in_words(text);
                                                                      return time &&
                                                                             (time->after_previous ||
                                                                              time->unit != TimeInWords::Unit::seconds);
                                                                    }))}),
                             "key-time"));
  // A bare number in quotes is not accepted as a time.
  const auto frames = [](std::string_view text) {
    const auto time = time_in_words(text);
    return time && time->unit == TimeInWords::Unit::frames && !time->after_previous;
  };
  stage_time = store.add(named(choice_of("a stage time: seconds of at least 0, or \"12f\"",
                                         {not_negative, store.add(time_text("^" + digits + "f$", false, frames))}),
                               "stage-time"));
  length_of_time = store.add(named(choice_of("a length of time above 0: seconds, or \"12f\"",
                                             {positive, store.add(time_text("^" + digits + "f$", false, frames))}),
                                   "length-of-time"));
  ease = ease_form(store);

  Form hex = named(text_of("a color: \"#rgb\", \"#rrggbb\" or \"#rrggbbaa\"",
                           "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})$", is_hex_color),
                   "color");
  hex.instead = [](const json::Value& value) { return color_meant(value); };
  hex.why = [](std::string_view text) { return color_meant(text); };
  color = store.add(std::move(hex));
  scale = store.add(named(choice_of("a scale: a number, or a list of 3", {number, vector}), "scale"));
  axis = store.add(named(choice_of("an axis: \"x\", \"y\", \"z\", \"-x\", \"-y\", \"-z\" or a list of 3 numbers",
                                   {store.add(words_of("", {"x", "y", "z", "-x", "-y", "-z"})), vector}),
                         "axis"));
  euler_order =
      store.add(named(words_of("an order of axes: capitals turn about the turned axes (\"XYZ\"), small letters about "
                               "the fixed ones (\"xyz\")",
                               {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX", "XYX", "XZX", "YXY", "YZY", "ZXZ", "ZYZ",
                                "xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"}),
                      "euler-order"));
  three_axes =
      store.add(named(words_of("an order of three axes: capitals turn about the turned axes (\"XYZ\"), small "
                               "letters about the fixed ones (\"xyz\")",
                               {"XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX", "xyz", "xzy", "yxz", "yzx", "zxy", "zyx"}),
                      "order-of-three-axes"));

  const std::string what =
      "a rotation: {\"euler\": [x, y, z]}, {\"axis\": \"z\", \"angle\": 90} or {\"quat\": [x, y, z, w]}, in degrees";
  const Field euler_field{"euler", vector, "three angles in degrees, in the order's sequence", true};
  const Field quat_field{"quat", vector_4, "x, y, z, w; need not be of unit length", true};
  const Field axis_field{"axis", axis, "", true}, angle_field{"angle", number, "degrees, never wrapped", true};
  const auto spelled = [&](const std::string& spelling, std::vector<Field> fields) {
    Form form = object_of(what, std::move(fields));
    form.definition = "rotation-" + spelling;
    form.on_one_line = true;
    form.instead = [spelling](const json::Value& value) { return rotation_meant(value, spelling); };
    form.foremost_fault = [spelling](const json::Value& value) -> std::string {
      if (std::string angles = angles_meant(value); !angles.empty()) return angles;
      for (const char* other : {"euler", "quat", "angle"})
        if (other != spelling && value.find(other) && !value.find(spelling))
          return "rotations of one track are spelled one way; its first key has " + json::in_quotes(spelling) +
                 ", this one " + json::in_quotes(other);
      return {};
    };
    return store.add(std::move(form));
  };
  euler = spelled("euler", {euler_field});
  quaternion = spelled("quat", {quat_field});
  axis_angle = spelled("angle", {axis_field, angle_field});

  Form rest = object_of(what, {{"euler", vector, euler_field.help},
                               {"order", euler_order, "", false, "\"XYZ\""},
                               {"axis", axis, ""},
                               {"angle", number, angle_field.help, false, {}, {"degrees", "deg"}},
                               {"quat", vector_4, quat_field.help, false, {}, {"quaternion"}}});
  rest.together = {exactly_one({"euler", "angle", "quat"}),
                   {Together::Rule::first_needs_second, {"order", "euler"}},
                   {Together::Rule::first_needs_second, {"axis", "angle"}},
                   {Together::Rule::first_needs_second, {"angle", "axis"}}};
  rest.definition = "rotation";
  rest.on_one_line = true;
  rest.instead = [](const json::Value& value) { return rotation_meant(value, "euler"); };
  rest.foremost_fault = angles_meant;
  rotation = store.add(std::move(rest));
}

}  // namespace tweenfall::document
