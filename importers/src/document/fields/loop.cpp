#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/read/values.h"
#include "document/report/spellings.h"

#include <string>
#include <utility>
#include <vector>

namespace tweenfall::document::fields {

namespace {

const std::vector<std::pair<std::string, LoopMode>>& loop_words() {
  static const std::vector<std::pair<std::string, LoopMode>> words{{"repeat", LoopMode::repeat},
                                                                   {"repeat-offset", LoopMode::repeat_offset},
                                                                   {"pingpong", LoopMode::pingpong},
                                                                   {"once", LoopMode::once}};
  return words;
}

const Form* either_form(FormStore& store, const ValueForms& values, std::size_t words_taken) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < words_taken; ++i) words.push_back(loop_words()[i].first);
  const Form* word = store.add(words_of("a way to loop", words));
  Form full =
      object_of("a loop: {\"mode\", \"count\"}",
                {{"mode", word, "", true}, {"count", values.positive, "number of rounds; absent: without end"}});
  full.on_one_line = true;
  Form either = choice_of("a way to loop, or {\"mode\", \"count\"}", {word, store.add(std::move(full))});
  either.instead = loop_meant;
  return store.add(std::move(either));
}

}  // namespace

const Form* loop_form(FormStore& store, const ValueForms& values) {
  return either_form(store, values, loop_words().size() - 1);
}

const Form* loop_or_once_form(FormStore& store, const ValueForms& values) {
  return either_form(store, values, loop_words().size());
}

std::optional<Loop> read_loop(const json::Value& value) {
  const bool full = value.is(json::Value::Kind::object);
  const std::string said = full ? text_in(value, "mode") : std::string(value.text());
  for (const auto& [word, mode] : loop_words())
    if (said == word) return Loop{mode, full ? number_in(value, "count", 0) : 0};
  return std::nullopt;
}

void read_count_beside(const json::Value& value, std::optional<Loop>& loop, Problems& problems) {
  if (!loop) return;
  if (loop->count > 0) problems.add(value, "\"count\" beside a \"loop\" that counts already; give one of them");
  loop->count = value.number();
  if (loop->mode == LoopMode::once)
    problems.add(value, "\"count\" means nothing for what is played once; give another \"loop\"");
}

}  // namespace tweenfall::document::fields
