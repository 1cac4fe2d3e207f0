#include "document/fields/change.h"

namespace tweenfall::document::fields {

namespace {

const Table<Twist>& added_table() {
  static const Table<Twist> table("what is added",
                                  {{"linear", &ValueForms::vector, "m/s", member<Twist>(&Twist::linear)},
                                   {"angular", &ValueForms::vector, "degrees/s", turning<Twist>(&Twist::angular)}});
  return table;
}

const Row<TakeOver>& source_row() {
  using Velocity = TakeOver::Velocity;
  static const Row<TakeOver> row = one_of<TakeOver, Velocity>(
      "source", "a velocity: \"curve\", \"step\" or \"zero\"",
      {{"curve", Velocity::curve}, {"step", Velocity::step}, {"zero", Velocity::zero}}, "", &TakeOver::velocity);
  return row;
}

const Table<TakeOver>& take_over_table() {
  const Meaning<TakeOver> average = {[](const json::Value& value, TakeOver& out, Building&) {
    out.velocity = TakeOver::Velocity::average;
    out.average_over = value.number();
  }};
  static const Table<TakeOver> table("a velocity: {\"source\" or \"average\", \"scale\", \"add\"}",
                                     {source_row(),
                                      {"average", &ValueForms::positive, "over the last seconds", average},
                                      {"scale", &ValueForms::number, "factor", member<TakeOver>(&TakeOver::scale)},
                                      part<TakeOver>("add", added_table(), "after scaling", &TakeOver::add)});
  return table;
}

const Row<TakeOver>& overlap_words() {
  using Overlap = TakeOver::Overlap;
  static const Row<TakeOver> row = one_of<TakeOver, Overlap>(
      "overlap", "what becomes of overlap: \"push\", \"ignore\", \"rewind\" or \"veto\"",
      {{"push", Overlap::push}, {"ignore", Overlap::ignore}, {"rewind", Overlap::rewind}, {"veto", Overlap::veto}}, "",
      &TakeOver::overlap);
  return row;
}

const Table<TakeOver>& rewind_table() {
  const Meaning<TakeOver> rewind = {[](const json::Value& value, TakeOver& out, Building&) {
    out.overlap = TakeOver::Overlap::rewind;
    out.rewind_within = value.number();
  }};
  static const Table<TakeOver> table("a rewind", {{"rewind", &ValueForms::not_negative,
                                                   "by at most so many seconds, else it is pushed", rewind, true}});
  return table;
}

}  // namespace

const Form* overlap_form(FormStore& store, const ValueForms& values) {
  return store.add(
      choice_of("what becomes of overlap: \"push\", \"ignore\", \"rewind\", {\"rewind\": seconds} or \"veto\"",
                {overlap_words().form.in(store, values), store.add(rewind_table().form(store, values))}));
}

void read_overlap(const json::Value& value, TakeOver& take_over, Building& building) {
  if (value.is(json::Value::Kind::text)) overlap_words().meaning.read(value, take_over, building);
  rewind_table().read(value, take_over, building);
}

const Form* take_over_form(FormStore& store, const ValueForms& values) {
  Form full = take_over_table().form(store, values);
  full.together = {at_most_one({"source", "average"})};
  Form form = choice_of("a velocity: \"curve\", \"step\", \"zero\", or {\"source\" or \"average\", \"scale\", \"add\"}",
                        {source_row().form.in(store, values), store.add(std::move(full))});
  form.definition = "velocity";
  return store.add(std::move(form));
}

void read_take_over(const json::Value& value, TakeOver& take_over, Building& building) {
  if (value.is(json::Value::Kind::text)) source_row().meaning.read(value, take_over, building);
  take_over_table().read(value, take_over, building);
}

}  // namespace tweenfall::document::fields
