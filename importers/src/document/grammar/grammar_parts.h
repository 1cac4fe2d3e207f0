#pragma once

// The table in its parts: values first, then what is made of them.

#include "document/shape.h"

#include <initializer_list>

namespace tweenfall::document {

// Values that many fields share.
struct ValueShapes {
  explicit ValueShapes(ShapeStore& store);

  const Shape *boolean, *name, *number, *positive, *not_negative;
  const Shape *vector, *vector_2, *vector_4, *any_vector, *numbers;
  const Shape *key_time, *stage_time, *length_of_time, *ease;
  const Shape *color, *scale, *axis, *rotation, *euler_order;
  const Shape *euler, *axis_angle, *quaternion;  // rotations as keys spell them
  const Shape* any;
};

// Tracks and clips.
const Shape* tracks_shape(ShapeStore& store, const ValueShapes& values);
const Shape* clip_shape(ShapeStore& store, const ValueShapes& values);
// Keys of numbers in stage time, for weights of plays.
const Shape* weight_keys_shape(ShapeStore& store, const ValueShapes& values);
// What is laid over a track of numbers.
const Shape* modifiers_shape(ShapeStore& store, const ValueShapes& values);

const Shape* node_shape(ShapeStore& store, const ValueShapes& values);
const Shape* play_shape(ShapeStore& store, const ValueShapes& values);
const Shape* world_shape(ShapeStore& store, const ValueShapes& values);
const Shape* rule_shape(ShapeStore& store, const ValueShapes& values);
const Shape* import_shape(ShapeStore& store, const ValueShapes& values);

// Shapes in the making
Shape object_of(std::string what, std::vector<Field> fields);
Shape list_of(const Shape* element, std::string what, std::size_t fewest = 1, std::size_t most = Shape::no_limit);
Shape words_of(std::string what, std::vector<std::string> words);
Shape choice_of(std::string what, std::vector<const Shape*> alternatives);

inline Together exactly_one(std::vector<std::string> names) {
  return {Together::Rule::exactly_one, std::move(names)};
}
inline Together at_most_one(std::vector<std::string> names) {
  return {Together::Rule::at_most_one, std::move(names)};
}

}  // namespace tweenfall::document
