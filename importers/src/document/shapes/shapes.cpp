#include "document/shapes/shapes.h"

#include <vector>

// Every shape there is: the functions in the files of these names.
#define TWEENFALL_SHAPES(one) one(sphere) one(box) one(capsule) one(plane) one(hull) one(lathe) one(sweep)

namespace tweenfall::document::shapes {

#define TWEENFALL_SHAPE_DECLARED(name) SolidKind name();
TWEENFALL_SHAPES(TWEENFALL_SHAPE_DECLARED)
#undef TWEENFALL_SHAPE_DECLARED

namespace {

const std::vector<SolidKind>& kinds() {
#define TWEENFALL_SHAPE_LISTED(name) name(),
  static const std::vector<SolidKind> all = {TWEENFALL_SHAPES(TWEENFALL_SHAPE_LISTED)};
#undef TWEENFALL_SHAPE_LISTED
  return all;
}

}  // namespace

const Form* form(FormStore& store, const ValueForms& values) {
  std::vector<Field> fields;
  std::vector<std::string> words;
  std::string what = "a shape: one of ";
  for (const SolidKind& kind : kinds()) {
    what += (words.empty() ? "" : ", ") + in_quotes(kind.word);
    words.push_back(kind.word);
    fields.push_back({kind.word, kind.form.in(store, values), kind.help});
  }
  Form form = object_of(std::move(what), std::move(fields));
  form.together = {exactly_one(std::move(words))};
  form.definition = "shape";
  return store.add(std::move(form));
}

Solid read(const JsonValue& shape, Building& building) {
  for (const SolidKind& kind : kinds())
    if (const JsonValue value = usable(shape, kind.word)) return kind.read(value, building).value_or(Sphere{});
  return Sphere{};
}

}  // namespace tweenfall::document::shapes
