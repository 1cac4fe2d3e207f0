#include <tweenfall/anim/graph.h>
#include <tweenfall/curves/number_text.h>

namespace tweenfall {

namespace graphs {
namespace {

std::string in_words(const GraphCondition& condition) {
  using When = GraphCondition::Kind;
  switch (condition.kind) {
    case When::above:
      return condition.name + " > " + brief_text(condition.value);
    case When::below:
      return condition.name + " < " + brief_text(condition.value);
    case When::equals:
      return condition.name + " = " + brief_text(condition.value);
    case When::event:
      return "event \"" + condition.name + "\"";
    case When::time_in_state:
      return "after " + brief_text(condition.value) + " s";
    case When::clip_end:
      return "clip ends";
  }
  return {};
}

}  // namespace
}  // namespace graphs

std::string words_of(std::span<const GraphCondition> when) {
  std::string words;
  for (const GraphCondition& condition : when) words += (words.empty() ? "" : " and ") + graphs::in_words(condition);
  return words.empty() ? "at once" : words;
}

std::string words_of(const GraphChange& change) {
  const std::string seconds = brief_text(change.seconds) + " s";
  switch (change.kind) {
    case GraphChange::Kind::fade:
      if (change.seconds == 0) return "cut";
      return "fade " + seconds + (change.ease ? ", " + change.ease->name() : "");
    case GraphChange::Kind::quintic:
      return "settle quintic " + seconds;
    case GraphChange::Kind::half_life:
      return "settle half-life " + seconds;
    case GraphChange::Kind::dead_blend:
      return "dead blend " + seconds;
  }
  return {};
}

}  // namespace tweenfall
