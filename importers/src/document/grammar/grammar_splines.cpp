#include "document/grammar/grammar_functions.h"

namespace tweenfall::document {

namespace {

// The condition at an end of a C2 spline, or of one with a slope rule.
const Form* end_form(FormStore& store, const Form* value) {
  Form held = object_of("an end: {\"rate\"} or {\"acceleration\"}, or \"not-a-knot\"",
                        {{"rate", value, "value per second"}, {"acceleration", value, "value per second squared"}});
  held.together = {exactly_one({"rate", "acceleration"})};
  held.on_one_line = true;
  const Form* word = store.add(words_of("", {"not-a-knot"}));
  const std::string what = held.what;
  return store.add(choice_of(what, {word, store.add(std::move(held))}));
}

}  // namespace

std::vector<Field> spline_fields(FormStore& store, const ValueForms& values, const Form* value,
                                 const std::string& kind) {
  const auto named = [&](const std::string& definition, Form form) {
    form.definition = definition + "-" + kind;
    return store.add(std::move(form));
  };
  const Form* points = store.add(list_of(value, "a list of two or more values", 2));
  const Form* some = store.add(list_of(value, "a list of values, one per point"));
  const Form* times = store.add(list_of(values.number, "a list of two or more times in seconds", 2));
  const Form* knots = store.add(list_of(values.number, "a list of knots in seconds"));
  Form whole;
  whole.kind = Form::Kind::number;
  whole.what = "a degree from 1 to 5";
  whole.whole = true;
  whole.low = 1;
  whole.high = 5;
  const Form* degree = store.add(std::move(whole));
  const Field duration{"duration", values.positive, "s for the whole of it", false, "1"};

  Form through =
      object_of("a spline: {\"points\", \"times\", ...}",
                {{"points", points, "it leads through all of them", true},
                 {"times", times, "s, one per point; a closed one has one more, that of the return"},
                 duration,
                 {"spacing", store.add(words_of("a spacing of the times", {"uniform", "centripetal", "chordal"})),
                  "how the duration is shared between the points", false, "\"uniform\""},
                 {"ease", values.ease, "the rule of its slopes", false, "\"natural\""},
                 {"start", end_form(store, value), "what it is held to at its start"},
                 {"end", end_form(store, value), "what it is held to at its end"},
                 {"closed", values.boolean, "back to the first point, and smooth there", false, "false"},
                 {"rates", some, "value per second, one per point"},
                 {"accelerations", some, "value per second squared, one per point: the spans are quintic"}});
  through.together = {at_most_one({"times", "duration"}),
                      at_most_one({"times", "spacing"}),
                      at_most_one({"rates", "ease"}),
                      at_most_one({"rates", "start"}),
                      at_most_one({"rates", "end"}),
                      at_most_one({"rates", "closed"}),
                      at_most_one({"closed", "start"}),
                      at_most_one({"closed", "end"}),
                      {Together::Rule::first_needs_second, {"accelerations", "rates"}}};

  Form bezier = object_of("a chain of Bezier curves: {\"degree\", \"points\", ...}",
                          {{"points", points, "end, controls, end, controls, end, ...", true},
                           {"degree", degree, "of each curve: how many controls less one", false, "3"},
                           {"times", times, "s, one per end"},
                           duration});
  bezier.together = {at_most_one({"times", "duration"})};

  Form b_spline = object_of("a B-spline: {\"degree\", \"points\", \"knots\"}",
                            {{"points", points, "control points", true},
                             {"degree", degree, "", false, "3"},
                             {"knots", knots, "s; degree + 1 more than points; absent: evenly spaced, ends clamped"},
                             duration});
  b_spline.together = {at_most_one({"knots", "duration"})};

  return {{"spline", named("spline", std::move(through)), "a spline through points"},
          {"bezier", named("bezier", std::move(bezier)), "Bezier curves, drawn by control points"},
          {"b_spline", named("b-spline", std::move(b_spline)), "a B-spline, drawn by control points"}};
}

std::vector<Field> rotation_spline_fields(FormStore& store, const ValueForms& values) {
  const Form* points = store.add(list_of(values.rotation, "a list of two or more rotations", 2));
  const Form* times = store.add(list_of(values.number, "a list of two or more times in seconds", 2));
  const Field duration{"duration", values.positive, "s for the whole of it", false, "1"};
  Form rate = object_of("an end: {\"rate\"}", {{"rate", values.vector, "angular velocity, degrees per second", true}});
  rate.on_one_line = true;
  const Form* end = store.add(std::move(rate));
  Form through = object_of("a spline: {\"points\", \"times\", ...}",
                           {{"points", points, "it leads through all of them, the short way", true},
                            {"times", times, "s, one per point"},
                            duration,
                            {"start", end, "absent: the mean of the first span"},
                            {"end", end, "absent: the mean of the last span"}});
  through.together = {at_most_one({"times", "duration"})};
  through.definition = "spline-rotation";
  Form bezier = object_of("a chain of Bezier curves: {\"points\", ...}",
                          {{"points", points, "end, two controls, end, two controls, end, ...", true},
                           {"times", times, "s, one per end"},
                           duration});
  bezier.together = {at_most_one({"times", "duration"})};
  bezier.definition = "bezier-rotation";
  return {{"spline", store.add(std::move(through)), "through rotations with continuous angular acceleration"},
          {"bezier", store.add(std::move(bezier)), "Bezier curves, drawn by control rotations"}};
}

}  // namespace tweenfall::document
