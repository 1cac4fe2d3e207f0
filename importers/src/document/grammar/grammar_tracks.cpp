#include <tweenfall/curves/barycentric.h>
#include <tweenfall/curves/number_text.h>

#include "document/grammar/grammar_functions.h"
#include "document/grammar/grammar_parts.h"
#include "document/report/foreign_words.h"
#include "document/report/spellings.h"
#include "document/report/suggestion.h"

#include <utility>

namespace tweenfall::document {

namespace {

// The value of the first key of a track, in any of its forms, or the first of a mix; null when there is none.
json::Value first_key_value(const json::Value& track) {
  if (const json::Value mix = track.find("barycentric")) {
    const json::Value values = mix.find("values");
    return values && !values.items().empty() ? values.items().front() : json::Value();
  }
  const json::Value keys = track.is(json::Value::Kind::object) ? track.find("keys") : track;
  if (!keys || keys.items().empty()) return {};
  const json::Value key = keys.items().front();
  if (key.is(json::Value::Kind::list)) return key.items().size() > 1 ? key.items()[1] : json::Value();
  return key.find("v");
}

bool has_function(const json::Value& track) {
  for (const std::string& name : FunctionForms::names())
    if (track.find(name)) return true;
  return false;
}

// The forms of tracks for one kind of value, with its options.
struct TrackKind {
  std::string name;  // of its definitions
  const Form* value = nullptr;
  const Form* rate = nullptr;  // null: the value switches, without eases or tangents
  bool turns = false;          // a rotation: rates are angular velocities; no tangents from neighboring keys
  std::vector<Field> options{};
  TrackFunctions functions{};
  std::vector<Field> key_options{};  // additional fields of keys written as objects
  bool mixes = true;                 // whether values can be mixed by weights
  std::vector<Field> made_of_numbers{};
};

class TrackForms {
 public:
  TrackForms(FormStore& store, const ValueForms& values) : functions(store, values), store_(store), values_(values) {
    outside_words_ = store_.add(
        words_of("what happens outside the keys", {"hold", "linear", "repeat", "repeat-offset", "pingpong"}));
    overlong_ = store_.add(words_of("what gives way to overlong handles", {"keep-ratio", "keep-start", "contain"}));
    ends_ = store_.add(words_of("what lies beyond the end keys for automatic slopes", {"secant", "flat", "wrap"}));
  }

  const Form* keys(const TrackKind& kind) {
    const Form* tangent = nullptr;
    if (kind.rate) {
      const Form* words =
          store_.add(kind.turns ? words_of("", {"auto", "flat", "vector"})
                                : words_of("", {"auto", "flat", "vector", "aligned", "mirrored", "plateau",
                                                "auto-clamped", "auto-chord", "auto-mix", "auto-ease"}));
      Form handle = object_of("a tangent with \"rate\" or \"kind\", and \"weight\"",
                              {{"rate", kind.rate, "value per second"},
                               {"kind", words, "a word in place of a rate"},
                               {"weight", share(), "the handle's share of the span", false, number_text(1.0 / 3.0)}});
      handle.together = {exactly_one({"rate", "kind"})};
      Form form = choice_of("a tangent: \"auto\", \"flat\", a rate in value per second, or {\"rate\", \"weight\"}",
                            {words, kind.rate, store_.add(handle)});
      form.definition = "tangent-" + kind.name;
      tangent = store_.add(std::move(form));
    }
    Form row;
    row.kind = Form::Kind::tuple;
    row.what = kind.rate ? "a key: [time, value], [time, value, ease] or {\"t\", \"v\", ...}"
                         : "a key: [time, value] or {\"t\", \"v\"}";
    row.parts = {values_.key_time, kind.value};
    if (kind.rate) row.parts.push_back(values_.ease);
    row.fewest = 2;
    row.on_one_line = true;
    row.instead = key_meant;
    Form full = object_of(row.what, {{"t", values_.key_time, "time", true, {}, {"time", "at", "frame"}},
                                     {"v", kind.value, "value", true, {}, {"value"}}});
    if (kind.rate) {
      full.fields.push_back({"ease",
                             values_.ease,
                             "how the curve leaves the key",
                             false,
                             "\"smooth-clamped\"",
                             {"easing", "interpolation"}});
      full.fields.push_back({"in", tangent, "slope on arrival", false, "", {"handle_left", "intangent"}});
      full.fields.push_back({"out", tangent, "slope on leaving", false, "", {"handle_right", "outtangent"}});
      full.fields.push_back({"v_in", kind.value, "value on arrival, where the curve jumps"});
      full.together = {at_most_one({"ease", "out"})};
    }
    for (const Field& option : kind.key_options) full.fields.push_back(option);
    full.on_one_line = true;
    Form key = choice_of(row.what, {store_.add(row), store_.add(full)});
    key.definition = "key-" + kind.name;
    Form list = list_of(store_.add(std::move(key)), "a list of keys");
    list.definition = "keys-" + kind.name;
    list.one_per_line = true;
    return store_.add(std::move(list));
  }

  const Form* object(const TrackKind& kind, const Form* keys) {
    Form form = object_of("a track: a list of keys, or an object with \"keys\"", kind.options);
    form.definition = "track-" + kind.name;
    form.said_of = said_of_field_of_track;
    if (kind.rate) {
      const Form* beyond = outside(kind);
      form.fields.push_back({"before", beyond, "before the first key", false, "\"hold\"", {"preinfinity"}});
      form.fields.push_back(
          {"after", beyond, "after the last key", false, "\"hold\"", {"postinfinity", "extrapolation", "extend"}});
      form.fields.push_back(
          {"overlong", overlong_, "what gives way where handles would turn time", false, "\"keep-ratio\""});
      form.fields.push_back({"ends", ends_, "what automatic slopes see beyond the ends", false, "\"secant\""});
    }
    std::vector<std::string> sources = {"keys"};
    form.fields.push_back({"keys", keys, "the keys, in order of time"});
    for (const Field& function : kind.functions.endless) {
      form.fields.push_back(function);
      sources.push_back(function.name);
      form.together.push_back(at_most_one({"before", function.name}));
      form.together.push_back(at_most_one({"after", function.name}));
      form.together.push_back(at_most_one({"overlong", function.name}));
      form.together.push_back(at_most_one({"ends", function.name}));
    }
    for (const Field& function : kind.functions.passing) {
      form.fields.push_back(function);
      sources.push_back(function.name);
      if (form.field("turn")) form.together.push_back(at_most_one({"turn", function.name}));
      form.together.push_back(at_most_one({"overlong", function.name}));
      form.together.push_back(at_most_one({"ends", function.name}));
    }
    for (const Field& made : kind.made_of_numbers) add_alone(form, made, sources);
    if (kind.rate && kind.mixes) {
      add_alone(form, mix_of(kind), sources);
      if (kind.name == "euler") form.together.push_back(at_most_one({"modifiers", "barycentric"}));
    }
    if (kind.functions.parameters) {
      form.fields.push_back({"parameters", functions.parameters(), "numbers that the expression calls by name"});
      form.together.push_back({Together::Rule::first_needs_second, {"parameters", "expression"}});
    }
    form.together.insert(form.together.begin(), exactly_one(std::move(sources)));
    return store_.add(std::move(form));
  }

  // Adds a source that has its own rules outside.
  static void add_alone(Form& form, const Field& source, std::vector<std::string>& sources) {
    form.fields.push_back(source);
    sources.push_back(source.name);
    for (const char* option : {"turn", "before", "after", "overlong", "ends", "mix", "hue"})
      if (form.field(option)) form.together.push_back(at_most_one({option, source.name}));
  }

  Field mix_of(const TrackKind& kind) {
    if (!weight_) {
      TrackKind numbers{
          "mix-weight", values_.number, values_.number, false, {}, functions.of_numbers("of the whole", false)};
      numbers.mixes = false;
      weight_ = either(numbers);
    }
    const std::size_t most = most_mixed_curves;
    Form mix =
        object_of("a mix: {\"values\", \"weights\"}",
                  {{"values", store_.add(list_of(kind.value, "a list of values", 1, most)), "what is mixed", true},
                   {"weights", store_.add(list_of(weight_, "a list of tracks of numbers", 1, most)),
                    "a track of numbers for each value; each counts as a part of their sum", true}});
    mix.definition = "mix-" + kind.name;
    return {"barycentric", store_.add(std::move(mix)), "a mix of values by weights that are tracks"};
  }

  // A word, or an object for rules that need a number.
  const Form* outside(const TrackKind& kind) {
    const Form* plays = store_.add(words_of("a way to repeat", {"repeat", "repeat-offset", "pingpong"}));
    Form full = object_of(
        "an outside: {\"mode\", \"count\"} or {\"slope\"}",
        {{"mode", plays, "how it repeats"}, {"count", values_.positive, "plays beyond this end; absent: without end"}});
    full.on_one_line = true;
    full.together = {{Together::Rule::first_needs_second, {"count", "mode"}}};
    if (kind.turns || kind.name == "weights") {
      full.what = "an outside: {\"mode\", \"count\"}";
      full.fields[0].required = true;
    } else {
      full.fields.push_back({"slope", kind.rate, "straight on, in value per second"});
      full.together.insert(full.together.begin(), exactly_one({"mode", "slope"}));
    }
    Form form = choice_of("what happens outside the keys", {outside_words_, store_.add(std::move(full))});
    form.definition = "outside-" + kind.name;
    return store_.add(std::move(form));
  }

  // Keys alone, or an object, for tracks of one kind only.
  const Form* either(const TrackKind& kind) {
    const Form* list = keys(kind);
    return store_.add(choice_of("a track: a list of keys, or an object with \"keys\"", {list, object(kind, list)}));
  }

  const Form* rotation() {
    const Form* turn = store_.add(words_of("which way around", {"short", "long"}));
    const TrackKind euler{"euler",
                          values_.euler,
                          values_.vector,
                          true,
                          {relative(),
                           {"order", values_.euler_order, "", false, "\"XYZ\"", {"rotateorder", "rotation_order"}},
                           modifiers(3)}};
    const TrackKind quaternion{"quat",
                               values_.quaternion,
                               values_.vector,
                               true,
                               {relative(), {"turn", turn, "way around", false, "\"short\""}},
                               {{}, rotation_spline_fields(store_, values_), false},
                               {{"turn", key_turn(turn), "the way to the next key"}}};
    const TrackKind axis_angle{"axis-angle", values_.axis_angle, values_.vector, true, {relative()}};
    const TrackKind degrees{"degrees",
                            values_.number,
                            values_.number,
                            true,
                            {{"axis", values_.axis, "what the degrees turn about", true}, relative(), modifiers(1)},
                            functions.of_numbers("degrees", true)};
    struct Spelled {
      const Form *list, *object;
    };
    const auto made = [&](const TrackKind& kind) {
      const Form* list = keys(kind);
      return Spelled{list, object(kind, list)};
    };
    const Spelled in_euler = made(euler), in_quat = made(quaternion), in_axis_angle = made(axis_angle);
    const Form* in_degrees = object(degrees, keys(degrees));
    Form form = choice_of("a track of rotations: a list of keys, or an object with \"keys\"",
                          {in_euler.list, in_euler.object, in_quat.list, in_quat.object, in_axis_angle.list,
                           in_axis_angle.object, in_degrees});
    form.select = [=](const json::Value& value) -> const Form* {
      const bool list = value.is(json::Value::Kind::list);
      if (!list && !value.is(json::Value::Kind::object)) return nullptr;
      const bool has_axis = static_cast<bool>(value.find("axis"));
      if (!list && !has_axis && (value.find("spline") || value.find("bezier"))) return in_quat.object;
      if (!list && (has_axis || has_function(value))) return in_degrees;
      const json::Value first = first_key_value(value);
      const Spelled& spelled = first && first.find("quat")    ? in_quat
                               : first && first.find("angle") ? in_axis_angle
                                                              : in_euler;
      return list ? spelled.list : spelled.object;
    };
    return store_.add(std::move(form));
  }

  const Form* key_turn(const Form* ways) {
    Form whole;
    whole.kind = Form::Kind::number;
    whole.what = "a whole number of turns, -1000000 to 1000000";
    whole.whole = true;
    whole.low = -1e6;
    whole.high = 1e6;
    Form told = object_of("a turn: {\"way\", \"turns\"} or {\"axis\", \"turns\"}",
                          {{"way", ways, "way around; absent: as the track says"},
                           {"axis", values_.axis, "the way that turns counterclockwise about it"},
                           {"turns", store_.add(std::move(whole)), "whole turns on top", false, "0"}});
    told.together = {at_most_one({"way", "axis"})};
    told.on_one_line = true;
    Form form = choice_of("\"short\", \"long\", or {\"way\", \"turns\"} or {\"axis\", \"turns\"}",
                          {ways, store_.add(std::move(told))});
    form.definition = "turn";
    return store_.add(std::move(form));
  }

  // User tracks: the kind is stated, or else that of the first value.
  const Form* user() {
    const auto kind_field = [&](const std::string& kind, bool required) {
      return Field{"kind", store_.add(words_of("the kind " + json::in_quotes(kind), {kind})), "kind of value",
                   required};
    };
    Form plain_text;
    plain_text.kind = Form::Kind::text;
    plain_text.what = "a text; one that starts with '#' needs \"kind\": \"text\" on the track";
    plain_text.pattern = "^(?!#)";
    plain_text.fits = [](std::string_view text) { return text.substr(0, 1) != "#"; };
    Form any_text;
    any_text.kind = Form::Kind::text;
    any_text.what = "a text";

    const TrackKind number{"number",
                           values_.number,
                           values_.number,
                           false,
                           {kind_field("number", false), modifiers(1)},
                           functions.of_numbers("the value's unit", true)};
    const TrackKind swinging{"swinging-vector",
                             values_.vector,
                             values_.vector,
                             false,
                             {kind_field("vector", false), modifiers(3)},
                             functions.of_places("the value's unit")};
    const TrackKind color{
        "user-color", values_.color, values_.vector_4, false, {kind_field("color", false), space(), hue()}};
    const TrackKind truth{"switch", values_.boolean, nullptr, false, {kind_field("switch", false)}};
    const TrackKind text{"text", store_.add(plain_text), nullptr};
    const TrackKind said_text{"said-text", store_.add(any_text), nullptr, false, {kind_field("text", true)}};
    struct Made {
      std::string kind;
      const Form *list, *object;
    };
    std::vector<Made> made;
    Form form = choice_of("a track: a list of keys, or an object with \"keys\"", {});
    const auto add = [&](const std::string& kind, const TrackKind& what) {
      const Form* list = keys(what);
      made.push_back({kind, list, object(what, list)});
      if (what.name != "said-text") form.alternatives.push_back(list);
      form.alternatives.push_back(made.back().object);
    };
    add("number", number);
    add("vector-2", {"vector-2",
                     values_.vector_2,
                     values_.vector_2,
                     false,
                     {kind_field("vector", false), modifiers(2)},
                     functions.of_vectors(2)});
    add("vector-3", swinging);
    add("vector-4", {"vector-4",
                     values_.vector_4,
                     values_.vector_4,
                     false,
                     {kind_field("vector", false), modifiers(4)},
                     functions.of_vectors(4)});
    add("color", color);
    add("switch", truth);
    add("text", text);
    add("said-text", said_text);

    // Used where the kind is not a valid word.
    Form any_track = object_of(
        "a track", {{"kind", store_.add(words_of("a kind of value", {"number", "vector", "color", "switch", "text"})),
                     "kind of value"},
                    {"keys", values_.any, ""},
                    {"before", values_.any, ""},
                    {"after", values_.any, ""},
                    {"overlong", overlong_, ""},
                    {"ends", ends_, ""},
                    {"modifiers", values_.any, ""},
                    {"space", values_.any, ""},
                    {"hue", values_.any, ""}});
    for (const std::string& name : FunctionForms::names()) any_track.fields.push_back({name, values_.any, ""});
    any_track.fields.push_back({"barycentric", values_.any, ""});
    any_track.fields.push_back({"parameters", values_.any, ""});
    const Form* unknown = store_.add(std::move(any_track));
    form.select = [made, unknown](const json::Value& value) -> const Form* {
      const bool list = value.is(json::Value::Kind::list);
      if (!list && !value.is(json::Value::Kind::object)) return nullptr;
      const json::Value first = first_key_value(value);
      std::string kind;
      if (const json::Value said = value.find("kind")) {
        kind = said.is(json::Value::Kind::text) ? said.text() : "";
        if (kind == "text") kind = "said-text";
      } else if (first) {
        switch (first.kind()) {
          case json::Value::Kind::number:
            kind = "number";
            break;
          case json::Value::Kind::boolean:
            kind = "switch";
            break;
          case json::Value::Kind::text:
            kind = first.text().substr(0, 1) == "#" ? "color" : "text";
            break;
          case json::Value::Kind::list:
            kind = "vector";
            break;
          default:
            kind = "number";
            break;
        }
      } else {
        kind = FunctionForms::dimension(value) > 1 ? "vector" : "number";
      }
      if (kind == "vector") {
        const std::size_t size = first ? first.items().size() : FunctionForms::dimension(value);
        kind = size == 2 ? "vector-2" : size == 4 ? "vector-4" : "vector-3";
      }
      for (const Made& each : made)
        if (each.kind == kind) return list ? each.list : each.object;
      return unknown;
    };
    return store_.add(std::move(form));
  }

  Field relative() const {
    return {"relative", values_.boolean, "compose with the node's value instead of replacing it", false, "false"};
  }
  Field space() {
    if (!space_)
      space_ = store_.add(
          words_of("a color space", {"oklab", "linear", "srgb", "oklch", "hsl", "hsv", "hwb", "lab", "lch"}));
    return {"space", space_, "where colors are mixed", false, "\"oklab\""};
  }
  Field hue() {
    if (!hue_)
      hue_ = store_.add(words_of("which way around the hue goes", {"shorter", "longer", "increasing", "decreasing"}));
    return {"hue", hue_, "which way around, in spaces with a hue", false, "\"shorter\""};
  }
  Field mix() {
    return {"mix", store_.add(words_of("a way to mix", {"linear", "log"})), "log: ratios are interpolated", false,
            "\"linear\""};
  }

  Field aspect() {
    return {"aspect", keys({"aspect", values_.positive, values_.number}),
            "keys of the ratio of width to height, x to y, mixed by its logarithm; the area stays 1"};
  }

  Field modifiers(std::size_t size) {
    if (!modifiers_) modifiers_ = modifiers_form(store_, values_);
    return modifiers_field(store_, modifiers_, size);
  }

  const FunctionForms functions;

 private:
  const Form* share() {
    if (!share_) {
      Form form;
      form.kind = Form::Kind::number;
      form.what = "a share of the span, above 0";
      form.low = 0;
      form.above_low = true;
      share_ = store_.add(std::move(form));
    }
    return share_;
  }

  FormStore& store_;
  const ValueForms& values_;
  const Form* outside_words_ = nullptr;
  const Form* overlong_ = nullptr;
  const Form* ends_ = nullptr;
  const Form* share_ = nullptr;
  const Form* weight_ = nullptr;  // a track of numbers within a track
  const Form* space_ = nullptr;
  const Form* hue_ = nullptr;
  const Form* modifiers_ = nullptr;
};

}  // namespace

const Form* tracks_form(FormStore& store, const ValueForms& values) {
  TrackForms make(store, values);
  Form tracks = object_of("an object with tracks by name", {});
  tracks.definition = "tracks";
  tracks.one_per_line = true;
  tracks.instead = member_meant;
  tracks.endings = {
      {".position", make.either({"position",
                                 values.vector,
                                 values.vector,
                                 false,
                                 {make.relative(), make.modifiers(3)},
                                 make.functions.of_places("m")})},
      {".rotation", make.rotation()},
      {".scale", make.either({"scale",
                              values.scale,
                              values.scale,
                              false,
                              {make.relative(), make.mix(), make.modifiers(3)},
                              make.functions.of_scales(),
                              {},
                              true,
                              {make.aspect()}})},
      {".color", make.either({"color", values.color, values.vector_4, false, {make.space(), make.hue()}})},
      {".weights", make.either({"weights", values.numbers, values.numbers, false, {}, {}, {}, false})}};
  const auto component = [&](const std::string& name, std::vector<Field> options, const std::string& unit) {
    return make.either({name, values.number, values.number, false, std::move(options),
                        make.functions.of_numbers(unit, name == "angle")});
  };
  const Form* length = component("coordinate", {make.relative(), make.modifiers(1)}, "m");
  const Form* angle = component(
      "angle", {make.relative(), {"order", values.three_axes, "", false, "\"XYZ\""}, make.modifiers(1)}, "degrees");
  const Form* factor = component("factor", {make.relative(), make.modifiers(1)}, "of the size");
  const Form* channel = component("channel", {make.modifiers(1)}, "linear, 0 to 1");
  for (const char axis : {'x', 'y', 'z'}) {
    tracks.endings.push_back({std::string(".position.") + axis, length});
    tracks.endings.push_back({std::string(".rotation.") + axis, angle});
    tracks.endings.push_back({std::string(".scale.") + axis, factor});
  }
  for (const char part : {'r', 'g', 'b', 'a'}) tracks.endings.push_back({std::string(".color.") + part, channel});
  tracks.others = make.user();
  tracks.name_pattern = "^[\\s\\S]+\\.[^.]+$";
  tracks.name_meant = property_meant;
  tracks.name_fault = [](std::string_view name) -> std::string {
    const std::size_t dot = name.rfind('.');
    if (dot != std::string_view::npos && dot > 0 && dot + 1 < name.size()) return {};
    return "a track is named \"node.property\", such as \"ball.position\"; found " + json::in_quotes(name);
  };
  return store.add(std::move(tracks));
}

const Form* weight_keys_form(FormStore& store, const ValueForms& values) {
  return TrackForms(store, values).keys({"weight", values.number, values.number});
}

}  // namespace tweenfall::document
