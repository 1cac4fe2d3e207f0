#pragma once

// The parts of the table: values first, then forms made from them.

#include "document/form.h"

#include <initializer_list>

namespace tweenfall::document {

// Values that many fields share.
struct ValueForms {
  explicit ValueForms(FormStore& store);

  const Form *boolean, *name, *number, *positive, *not_negative;
  const Form *vector, *vector_2, *vector_4, *any_vector, *numbers;
  const Form *key_time, *stage_time, *length_of_time, *ease;
  const Form *color, *scale, *axis, *rotation, *euler_order, *three_axes;
  const Form *euler, *axis_angle, *quaternion;  // rotations as keys spell them
  const Form* any;
};

// Tracks and clips.
const Form* tracks_form(FormStore& store, const ValueForms& values);
const Form* clip_form(FormStore& store, const ValueForms& values);
// Keys of numbers in stage time, for weights of plays.
const Form* weight_keys_form(FormStore& store, const ValueForms& values);
// The modifiers of a track of numbers.
const Form* modifiers_form(FormStore& store, const ValueForms& values);
// Over numbers a list; over vectors one list for all components alike, or lists by component.
[[nodiscard]] Field modifiers_field(FormStore& store, const Form* modifiers, std::size_t size);

// Helpers to make forms
Form bounded(std::string what, double low, bool above_low, double high = Form::infinite, bool whole = false);
Form object_of(std::string what, std::vector<Field> fields);
Form list_of(const Form* element, std::string what, std::size_t fewest = 1, std::size_t most = Form::no_limit);
// An object whose members, all of one form, have names chosen by the author.
Form map_of(const Form* element, std::string what);
Form words_of(std::string what, std::vector<std::string> words);
Form choice_of(std::string what, std::vector<const Form*> alternatives);

inline Together exactly_one(std::vector<std::string> names) {
  return {Together::Rule::exactly_one, std::move(names)};
}
inline Together at_most_one(std::vector<std::string> names) {
  return {Together::Rule::at_most_one, std::move(names)};
}

}  // namespace tweenfall::document
