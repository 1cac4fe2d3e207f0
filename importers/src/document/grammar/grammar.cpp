#include "document/grammar/grammar.h"

#include "document/grammar/grammar_parts.h"

#include <utility>

namespace tweenfall::document {

namespace {

struct Grammar {
  ShapeStore store;
  const Shape* root = nullptr;

  Grammar() {
    const ValueShapes values(store);
    const auto map_of = [&](const Shape* shape, const std::string& what) {
      Shape map = object_of(what, {});
      map.others = shape;
      map.one_a_line = true;
      map.name_pattern = "^[\\s\\S]+$";
      map.name_fault = [](std::string_view name) { return std::string(name.empty() ? "a name is not empty" : ""); };
      return store.add(std::move(map));
    };
    const auto rows_of = [&](const Shape* shape, const std::string& what) {
      Shape list = list_of(shape, what, 0);
      list.one_a_line = true;
      return store.add(std::move(list));
    };
    Shape version;
    version.kind = Shape::Kind::number;
    version.what = "1, the version that this reader reads";
    version.low = version.high = document_version;
    Shape text;
    text.kind = Shape::Kind::text;
    text.what = "a text";
    const Shape* any_text = store.add(text);
    Shape frames;
    frames.kind = Shape::Kind::number;
    frames.what = "frames per second above 0";
    frames.low = 0;
    frames.above_low = true;

    Shape document =
        object_of("a document: an object with \"tweenfall\": 1",
                  {{"$schema", any_text, "for editors"},
                   {"tweenfall", store.add(version), "the version", true},
                   {"name", any_text, "", false, "\"\""},
                   {"fps", store.add(frames), "what \"12f\" counts"},
                   {"import", import_shape(store, values), "files whose nodes and clips come in"},
                   {"nodes", map_of(node_shape(store, values), "an object with nodes by name"), ""},
                   {"clips", map_of(clip_shape(store, values), "an object with clips by name"), "", false, "{}"},
                   {"play", rows_of(play_shape(store, values), "a list of plays"), "absent: the only clip"},
                   {"world", world_shape(store, values), "", false, "{}"},
                   {"handoff", rows_of(rule_shape(store, values), "a list of rules"), "", false, "[]"}});
    document.one_a_line = true;
    root = store.add(std::move(document));
  }
};

}  // namespace

const Shape& document_shape() {
  static const Grammar grammar;
  return *grammar.root;
}

}  // namespace tweenfall::document
