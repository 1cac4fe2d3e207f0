#include "document/grammar/grammar_functions.h"

namespace tweenfall::document {

namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

std::string parameter_fault(std::string_view name) {
  bool fits = !name.empty() && is_letter(name.front());
  for (const char c : name) fits = fits && (is_letter(c) || (c >= '0' && c <= '9'));
  return fits ? std::string()
              : "a parameter's name has letters, digits and \"_\" and does not start with a digit; found " +
                    json::in_quotes(name);
}

}  // namespace

FunctionForms::FunctionForms(FormStore& store, const ValueForms& values) : store_(store), values_(values) {
  const auto named = [&](const std::string& definition, Form form) {
    form.definition = definition;
    return store.add(std::move(form));
  };
  Form text;
  text.kind = Form::Kind::text;
  text.what = "an expression of t, such as \"2*cos(t)\"";
  text_ = named("expression", std::move(text));
  const Form* part = store.add(choice_of("an expression of t, or a number", {text_, values.number}));
  const auto expressions = [&](std::size_t size) {
    return named("expressions-" + std::to_string(size),
                 list_of(part, "a list of " + std::to_string(size) + " expressions of t", size, size));
  };
  expressions_2_ = expressions(2);
  expressions_3_ = expressions(3);
  expressions_4_ = expressions(4);

  Form names = object_of("an object with numbers by name", {});
  names.others = values.number;
  names.name_pattern = "^[A-Za-z_][A-Za-z0-9_]*$";
  names.name_fault = parameter_fault;
  parameters_ = named("parameters", std::move(names));

  projectile_ = named("projectile", object_of("a projectile: {\"from\", \"velocity\", \"gravity\"}",
                                              {{"from", values.vector, "m", false, "[0, 0, 0]"},
                                               {"velocity", values.vector, "m/s at time 0", true},
                                               {"gravity", values.vector, "m/s^2", false, "[0, -9.81, 0]"}}));
  pendulum_ = named(
      "pendulum",
      object_of("a pendulum: {\"angle\", \"rate\", \"length\", \"gravity\"}",
                {{"angle", values.number, "degrees from hanging down, at time 0", true},
                 {"rate", values.number, "degrees per second at time 0; fast enough, it goes over the top", false, "0"},
                 {"length", values.positive, "m", false, "1"},
                 {"gravity", values.positive, "m/s^2", false, "9.81"}}));
  Form orbit = object_of(
      "an orbit: {\"center\", \"periapsis\", \"eccentricity\", \"period\", ...}",
      {{"center", values.vector, "the heavy body, m", false, "[0, 0, 0]"},
       {"periapsis", values.positive, "least distance from the center, m", true},
       {"eccentricity", values.not_negative, "below 1 an ellipse, 1 a parabola, above a hyperbola", false, "0"},
       {"period", values.positive, "s; of ellipses"},
       {"gravitational_parameter", values.positive, "G M, m^3/s^2"},
       {"passage", values.number, "time of the periapsis, s", false, "0"},
       {"rotation", values.rotation, "turns the plane from x to the periapsis, y as it moves there"}});
  orbit.together = {exactly_one({"period", "gravitational_parameter"})};
  orbit_ = named("orbit", std::move(orbit));

  const Field duration{"duration", values.positive, "s", false, "1"};
  path_ = named(
      "path",
      object_of("a path: {\"points\", \"speed\": \"even\"}",
                {{"points", store.add(list_of(values.vector, "a list of two or more points", 2)),
                  "m; the way leads through all of them", true},
                 {"speed", store.add(words_of("a speed", {"even"})), "", false, "\"even\""},
                 {"duration", values.positive, "s for the whole way", false, "1"},
                 {"closed", values.boolean, "back to the first point", false, "false"},
                 {"ease", store.add(words_of("a tangent rule", {"natural", "catmull-rom", "centripetal", "linear"})),
                  "what shapes the way between the points", false, "\"natural\""}}));
  line_ =
      named("line",
            object_of("a line: {\"from\", \"to\", \"duration\"}",
                      {{"from", values.vector, "m", false, "[0, 0, 0]"}, {"to", values.vector, "m", true}, duration}));
  arc_ = named("arc", object_of("an arc: {\"center\", \"from\", \"axis\", \"angle\", \"duration\"}",
                                {{"center", values.vector, "m", false, "[0, 0, 0]"},
                                 {"from", values.vector, "where it begins, m", true},
                                 {"axis", values.axis, "what it turns about", false, "\"z\""},
                                 {"angle", values.number, "degrees", false, "360"},
                                 duration}));
}

Field FunctionForms::oscillator(const Form* value, const std::string& unit) const {
  const Form* form =
      store_.add(object_of("an oscillator: {\"amplitude\", \"hz\", \"phase\", \"damping\", \"center\"}",
                           {{"amplitude", value, unit, true},
                            {"hz", values_.not_negative, "cycles per second", true},
                            {"phase", values_.number, "degrees", false, "0"},
                            {"damping", values_.not_negative, "rate of decay, 1/s", false, "0"},
                            {"center", value, unit + ", added", false, value == values_.number ? "0" : "[0, 0, 0]"}}));
  return {"oscillator", form, "swings"};
}

Field FunctionForms::spring(const Form* value, const std::string& unit) const {
  const std::string nothing = value == values_.number ? "0" : "[0, 0, 0]";
  const Form* form =
      store_.add(object_of("a spring: {\"hz\", \"zeta\", \"from\", \"velocity\", \"goal\", \"goal_velocity\"}",
                           {{"hz", values_.positive, "undamped cycles per second", true},
                            {"zeta", values_.not_negative, "damping ratio; 1 is critical", false, "1"},
                            {"from", value, unit + ", at time 0", false, nothing},
                            {"velocity", value, unit + " per second at time 0", false, nothing},
                            {"goal", value, unit + ", at time 0", true},
                            {"goal_velocity", value, unit + " per second", false, nothing}}));
  return {"spring", form, "an exact damped spring after a goal"};
}

Field FunctionForms::expression(const Form* form) const {
  return {"expression", form, "a formula of t, the clip's seconds"};
}

TrackFunctions FunctionForms::of_numbers(const std::string& unit, bool angles) const {
  TrackFunctions out{{oscillator(values_.number, unit), spring(values_.number, unit)},
                     spline_fields(store_, values_, values_.number, "number"),
                     true};
  if (angles) out.endless.push_back({"pendulum", pendulum_, "swings in exact arcs of any size, degrees"});
  out.endless.push_back(expression(text_));
  return out;
}

TrackFunctions FunctionForms::of_places(const std::string& unit) const {
  TrackFunctions out{{oscillator(values_.vector, unit),
                      spring(values_.vector, unit),
                      {"projectile", projectile_, "a thrown body's way"},
                      {"orbit", orbit_, "a small body's way around a heavy one"},
                      expression(expressions_3_)},
                     spline_fields(store_, values_, values_.vector, "vector-3"),
                     true};
  out.passing.insert(out.passing.begin(), {{"path", path_, "a smooth way through points"},
                                           {"line", line_, "a straight way"},
                                           {"arc", arc_, "a way along a circle"}});
  return out;
}

TrackFunctions FunctionForms::of_scales() const {
  const Form* either = store_.add(choice_of("an expression of t, or a list of 3", {text_, expressions_3_}));
  return {{oscillator(values_.vector, "factors"), spring(values_.vector, "factors"), expression(either)},
          spline_fields(store_, values_, values_.vector, "vector-3"),
          true};
}

TrackFunctions FunctionForms::of_vectors(std::size_t size) const {
  return {{expression(size == 2 ? expressions_2_ : expressions_4_)},
          size == 2 ? spline_fields(store_, values_, values_.vector_2, "vector-2")
                    : spline_fields(store_, values_, values_.vector_4, "vector-4"),
          true};
}

std::size_t FunctionForms::dimension(const json::Value& track) {
  for (const char* name : {"projectile", "orbit", "path", "line", "arc"})
    if (track.find(name)) return 3;
  json::Value value = track.find("expression");
  const auto inside = [&](const char* function, const char* member) {
    if (const json::Value settings = track.find(function)) value = settings.find(member);
  };
  inside("oscillator", "amplitude");
  inside("spring", "goal");
  for (const char* spline : {"spline", "bezier", "b_spline"}) {
    inside(spline, "points");
    if (track.find(spline)) value = value && !value.items().empty() ? value.items().front() : json::Value();
  }
  return value && value.is(json::Value::Kind::list) ? value.items().size() : 1;
}

const std::vector<std::string>& FunctionForms::names() {
  static const std::vector<std::string> list = {"oscillator", "spring", "pendulum", "expression",
                                                "projectile", "orbit",  "path",     "line",
                                                "arc",        "spline", "bezier",   "b_spline"};
  return list;
}

}  // namespace tweenfall::document
