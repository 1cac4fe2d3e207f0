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

struct OperationWords {
  std::string operator()(const RestPose&) const { return "what lies below"; }
  std::string operator()(const ClipPose& pose) const {
    std::string words = "clip";
    if (pose.speed != 1) words += " at " + brief_text(pose.speed) + " x";
    if (pose.at != 0) words += " after " + brief_text(pose.at) + " s";
    constexpr const char* modes[] = {", once", ", repeat", ", repeat-offset", ", pingpong"};
    if (pose.loop) words += modes[static_cast<int>(pose.loop->mode)];
    if (pose.loop && pose.loop->count > 0) words += " x " + brief_text(pose.loop->count);
    return words;
  }
  std::string operator()(const BlendPose&) const { return "blend"; }
  std::string operator()(const LayersPose&) const { return "layers"; }
  std::string operator()(const SpacePose& pose) const {
    std::string words = "space";
    for (const GraphNumber& number : pose.by) {
      const auto* parameter = std::get_if<ByParameter>(&number);
      words += (&number == &pose.by.front() ? " by " : ", ") + (parameter ? parameter->name : "keys");
    }
    return words + (pose.sync ? ", in phase" : "");
  }
  std::string operator()(const MachinePose&) const { return "machine"; }
};

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

std::string words_of(const PoseOperation& operation) {
  return std::visit(graphs::OperationWords{}, operation);
}

}  // namespace tweenfall
